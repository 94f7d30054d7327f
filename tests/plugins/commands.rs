//! A program of its own as a plugin: what it does wrong costs one job each, and is told.

use std::time::{Duration, Instant};

use seamline_ecs::{Segmentation, Stage, StageError, Worker};
use seamline_mesh::{Mesh, shapes, weld};
use seamline_tests::daemon::{Home, cuboid};
use seamline_tests::{pipeline, run, seamline};
use std::sync::Arc;

const FICKLE: &str = env!("CARGO_BIN_EXE_fickle_plugin");

fn torus() -> Arc<Mesh> {
    Arc::new(weld(shapes::torus(2.0, 0.5, 24, 12).polygons(), 0.0))
}

fn classifier(manner: &str, more: &str) -> String {
    format!("pipeline.classifier={{ command = ['{FICKLE}', '{manner}'], timeout_s = 20{more} }}")
}

fn worker(manner: &str, more: &str) -> Worker {
    Worker::new(pipeline(&[&classifier(manner, more)]))
}

fn cut(manner: &str, more: &str) -> Result<Segmentation, StageError> {
    worker(manner, more).segment(torus())
}

#[test]
fn a_program_classifies_mesh_after_mesh() {
    for manner in ["good", "once"] {
        let mut worker = worker(manner, "");
        let first = worker.segment(torus()).unwrap();
        for _ in 0..5 {
            assert_eq!(
                worker.segment(torus()).unwrap().face_patches,
                first.face_patches
            );
        }
    }
}

#[test]
fn it_may_be_sent_only_what_it_needs() {
    assert!(cut("good", ", send = ['samples']").is_ok());
    let without = cut("good", ", send = ['faces']").unwrap_err();
    assert!(without.message.contains("no curvature"), "{without}");
}

#[test]
fn a_program_rectifies() {
    let given = format!("pipeline.rectifier={{ command = ['{FICKLE}', 'all'] }}");
    let none = Worker::new(pipeline(&["pipeline.rectifier=none"])).segment(torus());
    let same = Worker::new(pipeline(&[&given])).segment(torus());
    assert_eq!(same.unwrap().face_patches, none.unwrap().face_patches);
}

#[test]
fn every_way_to_be_wrong_is_one_reason() {
    for (manner, what) in [
        (
            "leaves",
            "ended with exit status: 7 before it had answered; it said: I do not like this mesh",
        ),
        (
            "leaves-unread",
            "ended with exit status: 0 before it had answered",
        ),
        (
            "garbage",
            "no Arrow IPC stream: it has `Hello! I` where a message begins",
        ),
        ("endless", "no Arrow IPC stream"),
        ("half", "ended with exit status: 0 before it had answered"),
        ("short", "the classifier gave"),
        ("long", "the classifier gave"),
        ("empty", "the classifier gave 0 clusters for"),
        ("out-of-range", "the cluster"),
        ("negative", "answered with -1 in row 0"),
        ("gaps", "answered with nothing in row 0"),
        ("text", "answered with the column `cluster`: Utf8"),
        ("misnamed", "answered with the column `klusters`: UInt32"),
    ] {
        let error = cut(manner, "").expect_err(manner);
        assert_eq!(error.stage.name(), "classify", "{manner}: {error}");
        assert!(error.message.contains(what), "{manner}: {error}");
        assert!(
            !error.message.contains('\n') && !error.hint.is_empty(),
            "{manner}: {error}"
        );
    }
}

#[test]
fn a_silent_program_is_ended_in_time() {
    let begun = Instant::now();
    let mut worker = Worker::new(pipeline(&[&format!(
        "pipeline.classifier={{ command = ['{FICKLE}', 'silent'], timeout_s = 0.5 }}"
    )]));
    let error = worker.segment(torus()).unwrap_err();
    assert!(
        error.message.contains("gave no answer within 0.5 s"),
        "{error}"
    );
    assert!(begun.elapsed() < Duration::from_secs(10));
}

#[test]
fn a_program_that_dies_between_meshes_costs_one_mesh_and_is_started_again() {
    let mut worker = worker("dies-on-second", "");
    assert!(worker.segment(torus()).is_ok());
    let error = worker.segment(torus()).unwrap_err();
    assert!(error.message.contains("exit status: 3"), "{error}");
    assert!(worker.segment(torus()).is_ok());
}

#[test]
fn a_program_that_is_not_there_is_told() {
    let missing = "pipeline.classifier={ command = ['no-such-program-anywhere'] }";
    let error = Worker::new(pipeline(&[missing]))
        .segment(torus())
        .unwrap_err();
    assert!(
        error
            .message
            .contains("`no-such-program-anywhere` cannot be started"),
        "{error}"
    );
}

