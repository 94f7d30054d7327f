//! The folder of results, file by file.

use std::collections::BTreeSet;

use seamline_tests::daemon::without_seconds;
use seamline_tests::same_partition;
use serde_json::Value;

use crate::home::Home;

const RESULTS: &str = "out/shaft.stl.seamline";

fn cut_shaft() -> (Home, seamline_tests::samples::Sample) {
    let home = Home::new();
    let shaft = home.put_sample("shaft.stl");
    home.run("segment shaft.stl -o out").ended(0);
    (home, shaft)
}

#[test]
fn a_mesh_gives_one_folder_with_four_files_and_nothing_beside_it() {
    let (home, _) = cut_shaft();
    assert_eq!(home.listed("out"), ["shaft.stl.seamline"]);
    assert_eq!(
        home.listed(RESULTS),
        ["boundaries.obj", "labels.seg", "patches.ply", "report.json"]
    );
}

#[test]
fn results_lie_in_the_present_folder_unless_told_otherwise() {
    let home = Home::new();
    home.put_sample("turned/cone.obj");
    home.run("segment turned/cone.obj").ended(0);
    assert_eq!(home.listed("."), ["cone.obj.seamline", "turned"]);
}

#[test]
fn labels_are_one_a_face_from_0_and_numbered_by_first_face() {
    let (home, shaft) = cut_shaft();
    let labels = home.labels(RESULTS);
    assert!(same_partition(&labels, &shaft.patches));
    let mut next = 0;
    for (face, &label) in labels.iter().enumerate() {
        assert!(label <= next, "face {face} has label {label} before {next}");
        next = next.max(label + 1);
    }
}

#[test]
fn a_polygon_has_one_label() {
    let home = Home::new();
    let cylinder = home.put_sample("cylinder.obj");
    home.run("segment cylinder.obj").ended(0);
    let labels = home.labels("cylinder.obj.seamline");
    assert_eq!(labels.len(), 66, "64 quads and two lids");
    assert!(same_partition(&labels, &cylinder.patches));
    let report = home.json("cylinder.obj.seamline/report.json");
    assert_eq!(report["input"]["faces"], 66);
    assert_eq!(report["input"]["triangles"], 64 * 2 + 2 * 30);
}

#[test]
fn a_face_without_area_has_the_patch_of_a_neighbour() {
    // A box, its top cut along a needle between two corners and a point halfway; and two faces with a
    // repeated corner, on the bottom and on the side.
    let home = Home::new();
    let box_with_needle = "\
        v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nv 0.5 0.5 1\n\
        f 1 4 3 2\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n\
        f 5 6 7\nf 5 7 9\nf 5 9 8\nf 9 7 8\n\
        f 1 1 3\nf 4 4 4\n";
    home.put("needle.obj", box_with_needle);
    home.run("segment needle.obj").ended(0);
    let labels = home.labels("needle.obj.seamline");
    assert_eq!(labels[..9], [0, 1, 2, 3, 4, 5, 5, 5, 5]);
    assert_eq!(labels[9], 0, "along the bottom's diagonal");
    assert!(
        [0, 3, 4].contains(&labels[10]),
        "at a corner of three sides"
    );
    let report = home.json("needle.obj.seamline/report.json");
    assert_eq!(report["patches"].as_array().map(Vec::len), Some(6));
}

#[test]
fn patches_ply_names_patch_colour_and_curvature() {
    let (home, shaft) = cut_shaft();
    let text = home.text(&format!("{RESULTS}/patches.ply"));
    let (header, _) = text.split_once("end_header\n").expect("a header");
    assert!(header.starts_with("ply\nformat "), "{header}");
    let (vertex, face) = header.split_once("element face ").expect("faces");
    let (count, face) = face.split_once('\n').expect("their number");
    assert_eq!(count, shaft.patches.len().to_string());
    for property in ["int patch", "uchar red", "uchar green", "uchar blue"] {
        assert!(face.contains(&format!("property {property}\n")), "{face}");
    }
    for property in ["k_min", "k_max", "d_min_x", "d_max_z"] {
        assert!(
            vertex.contains(&format!("property float {property}\n")),
            "{vertex}"
        );
    }
}

#[test]
fn patches_ply_can_be_cut_again_and_gives_the_same_patches() {
    let (home, _) = cut_shaft();
    home.run(&format!("segment {RESULTS}/patches.ply")).ended(0);
    assert_eq!(home.labels("patches.ply.seamline"), home.labels(RESULTS));
}

#[test]
fn boundaries_obj_has_one_group_a_pair_of_patches_that_touch() {
    let (home, _) = cut_shaft();
    let text = home.text(&format!("{RESULTS}/boundaries.obj"));
    let lines_of = |start: &'static str| {
        text.lines()
            .filter_map(move |line| line.strip_prefix(start))
    };
    let groups: Vec<_> = lines_of("g ").collect();
    let report = home.json(&format!("{RESULTS}/report.json"));
    let boundaries = report["boundaries"].as_array().expect("boundaries");
    let named = |boundary: &Value| {
        format!(
            "patch_{}_patch_{}",
            boundary["patches"][0], boundary["patches"][1]
        )
    };
    assert_eq!(groups, boundaries.iter().map(named).collect::<Vec<_>>());
    assert_eq!(
        groups.len(),
        7,
        "one between each two neighbours along the shaft"
    );

    let vertices = lines_of("v ").count();
    assert_eq!(lines_of("l ").count(), 7, "each a circle");
    for circle in lines_of("l ") {
        let corners: Vec<usize> = circle
            .split(' ')
            .map(|n| n.parse().expect("a number"))
            .collect();
        assert_eq!(corners.first(), corners.last(), "it closes");
        assert_eq!(corners.len(), 33, "32 sides");
        assert!(corners.iter().all(|corner| (1..=vertices).contains(corner)));
    }
}

