//! Runs the command.

use super::args::Matrix as Args;
use super::{csv, json};
use crate::exit::{Exit, stopped_by};
use crate::files;
use crate::interrupt;
use crate::many::{Meshes, Notes, Problem, expand};
use crate::numbers::grouped;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::bail;
use pompeiu::core::TriMesh;
use pompeiu::hausdorff::{DirectedReport, Tolerance};
use pompeiu::matching::TaskProgress;
use pompeiu::matching::matrix::{self, Matrix, MatrixOptions, Task, tasks};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Everything there is to report.
pub(super) struct Answer {
    pub(super) names: Vec<String>,
    pub(super) matrix: Matrix,
    pub(super) tolerance: Tolerance,
    pub(super) directed: bool,
    pub(super) problems: Vec<Problem>,
    pub(super) total: Duration,
}

impl Answer {
    /// Whether a file cannot be used.
    pub(super) fn is_unusable(&self, i: usize) -> bool {
        self.problems.iter().any(|problem| problem.path == self.names[i])
    }

    /// What was not measured as asked, though both files can be used.
    pub(super) fn open(&self) -> Vec<Task> {
        let usable = |task: &Task| !self.is_unusable(task.from) && !self.is_unusable(task.to);
        self.matrix.open().filter(usable).collect()
    }
}

pub(crate) fn run(args: &Args, printer: &Printer) -> anyhow::Result<Exit> {
    let started = Instant::now();
    let tolerance = args.tolerance.get();
    args.many.limits.apply_threads()?;
    let inputs = expand(&args.files, args.many.recursive);
    let mut problems = inputs.problems;
    if inputs.paths.is_empty() {
        Problem::report(&problems);
        bail!("there are no meshes to measure");
    }
    if let [only] = &inputs.paths[..] {
        printer.note(format_args!(
            "note: {} is the only mesh; a matrix has the distances of all pairs of several, such as those of a folder",
            only.display()
        ));
    }
    if let Some(journal) = &args.many.resume {
        files::check_place(journal, &inputs.paths.iter().map(PathBuf::as_path).collect::<Vec<_>>())?;
    }
    let meshes = Meshes::new(inputs.paths, args.many.cache());
    let wait = Wait::new(printer);
    let notes = args.many.resume.as_deref().map(|path| Notes::open(path, &meshes, &wait)).transpose()?;
    let show = |progress: &TaskProgress| {
        wait.count("pairs measured".to_owned(), [progress.done, progress.tasks].map(|n| n as u64));
        interrupt::flow()
    };
    let limits = args.many.limits.after(started.elapsed());
    let options = MatrixOptions { tolerance, limits, observer: Some(&show) };
    interrupt::listen();
    let matrix = matrix::measure(&Source { meshes: &meshes, tolerance, notes: notes.as_ref() }, &options)?;
    drop(wait);

    if let Some(notes) = &notes {
        notes.tell(printer);
    }
    let names = meshes.names();
    for (index, name) in names.iter().enumerate() {
        if let Some(message) = meshes.failure(index) {
            problems.push(Problem { path: name.clone(), message });
        }
    }
    Problem::report(&problems);
    let (directed, total) = (args.directed, started.elapsed());
    let answer = Answer { names, matrix, tolerance, directed, problems, total };
    let open = answer.open().len();
    if open > 0 {
        let all = tasks(answer.names.len()).count();
        printer.warning(format_args!(
            "ended by {}: {} of {} directed distances are open",
            stopped_by(answer.matrix.stop_reason()),
            grouped(open as u64),
            grouped(all as u64)
        ));
    }
    let exit = match (answer.problems.is_empty(), open) {
        (false, _) => Exit::Unusable,
        (true, 0) => Exit::Done,
        (true, _) => Exit::Undecided,
    };
    Printer::answer(&if args.json { json::json(&answer)? } else { csv::csv(&answer)? })?;
    Ok(exit)
}

/// The files, the journal and the bar of a run.
struct Source<'r> {
    meshes: &'r Meshes,
    tolerance: Tolerance,
    notes: Option<&'r Notes>,
}

impl Source<'_> {
    fn question(&self) -> (&'static str, Tolerance) {
        ("matrix", self.tolerance)
    }
}

impl matrix::Meshes for Source<'_> {
    type Mesh = Arc<TriMesh>;

    fn count(&self) -> usize {
        self.meshes.paths().len()
    }

    fn mesh(&self, index: usize) -> Option<Arc<TriMesh>> {
        self.meshes.mesh(index).ok()
    }

    fn bytes(&self) -> usize {
        self.meshes.bytes()
    }

    fn known(&self, task: Task) -> Option<DirectedReport> {
        self.notes?.get(&self.question(), &[task.from, task.to])
    }

    fn found(&self, task: Task, report: &DirectedReport) {
        if let Some(notes) = self.notes {
            notes.add(&self.question(), &[task.from, task.to], report);
        }
    }
}
