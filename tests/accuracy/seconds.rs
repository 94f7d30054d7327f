//! The models that took most time.

use std::time::Duration;

use crate::cut::Cut;
use crate::text::of;

const TOLD: usize = 10;
/// What nobody waits for.
const SOON: Duration = Duration::from_millis(150);

pub fn print(cuts: &[Cut]) {
    let processors = std::thread::available_parallelism().map_or(1, usize::from);
    println!(
        "\n### Time\n\nOn {processors} processors.\n\n\
        | mesh | triangles | seconds of all processors | milliseconds from begin to end |\n|---|---|---|---|"
    );
    let mut slowest: Vec<&Cut> = cuts.iter().collect();
    slowest.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    for cut in slowest.iter().take(TOLD) {
        let triangles = cut.model.mesh.triangles.len();
        println!(
            "| {} | {triangles} | {:.2} | {} |",
            cut.model.name,
            cut.seconds,
            cut.elapsed.as_millis()
        );
    }
    let all: f64 = cuts.iter().map(|cut| cut.seconds).sum();
    println!("| all {} | | {all:.2} | |", cuts.len());
    let soon = cuts.iter().filter(|cut| cut.elapsed <= SOON).count();
    println!(
        "\nFrom begin to end at most {} ms: {}.",
        SOON.as_millis(),
        of(soon, cuts.len())
    );
}
