//! The paper's tables, on the paper's own Fandisk.

use seamline_ecs::Segmentation;
use seamline_mesh::{Mesh, read, weld};
use seamline_tests::{bench, count, segment_mesh};

fn fandisk() -> Option<Mesh> {
    Some(weld(
        read(&bench("paper/fandisk.obj")?).expect("fandisk reads"),
        0.0,
    ))
}

fn cut(mesh: &Mesh, clusters: u32, threshold: f64, more: &[&str]) -> Segmentation {
    let clusters = format!("kmeans.clusters={clusters}");
    let threshold = format!("merge.threshold={threshold}");
    let settings = ["pipeline.profile=lavoue2005", &clusters, &threshold];
    segment_mesh(mesh.clone(), &[&settings, more].concat())
}

#[test]
fn fandisk_by_clusters() {
    let Some(mesh) = fandisk() else { return };
    for k in [5, 10, 15, 18, 20, 30] {
        let grown = cut(&mesh, k, 5.0, &[]);
        let fifty = cut(&mesh, k, 50.0, &["pipeline.rectifier=none"]);
        println!(
            "K {k}: sharp {} {} inserted {} K' {} grown {} T5 {} T50 {} rectified {}",
            count(&grown, "sharp", "sharp_edges"),
            count(&grown, "sharp", "sharp_vertices"),
            count(&grown, "sharp", "inserted_vertices"),
            count(&grown, "classify", "clusters_regularised"),
            count(&grown, "grow", "regions"),
            count(&grown, "merge", "regions"),
            fifty.patches.len(),
            grown.patches.len(),
        );
        let scale = 1.0;
        let length: f64 = grown.boundaries.iter().map(|b| b.length).sum::<f64>() / scale;
        println!("   length {length}  bbox {:?}", grown.findings.bounding_box);
    }
}
