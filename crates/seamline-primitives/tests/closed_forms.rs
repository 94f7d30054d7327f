//! Surfaces of shapes in closed form.

mod shaken;

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec3, dvec2};
use proptest::prelude::*;
use seamline_mesh::shapes::{self, Diagonals, Shape};
use seamline_mesh::{Topology, weld};
use seamline_primitives::{Fitted, Found, Kind, find};
use shaken::found_shaken;

fn found(shape: &Shape) -> (Found, Vec<u32>) {
    let mesh = weld(shape.polygons(), 0.0);
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    let truth = mesh
        .face_of_triangle
        .iter()
        .map(|&face| shape.patches[face as usize])
        .collect();
    (find(mesh.positions(), &topology, 0.0), truth)
}

/// Are two labellings the same but for the names of the labels?
fn same(a: &[u32], b: &[u32]) -> bool {
    let mut pairs: Vec<(u32, u32)> = a.iter().copied().zip(b.iter().copied()).collect();
    pairs.sort_unstable();
    pairs.dedup();
    let [firsts, seconds] = [|p: &(u32, u32)| p.0, |p: &(u32, u32)| p.1].map(|name| {
        let mut names: Vec<u32> = pairs.iter().map(name).collect();
        names.sort_unstable();
        names.dedup();
        names.len()
    });
    pairs.len() == firsts && pairs.len() == seconds
}

fn of_kind(found: &Found, kind: Kind) -> Vec<Fitted> {
    let surfaces = found.surfaces.iter().flatten();
    surfaces
        .filter(|fitted| fitted.surface.kind == kind)
        .copied()
        .collect()
}

#[test]
fn a_cylinder_of_radius_two_is_a_cylinder_of_radius_two_between_two_planes() {
    let (found, truth) = found(&shapes::cylinder(2.0, 3.0, 24, 1, Diagonals::Uniform));
    assert!(same(&found.of_face, &truth));
    let [side] = of_kind(&found, Kind::Cylinder)[..] else {
        panic!("one cylinder");
    };
    assert!((side.surface.a - 2.0).abs() < 1e-9);
    assert!((side.surface.axis.z.abs() - 1.0).abs() < 1e-9);
    assert!(side.convex && side.exact);
    assert_eq!(of_kind(&found, Kind::Plane).len(), 2);
    assert!(found.exact_share > 0.999);
}

#[test]
fn turned_inside_out_it_is_a_hole() {
    let (found, _) = found(&shapes::cylinder(2.0, 3.0, 24, 1, Diagonals::Uniform).reversed());
    assert!(
        of_kind(&found, Kind::Cylinder)
            .iter()
            .all(|side| !side.convex)
    );
}

#[test]
fn a_cone_has_its_half_angle_and_a_torus_its_two_radii() {
    // Rows between rim and tip, else any cone through the rim would do.
    let profile = [
        shapes::line(glam::DVec2::new(0.0, 0.0), glam::DVec2::new(2.0, 0.0)),
        shapes::line(glam::DVec2::new(2.0, 0.0), glam::DVec2::new(1.0, 2.0)),
        shapes::line(glam::DVec2::new(1.0, 2.0), glam::DVec2::new(0.0, 2.0)),
    ];
    let (frustum, truth) = found(&shapes::revolve(&profile, 32, Diagonals::Uniform));
    assert!(same(&frustum.of_face, &truth));
    let [side] = of_kind(&frustum, Kind::Cone)[..] else {
        panic!("one cone");
    };
    assert!((side.surface.b - 0.5f64.atan()).abs() < 1e-7);

    let (torus, truth) = found(&shapes::torus(3.0, 1.0, 40, 20));
    assert!(same(&torus.of_face, &truth));
    let [tube] = of_kind(&torus, Kind::Torus)[..] else {
        panic!("one torus");
    };
    assert!((tube.surface.a - 3.0).abs() < 1e-7 && (tube.surface.b - 1.0).abs() < 1e-7);
}

#[test]
fn a_sphere_of_triangles_is_one_sphere() {
    let (found, truth) = found(&shapes::icosphere(3));
    assert!(same(&found.of_face, &truth));
    let [all] = of_kind(&found, Kind::Sphere)[..] else {
        panic!("one sphere");
    };
    assert!((all.surface.a - 1.0).abs() < 1e-9 && all.surface.point.length() < 1e-9);
}

#[test]
fn a_smooth_cube_has_six_planes_twelve_cylinders_and_eight_spheres() {
    for (flat, round) in [(12, 8), (1, 4), (3, 6)] {
        let (found, truth) = found(&shapes::smooth_cube(0.2, flat, round));
        assert!(same(&found.of_face, &truth), "{flat} {round}");
        let counts = [Kind::Plane, Kind::Cylinder, Kind::Sphere].map(|k| of_kind(&found, k).len());
        assert_eq!(counts, [6, 12, 8], "{flat} {round}");
        for fitted in found.surfaces.iter().flatten() {
            if fitted.surface.kind != Kind::Plane {
                assert!((fitted.surface.a - 0.2).abs() < 1e-6);
            }
        }
    }
}

#[test]
fn the_fillet_of_a_shaft_is_a_torus_that_bends_inward() {
    let (found, truth) = found(&shapes::shaft(24, 4));
    assert!(same(&found.of_face, &truth));
    let [fillet] = of_kind(&found, Kind::Torus)[..] else {
        panic!("one torus");
    };
    assert!(!fillet.convex);
}