#[test]
fn wrong_settings_of_a_command_are_wrong_use_and_name_their_key() {
    let home = Home::new();
    let mesh = home.drop("part.obj", cuboid(1.0));
    for (value, said) in [
        ("{ command = [] }", "pipeline.classifier.command"),
        (
            "{ command = ['x'], timeout_s = 0 }",
            "pipeline.classifier.timeout_s",
        ),
        (
            "{ command = ['x'], send = ['edges'] }",
            "samples, neighbours, vertices and faces",
        ),
        (
            "{ command = ['x'], timeout = 3 }",
            "unknown field `timeout`",
        ),
        ("{ timeout_s = 3 }", "missing field `command`"),
        ("3", "the name of a plugin"),
    ] {
        let set = format!("pipeline.classifier={value}");
        let ran = run(seamline().arg("segment").arg(&mesh).args(["--set", &set])).ended(2);
        assert!(ran.err.contains(said), "{value}: {}", ran.err);
        assert!(
            ran.err.contains("pipeline.classifier"),
            "{value}: {}",
            ran.err
        );
    }
}

#[test]
fn a_program_is_chosen_on_the_command_line_and_one_that_is_no_plugin_is_told_how() {
    let home = Home::new();
    let mesh = home.drop("part.obj", cuboid(1.0));
    let segment = |stage: &str, choice: &str| {
        let mut segment = seamline();
        segment
            .args(["segment", "--json", "-o"])
            .arg(home.at("out"));
        run(segment.arg(&mesh).args([stage, choice]))
    };
    for (stage, key, manner) in [
        ("--classifier", "classifier", "good"),
        ("--rectifier", "rectifier", "all"),
    ] {
        let report = segment(stage, &format!("{{ command = ['{FICKLE}', '{manner}'] }}")).json();
        assert_eq!(report["settings"]["pipeline"][key]["command"][1], manner);
    }
    let told = segment("--classifier", "./mine.py").ended(2);
    assert!(
        told.err
            .contains("{ command = [\"program\", \"argument\"] }"),
        "{}",
        told.err
    );
}

#[test]
fn what_a_program_says_is_shown_to_who_asks_for_it() {
    let home = Home::new();
    let mesh = home.drop("part.obj", cuboid(1.0));
    let good = format!("{{ command = ['{FICKLE}', 'good'] }}");
    let segment = |more: &[&str]| {
        let mut segment = seamline();
        segment.args(["segment", "--classifier", &good, "-o"]);
        run(segment.arg(home.at("out")).arg(&mesh).args(more)).ended(0)
    };
    assert!(!segment(&[]).err.contains("rows to look at"));
    assert!(segment(&["-v"]).err.contains("rows to look at"));
    let check = run(seamline().args(["plugins", "check", FICKLE, "good"])).ended(0);
    assert!(check.err.contains("rows to look at"), "{}", check.err);
    assert!(!check.out.contains("rows to look at"), "{}", check.out);
}

#[test]
fn in_the_daemon_each_fault_is_one_job_in_quarantine_and_the_others_go_on() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\n[[rules]]\nfiles = ['bad*']\nclassifier = {{ command = ['{FICKLE}', 'garbage'] }}\n\
         [pipeline]\nclassifier = {{ command = ['{FICKLE}', 'good'] }}\n"
    ));
    for name in [
        "good1.obj",
        "bad1.obj",
        "good2.obj",
        "bad2.obj",
        "good3.obj",
    ] {
        // All of other content.
        let height = f64::from(name.bytes().map(u32::from).sum::<u32>());
        home.drop(name, cuboid(height));
    }
    let ran = home.once();
    assert_eq!(ran.code, Some(1), "{}", ran.err);
    assert_eq!(home.results().names().len(), 3);
    for bad in ["bad1.obj", "bad2.obj"] {
        let reason = home.reason(bad).expect("a reason");
        assert_eq!(reason["stage"], "classify");
        let message = reason["message"].as_str().unwrap();
        assert!(message.contains("no Arrow IPC stream"), "{message}");
    }
}

/// The command that prints what a program costs beside its own work:
/// `cargo test --release -p seamline-tests --test plugins overhead -- --ignored --nocapture`.
#[test]
#[ignore = "takes some minutes"]
fn overhead_on_a_million_vertices() {
    let mesh = Arc::new(weld(shapes::torus(2.0, 0.5, 2000, 500).polygons(), 0.0));
    println!(
        "{} vertices, {} triangles",
        mesh.positions().len(),
        mesh.triangles.len()
    );
    let on_vertices = ["curvature.carrier=vertices", "sharp.enrich=false"];
    let worker = |classifier: &str| {
        let given = [on_vertices[0], on_vertices[1], classifier];
        Worker::new(pipeline(&given))
    };
    let mut workers = [
        worker("pipeline.classifier=kmeans"),
        worker(&classifier("good", ", send = ['samples']")),
        worker(&classifier("good", "")),
    ];
    // In turn, so that whatever else the machine does is shared; the first round starts the programs.
    let mut seconds = [const { Vec::new() }; 3];
    for _ in 0..6 {
        for (worker, seconds) in workers.iter_mut().zip(&mut seconds) {
            let cut = worker.segment(Arc::clone(&mesh)).unwrap();
            seconds.push(cut.stages[Stage::Classify as usize].seconds);
        }
    }
    let [built_in, samples, all] = seconds.map(|mut seconds| {
        seconds.remove(0);
        seconds.sort_by(f64::total_cmp);
        seconds[2]
    });
    println!("kmeans {built_in:.3} s; command, samples only {samples:.3} s; all tables {all:.3} s");
}
