use std::path::Path;

use seamline_mesh::{read_bytes, weld};

use super::*;

/// A bumpy grid of `side` by `side` squares, as vertices and as faces.
fn grid(side: u32) -> (Vec<[f32; 3]>, Vec<[u32; 4]>) {
    let across = side + 1;
    let vertices = (0..across * across).map(|v| {
        let [x, y] = [v % across, v / across].map(|i| i as f32 / 7.0);
        [x, y, (x * 3.0).sin() * y.cos()]
    });
    let corner = |face: u32| face / side * across + face % side;
    let faces = (0..side * side).map(corner);
    let faces = faces.map(|v| [v, v + 1, v + across + 1, v + across]);
    (vertices.collect(), faces.collect())
}

fn triangles(faces: &[[u32; 4]]) -> Vec<[u32; 3]> {
    faces
        .iter()
        .flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]])
        .collect()
}

fn stl_binary(side: u32) -> Vec<u8> {
    let (vertices, faces) = grid(side);
    let triangles = triangles(&faces);
    let mut bytes = vec![b' '; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        for v in triangle {
            bytes.extend(vertices[v as usize].iter().flat_map(|x| x.to_le_bytes()));
        }
        bytes.extend([0; 2]);
    }
    bytes
}

fn stl_text(side: u32, indent: &str) -> Vec<u8> {
    let (vertices, faces) = grid(side);
    let mut text = "solid part\n".to_owned();
    for triangle in triangles(&faces) {
        text += &format!("{indent}facet normal 0 0 1\n{indent}outer loop\n");
        for [x, y, z] in triangle.map(|v| vertices[v as usize]) {
            text += &format!("{indent}vertex {x:e} {y:e} {z:e}\n");
        }
        text += &format!("{indent}endloop\n{indent}endfacet\n");
    }
    (text + "endsolid part\n").into_bytes()
}

fn obj(side: u32, quads: bool) -> Vec<u8> {
    let (vertices, faces) = grid(side);
    let mut text: String = vertices
        .iter()
        .map(|[x, y, z]| format!("v {x} {y} {z}\n"))
        .collect();
    if quads {
        text.extend(
            faces
                .iter()
                .map(|f| format!("f {} {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1, f[3] + 1)),
        );
    } else {
        text.extend(
            triangles(&faces)
                .iter()
                .map(|f| format!("f {} {} {}\n", f[0] + 1, f[1] + 1, f[2] + 1)),
        );
    }
    text.into_bytes()
}

fn ply(side: u32, quads: bool) -> Vec<u8> {
    let (vertices, faces) = grid(side);
    let rows: Vec<String> = if quads {
        faces
            .iter()
            .map(|f| format!("4 {} {} {} {}\n", f[0], f[1], f[2], f[3]))
            .collect()
    } else {
        triangles(&faces)
            .iter()
            .map(|f| format!("3 {} {} {}\n", f[0], f[1], f[2]))
            .collect()
    };
    let header = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        vertices.len(),
        rows.len()
    );
    let points = vertices.iter().map(|[x, y, z]| format!("{x} {y} {z}\n"));
    (header + &points.collect::<String>() + &rows.concat()).into_bytes()
}

#[test]
fn what_a_file_is_found_to_need_lies_between_the_least_and_what_was_likely() {
    let files = [
        ("binary.stl", stl_binary(150)),
        ("text.stl", stl_text(150, "")),
        ("indented.stl", stl_text(150, "      ")),
        ("triangles.obj", obj(150, false)),
        ("quads.obj", obj(150, true)),
        ("triangles.ply", ply(150, false)),
        ("quads.ply", ply(150, true)),
    ];
    for (name, bytes) in files {
        let mesh = weld(read_bytes(&bytes, Path::new(name)).unwrap(), 0.0);
        let size = [mesh.triangles.len(), mesh.positions().len()].map(|count| count as u64);
        assert_eq!(size[0], 45_000);
        for enriched in [false, true] {
            let needed = bytes_for_mesh(size[0], size[1], enriched);
            let start = &bytes[..bytes.len().min(START_BYTES)];
            let Estimate { bytes, least_bytes } = estimate(bytes.len() as u64, start, enriched);
            // The grid is open: it has some more vertices than half its triangles.
            let slack = needed / 50;
            assert!(
                bytes + slack >= needed && bytes <= 2 * needed,
                "{name}: {bytes} for {needed}"
            );
            assert!(
                least_bytes <= needed + slack,
                "{name}: {least_bytes} for {needed}"
            );
        }
    }
}

#[test]
fn a_claim_beyond_the_bytes_is_not_believed() {
    let mut bytes = stl_binary(20);
    bytes[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
    let length = bytes.len() as u64;
    assert_eq!(sizes(length, &bytes), [Size::of_triangles(800); 2]);
    let header = b"ply\nformat ascii 1.0\nelement vertex 99999999999\nelement face 99999999999\nend_header\n";
    assert!(estimate(3000, header, false).bytes < 10 << 20);
}

#[test]
fn a_long_file_takes_its_length_at_least_whatever_it_holds() {
    for start in [
        &b""[..],
        b"ply",
        b"ply\nend_header\n",
        b"solid",
        b"\0\0\0",
        b"# words\n",
    ] {
        for length in [0, 1, 83, 84, 1 << 20, u64::MAX] {
            let Estimate { bytes, least_bytes } = estimate(length, start, true);
            assert!(
                length <= least_bytes && least_bytes <= bytes,
                "{start:?} {length}"
            );
        }
    }
}

#[test]
fn the_constants_cover_what_was_measured() {
    // Triangles, vertices, enriched, kilobytes at the peak.
    let measured = [
        (1_731_968, 865_968, false, 1_501_808),
        (432_992, 1_298_976, false, 1_113_280),
        (432_992, 216_480, false, 510_080),
        (431_244, 287_496, false, 540_004),
        (1_731_968, 865_968, true, 1_629_600),
        (432_992, 1_298_976, true, 1_837_184),
        (432_992, 216_480, true, 952_844),
        (431_244, 287_496, true, 1_268_444),
    ];
    for (triangles, vertices, enriched, kilobytes) in measured {
        let peak = kilobytes * 1024 - 12_000_000;
        let needed = bytes_for_mesh(triangles, vertices, enriched);
        assert!(needed >= peak, "{needed} for {peak}");
        assert!(bytes_kept(triangles, vertices, enriched) < needed);
    }
}
