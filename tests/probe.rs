//! probe
use seamline_mesh::shapes::{self, Shape};
use seamline_tests::{same_partition, segment};
fn show(name: &str, shape: &Shape, settings: &[&str], move_to: impl Fn(glam::DVec3) -> glam::DVec3) {
    println!("== {name}");
    let mut last: Option<Vec<u32>> = None;
    for (w, s) in [shape.clone(), shape.map(move_to)].iter().enumerate() {
        let cut = segment(s.polygons(), settings);
        println!("  {} patches", cut.patches.len());
        for st in &cut.stages { if !st.counts.is_empty() { println!("    {:?} {:?}", st.stage, st.counts); } }
        if w == 0 {
        for p in &cut.patches { println!("    {} faces {} area {:.5} k {:.3} {:.3} spread {:.3} {:.3} {:?}", p.id, p.summary.faces, p.summary.area, p.summary.k_min_mean, p.summary.k_max_mean, p.summary.k_min_spread, p.summary.k_max_spread, p.neighbours); }}
        if let Some(last) = &last { println!("    same: {}", same_partition(last, &cut.face_patches)); }
        last = Some(cut.face_patches);
    }
}
#[test]
fn probe() {
    let cube = shapes::smooth_cube(0.05, 1, 2);
    for r in ["none", "contour-tracking"] {
    let r = format!("pipeline.rectifier={r}");
    show("cad cube scaled", &cube, &[&r], |p| p * 3372.8841687890904);
    show("cad cube moved", &cube, &[&r], |p| p + 9.17480576049807 * glam::DVec3::Y);
    }
    let l = "pipeline.profile=lavoue2005";
    show("lav cube moved", &shapes::smooth_cube(0.3679853411866537, 4, 2), &[l], |p| p + -7.533951731486537 * glam::DVec3::Z);
    show("lav shaft scaled", &shapes::shaft(9, 2), &[l], |p| p * 0.0008580001026895353);
}
