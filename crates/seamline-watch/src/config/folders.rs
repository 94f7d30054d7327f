//! Which folders may lie inside which: results must not come back as input.

use std::io;
use std::path::{Component, Path, PathBuf};

use seamline_ecs::settings::SettingsError;

use super::Config;

/// The same place with links resolved and `..` taken away, even where the end of it does not exist yet.
pub(super) fn resolve(path: &Path) -> io::Result<PathBuf> {
    let mut exists = path;
    loop {
        match exists.canonicalize() {
            Ok(start) => {
                let rest = path.strip_prefix(exists).unwrap_or(Path::new(""));
                return Ok(lexically(start, rest));
            }
            Err(error) => match exists.parent() {
                Some(parent) if error.kind() == io::ErrorKind::NotFound => {
                    exists = if parent.as_os_str().is_empty() {
                        Path::new(".")
                    } else {
                        parent
                    };
                    if exists == Path::new(".") {
                        return Ok(lexically(exists.canonicalize()?, path));
                    }
                }
                _ => return Err(error),
            },
        }
    }
}

fn lexically(start: PathBuf, rest: &Path) -> PathBuf {
    rest.components().fold(start, |mut at, part| {
        match part {
            Component::ParentDir => {
                at.pop();
            }
            Component::Normal(name) => at.push(name),
            _ => {}
        }
        at
    })
}

/// Refuses folders of which one would feed the other.
pub(super) fn check(config: &Config) -> Result<(), SettingsError> {
    for (at, watched) in config.watch.iter().enumerate() {
        let root = &watched.root;
        for (key, dir) in [
            ("output.dir", &config.output),
            ("state.dir", &config.state),
            ("quarantine.dir", &config.quarantine),
            ("done.dir", &config.done),
        ] {
            let seen_again = if watched.recursive {
                dir.starts_with(root)
            } else {
                dir == root && key != "output.dir"
            };
            if seen_again {
                return Err(SettingsError::new(
                    key,
                    format!(
                        "{} lies inside the watched folder {}",
                        dir.display(),
                        root.display()
                    ),
                    "what is put there would be taken as input: name a folder beside the watched one, \
                     or watch with `recursive = false`",
                ));
            }
        }
        for earlier in &config.watch[..at] {
            let twice = root == &earlier.root
                || (earlier.recursive && root.starts_with(&earlier.root))
                || (watched.recursive && earlier.root.starts_with(root));
            if twice {
                return Err(SettingsError::new(
                    format!("watch.{at}.root"),
                    format!(
                        "{} is watched already, by way of {}",
                        root.display(),
                        earlier.root.display()
                    ),
                    "name each folder once, with all patterns in one `include`",
                ));
            }
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_does_not_exist_yet_is_resolved_from_the_one_that_does() {
        let home = tempfile::tempdir().unwrap();
        let real = home.path().canonicalize().unwrap();
        std::fs::create_dir(real.join("a")).unwrap();
        assert_eq!(
            resolve(&real.join("a/../b/c/../d")).unwrap(),
            real.join("b/d")
        );
        assert_eq!(resolve(&real.join("a")).unwrap(), real.join("a"));
    }
}
