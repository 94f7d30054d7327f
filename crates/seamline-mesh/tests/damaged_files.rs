//! Valid files, cut short and with bits turned: the readers refuse or read them, and never panic.

use std::path::Path;

use glam::DVec3;
use proptest::prelude::*;
use seamline_mesh::write::{
    VertexQuantities, write_obj, write_ply, write_stl_ascii, write_stl_binary,
};
use seamline_mesh::{Format, PolygonMesh, Topology, examine, read_bytes, weld};

/// A box of quads and triangles.
fn sample() -> PolygonMesh {
    PolygonMesh {
        format: Format::Memory,
        positions: (0..8u8)
            .map(|i| DVec3::from([i & 1, i >> 1 & 1, i >> 2].map(f64::from)))
            .collect(),
        starts: vec![0, 4, 8, 12, 16, 20, 23, 26],
        corners: vec![
            0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 1, 7, 5,
        ],
    }
}

/// The sample in every format, with the name it could have.
fn files() -> Vec<(&'static str, Vec<u8>)> {
    let mesh = sample();
    let triangles = weld(mesh.clone(), 0.0).triangles;
    let n = mesh.positions.len();
    let (k, d) = (vec![0.0; n], vec![[0.0; 3]; n]);
    let quantities = VertexQuantities {
        k_min: &k,
        k_max: &k,
        d_min: &d,
        d_max: &d,
    };
    let mut files = vec![
        ("a.stl", Vec::new()),
        ("b.stl", Vec::new()),
        ("c.obj", Vec::new()),
        ("d.ply", Vec::new()),
    ];
    write_stl_binary(&mut files[0].1, &mesh.positions, &triangles).unwrap();
    write_stl_ascii(&mut files[1].1, "sample", &mesh.positions, &triangles).unwrap();
    write_obj(&mut files[2].1, &mesh).unwrap();
    write_ply(&mut files[3].1, &mesh, quantities, &[0; 7], None).unwrap();
    let mut text = "ply\r\nformat ascii 1.0\r\nelement face 7\r\nproperty list int uint vertex_index\r\n\
                    property list char short extra\r\nelement vertex 8\r\nproperty double x\r\nproperty float y\r\n\
                    property uchar z\r\nelement other 1\r\nproperty list uchar double w\r\nend_header\r\n"
        .to_owned();
    for face in 0..mesh.face_count() {
        let corners: Vec<String> = mesh.face(face).iter().map(u32::to_string).collect();
        text += &format!("{} {} 1 -7\r\n", corners.len(), corners.join(" "));
    }
    for p in &mesh.positions {
        text += &format!("{} {} {}\r\n", p.x, p.y, p.z);
    }
    files.push(("e.ply", (text + "2 0.5 1e3\r\n").into_bytes()));
    let utf16 = std::iter::once(0xFEFF).chain(
        String::from_utf8_lossy(&files[2].1)
            .encode_utf16()
            .collect::<Vec<_>>(),
    );
    files.push(("f.obj", utf16.flat_map(u16::to_be_bytes).collect()));
    files
}

/// Whatever is read keeps the promises of a mesh, and can be worked with.
fn try_to_read(bytes: &[u8], name: &str) {
    let mesh = match read_bytes(bytes, Path::new(name)) {
        Ok(mesh) => mesh,
        Err(error) => {
            let text = error.to_string();
            assert!(!text.contains('\n') && text.len() < 400, "{text}");
            return;
        }
    };
    assert!(mesh.positions.iter().all(|p| p.is_finite()));
    assert!(
        mesh.corners
            .iter()
            .all(|&v| (v as usize) < mesh.positions.len())
    );
    assert!(mesh.face_count() > 0 && (0..mesh.face_count()).all(|face| mesh.face(face).len() >= 3));
    assert_eq!(mesh.starts.last().copied(), Some(mesh.corners.len() as u32));
    let mesh = weld(mesh, 0.0);
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    assert_eq!(
        examine(&mesh, &topology).input_faces,
        mesh.polygons.face_count()
    );
}

#[test]
fn every_format_reads_back() {
    for (name, bytes) in files() {
        let mesh =
            read_bytes(&bytes, Path::new(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
        let welded = weld(mesh, 0.0);
        assert_eq!(welded.triangles.len(), 12, "{name}");
        assert_eq!(welded.positions().len(), 8, "{name}");
    }
}

#[test]
fn every_shorter_file_is_refused_or_read_but_nothing_worse() {
    for (name, bytes) in files() {
        for end in 0..bytes.len() {
            try_to_read(&bytes[..end], name);
        }
    }
}

#[test]
fn shorter_binary_files_are_seen_to_be_incomplete() {
    for (name, bytes) in files()
        .into_iter()
        .filter(|(name, _)| ["a.stl", "d.ply"].contains(name))
    {
        for end in 90..bytes.len() {
            assert!(
                read_bytes(&bytes[..end], Path::new(name))
                    .unwrap_err()
                    .is_truncated(),
                "{name} at {end}"
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    #[test]
    fn turned_bits_are_refused_or_read_but_nothing_worse(
        which in 0usize..6,
        flips in prop::collection::vec((any::<prop::sample::Index>(), 0u8..8), 1..6),
        end in any::<prop::sample::Index>(),
        cut in prop::bool::weighted(0.2),
        other_name in prop::option::weighted(0.2, prop::sample::select(vec!["x.stl", "x.obj", "x.ply", "x"])),
    ) {
        let (name, mut bytes) = files().swap_remove(which);
        for (place, bit) in flips {
            let place = place.index(bytes.len());
            bytes[place] ^= 1 << bit;
        }
        if cut {
            bytes.truncate(end.index(bytes.len()));
        }
        try_to_read(&bytes, other_name.unwrap_or(name));
    }

    #[test]
    fn any_bytes_at_all_are_refused_or_read_but_nothing_worse(
        bytes in prop::collection::vec(any::<u8>(), 0..300),
        start in prop::sample::select(vec![&b""[..], b"ply\n", b"ply\r\nformat ascii 1.0\r\n", b"solid ", b"v 0 0 0\nf ", b"\xFF\xFE"]),
        name in prop::sample::select(vec!["x.stl", "x.obj", "x.ply", "x"]),
    ) {
        try_to_read(&[start, &bytes].concat(), name);
    }
}
