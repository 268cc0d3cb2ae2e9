//! Runs the command.

use super::args::{Align, Rank, RankDirection};
use super::{csv, json, text};
use crate::exit::Exit;
use crate::files;
use crate::many::{Fingerprint, Journal, Meshes, Problem, expand, fingerprint};
use crate::pair::File;
use crate::printer::Printer;
use crate::threads::use_threads;
use crate::wait::Wait;
use anyhow::{Context, bail};
use pompeiu::core::mesh::unreferenced_vertices;
use pompeiu::matching::align::Alignment;
use pompeiu::matching::rank::{
    Measure, Options, Outcome, Ranking, Report, Row, Status, Task, Template, perform, run as run_rounds,
};
use rayon::prelude::*;
use std::path::PathBuf;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Everything there is to report.
pub(super) struct Answer {
    pub(super) template: File,
    pub(super) options: Options,
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
    let options = options(args);
    options.check()?;
    if let Some(threads) = args.many.threads {
        use_threads(threads)?;
    }
    let inputs = expand(&args.targets, args.many.recursive);
    if let Some(path) = &args.csv {
        if args.many.resume.as_ref() == Some(path) {
            bail!("{}: is both table and journal; give one of them another name", path.display());
        }
        let read = std::iter::once(&args.template).chain(&inputs.paths).chain(&args.many.resume);
        files::check_place(path, &read.map(PathBuf::as_path).collect::<Vec<_>>())?;
    }
    let wait = Wait::new(printer);
    wait.show(format!("reading {}", args.template.display()));
    let read = files::read(&args.template)?;
    wait.suspend(|| {
        files::warn_of_changes(&args.template, &read, printer);
        files::warn_of_unreferenced(&args.template, unreferenced_vertices(&read.mesh), printer);
    });
    let file = File::new(&args.template, &read.mesh);
    let template = Template::new(read.mesh, &options).with_context(|| file.path.clone())?;
    if inputs.paths.is_empty() {
        drop(wait);
        Problem::report(&inputs.problems);
        bail!("there are no targets to rank");
    }
    let meshes = Meshes::new(inputs.paths, args.many.cache);
    let journal = args.many.resume.as_deref().map(Journal::open).transpose()?;
    let notes = journal.map(|journal| Notes::new(journal, args, &options, &meshes, &wait)).transpose()?;
    let report = rank(&template, &meshes, notes.as_ref(), &wait)?;
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
    let any_failed = !failed.is_empty() || !inputs.problems.is_empty();
    let answer =
        Answer { template: file, options, report, problems: inputs.problems, total: started.elapsed() };
    if let Some(path) = &args.csv {
        files::write_whole(path, &csv::csv(&answer)?, printer)?;
    }
    Printer::answer(&if args.json { json::json(&answer)? } else { text::text(&answer) })?;
    Ok(if any_failed { Exit::Unusable } else { Exit::Done })
}

fn options(args: &Rank) -> Options {
    Options {
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
        tolerance: args.tolerance,
    }
}

fn rank(template: &Template, meshes: &Meshes, notes: Option<&Notes>, wait: &Wait) -> anyhow::Result<Report> {
    let mut ranking = Ranking::new(meshes.names(), template.options())?;
    let targets = meshes.paths().len();
    let done = AtomicU64::new(0);
    let settled = AtomicU64::new(0);
    let tasks = AtomicU64::new(ranking.round().len() as u64);
    let work = |task: &Task| {
        let outcome = match meshes.mesh(task.target) {
            Ok(mesh) => perform(template, &mesh, &task.action),
            Err(message) => Outcome::Failed(message),
        };
        if let (Some(notes), false) = (notes, matches!(outcome, Outcome::Failed(_))) {
            notes.add(task, &outcome);
        }
        outcome
    };
    let noted = |task: &Task| {
        let outcome = notes.and_then(|notes| notes.get(task)).unwrap_or_else(|| work(task));
        let settled = settled.load(Ordering::Relaxed);
        wait.count(
            format!("{settled} of {targets} settled"),
            [done.fetch_add(1, Ordering::Relaxed) + 1, tasks.load(Ordering::Relaxed)],
        );
        outcome
    };
    run_rounds(&mut ranking, noted, |ranking| {
        meshes.keep_only(|target| ranking.wants(target));
        settled.store(ranking.settled() as u64, Ordering::Relaxed);
        tasks.store(ranking.round().len() as u64, Ordering::Relaxed);
        done.store(0, Ordering::Relaxed);
        wait.restart();
    })?;
    Ok(ranking.report())
}

/// The journal of a ranking.
struct Notes {
    journal: Journal,
    template: Fingerprint,
    /// None for files that cannot be read.
    targets: Vec<Option<Fingerprint>>,
    options: String,
    taken: AtomicU64,
    /// The first result that could not be noted.
    problem: OnceLock<anyhow::Error>,
}

impl Notes {
    fn new(
        journal: Journal,
        args: &Rank,
        options: &Options,
        meshes: &Meshes,
        wait: &Wait,
    ) -> anyhow::Result<Self> {
        wait.show("looking for what was done before".to_owned());
        let template = fingerprint(&args.template).with_context(|| args.template.display().to_string())?;
        let targets = meshes.paths().par_iter().map(|path| fingerprint(path).ok()).collect();
        // Results of tasks do not depend on how many places there are, but for what tasks ask.
        let options = serde_json::to_string(&(options.measure, options.alignment))?;
        Ok(Self { journal, template, targets, options, taken: AtomicU64::new(0), problem: OnceLock::new() })
    }

    fn key(&self, task: &Task) -> Option<String> {
        let target = self.targets[task.target].as_ref()?;
        Journal::key(&("rank", &self.template, target, &self.options, &task.action)).ok()
    }

    fn get(&self, task: &Task) -> Option<Outcome> {
        let found = self.journal.get(&self.key(task)?)?;
        self.taken.fetch_add(1, Ordering::Relaxed);
        Some(found)
    }

    fn add(&self, task: &Task, outcome: &Outcome) {
        let Some(key) = self.key(task) else { return };
        if let Err(error) = self.journal.add(key, outcome) {
            let _ = self.problem.set(error);
        }
    }

    /// Tells how much was there before, and of what could not be noted.
    fn tell(&self, printer: &Printer) {
        if self.journal.len() > 0 {
            printer.note(format_args!(
                "{} results were taken from the journal",
                self.taken.load(Ordering::Relaxed)
            ));
        }
        if let Some(error) = self.problem.get() {
            printer.warning(format_args!("{error:#}; this run cannot be resumed"));
        }
    }
}
