use std::io::{BufRead, BufReader, Read, Write};
use std::net::{Ipv4Addr, TcpStream};
use std::path::PathBuf;

use super::*;
use crate::health::{BEAT_LIMIT, Trouble};
use crate::metrics::OutcomeKind;

const ANY: SocketAddr = SocketAddr::new(std::net::IpAddr::V4(Ipv4Addr::LOCALHOST), 0);
const PATIENCE: Duration = Duration::from_secs(20);

fn parts() -> (Arc<Health>, Arc<Metrics>) {
    (Arc::new(Health::new()), Arc::new(Metrics::new("1.2.3")))
}

fn connect(serving: &Serving) -> TcpStream {
    let stream = TcpStream::connect(serving.address()).unwrap();
    stream.set_read_timeout(Some(PATIENCE)).unwrap();
    stream
}

struct Answer {
    status: u16,
    headers: String,
    body: String,
}

fn ask(serving: &Serving, method: &str, path: &str) -> Answer {
    let mut stream = connect(serving);
    write!(
        stream,
        "{method} {path} HTTP/1.1\r\nHost: x\r\nConnection: close\r\n\r\n"
    )
    .unwrap();
    let mut text = String::new();
    stream.read_to_string(&mut text).unwrap();
    let (head, body) = text.split_once("\r\n\r\n").unwrap();
    let (first, headers) = head.split_once("\r\n").unwrap();
    Answer {
        status: first.split(' ').nth(1).unwrap().parse().unwrap(),
        headers: headers.to_ascii_lowercase(),
        body: body.to_owned(),
    }
}

fn get(serving: &Serving, path: &str) -> Answer {
    ask(serving, "GET", path)
}

#[test]
fn health_is_told_by_the_beat() {
    let (health, metrics) = parts();
    let serving = serve(ANY, health.clone(), metrics).unwrap();
    let answer = get(&serving, "/health");
    assert_eq!((answer.status, answer.body.as_str()), (200, "ok\n"));
    assert!(answer.headers.contains("content-type: text/plain"));

    let long_ago = Instant::now().checked_sub(BEAT_LIMIT * 2).unwrap();
    health.beat_at(long_ago);
    let answer = get(&serving, "/health");
    assert_eq!(answer.status, 503);
    assert!(answer.body.starts_with("no sign of life for 6"));
    assert!(answer.body.ends_with(" s\n"));
    assert_eq!(get(&serving, "/ready").status, 503);

    health.beat();
    assert_eq!(get(&serving, "/health").status, 200);
}

#[test]
fn ready_goes_red_and_green_while_health_stays_green() {
    let (health, metrics) = parts();
    let serving = serve(ANY, health.clone(), metrics).unwrap();
    let answer = get(&serving, "/ready");
    assert_eq!(answer.status, 503);
    assert_eq!(
        answer.body,
        "starting: the watched folders are not listed yet\n"
    );
    health.clear(&Trouble::Starting);
    let answer = get(&serving, "/ready");
    assert_eq!((answer.status, answer.body.as_str()), (200, "ready\n"));

    let folder = PathBuf::from("/srv/inbox");
    health.raise(Trouble::FolderAway(folder.clone()), "No such file");
    health.raise(Trouble::Stopping, "");
    let answer = get(&serving, "/ready");
    assert_eq!(answer.status, 503);
    assert_eq!(
        answer.body,
        "stopping\nthe watched folder /srv/inbox is away: No such file\n"
    );
    assert_eq!(get(&serving, "/health").status, 200);

    health.clear(&Trouble::FolderAway(folder));
    health.clear(&Trouble::Stopping);
    assert_eq!(get(&serving, "/ready").status, 200);
}

#[test]
fn metrics_are_served_as_they_are_now() {
    let (health, metrics) = parts();
    let serving = serve(ANY, health, metrics.clone()).unwrap();
    metrics.job_ended(OutcomeKind::Done);
    let answer = get(&serving, "/metrics");
    assert_eq!(answer.status, 200);
    assert!(
        answer
            .headers
            .contains("content-type: application/openmetrics-text; version=1.0.0; charset=utf-8")
    );
    assert_eq!(answer.body, metrics.encode());
    let done = "\nseamline_jobs_total{outcome=\"done\"} 1\n";
    assert!(answer.body.contains(done));
    metrics.job_ended(OutcomeKind::Done);
    assert!(!get(&serving, "/metrics").body.contains(done));
}

