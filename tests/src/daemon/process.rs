//! The program at work.

use std::fs::{self, File};
use std::net::SocketAddr;
use std::path::PathBuf;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::{Metrics, get};

/// How long anything is waited for that is sure to come.
pub const LIMIT: Duration = Duration::from_secs(60);

/// What can be sent to the daemon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Signal {
    /// Please end.
    Term,
    /// Read your configuration again.
    Hup,
    /// Stand still.
    Stop,
    /// Go on.
    Cont,
    /// End now.
    Kill,
}

/// A running daemon; killed if a test ends without stopping it.
pub struct Daemon {
    child: Child,
    log: PathBuf,
}

impl Daemon {
    /// Starts a command; what it says goes to the file `log`.
    ///
    /// # Panics
    ///
    /// If it cannot be started, as everything here panics that would end a test.
    pub fn spawn(command: &mut Command, log: PathBuf) -> Self {
        let said = File::create(&log).unwrap();
        let child = command
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(said)
            .spawn()
            .unwrap();
        Self { child, log }
    }

    /// Waits for the word of the log that it watches.
    pub fn wait_until_watching(&mut self) {
        let started = Instant::now();
        while !self.log().contains("watching ") {
            let ended = self.child.try_wait().unwrap();
            assert!(
                ended.is_none() && started.elapsed() < LIMIT,
                "the daemon does not watch, but {ended:?}:\n{}",
                self.log()
            );
            sleep(Duration::from_millis(5));
        }
    }

    /// Its process.
    pub fn pid(&self) -> u32 {
        self.child.id()
    }

    /// All it has said.
    pub fn log(&self) -> String {
        String::from_utf8_lossy(&fs::read(&self.log).unwrap_or_default()).into_owned()
    }

    /// Sends it a signal.
    pub fn signal(&self, signal: Signal) {
        let name = match signal {
            Signal::Term => "-TERM",
            Signal::Hup => "-HUP",
            Signal::Stop => "-STOP",
            Signal::Cont => "-CONT",
            Signal::Kill => "-KILL",
        };
        let pid = self.pid().to_string();
        let sent = Command::new("kill").args([name, &pid]).status().unwrap();
        assert!(sent.success(), "kill {name} {pid}");
    }

    /// Has it ended by itself?
    pub fn has_ended(&mut self) -> bool {
        self.child.try_wait().unwrap().is_some()
    }

    /// Waits for its end and gives the exit code; `None` if a signal ended it.
    #[track_caller]
    pub fn wait_exit(&mut self, limit: Duration) -> Option<i32> {
        let started = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().unwrap() {
                return status.code();
            }
            assert!(
                started.elapsed() < limit,
                "waited {limit:?} for the daemon to end:\n{}",
                self.log()
            );
            sleep(Duration::from_millis(5));
        }
    }

    /// Tells it to end, waits, and gives the exit code.
    #[track_caller]
    pub fn terminate(mut self) -> Option<i32> {
        self.signal(Signal::Term);
        self.wait_exit(LIMIT)
    }

    /// Ends it as a power cut would.
    pub fn kill(mut self) {
        self.child.kill().unwrap();
        self.child.wait().unwrap();
    }

    /// Waits until something holds.
    ///
    /// # Panics
    ///
    /// If it does not within [`LIMIT`], with the log.
    #[track_caller]
    pub fn wait_for(&self, what: &str, holds: impl FnMut() -> bool) {
        self.wait_longer(what, LIMIT, holds);
    }

    /// As [`Daemon::wait_for`], with a limit of its own.
    #[track_caller]
    pub fn wait_longer(&self, what: &str, limit: Duration, holds: impl FnMut() -> bool) {
        if !wait_within(limit, holds) {
            panic!(
                "waited {limit:?} for {what}; the daemon said:\n{}",
                self.log()
            );
        }
    }

    /// Where its health and metrics are told: the port it says it listens on.
    #[track_caller]
    pub fn http_address(&self) -> SocketAddr {
        let mut address = None;
        self.wait_for("the address it listens on", || {
            let log = self.log();
            let said = log.split("listening on http://").nth(1);
            let word = said.and_then(|rest| rest.split_whitespace().next());
            address = word.and_then(|word| word.trim_end_matches(['/', '"', '}']).parse().ok());
            address.is_some()
        });
        address.unwrap()
    }

    /// What it answers to a request, as status and body.
    #[track_caller]
    pub fn get(&self, path: &str) -> (u16, String) {
        get(self.http_address(), path)
    }

    /// Its metrics now.
    #[track_caller]
    pub fn metrics(&self) -> Metrics {
        let (status, body) = self.get("/metrics");
        assert_eq!(status, 200, "{body}");
        Metrics::parse(&body)
    }

    /// A figure of `/proc/PID/status` in bytes, such as `VmHWM`, the most memory it ever had.
    #[track_caller]
    pub fn memory(&self, figure: &str) -> u64 {
        let status = fs::read_to_string(format!("/proc/{}/status", self.pid())).unwrap();
        let line = status.lines().find(|line| line.starts_with(figure));
        let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)?.parse::<u64>().ok());
        1024 * kilobytes.expect("the system tells it")
    }
}

impl Drop for Daemon {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Does something come to hold within this time?
pub fn wait_within(limit: Duration, mut holds: impl FnMut() -> bool) -> bool {
    let started = Instant::now();
    while !holds() {
        if started.elapsed() > limit {
            return false;
        }
        sleep(Duration::from_millis(15));
    }
    true
}

/// A command that does something first, or under other circumstances, and then becomes `command`.
pub fn behind(first: &[&str], command: &Command) -> Command {
    let mut both = Command::new(first[0]);
    both.args(&first[1..]);
    both.arg(command.get_program()).args(command.get_args());
    for (name, value) in command.get_envs() {
        match value {
            Some(value) => both.env(name, value),
            None => both.env_remove(name),
        };
    }
    both
}

/// Does this command end well? If not, or if there is no such command, what needs it cannot run here.
pub fn works(command: &[&str]) -> bool {
    let ran = Command::new(command[0]).args(&command[1..]).output();
    ran.is_ok_and(|output| output.status.success())
}
