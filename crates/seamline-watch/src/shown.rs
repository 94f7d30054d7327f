//! Names of files, as they are said.

use std::path::Path;

/// A path on one line: control characters are escaped, so that a name cannot pass for a line of its own.
pub fn shown(path: &Path) -> String {
    let escape = |c: char| {
        if c.is_control() {
            c.escape_default().to_string()
        } else {
            c.to_string()
        }
    };
    path.display().to_string().chars().map(escape).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_feed_in_a_name_does_not_begin_a_line() {
        assert_eq!(shown(Path::new("a\nb \u{e4}.stl")), "a\\nb \u{e4}.stl");
    }
}
