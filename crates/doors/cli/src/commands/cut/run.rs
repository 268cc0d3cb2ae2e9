//! Runs the command.

use super::args::Cut as Args;
use super::{json, text};
use crate::exit::Exit;
use crate::printer::Printer;
use crate::wait::Wait;
use crate::{files, surface};
use anyhow::{Context, bail};
use pompeiu::core::TriMesh;
use pompeiu::flatten::{Opened, choose_cut, open, straighten};
use std::time::{Duration, Instant};

/// What was done, for both kinds of answers.
pub(super) struct Outcome {
    pub(super) path: String,
    /// Vertices of the input.
    pub(super) vertices: usize,
    pub(super) opened: Opened,
    pub(super) edges: usize,
    pub(super) length: f64,
    pub(super) strategy: &'static str,
    pub(super) total: Duration,
}

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    if args.output.is_none() && !args.json {
        bail!("nothing would be written; name the result with -o, or ask for --json");
    }
    if let Some(output) = &args.output {
        files::check_writable(output)?;
        files::check_place(output, &[&args.mesh])?;
    }
    let shown = || args.mesh.display().to_string();
    let wait = Wait::new(printer);
    let (mut mesh, mut surface) = surface::read(&args.mesh, &wait, printer)?;
    wait.show("choosing edges".to_owned());
    let options = args.choice.options(&surface)?;
    let mut cut = choose_cut(&surface, &options).with_context(shown)?;
    if args.choice.straighten {
        let straight = straighten(&surface, &cut).with_context(shown)?;
        (mesh, surface, cut) = (straight.mesh, straight.surface, straight.cut);
    }
    let opened = open(surface.mesh(), &cut).with_context(shown)?;
    drop(wait);
    if let Some(output) = &args.output {
        let whole =
            TriMesh::new(opened.spread(mesh.positions()), opened.faces().to_vec()).with_context(shown)?;
        files::write(output, &whole, printer)?;
    }
    let edges: Vec<_> = surface.mesh().edge_ids().filter(|&edge| cut[edge]).collect();
    let outcome = Outcome {
        path: shown(),
        vertices: mesh.positions().len(),
        opened,
        edges: edges.len(),
        length: edges.iter().fold(0.0, |sum, &edge| sum + surface.surface().edge_length(edge)),
        strategy: options.strategy.name(),
        total: started.elapsed(),
    };
    Printer::answer(&if args.json { json::json(&outcome)? } else { text::text(&outcome) })?;
    Ok(Exit::Done)
}
