//! Answers go to stdout, everything else to stderr.

use anstyle::{AnsiColor, Style};
use anyhow::Context;
use std::fmt::Display;
use std::io::{self, Write};

const ERROR: Style = AnsiColor::Red.on_default().bold();
const WARNING: Style = AnsiColor::Yellow.on_default().bold();
/// For the names of quantities.
pub(crate) const LABEL: Style = Style::new().bold();

/// Where a command talks to. Colours appear on terminals only, and not if `NO_COLOR` is set.
pub(crate) struct Printer {
    quiet: bool,
}

impl Printer {
    pub(crate) fn new(quiet: bool) -> Self {
        Self { quiet }
    }

    /// Whether nothing but answers and errors is wanted.
    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// Writes the answer. That nobody reads on is not an error.
    pub(crate) fn answer(text: &str) -> anyhow::Result<()> {
        let mut out = anstream::stdout().lock();
        match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
            Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
            result => result.context("stdout: the answer could not be written"),
        }
    }

    /// Tells something that the user should know but did not ask.
    pub(crate) fn warning(&self, text: impl Display) {
        if !self.quiet {
            say("warning", WARNING, &text);
        }
    }

    /// Tells what was done.
    pub(crate) fn note(&self, text: impl Display) {
        if !self.quiet {
            let _ = writeln!(anstream::stderr(), "{}", on_one_line(&text));
        }
    }

    /// Tells what to do next.
    pub(crate) fn hint(text: &str) {
        let _ = writeln!(anstream::stderr(), "\n{}", on_one_line(&text));
    }

    /// Tells why there is no answer.
    pub(crate) fn error(error: &anyhow::Error) {
        say("error", ERROR, &sentence(error));
    }
}

/// The error and what lies behind it, without causes that it already tells.
fn sentence(error: &anyhow::Error) -> String {
    let mut text = error.to_string();
    for cause in error.chain().skip(1).map(ToString::to_string) {
        if !text.contains(&cause) {
            text = format!("{text}: {cause}");
        }
    }
    text
}

fn say(kind: &str, style: Style, text: &dyn Display) {
    // Where stderr is closed there is nobody to tell.
    let _ = writeln!(anstream::stderr(), "{style}{kind}:{style:#} {}", on_one_line(text));
}

/// File names and file contents may hold anything; a message is one line without control characters.
fn on_one_line(text: &dyn Display) -> String {
    let mut line = String::new();
    for c in text.to_string().chars() {
        if c.is_control() { line.extend(c.escape_default()) } else { line.push(c) }
    }
    line
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn causes_are_told_once() {
        let error = anyhow::anyhow!("no space").context("a.obj: no space").context("writing");
        assert_eq!(sentence(&error), "writing: a.obj: no space");
    }

    #[test]
    fn messages_stay_on_one_line() {
        assert_eq!(on_one_line(&"a\nb\u{1b}[31m é"), "a\\nb\\u{1b}[31m é");
    }
}
