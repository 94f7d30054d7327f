//! The sample parts in `tests/data`: every one made here, none taken from elsewhere.

use glam::{DVec3, dvec3};
use seamline_mesh::shapes::{self, Diagonals, Shape};
use seamline_mesh::write::{
    VertexQuantities, write_obj, write_ply, write_stl_ascii, write_stl_binary,
};
use seamline_mesh::{Mesh, weld};

/// One file of `tests/data`.
#[derive(Clone, Debug)]
pub struct Sample {
    /// Where it lies, below `tests/data`.
    pub path: &'static str,
    /// What the file holds.
    pub bytes: Vec<u8>,
    /// The patch of each face of the file.
    pub patches: Vec<u32>,
}

impl Sample {
    /// How many patches are right.
    pub fn patch_count(&self) -> usize {
        self.patches
            .iter()
            .max()
            .map_or(0, |&last| last as usize + 1)
    }
}

/// All sample parts, in the order of their paths. The same on every call.
pub fn samples() -> Vec<Sample> {
    vec![
        obj("bracket.obj", &shapes::bracket(6), 20.0),
        obj(
            "cylinder.obj",
            &shapes::cylinder(1.0, 2.0, 32, 2, Diagonals::None),
            15.0,
        ),
        stl(
            "rounded_box.stl",
            &shapes::rounded_box(dvec3(2.0, 2.0, 1.0), [0.2, 0.0, 0.6, 0.0], 6),
            25.0,
        ),
        stl("shaft.stl", &shapes::shaft(32, 4), 12.0),
        stl("smooth_cube.stl", &shapes::smooth_cube(0.2, 3, 4), 50.0),
        text_stl(
            "stadium_plate.stl",
            &shapes::stadium(2.0, 0.5, 0.25, 10),
            30.0,
        ),
        ply("torus.ply", &shapes::torus(1.0, 0.3, 36, 20), 20.0),
        obj("turned/cone.obj", &shapes::cone(1.0, 2.0, 24), 10.0),
        stl("turned/shaft.stl", &shapes::shaft(24, 3), 8.0),
    ]
}

/// The shape in millimetres, welded. Coordinates are those of a drawing, with six digits after the point: more
/// would depend on the last bit of this machine's sine.
fn part(shape: &Shape, size: f64) -> Mesh {
    let rounded = |p: DVec3| (p * size * 1e6).round() / 1e6;
    weld(shape.map(rounded).polygons(), 0.0)
}

/// What `fill` writes.
fn filled(fill: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>) -> Vec<u8> {
    let mut bytes = Vec::new();
    fill(&mut bytes).expect("memory takes every byte");
    bytes
}

/// Faces as they are, polygons of more than three corners among them.
fn obj(path: &'static str, shape: &Shape, size: f64) -> Sample {
    let part = part(shape, size);
    Sample {
        path,
        bytes: filled(|out| write_obj(out, &part.polygons)),
        patches: shape.patches.clone(),
    }
}

/// As [`obj`]; the file has the columns of `patches.ply`, without anything in them.
fn ply(path: &'static str, shape: &Shape, size: f64) -> Sample {
    let part = part(shape, size);
    let vertices = part.positions().len();
    let (zero, nowhere) = (vec![0.0; vertices], vec![[0.0; 3]; vertices]);
    let nothing = VertexQuantities {
        k_min: &zero,
        k_max: &zero,
        d_min: &nowhere,
        d_max: &nowhere,
    };
    let one_patch = vec![0; part.polygons.face_count()];
    Sample {
        path,
        bytes: filled(|out| write_ply(out, &part.polygons, nothing, &one_patch, None)),
        patches: shape.patches.clone(),
    }
}

fn stl(path: &'static str, shape: &Shape, size: f64) -> Sample {
    let part = part(shape, size);
    Sample {
        path,
        bytes: filled(|out| write_stl_binary(out, part.positions(), &part.triangles)),
        patches: of_triangles(shape, &part),
    }
}

fn text_stl(path: &'static str, shape: &Shape, size: f64) -> Sample {
    let part = part(shape, size);
    let name = path.trim_end_matches(".stl");
    Sample {
        path,
        bytes: filled(|out| write_stl_ascii(out, name, part.positions(), &part.triangles)),
        patches: of_triangles(shape, &part),
    }
}

/// STL knows nothing but triangles: each has the patch of the polygon it was cut from.
fn of_triangles(shape: &Shape, part: &Mesh) -> Vec<u32> {
    let faces = part.face_of_triangle.iter();
    faces.map(|&face| shape.patches[face as usize]).collect()
}
