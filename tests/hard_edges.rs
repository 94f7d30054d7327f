//! Contours completed from hard edges alone, without any segmentation (paper 5.4: "we can imagine using it as
//! a contour tracking post-process to a hard edge detection algorithm").

use std::fs;

use seamline_tests::{bench, run, seamline};
use serde_json::Value;

#[test]
fn hard_edges_of_fandisk_close_into_the_same_14_patches_from_25_to_60_degrees() {
    let Some(path) = bench("paper/fandisk.obj") else {
        return;
    };
    let home = tempfile::tempdir().expect("a temporary folder");
    for profile in ["cad", "lavoue2005"] {
        for angle in ["25", "30", "40", "50", "60"] {
            let mut command = seamline();
            command.current_dir(home.path()).arg("rectify").arg(&path);
            command.args(["--sharp-deg", angle, "--profile", profile]);
            run(&mut command).ended(0);
            let place = home.path().join("fandisk.obj.seamline/report.json");
            let report = fs::read_to_string(place).expect("a report");
            let report: Value = serde_json::from_str(&report).expect("JSON");
            let at = format!("at {angle} degrees in {profile}");
            assert_eq!(report["patches"].as_array().map(Vec::len), Some(14), "{at}");
            let changes = &report["changes"];
            assert_eq!(changes["after"]["edges"], 743, "{at}");
            assert_eq!(changes["after"]["open_ends"], 0, "{at}");
            assert_eq!(changes["before"]["open_ends"], 2, "{at}");
            assert_eq!(changes["open_ends_closed"], 2, "{at}");
            assert_eq!(changes["edges"]["removed"], 0, "{at}");
        }
    }
}
