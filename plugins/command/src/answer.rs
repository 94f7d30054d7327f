//! The answer of a program: where it ends, and what it says.

use std::io::Cursor;
use std::panic::catch_unwind;

use arrow_array::cast::AsArray;
use arrow_array::types::{Int32Type, Int64Type, UInt32Type, UInt64Type};
use arrow_array::{Array, RecordBatch};
use arrow_ipc::reader::StreamReader;
use arrow_ipc::root_as_message;
use arrow_schema::DataType;

use crate::fault::Fault;

/// What begins every message of a stream.
const CONTINUES: [u8; 4] = [0xFF; 4];

/// The longest description of a message that is believed.
const LONGEST_HEADER: usize = 1 << 20;

/// Bytes that an answer of so many rows may have: eight a row, and as much again for all that is about them.
fn longest(rows: usize) -> usize {
    16 * rows + LONGEST_HEADER
}

/// Reads one stream to its end and not a byte farther. `more` gives as many bytes as it is asked for.
///
/// Lengths are looked at before they are believed: a program that prints a greeting would else be waited for
/// until it has said as many bytes as its letters make up.
pub fn read_stream(
    rows: usize,
    mut more: impl FnMut(usize) -> Result<Vec<u8>, Fault>,
) -> Result<Vec<u8>, Fault> {
    let most = longest(rows);
    let mut stream = Vec::new();
    loop {
        let start = more(8)?;
        if start[..4] != CONTINUES {
            return Err(Fault::Garbage(format!(
                "it has {} where a message begins",
                shown(&start)
            )));
        }
        stream.extend_from_slice(&start);
        let header_len = u32::from_le_bytes([start[4], start[5], start[6], start[7]]) as usize;
        if header_len == 0 {
            return Ok(stream);
        }
        if header_len > LONGEST_HEADER {
            return Err(Fault::Garbage(format!("a message of {header_len} bytes")));
        }
        let header = more(header_len)?;
        let body_len = {
            let message =
                root_as_message(&header).map_err(|error| Fault::Garbage(one_line(&error)))?;
            usize::try_from(message.bodyLength())
                .map_err(|_| Fault::Garbage("a message of negative length".to_owned()))?
        };
        stream.extend_from_slice(&header);
        if body_len > most || stream.len() + body_len > most {
            return Err(Fault::TooLong(most));
        }
        stream.extend_from_slice(&more(body_len)?);
    }
}

/// The numbers of the one column of a stream.
pub fn numbers(stream: Vec<u8>, wanted: &'static str) -> Result<Vec<u32>, Fault> {
    // What is written wrongly on purpose may bring the reader to its limits.
    let read = catch_unwind(|| decode(stream, wanted));
    read.unwrap_or_else(|_| Err(Fault::Garbage("its parts contradict each other".to_owned())))
}

fn decode(stream: Vec<u8>, wanted: &'static str) -> Result<Vec<u32>, Fault> {
    let garbage = |error| Fault::Garbage(one_line(&error));
    let reader = StreamReader::try_new(Cursor::new(stream), None).map_err(garbage)?;
    let schema = reader.schema();
    let is_whole = |kind: &DataType| {
        use DataType::{Int32, Int64, UInt32, UInt64};
        matches!(kind, Int32 | Int64 | UInt32 | UInt64)
    };
    let right = match &schema.fields()[..] {
        [only] => only.name() == wanted && is_whole(only.data_type()),
        _ => false,
    };
    if !right {
        let columns: Vec<_> = schema
            .fields()
            .iter()
            .map(|field| format!("`{}`: {}", field.name(), field.data_type()))
            .collect();
        let found = match columns.len() {
            0 => "no column".to_owned(),
            1 => format!("the column {}", columns[0]),
            _ => format!("the columns {}", columns.join(", ")),
        };
        return Err(Fault::WrongColumns { found, wanted });
    }
    let mut numbers = Vec::new();
    for batch in reader {
        add(&batch.map_err(garbage)?, &mut numbers)?;
    }
    Ok(numbers)
}

