//! A classifier as a program of its own, which does right or wrong as it is told: `fickle_plugin MANNER`.
//!
//! Right: `good` (a cluster for the flat and one for the rest), `once` (the same, and ends after each mesh), `all`
//! (the same for a rectifier: labels as they are). Everything else is wrong in the way it is called.

use std::error::Error;
use std::io::{Read, Stdin, Write, stdin, stdout};
use std::process::exit;
use std::sync::Arc;
use std::thread::sleep;
use std::time::Duration;

use arrow_array::cast::AsArray;
use arrow_array::types::{Float64Type, UInt32Type};
use arrow_array::{ArrayRef, Int64Array, RecordBatch, StringArray, UInt32Array};
use arrow_ipc::reader::StreamReader;
use arrow_ipc::writer::StreamWriter;

type Answer<T> = Result<T, Box<dyn Error>>;

fn main() -> Answer<()> {
    let manner = std::env::args().nth(1).unwrap_or_default();
    let mut meshes = 0;
    while let Some(tables) = next_mesh(&manner)? {
        meshes += 1;
        if manner == "dies-on-second" && meshes == 2 {
            exit(3);
        }
        answer(&manner, &tables)?;
        if manner == "once" {
            break;
        }
    }
    Ok(())
}

/// The tables of the next mesh; nothing at the end of the input.
fn next_mesh(manner: &str) -> Answer<Option<Vec<RecordBatch>>> {
    match manner {
        "leaves" => {
            eprintln!("I do not like this mesh");
            exit(7);
        }
        "leaves-unread" => exit(0),
        _ => {}
    }
    let mut input = stdin();
    let mut tables = Vec::new();
    loop {
        let Some(table) = next_table(&mut input)? else {
            return Ok(None);
        };
        let about = table.schema_ref().metadata().clone();
        let all = about["seamline.tables"].split(',').count();
        tables.push(table);
        if tables.len() == all {
            return Ok(Some(tables));
        }
    }
}

fn next_table(input: &mut Stdin) -> Answer<Option<RecordBatch>> {
    // A reader of streams takes the end of the input for an error, so that it is looked for first.
    let mut first = [0; 1];
    if input.read(&mut first)? == 0 {
        return Ok(None);
    }
    let mut reader = StreamReader::try_new(first.chain(input), None)?;
    let table = reader.next().ok_or("a table without rows")??;
    if reader.next().is_some() {
        return Err("a table in parts".into());
    }
    Ok(Some(table))
}

fn answer(manner: &str, tables: &[RecordBatch]) -> Answer<()> {
    let table = &tables[0];
    let rows = table.num_rows() as u32;
    eprintln!("{rows} rows to look at");
    let whole = |values: Vec<u32>| Arc::new(UInt32Array::from(values)) as ArrayRef;
    let zeros = |count: u32| whole(vec![0; count as usize]);
    let (name, column) = match manner {
        "all" => {
            let labels = table.column_by_name("label").ok_or("no labels")?;
            (
                "label",
                whole(labels.as_primitive::<UInt32Type>().values().to_vec()),
            )
        }
        "garbage" => {
            return Ok(writeln!(
                stdout(),
                "Hello! I have classified {rows} samples."
            )?);
        }
        "silent" => {
            sleep(Duration::from_secs(600));
            return Ok(());
        }
        "endless" => loop {
            stdout().write_all(&[0xFF; 4096])?;
        },
        "half" => {
            let stream = stream("cluster", zeros(rows))?;
            stdout().write_all(&stream[..stream.len() / 2])?;
            stdout().flush()?;
            exit(0);
        }
        "short" => ("cluster", zeros(rows.saturating_sub(1))),
        "long" => ("cluster", zeros(rows + 1)),
        "empty" => ("cluster", zeros(0)),
        "out-of-range" => ("cluster", whole((1..=rows).collect())),
        "negative" => (
            "cluster",
            Arc::new(Int64Array::from(vec![-1; rows as usize])) as ArrayRef,
        ),
        "gaps" => {
            let gaps: UInt32Array = (0..rows).map(|row| (row > 0).then_some(0)).collect();
            ("cluster", Arc::new(gaps) as ArrayRef)
        }
        "text" => {
            let words = StringArray::from_iter_values((0..rows).map(|_| "flat"));
            ("cluster", Arc::new(words) as ArrayRef)
        }
        "misnamed" => ("klusters", zeros(rows)),
        "forgetful" => {
            // Other clusters each time.
            let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH)?;
            let turn = now.subsec_micros();
            (
                "cluster",
                whole(
                    (0..rows)
                        .map(|row| (row * 7 + turn) % rows.min(5))
                        .collect(),
                ),
            )
        }
        _ => {
            let curvature = table.column_by_name("k_max").ok_or("no curvature")?;
            let curvature = curvature.as_primitive::<Float64Type>().values();
            (
                "cluster",
                whole(
                    curvature
                        .iter()
                        .map(|&k| u32::from(k > 0.1 && rows > 1))
                        .collect(),
                ),
            )
        }
    };
    stdout().write_all(&stream(name, column)?)?;
    stdout().flush()?;
    eprintln!("answered for {rows} rows");
    Ok(())
}

fn stream(name: &str, column: ArrayRef) -> Answer<Vec<u8>> {
    let table = RecordBatch::try_from_iter([(name, column)])?;
    let mut writer = StreamWriter::try_new(Vec::new(), &table.schema())?;
    writer.write(&table)?;
    writer.finish()?;
    Ok(writer.into_inner()?)
}
