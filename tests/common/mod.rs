//! What the end-to-end tests share: the program, built as people build it.

use std::process::Command;
use std::sync::OnceLock;

use escargot::{CargoBuild, CargoRun};

/// The program, ready to be given arguments. Built once a test binary, in the profile of the tests.
pub fn seamline() -> Command {
    static PROGRAM: OnceLock<CargoRun> = OnceLock::new();
    let program = PROGRAM.get_or_init(|| {
        CargoBuild::new()
            .manifest_path(concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml"))
            .package("seamline")
            .bin("seamline")
            .current_release()
            .run()
            .expect("the program builds")
    });
    program.command()
}
