//! Files that could not be cut, put aside with the reason beside them.

use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Serialize;

use crate::fitted::fitted;
use crate::outputs::{TEMPORARY_END, TEMPORARY_START};
use crate::relocate::{move_aside_with, sync_folder};

/// Why a file is in quarantine: what stands in `<name>.error.json`.
#[derive(Clone, Debug, Serialize)]
pub struct Reason<'a> {
    /// Where it failed: `read`, or a stage of the pipeline.
    pub stage: &'a str,
    /// What went wrong, in one line.
    pub message: &'a str,
    /// What would be right.
    pub hint: &'a str,
    /// Where the file was.
    pub path: String,
    /// BLAKE3 of its bytes in hexadecimal, where they could be read.
    pub blake3: Option<&'a str>,
    /// How often it was tried.
    pub attempts: u32,
    /// The version of the program.
    pub program_version: &'a str,
    /// The settings in force.
    pub settings: &'a toml::Table,
}

/// Moves a file to `quarantine/relative`, or to the first free name like it, with the reason beside it. The
/// reason is there before the file is, so that a crash leaves no file without one. The time of change is
/// kept. Gives the place.
///
/// # Errors
///
/// Whatever the file system refuses; the file is then where it was.
pub fn put_aside(
    quarantine: &Path,
    relative: &Path,
    source: &Path,
    reason: &Reason<'_>,
) -> io::Result<PathBuf> {
    let wanted = quarantine.join(relative);
    move_aside_with(source, &wanted, &|place| {
        write_reason(source, place, reason)
    })
}

fn write_reason(source: &Path, place: &Path, reason: &Reason<'_>) -> io::Result<()> {
    let folder = place.parent().unwrap_or(Path::new("."));
    let mut text = tempfile::Builder::new()
        .prefix(TEMPORARY_START)
        .suffix(TEMPORARY_END)
        .tempfile_in(folder)?;
    serde_json::to_writer_pretty(text.as_file_mut(), reason)?;
    text.write_all(b"\n")?;
    text.as_file()
        .set_permissions(fs::metadata(source)?.permissions())?;
    text.as_file().sync_all()?;
    text.persist(reason_beside(place))
        .map_err(|error| error.error)?;
    sync_folder(folder)
}

/// Where the reason for a file in quarantine stands.
pub fn reason_beside(place: &Path) -> PathBuf {
    place.with_file_name(fitted(place.file_name().unwrap_or_default(), ".error.json"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn reason(settings: &toml::Table) -> Reason<'_> {
        Reason {
            stage: "read",
            message: "line 3: not a number",
            hint: "export it again",
            path: "inbox/a/part.stl".to_owned(),
            blake3: Some("00ff"),
            attempts: 1,
            program_version: "1.2.3",
            settings,
        }
    }

    #[test]
    fn a_file_is_put_aside_under_its_path_with_the_reason_beside_it() {
        let home = tempfile::tempdir().unwrap();
        let source = home.path().join("part.stl");
        fs::write(&source, "x").unwrap();
        let settings = "[merge]\nthreshold = 2.5\n".parse().unwrap();
        let quarantine = home.path().join("quarantine");
        let place = put_aside(
            &quarantine,
            Path::new("a/part.stl"),
            &source,
            &reason(&settings),
        )
        .unwrap();

        assert_eq!(place, quarantine.join("a/part.stl"));
        assert_eq!(fs::read_to_string(&place).unwrap(), "x");
        assert!(!source.exists());
        let text = fs::read_to_string(quarantine.join("a/part.stl.error.json")).unwrap();
        let told: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(told["stage"], "read");
        assert_eq!(told["message"], "line 3: not a number");
        assert_eq!(told["attempts"], 1);
        assert_eq!(told["settings"]["merge"]["threshold"], 2.5);
        assert_eq!(fs::read_dir(place.parent().unwrap()).unwrap().count(), 2);
    }

    #[test]
    fn a_second_file_of_the_same_name_has_a_reason_of_its_own() {
        let home = tempfile::tempdir().unwrap();
        let settings = toml::Table::new();
        for name in ["part.stl", "part-1.stl"] {
            let source = home.path().join("part.stl");
            fs::write(&source, "x").unwrap();
            let place = put_aside(
                &home.path().join("q"),
                Path::new("part.stl"),
                &source,
                &reason(&settings),
            )
            .unwrap();
            assert_eq!(place.file_name().unwrap(), name);
            assert!(reason_beside(&place).exists());
        }
    }
}
