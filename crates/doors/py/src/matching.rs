//! Many meshes: ranking them, and the distances of all pairs, here and on other machines.
//!
//! Tasks, their results and reports pass as JSON, in which every double comes back to the last bit: so they travel to other
//! processes and machines as they are.

use crate::arrays::array_of_square;
use crate::ask::{Asked, Asking, Beside, Given, Outcome, failure, request};
use crate::errors::{InternalError, Raise};
use crate::json::{parsed, written};
use crate::mesh::Mesh;
use crate::wait::{self, Told, Watch};
use numpy::PyArray2;
use pompeiu::core::TriMesh;
use pompeiu::core::run::{StopReason, on_threads};
use pompeiu::hausdorff::{HausdorffOptions, Target as Tree};
use pompeiu::io::read_mesh;
use pompeiu::matching::matrix::{self, Matrix, MatrixOptions, Task as Pair};
use pompeiu::matching::rank;
use pompeiu::matching::request::{MatrixRequest, RankReport, RankRequest};
use pompeiu::matching::{Meshes, TaskObserver, TaskProgress};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::borrow::Borrow;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
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

/// Meshes in memory, and files that are read when a task needs them.
struct Sources<'g>(&'g [Given]);

/// A mesh while a task uses it.
enum Used<'g> {
    Memory(&'g TriMesh),
    File(Box<TriMesh>),
}

impl Borrow<TriMesh> for Used<'_> {
    fn borrow(&self) -> &TriMesh {
        match self {
            Self::Memory(mesh) => mesh,
            Self::File(mesh) => mesh,
        }
    }
}

fn bytes_of(given: &Given) -> usize {
    given.mesh().map_or(0, |mesh| size_of_val(mesh.positions()) + size_of_val(mesh.faces()))
}

impl<'g> Meshes for Sources<'g> {
    type Mesh = Used<'g>;

    fn count(&self) -> usize {
        self.0.len()
    }

    fn name(&self, index: usize) -> String {
        match &self.0[index] {
            Given::NamedMesh(name, _) | Given::File(name, _) => name.clone(),
            _ => index.to_string(),
        }
    }

    fn mesh(&self, index: usize) -> Result<Used<'g>, String> {
        match &self.0[index] {
            Given::File(_, path) => {
                read_mesh(path).map(|mesh| Used::File(Box::new(mesh))).map_err(|error| error.to_string())
            }
            given => given.mesh().map(Used::Memory).ok_or_else(|| "expected a mesh".to_owned()),
        }
    }

    fn bytes(&self) -> usize {
        self.0.iter().map(bytes_of).sum()
    }

    fn bytes_beside(&self, index: usize) -> usize {
        self.bytes() - bytes_of(&self.0[index])
    }
}

impl Asked for RankRequest {
    type Told = TaskProgress;

    fn ask(&self, asking: &Asking<'_, TaskProgress>) -> Outcome<Self> {
        let Some((Given::Mesh(template), targets)) = asking.given.split_first() else {
            return asking.unusable();
        };
        let found = self.run(template.get().inner(), &Sources(targets), &asking.context, Some(asking.watch));
        Ok((found.map_err(failure)?, Vec::new()))
    }
}

impl Asked for MatrixRequest {
    type Told = TaskProgress;

    fn ask(&self, asking: &Asking<'_, TaskProgress>) -> Outcome<Self> {
        let (report, matrix) =
            self.run(&Sources(asking.given), &asking.context, Some(asking.watch)).map_err(failure)?;
        let end = |end| Beside::Numbers(directed(&matrix, end));
        Ok((report, vec![("directed_lower", end(0)), ("directed_upper", end(1))]))
    }
}

/// One end of the enclosures of all directed distances, row by row; NaN for what is not known.
fn directed(matrix: &Matrix, end: usize) -> Vec<f64> {
    let count = matrix.count();
    let entry = |at: usize| matrix.directed(at / count, at % count).map_or(f64::NAN, |ends| ends[end]);
    (0..count * count).map(entry).collect()
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
        let options = request::<RankRequest>(options)?.options();
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
    fn report(&self) -> PyResult<String> {
        written(&RankReport::from(self.lock().report()).if_usable().map_err(Raise::raise)?)
    }
}

/// The template of a ranking, prepared once for all tasks of a process.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct Template(rank::Template);

#[pymethods]
impl Template {
    #[new]
    fn new(py: Python<'_>, mesh: &Bound<'_, Mesh>, options: &str) -> PyResult<Self> {
        let options = request::<RankRequest>(options)?.options();
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

/// A report as JSON, and two square arrays.
type Reported<'py> = (String, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray2<f64>>);

/// A matrix whose entries are found elsewhere.
#[pyclass(frozen, module = "pompeiu._native")]
pub(crate) struct Entries {
    matrix: Mutex<Matrix>,
    request: MatrixRequest,
}

impl Entries {
    fn lock(&self) -> MutexGuard<'_, Matrix> {
        self.matrix.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[pymethods]
impl Entries {
    #[new]
    fn new(count: usize, options: &str) -> PyResult<Self> {
        let request: MatrixRequest = request(options)?;
        request.tolerance().check().map_err(Raise::raise)?;
        Ok(Self { matrix: Mutex::new(Matrix::new(count)), request })
    }

    /// Notes the results of some tasks that lead to one mesh.
    #[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
    fn set(&self, to: usize, entries: Vec<(usize, String)>) -> PyResult<()> {
        let mut matrix = self.lock();
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
        self.lock().stop(StopReason::Cancelled);
    }

    /// The report as JSON, and both ends of the directed distances.
    fn report<'py>(&self, py: Python<'py>) -> PyResult<Reported<'py>> {
        let matrix = self.lock();
        let names = (0..matrix.count()).map(|index| index.to_string()).collect();
        let report = self.request.report(&matrix, names, &[]);
        let end = |end| array_of_square(py, directed(&matrix, end), matrix.count());
        Ok((written(&report)?, end(0)?, end(1)?))
    }
}

/// A mesh that others are measured to, for entries of a matrix.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "what is extracted from Python is owned")]
pub(crate) fn matrix_entries(
    py: Python<'_>,
    to: &Bound<'_, Mesh>,
    from_: Vec<Py<Mesh>>,
    options: &str,
    threads: usize,
) -> PyResult<Vec<String>> {
    let to = to.clone().unbind();
    let tolerance = request::<MatrixRequest>(options)?.tolerance();
    let options = MatrixOptions { tolerance, ..MatrixOptions::default() };
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
