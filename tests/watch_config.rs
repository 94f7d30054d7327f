//! What comes in `watch-config/`: each configuration is right by the schema and by the program, and cuts a part.

use std::fs;
use std::path::{Path, PathBuf};

use seamline_tests::samples::{Sample, samples};
use seamline_tests::{run, same_partition, seamline};
use serde_json::Value;

/// A configuration that comes with the program, and what is tried with it.
struct Shipped {
    name: &'static str,
    /// Where a part is dropped, and where the result of that part is to be.
    drops: &'static [(&'static str, &'static str)],
    /// Where the parts are afterwards.
    sources: &'static [&'static str],
    /// Do labels of another tool come with each part?
    labelled: bool,
}

/// All of them. Paths are those of a project whose `watch-config/` holds the file.
const SHIPPED: [Shipped; 4] = [
    Shipped {
        name: "demo.toml",
        drops: &[(
            "tests/data/deeper/part.stl",
            "watch-config/demo/out/deeper/part.stl.seamline",
        )],
        sources: &["tests/data/deeper/part.stl"],
        labelled: false,
    },
    Shipped {
        name: "production.toml",
        drops: &[(
            "watch-config/inbox/deeper/part.stl",
            "watch-config/out/deeper/part.stl.seamline",
        )],
        sources: &["watch-config/done/deeper/part.stl"],
        labelled: false,
    },
    Shipped {
        name: "pairs.toml",
        drops: &[(
            "watch-config/inbox/from-others/part.stl",
            "watch-config/out/from-others/part.stl.seamline",
        )],
        sources: &[
            "watch-config/done/from-others/part.stl",
            "watch-config/done/from-others/part.seg",
        ],
        labelled: true,
    },
    Shipped {
        name: "network-share.toml",
        drops: &[
            (
                "watch-config/shares/acme/inbox/acme/part.stl",
                "watch-config/shares/results/patches/acme/part.stl.seamline",
            ),
            (
                "watch-config/shares/bolt-and-sons/inbox/bolt-and-sons/part.stl",
                "watch-config/shares/results/patches/bolt-and-sons/part.stl.seamline",
            ),
        ],
        sources: &[
            "watch-config/shares/acme/inbox/acme/part.stl",
            "watch-config/shares/bolt-and-sons/inbox/bolt-and-sons/part.stl",
        ],
        labelled: false,
    },
];

fn shipped(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../watch-config")
        .join(name);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn parsed(text: &str) -> Value {
    let tables: toml::Table = text.parse().expect("TOML");
    serde_json::to_value(tables).expect("what TOML can say JSON can say")
}

fn schema() -> Value {
    serde_json::from_str(&shipped("schema.json")).expect("JSON")
}

/// What the schema has against a configuration.
fn faults(text: &str) -> Vec<String> {
    let validator = jsonschema::validator_for(&schema()).expect("a schema");
    let tables = parsed(text);
    let faults = validator.iter_errors(&tables);
    faults
        .map(|fault| format!("{}: {fault}", fault.instance_path()))
        .collect()
}

/// The configuration as it comes, but for two things: files are taken after 50 ms, so that the test is short, and
/// the system chooses the port, so that two tests do not want the same.
fn hurried(text: &str) -> String {
    let mut tables: toml::Table = text.parse().expect("TOML");
    for watched in tables["watch"].as_array_mut().expect("folders") {
        let watched = watched.as_table_mut().expect("a table");
        watched.insert("stable_for_ms".to_owned(), 50.into());
        watched.insert("poll_ms".to_owned(), 50.into());
    }
    if let Some(http) = tables.get_mut("http") {
        http["listen"] = "127.0.0.1:0".into();
    }
    tables.to_string()
}

/// The sample parts that may be called `part.stl`.
fn parts() -> impl Iterator<Item = Sample> {
    let samples = samples().into_iter();
    samples.filter(|sample| sample.path.ends_with(".stl"))
}

/// A temporary project: the configuration in `watch-config/`, and a part in each folder it watches.
fn project(of: &Shipped, config: &str) -> (tempfile::TempDir, PathBuf) {
    let home = tempfile::tempdir().expect("a folder");
    let put = |name: &str, bytes: &[u8]| {
        let path = home.path().join(name);
        fs::create_dir_all(path.parent().expect("it lies below")).expect("a folder for it");
        fs::write(&path, bytes).expect("a file to put");
        path
    };
    for ((drop, _), part) in of.drops.iter().zip(parts()) {
        put(drop, &part.bytes);
        if of.labelled {
            let labels: String = part.patches.iter().map(|p| format!("{p}\n")).collect();
            put(&drop.replace(".stl", ".seg"), labels.as_bytes());
        }
    }
    let config = put(&format!("watch-config/{}", of.name), config.as_bytes());
    (home, config)
}

#[test]
fn every_configuration_that_comes_with_the_program_is_tried_here() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../watch-config");
    let names = fs::read_dir(folder)
        .expect("it comes with the program")
        .map(|entry| entry.expect("an entry").file_name());
    let mut names: Vec<_> = names
        .map(|name| name.to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".toml"))
        .collect();
    names.sort();
    let mut tried = SHIPPED.map(|shipped| shipped.name);
    tried.sort();
    assert_eq!(names, tried);
}

