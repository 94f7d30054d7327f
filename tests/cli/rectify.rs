//! `rectify`: boundaries that another tool has found.

use std::fs;

use seamline_mesh::write::write_obj;
use seamline_mesh::{Topology, shapes, weld};
use seamline_tests::same_partition;
use serde_json::Value;

use crate::home::Home;

/// A cube of unit side with one label a side; its faces are squares.
const CUBE: &str = "\
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
";
const SIDES: [&str; 6] = [
    "f 4 3 2 1\n",
    "f 5 6 7 8\n",
    "f 1 2 6 5\n",
    "f 2 3 7 6\n",
    "f 3 4 8 7\n",
    "f 4 1 5 8\n",
];

fn cube(before_each: impl Fn(usize) -> String) -> String {
    let sides = SIDES.iter().enumerate();
    let sides: String = sides.map(|(i, side)| before_each(i) + side).collect();
    CUBE.to_owned() + &sides
}

fn with_cube() -> Home {
    let home = Home::new();
    home.put("cube.obj", cube(|_| String::new()));
    home
}

fn labels(home: &Home, name: &str) -> String {
    let place = home.at(&format!("{name}.seamline/labels.seg"));
    let text = fs::read_to_string(place).expect("labels are there");
    text.lines().collect::<Vec<_>>().join(" ")
}

fn report(home: &Home) -> Value {
    let text = fs::read_to_string(home.at("cube.obj.seamline/report.json")).expect("a report");
    serde_json::from_str(&text).expect("JSON")
}

#[test]
fn hard_edges_of_a_cube_make_six_patches() {
    let home = with_cube();
    home.run("rectify cube.obj --sharp-deg 40").ended(0);
    assert_eq!(labels(&home, "cube.obj"), "0 1 2 3 4 5");
    let report = report(&home);
    assert_eq!(report["settings"]["hard-edges"]["strong_deg"], 40.0);
    assert_eq!(report["changes"]["edges"]["kept"], 12);
    assert!(report["input"].get("markings").is_none());
}

#[test]
fn labels_come_as_text_as_names_as_colours_and_as_a_selection() {
    let home = with_cube();
    home.put("six.seg", "9\n8\n7\n6\n5\n-4\n");
    home.run("rectify cube.obj --labels six.seg").ended(0);
    assert_eq!(labels(&home, "cube.obj"), "0 1 2 3 4 5");

    home.put("named.obj", cube(|i| format!("usemtl side{}\n", i / 2)));
    home.run("rectify named.obj --labels named.obj").ended(0);
    // Bottom and top have one name and do not touch: they are two patches.
    assert_eq!(labels(&home, "named.obj"), "0 1 2 2 3 3");
    home.run("rectify named.obj --labels named.obj --labels-by group")
        .ended(0);
    assert_eq!(labels(&home, "named.obj"), "0 0 0 0 0 0");

    home.run("rectify cube.obj --sharp-deg 40").ended(0);
    fs::copy(
        home.at("cube.obj.seamline/patches.ply"),
        home.at("patches.ply"),
    )
    .expect("the PLY of the results");
    for by in ["", " --labels-by colour"] {
        home.run(&format!("rectify cube.obj --labels patches.ply{by}"))
            .ended(0);
        assert_eq!(labels(&home, "cube.obj"), "0 1 2 3 4 5", "{by}");
    }

    home.put("cube.selection.txt", "\n1 3\n\n");
    home.run("rectify cube.obj --labels cube.selection.txt")
        .ended(0);
    assert_eq!(labels(&home, "cube.obj"), "0 1 0 1 0 0");
}

#[test]
fn edges_come_as_lines_of_an_obj_and_as_a_selection() {
    let home = with_cube();
    let lines = "l 1 2 3 4 1\nl 5 6 7 8 5\nl 1 5\nl 2 6\nl 3 7\nl 4 8\n";
    home.put("lines.obj", lines);
    home.put("with_lines.obj", cube(|_| String::new()) + lines);
    let pairs = "0 1 1 2 2 3 3 0 4 5 5 6 6 7 7 4 0 4 1 5 2 6 3 7";
    home.put("cube.selection.txt", format!("\n\n{pairs}\n"));
    for line in [
        "rectify cube.obj --edges lines.obj",
        "rectify cube.obj --edges with_lines.obj",
        "rectify cube.obj --edges cube.selection.txt",
    ] {
        home.run(line).ended(0);
        assert_eq!(labels(&home, "cube.obj"), "0 1 2 3 4 5", "{line}");
    }
    home.run("rectify with_lines.obj --edges with_lines.obj")
        .ended(0);
    assert_eq!(labels(&home, "with_lines.obj"), "0 1 2 3 4 5");
}

