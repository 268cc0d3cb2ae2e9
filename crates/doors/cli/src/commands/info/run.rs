//! Runs the command.

use super::args::Info;
use super::{json, text};
use crate::exit::Exit;
use crate::files;
use crate::printer::Printer;
use pompeiu::core::MeshSummary;
use pompeiu::core::spatial::self_intersections;

/// Pairs of intersecting faces that are counted.
const MOST_PAIRS: usize = 10_000_000;

pub(crate) fn run(args: &Info, printer: &Printer) -> anyhow::Result<Exit> {
    let read = files::read(&args.file)?;
    let summary = MeshSummary::of(&read.mesh);
    let intersections = args.intersections.then(|| self_intersections(&read.mesh, MOST_PAIRS));
    files::warn_of_changes(&args.file, &read, printer);
    let path = args.file.display().to_string();
    Printer::answer(&if args.json {
        json::json(&path, &read, &summary, intersections.as_ref())?
    } else {
        text::text(&path, &read, &summary, intersections.as_ref())
    })?;
    Ok(Exit::Done)
}
