//! What must hold in the end.

use std::collections::BTreeMap;

use rusqlite::Connection;
use seamline_tests::daemon::{Home, Status, leftovers};

use crate::writers::Dropped;

/// The results by the hash of their content, each with the name it is under.
type ByContent = BTreeMap<String, Vec<(String, [Vec<u8>; 4])>>;

/// What `watch --once` makes of what stayed, when nobody disturbs it.
pub fn undisturbed(dropped: &Dropped) -> Home {
    let calm = Home::with("stable_for_ms = 500\n");
    for (name, content) in dropped {
        calm.drop(name, &content.bytes);
    }
    calm.once();
    calm
}

/// Every content that stayed has one whole result, that of an undisturbed run to the byte, or one place in
/// quarantine with its reason; and nothing unfinished lies about.
pub fn nothing_is_lost(home: &Home, calm: &Home, dropped: &Dropped) {
    let [found, expected] = [home, calm].map(by_content);
    let reasons = reasons(home);
    let mut lost = Vec::new();
    for (name, content) in dropped {
        let hash = hash(&content.bytes);
        let results = found.get(&hash).map_or(&[][..], Vec::as_slice);
        let put_aside = reasons.get(&hash).copied().unwrap_or(0);
        match (content.faces, results, put_aside) {
            (Some(faces), [(place, bytes)], 0) => {
                let labels = bytes[0].iter().filter(|&&b| b == b'\n').count();
                assert_eq!(labels, faces, "{place}");
                assert!(*bytes == expected[&hash][0].1, "{place} differs");
            }
            (None, [], 1) => {}
            _ => {
                let places: Vec<_> = results.iter().map(|(place, _)| place).collect();
                lost.push(format!(
                    "{name}: faces {:?}, results {places:?}, in quarantine {put_aside} times, rows {:?}",
                    content.faces,
                    home.status().jobs_of(name)
                ));
            }
        }
    }
    assert!(
        lost.is_empty(),
        "{} of {}:\n{}",
        lost.len(),
        dropped.len(),
        lost.join("\n")
    );
    assert_eq!(leftovers(&home.path()), [""; 0]);
}

fn hash(bytes: &[u8]) -> String {
    blake3::hash(bytes).to_hex().to_string()
}

fn by_content(home: &Home) -> ByContent {
    let results = home.results();
    let mut found = ByContent::new();
    for (name, bytes) in results.all() {
        let report = results.report(&name).unwrap();
        let hash = report["input"]["blake3"].as_str().unwrap().to_owned();
        found.entry(hash).or_default().push((name, bytes));
    }
    found
}

/// How often each content lies in quarantine, with its reason beside it.
fn reasons(home: &Home) -> BTreeMap<String, u32> {
    let results = home.results();
    let mut found = BTreeMap::new();
    for name in results.quarantined() {
        let reason = results.reason(&name);
        let reason = reason.unwrap_or_else(|| panic!("{name} is in quarantine without a reason"));
        let bytes = std::fs::read(results.quarantine.join(&name)).unwrap();
        assert_eq!(reason["blake3"], hash(&bytes), "{name}: {reason}");
        *found.entry(hash(&bytes)).or_insert(0) += 1;
    }
    found
}

/// Prints what came of it.
pub fn figures(status: &Status, files: usize) {
    let ended = |state: &str| status.count(state);
    let repeated = status.jobs.iter().filter(|job| job.attempts > 1).count();
    let same = status
        .jobs
        .iter()
        .filter(|job| job.same_as.is_some())
        .count();
    println!("{files} files stayed, {} jobs", status.jobs.len());
    println!(
        "{} done ({same} of them of the same content as another), {} quarantined, {} gone, {repeated} begun more than once",
        ended("done"),
        ended("quarantined"),
        ended("gone")
    );
    println!("longest from ready to done: {:.1} s", longest(status));
}

/// By the clock of a database, which knows the calendar.
fn longest(status: &Status) -> f64 {
    let clock = Connection::open_in_memory().unwrap();
    let seconds = |from: &str, to: &str| -> f64 {
        let question = "SELECT 86400.0 * (julianday(?2) - julianday(?1))";
        clock
            .query_row(question, [from, to], |row| row.get(0))
            .unwrap()
    };
    let done = status.jobs.iter().filter(|job| job.state == "done");
    let took =
        done.filter_map(|job| Some(seconds(job.queued_at.as_deref()?, job.ended_at.as_deref()?)));
    took.fold(0.0, f64::max)
}
