//! Awkward and broken files, up to welding: each is read or refused as the README beside them says.

use std::path::{Path, PathBuf};

use seamline_mesh::{Findings, Format, Mesh, ReadError, Topology, examine, read, weld};

/// The folder of bad files, if it is there.
fn folder() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/bench/bad");
    if !folder.is_dir() {
        eprintln!("SKIPPED: no folder {}", folder.display());
        return None;
    }
    Some(folder)
}

fn load(path: &Path) -> Result<(Mesh, Findings), ReadError> {
    let mesh = weld(read(path)?, 0.0);
    let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
    let findings = examine(&mesh, &topology);
    Ok((mesh, findings))
}

/// Runs `check` on one file, if the folder is there.
fn with(name: &str, check: impl FnOnce(Result<(Mesh, Findings), ReadError>)) {
    if let Some(folder) = folder() {
        check(load(&folder.join(name)));
    }
}

fn found(name: &str, check: impl FnOnce(&Findings)) {
    with(name, |loaded| check(&loaded.unwrap().1));
}

fn refused(name: &str, message: &str) {
    with(name, |loaded| {
        let error = loaded.unwrap_err();
        assert_eq!(error.to_string(), message);
        assert!(!error.hint().is_empty());
    });
}

/// The table of the README: file and what is expected.
fn expectations(folder: &Path) -> Vec<(String, String)> {
    let text = std::fs::read_to_string(folder.join("README.md")).unwrap();
    let rows = text.lines().filter_map(|line| {
        let cells: Vec<&str> = line.trim_matches('|').split('|').map(str::trim).collect();
        match cells[..] {
            [file, .., expected] if file.contains('.') => {
                Some((file.to_owned(), expected.to_owned()))
            }
            _ => None,
        }
    });
    rows.collect()
}

#[test]
fn every_file_is_read_or_refused_as_its_readme_says() {
    let Some(folder) = folder() else { return };
    let expectations = expectations(&folder);
    assert!(expectations.len() >= 27, "the README has a table");
    for (file, expected) in expectations {
        let loaded = load(&folder.join(&file));
        match (expected.as_str(), loaded) {
            ("process", Err(error)) => panic!("{file}: {error}"),
            ("refuse", Ok(_)) => panic!("{file} was read"),
            (_, Ok((mesh, findings))) => {
                assert!(!mesh.triangles.is_empty(), "{file}");
                assert!(!findings.lines().is_empty());
            }
            (_, Err(error)) => {
                assert!(!error.to_string().contains('\n'), "{file}: {error}");
                assert!(!error.to_string().contains(&file), "{file}: {error}");
            }
        }
    }
}

#[test]
fn refusals_say_where_and_why() {
    refused("empty.stl", "the file is empty (0 bytes)");
    refused(
        "truncated_binary.stl",
        "binary STL ends inside triangle 8 of 60 (454 bytes, 3084 needed): the copy is incomplete",
    );
    refused(
        "ascii_nan.stl",
        "line 20: coordinate `nan` is not a finite number",
    );
    refused(
        "count_huge.stl",
        "binary STL ends inside triangle 61 of 4294967295 (3084 bytes, 214748364834 needed): the copy is incomplete",
    );
    refused(
        "index_out_of_range.obj",
        "line 21: the face names vertex 99, but the file has 8 (counted from 1)",
    );
    refused(
        "text.stl",
        "not an STL: text that begins with `Dear all,`, not with `solid`",
    );
    with("declared_8_million.ply", |loaded| {
        let error = loaded.unwrap_err();
        assert!(error.is_truncated());
        assert!(
            error
                .to_string()
                .starts_with("PLY header declares 8000000 x vertex, 16000000 x face"),
            "{error}"
        );
        assert!(error.to_string().contains("24 bytes follow"), "{error}");
    });
}

#[test]
fn only_incomplete_copies_count_as_truncated() {
    let truncated = [
        "empty.stl",
        "truncated_binary.stl",
        "count_huge.stl",
        "declared_8_million.ply",
    ];
    for name in truncated {
        with(name, |loaded| {
            assert!(loaded.unwrap_err().is_truncated(), "{name}")
        });
    }
    for name in ["ascii_nan.stl", "index_out_of_range.obj", "text.stl"] {
        with(name, |loaded| {
            assert!(!loaded.unwrap_err().is_truncated(), "{name}")
        });
    }
}

