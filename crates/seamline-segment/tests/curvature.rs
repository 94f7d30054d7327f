//! Curvature tensors on surfaces whose curvature is known in closed form.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, dvec2, dvec3};
use proptest::prelude::*;
use seamline_ecs::components::{DihedralAngle, FaceShape, Position, SharpEdge};
use seamline_mesh::shapes::{self, Diagonals, Shape};
use seamline_mesh::{Topology, weld};
use seamline_segment::{
    Bending, Full, PrincipalFrame, TensorForm, TensorPair, dihedral_angles, face_shapes,
    face_tensors, find_facets, tangent_principal_frame, vertex_tensors,
};

/// A shape measured, with no edge taken as sharp.
struct Measured {
    topology: Topology,
    positions: Vec<Position>,
    shapes: Vec<FaceShape>,
    angles: Vec<DihedralAngle>,
    sharp: Vec<SharpEdge>,
}

impl Measured {
    fn of(shape: &Shape) -> Self {
        let mesh = weld(shape.polygons(), 0.0);
        let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
        let [_, faces, edges] = topology.counts();
        let positions: Vec<_> = mesh.positions().iter().map(|&p| Position(p)).collect();
        let mut shapes = vec![FaceShape::default(); faces];
        face_shapes(&topology, &positions, &mut shapes);
        let mut angles = vec![DihedralAngle::default(); edges];
        dihedral_angles(&topology, &positions, &shapes, &mut angles);
        Self {
            topology,
            positions,
            shapes,
            angles,
            sharp: vec![SharpEdge(false); edges],
        }
    }

    fn with_sharp_above(mut self, degrees: f64) -> Self {
        self.sharp = self
            .angles
            .iter()
            .map(|angle| SharpEdge(angle.0.abs().to_degrees() > degrees))
            .collect();
        self
    }

    fn bending(&self) -> Bending<'_> {
        Bending {
            topology: &self.topology,
            positions: &self.positions,
            shapes: &self.shapes,
            angles: &self.angles,
            sharp: &self.sharp,
        }
    }

    /// The sum of `beta |e|` over all edges: the integral of `k1 + k2` over a closed surface.
    fn total_bending(&self) -> f64 {
        let edges = self.topology.edge_vertices.iter().zip(&self.angles);
        edges
            .map(|([a, b], angle)| {
                angle.0
                    * self.positions[*a as usize]
                        .0
                        .distance(self.positions[*b as usize].0)
            })
            .sum()
    }

    /// Principal frames of the vertices for which `which` holds, across the normal `normal` gives.
    fn frames(
        &self,
        form: TensorForm,
        which: impl Fn(DVec3) -> bool,
        normal: impl Fn(DVec3) -> DVec3,
    ) -> Vec<PrincipalFrame> {
        let tensors: Vec<TensorPair> = vertex_tensors(&self.bending(), form, 0.3);
        let vertices = self
            .positions
            .iter()
            .zip(&tensors)
            .filter(|(p, _)| which(p.0));
        let frames: Vec<_> = vertices
            .map(|(p, t)| tangent_principal_frame(&t.full, normal(p.0).normalize()))
            .collect();
        assert!(!frames.is_empty());
        frames
    }
}

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!(
        (found - expected).abs() <= tolerance,
        "{found} is not {expected} within {tolerance}"
    );
}

#[test]
fn a_cube_bends_by_six_pi_times_its_side_and_inside_out_by_as_much_the_other_way() {
    for side in [1.0, 2.5] {
        let cube = shapes::cuboid(DVec3::splat(side));
        assert_near(Measured::of(&cube).total_bending(), 6.0 * PI * side, 1e-11);
        assert_near(
            Measured::of(&cube.reversed()).total_bending(),
            -6.0 * PI * side,
            1e-11,
        );
    }
}

#[test]
fn a_box_bends_by_two_pi_times_the_sum_of_its_sides() {
    let size = dvec3(1.0, 2.0, 3.5);
    let found = Measured::of(&shapes::cuboid(size)).total_bending();
    assert_near(found, TAU * size.element_sum(), 1e-11);
}

#[test]
fn an_icosphere_bends_by_nearly_eight_pi() {
    assert_near(
        Measured::of(&shapes::icosphere(3)).total_bending(),
        25.0928,
        1e-4,
    );
}

