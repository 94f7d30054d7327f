//! Meshes to drop.

use seamline_mesh::shapes::{self, Shape};
use seamline_mesh::write::write_stl_binary;

/// A box of six squares, as OBJ.
pub fn cuboid(height: f64) -> String {
    let corners = (0..8).map(|i| {
        let z = f64::from(i >> 2) * height;
        format!("v {} {} {z}\n", i & 1, i >> 1 & 1)
    });
    let faces = [
        "1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6",
    ];
    corners
        .chain(faces.iter().map(|face| format!("f {face}\n")))
        .collect()
}

/// Boxes of different heights with their names, `part0.obj` and on.
pub fn cuboids(count: u32) -> impl Iterator<Item = (String, String)> {
    (0..count).map(|n| (format!("part{n}.obj"), cuboid(f64::from(n + 1))))
}

/// A torus of so many triangles, about; as binary STL.
pub fn torus(triangles: usize) -> Vec<u8> {
    let rows = (triangles as f64 / 4.0).sqrt() as usize;
    stl(&shapes::torus(10.0, 3.0, 2 * rows, rows))
}

/// A shape of triangles as binary STL.
///
/// # Panics
///
/// Never: memory refuses nothing.
pub fn stl(shape: &Shape) -> Vec<u8> {
    let polygons = shape.polygons();
    let triangles: Vec<[u32; 3]> = (0..polygons.face_count())
        .map(|face| {
            let corners = polygons.face(face);
            [corners[0], corners[1], corners[2]]
        })
        .collect();
    let mut bytes = Vec::new();
    write_stl_binary(&mut bytes, &polygons.positions, &triangles).unwrap();
    bytes
}
