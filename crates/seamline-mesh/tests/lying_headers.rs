//! Small files that promise thousands of millions of elements: none gets memory for more than its bytes.

#![cfg(target_os = "linux")]

use std::path::Path;

use seamline_mesh::read_bytes;

const MANY: u32 = 4_000_000_000;

/// The most address space this process ever had, in bytes. Memory that is set aside and never touched counts.
fn peak_bytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let line = status.lines().find(|line| line.starts_with("VmPeak:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1));
    1024 * kilobytes.unwrap().parse::<u64>().unwrap()
}

fn stl(count: u32) -> Vec<u8> {
    let mut bytes = vec![b' '; 80];
    bytes.extend(count.to_le_bytes());
    bytes.resize(1024, 0);
    bytes
}

/// A PLY of 1 kB: the elements of the header, then a payload that begins as given.
fn ply(format: &str, elements: &str, payload: &[u8]) -> Vec<u8> {
    let header = format!("ply\nformat {format} 1.0\n{elements}end_header\n");
    let mut bytes = [header.as_bytes(), payload].concat();
    bytes.resize(1024, if format == "ascii" { b'\n' } else { 0 });
    bytes
}

fn vertices(count: u32) -> String {
    format!("element vertex {count}\nproperty uchar x\nproperty uchar y\nproperty uchar z\n")
}

fn faces(count: u32, list: &str) -> String {
    format!("element face {count}\nproperty list {list} vertex_indices\n")
}

/// Files of which each makes one promise it does not keep.
fn lies() -> Vec<(String, Vec<u8>)> {
    let mut lies = vec![
        ("a.stl".to_owned(), stl(MANY)),
        ("b.stl".to_owned(), stl(u32::MAX)),
    ];
    for format in ["ascii", "binary_little_endian", "binary_big_endian"] {
        let many = match format {
            "ascii" => format!("0 0 0\n{MANY} 0 1 2\n").into_bytes(),
            "binary_big_endian" => [&[0; 3][..], &MANY.to_be_bytes()].concat(),
            _ => [&[0; 3][..], &MANY.to_le_bytes()].concat(),
        };
        let skipped = "element other 1\nproperty uchar a\nproperty uchar b\nproperty uchar c\n\
                       property list uint double w\n";
        for (what, elements) in [
            ("vertices", vertices(MANY) + &faces(1, "uchar int")),
            ("faces", vertices(1) + &faces(MANY, "uchar int")),
            (
                "others",
                format!("element other {}\nproperty uchar a\n", u64::MAX)
                    + &vertices(1)
                    + &faces(1, "uchar int"),
            ),
            ("corners", vertices(1) + &faces(1, "uint int")),
            ("unsigned corners", vertices(1) + &faces(1, "uint ushort")),
            (
                "items of a list nobody asked for",
                skipped.to_owned() + &vertices(1) + &faces(1, "uchar int"),
            ),
        ] {
            lies.push((
                format!("{format} {what}.ply"),
                ply(format, &elements, &many),
            ));
        }
    }
    for index in [i64::from(MANY), -i64::from(MANY), i64::MAX] {
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 {index}\n");
        lies.push((format!("{index}.obj"), text.into_bytes()));
    }
    lies
}

/// One test in this file, so that nothing else of the process takes memory meanwhile.
#[test]
fn no_promise_of_a_small_file_is_worth_memory() {
    // Whatever the first mesh of a process costs.
    let good = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    read_bytes(good.as_bytes(), Path::new("good.obj")).unwrap();
    for (name, bytes) in lies() {
        let before = peak_bytes();
        let error = read_bytes(&bytes, Path::new(&name)).expect_err(&name);
        let taken = peak_bytes() - before;
        assert!(taken < 256 << 20, "{name}: {taken} bytes for {error}");
        assert!(!error.to_string().contains('\n'), "{name}: {error}");
    }
}
