//! The daemon under fire: writers that do everything writers do, and kill -9 every few seconds. In the end
//! every content that stayed has one whole result, or one place in quarantine with its reason.
//!
//!     cargo test --release -p seamline-tests --test soak -- --ignored --nocapture
//!
//! takes 20 minutes for 2,000 files. `SOAK_FILES`, `SOAK_MINUTES` and `SOAK_SEED` change that.

mod check;
mod writers;

use std::thread;
use std::time::{Duration, Instant};

use seamline_tests::daemon::{Daemon, Home, leftovers, wait_within};
use writers::{Dropped, Writer};

const WRITERS: u32 = 4;

/// Longer than files must hold still, and than the periodic listing takes.
const QUIET: Duration = Duration::from_secs(8);

/// Writers pause for less than `stable_for_ms`, as they must; attempts do not run out by kills.
const CONFIG: &str = "\
stable_for_ms = 1500
max_wait_ms = 60000
[daemon]
rescan_ms = 5000
[retry]
attempts = 1000
first_ms = 100
most_ms = 1000
";

fn from_environment(name: &str, default: u32) -> u32 {
    let given = std::env::var(name).ok();
    given.map_or(default, |text| text.parse().expect("a number"))
}

#[test]
#[ignore = "takes 20 minutes"]
fn nothing_is_lost_under_fire() {
    let files = from_environment("SOAK_FILES", 2000);
    let lasts = Duration::from_secs(60 * u64::from(from_environment("SOAK_MINUTES", 20)));
    let seed = u64::from(from_environment("SOAK_SEED", 1));
    let home = Home::with(CONFIG);
    let pace = lasts * WRITERS / files;

    let [mut kills, mut in_writing] = [0, 0];
    let dropped: Dropped = thread::scope(|scope| {
        let writers: Vec<_> = (0..WRITERS)
            .map(|number| {
                let writer = Writer::new(home.inbox(), number, seed);
                scope.spawn(move || writer.drop_all(files / WRITERS, pace))
            })
            .collect();
        let mut random = fastrand::Rng::with_seed(seed);
        while writers.iter().any(|writer| !writer.is_finished()) {
            let daemon = home.start();
            let lives = Duration::from_millis(random.u64(2000..8000));
            let ended = || writers.iter().all(|writer| writer.is_finished());
            wait_within(lives, ended);
            // Every other one in the middle of writing, if that comes soon.
            if kills % 2 == 1 {
                let writes = || !leftovers(&home.at("out")).is_empty();
                in_writing += u32::from(wait_within(lives, || writes() || ended()) && writes());
            }
            daemon.kill();
            kills += 1;
        }
        writers
            .into_iter()
            .flat_map(|writer| writer.join().unwrap())
            .collect()
    });

    let daemon = home.start();
    let started = Instant::now();
    wait_for_the_end(&home, &daemon, &dropped);
    println!(
        "drained in {:.1} s",
        (started.elapsed() - QUIET).as_secs_f64()
    );
    let casualties = home.requeue_casualties();
    println!("{casualties} put aside because they were killed thrice, and brought back");
    wait_for_the_end(&home, &daemon, &dropped);
    assert_eq!(daemon.terminate(), Some(0));

    println!("{kills} kills, {in_writing} of them in the middle of writing");
    check::figures(&home.status(), dropped.len());
    let calm = check::undisturbed(&dropped);
    check::nothing_is_lost(&home, &calm, &dropped);
}

/// Until every file is dealt with and nothing has moved for a while.
fn wait_for_the_end(home: &Home, daemon: &Daemon, dropped: &Dropped) {
    let mut quiet_since = Instant::now();
    daemon.wait_longer("the end", Duration::from_secs(900), || {
        let status = home.status();
        let settled = |name: &String| {
            let job = status.latest(name);
            job.is_some_and(|job| job.state == "done" || job.state == "quarantined")
        };
        let open = status.count("pending") + status.count("running");
        if open > 0 || !dropped.keys().all(settled) {
            quiet_since = Instant::now();
        }
        thread::sleep(Duration::from_millis(200));
        quiet_since.elapsed() > QUIET
    });
}
