//! What the system does not allow, met in a user namespace of the test's own.

use std::os::unix::fs::{PermissionsExt, chown};

use super::*;
use crate::test_support::in_own_namespace;

#[test]
fn a_folder_that_may_not_be_read_keeps_no_other_from_being_heard() {
    let test =
        "events::tests::refused::a_folder_that_may_not_be_read_keeps_no_other_from_being_heard";
    let closed = |home: &Path| {
        for name in ["a", "b", "c"] {
            fs::create_dir_all(home.join(name).join("below")).unwrap();
        }
        // Of an owner whom the root of the namespace is not.
        let _ = chown(home.join("b"), Some(65534), Some(65534));
        fs::set_permissions(home.join("b"), fs::Permissions::from_mode(0o000)).unwrap();
    };
    let Some(home) = in_own_namespace(test, closed) else {
        return;
    };
    assert!(fs::read_dir(home.join("b")).is_err());
    let mut events = native(&home);
    for name in ["a", "c"] {
        let part = home.join(name).join("below/part.stl");
        fs::write(&part, "x").unwrap();
        named(&mut events, &[&part]);
    }
}

#[test]
fn shares_are_polled_unless_told_otherwise() {
    let test = "events::tests::refused::shares_are_polled_unless_told_otherwise";
    let Some(home) = in_own_namespace(test, |_| {}) else {
        return;
    };
    if !Path::new("/dev/fuse").exists() {
        eprintln!("SKIPPED: {test}: there is no /dev/fuse here");
        return;
    }
    let share = home.join("vendor");
    fs::create_dir(&share).unwrap();
    let options = "fd=9,rootmode=40000,user_id=0,group_id=0";
    let mount = format!("exec 9<>/dev/fuse && mount -i -t fuse -o {options} host:/x \"$0\"");
    let status = std::process::Command::new("sh")
        .arg("-c")
        .arg(mount)
        .arg(&share)
        .status();
    assert!(status.unwrap().success());
    let flat = Watched {
        recursive: false,
        ..watched(&home, Watcher::Auto)
    };
    assert!(!Events::listen(&[flat]).is_polled(&home));
    // The program behind this one is gone, so that the system refuses to listen there.
    let said = said_while(|| {
        assert!(Events::listen(&[watched(&home, Watcher::Native)]).is_polled(&home));
    });
    assert!(said.contains("WARN") && said.lines().count() == 1, "{said}");
    let said = said_while(|| {
        let watched = watched(&home, Watcher::Auto);
        let mut events = Events::listen(std::slice::from_ref(&watched));
        assert!(events.is_polled(&home) && !waits_for(&events, &home));
        events.hear_again(&watched);
    });
    assert_eq!(said.lines().count(), 1, "{said}");
    assert!(
        said.contains(&format!("{} is of type fuse", share.display())),
        "{said}"
    );
}

#[test]
fn without_instances_of_inotify_the_root_is_polled_and_one_line_says_so() {
    let test = "events::tests::refused::without_instances_of_inotify_the_root_is_polled_and_one_line_says_so";
    let Some(home) = in_own_namespace(test, |_| {}) else {
        return;
    };
    if !limited(test, "max_inotify_instances", 0) {
        return;
    }
    for watcher in [Watcher::Auto, Watcher::Native] {
        let said = said_while(|| {
            let watched = watched(&home, watcher);
            let mut events = Events::listen(std::slice::from_ref(&watched));
            assert!(events.is_polled(&home) && !waits_for(&events, &home));
            events.hear_again(&watched);
        });
        assert_eq!(said.lines().count(), 1, "{said}");
        assert!(
            said.contains("sudo sysctl fs.inotify.max_user_instances="),
            "{said}"
        );
    }
}

#[test]
fn without_watches_of_inotify_the_root_is_polled_and_one_line_says_so() {
    let test = "events::tests::refused::without_watches_of_inotify_the_root_is_polled_and_one_line_says_so";
    let Some(home) = in_own_namespace(test, |_| {}) else {
        return;
    };
    let [small, large] = ["small", "large"].map(|name| home.join(name));
    for number in 0..10 {
        fs::create_dir_all(large.join(number.to_string())).unwrap();
    }
    fs::create_dir(&small).unwrap();
    if !limited(test, "max_inotify_watches", 5) {
        return;
    }
    let watched = [&large, &small].map(|root| watched(root, Watcher::Auto));
    let said = said_while(|| {
        let mut events = Events::listen(&watched);
        assert!(events.is_polled(&large));
        // The five watches of the root that was given up are free again.
        let until = Instant::now() + LONG;
        while events.is_polled(&small) && Instant::now() < until {
            std::thread::sleep(Duration::from_millis(10));
            events.hear_again(&watched[1]);
        }
        assert!(!events.is_polled(&small));
        nothing_more(&mut events);

        // The limit is met later, by new folders.
        fs::create_dir_all(small.join("1/2/3/4/5/6/7")).unwrap();
        named(&mut events, &[&small]);
        assert!(events.is_polled(&small));
    });
    let warnings: Vec<_> = said.lines().filter(|line| line.contains("small")).collect();
    assert_eq!(warnings.len(), 1, "{said}");
    assert_eq!(said.lines().count(), 2, "{said}");
    for line in said.lines() {
        assert!(
            line.contains("sudo sysctl fs.inotify.max_user_watches="),
            "{said}"
        );
    }
}

/// Sets a limit of this user namespace; false, and said, where that cannot be.
fn limited(test: &str, limit: &str, to: u32) -> bool {
    let set = fs::write(format!("/proc/sys/user/{limit}"), to.to_string());
    if let Err(error) = &set {
        eprintln!("SKIPPED: {test}: user.{limit} cannot be set here: {error}");
    }
    set.is_ok()
}
