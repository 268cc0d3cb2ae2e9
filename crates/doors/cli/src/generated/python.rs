//! The functions of the Python package: what stands in their signatures after `*`, and what their docstrings say of it. The rest of a
//! function is written by hand.

use super::options::{Described, options};
use super::{Visitor, compare, repository};
use crate::commands::visit_systems;
use crate::door::System;
use clap::Args;
use pompeiu::core::request::{Limit, Request};
use pompeiu::hausdorff::DeviationMeasures;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::Value;
use std::fmt::Write;
use std::path::PathBuf;

/// Longest line of a docstring.
const WIDTH: usize = 120;

/// The modules of the package, with their paths.
struct Package(Vec<(PathBuf, String)>);

impl Visitor for Package {
    fn system<S: System>(&mut self) {
        self.remake::<S::Request>();
    }
}

impl Package {
    /// Makes the parts of a function anew that follow from its request.
    fn remake<Q: Request + Args + Serialize + JsonSchema>(&mut self) {
        let name = Q::NAME;
        let head = format!("\ndef {name}(\n");
        let (path, text) = self
            .0
            .iter_mut()
            .find(|(_, text)| text.contains(&head))
            .unwrap_or_else(|| panic!("no function {name} in the Python package"));
        let function = text.find(&head).unwrap();
        let body = text[function..].to_owned();
        let remade = function_of(&body, &options::<Q>(), Q::LIMITS);
        text.replace_range(function.., &remade.unwrap_or_else(|| panic!("{}: {name}", path.display())));
    }
}

/// A module from a function on, with the parts of the first function that follow from its request.
pub(super) fn function_of(text: &str, options: &[Described], limits: &[Limit]) -> Option<String> {
    let limits: Vec<(&str, &str, &str)> = limits.iter().map(|&limit| limit_of(limit)).collect();
    let signature = text.find("\n    *,\n")? + "\n    *,\n".len();
    let end = signature + text[signature..].find("\n) ->")? + 1;
    // Whether and how progress is told is the function's own affair.
    let progress = text[signature..end].lines().find(|line| line.starts_with("    progress:"));
    let mut made = text[..signature].to_owned();
    for Described { name, python, default, .. } in options {
        let parameter = format!("    {name}: {python} = {},\n", literal(default));
        // An option may also be given by its position.
        let head = format!("\n    {name}:");
        if let Some(start) = made[..signature].find(&head).map(|found| found + 1) {
            let end = start + made[start..].find('\n')? + 1;
            made.replace_range(start..end, &parameter);
        } else {
            made += &parameter;
        }
    }
    for (name, kind, _) in &limits {
        let _ = writeln!(made, "    {name}: Optional[{kind}] = None,");
    }
    if let Some(line) = progress {
        let _ = writeln!(made, "{line}");
    }
    let rest = &text[end..];
    let parameters =
        rest.find("    Parameters\n    ----------\n")? + "    Parameters\n    ----------\n".len();
    let close = parameters + rest[parameters..].find("\n\n    ")? + 1;
    made += &rest[..parameters];
    // Positional parameters come before the first option, progress after the last.
    let documented = &rest[parameters..close];
    let is_made = |line: &str| {
        let names = options.iter().map(|one| one.name.as_str()).chain(limits.iter().map(|one| one.0));
        names.into_iter().any(|name| line.starts_with(&format!("    {name} :")))
    };
    let entries = entries(documented);
    let (before, after): (Vec<&String>, Vec<&String>) = entries
        .iter()
        .filter(|entry| !is_made(entry))
        .partition(|entry| !entry.starts_with("    progress :"));
    made.extend(before.into_iter().map(String::as_str));
    for one in options {
        made += &documentation(one);
    }
    for (name, kind, description) in &limits {
        let _ = writeln!(made, "    {name} : {kind}, optional\n        {description}.");
    }
    made.extend(after.into_iter().map(String::as_str));
    Some(made + &rest[close..])
}

/// The entries of a list of parameters: a line with the name, then lines that are indented more.
fn entries(text: &str) -> Vec<String> {
    let mut entries: Vec<String> = Vec::new();
    for line in text.lines() {
        match entries.last_mut() {
            Some(last) if line.starts_with("        ") => {
                *last += line;
                last.push('\n');
            }
            _ => entries.push(format!("{line}\n")),
        }
    }
    entries
}

fn limit_of(limit: Limit) -> (&'static str, &'static str, &'static str) {
    match limit {
        Limit::Threads => (
            limit.name(),
            "int",
            "Threads to use; all processors by default. The answer does not depend on it",
        ),
        Limit::Time => (limit.name(), "float", "Stop after so many seconds with the answer found by then"),
        Limit::Memory => {
            (limit.name(), "int", "Stop before memory exceeds so many bytes, with the answer found by then")
        }
    }
}

/// A default as Python writes it.
fn literal(value: &Value) -> String {
    match value {
        Value::Null => "None".to_owned(),
        Value::Bool(is) => if *is { "True" } else { "False" }.to_owned(),
        Value::Array(values) if values.is_empty() => "()".to_owned(),
        Value::Array(values) => {
            format!("({})", values.iter().map(|one| literal(one) + ",").collect::<Vec<_>>().join(" "))
        }
        other => other.to_string(),
    }
}

fn documentation(option: &Described) -> String {
    let (kind, optional) = match option.python.strip_prefix("Optional[") {
        Some(inner) => {
            (inner.trim_end_matches(']').to_owned() + &"]".repeat(inner.matches('[').count()), ", optional")
        }
        None => (option.python.clone(), ""),
    };
    let kind = if kind.starts_with("Literal") { "str".to_owned() } else { kind };
    let text = format!("    {} : {kind}{optional}\n", option.name);
    let mut words = option.description.clone();
    let described: Vec<String> = option
        .choices
        .iter()
        .map(|one| match one.description.as_str() {
            "" => format!("``\"{}\"``", one.name),
            description => format!("``\"{}\"``: {}", one.name, lower(description)),
        })
        .collect();
    if !described.is_empty() {
        words += ". ";
        words += &described.join("; ");
    }
    words.push('.');
    text + &wrapped(&words, "        ")
}

/// A description within a sentence.
fn lower(text: &str) -> String {
    let mut letters = text.chars();
    let first = letters.next().map(|c| c.to_lowercase().to_string()).unwrap_or_default();
    // An abbreviation keeps its capitals.
    if letters.clone().next().is_some_and(char::is_uppercase) {
        text.to_owned()
    } else {
        first + letters.as_str()
    }
}

fn wrapped(words: &str, indent: &str) -> String {
    let (mut text, mut line) = (String::new(), indent.to_owned());
    for word in words.split_whitespace() {
        if line.chars().count() + 1 + word.chars().count() > WIDTH && line.len() > indent.len() {
            let _ = writeln!(text, "{}", line.trim_end());
            indent.clone_into(&mut line);
        }
        if line.len() > indent.len() {
            line.push(' ');
        }
        line += word;
    }
    let _ = writeln!(text, "{line}");
    text
}

#[test]
fn functions_of_the_python_package_follow_from_the_requests() {
    let folder = repository().join("python/pompeiu");
    let mut modules: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    modules.retain(|path| path.extension().is_some_and(|suffix| suffix == "py"));
    modules.sort();
    let read = |path: PathBuf| {
        let text = std::fs::read_to_string(&path).unwrap();
        (path, text)
    };
    let mut package = Package(modules.into_iter().map(read).collect());
    visit_systems(&mut package);
    // One direction of a deviation has no command.
    package.remake::<DeviationMeasures>();
    for (path, text) in package.0 {
        compare(&path, &text);
    }
}
