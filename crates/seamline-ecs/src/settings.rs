//! Settings of the steps: tables with documented defaults, overlaid by what a person gives.
//!
//! Each step and each plugin has one table of its own name. A profile is nothing but a set of defaults.
//! What is given is checked against the defaults: an unknown key names the nearest known one, a value of
//! the wrong kind says what kind is right.

use schemars::{JsonSchema, Schema, schema_for};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use thiserror::Error;
use toml::{Table, Value};

/// Which set of defaults is in force.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Profile {
    /// For CAD tessellations: curvature on facets, relative distances.
    #[default]
    Cad,
    /// The paper as it stands: curvature at vertices, absolute distances.
    Lavoue2005,
}

/// The settings of one step: a table of the configuration.
///
/// Every field is always written, so that the defaults name every key there is; "none" is a value (zero,
/// as documented), never an absent key.
pub trait StepSettings:
    Serialize + DeserializeOwned + JsonSchema + Clone + Send + Sync + 'static
{
    /// The name of the table.
    const TABLE: &'static str;
    /// The keys whose value may be of another kind than its default, as a number or a word. What such a value
    /// may be is told by the field's type.
    const SEVERAL_KINDS: &'static [&'static str] = &[];

    /// What holds where nothing is given.
    fn defaults(profile: Profile) -> Self;

    /// Are the values in their ranges? The error names the key and what would be right.
    fn check(&self) -> Result<(), OutOfRange> {
        Ok(())
    }
}

/// A value of the right kind outside its range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfRange {
    /// The key within the table.
    pub key: &'static str,
    /// What would be right: `"an angle above 0 and below 180 degrees"`.
    pub wants: &'static str,
}

impl OutOfRange {
    /// Fails with `key` and `wants` unless `holds`.
    pub fn unless(holds: bool, key: &'static str, wants: &'static str) -> Result<(), Self> {
        if holds {
            Ok(())
        } else {
            Err(Self { key, wants })
        }
    }
}

/// What is wrong with a setting.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{key}: {reason}")]
pub struct SettingsError {
    /// The dotted key: `merge.threshold`.
    pub key: String,
    /// What is wrong with it.
    pub reason: String,
    /// What would be right.
    pub hint: String,
}

impl SettingsError {
    /// An error at `key`.
    pub fn new(key: impl Into<String>, reason: impl Into<String>, hint: impl Into<String>) -> Self {
        Self {
            key: key.into(),
            reason: reason.into(),
            hint: hint.into(),
        }
    }

    /// An unknown key or name, with the nearest of the known ones.
    pub fn unknown<'a>(
        key: impl Into<String>,
        what: &str,
        found: &str,
        known: impl IntoIterator<Item = &'a str>,
    ) -> Self {
        let known: Vec<_> = known.into_iter().collect();
        let hint = match nearest(found, known.iter().copied()) {
            Some(near) => format!("did you mean `{near}`?"),
            None => format!("known: {}", known.join(", ")),
        };
        Self::new(key, format!("unknown {what} `{found}`"), hint)
    }
}

/// The name most like `found`, if one is like it at all.
fn nearest<'a>(found: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    known
        .map(|name| (strsim::damerau_levenshtein(found, name), name))
        .filter(|&(distance, name)| distance <= 1 + name.len() / 3)
        .min()
        .map(|(_, name)| name)
}

/// [`StepSettings`] with the type rubbed off.
#[derive(Clone, Copy)]
pub struct SettingsTable {
    /// The name of the table.
    pub name: &'static str,
    /// Its defaults, every key present.
    pub defaults: fn(Profile) -> Table,
    /// Its JSON schema.
    pub schema: fn() -> Schema,
    several_kinds: &'static [&'static str],
    check: fn(&Table) -> Result<(), SettingsError>,
}

impl SettingsTable {
    /// The table of `S`.
    pub fn of<S: StepSettings>() -> Self {
        Self {
            name: S::TABLE,
            defaults: |profile| {
                Table::try_from(S::defaults(profile)).expect("settings are tables of plain values")
            },
            schema: || schema_for!(S),
            several_kinds: S::SEVERAL_KINDS,
            check: |in_force| read::<S>(in_force).map(|_| ()),
        }
    }
}

