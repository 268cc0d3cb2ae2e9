//! Runs the command.

use super::args::Matrix as Args;
use super::{csv, json};
use crate::exit::Exit;
use crate::many::{Fingerprint, Journal, Meshes, Problem, expand, fingerprint};
use crate::printer::Printer;
use crate::threads::use_threads;
use crate::wait::Wait;
use anyhow::bail;
use pompeiu::hausdorff::Target;
use pompeiu::matching::matrix::{Entry, Matrix, Task, directed};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Everything there is to report.
pub(super) struct Answer {
    pub(super) names: Vec<String>,
    pub(super) matrix: Matrix,
    pub(super) tolerance: f64,
    pub(super) directed: bool,
    pub(super) problems: Vec<Problem>,
    pub(super) total: Duration,
}

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    if let Some(threads) = args.many.threads {
        use_threads(threads)?;
    }
    let inputs = expand(&args.files, args.many.recursive);
    let mut problems = inputs.problems;
    if inputs.paths.is_empty() {
        Problem::report(&problems);
        bail!("there are no meshes to measure");
    }
    let meshes = Meshes::new(inputs.paths, args.many.cache);
    let wait = Wait::new(printer);
    let journal = args.many.resume.as_deref().map(Journal::open).transpose()?;
    let before = journal.as_ref().map_or(0, Journal::len);
    let notes = journal.map(|journal| Notes::new(journal, &meshes, args.tolerance, &wait));
    let matrix = measure(&meshes, args.tolerance, notes.as_ref(), &wait)?;
    drop(wait);

    if let Some(notes) = notes.filter(|_| before > 0) {
        printer.note(format_args!("{} results were taken from the journal", notes.taken.into_inner()));
    }
    let names = meshes.names();
    for (index, name) in names.iter().enumerate() {
        if let Some(message) = meshes.failure(index) {
            problems.push(Problem { path: name.clone(), message });
        }
    }
    Problem::report(&problems);
    let exit = if problems.is_empty() { Exit::Done } else { Exit::Unusable };
    let (tolerance, directed, total) = (args.tolerance, args.directed, started.elapsed());
    let answer = Answer { names, matrix, tolerance, directed, problems, total };
    Printer::answer(&if args.json { json::json(&answer)? } else { csv::csv(&answer)? })?;
    Ok(exit)
}

/// All pairs, grouped by the mesh that is measured to: its tree is built once, and only if something is measured.
fn measure(meshes: &Meshes, tolerance: f64, notes: Option<&Notes>, wait: &Wait) -> anyhow::Result<Matrix> {
    let count = meshes.paths().len();
    let pairs = (count * (count - 1)) as u64;
    let done = AtomicU64::new(0);
    let mut matrix = Matrix::new(count);
    for to in 0..count {
        let row = (0..count).filter(|from| *from != to).map(|from| Task { from, to });
        let mut left = Vec::new();
        for task in row {
            match notes.and_then(|notes| notes.get(task)) {
                Some(entry) => {
                    matrix.set(task, entry);
                    done.fetch_add(1, Ordering::Relaxed);
                }
                None => left.push(task),
            }
        }
        // A single mesh is read too, so that what is wrong with it is told.
        let Ok(mesh) = (if left.is_empty() && count > 1 { continue } else { meshes.mesh(to) }) else {
            done.fetch_add(left.len() as u64, Ordering::Relaxed);
            continue;
        };
        let target = Target::new(&mesh);
        for tasks in left.chunks(2 * rayon::current_num_threads()) {
            let work = |task: &Task| -> anyhow::Result<Option<Entry>> {
                let entry = match meshes.mesh(task.from) {
                    Ok(mesh) => Some(directed(&mesh, &target, tolerance)?),
                    Err(_) => None,
                };
                if let (Some(notes), Some(entry)) = (notes, &entry) {
                    notes.add(*task, entry)?;
                }
                wait.count("pairs measured".to_owned(), [done.fetch_add(1, Ordering::Relaxed) + 1, pairs]);
                Ok(entry)
            };
            let entries = tasks.par_iter().map(work).collect::<anyhow::Result<Vec<_>>>()?;
            for (task, entry) in tasks.iter().zip(entries) {
                if let Some(entry) = entry {
                    matrix.set(*task, entry);
                }
            }
        }
    }
    Ok(matrix)
}

/// The journal of a matrix.
struct Notes {
    journal: Journal,
    /// None for files that cannot be read.
    files: Vec<Option<Fingerprint>>,
    tolerance: f64,
    taken: AtomicU64,
}

impl Notes {
    fn new(journal: Journal, meshes: &Meshes, tolerance: f64, wait: &Wait) -> Self {
        wait.show("looking for what was done before".to_owned());
        let files = meshes.paths().par_iter().map(|path| fingerprint(path).ok()).collect();
        Self { journal, files, tolerance, taken: AtomicU64::new(0) }
    }

    fn key(&self, task: Task) -> Option<String> {
        let [from, to] = [task.from, task.to].map(|at| self.files[at].as_ref());
        Journal::key(&("matrix", from?, to?, self.tolerance)).ok()
    }

    fn get(&self, task: Task) -> Option<Entry> {
        let found = self.journal.get(&self.key(task)?)?;
        self.taken.fetch_add(1, Ordering::Relaxed);
        Some(found)
    }

    fn add(&self, task: Task, entry: &Entry) -> anyhow::Result<()> {
        match self.key(task) {
            Some(key) => self.journal.add(key, entry),
            None => Ok(()),
        }
    }
}
