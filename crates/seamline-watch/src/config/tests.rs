use std::fs;

use seamline_ecs::settings::{Profile, StepSettings};

use super::*;

struct Home(tempfile::TempDir);

impl Home {
    fn new() -> Self {
        let home = tempfile::tempdir().unwrap();
        fs::create_dir(home.path().join("inbox")).unwrap();
        Self(home)
    }

    fn load(&self, text: &str) -> Result<Config, ConfigError> {
        let path = self.0.path().join("demo.toml");
        fs::write(&path, text).unwrap();
        Config::load(&path, &[SettingsTable::of::<Merge>()])
    }

    /// The text of an error, without the folder.
    fn refusal(&self, text: &str) -> String {
        let error = self.load(text).unwrap_err();
        assert!(!error.to_string().contains('\n'));
        let home = self.0.path().canonicalize().unwrap();
        let text = error
            .to_string()
            .replace(&format!("{}/", home.display()), "");
        text.replace(&format!("{}/", self.0.path().display()), "")
    }
}

/// Stands for a step of the pipeline.
#[derive(Clone, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
struct Merge {
    threshold: f64,
}

impl StepSettings for Merge {
    const TABLE: &'static str = "merge";
    fn defaults(_: Profile) -> Self {
        Self { threshold: 1.0 }
    }
}

const FRAME_TEXT: &str = "\
[[watch]]
root = \"inbox\"
stable_for_ms = 500
";

#[test]
fn what_is_not_given_has_its_default_beside_the_file() {
    let home = Home::new();
    let config = home.load(FRAME_TEXT).unwrap();
    let base = home.0.path().canonicalize().unwrap();
    assert_eq!(config.watch[0].root, base.join("inbox"));
    assert_eq!(config.watch[0].stable_for, Duration::from_millis(500));
    assert_eq!(config.watch[0].after, After::Keep);
    assert_eq!(config.output, base.join("out"));
    assert_eq!(config.quarantine, base.join("quarantine"));
    assert!((1..=4).contains(&config.workers));
    assert!(!base.join("out").exists());
}

#[test]
fn tables_of_the_pipeline_are_handed_on_untouched() {
    let config = Home::new()
        .load(&format!(
            "{FRAME_TEXT}[merge]\nthreshold = 3\nwhatever = 'x'\n"
        ))
        .unwrap();
    assert_eq!(
        config.pipeline_settings()["merge"]["whatever"].as_str(),
        Some("x")
    );
    assert!(!config.pipeline_settings().contains_key("watch"));
}

#[test]
fn an_unknown_key_names_file_line_and_the_nearest_known_key() {
    let text = "[[watch]]\nroot = \"inbox\"\n\nstable_for_sm = 2\n";
    assert_eq!(
        Home::new().refusal(text),
        "demo.toml:4: watch.stable_for_sm: unknown key `stable_for_sm`; did you mean `stable_for_ms`?"
    );
}

#[test]
fn an_unknown_table_names_the_nearest_of_frame_and_pipeline() {
    let frame = Home::new().refusal(&format!("{FRAME_TEXT}[outptu]\ndir = 'x'\n"));
    assert_eq!(
        frame,
        "demo.toml:4: outptu: unknown table `outptu`; did you mean `output`?"
    );
    let pipeline = Home::new().refusal(&format!("{FRAME_TEXT}[merg]\n"));
    assert_eq!(
        pipeline,
        "demo.toml:4: merg: unknown table `merg`; did you mean `merge`?"
    );
}

#[test]
fn a_value_of_the_wrong_kind_says_what_kind_is_right() {
    let text = format!("{FRAME_TEXT}recursive = \"yes\"\n");
    assert_eq!(
        Home::new().refusal(&text),
        "demo.toml:4: watch.recursive: is a text in quotes; wants true or false, as in `recursive = true`"
    );
}