#[test]
fn report_json_tells_input_settings_findings_stages_patches_and_boundaries() {
    let (home, shaft) = cut_shaft();
    let report = home.json(&format!("{RESULTS}/report.json"));
    let keys: BTreeSet<_> = report
        .as_object()
        .expect("an object")
        .keys()
        .map(String::as_str)
        .collect();
    for key in [
        "schema_version",
        "program",
        "input",
        "settings",
        "findings",
        "stages",
        "patches",
        "boundaries",
    ] {
        assert!(keys.contains(key), "{key}");
    }
    assert_eq!(report["schema_version"], 1);
    assert_eq!(report["input"]["path"], "shaft.stl");
    assert_eq!(report["input"]["format"], "stl-binary");
    assert_eq!(report["input"]["bytes"], shaft.bytes.len());
    assert_eq!(report["input"]["faces"], shaft.patches.len());
    assert!(
        report["input"]["blake3"]
            .as_str()
            .is_some_and(|hash| hash.len() == 64)
    );
    assert_eq!(report["settings"]["pipeline"]["profile"], "cad");
    assert_eq!(report["findings"]["closed"], true);

    let patches = report["patches"].as_array().expect("patches");
    assert_eq!(patches.len(), shaft.patch_count());
    let faces: u64 = patches
        .iter()
        .filter_map(|patch| patch["faces"].as_u64())
        .sum();
    assert_eq!(faces as usize, shaft.patches.len());
    for (id, patch) in patches.iter().enumerate() {
        assert_eq!(patch["id"], id);
        for key in [
            "area",
            "perimeter",
            "k_min_mean",
            "k_min_spread",
            "k_max_mean",
            "k_max_spread",
        ] {
            assert!(patch[key].is_number(), "patch {id}: {key}");
        }
        assert!(
            patch["neighbours"]
                .as_array()
                .is_some_and(|all| !all.is_empty()),
            "patch {id}"
        );
    }
    for boundary in report["boundaries"].as_array().expect("boundaries") {
        assert!(
            boundary["length"]
                .as_f64()
                .is_some_and(|length| length > 0.0),
            "{boundary}"
        );
        let share = boundary["sharp_share"].as_f64();
        assert!(
            share.is_some_and(|share| (0.0..=1.0).contains(&share)),
            "{boundary}"
        );
    }
}

#[test]
fn only_the_files_asked_for_are_written() {
    let home = Home::new();
    home.put_sample("bracket.obj");
    home.run("segment bracket.obj --write labels").ended(0);
    assert_eq!(home.listed("bracket.obj.seamline"), ["labels.seg"]);
    home.run("segment bracket.obj --write report,boundaries")
        .ended(0);
    assert_eq!(
        home.listed("bracket.obj.seamline"),
        ["boundaries.obj", "report.json"]
    );
}

/// Curvature that nobody has asked for is not computed; what is asked for must not miss it.
#[test]
fn each_file_is_the_same_whichever_others_are_written() {
    let home = Home::new();
    home.put_sample("shaft.stl");
    for command in ["segment shaft.stl", "rectify shaft.stl --sharp-deg 40"] {
        for profile in ["cad", "lavoue2005"] {
            let command = format!("{command} --profile {profile}");
            home.run(&format!("{command} -o all")).ended(0);
            for (word, file) in [
                ("labels", "labels.seg"),
                ("patches", "patches.ply"),
                ("boundaries", "boundaries.obj"),
                ("report", "report.json"),
            ] {
                home.run(&format!("{command} -o alone --write {word}"))
                    .ended(0);
                let [mut all, mut alone] = ["all", "alone"]
                    .map(|folder| home.read(&format!("{folder}/shaft.stl.seamline/{file}")));
                if word == "report" {
                    [all, alone] = [all, alone].map(|report| without_seconds(&report));
                }
                assert!(all == alone, "{file} of {command}");
            }
        }
    }
}

#[test]
fn a_file_nobody_knows_is_wrong_use_and_nothing_is_written() {
    let home = Home::new();
    home.put_sample("bracket.obj");
    let ran = home
        .run("segment bracket.obj -o out --write label")
        .ended(2);
    assert!(ran.err.contains("did you mean `labels`?"), "{}", ran.err);
    assert_eq!(home.listed("."), ["bracket.obj"]);
}

#[test]
fn json_is_one_report_a_line_on_standard_output_and_nothing_else() {
    let home = Home::new();
    home.put_sample("bracket.obj");
    home.put_sample("shaft.stl");
    let ran = home
        .run("segment bracket.obj shaft.stl --json -o out")
        .ended(0);
    let reports: Vec<Value> = ran
        .out
        .lines()
        .map(|line| serde_json::from_str(line).expect("a line of JSON"))
        .collect();
    let paths: Vec<_> = reports
        .iter()
        .map(|report| &report["input"]["path"])
        .collect();
    assert_eq!(paths, ["bracket.obj", "shaft.stl"]);
    assert_eq!(reports[1], home.json(&format!("{RESULTS}/report.json")));
}

#[test]
fn what_is_said_to_a_person_is_on_standard_error_and_quiet_is_silent() {
    let home = Home::new();
    home.put_sample("bracket.obj");
    let ran = home.run("segment bracket.obj").ended(0);
    assert_eq!(ran.out, "");
    assert!(
        ran.err.contains("bracket.obj: 10 patches of 38 faces"),
        "{}",
        ran.err
    );
    let ran = home.run("segment bracket.obj -q").ended(0);
    assert_eq!((ran.out.as_str(), ran.err.as_str()), ("", ""));
}
