//! The demonstration that comes with the program, on a copy of its folders.

use std::fs;
use std::path::Path;

use seamline_tests::same_partition;
use seamline_tests::samples::samples;

use crate::home::Home;

const DEMO: &str = "watch-config/demo.toml";

/// The parts of a checkout that the demonstration needs.
fn checkout() -> Home {
    let home = Home::new();
    let original = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(DEMO);
    home.put(DEMO, fs::read(original).expect("it comes with the program"));
    for sample in samples() {
        home.put(&format!("tests/data/{}", sample.path), sample.bytes);
    }
    home
}

#[test]
fn the_demonstration_cuts_every_sample_part_once() {
    let home = checkout();
    home.run(&format!("watch {DEMO} --once")).ended(0);
    for sample in samples() {
        let labels = home.labels(&format!("watch-config/demo/out/{}.seamline", sample.path));
        assert!(same_partition(&labels, &sample.patches), "{}", sample.path);
    }
    let in_folder = |folder: &str, depth: usize| {
        let of = samples().into_iter().map(|sample| sample.path);
        let mut names: Vec<_> = of
            .filter(|path| path.starts_with(folder) && path.matches('/').count() == depth)
            .map(|path| format!("{}.seamline", &path[folder.len()..]))
            .collect();
        names.sort();
        names
    };
    assert_eq!(
        home.listed("watch-config/demo/out/turned"),
        in_folder("turned/", 1)
    );
    let mut top = in_folder("", 0);
    top.push("turned".to_owned());
    assert_eq!(home.listed("watch-config/demo/out"), top);
    assert_eq!(home.listed("watch-config/demo/quarantine"), [""; 0]);
    for sample in samples() {
        let kept = home.read(&format!("tests/data/{}", sample.path));
        assert!(kept == sample.bytes, "{} is left alone", sample.path);
    }
}
