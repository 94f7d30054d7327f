//! Names made from other names, which have no more room than any name.

use std::ffi::{OsStr, OsString};
use std::os::unix::ffi::{OsStrExt, OsStringExt};

/// The longest name that file systems take, in bytes.
const MOST: usize = 255;

/// `name` with `suffix` behind it. Where that is too long, the end of `name` gives way to `~` and the start of
/// its BLAKE3, so that two long names stay two names, and the same name gives the same always.
pub(crate) fn fitted(name: &OsStr, suffix: &str) -> OsString {
    let bytes = name.as_bytes();
    let mut made = bytes.to_vec();
    if bytes.len() + suffix.len() > MOST {
        let hash = &blake3::hash(bytes).to_hex()[..12];
        let mut kept = MOST - suffix.len() - hash.len() - 1;
        let is_inside_a_character = |byte: u8| byte & 0xC0 == 0x80;
        while kept > 0 && is_inside_a_character(bytes[kept]) {
            kept -= 1;
        }
        made.truncate(kept);
        made.push(b'~');
        made.extend_from_slice(hash.as_bytes());
    }
    made.extend_from_slice(suffix.as_bytes());
    OsString::from_vec(made)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_with_room_behind_it_stays_as_it_is() {
        assert_eq!(
            fitted(OsStr::new("part.stl"), ".seamline"),
            "part.stl.seamline"
        );
        let long = "a".repeat(246);
        assert_eq!(
            fitted(OsStr::new(&long), ".seamline"),
            &*format!("{long}.seamline")
        );
    }

    #[test]
    fn long_names_fit_and_stay_apart() {
        let [a, b] = ["a.stl", "b.stl"].map(|end| "\u{e4}".repeat(125) + end);
        let [fit_a, fit_b] = [&a, &b].map(|name| fitted(OsStr::new(name), ".error.json"));
        assert!(fit_a.len() <= MOST && fit_a.len() > 250);
        assert!(
            fit_a
                .to_str()
                .is_some_and(|name| name.ends_with(".error.json"))
        );
        assert_ne!(fit_a, fit_b);
        assert_eq!(fit_a, fitted(OsStr::new(&a), ".error.json"));
    }
}