/// A disc of radius 2 with a shaft of radius 1 on it and a fillet of `radius` in four chords between, in the single
/// precision of an export and not along any axis.
fn filleted_shaft(radius: f64, sides: usize) -> Shape {
    let corner = 1.0 + radius;
    let round = [-FRAC_PI_2, -PI];
    let profile = shapes::profile(
        vec![
            shapes::line(dvec2(0.0, 0.0), dvec2(2.0, 0.0)),
            shapes::line(dvec2(2.0, 0.0), dvec2(2.0, 1.0)),
            shapes::line(dvec2(2.0, 1.0), dvec2(corner, 1.0)),
            shapes::arc(dvec2(corner, corner), radius, round[0], round[1], 4),
            shapes::line(dvec2(1.0, corner), dvec2(1.0, 2.0)),
            shapes::line(dvec2(1.0, 2.0), dvec2(0.0, 2.0)),
        ],
        false,
    );
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    shapes::revolve(&profile, sides, Diagonals::Uniform).map(|x| (turn * x).as_vec3().as_dvec3())
}

/// Each strip across it lies on a cylinder of the tube's radius as exactly as it is stored.
#[test]
fn a_narrow_fillet_is_one_torus_however_many_strips_it_has() {
    for sides in [256, 512, 1000] {
        let (found, truth) = found(&filleted_shaft(0.02, sides));
        assert!(same(&found.of_face, &truth), "{sides} strips");
        let [fillet] = of_kind(&found, Kind::Torus)[..] else {
            panic!("one torus, {sides} strips");
        };
        assert!((fillet.surface.b - 0.02).abs() < 1e-5 && (fillet.surface.a - 1.02).abs() < 1e-5);
    }
}

#[test]
fn a_mesh_without_extent_is_cut_all_the_same() {
    let topology = Topology::build(3, vec![[0, 1, 2]]);
    let found = find(&[DVec3::ZERO; 3], &topology, 0.0);
    assert_eq!(found.of_face, [0]);
    assert_eq!(find(&[], &Topology::build(0, Vec::new()), 0.0).of_face, []);
}

/// A smooth cube whose vertices are moved by up to half of `width` along each axis, with so many facets across each
/// rounding.
fn noisy_cube(width: f64, round: usize) -> (Found, Vec<u32>) {
    let shape = shapes::smooth_cube(0.2, 12, round);
    (found_shaken(&shape, width), shape.patches)
}

#[test]
fn the_noise_of_vertices_is_told_and_its_size() {
    assert_eq!(noisy_cube(0.0, 8).0.noise, 0.0);
    for width in [1e-4, 1e-3] {
        is_told(width, 8);
    }
}

/// Its flattest pairs of triangles are off one plane by what it bends, which would be noise of some size.
#[test]
fn a_smooth_egg_is_not_taken_for_noisy() {
    let egg =
        shapes::icosphere(4).map(|x| x * DVec3::new(1.0, 1.0, 1.3 + 0.2 * x.z - 0.1 * x.z * x.z));
    assert_eq!(found(&egg).0.noise, 0.0);
}

#[test]
fn facets_as_narrow_as_the_noise_hide_nothing_of_it() {
    is_told(0.02, 50);
}

/// Is the standard deviation told, as nearly as a knee in a curve can be seen?
fn is_told(width: f64, round: usize) {
    let deviation = width / 12f64.sqrt();
    let noise = noisy_cube(width, round).0.noise;
    assert!(
        (0.7..1.4).contains(&(noise / deviation)),
        "{noise} for {deviation}"
    );
}

#[test]
fn a_smooth_cube_keeps_its_patches_under_noise_of_a_thousandth_of_an_edge() {
    let (found, truth) = noisy_cube(1e-4, 8);
    assert!(found.exact_share > 0.5, "{}", found.exact_share);
    let kinds = [Kind::Plane, Kind::Cylinder, Kind::Sphere].map(|kind| of_kind(&found, kind).len());
    assert_eq!(kinds, [6, 12, 8]);
    assert_eq!(found.surfaces.len(), 26);
    let mut pairs: Vec<(u32, u32)> = truth.iter().copied().zip(found.of_face).collect();
    pairs.sort_unstable();
    let most = pairs.chunk_by(|a, b| a.0 == b.0).map(|of_one| {
        let runs = of_one.chunk_by(|a, b| a.1 == b.1);
        runs.map(<[_]>::len).max().unwrap()
    });
    let agree: usize = most.sum();
    assert!(
        agree * 100 >= truth.len() * 97,
        "{agree} of {}",
        truth.len()
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(12))]

    #[test]
    fn a_part_is_cut_alike_wherever_it_lies_and_however_large_it_is(
        axis in prop::array::uniform3(-1.0..1.0f64),
        angle in 0.0..6.0f64,
        place in prop::array::uniform3(-10.0..10.0f64),
        size in 1e-3..1e3f64,
    ) {
        let turn = DQuat::from_axis_angle(
            DVec3::from_array(axis).normalize_or(DVec3::Z),
            angle,
        );
        let shape = shapes::bracket(5);
        let moved = shape.map(|x| (turn * x + DVec3::from_array(place)) * size);
        let (found, truth) = found(&moved);
        prop_assert!(same(&found.of_face, &truth));
    }
}