#[test]
fn what_does_not_fit_the_mesh_is_one_line_that_names_file_place_and_remedy() {
    let home = with_cube();
    home.put("many.seg", "1\n".repeat(12));
    home.put("odd.edges.txt", "0 1\n0 6\n");
    for (what, said) in [
        (
            "--labels many.seg",
            "error: many.seg: 12 labels for 6 faces; the mesh has 6 faces, which make 12 triangles",
        ),
        (
            "--edges odd.edges.txt",
            "error: odd.edges.txt: line 2: vertices 0 and 6 are not joined by an edge of the mesh; ",
        ),
        (
            "--edges no.txt",
            "error: no.txt: cannot be read: No such file or directory",
        ),
    ] {
        let ran = home.run(&format!("rectify cube.obj {what}")).ended(1);
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
        assert!(ran.err.starts_with(said), "{}", ran.err);
        assert!(!home.at("cube.obj.seamline").exists());
    }
}

#[test]
fn without_something_to_rectify_or_with_two_things_nothing_is_done() {
    let home = with_cube();
    home.run("rectify cube.obj").ended(2);
    home.run("rectify cube.obj --sharp-deg 40 --labels six.seg")
        .ended(2);
    for angles in ["0", "x", "40:180", "50:40"] {
        let ran = home
            .run(&format!("rectify cube.obj --sharp-deg {angles}"))
            .ended(2);
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
        let option = format!("--sharp-deg {angles}: ");
        assert!(ran.err.contains(&option), "{}", ran.err);
    }
    let ran = home.run("rectify cube.obj --sharp-deg 40:15").ended(2);
    assert!(ran.err.contains("as 15:40"), "{}", ran.err);
    assert!(!home.at("cube.obj.seamline").exists());
}

/// A square sheet of four by four, with a contour from its middle that goes to one border only.
fn sheet() -> String {
    let mut text = String::new();
    for i in 0..25 {
        text += &format!("v {} {} 0\n", i % 5, i / 5);
    }
    for i in (0..20).filter(|i| i % 5 < 4) {
        text += &format!("f {} {} {} {}\n", i + 1, i + 2, i + 7, i + 6);
    }
    text
}

#[test]
fn all_boundaries_of_a_smooth_cube_given_as_edges_come_back_as_its_26_patches() {
    // Flats four edges long and flats one edge long.
    for (flat_steps, edge_steps) in [(4, 6), (1, 6), (1, 4)] {
        let cube = shapes::smooth_cube(0.2, flat_steps, edge_steps);
        let mesh = weld(cube.polygons(), 0.0);
        let topology = Topology::build(mesh.positions().len(), mesh.triangles.clone());
        let patch = |triangle: u32| cube.patches[mesh.face_of_triangle[triangle as usize] as usize];
        let between = (0..topology.edge_faces.len()).filter(|&edge| {
            let faces = topology.face_pair(edge);
            faces.is_some_and(|[a, b]| patch(a) != patch(b))
        });
        let lines: Vec<String> = between
            .map(|edge| {
                let [a, b] = topology.edge_vertices[edge];
                format!("{a} {b}\n")
            })
            .collect();
        let mut obj = Vec::new();
        write_obj(&mut obj, &mesh.polygons).expect("memory takes every byte");
        let home = Home::new();
        home.put("smooth.obj", obj);
        home.put("smooth.edges.txt", lines.concat());
        for more in ["", " --set contour-tracking.dangling=keep"] {
            let ran = home
                .run(&format!(
                    "rectify smooth.obj --edges smooth.edges.txt{more}"
                ))
                .ended(0);
            assert!(ran.err.contains(": 26 patches of "), "{}", ran.err);
            assert!(!ran.err.contains("doubted"), "{}", ran.err);
            let found = home.labels("smooth.obj.seamline");
            assert!(same_partition(&found, &cube.patches));
        }
    }
}

