//! The `cad` profile on CAD meshes whose patches are known.

use std::fs;

use seamline_mesh::{read, weld};
use seamline_tests::score::{Agreement, agreement};
use seamline_tests::{bench, segment_mesh};

const PARAMETRIC_PARTS: [&str; 17] = [
    "bottle",
    "box",
    "cam",
    "cone",
    "countersunk_plate",
    "cylinder",
    "flange",
    "gear",
    "l_bracket",
    "loft_body",
    "pipe_elbow",
    "pocketed_plate",
    "smooth_cube",
    "sphere",
    "stepped_shaft",
    "torus",
    "wheel",
];

/// Mean agreement of the parametric parts in one tessellation.
fn mean_agreement(variant: &str) -> Option<Agreement> {
    let models = bench("models")?;
    let mut mean = Agreement::default();
    for part in PARAMETRIC_PARTS {
        let path = models.join(format!("{part}-{variant}.stl"));
        let mesh = weld(read(&path).expect("the model reads"), 0.0);
        let labels =
            fs::read_to_string(path.with_extension("seg")).expect("its truth lies beside it");
        let truth: Vec<u32> = labels
            .lines()
            .map(|line| line.parse().expect("a label"))
            .collect();
        let found = segment_mesh(mesh.clone(), &["pipeline.profile=cad"]).face_patches;
        let found = agreement(&mesh, &truth, &found);
        mean.ari += found.ari / PARAMETRIC_PARTS.len() as f64;
        mean.boundary_f1 += found.boundary_f1 / PARAMETRIC_PARTS.len() as f64;
    }
    println!("{variant}: {mean:?}");
    Some(mean)
}

/// The floors are what an independent implementation of the facet method reached on these meshes.
#[test]
fn cad_agrees_with_the_truth_at_least_as_well_as_the_facet_method_it_implements() {
    for (variant, ari, boundary_f1) in [
        ("coarse", 0.855, 0.864),
        ("fine", 0.942, 0.934),
        ("uniform", 0.914, 0.920),
    ] {
        let Some(found) = mean_agreement(variant) else {
            return;
        };
        assert!(found.ari >= ari, "{variant}: ari {}", found.ari);
        assert!(
            found.boundary_f1 >= boundary_f1,
            "{variant}: boundary F1 {}",
            found.boundary_f1
        );
    }
}
