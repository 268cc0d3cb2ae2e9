//! Many meshes: ranking them, and the distances of all pairs.
//!
//! Tasks, their results and reports pass as JSON, in which every double comes back to the last bit: so they travel to other
//! processes and machines as they are.

use crate::arrays::array_of_square;
use crate::errors::{InternalError, Raise};
use crate::json::{parsed, written};
use crate::mesh::Mesh;
use crate::wait::{self, Told, Watch};
use numpy::PyArray2;
use pompeiu::core::TriMesh;
use pompeiu::hausdorff::Target as Tree;
use pompeiu::io::read_mesh;
use pompeiu::matching::matrix::{self, Entry, Matrix, Task as Pair};
use pompeiu::matching::rank::{self, Options, Outcome, Task};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use rayon::prelude::*;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Runs work on so many threads, or on those there are.
fn on_threads<R: Send>(threads: Option<usize>, work: impl FnOnce() -> R + Send) -> R {
    match threads.map(|threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build()) {
        Some(Ok(pool)) => pool.install(work),
        _ => work(),
    }
}

/// How far many tasks have come.
struct Steps {
    done: usize,
    all: usize,
    settled: usize,
    of: usize,
}

impl Told for Steps {
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (self.done, self.all, self.settled, self.of).into_pyobject(py)
    }
}

/// A mesh in memory, or a file that is read when a task needs it.
#[derive(FromPyObject)]
pub(crate) enum Source {
    Memory(Py<Mesh>),
    File(PathBuf),
}

impl Source {
    fn perform(&self, template: &rank::Template, task: &Task) -> Outcome {
        match self {
            Self::Memory(mesh) => rank::perform(template, mesh.get().inner(), &task.action),
            Self::File(path) => match read_mesh(path) {
                Ok(mesh) => rank::perform(template, &mesh, &task.action),
                Err(error) => Outcome::Failed(error.to_string()),
            },
        }
    }
}

/// Tasks for each thread between two looks at whether to stop.
const TASKS_PER_THREAD: usize = 2;

/// The report of a ranking, and for each of its rows the place of the target.
fn reported(ranking: &rank::Ranking) -> PyResult<(String, Vec<usize>)> {
    let report = ranking.report();
    Ok((written(&report)?, report.standings.iter().map(|standing| standing.target).collect()))
}

/// Ranks meshes on this machine: the report, and whether it came to its end.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
pub(crate) fn rank_meshes(
    py: Python<'_>,
    template: &Bound<'_, Mesh>,
    sources: Vec<Source>,
    names: Vec<String>,
    options: &str,
    threads: Option<usize>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<(String, Vec<usize>, bool)> {
    let options: Options = parsed(options)?;
    let template = template.get().inner();
    let ranking = wait::run(py, progress, |watch: &mut Watch<'_, Steps>| {
        on_threads(threads, || rank_here(template, &sources, names, &options, watch))
    })?
    .map_err(Raise::raise)?;
    let (report, places) = reported(&ranking)?;
    Ok((report, places, ranking.round().is_empty()))
}

fn rank_here(
    template: &TriMesh,
    sources: &[Source],
    names: Vec<String>,
    options: &Options,
    watch: &Watch<'_, Steps>,
) -> Result<rank::Ranking, rank::RankError> {
    let mut ranking = rank::Ranking::new(names, options)?;
    let template = rank::Template::new(template.clone(), options)?;
    while !ranking.round().is_empty() {
        let (all, settled, of) = (ranking.round().len(), ranking.settled(), sources.len());
        let done = AtomicUsize::new(0);
        let mut outcomes = Vec::with_capacity(all);
        for tasks in ranking.round().chunks(TASKS_PER_THREAD * rayon::current_num_threads()) {
            if watch.is_stopped() {
                return Ok(ranking);
            }
            outcomes.par_extend(tasks.par_iter().map(|task| {
                let outcome = sources[task.target].perform(&template, task);
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                watch.tell(Steps { done, all, settled, of });
                outcome
            }));
        }
        ranking.merge(outcomes)?;
    }
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
        let ranking = rank::Ranking::new(names, &parsed(options)?).map_err(Raise::raise)?;
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
        let options: Options = parsed(options)?;
        let mesh = mesh.get().inner();
        py.detach(|| rank::Template::new(mesh.clone(), &options)).map(Self).map_err(Raise::raise)
    }

    /// Does a task, on so many threads.
    fn perform(
        &self,
        py: Python<'_>,
        mesh: &Bound<'_, Mesh>,
        action: &str,
        threads: usize,
    ) -> PyResult<String> {
        let action = parsed(action)?;
        let mesh = mesh.get().inner();
        written(&py.detach(|| on_threads(Some(threads), || rank::perform(&self.0, mesh, &action))))
    }
}

/// What a matrix holds: lower and upper bounds, row by row, and the number of distances evaluated.
type Arrays<'py> = (Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>, u64);

fn arrays<'py>(py: Python<'py>, matrix: &Matrix) -> PyResult<Arrays<'py>> {
    let count = matrix.count();
    let end = |end: usize| {
        let entry = |at: usize| matrix.directed(at / count, at % count).map_or(f64::NAN, |ends| ends[end]);
        array_of_square(py, (0..count * count).map(entry).collect(), count)
    };
    Ok((end(0)?, end(1)?, matrix.distances()))
}

/// The directed distances of all pairs; what a stop left out is NaN.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
pub(crate) fn distance_matrix<'py>(
    py: Python<'py>,
    meshes: Vec<Py<Mesh>>,
    tolerance: f64,
    threads: Option<usize>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Arrays<'py>> {
    let meshes: Vec<&TriMesh> = meshes.iter().map(|mesh| mesh.get().inner()).collect();
    let matrix = wait::run(py, progress, |watch: &mut Watch<'_, Steps>| {
        on_threads(threads, || matrix_here(&meshes, tolerance, watch))
    })?;
    arrays(py, &matrix.map_err(Raise::raise)?)
}

fn matrix_here(
    meshes: &[&TriMesh],
    tolerance: f64,
    watch: &Watch<'_, Steps>,
) -> Result<Matrix, pompeiu::hausdorff::OptionError> {
    let count = meshes.len();
    let mut matrix = Matrix::new(count);
    let all = count * count.saturating_sub(1);
    let done = AtomicUsize::new(0);
    for (to, mesh) in meshes.iter().enumerate() {
        if watch.is_stopped() {
            break;
        }
        let tree = Tree::new(mesh);
        let directed = |from: usize| -> Result<_, pompeiu::hausdorff::OptionError> {
            let entry = matrix::directed(meshes[from], &tree, tolerance)?;
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            watch.tell(Steps { done, all, settled: to, of: count });
            Ok((Pair { from, to }, entry))
        };
        let column: Vec<(Pair, Entry)> =
            (0..count).into_par_iter().filter(|from| *from != to).map(directed).collect::<Result<_, _>>()?;
        for (pair, entry) in column {
            matrix.set(pair, entry);
        }
    }
    Ok(matrix)
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
            matrix.set(Pair { from, to }, parsed(&entry)?);
        }
        Ok(())
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
    tolerance: f64,
    threads: usize,
) -> PyResult<Vec<String>> {
    let to = to.get().inner();
    let entries = py.detach(|| {
        on_threads(Some(threads), || {
            let tree = Tree::new(to);
            from_
                .iter()
                .map(|mesh| matrix::directed(mesh.get().inner(), &tree, tolerance))
                .collect::<Result<Vec<_>, _>>()
        })
    });
    entries.map_err(Raise::raise)?.iter().map(written).collect()
}
