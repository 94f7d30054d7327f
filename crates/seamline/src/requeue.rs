//! `seamline requeue`: jobs are done again.

use anyhow::Result;
use seamline_watch::ledger::{JobId, requeue};
use seamline_watch::shown;

use crate::args::RequeueArgs;
use crate::outcome::{Outcome, say_error};
use crate::say::{counted, print};
use crate::status::{state_folder, unusable};

/// Puts jobs back, each named with where its file is now. One that cannot be put back does not keep the others.
pub fn run(args: &RequeueArgs) -> Result<Outcome> {
    let state = state_folder(&args.config)?;
    let jobs: Vec<_> = args.jobs.iter().copied().map(JobId).collect();
    let jobs = (!args.all_quarantined).then_some(&jobs[..]);
    let mut failures = 0;
    let put_back = requeue(&state, jobs).map_err(unusable)?;
    for (id, result) in &put_back {
        match result {
            Ok(path) => print(&format_args!("{}  {}", id.0, shown(path)))?,
            Err(error) => {
                failures += 1;
                say_error(&format!("{error}; {}", error.hint()));
            }
        }
    }
    if put_back.is_empty() {
        print(&format_args!("{} in quarantine", counted(0, "job", "jobs")))?;
    }
    Ok(Outcome::of_failures(failures))
}
