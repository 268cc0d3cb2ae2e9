//! Runs the command.

use super::args::Couple as Args;
use super::scene::{self, Scene};
use super::{json, text};
use crate::exit::Exit;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{files, interrupt};
use pompeiu::coupling::scenario::RunReport;
use pompeiu::coupling::{CouplingOptions, Scheme};
use std::fmt::Write;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// What was found, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) scene: Scene,
    /// One run, or one for each scheme.
    pub(super) runs: Vec<RunReport>,
    pub(super) is_comparison: bool,
    /// From the command's start to its answer.
    pub(super) total: Duration,
}

/// Schemes that are compared, beside that of the scene.
const COMPARED: [Scheme; 7] = [
    Scheme::Fixed,
    Scheme::Constant(0.1),
    Scheme::Constant(0.01),
    Scheme::Aitken(0.5),
    Scheme::IqnIls,
    Scheme::IqnImvj,
    Scheme::TwoModels,
];

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let scene = scene::read(args)?;
    files::check_places(args.output.as_deref(), &[args.scene.as_path()])?;
    interrupt::listen();
    let wait = Wait::new(printer);
    let schemes =
        if args.compare { schemes_to_compare(scene.options.scheme) } else { vec![scene.options.scheme] };
    let mut table = String::from("window,quantity");
    let mut runs = Vec::with_capacity(schemes.len());
    for scheme in schemes {
        let options = CouplingOptions { scheme, ..scene.options.clone() };
        let report = scene.scenario.run(&options, scene.windows, &mut |window, x, y| {
            wait.show(format!("{}: window {window} of {}", scheme.name(), scene.windows));
            if args.output.is_some() {
                add_rows(&mut table, window, x, y);
            }
            let in_time = args.time_limit.is_none_or(|limit| started.elapsed() < limit);
            in_time && interrupt::flow() == ControlFlow::Continue(())
        })?;
        runs.push(report);
    }
    drop(wait);
    if let Some(path) = &args.output {
        files::write_whole(path, table.as_bytes(), printer)?;
    }
    let all = |run: &RunReport| run.windows.len() == scene.windows;
    let is_done = runs.iter().any(all);
    let outcome = Outcome { scene, runs, is_comparison: args.compare, total: started.elapsed() };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(if is_done { Exit::Done } else { Exit::Undecided })
}

fn schemes_to_compare(own: Scheme) -> Vec<Scheme> {
    let others = COMPARED.into_iter().filter(|scheme| *scheme != own);
    std::iter::once(own).chain(others).collect()
}

/// A row for each of the interface's data, with a column for each value.
fn add_rows(table: &mut String, window: usize, x: &[f64], y: &[f64]) {
    if window == 1 {
        for i in 0..x.len() {
            let _ = write!(table, ",{i}");
        }
        table.push('\n');
    }
    for (name, values) in [("x", x), ("y", y)] {
        let _ = write!(table, "{window},{name}");
        for value in values {
            let _ = write!(table, ",{value:?}");
        }
        table.push('\n');
    }
}