#[test]
fn every_configuration_passes_the_check_as_it_comes() {
    for of in SHIPPED {
        let (_home, config) = project(&of, &shipped(of.name));
        let ran = run(seamline().args(["config", "check"]).arg(config)).ended(0);
        assert_eq!(ran.err, "", "{}", of.name);
    }
}

#[test]
fn every_configuration_cuts_what_is_dropped() {
    for of in SHIPPED {
        let (home, config) = project(&of, &hurried(&shipped(of.name)));
        let ran = run(seamline().arg("watch").arg(config).arg("--once")).ended(0);
        for ((_, result), part) in of.drops.iter().zip(parts()) {
            let labels = fs::read_to_string(home.path().join(result).join("labels.seg"));
            let labels: Vec<u32> = labels
                .unwrap_or_else(|error| panic!("{result}: {error}: {ran:?}"))
                .lines()
                .map(|line| line.parse().expect("a number"))
                .collect();
            assert!(same_partition(&labels, &part.patches), "{result}");
        }
        for source in of.sources {
            assert!(home.path().join(source).is_file(), "{source}: {ran:?}");
        }
    }
}

#[test]
fn the_schema_beside_them_is_the_one_the_program_prints() {
    let printed = run(seamline().args(["config", "schema"])).ended(0).out;
    assert!(
        shipped("schema.json") == printed,
        "renew it: cargo run --release -- config schema > watch-config/schema.json"
    );
}

#[test]
fn every_configuration_is_right_by_the_schema_and_names_it() {
    for of in SHIPPED {
        let text = shipped(of.name);
        assert_eq!(faults(&text), [""; 0], "{}", of.name);
        assert!(text.starts_with("#:schema ./schema.json\n"), "{}", of.name);
    }
}

#[test]
fn what_is_wrong_is_wrong_by_the_schema_too() {
    for (text, place) in [
        ("[[watch]]\nrecursive = true\n", "/watch/0"),
        ("[[watch]]\nroot = \"in\"\nrecursiv = true\n", "/watch/0"),
        (
            "[[watch]]\nroot = \"in\"\nafter = \"burn\"\n",
            "/watch/0/after",
        ),
        ("[daemon]\ndrain_s = -1\n", "/daemon/drain_s"),
        ("[merge]\nthreshold = \"low\"\n", "/merge/threshold"),
        (
            "[merge]\nthreshold = \"auto\"\nregions = -1\n",
            "/merge/regions",
        ),
        ("[[rules]]\nprofile = \"cad\"\n", "/rules/0"),
        (
            "[[rules]]\nfiles = [\"a\"]\n[rules.settings.merge]\nsmall = 1\n",
            "/rules/0/settings/merge",
        ),
        (
            "[pipeline]\nclassifier = { timeout_s = 3 }\n",
            "/pipeline/classifier",
        ),
        ("[outptu]\ndir = \"out\"\n", ""),
    ] {
        let faults = faults(text);
        let [fault] = &faults[..] else {
            panic!("one fault in {text}: {faults:?}")
        };
        assert!(fault.starts_with(&format!("{place}: ")), "{text}: {fault}");
    }
}

/// The tables of the steps go with a profile and are better left alone; every other one is there, with all its keys.
#[test]
fn production_sets_every_key_that_is_not_a_step_s_own() {
    let steps = seamline_ecs::tables(
        &seamline_segment::builtin_steps(),
        &seamline_plugins::registry(),
    );
    let is_a_step_s = |table: &str| table != "pipeline" && steps.iter().any(|s| s.name == table);
    let production = parsed(&shipped("production.toml"));
    let schema = schema();
    let tables = schema["properties"].as_object().expect("tables");
    for (table, of_table) in tables.iter().filter(|(name, _)| !is_a_step_s(name)) {
        let (keys, set) = match table.as_str() {
            "watch" | "rules" => (&of_table["items"]["properties"], &production[table][0]),
            _ => (&of_table["properties"], &production[table]),
        };
        for key in keys.as_object().expect("keys").keys() {
            assert!(!set[key].is_null(), "{table}.{key}");
        }
    }
}

/// The value of a line `key=value` of the unit.
fn of_unit(key: &str) -> String {
    let unit = shipped("seamline.service");
    let value = unit
        .lines()
        .find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
    value
        .unwrap_or_else(|| panic!("the unit sets {key}"))
        .to_owned()
}

#[test]
fn the_unit_leaves_the_daemon_its_time_and_its_memory() {
    let production = parsed(&shipped("production.toml"));
    let stop_s: u64 = of_unit("TimeoutStopSec").parse().expect("seconds");
    assert!(stop_s >= production["daemon"]["drain_s"].as_u64().expect("seconds") + 10);
    let most: u64 = of_unit("MemoryMax")
        .strip_suffix('G')
        .and_then(|gibibytes| gibibytes.parse().ok())
        .expect("gibibytes");
    let limit = production["limits"]["memory_limit_bytes"].as_u64();
    assert!(limit.is_some_and(|limit| limit <= (most << 30) / 4 * 3));
}
