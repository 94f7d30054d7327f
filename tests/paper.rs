//! The paper's tables, on the paper's own Fandisk, by the profile `lavoue2005`.

use std::collections::BTreeMap;

use glam::DVec3;
use seamline_ecs::Segmentation;
use seamline_mesh::{EdgeKind, Mesh, Topology, read, weld};
use seamline_tests::{bench, count, segment_mesh};

fn fandisk() -> Option<Mesh> {
    Some(weld(
        read(&bench("paper/fandisk.obj")?).expect("fandisk reads"),
        0.0,
    ))
}

fn cut(mesh: &Mesh, clusters: u32, threshold: f64, rectifier: &str) -> Segmentation {
    let settings = [
        "pipeline.profile=lavoue2005".to_owned(),
        format!("pipeline.rectifier={rectifier}"),
        format!("kmeans.clusters={clusters}"),
        format!("merge.threshold={threshold}"),
    ];
    segment_mesh(mesh.clone(), &settings.each_ref().map(String::as_str))
}

/// Length of all boundaries, in longest sides of the bounding box.
fn boundary_length(mesh: &Mesh, cut: &Segmentation) -> f64 {
    let [low, high] = mesh.bounding_box();
    cut.boundaries.iter().map(|b| b.length).sum::<f64>() / (high - low).max_element()
}

#[test]
fn fandisk_has_the_sharp_features_it_is_known_for() {
    let Some(mesh) = fandisk() else { return };
    let found = cut(&mesh, 10, 5.0, "none");
    assert_eq!(found.findings.triangles, 12_946);
    assert_eq!(count(&found, "sharp", "sharp_edges"), 710);
    assert_eq!(count(&found, "sharp", "sharp_vertices"), 700);
    assert_eq!(count(&found, "sharp", "inserted_vertices"), 20);
}

/// The paper's Table 2, and its Fig. 10 and Table 1 at threshold 5. The command that prints it:
/// `cargo test --release -p seamline-tests --test paper -- --nocapture`.
#[test]
fn fandisk_comes_out_with_as_many_regions_as_in_the_papers_tables() {
    let Some(mesh) = fandisk() else { return };
    println!("| K | K' | grown | T = 50 | T = 5 | T = 5, rectified | length |");
    println!("|---|---|---|---|---|---|---|");
    for (k, clusters, grown) in [
        (5, 4, 41),
        (10, 8, 52),
        (15, 8, 66),
        (18, 9, 66),
        (20, 10, 72),
        (30, 11, 82),
    ] {
        let fifty = cut(&mesh, k, 50.0, "none");
        let five = cut(&mesh, k, 5.0, "contour-tracking");
        let found_clusters = count(&five, "classify", "clusters_regularised");
        let found_grown = count(&five, "grow", "regions");
        let merged = count(&five, "merge", "regions");
        let length = boundary_length(&mesh, &five);
        println!(
            "| {k} | {found_clusters} | {found_grown} | {} | {merged} | {} | {length:.3} |",
            fifty.patches.len(),
            five.patches.len()
        );
        // Ties of k-means in the last bit may move a sample.
        assert!(
            found_clusters.abs_diff(clusters) <= 1,
            "K {k}: K' {found_clusters}"
        );
        assert!(
            found_grown.abs_diff(grown) <= 3,
            "K {k}: grown {found_grown}"
        );
        assert_eq!(fifty.patches.len(), 15, "K {k}");
        assert!((22..=26).contains(&merged), "K {k}: {merged}");
        assert!(
            (22..=23).contains(&five.patches.len()),
            "K {k}: {}",
            five.patches.len()
        );
        let right = if five.patches.len() == 22 {
            16.948
        } else {
            17.404
        };
        assert!((length - right).abs() < 0.02, "K {k}: length {length}");
    }
}

#[test]
fn no_rectified_boundary_of_fandisk_turns_by_more_than_45_degrees_where_it_is_not_sharp() {
    let Some(mesh) = fandisk() else { return };
    let before = cut(&mesh, 10, 5.0, "none");
    assert!(
        smooth_turns(&mesh, &before).any(|turn| turn > 45.0),
        "unrectified boundaries are jagged"
    );
    for k in [5, 10, 15, 20] {
        let after = cut(&mesh, k, 5.0, "contour-tracking");
        let worst = smooth_turns(&mesh, &after).fold(0.0, f64::max);
        assert!(worst <= 45.0, "K {k}: a turn of {worst} degrees");
    }
}

/// The turns in degrees between consecutive boundary edges that are not sharp, at vertices where just two
/// boundary edges meet.
fn smooth_turns(mesh: &Mesh, cut: &Segmentation) -> impl Iterator<Item = f64> {
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    let at = |v: u32| mesh.positions()[v as usize];
    let normal = |face: u32| {
        let [a, b, c] = topology.triangles[face as usize].map(at);
        (b - a).cross(c - a).normalize()
    };
    let mut around: BTreeMap<u32, Vec<(DVec3, bool)>> = BTreeMap::new();
    for (edge, [a, b]) in topology.edge_faces.iter().copied().enumerate() {
        assert_eq!(
            topology.edge_kind[edge],
            EdgeKind::Regular,
            "fandisk is closed"
        );
        if cut.face_patches[a as usize] == cut.face_patches[b as usize] {
            continue;
        }
        let sharp = normal(a).angle_between(normal(b)).to_degrees() > 40.0;
        let [from, to] = topology.edge_vertices[edge];
        around
            .entry(from)
            .or_default()
            .push((at(to) - at(from), sharp));
        around
            .entry(to)
            .or_default()
            .push((at(from) - at(to), sharp));
    }
    around.into_values().filter_map(|edges| match edges[..] {
        [(a, false), (b, false)] => Some((-a).angle_between(b).to_degrees()),
        _ => None,
    })
}
