//! `seamline status`: what became of every file.

use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

use anyhow::{Result, anyhow};
use humantime::{format_duration, format_rfc3339_millis};
use seamline_watch::ledger::{JobState, LedgerError, Reader, Row};
use seamline_watch::lock::holder;
use seamline_watch::{Config, ConfigFile, shown};
use serde_json::{Map, Value, json};

use crate::args::StatusArgs;
use crate::outcome::{Outcome, WrongUse};
use crate::say::{counted, print};
use crate::settings::pipeline_tables;

/// How many of the jobs that are done are named to a person.
const LATEST: usize = 10;

/// Prints what the ledger has, to a person or as JSON. The daemon may run meanwhile.
pub fn run(args: &StatusArgs) -> Result<Outcome> {
    let state = state_folder(&args.config)?;
    let ledger = Reader::open(&state).map_err(unusable)?;
    let (rows, counts) = (
        ledger.rows().map_err(unusable)?,
        ledger.counts().map_err(unusable)?,
    );
    let daemon = holder(&state);
    if args.json {
        let all = json!({
            "daemon": { "running": daemon.is_some(), "pid": daemon },
            "counts": counts_by_name(&counts),
            "jobs": rows.iter().map(as_json).collect::<Vec<_>>(),
        });
        print(&serde_json::to_string(&all)?)?;
    } else {
        tell(daemon, &counts, &rows)?;
    }
    Ok(Outcome::Done)
}

/// The folder of the ledger, of a configuration whose watched folders may be away.
pub fn state_folder(config: &Path) -> Result<PathBuf> {
    let file = ConfigFile::read(config, &pipeline_tables())?;
    Ok(Config::state_folder(&file)?)
}

/// A ledger that is not there is wrong use; one that fails is not.
pub fn unusable(error: LedgerError) -> anyhow::Error {
    let said = format!("{error}; {}", error.hint());
    match error {
        LedgerError::None { .. } => WrongUse(said).into(),
        _ => anyhow!(said),
    }
}

fn counts_by_name(counts: &[(JobState, u64)]) -> Map<String, Value> {
    let named = counts.iter();
    named
        .map(|(state, count)| (state.word().to_owned(), json!(count)))
        .collect()
}

fn as_json(row: &Row) -> Value {
    let path = |path: Option<&PathBuf>| path.map(|path| path.display().to_string());
    let time = |at: Option<SystemTime>| at.map(|at| format_rfc3339_millis(at).to_string());
    json!({
        "id": row.id.0,
        "path": row.path.to_string_lossy(),
        "relative": row.relative.to_string_lossy(),
        "state": row.state.word(),
        "content": row.content,
        "settings": row.settings,
        "attempts": row.attempts,
        "queued_at": time(Some(row.queued_at)),
        "started_at": time(row.started_at),
        "ended_at": time(row.ended_at),
        "stage": row.stage,
        "message": row.message,
        "hint": row.hint,
        "result": path(row.result.as_ref()),
        "source": path(row.source.as_ref()),
        "same_as": row.same_as.map(|id| id.0),
        "program_version": row.program_version,
    })
}

fn tell(daemon: Option<u32>, counts: &[(JobState, u64)], rows: &[Row]) -> Result<()> {
    print(&match daemon {
        Some(pid) => format!("running as process {pid}"),
        None => "not running".to_owned(),
    })?;
    let counts: Vec<_> = counts
        .iter()
        .map(|(state, count)| format!("{count} {}", state.word()))
        .collect();
    print(&counts.join(", "))?;
    for state in [
        JobState::Running,
        JobState::Pending,
        JobState::Quarantined,
        JobState::Done,
    ] {
        let of_state: Vec<_> = rows.iter().filter(|row| row.state == state).collect();
        let skipped = match state {
            JobState::Done => of_state.len().saturating_sub(LATEST),
            _ => 0,
        };
        if !of_state.is_empty() {
            print(&format_args!("\n{}", state.word()))?;
        }
        if skipped > 0 {
            let more = counted(skipped, "earlier job", "earlier jobs");
            print(&format_args!("  ({more}; --json tells all)"))?;
        }
        for row in &of_state[skipped..] {
            print(&line(row))?;
        }
    }
    Ok(())
}

fn line(row: &Row) -> String {
    let mut line = format!("  {:>5}  {}", row.id.0, shown(&row.path));
    let since = row.ended_at.or(row.started_at).unwrap_or(row.queued_at);
    if let Ok(ago) = since.elapsed() {
        let ago = Duration::from_secs(ago.as_secs());
        line += &format!("  {} ago", format_duration(ago));
    }
    if let Some(holder) = row.same_as {
        line += &format!("  (the same was cut in job {})", holder.0);
    }
    if let (Some(message), Some(hint)) = (&row.message, &row.hint) {
        let stage = row.stage.as_deref().unwrap_or_default();
        line += &format!("\n         {stage}: {message}; {hint}");
    }
    line
}
