//! The help of the program: its commands under the jobs that people come with.

use super::{Args, STYLES};
use clap::{Command, CommandFactory, FromArgMatches};
use std::fmt::Write;

/// Each command under one job, in the order of the help.
const JOBS: [(&str, &[&str]); 6] = [
    ("Compare meshes", &["distance", "deviation", "app", "align", "rank", "matrix", "verify"]),
    ("Inspect and change meshes", &["info", "repair", "simplify", "remesh", "convert", "generate"]),
    ("Surfaces and what happens on them", &["flatten", "cut", "medial", "flow", "decompose", "fluid"]),
    ("Bodies and neurons", &["contact", "couple", "neuron"]),
    ("Drawings", &["puzzle", "complexity"]),
    ("The program itself", &["completions", "man", "help"]),
];

/// Columns of a line, and of the names before what commands do.
const WIDTH: usize = 80;
const NAMES: usize = 15;

/// What clap adds by itself.
const HELP: &str = "Print this message or the help of a command";

/// Reads the command line.
pub(crate) fn parse() -> Result<Args, clap::Error> {
    let command = Args::command();
    let template = format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{}{}Options:{:#}\n{{options}}{{after-help}}",
        listed(&command),
        STYLES.get_header(),
        STYLES.get_header()
    );
    let matches = command.help_template(template).try_get_matches()?;
    Args::from_arg_matches(&matches)
}

/// The commands with what they do, under their jobs.
fn listed(command: &Command) -> String {
    let (header, literal) = (STYLES.get_header(), STYLES.get_literal());
    let mut text = String::new();
    for (job, names) in JOBS {
        let _ = writeln!(text, "{header}{job}:{header:#}");
        for name in names {
            let about = command.find_subcommand(name).and_then(Command::get_about);
            let about = about.map_or_else(|| HELP.to_owned(), ToString::to_string);
            let room = " ".repeat(NAMES - 2 - name.len());
            let _ = writeln!(text, "  {literal}{name}{literal:#}{room}{}", wrapped(&about));
        }
        text.push('\n');
    }
    text
}

/// A sentence in lines that leave room for the names.
fn wrapped(sentence: &str) -> String {
    let mut lines = vec![String::new()];
    for word in sentence.split(' ') {
        let last = lines.len() - 1;
        if lines[last].is_empty() {
            lines[last].push_str(word);
        } else if NAMES + lines[last].chars().count() + 1 + word.chars().count() <= WIDTH {
            let _ = write!(lines[last], " {word}");
        } else {
            lines.push(word.to_owned());
        }
    }
    lines.join(&format!("\n{}", " ".repeat(NAMES)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn every_command_is_under_one_job() {
        let listed: Vec<&str> = JOBS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        let command = Args::command();
        let known = command.get_subcommands().map(Command::get_name).chain(["help"]);
        assert_eq!(listed.iter().copied().collect::<BTreeSet<_>>(), known.collect());
        assert_eq!(listed.len(), listed.iter().collect::<BTreeSet<_>>().len(), "none is there twice");
        assert!(
            super::listed(&command).lines().all(|line| line.chars().count() <= WIDTH + 20),
            "styles take some"
        );
    }
}
