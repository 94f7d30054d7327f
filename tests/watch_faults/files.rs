//! Files that are broken, want too much, or cannot be read.

use std::fs::File;
use std::io::Write;
use std::thread::sleep;
use std::time::Duration;

use seamline_tests::daemon::{FailingDisk, Home, cuboid, cuboids, torus};

use crate::{EIO, METRICS};

/// One that is completed in time is done; one that is not is put aside, and not before its time.
#[test]
fn truncated_by_header_waits_then_quarantines() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\nmax_wait_ms = 3000\n{METRICS}"
    ));
    let daemon = home.start();
    let whole = torus(200);
    let half = &whole[..whole.len() / 2];
    let resumed = home.drop("resumed.stl", half);
    home.drop("given-up.stl", half);
    home.drop("whole.stl", torus(300));
    daemon.wait_for("the whole one", || home.labels("whole.stl") > 0);
    sleep(Duration::from_millis(1000));
    assert_eq!(home.results().quarantined(), [""; 0]);
    assert!(
        home.status().is("resumed.stl", "pending")
            || home.status().jobs_of("resumed.stl").is_empty()
    );
    let mut file = File::options().append(true).open(resumed).unwrap();
    file.write_all(&whole[half.len()..]).unwrap();
    drop(file);
    daemon.wait_for("the resumed one", || home.labels("resumed.stl") > 0);
    assert_eq!(
        home.labels("resumed.stl"),
        home.results().report("resumed.stl").unwrap()["input"]["faces"]
    );

    daemon.wait_for("the other", || home.reason("given-up.stl").is_some());
    let reason = home.reason("given-up.stl").unwrap();
    let message = reason["message"].as_str().unwrap();
    assert!(message.contains("incomplete"), "{reason}");
    assert_eq!(home.results().quarantined(), ["given-up.stl"]);
    assert!(!home.result("given-up.stl").exists());
    assert_eq!(daemon.terminate(), Some(0));
}

/// Broken files, and one that the disk does not give: the others are done, and `requeue` brings it back.
#[test]
fn poison_file_quarantined() {
    let retry = "[retry]\nattempts = 3\nfirst_ms = 100\nmost_ms = 400\n";
    let home = Home::with(&format!("stable_for_ms = 100\n{retry}"));
    let Some(disk) = FailingDisk::new(&home) else {
        return;
    };
    disk.fail(1000);
    let mut daemon = home.start_as(disk.under(&mut home.watch(), "inbox/a/sector.obj", EIO));
    home.drop("a/sector.obj", cuboid(50.0));
    home.drop("a/bad.stl", "this is no mesh at all\n");
    home.drop("a/bad.obj", "v 0 0 0\nf 1 2 3\n");
    for (name, text) in cuboids(5) {
        home.drop(name, text);
    }
    daemon.wait_for("the good results", || home.results().names().len() == 5);
    for (name, attempts) in [("a/bad.stl", 1), ("a/bad.obj", 1), ("a/sector.obj", 3)] {
        daemon.wait_for(name, || home.reason(name).is_some());
        daemon.wait_for(name, || home.status().only(name).source.is_some());
        let reason = home.reason(name).unwrap();
        for key in ["stage", "message", "hint", "path", "program_version"] {
            let told = reason[key].as_str().is_some_and(|text| !text.is_empty());
            assert!(told, "{name}: {key}: {reason}");
        }
        assert_eq!(reason["attempts"], attempts, "{name}");
        assert_eq!(reason["blake3"].is_string(), attempts == 1, "{reason}");
        assert!(reason["settings"].is_object());
        assert!(home.at("quarantine").join(name).exists());
        assert!(!home.inbox().join(name).exists());
        assert!(!home.result(name).exists());
        let status = home.status();
        let row = status.only(name);
        assert_eq!(row.attempts, attempts);
        assert_eq!(row.message.as_deref(), reason["message"].as_str());
        assert_eq!(
            row.source.as_deref(),
            Some(&*home.path().join("quarantine").join(name))
        );
    }
    assert_eq!(disk.failures().len(), 3);
    assert!(!daemon.has_ended());

    disk.repair();
    let id = home.status().only("a/sector.obj").id.to_string();
    home.requeue(&[&id]);
    daemon.wait_for("it to be done", || home.status().is("a/sector.obj", "done"));
    assert_eq!(home.labels("a/sector.obj"), 6);
    assert!(!home.at("quarantine/a/sector.obj").exists());
    assert_eq!(home.reason("a/sector.obj"), None);

    // The others come back as well, and go the same way.
    home.requeue(&["--all-quarantined"]);
    daemon.wait_for("them to come back", || {
        let bad = ["a/bad.stl", "a/bad.obj"];
        bad.iter()
            .all(|name| home.status().is(name, "quarantined") && home.reason(name).is_some())
    });
    assert_eq!(
        home.status().count("quarantined"),
        2,
        "{:#?}",
        home.status()
    );
    assert_eq!(daemon.terminate(), Some(0));
}