#[test]
fn one_edge_across_a_flat_is_doubted_though_it_goes_from_rim_to_rim() {
    let home = Home::new();
    let triangles = SIDES.iter().flat_map(|side| {
        let corners: Vec<&str> = side[2..].split_whitespace().collect();
        let [a, b, c, d] = corners[..] else {
            panic!("a square")
        };
        [format!("f {a} {b} {c}\n"), format!("f {a} {c} {d}\n")]
    });
    home.put("cube.obj", CUBE.to_owned() + &triangles.collect::<String>());
    let rim = "0 1\n1 2\n2 3\n3 0\n4 5\n5 6\n6 7\n7 4\n0 4\n1 5\n2 6\n3 7\n";
    home.put("cube.edges.txt", rim.to_owned() + "3 1\n");
    let given = "rectify cube.obj --edges cube.edges.txt";
    let ran = home.run(given).ended(0);
    assert!(ran.err.contains(": 6 patches of "), "{}", ran.err);
    assert!(ran.err.contains("; 1 edge doubted: "), "{}", ran.err);
    let all = format!("{given} --set contour-tracking.doubt_given=false");
    let ran = home.run(&all).ended(0);
    assert!(ran.err.contains(": 7 patches of "), "{}", ran.err);
}

/// A sheet of ten by sixteen, folded by so many degrees along its middle, row upon row.
fn folded_sheet(degrees: f64) -> String {
    let mut text = String::new();
    let (sin, cos) = degrees.to_radians().sin_cos();
    for row in 0..17 {
        for x in -5..=5 {
            let beyond = f64::from(x.max(0));
            let along = f64::from(x.min(0)) + beyond * cos;
            text += &format!("v {along} {row} {}\n", beyond * sin);
        }
    }
    for i in (0..16 * 11).filter(|i| i % 11 < 10) {
        text += &format!("f {} {} {} {}\n", i + 1, i + 2, i + 13, i + 12);
    }
    text
}

/// The edges of the fold from one row to another.
fn along_the_fold(rows: std::ops::Range<usize>) -> String {
    rows.map(|row| format!("{} {}\n", row * 11 + 5, row * 11 + 16))
        .collect()
}

#[test]
fn a_crease_that_turns_less_than_a_sharp_edge_stays() {
    let home = Home::new();
    home.put("fold.obj", folded_sheet(39.0));
    for rows in [0..16, 2..14] {
        home.put("fold.edges.txt", along_the_fold(rows.clone()));
        let ran = home.run("rectify fold.obj --edges fold.edges.txt").ended(0);
        assert!(ran.err.contains(": 2 patches of "), "{}", ran.err);
        let added = 16 - rows.len();
        let kept = format!("edges: {} kept, {added} added, 0 removed", rows.len());
        assert!(ran.err.contains(&kept), "{}", ran.err);
    }
}

#[test]
fn a_line_in_a_flat_is_taken_where_it_parts_something_and_doubted_aloud_where_it_ends() {
    let home = Home::new();
    home.put("flat.obj", folded_sheet(0.0));
    home.put("whole.edges.txt", along_the_fold(0..16));
    let ran = home
        .run("rectify flat.obj --edges whole.edges.txt")
        .ended(0);
    assert!(ran.err.contains(": 2 patches of "), "{}", ran.err);

    home.put("part.edges.txt", along_the_fold(5..9));
    let ran = home.run("rectify flat.obj --edges part.edges.txt").ended(0);
    let said = "; 4 edges doubted: contour-tracking.doubt_given=false takes them all";
    assert!(ran.err.contains(said), "{}", ran.err);
    let edges = &home.json("flat.obj.seamline/report.json")["changes"]["edges"];
    assert_eq!(
        (&edges["removed"], &edges["doubted"]),
        (&4.into(), &4.into())
    );

    let ran = home
        .run("rectify flat.obj --edges part.edges.txt --set contour-tracking.dangling=keep")
        .ended(0);
    assert!(ran.err.contains("4 edges inside a patch"), "{}", ran.err);
    assert!(!ran.err.contains("doubted"), "{}", ran.err);
}

#[test]
fn without_any_weight_on_votes_what_only_sharp_edges_bound_keeps_its_label() {
    let home = Home::new();
    home.put("fold.obj", folded_sheet(90.0));
    // One face in the middle of the left half bears the label of the right one.
    let label = |i: usize| u32::from(i % 10 >= 5 || i == 72);
    let lines: Vec<String> = (0..160).map(|i| format!("{}\n", label(i))).collect();
    home.put("fold.seg", lines.concat());
    let ran = home
        .run("rectify fold.obj --labels fold.seg --set contour-tracking.vote_weight=0")
        .ended(0);
    assert!(ran.err.contains(": 2 patches of "), "{}", ran.err);
}