proptest! {
    #[test]
    fn face_tensors_add_up_to_the_bending_of_all_edges(
        size in prop::array::uniform3(0.1f64..5.0),
        radius in 0.01f64..0.04,
    ) {
        let solid = shapes::rounded_box(DVec3::from_array(size), [radius, 0.0, radius, 0.0], 5);
        let measured = Measured::of(&solid);
        let trace: f64 =
            face_tensors::<Full>(&measured.bending()).iter().map(|t| t.0.0[..3].iter().sum::<f64>()).sum();
        prop_assert!((trace - measured.total_bending()).abs() < 1e-9);
    }
}

const AXIS: DVec3 = DVec3::Z;

/// Curvature of an n-gon prism about a circle of radius `radius`: the step over the side.
fn prism_curvature(radius: f64, sides: usize) -> f64 {
    (TAU / sides as f64) / (2.0 * radius * (PI / sides as f64).sin())
}

fn prism(radius: f64, sides: usize, diagonals: Diagonals) -> Measured {
    Measured::of(&shapes::cylinder(radius, 3.0, sides, 6, diagonals))
}

/// Is this vertex two rows from the rims at least?
fn is_inside(p: DVec3) -> bool {
    p.z > 0.9 && p.z < 2.1
}

fn away_from_axis(p: DVec3) -> DVec3 {
    dvec3(p.x, p.y, 0.0)
}

#[test]
fn a_facet_of_a_prism_bends_one_way_only_by_its_step_over_its_width() {
    for (sides, diagonals) in [
        (12, Diagonals::Uniform),
        (17, Diagonals::Alternating),
        (64, Diagonals::Uniform),
    ] {
        let measured = prism(2.0, sides, diagonals).with_sharp_above(40.0);
        let facets = find_facets(&measured.bending(), 1e-3);
        let right = prism_curvature(2.0, sides);
        let strips: Vec<_> = facets
            .samples
            .iter()
            .filter(|s| s.curvature[1] > 1e-9)
            .collect();
        assert_eq!(
            strips.len(),
            sides,
            "one facet a side, each the whole strip"
        );
        for strip in strips {
            assert_near(strip.curvature[0], 0.0, 1e-12);
            assert_near(strip.curvature[1], right, 1e-12);
        }
    }
}

#[test]
fn a_cylinder_of_radius_2_bends_one_way_only_by_one_half() {
    let cylinder = prism(2.0, 128, Diagonals::Alternating);
    for frame in cylinder.frames(TensorForm::Ring, is_inside, away_from_axis) {
        assert_near(frame.k.k_min, 0.0, 1e-9);
        assert_near(frame.k.k_max, 0.5, 1e-3);
        assert_near(frame.d_min.dot(AXIS).abs(), 1.0, 1e-12);
        assert_near(frame.d_max.dot(AXIS), 0.0, 1e-12);
    }
}

#[test]
fn the_ring_form_is_exact_on_prisms_however_they_are_cut() {
    for diagonals in [Diagonals::Uniform, Diagonals::Alternating] {
        for sides in [12, 24, 48] {
            let prism = prism(1.0, sides, diagonals);
            for frame in prism.frames(TensorForm::Ring, is_inside, away_from_axis) {
                assert_near(frame.k.k_max, prism_curvature(1.0, sides), 1e-9);
                assert_near(frame.k.k_min, 0.0, 1e-9);
            }
        }
    }
}

#[test]
fn spokes_and_cell_depend_on_the_diagonals_of_a_prism() {
    let right = prism_curvature(1.0, 48);
    let factors = |form, diagonals| {
        let frames = prism(1.0, 48, diagonals).frames(form, is_inside, away_from_axis);
        let factors = frames.iter().map(|frame| frame.k.k_max / right);
        [
            factors.clone().fold(f64::MAX, f64::min),
            factors.fold(0.0, f64::max),
        ]
    };
    for (form, diagonals, [least, most]) in [
        (
            TensorForm::Spokes,
            Diagonals::Uniform,
            [2.0 / 3.0, 2.0 / 3.0],
        ),
        (TensorForm::Spokes, Diagonals::Alternating, [0.5, 1.0]),
        (TensorForm::Cell, Diagonals::Uniform, [1.0, 1.0]),
        (TensorForm::Cell, Diagonals::Alternating, [0.75, 1.5]),
    ] {
        let found = factors(form, diagonals);
        assert_near(found[0], least, 1e-9);
        assert_near(found[1], most, 1e-9);
    }
}