/// Also with no daemon about, and for a file the daemon then takes.
#[test]
fn requeue_works_while_no_daemon_runs() {
    let home = Home::new();
    home.drop("bad.obj", "v 0 0 0\nf 1 2 3\n");
    home.once().ended(1);
    home.requeue(&["--all-quarantined"]);
    assert!(home.inbox().join("bad.obj").exists());
    assert!(!home.at("quarantine/bad.obj").exists());
    home.once().ended(1);
    assert!(home.at("quarantine/bad.obj").exists());
    let ran = seamline_tests::run(
        seamline_tests::seamline()
            .arg("requeue")
            .arg(home.config())
            .arg("4711"),
    );
    assert_ne!(ran.code, Some(0), "{ran:#?}");
    assert!(ran.err.contains("4711"), "{ran:#?}");
}

/// Files that want more than there is are refused, each for its reason, and cost no memory.
#[test]
fn too_large_or_packed_is_refused() {
    let home = Home::with(&format!(
        "stable_for_ms = 100\nmax_wait_ms = 200\n[limits]\nmax_file_bytes = 200000\nmax_triangles = 2000\n{METRICS}"
    ));
    let daemon = home.start();
    let promise = |file: &mut Vec<u8>| file.extend(u32::MAX.to_le_bytes());
    let mut stl = vec![b' '; 80];
    promise(&mut stl);
    stl.extend([0; 50]);
    let ply = "ply\nformat binary_little_endian 1.0\nelement vertex 4294967295\nproperty float x\n\
               property float y\nproperty float z\nelement face 4294967295\n\
               property list uchar int vertex_indices\nend_header\n\0\0\0\0";
    let gzip = [b"\x1f\x8b\x08\0\0\0\0\0\0\x03".to_vec(), vec![0x5a; 500]].concat();
    let zip = [b"PK\x03\x04\x14\0\0\0\x08\0".to_vec(), vec![0x5a; 500]].concat();
    let cases: [(&str, Vec<u8>, &[&str]); 6] = [
        ("long.obj", vec![b'#'; 200_001], &["200001", "200000"]),
        ("fine.stl", torus(3000), &["2000", "triangles"]),
        ("promise.stl", stl, &["incomplete"]),
        ("promise.ply", ply.into(), &["incomplete"]),
        ("gzip.stl", gzip, &["archive"]),
        ("zip.stl", zip, &["archive"]),
    ];
    for (name, bytes, _) in &cases {
        home.drop(name, bytes);
    }
    home.drop("good.obj", cuboid(1.0));
    for (name, _, words) in &cases {
        daemon.wait_for(name, || home.reason(name).is_some());
        let reason = home.reason(name).unwrap();
        let told = format!("{} {}", reason["message"], reason["hint"]);
        for word in *words {
            assert!(told.contains(word), "{name}: `{word}` is not told: {told}");
        }
        daemon.wait_for(name, || home.status().is(name, "quarantined"));
        assert_eq!(home.status().only(name).attempts, 1, "{name}");
    }
    daemon.wait_for("the good one", || home.labels("good.obj") == 6);
    assert!(daemon.memory("VmHWM") < 200 << 20);
    assert_eq!(daemon.terminate(), Some(0));
}
