//! Contact of elastic bodies: scenes in files or as JSON, meshes, and a callback after each step.

use crate::arrays::array_of_rows;
use crate::ask::{Answered, Asked, Asking, Beside, Failure, Given, Limited, Outcome, answer, failure};
use crate::errors::Raise;
use crate::json::written;
use crate::page::RunPage;
use crate::wait::Share;
use pompeiu::contact::request::{BodyMesh, Checkpoint, ContactRequestError};
use pompeiu::contact::show::ContactFrames;
use pompeiu::contact::{ContactRequest, ContactStep, Scene, Simulation};
use pompeiu::io::{SurfaceOrSolid, read_surface_or_solid};
use pyo3::prelude::*;
use pyo3::types::PyBool;
use std::ops::ControlFlow;
use std::path::Path;

/// Gets what was measured of the last step, and the bodies; gives whether to go on.
type OnStep<'s> = dyn FnMut(&Simulation, &ContactStep) -> ControlFlow<()> + Send + 's;

impl Asked for ContactRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        run(self, asking, &mut |_, _| ControlFlow::Continue(()))
    }
}

fn run(
    request: &ContactRequest,
    asking: &Asking<'_, Share>,
    on_step: &mut OnStep<'_>,
) -> Outcome<ContactRequest> {
    let Some((first, rest)) = asking.given.split_first() else { return asking.unusable() };
    let (resume, rest) = match rest.split_last() {
        Some((Given::State(bytes), rest)) => (Some(&bytes[..]), rest),
        _ => (None, rest),
    };
    let scene = match first {
        Given::Scene(path) => Scene::named(path).map_err(failure)?,
        Given::SceneText(text) => Scene::from_json(text).map_err(failure)?,
        _ => return asking.unusable(),
    };
    let mut meshes = Vec::new();
    for given in rest {
        meshes.push(match given {
            Given::File(_, path) => read(path)?,
            Given::Tetrahedra(positions, cells) => {
                BodyMesh::Tetrahedra { positions: positions.clone(), cells: cells.clone() }
            }
            other => match other.mesh() {
                Some(mesh) => BodyMesh::Surface(mesh.clone()),
                None => return asking.unusable(),
            },
        });
    }
    let meshes =
        scene.with_meshes(meshes, |path| read(path).map_err(Unread::Mesh)).map_err(|error| match error {
            Unread::Mesh(error) => error,
            Unread::Scene(error) => failure(error),
        })?;
    let mut frames = ContactFrames::default();
    let mut watch = |simulation: &Simulation, steps: &[ContactStep]| {
        frames.add(simulation);
        steps.last().map_or(ControlFlow::Continue(()), |step| on_step(simulation, step))
    };
    let run = request.run(&scene, &meshes, resume, &asking.watched(), &mut watch).map_err(failure)?;
    let checkpoint = Checkpoint::new(&run.simulation, &run.report.steps).and_then(|c| c.to_bytes());
    let checkpoint = checkpoint.map_err(|error| failure(ContactRequestError::from(error)))?;
    let state = run.simulation.state();
    let (report, faces) = (run.report.clone(), run.simulation.faces().to_vec());
    let page = RunPage::new(move || run.page(&frames, None).html());
    let beside = vec![
        ("positions", Beside::Points(state.positions)),
        ("velocities", Beside::Points(state.velocities)),
        ("faces", Beside::Triples(faces)),
        ("checkpoint", Beside::Bytes(checkpoint)),
        ("page", Beside::RunPage(page)),
    ];
    Ok((report, beside))
}

/// Why there is no mesh of a body.
enum Unread {
    Mesh(Failure),
    Scene(ContactRequestError),
}

impl From<ContactRequestError> for Unread {
    fn from(error: ContactRequestError) -> Self {
        Self::Scene(error)
    }
}

fn read(path: &Path) -> Result<BodyMesh, Failure> {
    Ok(match read_surface_or_solid(path).map_err(failure)? {
        SurfaceOrSolid::Surface(read) => BodyMesh::Surface(read.mesh),
        SurfaceOrSolid::Solid(solid) => {
            BodyMesh::Tetrahedra { positions: solid.positions, cells: solid.cells }
        }
    })
}

/// An exception of a callback, as a failure of the request.
struct Raised(PyErr);

impl Raise for Raised {
    fn exception(&self, _: String) -> PyErr {
        Python::attach(|py| self.0.clone_ref(py))
    }
}

impl std::fmt::Display for Raised {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.0.fmt(f)
    }
}

/// Runs a scene, and calls a function after each step with what was measured as JSON, positions and velocities; `False` ends the run.
#[pyfunction]
#[allow(clippy::needless_pass_by_value, reason = "PyO3 hands lists over by value")]
pub(crate) fn contact<'py>(
    py: Python<'py>,
    given: Vec<Bound<'py, PyAny>>,
    options: &str,
    limits: Limited,
    progress: Option<&Bound<'py, PyAny>>,
    on_step: Py<PyAny>,
) -> PyResult<Answered<'py>> {
    answer(py, &given, options, limits, progress, move |request: &ContactRequest, asking| {
        let mut raised = None;
        let found = run(request, asking, &mut |simulation, step| {
            let goes_on = Python::attach(|py| {
                let state = simulation.state();
                let positions = array_of_rows(py, state.positions)?;
                let velocities = array_of_rows(py, state.velocities)?;
                let told = on_step.bind(py).call1((written(step)?, positions, velocities))?;
                Ok::<_, PyErr>(!told.is(PyBool::new(py, false)))
            });
            match goes_on {
                Ok(true) => ControlFlow::Continue(()),
                Ok(false) => ControlFlow::Break(()),
                Err(error) => {
                    raised.get_or_insert(error);
                    ControlFlow::Break(())
                }
            }
        });
        raised.map_or(found, |error| Err(failure(Raised(error))))
    })
}
