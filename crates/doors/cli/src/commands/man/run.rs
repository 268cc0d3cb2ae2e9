//! Runs the command.

use super::args::Man;
use crate::args::Args;
use crate::exit::Exit;
use crate::printer::Printer;
use anyhow::Context;
use clap::CommandFactory;

pub(crate) fn run(args: &Man, printer: &Printer) -> anyhow::Result<Exit> {
    let folder = &args.output;
    std::fs::create_dir_all(folder)
        .and_then(|()| clap_mangen::generate_to(Args::command(), folder))
        .with_context(|| format!("{}: the manual pages could not be written", folder.display()))?;
    printer.note(format_args!("{}: one page for each command, pompeiu.1 for all", folder.display()));
    Ok(Exit::Done)
}