#[test]
fn what_contradicts_itself_or_has_no_effect_is_wrong_use() {
    let home = with_cube();
    home.put("six.seg", "9\n8\n7\n6\n5\n-4\n");
    for (line, said) in [
        (
            "rectify cube.obj --labels six.seg --labels-by group",
            "--labels-by group: in six.seg there is nothing to choose from; ",
        ),
        (
            "rectify cube.obj --sharp-deg 40 --labels-by group",
            "--labels",
        ),
        (
            "rectify cube.obj --sharp-deg 40 --classifier kmeans",
            "--classifier kmeans: ",
        ),
        (
            "rectify cube.obj --sharp-deg 40 --set hard-edges.weak_deg=20",
            "--set hard-edges.weak_deg=20: ",
        ),
        (
            "rectify cube.obj --labels six.seg --rectifier graph-cut --set contour-tracking.dangling=keep",
            "--set contour-tracking.dangling=keep: has no effect with --rectifier graph-cut; ",
        ),
        (
            "plugins check --stage rectify kmeans",
            "--stage rectify: kmeans fills classify; ",
        ),
        (
            "plugins check --stage nothing kmeans",
            "--stage nothing: is none; ",
        ),
    ] {
        let ran = home.run(line).ended(2);
        assert!(ran.err.contains(said), "{line}: {}", ran.err);
    }
    assert!(!home.at("cube.obj.seamline").exists());
}

#[test]
fn one_edge_given_of_a_box_is_closed_into_a_loop_and_nothing_is_left() {
    let home = with_cube();
    home.put("one.edges.txt", "0 1\n");
    let ran = home.run("rectify cube.obj --edges one.edges.txt").ended(0);
    assert!(ran.err.contains("open ends: 2 closed\n"), "{}", ran.err);
    assert_eq!(report(&home)["changes"]["after"]["open_ends"], 0);
    let patches = labels(&home, "cube.obj");
    assert!(patches.contains('1'), "{patches}");
}

#[test]
fn an_edge_that_is_missing_among_those_given_is_added_and_told() {
    let home = Home::new();
    home.put("sheet.obj", sheet());
    home.put(
        "seam.edges.txt",
        "2 7\n7 12 # the next is missing\n\n22 17\n",
    );
    home.run("rectify sheet.obj --edges seam.edges.txt --set contour-tracking.doubt_given=false")
        .ended(0);
    assert_eq!(
        labels(&home, "sheet.obj"),
        "0 0 1 1 0 0 1 1 0 0 1 1 0 0 1 1"
    );
    let text = fs::read_to_string(home.at("sheet.obj.seamline/report.json")).unwrap();
    let report: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(report["changes"]["edges"]["given"], 3);
    assert_eq!(report["changes"]["edges"]["added"], 1);
    // The seam goes from border to border.
    assert_eq!(report["changes"]["before"]["open_ends"], 2);
    assert_eq!(report["changes"]["after"]["open_ends"], 0);
    assert_eq!(report["input"]["markings"]["what"], "edges");
    let curves = fs::read_to_string(home.at("sheet.obj.seamline/boundaries.obj")).unwrap();
    let groups: Vec<&str> = curves
        .lines()
        .filter(|line| line.starts_with('g'))
        .collect();
    assert_eq!(groups, ["g patch_0_patch_1 old", "g patch_0_patch_1 new"]);
}