/// The settings of one step out of the tables in force ([`resolve`]).
pub fn read<S: StepSettings>(in_force: &Table) -> Result<S, SettingsError> {
    let table = in_force
        .get(S::TABLE)
        .cloned()
        .unwrap_or_else(|| Value::Table(Table::new()));
    let settings: S = table.try_into().map_err(|e: toml::de::Error| {
        SettingsError::new(
            S::TABLE,
            one_line(e.message()),
            "see `seamline plugins` and `seamline config schema`",
        )
    })?;
    settings.check().map_err(|OutOfRange { key, wants }| {
        SettingsError::new(
            format!("{}.{key}", S::TABLE),
            "out of range",
            format!("wants {wants}"),
        )
    })?;
    Ok(settings)
}

fn one_line(message: &str) -> String {
    message.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The defaults of all `known` tables, overlaid by what is `given`.
///
/// Errors: a table or key that no step has, a value of another kind than its default, a value out of range.
pub fn resolve(
    known: &[SettingsTable],
    profile: Profile,
    given: &Table,
) -> Result<Table, SettingsError> {
    let mut in_force: Table = known
        .iter()
        .map(|t| (t.name.to_owned(), Value::Table((t.defaults)(profile))))
        .collect();
    let several_kinds: Vec<String> = known
        .iter()
        .flat_map(|table| {
            table
                .several_kinds
                .iter()
                .map(|key| format!("{}.{key}", table.name))
        })
        .collect();
    overlay(&mut in_force, given, "", &several_kinds)?;
    for table in known {
        (table.check)(&in_force).map_err(|error| blame(table, profile, given, error))?;
    }
    Ok(in_force)
}

/// An error told of a table as a whole, such as a word that is none of those allowed, told of the key that is
/// refused on its own.
fn blame(
    table: &SettingsTable,
    profile: Profile,
    given: &Table,
    error: SettingsError,
) -> SettingsError {
    let given = given.get(table.name).and_then(Value::as_table);
    if error.key != table.name {
        return error;
    }
    let alone = |(key, value): (&String, &Value)| {
        let mut only = (table.defaults)(profile);
        only.insert(key.clone(), value.clone());
        let only = Table::from_iter([(table.name.to_owned(), Value::Table(only))]);
        (table.check)(&only)
            .err()
            .filter(|refused| refused.key == table.name)
            .map(|refused| SettingsError {
                key: format!("{}.{key}", table.name),
                ..refused
            })
    };
    given
        .and_then(|given| given.iter().find_map(alone))
        .unwrap_or(error)
}

fn overlay(
    base: &mut Table,
    given: &Table,
    prefix: &str,
    several_kinds: &[String],
) -> Result<(), SettingsError> {
    for (key, value) in given {
        let dotted = format!("{prefix}{key}");
        let Some(known) = base.get_mut(key) else {
            let what = if prefix.is_empty() { "table" } else { "key" };
            return Err(SettingsError::unknown(
                dotted,
                what,
                key,
                base.keys().map(String::as_str),
            ));
        };
        match (known, value) {
            (_, Value::Float(number)) if !number.is_finite() => {
                return Err(SettingsError::new(
                    dotted,
                    format!("is {number}"),
                    "wants a finite number",
                ));
            }
            (known @ Value::Float(_), Value::Integer(whole)) => {
                *known = Value::Float(*whole as f64)
            }
            (known, value) if several_kinds.contains(&dotted) => *known = value.clone(),
            (Value::Table(known), Value::Table(value)) => {
                overlay(known, value, &format!("{dotted}."), several_kinds)?
            }
            (known, value) if known.same_type(value) => *known = value.clone(),
            (known, value) => {
                return Err(SettingsError::new(
                    dotted,
                    format!("is {}", kind(value)),
                    format!("wants {}, as in `{key} = {known}`", kind(known)),
                ));
            }
        }
    }
    Ok(())
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::String(_) => "a text in quotes",
        Value::Integer(_) => "a whole number",
        Value::Float(_) => "a number",
        Value::Boolean(_) => "true or false",
        Value::Datetime(_) => "a date",
        Value::Array(_) => "a list",
        Value::Table(_) => "a table",
    }
}