#[test]
fn a_word_that_is_not_allowed_is_refused_with_the_words_that_are() {
    let after = Home::new().refusal(&format!("{FRAME_TEXT}after = \"mvoe\"\n"));
    assert!(
        after.starts_with("demo.toml:4: watch.after: unknown variant `mvoe`"),
        "{after}"
    );
    assert!(after.contains("`keep`, `move`"), "{after}");
    let write = Home::new().refusal(&format!("{FRAME_TEXT}[output]\nwrite = [\"lables\"]\n"));
    assert!(
        write.starts_with("demo.toml:5: output.write: unknown variant `lables`"),
        "{write}"
    );
}

#[test]
fn a_value_out_of_range_is_refused_on_its_line() {
    let text = "[[watch]]\nroot = \"inbox\"\n[[watch]]\nroot = \"inbox/b\"\nstable_for_ms = 0\n";
    assert_eq!(
        Home::new().refusal(text),
        "demo.toml:5: watch.stable_for_ms: out of range; wants 1 to 3600000 milliseconds"
    );
}

#[test]
fn a_watched_folder_that_is_not_there_is_waited_for_and_a_file_in_its_place_is_refused() {
    let home = Home::new();
    let text = "[[watch]]\nroot = \"later\"\n";
    let base = home.0.path().canonicalize().unwrap();
    assert_eq!(home.load(text).unwrap().watch[0].root, base.join("later"));
    fs::write(base.join("later"), "").unwrap();
    assert_eq!(
        home.refusal(text),
        "demo.toml:2: watch.root: later is not a folder; name a folder"
    );
}

#[test]
fn a_path_belongs_to_the_innermost_folder_that_looks_there() {
    let home = Home::new();
    let text =
        "[[watch]]\nroot = \"inbox\"\nrecursive = false\n[[watch]]\nroot = \"inbox/deep/er\"\n";
    let config = home.load(text).unwrap();
    let base = home.0.path().canonicalize().unwrap().join("inbox");
    let belongs = |path: &str| {
        let watched = config.watched_with(&base.join(path));
        watched.map(|watched| watched.root.clone())
    };
    let inner = base.join("deep/er");
    for (path, root) in [
        ("part.stl", Some(&base)),
        ("", Some(&base)),
        ("deep/part.stl", None),
        ("deep/er", Some(&inner)),
        ("deep/er/part.stl", Some(&inner)),
        ("deep/er/and/deeper.stl", Some(&inner)),
        ("../part.stl", None),
    ] {
        assert_eq!(belongs(path).as_ref(), root, "{path}");
    }
}

#[test]
fn output_inside_watch_is_refused() {
    for (table, key) in [
        ("output", "output.dir"),
        ("quarantine", "quarantine.dir"),
        ("done", "done.dir"),
    ] {
        let text = format!("{FRAME_TEXT}[{table}]\ndir = \"inbox/made/here\"\n");
        let refusal = Home::new().refusal(&text);
        let start = format!("demo.toml:5: {key}: inbox/made/here lies inside the watched folder");
        assert!(refusal.starts_with(&start), "{refusal}");
    }
    let flat = format!("{FRAME_TEXT}recursive = false\n[output]\ndir = \"inbox/made\"\n");
    assert!(Home::new().load(&flat).is_ok());
}

#[test]
fn a_folder_watched_twice_is_refused() {
    let text = "[[watch]]\nroot = \"inbox\"\n[[watch]]\nroot = \"./inbox/../inbox\"\n";
    let refusal = Home::new().refusal(text);
    assert!(
        refusal.starts_with("demo.toml:4: watch.root: inbox is watched already"),
        "{refusal}"
    );
}

#[test]
fn a_single_table_in_place_of_the_list_is_refused() {
    let refusal = Home::new().refusal("[watch]\nroot = \"inbox\"\n");
    assert_eq!(
        refusal,
        "demo.toml:1: watch: is one table; wants a list: write `[[watch]]`"
    );
}

#[test]
fn text_that_is_not_toml_is_refused_on_its_line() {
    let refusal = Home::new().refusal("[[watch]]\nroot = inbox\n");
    assert!(refusal.starts_with("demo.toml:2: "), "{refusal}");
}