/// Mean of the greater principal curvature over an icosphere of radius 1, each vertex within `range`.
fn curvature_of_sphere(form: TensorForm, range: [f64; 2]) -> f64 {
    let frames = Measured::of(&shapes::icosphere(3)).frames(form, |_| true, |p| p);
    for frame in &frames {
        assert!(
            frame.k.k_max > range[0] && frame.k.k_max < range[1],
            "{:?}",
            frame.k
        );
    }
    frames.iter().map(|f| f.k.k_max).sum::<f64>() / frames.len() as f64
}

#[test]
fn a_sphere_of_radius_1_bends_both_ways_by_1() {
    assert_near(
        curvature_of_sphere(TensorForm::Ring, [0.98, 1.04]),
        1.006,
        1e-3,
    );
    assert_near(
        curvature_of_sphere(TensorForm::Cell, [0.99, 1.15]),
        1.006,
        1e-3,
    );
    assert_near(
        curvature_of_sphere(TensorForm::Spokes, [0.66, 0.77]),
        0.671,
        1e-3,
    );
    assert_near(
        curvature_of_sphere(TensorForm::Ball, [0.95, 1.1]),
        1.024,
        1e-2,
    );
}

#[test]
fn a_ball_on_a_cylinder_of_48_sides_is_a_little_high() {
    let cylinder = prism(1.0, 48, Diagonals::Alternating);
    for frame in cylinder.frames(TensorForm::Ball, is_inside, away_from_axis) {
        assert_near(frame.k.k_max, 1.049, 1e-2);
        assert_near(frame.k.k_min, 0.0, 1e-2);
    }
}

#[test]
fn a_torus_bends_one_way_outside_and_both_ways_inside() {
    let torus = Measured::of(&shapes::torus(1.0, 0.35, 96, 48));
    let towards = |p: DVec3| p - away_from_axis(p).normalize();
    for (outside, on_equator, near_equator) in
        [(true, 1.0 / 1.35, 0.7336), (false, -1.0 / 0.65, -1.5132)]
    {
        let side = |p: DVec3| (p.truncate().length() > 1.0) == outside;
        let on = torus.frames(TensorForm::Ring, |p| side(p) && p.z.abs() < 1e-9, towards);
        for frame in on {
            assert_near(frame.k.k_min / on_equator, 1.0, 1e-2);
            assert_near(frame.k.k_max, 2.8547, 1e-3);
        }
        let three_rows = |p: DVec3| side(p) && p.z.abs() < 0.35 * (TAU / 48.0 * 1.5).sin();
        let near = torus.frames(TensorForm::Ring, three_rows, towards);
        let mean = near.iter().map(|frame| frame.k.k_min).sum::<f64>() / near.len() as f64;
        assert_near(mean, near_equator, 1e-3);
    }
}

#[test]
fn the_outermost_strips_of_a_fillet_have_three_quarters_of_the_curvature_of_the_inner_ones() {
    let steps = 6;
    let corners = [
        dvec2(0.0, 0.0),
        dvec2(4.0, 0.0),
        dvec2(4.0, 4.0),
        dvec2(0.0, 4.0),
    ];
    let solid = shapes::rounded_prism(&corners, &[1.0, 0.0, 0.0, 0.0], 2.0, steps);
    let measured = Measured::of(&solid).with_sharp_above(40.0);
    let facets = find_facets(&measured.bending(), 1e-3);
    let step = PI / 2.0 / steps as f64;
    let inner = step / (2.0 * (step / 2.0).sin());
    let mut strips: Vec<f64> = facets
        .samples
        .iter()
        .map(|s| s.curvature[1])
        .filter(|&k| k > 0.5)
        .collect();
    strips.sort_by(f64::total_cmp);
    assert_eq!(strips.len(), steps);
    for (i, strip) in strips.into_iter().enumerate() {
        assert_near(strip, if i < 2 { 0.75 * inner } else { inner }, 1e-9);
    }
}
