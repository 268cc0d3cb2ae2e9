//! The tables of options in the guide, between `<!-- options of COMMAND -->` and `<!-- end of options -->`.

use super::options::{Described, options};
use super::{Visitor, compare, repository};
use crate::args::Args;
use crate::commands::visit_systems;
use crate::door::System;
use clap::{Command, CommandFactory};
use pompeiu::core::request::Request;
use serde_json::Value;
use std::fmt::Write;
use std::path::PathBuf;

const END: &str = "<!-- end of options -->";

/// The pages of the guide, with their paths.
struct Pages(Vec<(PathBuf, String)>);

impl Visitor for Pages {
    fn system<S: System>(&mut self) {
        let name = <S::Request as Request>::NAME;
        let head = format!("<!-- options of {name} -->\n");
        let page = self.0.iter_mut().find(|(_, text)| text.contains(&head));
        let (_, text) = page.unwrap_or_else(|| panic!("no page of the guide has `{}`", head.trim_end()));
        let start = text.find(&head).unwrap() + head.len();
        let end = start + text[start..].find(END).unwrap();
        let command = Args::command();
        let command = command.find_subcommand(name).unwrap_or_else(|| panic!("no command {name}"));
        text.replace_range(start..end, &table(command, &options::<S::Request>()));
    }
}

fn table(command: &Command, options: &[Described]) -> String {
    if options.is_empty() {
        return "\nIt has no options of its own beside limits and those of the output.\n\n".to_owned();
    }
    let mut text = "\n| option | in Python and files | default | meaning |\n|---|---|---|---|\n".to_owned();
    for option in options {
        let arg = command.get_arguments().find(|arg| arg.get_id() == option.name.as_str());
        let arg = arg.unwrap_or_else(|| panic!("{}: no argument {}", command.get_name(), option.name));
        let values: String = match arg.get_value_names() {
            Some(names) if arg.get_action().takes_values() && option.choices.is_empty() => {
                format!(" {}", names.join(" ").replace('|', "\\|"))
            }
            _ => String::new(),
        };
        let default = match &option.default {
            Value::Null => String::new(),
            Value::Array(values) if values.is_empty() => String::new(),
            Value::String(name) if name.is_empty() => String::new(),
            Value::String(name) => format!("`{name}`"),
            other => format!("`{other}`"),
        };
        let names = option.choices.iter().map(|one| format!("`{}`", one.name)).collect::<Vec<_>>();
        let choices = if names.is_empty() { String::new() } else { format!(": {}", names.join(", ")) };
        let meaning = option.description.replace('|', "\\|");
        let long = arg.get_long().unwrap_or_default();
        let _ = writeln!(text, "| `--{long}{values}` | `{}` | {default} | {meaning}{choices} |", option.name);
    }
    text.push('\n');
    text
}

#[test]
fn every_option_of_a_system_is_in_the_guide() {
    let folder = repository().join("docs/guide/pages");
    let mut pages: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    pages.retain(|path| path.extension().is_some_and(|suffix| suffix == "md"));
    pages.sort();
    let mut pages =
        Pages(pages.into_iter().map(|p| (p.clone(), std::fs::read_to_string(p).unwrap())).collect());
    visit_systems(&mut pages);
    for (path, text) in pages.0 {
        compare(&path, &text);
    }
}
