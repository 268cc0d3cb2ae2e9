//! Many meshes: ranking them, and the distances of all pairs.
//!
//! Tasks, their results and reports pass as JSON, in which every double comes back to the last bit: so they travel to other
//! processes and machines as they are.

use crate::arrays::array_of_square;
use crate::errors::{InternalError, Raise};
use crate::hausdorff::{limits, tolerance};
use crate::json::{parsed, written};
use crate::mesh::Mesh;
use crate::wait::{self, Told, Watch};
use numpy::PyArray2;
use pompeiu::core::TriMesh;
use pompeiu::core::run::{Limits, StopReason, on_threads};
use pompeiu::hausdorff::{HausdorffOptions, Target as Tree};
use pompeiu::io::read_mesh;
use pompeiu::matching::matrix::{self, Matrix, MatrixOptions, Task as Pair};
use pompeiu::matching::rank::{self, Outcome, RankError, RankOptions, Task};
use pompeiu::matching::{TaskObserver, TaskProgress};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::path::PathBuf;
use std::sync::{Mutex, MutexGuard, PoisonError};

impl Told for TaskProgress {
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (self.done, self.tasks, self.settled, self.meshes).into_pyobject(py)
    }
}

impl TaskObserver for Watch<'_, TaskProgress> {
    fn progress(&self, progress: &TaskProgress) -> ControlFlow<()> {
        self.tell(*progress);
        if self.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// A mesh in memory, or a file that is read when a task needs it.
#[derive(FromPyObject)]
pub(crate) enum Source {
    Memory(Py<Mesh>),
    File(PathBuf),
}

impl Source {
    fn perform(&self, template: &rank::Template, task: &Task, search: &HausdorffOptions<'_>) -> Outcome {
        match self {
            Self::Memory(mesh) => rank::perform(template, mesh.get().inner(), &task.action, search),
            Self::File(path) => match read_mesh(path) {
                Ok(mesh) => rank::perform(template, &mesh, &task.action, search),
                Err(error) => Outcome::Failed(error.to_string()),
            },
        }
    }

    /// Bytes of memory that it takes while it is not looked at.
    fn bytes(&self) -> usize {
        match self {
            Self::Memory(mesh) => {
                let mesh = mesh.get().inner();
                size_of_val(mesh.positions()) + size_of_val(mesh.faces())
            }
            Self::File(_) => 0,
        }
    }
}

/// What a run may take: threads, seconds, bytes.
#[derive(FromPyObject)]
pub(crate) struct Most(Option<usize>, Option<f64>, Option<usize>);

impl Most {
    fn limits(self) -> PyResult<Limits> {
        limits(self.0, self.1, self.2)
    }
}

/// The report of a ranking, and for each of its rows the place of the target.
fn reported(ranking: &rank::Ranking) -> PyResult<(String, Vec<usize>)> {
    let report = ranking.report();
    Ok((written(&report)?, report.standings.iter().map(|standing| standing.target).collect()))
}

/// Ranks meshes on this machine.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
pub(crate) fn rank_meshes(
    py: Python<'_>,
    template: &Bound<'_, Mesh>,
    sources: Vec<Source>,
    names: Vec<String>,
    options: &str,
    most: Most,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, Vec<usize>)> {
    let options = RankOptions { limits: most.limits()?, ..parsed(options)? };
    let template = template.clone().unbind();
    let ranking = wait::run_detached(py, progress, move |watch: &mut Watch<'_, TaskProgress>| {
        let options = RankOptions { observer: Some(watch), ..options };
        rank_here(template.get().inner(), &sources, names, &options)
    })?;
    reported(&ranking.map_err(Raise::raise)?)
}

fn rank_here(
    template: &TriMesh,
    sources: &[Source],
    names: Vec<String>,
    options: &RankOptions<'_>,
) -> Result<rank::Ranking, RankError> {
    let mut ranking = rank::Ranking::new(names, options)?;
    let template = on_threads(options.limits.threads, || rank::Template::new(template.clone(), options))?;
    let held: usize = sources.iter().map(Source::bytes).sum();
    let done = |task: &Task, search: &HausdorffOptions<'_>| {
        let source = &sources[task.target];
        let mut search = search.clone();
        let beside = held - source.bytes();
        search.limits.memory = search.limits.memory.map(|memory| memory.saturating_sub(beside));
        source.perform(&template, task, &search)
    };
    rank::run(&mut ranking, options, done, |_| ())?;
    Ok(ranking)
}

/// A ranking whose tasks are done elsewhere: says which come next, given the results of those before.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct Ranking(Mutex<rank::Ranking>);

impl Ranking {
    fn lock(&self) -> MutexGuard<'_, rank::Ranking> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Ranking {
    #[new]
    fn new(names: Vec<String>, options: &str) -> PyResult<Self> {
        let options: RankOptions<'_> = parsed(options)?;
        let ranking = rank::Ranking::new(names, &options).map_err(Raise::raise)?;
        Ok(Self(Mutex::new(ranking)))
    }

    /// The tasks of this round: for each its target and what to do.
    fn round(&self) -> PyResult<Vec<(usize, String)>> {
        self.lock().round().iter().map(|task| Ok((task.target, written(&task.action)?))).collect()
    }

