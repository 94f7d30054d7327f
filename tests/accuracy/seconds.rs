//! The models that took most processor time.

use crate::cut::Cut;

const TOLD: usize = 10;

pub fn print(cuts: &[Cut]) {
    println!("\n### Processor time\n\n| mesh | triangles | seconds |\n|---|---|---|");
    let mut slowest: Vec<&Cut> = cuts.iter().collect();
    slowest.sort_by(|a, b| b.seconds.total_cmp(&a.seconds));
    for cut in slowest.iter().take(TOLD) {
        let triangles = cut.model.mesh.triangles.len();
        println!("| {} | {triangles} | {:.2} |", cut.model.name, cut.seconds);
    }
    let all: f64 = cuts.iter().map(|cut| cut.seconds).sum();
    println!("| all {} | | {all:.2} |", cuts.len());
}
