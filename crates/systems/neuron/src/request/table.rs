//! Tables of parameters.

use std::fmt;
use std::str::FromStr;

/// A table of parameters: values by names, as in TOML; as text `name = value, …`.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(transparent)]
pub struct ParameterTable(pub(super) toml::Table);

impl FromStr for ParameterTable {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let read: toml::Table = format!("table = {{ {text} }}")
            .parse()
            .map_err(|error: toml::de::Error| error.message().to_owned())?;
        match read.get("table") {
            Some(toml::Value::Table(table)) if read.len() == 1 => Ok(Self(table.clone())),
            _ => Err("expected values by names, such as diffusion = \"1 um^2/s\", steps = 100".to_owned()),
        }
    }
}

impl fmt::Display for ParameterTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let entries: Vec<String> = self.0.iter().map(|(name, value)| format!("{name} = {value}")).collect();
        f.write_str(&entries.join(", "))
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for ParameterTable {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "ParameterTable".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({ "type": "object", "description": "Values by names." })
    }
}