    /// Takes the results of the round, in the order of its tasks.
    #[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
    fn merge(&self, outcomes: Vec<String>) -> PyResult<()> {
        let outcomes = outcomes.iter().map(|outcome| parsed(outcome)).collect::<PyResult<_>>()?;
        self.lock().merge(outcomes).map_err(Raise::raise)
    }

    /// Whether a target may still be asked for.
    fn wants(&self, target: usize) -> bool {
        self.lock().wants(target)
    }

    /// How many targets are settled.
    fn settled(&self) -> usize {
        self.lock().settled()
    }

    /// Ends the ranking on request.
    fn stop(&self) {
        self.lock().stop(StopReason::Cancelled);
    }

    /// What is known so far.
    fn report(&self) -> PyResult<(String, Vec<usize>)> {
        reported(&self.lock())
    }
}

/// The template of a ranking, prepared once for all tasks of a process.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct Template(rank::Template);

#[pymethods]
impl Template {
    #[new]
    fn new(py: Python<'_>, mesh: &Bound<'_, Mesh>, options: &str) -> PyResult<Self> {
        let options: RankOptions<'_> = parsed(options)?;
        let mesh = mesh.clone().unbind();
        let made = wait::abandonable(py, move || rank::Template::new(mesh.get().inner().clone(), &options))?;
        made.map(Self).map_err(Raise::raise)
    }

    /// Does a task, on so many threads.
    fn perform(
        slf: &Bound<'_, Self>,
        py: Python<'_>,
        mesh: &Bound<'_, Mesh>,
        action: &str,
        threads: usize,
    ) -> PyResult<String> {
        let action = parsed(action)?;
        let (template, mesh) = (slf.clone().unbind(), mesh.clone().unbind());
        let threads = NonZeroUsize::new(threads);
        let outcome = wait::abandonable(py, move || {
            let search = HausdorffOptions::default();
            let (template, mesh) = (&template.get().0, mesh.get().inner());
            on_threads(threads, || rank::perform(template, mesh, &action, &search))
        })?;
        written(&outcome)
    }
}

/// What a matrix holds: lower and upper bounds, row by row, the number of distances evaluated, why it ended, and the rows and
/// columns of what is open.
type Arrays<'py> =
    (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>, u64, &'static str, Vec<(usize, usize)>);

fn arrays<'py>(py: Python<'py>, matrix: &Matrix) -> PyResult<Arrays<'py>> {
    let count = matrix.count();
    let end = |end: usize| {
        let entry = |at: usize| matrix.directed(at / count, at % count).map_or(f64::NAN, |ends| ends[end]);
        array_of_square(py, (0..count * count).map(entry).collect(), count)
    };
    let open = matrix.open().map(|pair| (pair.from, pair.to)).collect();
    Ok((end(0)?, end(1)?, matrix.distances(), matrix.stop_reason().name(), open))
}

/// The directed distances of all pairs; what a stop left out is NaN.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
pub(crate) fn distance_matrix<'py>(
    py: Python<'py>,
    meshes: Vec<Py<Mesh>>,
    width: (f64, String),
    most: Most,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Arrays<'py>> {
    let (tolerance, limits) = (tolerance(width.0, &width.1)?, most.limits()?);
    let matrix = wait::run_detached(py, progress, move |watch: &mut Watch<'_, TaskProgress>| {
        let meshes: Vec<&TriMesh> = meshes.iter().map(|mesh| mesh.get().inner()).collect();
        matrix::measure(&meshes.as_slice(), &MatrixOptions { tolerance, limits, observer: Some(watch) })
    })?;
    arrays(py, &matrix.map_err(Raise::raise)?)
}

/// A matrix whose entries are found elsewhere.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct Entries(Mutex<Matrix>);

#[pymethods]
impl Entries {
    #[new]
    fn new(count: usize) -> Self {
        Self(Mutex::new(Matrix::new(count)))
    }

    /// Notes the results of some tasks that lead to one mesh.
    #[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
    fn set(&self, to: usize, entries: Vec<(usize, String)>) -> PyResult<()> {
        let mut matrix = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        for (from, entry) in entries {
            let (found, count) = (from.max(to), matrix.count());
            if found >= count {
                return Err(InternalError::Mesh { found, count }.raise());
            }
            matrix.set(Pair { from, to }, &parsed(&entry)?);
        }
        Ok(())
    }

    /// Ends the matrix on request.
    fn stop(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).stop(StopReason::Cancelled);
    }

    fn arrays<'py>(&self, py: Python<'py>) -> PyResult<Arrays<'py>> {
        arrays(py, &self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// A mesh that others are measured to, for entries of a matrix.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
pub(crate) fn matrix_entries(
    py: Python<'_>,
    to: &Bound<'_, Mesh>,
    from_: Vec<Py<Mesh>>,
    width: (f64, String),
    threads: usize,
) -> PyResult<Vec<String>> {
    let to = to.clone().unbind();
    let options = MatrixOptions { tolerance: tolerance(width.0, &width.1)?, ..MatrixOptions::default() };
    let entries = wait::abandonable(py, move || {
        on_threads(NonZeroUsize::new(threads), || {
            let tree = Tree::new(to.get().inner());
            from_
                .iter()
                .map(|mesh| matrix::directed(mesh.get().inner(), &tree, &options))
                .collect::<Result<Vec<_>, _>>()
        })
    })?;
    entries.map_err(Raise::raise)?.iter().map(written).collect()
}