#[test]
fn a_gap_is_closed_or_left_open_as_is_asked_for() {
    let home = Home::new();
    home.put("sheet.obj", sheet());
    home.put("half.edges.txt", "2 7\n7 12\n");
    let run = |settings: &str| {
        let line =
            "rectify sheet.obj --edges half.edges.txt --set contour-tracking.doubt_given=false";
        let ran = home.run(&format!("{line}{settings}")).ended(0);
        let text = fs::read_to_string(home.at("sheet.obj.seamline/report.json")).unwrap();
        let changes = serde_json::from_str::<Value>(&text).unwrap()["changes"].clone();
        let of = |key: &str| changes["edges"][key].as_u64().unwrap();
        let left = changes["open_ends_left"].as_u64().unwrap();
        (of("added"), of("removed"), of("creases"), left, ran.err)
    };
    let (added, removed, creases, left, _) = run("");
    assert_eq!((added, removed, creases, left), (2, 0, 0, 0));
    let (added, removed, creases, left, _) = run(" --set contour-tracking.open_ends=bridge");
    assert_eq!((added, removed, creases, left), (2, 0, 0, 0));
    for limits in [
        " --set contour-tracking.open_ends=leave",
        " --set contour-tracking.max_gap_share=0.3",
        " --set contour-tracking.open_ends=bridge --set contour-tracking.max_gap_share=0.3",
    ] {
        let (added, removed, creases, left, _) = run(limits);
        assert_eq!((added, removed, creases, left), (0, 2, 0, 1), "{limits}");
        let keep = format!("{limits} --set contour-tracking.dangling=keep");
        let (added, removed, creases, left, said) = run(&keep);
        assert_eq!((added, removed, creases, left), (0, 0, 2, 1), "{limits}");
        assert!(said.contains("2 edges inside a patch"), "{said}");
    }
}

#[test]
fn edges_given_on_a_border_are_told_and_change_nothing() {
    let home = Home::new();
    home.put("sheet.obj", sheet());
    let seam = "2 7\n7 12\n12 17\n17 22\n";
    home.put("seam.edges.txt", seam);
    home.put("more.edges.txt", seam.to_owned() + "0 1\n1 2\n");
    home.run("rectify sheet.obj --edges seam.edges.txt")
        .ended(0);
    let without = labels(&home, "sheet.obj");
    let ran = home
        .run("rectify sheet.obj --edges more.edges.txt")
        .ended(0);
    let said = "2 edges given on borders, which are boundaries anyway";
    assert!(ran.err.contains(said), "{}", ran.err);
    assert_eq!(labels(&home, "sheet.obj"), without);
    let edges = &home.json("sheet.obj.seamline/report.json")["changes"]["edges"];
    assert_eq!(
        (&edges["given"], &edges["at_borders"]),
        (&4.into(), &2.into())
    );
}

#[test]
fn the_one_fraction_a_face_of_a_ply_has_is_its_label_if_it_is_whole() {
    let home = with_cube();
    let ply = |scale: f64| {
        let head = "ply\nformat ascii 1.0\nelement face 6\nproperty float scalar\nend_header\n";
        let lines = (0..6).map(|face| format!("{}\n", f64::from(face / 2) * scale));
        head.to_owned() + &lines.collect::<String>()
    };
    home.put("whole.ply", ply(1.0));
    home.run("rectify cube.obj --labels whole.ply").ended(0);
    // Bottom and top do not touch and are two patches.
    assert_eq!(labels(&home, "cube.obj"), "0 1 2 2 3 3");
    home.put("half.ply", ply(0.5));
    let ran = home.run("rectify cube.obj --labels half.ply").ended(1);
    assert!(ran.err.contains("0.5 is no label"), "{}", ran.err);
}

#[test]
fn refined_boundaries_tell_what_was_given_from_what_is_new() {
    let home = Home::new();
    home.put("flat.obj", folded_sheet(0.0));
    // Stairs one square deep across a flat sheet of ten by sixteen squares.
    let label = |i: usize| u32::from(i % 10 >= 4 + i / 10 % 2);
    let lines: Vec<String> = (0..160).map(|i| format!("{}\n", label(i))).collect();
    home.put("stairs.seg", lines.concat());
    let keep = "--set contour-tracking.rough_above_deg=180";
    let ran = home
        .run(&format!(
            "rectify flat.obj --labels stairs.seg --refine {keep}"
        ))
        .ended(0);
    let report = home.json("flat.obj.seamline/report.json");
    let added = report["refined"]["vertices_added"].as_u64();
    assert!(added.is_some_and(|added| added > 0), "{added:?}");
    let said = format!("  refined: {} vertices added\n", added.unwrap_or(0));
    assert!(ran.err.contains(&said), "{}", ran.err);
    let curves = fs::read_to_string(home.at("flat.obj.seamline/boundaries.obj")).unwrap();
    let groups: Vec<&str> = curves
        .lines()
        .filter(|line| line.starts_with('g'))
        .collect();
    assert!(groups.contains(&"g patch_0_patch_1 new"), "{groups:?}");
    assert!(
        groups.iter().all(|group| group.ends_with(" old")
            || group.ends_with(" new")
            || ["g removed", "g crease"].contains(group)),
        "{groups:?}"
    );
}
