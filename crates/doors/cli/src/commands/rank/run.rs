//! Runs the command.

use super::args::{Align, Rank, RankDirection};
use super::{csv, json, text};
use crate::exit::Exit;
use crate::files;
use crate::interrupt;
use crate::many::{Fingerprint, Meshes, Notes, Problem, expand, fingerprint};
use crate::pair::File;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::{Context, bail};
use pompeiu::core::mesh::unreferenced_vertices;
use pompeiu::hausdorff::HausdorffOptions;
use pompeiu::matching::TaskProgress;
use pompeiu::matching::align::Alignment;
use pompeiu::matching::rank::{
    Measure, Outcome, RankOptions, Ranking, Report, Row, Status, Task, Template, perform, run as run_rounds,
};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Everything there is to report.
pub(super) struct Answer {
    pub(super) template: File,
    pub(super) options: RankOptions<'static>,
    pub(super) report: Report,
    /// Inputs that led to no target.
    pub(super) problems: Vec<Problem>,
    pub(super) total: Duration,
}

impl Answer {
    /// Where the targets stand, and then what led to none.
    pub(super) fn rows(&self) -> Vec<Row> {
        let standings = self.report.standings.iter().cloned().map(Row::from);
        let problems = self.problems.iter().map(|p| Row::failed(p.path.clone(), p.message.clone()));
        standings.chain(problems).collect()
    }
}

pub(crate) fn run(args: &Rank, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let mut options = options(args);
    options.check()?;
    args.many.limits.apply_threads()?;
    let inputs = expand(&args.targets, args.many.recursive);
    let read: Vec<&Path> =
        std::iter::once(&args.template).chain(&inputs.paths).map(PathBuf::as_path).collect();
    files::check_places(args.csv.iter().chain(&args.many.resume).map(PathBuf::as_path), &read)?;
    let wait = Wait::new(printer);
    let mesh = files::read_shown(&args.template, &wait, printer)?;
    wait.suspend(|| files::warn_of_unreferenced(&args.template, unreferenced_vertices(&mesh), printer));
    let file = File::new(&args.template, &mesh);
    let template = Template::new(mesh, &options).with_context(|| file.path.clone())?;
    if inputs.paths.is_empty() {
        drop(wait);
        Problem::report(&inputs.problems);
        bail!("there are no targets to rank");
    }
    let meshes = Meshes::new(inputs.paths, args.many.cache());
    let notes = args.many.resume.as_deref().map(|path| Notes::open(path, &meshes, &wait)).transpose()?;
    let template_fingerprint = notes.as_ref().map(|_| fingerprint(&args.template)).transpose();
    let template_fingerprint = template_fingerprint.with_context(|| args.template.display().to_string())?;
    options.limits = args.many.limits.after(started.elapsed());
    let report =
        rank(&template, &meshes, &options, notes.as_ref().zip(template_fingerprint.as_ref()), &wait)?;
    drop(wait);

    if let Some(notes) = &notes {
        notes.tell(printer);
    }
    let failed = report.standings.iter().filter_map(|standing| match &standing.status {
        Status::Failed(message) => Some(Problem { path: standing.name.clone(), message: message.clone() }),
        _ => None,
    });
    let failed: Vec<Problem> = failed.collect();
    Problem::report(&inputs.problems);
    Problem::report(&failed);
    let exit = match (failed.is_empty() && inputs.problems.is_empty(), report.open().next()) {
        (false, _) => Exit::Unusable,
        (true, None) => Exit::Done,
        (true, Some(_)) => Exit::Undecided,
    };
    let answer =
        Answer { template: file, options, report, problems: inputs.problems, total: started.elapsed() };
    if let Some(path) = &args.csv {
        files::write_whole(path, &csv::csv(&answer)?, printer)?;
    }
    Printer::answer(&if args.json { json::json(&answer)? } else { text::text(&answer) })?;
    Ok(exit)
}

fn options(args: &Rank) -> RankOptions<'static> {
    RankOptions {
        measure: match args.direction {
            RankDirection::Both => Measure::Symmetric,
            RankDirection::FromTemplate => Measure::TemplateToTarget,
            RankDirection::ToTemplate => Measure::TargetToTemplate,
        },
        alignment: match args.align {
            Align::None => Alignment::None,
            Align::Centroid => Alignment::Centroid,
            Align::Scale => Alignment::Scale,
            Align::Rigid => Alignment::Rigid,
        },
        top: args.top as usize,
        all: args.all,
        tolerance: args.tolerance.get(),
        ..RankOptions::default()
    }
}

fn rank(
    template: &Template,
    meshes: &Meshes,
    options: &RankOptions<'_>,
    notes: Option<(&Notes, &Fingerprint)>,
    wait: &Wait,
) -> anyhow::Result<Report> {
    let mut ranking = Ranking::new(meshes.names(), options)?;
    let work = |task: &Task, search: &HausdorffOptions<'_>| {
        // Results of tasks do not depend on how many places there are, but for what tasks ask.
        let question =
            notes.map(|(_, template)| ("rank", template, options.measure, options.alignment, &task.action));
        let known = notes.and_then(|(notes, _)| notes.get(&question, &[task.target]));
        known.unwrap_or_else(|| {
            let outcome = match meshes.mesh(task.target) {
                Ok(mesh) => {
                    let mut search = search.clone();
                    search.limits.memory = search.limits.memory.map(|m| m.saturating_sub(meshes.bytes()));
                    perform(template, &mesh, &task.action, &search)
                }
                Err(message) => Outcome::Failed(message),
            };
            if let Some((notes, _)) = notes.filter(|_| outcome.is_complete()) {
                notes.add(&question, &[task.target], &outcome);
            }
            outcome
        })
    };
    let show = |progress: &TaskProgress| {
        let message = format!("{} of {} settled", progress.settled, progress.meshes);
        wait.count(message, [progress.done, progress.tasks].map(|n| n as u64));
        interrupt::flow()
    };
    interrupt::listen();
    run_rounds(&mut ranking, &RankOptions { observer: Some(&show), ..options.clone() }, work, |ranking| {
        meshes.keep_only(|target| ranking.wants(target));
        wait.restart();
    })?;
    Ok(ranking.report())
}
