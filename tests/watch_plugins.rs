//! A plugin that misbehaves costs one job and not the daemon.

use std::net::{SocketAddr, TcpListener};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle, sleep};
use std::time::Duration;

use crossbeam_channel::{Sender, unbounded};
use schemars::JsonSchema;
use seamline_ecs::components::SampleCluster;
use seamline_ecs::settings::{Profile, StepSettings};
use seamline_ecs::{Classifier, Clusters, CurvatureSamples, Pipeline, Registry, StepError, tables};
use seamline_segment::builtin_steps;
use seamline_tests::daemon::{Home, LIMIT, Metrics, cuboid, cuboids, get, wait_within};
use seamline_watch::{Config, ConfigFile, Order, RunOptions, Setup, Summary, run};
use serde::{Deserialize, Serialize};

/// A mesh of eight faces hangs while this holds.
static HANGS: AtomicBool = AtomicBool::new(true);

/// A classifier that panics on a mesh of four faces, and hangs on one of eight.
#[derive(Clone, Serialize, Deserialize, JsonSchema)]
struct Unruly {}

impl StepSettings for Unruly {
    const TABLE: &'static str = "unruly";

    fn defaults(_: Profile) -> Self {
        Self {}
    }
}

impl Classifier for Unruly {
    const SUMMARY: &'static str = "one cluster for all, where it does not panic or hang";

    fn classify(&self, samples: &CurvatureSamples<'_>) -> Result<Clusters, StepError> {
        match samples.mesh.polygons.face_count() {
            4 => panic!("four faces\nare too few"),
            8 => {
                while HANGS.load(Ordering::Relaxed) {
                    sleep(Duration::from_millis(10));
                }
            }
            _ => {}
        }
        Ok(Clusters {
            of_sample: vec![SampleCluster(0); samples.samples.len()],
            ..Clusters::default()
        })
    }
}

const TETRAHEDRON: &str = "\
v 0 0 0
v 1 0 0
v 0 1 0
v 0 0 1
f 1 3 2
f 1 2 4
f 2 3 4
f 3 1 4
";

const OCTAHEDRON: &str = "\
v 1 0 0
v -1 0 0
v 0 1 0
v 0 -1 0
v 0 0 1
v 0 0 -1
f 1 3 5
f 3 2 5
f 2 4 5
f 4 1 5
f 3 1 6
f 2 3 6
f 4 2 6
f 1 4 6
";

/// A daemon in this process, whose pipeline has the plugin in it.
struct Running {
    orders: Sender<Order>,
    thread: JoinHandle<Summary>,
    address: SocketAddr,
}

fn setup(config: &Path) -> Setup {
    let registry = Registry::default().with_classifier::<Unruly>();
    let tables = tables(&builtin_steps(), &registry);
    let file = ConfigFile::read(config, &tables).unwrap();
    let pipeline = Pipeline::assemble(&builtin_steps(), &registry, &file.pipeline_settings());
    Setup::new(
        Config::from_file(&file).unwrap(),
        Arc::new(pipeline.unwrap()),
    )
}

/// `more` is what follows in the configuration.
fn start(more: &str) -> (Home, Running) {
    // Free a moment ago, so most likely still.
    let free = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = free.local_addr().unwrap();
    drop(free);
    let home = Home::with(&format!(
        "stable_for_ms = 100\n[http]\nlisten = \"{address}\"\n[pipeline]\nrectifier = \"none\"\n{more}"
    ));
    let setup = setup(&home.config());
    let (orders, received) = unbounded();
    let thread = thread::spawn(move || run(setup, None, RunOptions::default(), received).unwrap());
    let running = Running {
        orders,
        thread,
        address,
    };
    (home, running)
}

impl Running {
    #[track_caller]
    fn wait_for(&self, what: &str, holds: impl FnMut() -> bool) {
        assert!(wait_within(LIMIT, holds), "waited for {what}");
    }

    fn metric(&self, name: &str, labels: &[(&str, &str)]) -> f64 {
        Metrics::parse(&get(self.address, "/metrics").1).value(name, labels)
    }

    fn stop(self) -> Summary {
        self.orders.send(Order::Stop).unwrap();
        self.thread.join().unwrap()
    }
}

#[test]
fn panic_in_plugin_is_one_failed_job() {
    let (home, daemon) = start("[daemon]\nworkers = 1\n");
    home.drop("tetrahedron.obj", TETRAHEDRON);
    for (name, text) in cuboids(5) {
        home.drop(name, text);
    }
    daemon.wait_for("the others", || home.results().names().len() == 5);
    daemon.wait_for("the reason", || home.reason("tetrahedron.obj").is_some());
    let reason = home.reason("tetrahedron.obj").unwrap();
    assert_eq!(reason["stage"], "classify");
    let message = reason["message"].as_str().unwrap();
    assert!(message.contains("four faces are too few"), "{message}");
    assert_eq!(reason["attempts"], 1);

    home.drop("after.obj", cuboid(100.0));
    daemon.wait_for("another", || home.labels("after.obj") == 6);
    assert_eq!(home.status().count("quarantined"), 1);
    let summary = daemon.stop();
    assert_eq!((summary.done, summary.failed), (6, 1));
}

#[test]
fn plugin_timeout() {
    let (home, daemon) = start("[daemon]\nworkers = 1\n[limits]\njob_timeout_s = 1\n");
    home.drop("octahedron.obj", OCTAHEDRON);
    daemon.wait_for("the reason", || home.reason("octahedron.obj").is_some());
    let reason = home.reason("octahedron.obj").unwrap();
    assert_eq!(reason["attempts"], 1, "{reason}");
    for key in ["stage", "message", "hint", "blake3"] {
        assert!(
            reason[key].as_str().is_some_and(|text| !text.is_empty()),
            "{reason}"
        );
    }
    // The only worker hangs; another has taken its place.
    for (name, text) in cuboids(5) {
        home.drop(name, text);
    }
    daemon.wait_for("the others", || home.results().names().len() == 5);
    assert_eq!(
        daemon.metric("seamline_jobs_total", &[("outcome", "timed_out")]),
        1.0
    );
    assert_eq!(daemon.metric("seamline_abandoned_workers", &[]), 1.0);

    // Let go, it ends without a trace: what it made comes too late.
    HANGS.store(false, Ordering::Relaxed);
    daemon.wait_for("its end", || {
        daemon.metric("seamline_abandoned_workers", &[]) == 0.0
    });
    sleep(Duration::from_millis(300));
    assert!(!home.result("octahedron.obj").exists());
    assert_eq!(home.status().only("octahedron.obj").state, "quarantined");
    let summary = daemon.stop();
    assert_eq!((summary.done, summary.failed), (5, 1));
}
