//! What the service manager is told: `systemd`, with `Type=notify` or `Type=notify-reload`.
//!
//! Where there is none (`NOTIFY_SOCKET` is not set) nothing is said. Where it cannot be told, this is logged
//! once; it is no reason to stop.

use std::io;
use std::sync::Once;

use sd_notify::NotifyState;
use tracing::warn;

/// The daemon has started, or has ended reading its configuration again.
pub fn ready() {
    tell(&[NotifyState::Ready]);
}

/// The daemon begins to read its configuration again; [`ready`] has to follow, also if the new one is refused.
pub fn reloading() {
    // `notify-reload` takes the message for one about this reload and no earlier one by the time in it.
    match NotifyState::monotonic_usec_now() {
        Ok(now) => tell(&[NotifyState::Reloading, now]),
        Err(error) => complain(&error),
    }
}

/// The daemon begins to stop.
pub fn stopping() {
    tell(&[NotifyState::Stopping]);
}

/// What the daemon is doing, in one line for `systemctl status`.
pub fn status(text: &str) {
    // A second line would be taken for another message.
    let line: String = text
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    tell(&[NotifyState::Status(&line)]);
}

/// The daemon is alive. To be said once a second, and only while it is true.
pub fn alive() {
    tell(&[NotifyState::Watchdog]);
}

fn tell(states: &[NotifyState<'_>]) {
    if let Err(error) = sd_notify::notify(states) {
        complain(&error);
    }
}

fn complain(error: &io::Error) {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| warn!("the service manager at NOTIFY_SOCKET cannot be told: {error}"));
}

#[cfg(test)]
mod tests {
    use std::env;
    use std::os::unix::net::UnixDatagram;
    use std::path::Path;
    use std::process::Command;
    use std::time::Duration;

    use super::*;

    /// The environment can be set for another process only, so that the tests run themselves again in one.
    const CHILD: &str = "SEAMLINE_TEST_SERVICE";

    fn in_a_child(test: &str, settings: &[(&str, &str)]) {
        let name = format!("service::tests::{test}");
        let mut command = Command::new(env::current_exe().unwrap());
        command.args([&name, "--exact"]).env(CHILD, "1");
        command.env_remove("NOTIFY_SOCKET");
        let output = command.envs(settings.iter().copied()).output().unwrap();
        let said = String::from_utf8_lossy(&output.stdout);
        assert!(output.status.success(), "{said}");
        assert!(said.contains("1 passed"), "{said}");
    }

    fn is_child() -> bool {
        env::var_os(CHILD).is_some()
    }

    fn manager(path: &Path) -> UnixDatagram {
        let socket = UnixDatagram::bind(path).unwrap();
        socket
            .set_read_timeout(Some(Duration::from_secs(10)))
            .unwrap();
        socket
    }

    fn heard(socket: &UnixDatagram) -> String {
        let mut buffer = [0; 1024];
        let length = socket.recv(&mut buffer).unwrap();
        String::from_utf8(buffer[..length].to_vec()).unwrap()
    }

    fn monotonic_usec() -> i128 {
        match NotifyState::monotonic_usec_now().unwrap() {
            NotifyState::MonotonicUsec(now) => now,
            other => panic!("{other}"),
        }
    }

    #[test]
    fn the_service_manager_hears_each_message_whole() {
        if is_child() {
            ready();
            reloading();
            status("3 jobs waiting\nREADY=0");
            alive();
            stopping();
            return;
        }
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("notify");
        let socket = manager(&path);
        let before = monotonic_usec();
        in_a_child(
            "the_service_manager_hears_each_message_whole",
            &[("NOTIFY_SOCKET", path.to_str().unwrap())],
        );
        assert_eq!(heard(&socket), "READY=1\n");
        let reloading = heard(&socket);
        let usec = reloading
            .strip_prefix("RELOADING=1\nMONOTONIC_USEC=")
            .and_then(|rest| rest.trim_end().parse().ok());
        let usec: i128 = usec.unwrap_or_else(|| panic!("{reloading}"));
        assert!((before..=monotonic_usec()).contains(&usec));
        assert_eq!(heard(&socket), "STATUS=3 jobs waiting READY=0\n");
        assert_eq!(heard(&socket), "WATCHDOG=1\n");
        assert_eq!(heard(&socket), "STOPPING=1\n");
    }

    #[test]
    fn without_a_service_manager_nothing_happens() {
        if !is_child() {
            return in_a_child("without_a_service_manager_nothing_happens", &[]);
        }
        ready();
        reloading();
        status("idle");
        alive();
        stopping();
    }

    #[test]
    fn a_service_manager_that_went_away_stops_nobody() {
        if is_child() {
            ready();
            alive();
            return;
        }
        let home = tempfile::tempdir().unwrap();
        let path = home.path().join("nobody");
        in_a_child(
            "a_service_manager_that_went_away_stops_nobody",
            &[("NOTIFY_SOCKET", path.to_str().unwrap())],
        );
    }
}
