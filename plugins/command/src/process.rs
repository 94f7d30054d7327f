//! One process, and the three threads that keep its pipes from filling up.

use std::io::{BufRead, BufReader, BufWriter, Read, Write};
use std::os::unix::process::CommandExt;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStderr, ChildStdin, ChildStdout, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use arrow_array::RecordBatch;
use arrow_ipc::writer::StreamWriter;
use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, bounded, unbounded};
use rustix::process::{Pid, Signal, kill_process_group};
use seamline_ecs::CommandSettings;
use tracing::info;

use crate::fault::Fault;

/// Bytes taken from a pipe at a time.
const CHUNK_BYTES: usize = 1 << 16;

/// A line on standard error is cut off after this.
const LINE_BYTES: u64 = 4096;

/// A process that has closed its output has this long to end.
const ENDS_WITHIN: Duration = Duration::from_secs(2);

/// A process of a program. It is killed, with all it has started, when it is dropped.
pub struct Process {
    child: Child,
    to_send: Sender<Vec<RecordBatch>>,
    sent: Receiver<()>,
    received: Receiver<Vec<u8>>,
    /// Received, and not yet asked for.
    rest: Vec<u8>,
    /// Bytes received since the last question.
    said: usize,
    last_words: Arc<Mutex<String>>,
    /// Disconnected once standard error is closed.
    listens: Receiver<()>,
}

impl Process {
    /// Starts the program.
    pub fn start(settings: &CommandSettings) -> Result<Self, Fault> {
        let not_started = |error: std::io::Error| Fault::NotStarted(error.to_string());
        let folder = Path::new(&settings.folder);
        let [program, arguments @ ..] = &settings.command[..] else {
            return Err(Fault::NotStarted("it has no name".to_owned()));
        };
        let mut child = Command::new(place_of(program, folder))
            .args(arguments)
            .current_dir(folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            // Of its own, so that what it starts can be ended with it.
            .process_group(0)
            .spawn()
            .map_err(not_started)?;
        let (Some(input), Some(output), Some(errors)) =
            (child.stdin.take(), child.stdout.take(), child.stderr.take())
        else {
            return Err(Fault::NotStarted("it has no pipes".to_owned()));
        };

        let (to_send, batches) = unbounded();
        let (say_sent, sent) = unbounded();
        thread::spawn(move || feed(input, &batches, &say_sent));
        let (give, received) = bounded(16);
        thread::spawn(move || drain(output, &give));
        let last_words = Arc::new(Mutex::new(String::new()));
        let (closed, listens) = bounded(0);
        let (words, name) = (Arc::clone(&last_words), program.clone());
        thread::spawn(move || {
            let _closed: Sender<()> = closed;
            log(errors, &name, &words);
        });
        Ok(Self {
            child,
            to_send,
            sent,
            received,
            rest: Vec::new(),
            said: 0,
            last_words,
            listens,
        })
    }

    /// Does it run, with nothing said that nobody asked for?
    pub fn is_at_rest(&mut self) -> bool {
        let runs = matches!(self.child.try_wait(), Ok(None));
        runs && self.rest.is_empty() && self.received.is_empty()
    }

    /// Has it ended with status 0 and not said a byte since the last question?
    pub fn ended_well_without_a_word(&mut self) -> bool {
        self.said == 0 && self.exit_status().is_some_and(|status| status.success())
    }

    /// Begins to send tables; it reads them when it likes.
    pub fn send(&mut self, tables: Vec<RecordBatch>) {
        self.said = 0;
        // Where the thread has ended the process has too, which is noticed when its answer is waited for.
        let _ = self.to_send.send(tables);
    }

    /// Waits until all is sent, or it is too late.
    pub fn finish_sending(&mut self, until: Instant) {
        let _ = self.sent.recv_deadline(until);
    }

    /// Its next bytes, exactly so many.
    pub fn receive(&mut self, count: usize, until: Instant) -> Result<Vec<u8>, Fault> {
        while self.rest.len() < count {
            match self.received.recv_deadline(until) {
                Ok(chunk) => {
                    self.said += chunk.len();
                    self.rest.extend_from_slice(&chunk);
                }
                Err(RecvTimeoutError::Timeout) => return Err(Fault::Silent(0.0)),
                Err(RecvTimeoutError::Disconnected) => return Err(self.ended()),
            }
        }
        let later = self.rest.split_off(count);
        Ok(std::mem::replace(&mut self.rest, later))
    }

    /// How it came to its end, now that its output is closed.
    fn ended(&mut self) -> Fault {
        let how = match self.exit_status() {
            Some(status) => format!("ended with {status}"),
            None => "closed its output".to_owned(),
        };
        // Until what it said last has come through.
        let _ = self.listens.recv_timeout(ENDS_WITHIN);
        let last = self
            .last_words
            .lock()
            .unwrap_or_else(PoisonError::into_inner);
        let last_words = if last.is_empty() {
            String::new()
        } else {
            format!("; it said: {last}")
        };
        Fault::Ended { how, last_words }
    }

    fn exit_status(&mut self) -> Option<ExitStatus> {
        let until = Instant::now() + ENDS_WITHIN;
        while Instant::now() < until {
            match self.child.try_wait() {
                Ok(None) => thread::sleep(Duration::from_millis(5)),
                Ok(ended) => return ended,
                Err(_) => return None,
            }
        }
        None
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        if let Ok(None) = self.child.try_wait() {
            if let Some(group) = Pid::from_raw(self.child.id().cast_signed()) {
                let _ = kill_process_group(group, Signal::KILL);
            }
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

/// A program named with a folder is looked for from `folder` on, one without among those installed.
fn place_of(program: &str, folder: &Path) -> PathBuf {
    if program.contains('/') {
        // The system would begin from the folder of this process or of the new one, as it pleases.
        std::path::absolute(folder.join(program)).unwrap_or_else(|_| folder.join(program))
    } else {
        PathBuf::from(program)
    }
}

fn feed(input: ChildStdin, batches: &Receiver<Vec<RecordBatch>>, sent: &Sender<()>) {
    let mut input = BufWriter::with_capacity(CHUNK_BYTES, input);
    for tables in batches {
        for table in tables {
            let written = StreamWriter::try_new(&mut input, &table.schema()).and_then(|mut to| {
                to.write(&table)?;
                to.finish()
            });
            if written.is_err() {
                return;
            }
        }
        if input.flush().is_err() || sent.send(()).is_err() {
            return;
        }
    }
}

fn drain(mut output: ChildStdout, give: &Sender<Vec<u8>>) {
    let mut chunk = vec![0; CHUNK_BYTES];
    loop {
        match output.read(&mut chunk) {
            Ok(0) | Err(_) => return,
            Ok(count) => {
                if give.send(chunk[..count].to_vec()).is_err() {
                    return;
                }
            }
        }
    }
}

fn log(errors: ChildStderr, program: &str, last_words: &Mutex<String>) {
    let mut errors = BufReader::new(errors);
    loop {
        let mut line = Vec::new();
        let read = (&mut errors).take(LINE_BYTES).read_until(b'\n', &mut line);
        if !matches!(read, Ok(1..)) {
            return;
        }
        let line = String::from_utf8_lossy(&line);
        let line = line.trim();
        if !line.is_empty() {
            info!("{program}: {line}");
            line.clone_into(&mut last_words.lock().unwrap_or_else(PoisonError::into_inner));
        }
    }
}
