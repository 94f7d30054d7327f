//! Several inputs at once.

use crate::home::{BAD_OBJ, Home};

#[test]
fn a_bad_file_among_good_ones_is_named_and_the_others_are_done() {
    let home = Home::new();
    home.put_sample("bracket.obj");
    home.put_sample("shaft.stl");
    home.put("bad.obj", BAD_OBJ);
    let ran = home
        .run("segment bracket.obj bad.obj missing.stl shaft.stl -o out -q")
        .ended(1);
    assert_eq!(
        home.listed("out"),
        ["bracket.obj.seamline", "shaft.stl.seamline"]
    );
    let [bad, missing] = ran.err.lines().collect::<Vec<_>>()[..] else {
        panic!("a line for each that failed: {}", ran.err);
    };
    assert!(bad.starts_with("error: bad.obj: line 3: "), "{bad}");
    assert!(
        missing.starts_with("error: missing.stl: cannot be read"),
        "{missing}"
    );
}

#[test]
fn two_inputs_of_the_same_name_are_refused_before_anything_is_done() {
    let home = Home::new();
    home.put_sample("shaft.stl");
    home.put_sample("turned/shaft.stl");
    let ran = home
        .run("segment shaft.stl turned/shaft.stl -o out")
        .ended(2);
    assert!(
        ran.err.contains("turned/shaft.stl") && ran.err.contains("-o"),
        "{}",
        ran.err
    );
    assert_eq!(home.listed("."), ["shaft.stl", "turned"]);
}

#[test]
fn results_of_an_earlier_run_are_replaced_as_a_whole() {
    let home = Home::new();
    home.put_sample("bracket.obj");
    home.run("segment bracket.obj").ended(0);
    home.put("bracket.obj.seamline/from-before", "");
    home.run("segment bracket.obj").ended(0);
    assert!(!home.at("bracket.obj.seamline/from-before").exists());
    assert_eq!(home.listed("bracket.obj.seamline").len(), 4);
}

#[test]
fn a_file_that_has_gone_bad_leaves_its_earlier_results_alone() {
    let home = Home::new();
    home.put_sample("bracket.obj");
    home.run("segment bracket.obj").ended(0);
    home.put("bracket.obj", BAD_OBJ);
    home.run("segment bracket.obj").ended(1);
    assert_eq!(home.labels("bracket.obj.seamline").len(), 38);
}