/// Lays tables over tables: what `given` has replaces what `base` has, key by key.
pub fn lay_over(base: &mut Table, given: &Table) {
    for (key, value) in given {
        match (base.get_mut(key), value) {
            (Some(Value::Table(base)), Value::Table(given)) => lay_over(base, given),
            _ => {
                base.insert(key.clone(), value.clone());
            }
        }
    }
}

/// Sets one dotted key, as `--set KEY=VALUE` does. `text` is TOML; what is not TOML is taken as text.
pub fn set_dotted(table: &mut Table, dotted: &str, text: &str) -> Result<(), SettingsError> {
    let value = text
        .parse::<Value>()
        .unwrap_or_else(|_| Value::String(text.to_owned()));
    let (path, key) = dotted.rsplit_once('.').unwrap_or(("", dotted));
    let mut at = table;
    for part in path.split('.').filter(|part| !part.is_empty()) {
        let next = at.entry(part).or_insert_with(|| Value::Table(Table::new()));
        at = next.as_table_mut().ok_or_else(|| {
            SettingsError::new(
                dotted,
                format!("`{part}` is a value, not a table"),
                "wants TABLE.KEY=VALUE",
            )
        })?;
    }
    at.insert(key.to_owned(), value);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Serialize, Deserialize, JsonSchema, PartialEq, Debug)]
    #[serde(deny_unknown_fields)]
    struct Cut {
        angle_deg: f64,
        rounds: u32,
    }

    impl StepSettings for Cut {
        const TABLE: &'static str = "cut";
        fn defaults(profile: Profile) -> Self {
            Self {
                angle_deg: if profile == Profile::Cad { 40.0 } else { 30.0 },
                rounds: 2,
            }
        }
        fn check(&self) -> Result<(), OutOfRange> {
            OutOfRange::unless(
                self.angle_deg < 180.0,
                "angle_deg",
                "an angle below 180 degrees",
            )
        }
    }

    fn resolve_text(text: &str) -> Result<Cut, SettingsError> {
        let given = text.parse().unwrap();
        read(&resolve(
            &[SettingsTable::of::<Cut>()],
            Profile::Cad,
            &given,
        )?)
    }

    #[test]
    fn what_is_not_given_keeps_its_default() {
        assert_eq!(
            resolve_text("cut.rounds = 5").unwrap(),
            Cut {
                angle_deg: 40.0,
                rounds: 5
            }
        );
    }

    #[test]
    fn a_whole_number_serves_where_a_number_is_wanted() {
        assert_eq!(resolve_text("cut.angle_deg = 25").unwrap().angle_deg, 25.0);
    }

    #[test]
    fn an_unknown_key_names_the_nearest_known_one() {
        let error = resolve_text("cut.angel_deg = 25").unwrap_err();
        assert_eq!(error.key, "cut.angel_deg");
        assert_eq!(error.hint, "did you mean `angle_deg`?");
    }

    #[test]
    fn a_value_of_the_wrong_kind_says_what_kind_is_right() {
        let error = resolve_text("cut.rounds = 'two'").unwrap_err();
        assert_eq!(error.to_string(), "cut.rounds: is a text in quotes");
        assert_eq!(error.hint, "wants a whole number, as in `rounds = 2`");
    }

    #[test]
    fn a_value_out_of_range_names_its_key() {
        assert_eq!(
            resolve_text("cut.angle_deg = 200").unwrap_err().key,
            "cut.angle_deg"
        );
    }

    #[test]
    fn a_dotted_key_reaches_into_tables() {
        let mut table = Table::new();
        set_dotted(&mut table, "cut.angle_deg", "25.5").unwrap();
        set_dotted(&mut table, "pipeline.classifier", "kmeans").unwrap();
        assert_eq!(table["cut"]["angle_deg"].as_float(), Some(25.5));
        assert_eq!(table["pipeline"]["classifier"].as_str(), Some("kmeans"));
    }
}
