//! The same input gives the same bytes, on any number of threads.

use seamline_tests::samples::samples;

use crate::home::Home;

#[test]
fn one_two_and_eight_threads_write_the_same_bytes_but_for_the_times_in_the_report() {
    let home = Home::new();
    // One at a time: two of them are called shaft, and would end in one folder.
    let names: Vec<_> = samples().iter().map(|sample| sample.path).collect();
    names.iter().for_each(|name| drop(home.put_sample(name)));
    let written = |threads: u32| {
        let mut bytes = Vec::new();
        for name in &names {
            home.run(&format!(
                "segment {name} -q -o out{threads} --threads {threads}"
            ))
            .ended(0);
            let file_name = name.rsplit('/').next().unwrap_or(name);
            let results = format!("out{threads}/{file_name}.seamline");
            for file in ["labels.seg", "patches.ply", "boundaries.obj"] {
                bytes.push(home.read(&format!("{results}/{file}")));
            }
            let mut report = home.json(&format!("{results}/report.json"));
            let times = report
                .as_object_mut()
                .and_then(|keys| keys.remove("seconds"));
            assert!(times.is_some(), "the report has its times in one place");
            bytes.push(report.to_string().into_bytes());
        }
        bytes
    };
    let alone = written(1);
    for threads in [2, 8] {
        assert!(written(threads) == alone, "{threads} threads");
    }
}
