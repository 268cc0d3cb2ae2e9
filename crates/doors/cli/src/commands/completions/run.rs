//! Runs the command.

use super::args::Completions;
use crate::args::Args;
use crate::exit::Exit;
use crate::printer::Printer;
use clap::CommandFactory;

pub(crate) fn run(args: &Completions, _printer: &Printer) -> anyhow::Result<Exit> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Args::command(), "pompeiu", &mut script);
    Printer::answer(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Done)
}
