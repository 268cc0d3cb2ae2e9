//! `pompeiu completions`.

use crate::args::{Args, Completions};
use crate::exit::Exit;
use crate::printer::Printer;
use clap::CommandFactory;

pub(crate) fn run(args: &Completions) -> anyhow::Result<Exit> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Args::command(), "pompeiu", &mut script);
    Printer::answer(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Done)
}
