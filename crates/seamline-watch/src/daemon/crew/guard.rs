//! Work that may panic.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::daemon::job::Failure;

/// Runs work that may panic; the panic is one failed job.
pub(super) fn guarded<T>(stage: &str, work: impl FnOnce() -> T) -> Result<T, Failure> {
    catch_unwind(AssertUnwindSafe(work)).map_err(|panic| {
        let said = panic.downcast_ref::<&str>().copied();
        let said = said.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
        let said = said.unwrap_or("no message").split_whitespace();
        Failure::new(
            stage,
            format!("panicked: {}", said.collect::<Vec<_>>().join(" ")),
            "this is a mistake in the program or a plugin: please report it with the file",
        )
    })
}
