//! Runs the command.

use super::args::Info;
use super::{json, text};
use crate::exit::Exit;
use crate::files;
use crate::printer::Printer;
use pompeiu::core::MeshSummary;

pub(crate) fn run(args: &Info, printer: &Printer) -> anyhow::Result<Exit> {
    let read = files::read(&args.file)?;
    let summary = MeshSummary::of(&read.mesh);
    files::warn_of_changes(&args.file, &read, printer);
    let path = args.file.display().to_string();
    Printer::answer(&if args.json {
        json::json(&path, &read, &summary)?
    } else {
        text::text(&path, &read, &summary)
    })?;
    Ok(Exit::Done)
}