#[test]
fn the_first_page_names_the_others() {
    let (health, metrics) = parts();
    let serving = serve(ANY, health, metrics).unwrap();
    let answer = get(&serving, "/");
    assert_eq!(answer.status, 200);
    for path in ["/health", "/ready", "/metrics"] {
        assert!(answer.body.contains(path));
    }
    assert!(answer.body.ends_with('\n'));
}

#[test]
fn what_is_not_there_is_404_and_what_is_not_get_is_405() {
    let (health, metrics) = parts();
    let serving = serve(ANY, health, metrics).unwrap();
    let answer = get(&serving, "/jobs");
    assert_eq!(answer.status, 404);
    assert!(answer.body.ends_with('\n'));
    for method in ["POST", "PUT", "DELETE"] {
        let answer = ask(&serving, method, "/metrics");
        assert_eq!(answer.status, 405, "{method}");
        assert!(
            answer.headers.contains("allow: get,head"),
            "{}",
            answer.headers
        );
        assert_eq!(answer.body, "only GET is answered\n");
    }
    let answer = ask(&serving, "HEAD", "/health");
    assert_eq!((answer.status, answer.body.as_str()), (200, ""));
}

#[test]
fn a_port_in_use_is_an_error_that_names_address_and_key() {
    let (health, metrics) = parts();
    let first = serve(ANY, health.clone(), metrics.clone()).unwrap();
    assert_ne!(first.address().port(), 0);
    let error = serve(first.address(), health, metrics).unwrap_err();
    let message = error.to_string();
    assert!(
        message.starts_with(&format!("cannot listen on {}: ", first.address())),
        "{message}"
    );
    assert!(error.hint().contains("`http.listen`"));
}

#[test]
fn dropped_it_lets_go_of_the_port() {
    let (health, metrics) = parts();
    let serving = serve(ANY, health.clone(), metrics.clone()).unwrap();
    let address = serving.address();
    assert_eq!(get(&serving, "/health").status, 200);
    drop(serving);
    assert!(TcpStream::connect(address).is_err());
    let again = serve(address, health, metrics).unwrap();
    assert_eq!(get(&again, "/health").status, 200);
}

#[test]
fn dropped_it_waits_for_no_open_connection() {
    let (health, metrics) = parts();
    let serving = serve(ANY, health, metrics).unwrap();
    // One that was answered and stays, one that says nothing, one that stops in the middle of its request.
    let mut kept = BufReader::new(connect(&serving));
    kept.get_mut()
        .write_all(b"GET /health HTTP/1.1\r\nHost: x\r\n\r\n")
        .unwrap();
    let mut line = String::new();
    while line != "ok\n" {
        line.clear();
        assert_ne!(kept.read_line(&mut line).unwrap(), 0);
    }
    let _silent = connect(&serving);
    let mut half = connect(&serving);
    half.write_all(b"GET /health HT").unwrap();

    let start = Instant::now();
    drop(serving);
    assert!(start.elapsed() < GRACE + Duration::from_secs(2));
    line.clear();
    assert_eq!(kept.read_line(&mut line).unwrap_or(0), 0);
}

#[test]
fn who_only_holds_a_connection_is_shown_out_and_the_next_one_comes_in() {
    let (health, metrics) = parts();
    let house = House {
        places: 1,
        stay: Duration::from_millis(300),
    };
    let serving = serve_in(house, ANY, Shared { health, metrics }).unwrap();
    let start = Instant::now();
    let mut silent = connect(&serving);
    assert_eq!(get(&serving, "/health").status, 200);
    assert!(start.elapsed() >= house.stay);
    assert_eq!(silent.read(&mut [0; 16]).unwrap_or(0), 0);
}