#[test]
fn a_binary_stl_that_says_solid_is_binary() {
    with("binary_says_solid.stl", |loaded| {
        let (mesh, findings) = loaded.unwrap();
        assert_eq!(mesh.polygons.format, Format::StlBinary);
        assert_eq!(
            (
                findings.triangles,
                findings.distinct_vertices,
                findings.closed
            ),
            (60, 32, true)
        );
    });
}

#[test]
fn other_encodings_and_line_ends_do_not_change_the_mesh() {
    for (name, faces) in [
        ("utf16.obj", 12),
        ("windows_1252_names.obj", 12),
        ("crlf.obj", 60),
        ("negative_indices.obj", 12),
    ] {
        found(name, |f| {
            assert_eq!(
                (f.input_faces, f.closed, f.euler_characteristic),
                (faces, true, 2),
                "{name}"
            )
        });
    }
    for (name, format) in [
        ("unknown_properties.ply", Format::PlyAscii),
        ("big_endian.ply", Format::PlyBigEndian),
    ] {
        with(name, |loaded| {
            let (mesh, findings) = loaded.unwrap();
            assert_eq!(mesh.polygons.format, format);
            assert!(
                findings.closed && findings.volume.is_some_and(|v| v > 0.0),
                "{name}"
            );
        });
    }
}

#[test]
fn quads_and_sixteen_gons_become_sixty_triangles_of_eighteen_faces() {
    with("quads_ngons.obj", |loaded| {
        let (mesh, findings) = loaded.unwrap();
        assert_eq!(
            (
                findings.input_faces,
                findings.larger_polygons,
                findings.triangles
            ),
            (18, 18, 60)
        );
        assert!(findings.closed && findings.oriented);
        assert_eq!(mesh.face_of_triangle.last(), Some(&17));
    });
}

#[test]
fn degenerate_faces_are_counted_and_keep_their_lines() {
    found("degenerate.obj", |f| {
        assert_eq!(
            (
                f.input_faces,
                f.faces_without_triangle,
                f.zero_area_triangles
            ),
            (f.triangles + 3, 3, 1)
        );
    });
}

#[test]
fn each_defect_is_found() {
    found("duplicate_triangles.obj", |f| {
        assert_eq!(f.duplicate_faces, 15)
    });
    found("nonmanifold_edge.obj", |f| {
        assert_eq!(
            (f.non_manifold_edges, f.border_edges, f.closed),
            (1, 2, false)
        )
    });
    found("flipped.stl", |f| {
        assert!(f.closed && !f.oriented && f.flipped_edges > 0 && f.volume.is_none())
    });
    found("isolated_vertices.obj", |f| {
        assert_eq!((f.isolated_vertices, f.closed), (2, true))
    });
    found("bowtie.obj", |f| {
        assert_eq!((f.non_manifold_vertices, f.parts, f.closed), (1, 2, true))
    });
    found("disconnected.stl", |f| {
        assert_eq!((f.parts, f.closed, f.euler_characteristic), (2, true, 4))
    });
    found("open_surface.obj", |f| {
        assert_eq!((f.border_loops, f.border_edges, f.closed), (2, 32, false))
    });
    found("mobius.obj", |f| {
        assert!(f.border_loops == 1 && f.flipped_edges > 0 && f.euler_characteristic == 0)
    });
    found("one_triangle.stl", |f| {
        assert_eq!((f.triangles, f.border_edges, f.border_loops), (1, 3, 1))
    });
}

#[test]
fn size_does_not_matter() {
    for name in ["tiny_scale.stl", "huge_scale.stl"] {
        found(name, |f| {
            assert_eq!(
                (f.triangles, f.zero_area_triangles, f.closed, f.oriented),
                (60, 0, true, true),
                "{name}"
            );
            assert!(f.area > 0.0 && f.volume.is_some_and(|v| v > 0.0));
        });
    }
}
