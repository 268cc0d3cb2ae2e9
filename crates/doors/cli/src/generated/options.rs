//! The options of a request: their names, types, defaults and descriptions, from its JSON schema.

use clap::{Args, Command};
use pompeiu::core::request::Request;
use pompeiu::options::options_of;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::Serialize;
use serde_json::Value;

/// One of the values of an option.
pub(super) struct Choice {
    pub(super) name: String,
    pub(super) description: String,
}

/// An option.
pub(super) struct Described {
    pub(super) name: String,
    /// The first paragraph of the doc comment, without a full stop at its end.
    pub(super) description: String,
    pub(super) default: Value,
    /// The type in Python.
    pub(super) python: String,
    pub(super) choices: Vec<Choice>,
}

/// All options of a request, in the order of the help.
pub(super) fn options<Q: Request + Args + Serialize + JsonSchema>() -> Vec<Described> {
    let command = Q::augment_args(Command::new(Q::NAME));
    let place = |name: &str| command.get_arguments().position(|arg| arg.get_id() == name);
    let generator = SchemaSettings::draft2020_12().for_serialize().into_generator();
    let root = serde_json::to_value(generator.into_root_schema_for::<Q>()).unwrap();
    let described = |(name, default): (String, Value)| {
        let schema = &root["properties"][&name];
        assert!(schema.is_object(), "{}: no schema of {name}", Q::NAME);
        let description = schema["description"].as_str().unwrap_or_default();
        let description = description.split("\n\n").next().unwrap_or_default().replace('\n', " ");
        assert!(!description.is_empty(), "{}: {name} has no description", Q::NAME);
        let choices = choices(schema, &root);
        Described {
            description: description.trim_end_matches('.').to_owned(),
            python: python_type(schema, &root),
            name,
            default,
            choices,
        }
    };
    let mut options: Vec<Described> = options_of(&Q::default()).into_iter().map(described).collect();
    options.sort_by_key(|option| place(&option.name));
    options
}

/// A schema, or the one that it refers to.
fn resolved<'s>(schema: &'s Value, root: &'s Value) -> &'s Value {
    match schema["$ref"].as_str() {
        Some(path) => resolved(root.pointer(path.trim_start_matches('#')).unwrap(), root),
        None => schema,
    }
}

/// The names that an option takes, with their descriptions.
fn choices(schema: &Value, root: &Value) -> Vec<Choice> {
    let schema = resolved(schema, root);
    if let Some(names) = schema["enum"].as_array() {
        let named = names.iter().filter_map(Value::as_str);
        return named.map(|name| Choice { name: name.to_owned(), description: String::new() }).collect();
    }
    let one = |part: &Value| match part["const"].as_str() {
        Some(name) => {
            let description = part["description"].as_str().unwrap_or_default().trim_end_matches('.');
            vec![Choice { name: name.to_owned(), description: description.replace('\n', " ") }]
        }
        None => choices(part, root),
    };
    let parts = ["oneOf", "anyOf"].into_iter().filter_map(|key| schema[key].as_array()).flatten();
    parts.flat_map(one).collect()
}

/// The type that Python expects.
fn python_type(schema: &Value, root: &Value) -> String {
    let schema = resolved(schema, root);
    if !choices(schema, root).is_empty() && schema["anyOf"].is_null() {
        let names: Vec<String> =
            choices(schema, root).iter().map(|one| format!("\"{}\"", one.name)).collect();
        return format!("Literal[{}]", names.join(", "));
    }
    for key in ["anyOf", "oneOf"] {
        if let Some(parts) = schema[key].as_array() {
            return union(parts.iter().map(|part| python_type(part, root)).collect());
        }
    }
    match &schema["type"] {
        Value::Array(types) => union(types.iter().map(|one| named(one, schema, root)).collect()),
        one => named(one, schema, root),
    }
}

fn named(kind: &Value, schema: &Value, root: &Value) -> String {
    match kind.as_str().unwrap_or_default() {
        "boolean" => "bool".to_owned(),
        "integer" => "int".to_owned(),
        "number" => "float".to_owned(),
        "string" => "str".to_owned(),
        "null" => "None".to_owned(),
        "array" if schema["items"].is_object() => {
            format!("Sequence[{}]", python_type(&schema["items"], root))
        }
        "array" => format!("Sequence[{}]", python_type(&schema["prefixItems"][0], root)),
        "object" if schema["additionalProperties"].is_object() => {
            format!("Mapping[str, {}]", python_type(&schema["additionalProperties"], root))
        }
        "object" => "Mapping[str, Any]".to_owned(),
        _ => "Any".to_owned(),
    }
}

fn union(mut types: Vec<String>) -> String {
    types.dedup();
    let is_optional = types.iter().any(|one| one == "None");
    types.retain(|one| one != "None");
    let whole = if types.len() == 1 { types.remove(0) } else { format!("Union[{}]", types.join(", ")) };
    if is_optional { format!("Optional[{whole}]") } else { whole }
}
