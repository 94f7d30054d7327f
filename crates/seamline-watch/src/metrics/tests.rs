use std::collections::HashSet;

use prometheus_parse::{Sample, Scrape, Value};

use super::*;

fn scrape(metrics: &Metrics) -> Scrape {
    let text = metrics.encode();
    Scrape::parse(text.lines().map(|line| Ok(line.to_owned()))).unwrap()
}

fn sample<'a>(scrape: &'a Scrape, name: &str, label: Option<(&str, &str)>) -> &'a Sample {
    let wanted = |sample: &&Sample| {
        sample.metric == name
            && label.is_none_or(|(key, value)| sample.labels.get(key) == Some(value))
    };
    let found: Vec<&Sample> = scrape.samples.iter().filter(wanted).collect();
    assert_eq!(found.len(), 1, "{name} {label:?}: {found:?}");
    found[0]
}

/// The parser takes counters for untyped, as their samples have `_total` and their announcement has not.
fn number(metrics: &Metrics, name: &str, label: Option<(&str, &str)>) -> f64 {
    match sample(&scrape(metrics), name, label).value {
        Value::Counter(number) | Value::Gauge(number) | Value::Untyped(number) => number,
        ref other => panic!("{name} is {other:?}"),
    }
}

#[test]
fn every_series_is_there_before_anything_happened() {
    let metrics = Metrics::new("1.2.3");
    for kind in OutcomeKind::ALL {
        let label = Some(("outcome", kind.name()));
        assert_eq!(number(&metrics, "seamline_jobs_total", label), 0.0);
    }
    for state in JobState::ALL {
        let label = Some(("state", state.word()));
        assert_eq!(number(&metrics, "seamline_ledger_jobs", label), 0.0);
    }
    for stage in stage_names() {
        let label = Some(("stage", stage));
        assert_eq!(number(&metrics, "seamline_stage_seconds_count", label), 0.0);
    }
    for result in ["ok", "refused"] {
        let label = Some(("result", result));
        assert_eq!(number(&metrics, "seamline_reloads_total", label), 0.0);
    }
    for state in ["present", "away"] {
        let label = Some(("state", state));
        assert_eq!(number(&metrics, "seamline_watch_folders", label), 0.0);
    }
    for name in [
        "seamline_job_seconds_count",
        "seamline_queue_jobs",
        "seamline_oldest_pending_seconds",
        "seamline_overflows_total",
        "seamline_scans_total",
        "seamline_read_bytes_total",
        "seamline_memory_reserved_bytes",
        "seamline_memory_limit_bytes",
        "seamline_paused",
        "seamline_abandoned_workers",
    ] {
        assert_eq!(number(&metrics, name, None), 0.0, "{name}");
    }
    let version = Some(("version", "1.2.3"));
    assert_eq!(number(&metrics, "seamline_build_info", version), 1.0);
}

#[test]
fn each_event_is_counted_where_it_belongs() {
    let metrics = Metrics::new("1.2.3");
    for (times, kind) in OutcomeKind::ALL.into_iter().enumerate() {
        (0..=times).for_each(|_| metrics.job_ended(kind));
    }
    metrics.read_bytes(1000);
    metrics.read_bytes(24);
    metrics.overflowed();
    metrics.scanned();
    metrics.scanned();
    metrics.reloaded(true);
    metrics.reloaded(false);
    metrics.reloaded(false);

    for (times, kind) in OutcomeKind::ALL.into_iter().enumerate() {
        let label = Some(("outcome", kind.name()));
        let count = number(&metrics, "seamline_jobs_total", label);
        assert_eq!(count, times as f64 + 1.0, "{kind:?}");
    }
    assert_eq!(number(&metrics, "seamline_read_bytes_total", None), 1024.0);
    assert_eq!(number(&metrics, "seamline_overflows_total", None), 1.0);
    assert_eq!(number(&metrics, "seamline_scans_total", None), 2.0);
    for (result, count) in [("ok", 1.0), ("refused", 2.0)] {
        let label = Some(("result", result));
        assert_eq!(number(&metrics, "seamline_reloads_total", label), count);
    }
}

