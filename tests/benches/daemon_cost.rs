//! What the daemon costs beside the work itself: `seamline watch --once` against `seamline segment`, on the same
//! thousand small parts, one thread each.
//!
//! `cargo bench -p seamline-tests --bench daemon_cost`. Times of the processors are those the system counts for
//! ended children, in steps of 10 ms; they are read from `/proc`, so that this runs on Linux only. Part for part
//! both write the same labels, which is checked.

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

use glam::DVec3;
use seamline_mesh::shapes::{self, Diagonals, Shape};
use seamline_mesh::{weld, write::write_stl_binary};
use seamline_tests::seamline;

const ROUNDS: usize = 4;
const CONFIG: &str = "[[watch]]\nroot = \"inbox\"\nstable_for_ms = 1\n\n[daemon]\nworkers = 1\n\n\
                      [pipeline]\nthreads = 1\n";

#[derive(Clone, Copy, PartialEq, Eq)]
enum Who {
    Segment,
    Watch,
}

/// The part of this number: of four kinds, and of about 1,000 to 10,000 triangles. No two are alike.
fn part(number: usize, of: usize) -> Shape {
    let size = (number / 4) as f64 / (of / 4) as f64;
    let triangles = 1100.0 + 8500.0 * size;
    let steps = |per_step: f64| (triangles / per_step) as usize;
    let shape = match number % 4 {
        0 => shapes::torus(1.0, 0.3, steps(40.0), 20),
        1 => shapes::cylinder(1.0, 2.0, steps(22.0), 10, Diagonals::Uniform),
        2 => shapes::shaft(steps(32.0), 9),
        _ => shapes::smooth_cube(0.2, 4 + (18.0 * size) as usize, 6),
    };
    let stretch = DVec3::new(1.0, 1.0, 1.0 + number as f64 * 1e-4);
    shape.map(|position| position * stretch)
}

/// Writes the parts; gives the fewest and the most triangles of one.
fn write_parts(inbox: &Path, count: usize) -> [usize; 2] {
    fs::create_dir(inbox).expect("a folder");
    let triangles = (0..count).map(|number| {
        let mesh = weld(part(number, count).polygons(), 0.0);
        let mut file = File::create(inbox.join(name(number))).expect("a file");
        write_stl_binary(&mut file, mesh.positions(), &mesh.triangles).expect("written");
        mesh.triangles.len()
    });
    triangles.fold([usize::MAX, 0], |[least, most], n| {
        [least.min(n), most.max(n)]
    })
}

fn name(number: usize) -> String {
    format!("part{number:04}.stl")
}

/// Seconds the processors gave to all children that have ended, in user and in system mode.
fn children_seconds() -> f64 {
    // Always 100 on Linux, whatever the kernel counts in.
    const TICKS_A_SECOND: f64 = 100.0;
    let stat = fs::read_to_string("/proc/self/stat").expect("Linux has it");
    // The name, in brackets, may hold blanks; behind it the third field follows.
    let fields = stat.rsplit_once(')').expect("a name").1.split_whitespace();
    let ticks = fields.skip(16 - 3).take(2).map(|n| n.parse::<f64>());
    ticks.map(|n| n.expect("a number")).sum::<f64>() / TICKS_A_SECOND
}

/// Runs a command to its end; seconds of the processors and by the clock.
fn measured(command: &mut Command) -> [f64; 2] {
    let (before, started) = (children_seconds(), Instant::now());
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null());
    assert!(quiet.status().expect("it starts").success(), "{command:?}");
    [children_seconds() - before, started.elapsed().as_secs_f64()]
}

/// Runs one of the two, and gives the times and the labels of every part. What it wrote is deleted at once, so
/// that each run comes after the same work of the disk.
fn run_and_clear(home: &Path, count: usize, who: Who) -> ([f64; 2], Vec<Vec<u8>>) {
    let mut command = seamline();
    command.current_dir(home.join("inbox"));
    match who {
        Who::Segment => command
            .args(["segment", "--threads", "1", "-o", "../out"])
            .args((0..count).map(name)),
        Who::Watch => command.args(["watch", "../watch.toml", "--once"]),
    };
    let seconds = measured(&mut command);
    let out = home.join("out");
    let labels = |number| fs::read(out.join(format!("{}.seamline/labels.seg", name(number))));
    let labels = (0..count).map(|number| labels(number).expect("labels"));
    let labels = labels.collect();
    fs::remove_dir_all(&out).expect("it is deleted");
    if who == Who::Watch {
        fs::remove_dir_all(home.join("state")).expect("it is deleted");
    }
    (seconds, labels)
}

/// Half of them are below and half above: of an even number the mean of the two in the middle.
fn median(mut of: Vec<f64>) -> f64 {
    of.sort_by(f64::total_cmp);
    (of[(of.len() - 1) / 2] + of[of.len() / 2]) / 2.0
}

fn main() {
    // Without this word cargo only wants to see that it runs.
    let in_earnest = std::env::args().any(|arg| arg == "--bench");
    let count = if in_earnest { 1000 } else { 8 };
    let home = tempfile::tempdir().expect("a temporary folder");
    let home = home.path();
    let [least, most] = write_parts(&home.join("inbox"), count);
    fs::write(home.join("watch.toml"), CONFIG).expect("a configuration");
    println!("{count} parts of {least} to {most} triangles; milliseconds a part");

    let (mut segmented, mut watched) = (Vec::new(), Vec::new());
    for round in 1..=ROUNDS {
        // Turn about, should it matter who comes first.
        let mut order = [Who::Segment, Who::Watch];
        order.rotate_left(round % 2);
        let labels = order.map(|who| {
            let (seconds, labels) = run_and_clear(home, count, who);
            match who {
                Who::Segment => segmented.push(seconds),
                Who::Watch => watched.push(seconds),
            }
            labels
        });
        assert!(labels[0] == labels[1], "both cut alike");
        let a_part = |seconds: &[[f64; 2]]| seconds[round - 1].map(|s| s * 1e3 / count as f64);
        let ([cut, cut_clock], [kept, kept_clock]) = (a_part(&segmented), a_part(&watched));
        println!(
            "round {round}: segment {cut:.3} of processor, {cut_clock:.3} by the clock; \
             watch {kept:.3} of processor, {kept_clock:.3} by the clock"
        );
    }
    for (at, what) in ["of processor", "by the clock"].into_iter().enumerate() {
        let a_part =
            |of: &[[f64; 2]]| median(of.iter().map(|run| run[at] * 1e3).collect()) / count as f64;
        let (cut, kept) = (a_part(&segmented), a_part(&watched));
        println!(
            "median {what}: segment {cut:.3}, watch {kept:.3}, ratio {:.3}",
            kept / cut
        );
    }
}