/// Adds the rows of a batch.
fn add(batch: &RecordBatch, numbers: &mut Vec<u32>) -> Result<(), Fault> {
    let column = batch.column(0);
    let before = numbers.len();
    if let Some(row) = (0..column.len()).find(|&row| column.is_null(row)) {
        return Err(Fault::WrongValue {
            value: "nothing".to_owned(),
            row: before + row,
        });
    }
    let mut wrong = None;
    let mut put = |value: Result<u32, String>| match value {
        Ok(value) => numbers.push(value),
        Err(value) => {
            wrong.get_or_insert((value, numbers.len()));
            numbers.push(0);
        }
    };
    match column.data_type() {
        DataType::UInt32 => {
            let values = column.as_primitive::<UInt32Type>().values();
            values.iter().for_each(|&value| put(Ok(value)));
        }
        DataType::Int32 => {
            let values = column.as_primitive::<Int32Type>().values();
            values
                .iter()
                .for_each(|&v| put(u32::try_from(v).map_err(|_| v.to_string())));
        }
        DataType::UInt64 => {
            let values = column.as_primitive::<UInt64Type>().values();
            values
                .iter()
                .for_each(|&v| put(u32::try_from(v).map_err(|_| v.to_string())));
        }
        _ => {
            let values = column.as_primitive::<Int64Type>().values();
            values
                .iter()
                .for_each(|&v| put(u32::try_from(v).map_err(|_| v.to_string())));
        }
    }
    match wrong {
        None => Ok(()),
        Some((value, row)) => Err(Fault::WrongValue { value, row }),
    }
}

/// Bytes as a person reads them.
fn shown(bytes: &[u8]) -> String {
    format!("`{}`", bytes.escape_ascii())
}

fn one_line(error: &impl ToString) -> String {
    let text = error.to_string();
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use arrow_array::{ArrayRef, Float64Array, Int64Array, UInt32Array};
    use arrow_ipc::writer::StreamWriter;
    use proptest::prelude::*;

    use super::*;

    fn stream(name: &str, column: ArrayRef) -> Vec<u8> {
        let batch = RecordBatch::try_from_iter([(name, column)]).unwrap();
        let mut writer = StreamWriter::try_new(Vec::new(), &batch.schema()).unwrap();
        writer.write(&batch).unwrap();
        writer.finish().unwrap();
        writer.into_inner().unwrap()
    }

    fn read(bytes: &[u8], rows: usize) -> Result<Vec<u8>, Fault> {
        let mut left = bytes;
        read_stream(rows, |count| match left.split_at_checked(count) {
            Some((now, later)) => {
                left = later;
                Ok(now.to_vec())
            }
            None => Err(Fault::Silent(1.0)),
        })
    }

    fn answer(bytes: &[u8]) -> Result<Vec<u32>, Fault> {
        numbers(read(bytes, 1000)?, "cluster")
    }

    #[test]
    fn a_stream_is_read_to_its_end_and_no_farther() {
        let mut bytes = stream("cluster", Arc::new(UInt32Array::from(vec![3, 1, 2])));
        assert_eq!(answer(&bytes), Ok(vec![3, 1, 2]));
        let whole = bytes.len();
        bytes.extend_from_slice(b"the next mesh");
        assert_eq!(read(&bytes, 3).unwrap().len(), whole);
    }

    #[test]
    fn numpys_whole_numbers_serve_and_those_below_zero_do_not() {
        let column = |values: Vec<i64>| stream("cluster", Arc::new(Int64Array::from(values)));
        assert_eq!(answer(&column(vec![0, 7])), Ok(vec![0, 7]));
        let value = "-1".to_owned();
        assert_eq!(
            answer(&column(vec![0, -1])),
            Err(Fault::WrongValue { value, row: 1 })
        );
    }

    #[test]
    fn other_columns_gaps_and_greetings_are_named() {
        let real = stream("cluster", Arc::new(Float64Array::from(vec![1.0])));
        assert!(
            answer(&real)
                .unwrap_err()
                .to_string()
                .contains("`cluster`: Float64")
        );
        let other = stream("labels", Arc::new(UInt32Array::from(vec![1])));
        assert!(
            answer(&other)
                .unwrap_err()
                .to_string()
                .contains("`labels`: UInt32")
        );
        let gap = stream("cluster", Arc::new(UInt32Array::from(vec![Some(1), None])));
        assert_eq!(
            answer(&gap).unwrap_err().to_string(),
            "answered with nothing in row 1"
        );
        let greeting = answer(b"Hello, I am a classifier").unwrap_err().to_string();
        assert!(greeting.contains("`Hello, I`"), "{greeting}");
    }

    #[test]
    fn more_bytes_than_an_answer_needs_are_not_waited_for() {
        let long = stream("cluster", Arc::new(UInt32Array::from(vec![0; 1 << 20])));
        assert_eq!(read(&long, 10), Err(Fault::TooLong(longest(10))));
    }

    proptest! {
        #[test]
        fn whatever_is_written_wrongly_is_a_fault_and_no_panic(
            changes in prop::collection::vec((prop::num::usize::ANY, prop::num::u8::ANY), 1..8),
        ) {
            let mut bytes = stream("cluster", Arc::new(UInt32Array::from(vec![3, 1, 2])));
            for (at, byte) in changes {
                let at = at % bytes.len();
                bytes[at] = byte;
            }
            let _ = answer(&bytes);
        }
    }
}
