//! Options of requests from TOML, JSON and dictionaries: defaults under what is given, unknown names refused.

use pompeiu_core::request::Request;
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// Options by their names.
pub type Options = Map<String, Value>;

/// Options that cannot be used.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OptionsError {
    /// There is no option of this name.
    #[error("{command} has no option `{name}`; did you mean `{nearest}`?")]
    Unknown {
        /// The command.
        command: &'static str,
        /// The name.
        name: String,
        /// The name of an option that is most like it.
        nearest: String,
    },
    /// A value that is not what the option takes.
    #[error("option `{name}` of {command}: {message}")]
    Value {
        /// The command.
        command: &'static str,
        /// The name.
        name: String,
        /// What is wrong.
        message: String,
    },
    /// The text is no TOML.
    #[error("{0}")]
    Syntax(String),
}

/// The options of a request by their names, in the order of the struct. An option that is not set is null.
pub fn options_of<Q: Serialize>(request: &Q) -> Options {
    match serde_json::to_value(request) {
        Ok(Value::Object(options)) => options,
        // A request is a struct of plain data.
        _ => Options::new(),
    }
}

/// The options of a TOML file.
///
/// # Errors
/// [`OptionsError::Syntax`] with the line; a number that is not finite.
pub fn options_of_toml(text: &str) -> Result<Options, OptionsError> {
    let table: toml::Table =
        text.parse().map_err(|e: toml::de::Error| OptionsError::Syntax(e.to_string()))?;
    table.into_iter().map(|(name, value)| Ok((name, json(value)?))).collect()
}

/// JSON has no numbers that are not finite and no dates.
fn json(value: toml::Value) -> Result<Value, OptionsError> {
    Ok(match value {
        toml::Value::String(text) => Value::String(text),
        toml::Value::Integer(number) => number.into(),
        toml::Value::Float(number) if number.is_finite() => number.into(),
        toml::Value::Float(number) => {
            return Err(OptionsError::Syntax(format!("{number} is no finite number")));
        }
        toml::Value::Boolean(is) => Value::Bool(is),
        toml::Value::Datetime(date) => Value::String(date.to_string()),
        toml::Value::Array(values) => Value::Array(values.into_iter().map(json).collect::<Result<_, _>>()?),
        toml::Value::Table(table) => {
            let entry = |(name, value)| Ok((name, json(value)?));
            Value::Object(table.into_iter().map(entry).collect::<Result<_, _>>()?)
        }
    })
}

/// The request with these options, and defaults for all others.
///
/// # Errors
/// [`OptionsError::Unknown`] and [`OptionsError::Value`]. Whether values make sense together is for the system to say.
pub fn request_from<Q>(given: Options) -> Result<Q, OptionsError>
where
    Q: Request + Serialize + DeserializeOwned,
{
    let defaults = options_of(&Q::default());
    if let Some(name) = given.keys().find(|name| !defaults.contains_key(*name)) {
        return Err(OptionsError::Unknown {
            command: Q::NAME,
            name: name.clone(),
            nearest: nearest(name, defaults.keys()),
        });
    }
    let read = |options: Options| {
        let mut all = defaults.clone();
        all.extend(options);
        serde_json::from_value::<Q>(Value::Object(all))
    };
    read(given.clone()).map_err(|error| {
        let alone = given.into_iter().find_map(|(name, value)| {
            let error = read(Options::from_iter([(name.clone(), value)])).err()?;
            Some((name, error))
        });
        let (name, error) = alone.unwrap_or_else(|| (String::new(), error));
        OptionsError::Value { command: Q::NAME, name, message: plain(&error.to_string()) }
    })
}

/// Kinds of values as the reader calls them, and as people do.
const KINDS: [(&str, &str); 14] = [
    ("invalid type: ", "found "),
    ("invalid value: ", "found "),
    ("invalid length ", "found a sequence of length "),
    ("floating point `", "the number `"),
    ("integer `", "the number `"),
    ("string \"", "the text \""),
    ("boolean `", "`"),
    ("expected f64", "expected a number"),
    ("expected usize", "expected a whole number of at least 0"),
    ("expected u64", "expected a whole number of at least 0"),
    ("expected u32", "expected a whole number of at least 0"),
    ("expected a boolean", "expected true or false"),
    ("unknown variant ", "found "),
    ("expected struct ", "expected the fields of "),
];

/// What is wrong, in words for people.
fn plain(message: &str) -> String {
    KINDS.iter().fold(message.to_owned(), |text, (from, to)| text.replace(from, to))
}

fn nearest<'n>(name: &str, names: impl Iterator<Item = &'n String>) -> String {
    let likeness = |known: &&String| strsim::normalized_damerau_levenshtein(name, known);
    names.max_by(|a, b| likeness(a).total_cmp(&likeness(b))).cloned().unwrap_or_default()
}
