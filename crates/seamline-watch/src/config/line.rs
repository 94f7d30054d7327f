//! Where in a TOML text a key stands.

use toml::de::{DeTable, DeValue};

/// The line, from 1, on which a dotted key stands in a TOML text.
///
/// A number picks an element of an array, as in `watch.1.root`; without one, the first element that has
/// the key serves. Where the key itself is not written, the line of the nearest table above it is given;
/// nothing if not even that is there, or if the text is not TOML.
pub fn line_of_key(text: &str, dotted: &str) -> Option<usize> {
    let document = DeTable::parse(text).ok()?;
    let path: Vec<&str> = dotted.split('.').collect();
    let found = in_table(document.get_ref(), &path)?;
    Some(line_at(text, found.start))
}

/// The line, from 1, that holds a byte of the text.
pub(super) fn line_at(text: &str, byte: usize) -> usize {
    1 + text.bytes().take(byte).filter(|&b| b == b'\n').count()
}

struct Found {
    start: usize,
    whole: bool,
}

fn in_table(table: &DeTable<'_>, path: &[&str]) -> Option<Found> {
    let (first, rest) = path.split_first()?;
    let (key, value) = table.iter().find(|(key, _)| key.get_ref() == first)?;
    let here = Found {
        start: key.span().start,
        whole: rest.is_empty(),
    };
    if here.whole {
        return Some(here);
    }
    Some(in_value(value.get_ref(), rest).unwrap_or(here))
}

fn in_value(value: &DeValue<'_>, path: &[&str]) -> Option<Found> {
    match value {
        DeValue::Table(table) => in_table(table, path),
        DeValue::Array(elements) => match path.split_first() {
            Some((number, rest)) if let Ok(at) = number.parse::<usize>() => {
                let element = elements.get(at)?;
                let here = Found {
                    start: element.span().start,
                    whole: rest.is_empty(),
                };
                in_value(element.get_ref(), rest).or(Some(here))
            }
            _ => elements
                .iter()
                .find_map(|e| in_value(e.get_ref(), path).filter(|found| found.whole)),
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "\
# frame
[[watch]]
root = \"a\"

[[watch]]
root = \"b\"
stable_for_ms = 5

[merge]
threshold = 3
merge.deep = 1
";

    #[test]
    fn a_key_in_a_table_is_found_on_its_line() {
        assert_eq!(line_of_key(TEXT, "merge.threshold"), Some(10));
        assert_eq!(line_of_key(TEXT, "merge.merge.deep"), Some(11));
        assert_eq!(line_of_key(TEXT, "merge"), Some(9));
    }

    #[test]
    fn a_number_picks_an_element_of_an_array() {
        assert_eq!(line_of_key(TEXT, "watch.0.root"), Some(3));
        assert_eq!(line_of_key(TEXT, "watch.1.root"), Some(6));
    }

    #[test]
    fn without_a_number_the_first_element_with_the_key_serves() {
        assert_eq!(line_of_key(TEXT, "watch.stable_for_ms"), Some(7));
    }

    #[test]
    fn a_key_that_is_not_written_has_the_line_of_its_table() {
        assert_eq!(line_of_key(TEXT, "merge.regions"), Some(9));
        assert_eq!(line_of_key(TEXT, "watch.1.recursive"), Some(5));
        assert_eq!(line_of_key(TEXT, "output.dir"), None);
    }

    #[test]
    fn text_that_is_not_toml_has_no_lines() {
        assert_eq!(line_of_key("= 3", "a"), None);
    }
}
