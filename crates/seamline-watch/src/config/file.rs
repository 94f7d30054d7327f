//! The file as it was written: text, lines and tables, and how a table of it is read.

use std::fs;
use std::path::{Path, PathBuf};

use seamline_ecs::SwappableStage;
use seamline_ecs::settings::{self, Profile, SettingsError, SettingsTable, StepSettings};
use toml::{Table, Value};

use super::ConfigError;
use super::frame::{
    DaemonTable, DoneTable, HttpTable, LimitsTable, LogTable, OutputTable, QuarantineTable,
    RetryTable, RuleTable, StateTable, WatchTable,
};

/// The tables of the frame besides the lists `[[watch]]` and `[[rules]]`.
pub(super) const FRAME: [fn() -> SettingsTable; 9] = [
    SettingsTable::of::<OutputTable>,
    SettingsTable::of::<StateTable>,
    SettingsTable::of::<QuarantineTable>,
    SettingsTable::of::<DoneTable>,
    SettingsTable::of::<DaemonTable>,
    SettingsTable::of::<LimitsTable>,
    SettingsTable::of::<RetryTable>,
    SettingsTable::of::<HttpTable>,
    SettingsTable::of::<LogTable>,
];

const LISTS: [&str; 2] = [WatchTable::TABLE, RuleTable::TABLE];

/// A configuration file that is TOML and holds no unknown table; its parts are checked by who needs them.
#[derive(Clone, Debug)]
pub struct ConfigFile {
    path: PathBuf,
    text: String,
    tables: Table,
}

impl ConfigFile {
    /// Reads a file. `pipeline_tables` are the tables that may stand beside the frame.
    ///
    /// # Errors
    ///
    /// A file that cannot be read, text that is not TOML, a top-level name that nobody knows.
    pub fn read(path: &Path, pipeline_tables: &[SettingsTable]) -> Result<Self, ConfigError> {
        let text = fs::read_to_string(path).map_err(|e| ConfigError::unreadable(path, &e))?;
        let tables: Table = text
            .parse()
            .map_err(|e| ConfigError::syntax(path, &text, &e))?;
        let file = Self {
            path: path.to_owned(),
            text,
            tables,
        };

        let frame: Vec<_> = FRAME.iter().map(|frame| frame().name).collect();
        let known = || {
            let pipeline = pipeline_tables.iter().map(|table| table.name);
            LISTS
                .into_iter()
                .chain(frame.iter().copied())
                .chain(pipeline)
        };
        for (name, value) in &file.tables {
            if known().all(|known| known != name) {
                let what = if matches!(value, Value::Table(_) | Value::Array(_)) {
                    "table"
                } else {
                    "key"
                };
                return Err(file.locate(SettingsError::unknown(name, what, name, known())));
            }
        }
        Ok(file)
    }

    /// The tables that belong to the pipeline. The folder a program is started in is relative to the file, and
    /// is told from here.
    pub fn pipeline_settings(&self) -> Table {
        let of_frame =
            |name: &str| LISTS.contains(&name) || FRAME.iter().any(|frame| frame().name == name);
        let pipeline = self.tables.iter().filter(|(name, _)| !of_frame(name));
        let mut pipeline: Table = pipeline
            .map(|(name, value)| (name.clone(), value.clone()))
            .collect();
        if let Some(Value::Table(choices)) = pipeline.get_mut("pipeline") {
            at_home(choices, self.path.parent().unwrap_or(Path::new("")));
        }
        pipeline
    }

    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    pub(super) fn tables(&self) -> &Table {
        &self.tables
    }

    /// Gives an error of the pipeline's settings its file and line.
    pub fn locate(&self, error: SettingsError) -> ConfigError {
        ConfigError::at(&self.path, &self.text, error)
    }

    /// The table of `S`, defaults filled in. `at` is where it stands: `output`, `watch.0`.
    pub(super) fn table<S: StepSettings>(
        &self,
        given: Option<&Value>,
        at: &str,
    ) -> Result<S, ConfigError> {
        read_table(given).map_err(|mut error: SettingsError| {
            error.key = error.key.replacen(S::TABLE, at, 1);
            self.locate(error)
        })
    }
}

/// Has the programs among the plugins chosen be started from `folder`.
pub(super) fn at_home(choices: &mut Table, folder: &Path) {
    for stage in SwappableStage::ALL {
        if let Some(Value::Table(command)) = choices.get_mut(stage.key()) {
            let given = command.get("folder").map_or(Some("."), Value::as_str);
            // What is no text is refused where it is read.
            if let Some(given) = given {
                let from_here = folder.join(given).display().to_string();
                command.insert("folder".to_owned(), Value::String(from_here));
            }
        }
    }
}

fn read_table<S: StepSettings>(given: Option<&Value>) -> Result<S, SettingsError> {
    let given = given.map(|table| (S::TABLE.to_owned(), table.clone()));
    let known = [SettingsTable::of::<S>()];
    settings::read(&settings::resolve(
        &known,
        Profile::Cad,
        &given.into_iter().collect(),
    )?)
}
