//! Programs that drop files, with all their habits.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::Write;
use std::path::PathBuf;
use std::thread::sleep;
use std::time::{Duration, Instant};

use fastrand::Rng;
use seamline_tests::daemon::{cuboid, torus};

/// What a file holds.
#[derive(Clone, Debug)]
pub struct Content {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// Its faces; nothing if it is no mesh.
    pub faces: Option<usize>,
}

/// The last content of every path that stayed, by its name below the inbox.
pub type Dropped = BTreeMap<String, Content>;

/// One program, which drops files into folders of its own.
pub struct Writer {
    inbox: PathBuf,
    number: u32,
    random: Rng,
    dropped: Dropped,
    contents: u32,
}

impl Writer {
    /// The writer of this number.
    pub fn new(inbox: PathBuf, number: u32, seed: u64) -> Self {
        Self {
            inbox,
            number,
            random: Rng::with_seed(seed * 1000 + u64::from(number)),
            dropped: Dropped::new(),
            contents: 0,
        }
    }

    /// Drops so many files, one a `pace`.
    pub fn drop_all(mut self, files: u32, pace: Duration) -> Dropped {
        let started = Instant::now();
        for number in 0..files {
            sleep((started + pace * number).saturating_duration_since(Instant::now()));
            self.drop_one(number);
        }
        self.dropped
    }

    fn drop_one(&mut self, number: u32) {
        let content = self.new_content();
        let folder = format!("writer{}/day{}", self.number, number % 7);
        let name = format!("{folder}/part{number}.{}", content.1);
        let content = content.0;
        fs::create_dir_all(self.inbox.join(folder)).unwrap();
        match self.random.u32(0..100) {
            0..25 => self.write_slowly(&name, &content.bytes),
            25..50 => self.write_then_rename(&name, &content.bytes),
            50..60 => {
                let other = self.new_content().0;
                self.write(&name, &other.bytes[..other.bytes.len() / 2]);
                self.pause(300);
                self.write_slowly(&name, &content.bytes);
            }
            60..70 => return self.overwrite_an_earlier_one(),
            70..80 => return self.repeat_an_earlier_one(&name),
            80..85 => {
                self.write(&name, &content.bytes);
                self.pause(4000);
                fs::remove_file(self.inbox.join(name)).unwrap();
                return;
            }
            85..92 => {
                let text = format!("v {} {number} 0\nf 1 2 3\n", self.number);
                self.write(&name, text.as_bytes());
                let broken = Content {
                    bytes: text.into_bytes(),
                    faces: None,
                };
                self.dropped.insert(name, broken);
                return;
            }
            _ => self.write(&name, &content.bytes),
        }
        self.dropped.insert(name, content);
    }

    /// A mesh that nobody has dropped before, with its extension.
    fn new_content(&mut self) -> (Content, &'static str) {
        self.contents += 1;
        let number = self.contents * 10 + self.number;
        if self.random.u32(0..10) < 7 {
            let bytes = cuboid(f64::from(number)).into_bytes();
            let faces = Some(6);
            return (Content { bytes, faces }, "obj");
        }
        let mut bytes = torus(self.random.usize(500..150_000));
        bytes[..4].copy_from_slice(&number.to_le_bytes());
        let faces = Some((bytes.len() - 84) / 50);
        (Content { bytes, faces }, "stl")
    }

    fn overwrite_an_earlier_one(&mut self) {
        let Some((name, _)) = self.pick() else { return };
        let is = |extension| name.ends_with(extension);
        let content = loop {
            let (content, extension) = self.new_content();
            if is(extension) {
                break content;
            }
        };
        match self.random.bool() {
            true => self.write_slowly(&name, &content.bytes),
            false => self.write_then_rename(&name, &content.bytes),
        }
        self.dropped.insert(name, content);
    }

    fn repeat_an_earlier_one(&mut self, name: &str) {
        let Some((earlier, content)) = self.pick() else {
            return;
        };
        let extension = earlier.rsplit('.').next().unwrap();
        let name = format!("{}-copy.{extension}", name.rsplit_once('.').unwrap().0);
        self.write(&name, &content.bytes);
        self.dropped.insert(name, content);
    }

    /// A mesh dropped before. Broken files are left alone: they are moved away by the daemon, and who
    /// writes to a file while it is moved has himself to blame.
    fn pick(&mut self) -> Option<(String, Content)> {
        let meshes: Vec<_> = self
            .dropped
            .iter()
            .filter(|(_, content)| content.faces.is_some())
            .collect();
        let (name, content) = self.random.choice(meshes)?;
        Some((name.clone(), content.clone()))
    }

    fn write(&self, name: &str, bytes: &[u8]) {
        fs::write(self.inbox.join(name), bytes).unwrap();
    }

    /// In pieces, with pauses, closed and opened again in between.
    fn write_slowly(&mut self, name: &str, bytes: &[u8]) {
        let path = self.inbox.join(name);
        let pieces = self.random.usize(2..6);
        File::create(&path).unwrap();
        for piece in bytes.chunks(bytes.len().div_ceil(pieces)) {
            let mut file = File::options().append(true).open(&path).unwrap();
            file.write_all(piece).unwrap();
            drop(file);
            self.pause(300);
        }
    }

    fn write_then_rename(&mut self, name: &str, bytes: &[u8]) {
        let name = self.inbox.join(name);
        let mut unfinished = name.clone().into_os_string();
        unfinished.push(".part");
        fs::write(&unfinished, bytes).unwrap();
        self.pause(200);
        fs::rename(unfinished, name).unwrap();
    }

    fn pause(&mut self, most_ms: u64) {
        sleep(Duration::from_millis(self.random.u64(0..most_ms)));
    }
}
