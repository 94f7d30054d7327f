//! Health and metrics, asked for over the wire.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::Duration;

use prometheus_parse::{Sample, Scrape, Value};

/// What a server answers to a plain request, as status and body.
///
/// # Panics
///
/// If it does not answer within ten seconds, or not by HTTP.
#[track_caller]
pub fn get(address: SocketAddr, path: &str) -> (u16, String) {
    let mut stream = TcpStream::connect(address).unwrap();
    let patience = Some(Duration::from_secs(10));
    stream.set_read_timeout(patience).unwrap();
    let request = format!("GET {path} HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
    stream.write_all(request.as_bytes()).unwrap();
    let mut answer = String::new();
    stream.read_to_string(&mut answer).unwrap();
    let (head, body) = answer.split_once("\r\n\r\n").expect("head and body");
    let status = head.split_whitespace().nth(1).and_then(|s| s.parse().ok());
    (status.expect("a status"), body.to_owned())
}

/// Metrics as a published parser reads them.
#[derive(Clone, Debug)]
pub struct Metrics {
    /// The text they were read from.
    pub text: String,
    samples: Vec<Sample>,
}

impl Metrics {
    /// Reads them.
    ///
    /// # Panics
    ///
    /// If the text is none that can be read.
    pub fn parse(text: &str) -> Self {
        let lines = text.lines().map(|line| Ok(line.to_owned()));
        Self {
            text: text.to_owned(),
            samples: Scrape::parse(lines).unwrap().samples,
        }
    }

    /// The value of a counter or gauge with these labels; `None` if it is not told.
    pub fn find(&self, name: &str, labels: &[(&str, &str)]) -> Option<f64> {
        self.samples_of(name, labels)
            .find_map(|sample| match sample.value {
                Value::Counter(value) | Value::Gauge(value) | Value::Untyped(value) => Some(value),
                _ => None,
            })
    }

    /// The value of a counter or gauge that must be told.
    ///
    /// # Panics
    ///
    /// If it is not, with all that is.
    #[track_caller]
    pub fn value(&self, name: &str, labels: &[(&str, &str)]) -> f64 {
        let found = self.find(name, labels);
        found.unwrap_or_else(|| panic!("{name} {labels:?} is not in\n{}", self.text))
    }

    /// How many values a histogram holds; 0 if it is not told.
    pub fn observed(&self, name: &str, labels: &[(&str, &str)]) -> f64 {
        let counts = self.samples_of(name, labels);
        let all = counts.filter_map(|sample| match &sample.value {
            Value::Histogram(buckets) => buckets.iter().map(|bucket| bucket.count).reduce(f64::max),
            _ => None,
        });
        all.sum()
    }

    /// Names of all that is told.
    pub fn names(&self) -> std::collections::BTreeSet<&str> {
        self.samples.iter().map(|s| s.metric.as_str()).collect()
    }

    fn samples_of<'a>(
        &'a self,
        name: &'a str,
        labels: &'a [(&str, &str)],
    ) -> impl Iterator<Item = &'a Sample> {
        self.samples.iter().filter(move |sample| {
            let fits = |(key, value): &(&str, &str)| sample.labels.get(key) == Some(value);
            sample.metric == name && labels.iter().all(fits)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "\
# HELP jobs Jobs.
# TYPE jobs counter
jobs_total{outcome=\"done\"} 3
jobs_total{outcome=\"gone\"} 1
# TYPE waiting gauge
waiting 7
# TYPE took_seconds histogram
took_seconds_sum{stage=\"read\"} 0.5
took_seconds_count{stage=\"read\"} 4
took_seconds_bucket{le=\"0.1\",stage=\"read\"} 3
took_seconds_bucket{le=\"+Inf\",stage=\"read\"} 4
# EOF
";

    #[test]
    fn counters_gauges_and_histograms_are_found_by_name_and_labels() {
        let metrics = Metrics::parse(TEXT);
        assert_eq!(metrics.value("jobs_total", &[("outcome", "gone")]), 1.0);
        assert_eq!(metrics.value("waiting", &[]), 7.0);
        assert_eq!(metrics.observed("took_seconds", &[("stage", "read")]), 4.0);
        assert_eq!(metrics.find("jobs_total", &[("outcome", "none")]), None);
    }
}