#[test]
fn levels_rise_and_fall() {
    let metrics = Metrics::new("1.2.3");
    let states: Vec<_> = JobState::ALL.into_iter().zip(3..).collect();
    metrics.set_jobs(&states);
    metrics.set_jobs(&[(JobState::Running, 1)]);
    metrics.set_queue(7);
    metrics.set_queue(5);
    metrics.set_oldest_pending(Some(Duration::from_millis(1500)));
    metrics.set_reserved_bytes(1 << 40);
    metrics.set_limit_bytes(u64::MAX);
    metrics.set_folders(2, 1);
    metrics.set_paused(true);
    metrics.set_abandoned(4);

    for (state, count) in [("pending", 3.0), ("running", 1.0), ("gone", 7.0)] {
        let label = Some(("state", state));
        assert_eq!(number(&metrics, "seamline_ledger_jobs", label), count);
    }
    for (name, level) in [
        ("seamline_queue_jobs", 5.0),
        ("seamline_oldest_pending_seconds", 1.5),
        ("seamline_memory_reserved_bytes", (1_u64 << 40) as f64),
        ("seamline_memory_limit_bytes", i64::MAX as f64),
        ("seamline_paused", 1.0),
        ("seamline_abandoned_workers", 4.0),
    ] {
        assert_eq!(number(&metrics, name, None), level, "{name}");
    }
    for (state, count) in [("present", 2.0), ("away", 1.0)] {
        let label = Some(("state", state));
        assert_eq!(number(&metrics, "seamline_watch_folders", label), count);
    }

    metrics.set_oldest_pending(None);
    metrics.set_paused(false);
    assert_eq!(
        number(&metrics, "seamline_oldest_pending_seconds", None),
        0.0
    );
    assert_eq!(number(&metrics, "seamline_paused", None), 0.0);
}

#[test]
fn times_fall_into_their_buckets() {
    let metrics = Metrics::new("1.2.3");
    metrics.stage_took("read", Duration::from_micros(1500));
    metrics.stage_took("read", Duration::from_secs(3600));
    metrics.stage_took("grow", Duration::from_secs(1));
    metrics.job_took(Duration::from_secs(2));

    let scrape = scrape(&metrics);
    let buckets = sample(&scrape, "seamline_stage_seconds", Some(("stage", "read")));
    let Value::Histogram(buckets) = &buckets.value else {
        panic!("{buckets:?}");
    };
    assert_eq!(buckets.len(), BOUNDS.len() + 1);
    for bucket in buckets {
        let expected = match bucket.less_than {
            ..0.002 => 0.0,
            ..=600.0 => 1.0,
            _ => 2.0,
        };
        assert_eq!(bucket.count, expected, "{}", bucket.less_than);
    }
    let read = Some(("stage", "read"));
    let sum = number(&metrics, "seamline_stage_seconds_sum", read);
    assert!((sum - 3600.0015).abs() < 1e-9, "{sum}");
    let grow = Some(("stage", "grow"));
    assert_eq!(number(&metrics, "seamline_stage_seconds_count", grow), 1.0);
    assert_eq!(number(&metrics, "seamline_job_seconds_sum", None), 2.0);
}

#[test]
fn strange_stages_share_one_series() {
    let metrics = Metrics::new("1.2.3");
    for number in 0..100 {
        metrics.stage_took(&format!("stage {number}"), Duration::from_secs(1));
    }
    let other = Some(("stage", "other"));
    let count = number(&metrics, "seamline_stage_seconds_count", other);
    assert_eq!(count, 100.0);
    assert!(!metrics.encode().contains("stage 7"));
}

/// Two families of one name, or a sample before its announcement, make a scraper refuse the whole.
#[test]
fn every_family_is_announced_once_and_holds_its_samples_together() {
    let metrics = Metrics::new("1.2.3");
    let text = metrics.encode();
    assert!(text.ends_with("\n# EOF\n"));
    let mut announced = HashSet::new();
    let mut helped = HashSet::new();
    let mut family = "";
    let mut samples = HashSet::new();
    for line in text.trim_end_matches("# EOF\n").lines() {
        let words: Vec<&str> = line.split(' ').collect();
        match words[..] {
            ["#", "TYPE", name, _] => {
                assert!(announced.insert(name), "{name} is there twice");
                family = name;
            }
            ["#", "HELP", name, _, ..] => assert!(helped.insert(name), "{name} is there twice"),
            ["#", "UNIT", name, unit] => {
                assert_eq!(name, family);
                assert!(name.ends_with(&format!("_{unit}")));
            }
            [series, _] => {
                let end = series
                    .split('{')
                    .next()
                    .and_then(|name| name.strip_prefix(family));
                let ends = ["", "_total", "_sum", "_count", "_bucket"];
                assert!(
                    end.is_some_and(|end| ends.contains(&end)),
                    "{line} is not of {family}"
                );
                assert!(samples.insert(series), "{series} is there twice");
            }
            _ => panic!("{line}"),
        }
    }
    assert_eq!(announced, helped);
    assert_eq!(announced.len(), 16);
}
