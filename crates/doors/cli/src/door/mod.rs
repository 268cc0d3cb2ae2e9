//! How a command asks a system: the request from the command line and `--config`, one session with one clock and one set of limits,
//! one answer, one rule for exit codes.
//!
//! A command is a struct of files, what goes in and out, with [`System`]: its options are those of the system's request.

mod config;
mod invocation;
mod session;

pub(crate) use invocation::Invocation;
pub(crate) use session::Session;

use crate::exit::Exit;
use crate::interrupt;
use crate::printer::Printer;
use clap::Args;
use pompeiu::core::request::{Answer, Request, Timing};
use pompeiu::options::{Options, OptionsError, options_of_toml};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::Path;
use std::time::Duration;

/// What a system reports.
pub(crate) type ReportOf<S> = <<S as System>::Request as Request>::Report;

/// What a command answers.
pub(crate) type AnswerOf<S> = Answer<<S as System>::Request, ReportOf<S>>;

#[cfg(test)]
pub(crate) use schemars::JsonSchema as Described;

/// What tests describe; anything.
#[cfg(not(test))]
pub(crate) trait Described {}

#[cfg(not(test))]
impl<T> Described for T {}

/// The files of a command and the text that a person reads. Everything else follows from the request of the system.
pub(crate) trait System: Args {
    /// What can be asked.
    type Request: Request<Report: Serialize + Described> + Args + Serialize + DeserializeOwned + Described;

    /// Refuses, before anything is read, files that cannot be read or written, and a run that would leave nothing.
    fn check(&self, json: bool) -> anyhow::Result<()>;

    /// The options in a file: TOML, unless a command knows another kind.
    fn options_in(_: &Path, text: &str) -> Result<Options, OptionsError> {
        options_of_toml(text)
    }

    /// A file of options that come before defaults and after those of `--config`; `is_given` tells what the command line has.
    ///
    /// # Errors
    /// If the files that are given do not go together.
    fn options_below(&self, is_given: impl Fn(&str) -> bool) -> anyhow::Result<Option<&Path>> {
        let _ = is_given;
        Ok(None)
    }

    /// Reads, computes and writes.
    fn run(&self, request: &mut Self::Request, session: &mut Session<'_>) -> anyhow::Result<ReportOf<Self>>;

    /// The answer for people.
    fn text(&self, answer: &AnswerOf<Self>) -> String;
}

/// A system whose files are written after its answer was printed, because they may take long.
pub(crate) trait Writes: System {
    /// What files are made of, beside the answer.
    type Found;

    /// Reads and computes.
    fn find(
        &self,
        request: &mut Self::Request,
        session: &mut Session<'_>,
    ) -> anyhow::Result<(ReportOf<Self>, Self::Found)>;

    /// Writes files.
    fn write(
        &self,
        answer: &AnswerOf<Self>,
        found: Self::Found,
        session: &mut Session<'_>,
    ) -> anyhow::Result<()>;

    /// The end of the answer for people: how long everything took, and writing alone.
    fn closing(&self, answer: &AnswerOf<Self>, total: Duration, writing: Duration) -> String;
}

/// Asks a system.
pub(crate) fn run<S: System>(invocation: &Invocation<S>, printer: &Printer) -> anyhow::Result<Exit> {
    let ask = |request: &mut S::Request, session: &mut Session<'_>| {
        Ok((invocation.system.run(request, session)?, ()))
    };
    let (answer, ..) = found(invocation, printer, ask)?;
    Printer::answer(&printed(invocation, &answer)?)?;
    Ok(Exit::of(&answer.report))
}

/// Asks a system, and writes files: after the text of the answer, and before its JSON, whose times include them.
pub(crate) fn run_and_write<S: Writes>(
    invocation: &Invocation<S>,
    printer: &Printer,
) -> anyhow::Result<Exit> {
    let Invocation { system, json, .. } = invocation;
    let ask = |request: &mut S::Request, session: &mut Session<'_>| system.find(request, session);
    let (mut answer, beside, mut session) = found(invocation, printer, ask)?;
    let text = printed(invocation, &answer)?;
    if *json {
        interrupt::print_if_ended(Some(text));
    } else {
        Printer::answer(&text)?;
    }
    let answered = session.elapsed();
    let written = system.write(&answer, beside, &mut session);
    session.stop_waiting();
    let total = session.elapsed();
    if *json {
        interrupt::print_if_ended(None);
        answer.timing.total = total;
        Printer::answer(&printed(invocation, &answer)?)?;
    }
    written?;
    if !json {
        Printer::answer(&system.closing(&answer, total, total.saturating_sub(answered)))?;
    }
    Ok(Exit::of(&answer.report))
}

/// The answer as it is printed.
fn printed<S: System>(invocation: &Invocation<S>, answer: &AnswerOf<S>) -> anyhow::Result<String> {
    Ok(if invocation.json { serde_json::to_string(answer)? + "\n" } else { invocation.system.text(answer) })
}

/// The report.
fn found<'s, S: System, F>(
    invocation: &'s Invocation<S>,
    printer: &'s Printer,
    ask: impl FnOnce(&mut S::Request, &mut Session<'_>) -> anyhow::Result<(ReportOf<S>, F)>,
) -> anyhow::Result<(AnswerOf<S>, F, Session<'s>)> {
    let Invocation { system, limits, json, .. } = invocation;
    let mut session = Session::start(limits, *json, printer);
    let mut request = invocation.request()?;
    system.check(*json)?;
    limits.apply_threads()?;
    let (report, found) = ask(&mut request, &mut session)?;
    session.stop_waiting();
    let timing = Timing { read: session.read_time(), total: session.elapsed() };
    let answer = Answer::new(session.inputs(*json), request, report, timing);
    Ok((answer, found, session))
}
