//! Asking a system: its request from a dictionary, one answer as JSON, arrays and meshes beside it.

use crate::arrays::{array_of, array_of_rows, vectors};
use crate::errors::{InternalError, Raise, UnusableLimit};
use crate::hausdorff::{DeviationPage, limits};
use crate::json::{parsed, written};
use crate::mesh::Mesh;
use crate::neuron;
use crate::page::RunPage;
use crate::puzzle::PuzzleDrawings;
use crate::wait::{self, Share, Told, Watch};
use pompeiu::complexity::{ComplexityRequest, NamedShape};
use pompeiu::contact::ContactRequest;
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::{Coordinates, Rounding};
use pompeiu::core::request::{Answer, InfoRequest, Input, Limit, Request, Timing};
use pompeiu::core::run::{Limits, RunContext};
use pompeiu::coupling::show::{CoupleFrames, CouplePage};
use pompeiu::coupling::{CoupleRequest, Scene};
use pompeiu::fields::DecomposeRequest;
use pompeiu::flatten::{CutRequest, FlattenError, FlattenRequest};
use pompeiu::flow::FlowRequest;
use pompeiu::fluid::request::FluidRequest;
use pompeiu::hausdorff::{DeviationMeasures, Progress, RepairRequest};
use pompeiu::io::read_face_vectors;
use pompeiu::matching::request::{
    AlignRequest, AlignedDeviationRequest, AlignedDistanceRequest, MatrixRequest, RankRequest,
};
use pompeiu::medial::{MedialReport, MedialRequest};
use pompeiu::neuron::{NeuronAnswer, NeuronRequest, NeuronSource};
use pompeiu::operators::FaceField;
use pompeiu::options::request_from;
use pompeiu::planar::ShapeSource;
use pompeiu::puzzle::{PuzzleRequest, PuzzleRequestError};
use pompeiu::remesh::RemeshRequest;
use pompeiu::surface::{EdgeData, EmbeddedSurface};
use pyo3::exceptions::PyKeyError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyList, PyTuple};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Why there is no answer.
pub(crate) type Failure = Box<dyn Raise + Send>;

pub(crate) fn failure(error: impl Raise + Send + 'static) -> Failure {
    Box::new(error)
}

/// What a system is asked about.
pub(crate) enum Given {
    /// A mesh.
    Mesh(Py<Mesh>),
    /// A mesh with a name.
    NamedMesh(String, Py<Mesh>),
    /// A file, or a folder, with its name.
    File(String, PathBuf),
    /// The corners of a shape in the plane, with its name.
    Outline(String, Vec<[f64; 2]>),
    /// A neuron.
    Neuron(NeuronSource),
    /// The file of a scene, or a name.
    Scene(PathBuf),
    /// A scene as JSON.
    SceneText(String),
    /// Vertices and tetrahedra.
    Tetrahedra(Vec<[f64; 3]>, Vec<[u32; 4]>),
    /// The bytes of a checkpoint.
    State(Vec<u8>),
}

impl Given {
    /// A mesh, a name with a mesh, a path or corners, the file or the bytes of a neuron, the file of a scene alone in a tuple, its JSON
    /// alone in a tuple in a tuple, the bytes of a checkpoint in the same way, or a name with vertices and tetrahedra.
    fn new(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(mesh) = object.cast::<Mesh>() {
            return Ok(Self::Mesh(mesh.clone().unbind()));
        }
        if let Ok(((text,),)) = object.extract::<((String,),)>() {
            return Ok(Self::SceneText(text));
        }
        if let Ok(((bytes,),)) = object.extract::<((Bound<'_, PyBytes>,),)>() {
            return Ok(Self::State(bytes.as_bytes().to_vec()));
        }
        if let Ok((path,)) = object.extract::<(PathBuf,)>() {
            return Ok(Self::Scene(path));
        }
        if !object.is_instance_of::<PyTuple>() {
            return Ok(Self::Neuron(neuron::source(object)?));
        }
        if let Ok((_, vertices, cells)) = object.extract::<(String, Bound<'_, PyAny>, Vec<[u32; 4]>)>() {
            return Ok(Self::Tetrahedra(vectors::<3>(&vertices, "vertices", "(n, 3)")?, cells));
        }
        let (name, source): (String, Bound<'_, PyAny>) = object.extract()?;
        if let Ok(mesh) = source.cast::<Mesh>() {
            return Ok(Self::NamedMesh(name, mesh.clone().unbind()));
        }
        Ok(match source.extract::<PathBuf>() {
            Ok(path) => Self::File(name, path),
            Err(_) => Self::Outline(name, vectors::<2>(&source, "the outline", "(n, 2)")?),
        })
    }

    /// The mesh, if it is one in memory.
    pub(crate) fn mesh(&self) -> Option<&TriMesh> {
        match self {
            Self::Mesh(mesh) | Self::NamedMesh(_, mesh) => Some(mesh.get().inner()),
            _ => None,
        }
    }

    /// The shape in the plane, if it is one.
    fn shape(&self) -> Option<NamedShape> {
        let (name, source) = match self {
            Self::File(name, path) => (name, ShapeSource::File(path.clone())),
            Self::Outline(name, corners) => (name, ShapeSource::Corners(corners.clone())),
            _ => return None,
        };
        Some(NamedShape { name: name.clone(), source })
    }

    fn input(&self) -> Input {
        match self {
            Self::Mesh(mesh) | Self::NamedMesh(_, mesh) => Input::of_mesh(mesh.get().inner()),
            Self::File(_, path) | Self::Scene(path) => {
                Input { path: Some(path.display().to_string()), ..Input::default() }
            }
            Self::Outline(_, corners) => Input { vertices: corners.len(), ..Input::default() },
            Self::Tetrahedra(vertices, _) => Input { vertices: vertices.len(), ..Input::default() },
            Self::Neuron(_) | Self::SceneText(_) | Self::State(_) => Input::default(),
        }
    }
}

/// What passes beside the JSON of an answer.
pub(crate) enum Beside {
    Numbers(Vec<f64>),
    /// Lower and upper ends.
    Intervals(Vec<[f64; 2]>),
    Indices(Vec<u32>),
    Pairs(Vec<[u32; 2]>),
    Triples(Vec<[u32; 3]>),
    Plane(Vec<[f64; 2]>),
    Points(Vec<[f64; 3]>),
    Colors(Vec<[u8; 3]>),
    Mesh(TriMesh),
    Outlines(Vec<Vec<[f64; 2]>>),
    Puzzle(Box<PuzzleDrawings>),
    Neuron {
        found: Box<NeuronAnswer>,
        request: Box<NeuronRequest>,
    },
    Page(Box<DeviationPage>),
    RunPage(RunPage),
    Bytes(Vec<u8>),
    /// Several results, each with what passes beside it.
    Each(Vec<Vec<(&'static str, Beside)>>),
}

impl Beside {
    fn object(self, py: Python<'_>) -> PyResult<Bound<'_, PyAny>> {
        Ok(match self {
            Self::Numbers(numbers) => array_of(py, numbers)?.into_any(),
            Self::Indices(indices) => array_of(py, indices)?.into_any(),
            Self::Pairs(rows) => array_of_rows(py, rows)?.into_any(),
            Self::Triples(rows) => array_of_rows(py, rows)?.into_any(),
            Self::Intervals(rows) | Self::Plane(rows) => array_of_rows(py, rows)?.into_any(),
            Self::Points(rows) => array_of_rows(py, rows)?.into_any(),
            Self::Colors(rows) => array_of_rows(py, rows)?.into_any(),
            Self::Mesh(mesh) => Bound::new(py, Mesh::from(mesh))?.into_any(),
            Self::Outlines(outlines) => {
                let arrays = outlines.into_iter().map(|rows| array_of_rows(py, rows));
                PyList::new(py, arrays.collect::<PyResult<Vec<_>>>()?)?.into_any()
            }
            Self::Puzzle(drawings) => Bound::new(py, *drawings)?.into_any(),
            Self::Neuron { found, request } => neuron::answer_parts(py, *found, &request)?.into_any(),
            Self::Page(page) => Bound::new(py, *page)?.into_any(),
            Self::RunPage(page) => Bound::new(py, page)?.into_any(),
            Self::Bytes(bytes) => PyBytes::new(py, &bytes).into_any(),
            Self::Each(all) => {
                let all = all.into_iter().map(|one| dictionary(py, one));
                PyList::new(py, all.collect::<PyResult<Vec<_>>>()?)?.into_any()
            }
        })
    }
}

fn dictionary<'py>(py: Python<'py>, beside: Vec<(&'static str, Beside)>) -> PyResult<Bound<'py, PyDict>> {
    let objects = PyDict::new(py);
    for (name, one) in beside {
        objects.set_item(name, one.object(py)?)?;
    }
    Ok(objects)
}

/// A report with what passes beside it.
pub(crate) type Found<R> = (R, Vec<(&'static str, Beside)>);

/// What a system is asked about, what it runs with, and who is told how far it has come.
pub(crate) struct Asking<'a, T> {
    pub(crate) given: &'a [Given],
    pub(crate) context: RunContext<'a>,
    pub(crate) watch: &'a Watch<'a, T>,
}

impl<'a, T> Asking<'a, T> {
    /// The only mesh.
    pub(crate) fn mesh(&self) -> Result<&'a TriMesh, Failure> {
        self.meshes().map(|[mesh]| mesh)
    }

    /// So many meshes, and nothing else.
    pub(crate) fn meshes<const N: usize>(&self) -> Result<[&'a TriMesh; N], Failure> {
        let meshes: Vec<&TriMesh> = self.given.iter().filter_map(Given::mesh).collect();
        let count = meshes.len();
        meshes.try_into().map_err(|_| failure(InternalError::Mesh { found: N, count }))
    }

    /// The only mesh as an oriented surface.
    pub(crate) fn surface(&self) -> Result<EmbeddedSurface, Failure> {
        EmbeddedSurface::new(self.mesh()?).map_err(failure)
    }

    /// What is said where something else was given.
    pub(crate) fn unusable<R>(&self) -> Result<R, Failure> {
        Err(failure(InternalError::Mesh { found: 0, count: self.given.len() }))
    }
}

impl<'a> Asking<'a, Share> {
    /// What the system runs with, its progress included.
    pub(crate) fn watched(&self) -> RunContext<'a> {
        self.context.clone().watched_by(self.watch)
    }
}

/// What a request comes to.
pub(crate) type Outcome<Q> = Result<Found<<Q as Request>::Report>, Failure>;

/// A system as Python asks it.
pub(crate) trait Asked: Request<Report: Serialize + Send> + Serialize + DeserializeOwned {
    /// What the callback in Python is called with.
    type Told: Told + 'static;

    /// Runs a request.
    fn ask(&self, asking: &Asking<'_, Self::Told>) -> Outcome<Self>;
}

macro_rules! systems {
    ($($Request:ty),* $(,)?) => {
        /// Asks a system by its name: the answer as JSON, and what passes beside it.
        #[pyfunction]
        pub(crate) fn ask<'py>(
            py: Python<'py>,
            name: &str,
            given: Vec<Bound<'py, PyAny>>,
            options: &str,
            limits: Limited,
            progress: Option<&Bound<'py, PyAny>>,
        ) -> PyResult<Answered<'py>> {
            match name {
                $(<$Request>::NAME => answer(py, &given, options, limits, progress, <$Request>::ask),)*
                _ => Err(PyKeyError::new_err(name.to_owned())),
            }
        }
    };
}

systems!(
    AlignRequest,
    AlignedDeviationRequest,
    AlignedDistanceRequest,
    ComplexityRequest,
    ContactRequest,
    CoupleRequest,
    CutRequest,
    DecomposeRequest,
    DeviationMeasures,
    FlattenRequest,
    FlowRequest,
    FluidRequest,
    InfoRequest,
    MatrixRequest,
    MedialRequest,
    NeuronRequest,
    PuzzleRequest,
    RankRequest,
    RemeshRequest,
    RepairRequest
);

/// The answer as JSON, and what passes beside it.
pub(crate) type Answered<'py> = (String, Bound<'py, PyDict>);

/// Asks a system by a function that runs its request.
pub(crate) fn answer<'py, Q, T: Told + 'static>(
    py: Python<'py>,
    given: &[Bound<'py, PyAny>],
    options: &str,
    limits: Limited,
    progress: Option<&Bound<'py, PyAny>>,
    ask: impl FnOnce(&Q, &Asking<'_, T>) -> Outcome<Q> + Send + 'static,
) -> PyResult<Answered<'py>>
where
    Q: Request<Report: Serialize + Send> + Serialize + DeserializeOwned,
{
    let request: Q = request(options)?;
    let limits = limits_of::<Q>(limits)?;
    let given: Vec<Given> = given.iter().map(Given::new).collect::<PyResult<_>>()?;
    let found = wait::run_detached(py, progress, move |watch: &mut Watch<'_, T>| {
        let started = Instant::now();
        let context = RunContext::start(Limits { cancel: Some(watch.token()), ..limits });
        let (report, beside) = ask(&request, &Asking { given: &given, context, watch })?;
        let inputs = given.iter().map(Given::input).collect();
        let timing = Timing { read: Duration::ZERO, total: started.elapsed() };
        Ok((Answer::new(inputs, request, report, timing), beside))
    })?;
    let (answer, beside) = found.map_err(|error: Failure| error.exception(error.to_string()))?;
    Ok((written(&answer)?, dictionary(py, beside)?))
}

/// A request from its options as JSON.
pub(crate) fn request<Q: Request + Serialize + DeserializeOwned>(options: &str) -> PyResult<Q> {
    request_from(parsed(options)?).map_err(Raise::raise)
}

/// Threads, seconds and bytes, where they are limited.
pub(crate) type Limited = (Option<usize>, Option<f64>, Option<usize>);

/// The limits, of which a system takes only those that it obeys.
pub(crate) fn limits_of<Q: Request>(given: Limited) -> PyResult<Limits> {
    let (threads, seconds, memory) = given;
    let given = [
        (Limit::Threads, threads.is_some()),
        (Limit::Time, seconds.is_some()),
        (Limit::Memory, memory.is_some()),
    ];
    let dropped = given.into_iter().find(|(limit, is_given)| *is_given && !Q::LIMITS.contains(limit));
    if let Some((limit, _)) = dropped {
        return Err(UnusableLimit { function: Q::NAME, limit: limit.name() }.raise());
    }
    limits(threads, seconds, memory)
}

/// A mesh as a file holds it: where coordinates are counted from the centre, moved by the shift.
pub(crate) fn shifted(mesh: TriMesh, rounding: &Rounding) -> Result<Beside, Failure> {
    Ok(Beside::Mesh(match rounding.shift {
        [0.0, 0.0, 0.0] => mesh,
        _ => rounding.written(&mesh).map_err(failure)?,
    }))
}

/// The ends of the edges that are cut.
fn ends(surface: &EmbeddedSurface, cut: &EdgeData<bool>) -> Beside {
    let mesh = surface.mesh();
    let cut = mesh.edge_ids().filter(|&edge| cut[edge]);
    Beside::Pairs(cut.map(|edge| mesh.ends(edge).map(|v| v.0)).collect())
}

impl Asked for ComplexityRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let shapes: Vec<NamedShape> = asking.given.iter().filter_map(Given::shape).collect();
        let found = self.run(&shapes, &asking.watched()).map_err(failure)?;
        Ok((found.report, Vec::new()))
    }
}

impl Asked for CoupleRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let [Given::Scene(path)] = asking.given else { return asking.unusable() };
        let scene = Scene::read(path).map_err(failure)?;
        let (mut xs, mut ys, mut frames) = (Vec::new(), Vec::new(), CoupleFrames::default());
        let mut keep = |window: usize, x: &[f64], y: &[f64]| {
            xs.extend_from_slice(x);
            ys.extend_from_slice(y);
            if !self.compare {
                frames.add(window, x, y);
            }
        };
        let report = self.run(&scene, &mut keep, &asking.watched()).map_err(failure)?;
        let mut beside = vec![("x", Beside::Numbers(xs)), ("y", Beside::Numbers(ys))];
        if !self.compare {
            let (scenario, report) = (scene.scenario().map_err(failure)?, report.clone());
            let page = RunPage::new(move || {
                let (kind, windows, run) = (&*report.kind, report.windows, &report.runs[0]);
                CouplePage { kind, scenario: &scenario, windows, run, frames: frames.frames(), command: None }
                    .html()
            });
            beside.push(("page", Beside::RunPage(page)));
        }
        Ok((report, beside))
    }
}

impl Asked for NeuronRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let [Given::Neuron(source)] = asking.given else { return asking.unusable() };
        let found = self.run(source.clone(), true, &asking.watched()).map_err(failure)?;
        let report = found.report.clone();
        let parts = Beside::Neuron { found: Box::new(found), request: Box::new(self.clone()) };
        Ok((report, vec![("parts", parts)]))
    }
}

impl Asked for PuzzleRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let width = self.kerf_width().map_err(PuzzleRequestError::from).map_err(failure)?;
        let found = self.run(true, &asking.watched()).map_err(failure)?;
        let outlines = (0..found.puzzle.pieces()).map(|piece| found.puzzle.outline(piece)).collect();
        let report = found.report.clone();
        let drawings = PuzzleDrawings::new(found, width);
        let beside =
            vec![("outlines", Beside::Outlines(outlines)), ("drawings", Beside::Puzzle(Box::new(drawings)))];
        Ok((report, beside))
    }
}

impl Asked for CutRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let found = self.run(asking.surface()?).map_err(|error| failure(FlattenError::from(error)))?;
        let edges = ends(&found.surface, &found.cut);
        Ok((found.report, vec![("mesh", Beside::Mesh(found.mesh)), ("edges", edges)]))
    }
}

impl Asked for DecomposeRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let surface = asking.surface()?;
        let file = self.field.as_ref().and_then(|source| source.file());
        let read = file.map(|path| read_face_vectors(path, self.name.as_deref())).transpose();
        let found = self.run(&surface, read.map_err(failure)?.as_deref()).map_err(failure)?;
        let Some((_, parts)) = found.split else { return Ok((found.report, Vec::new())) };
        let in_space = |u: &FaceField| {
            Beside::Points(u.entries().map(|(face, &vector)| surface.to_space(face, vector)).collect())
        };
        let beside = vec![
            ("gradient", in_space(&parts.gradient)),
            ("rotated", in_space(&parts.rotated)),
            ("harmonic", in_space(&parts.harmonic)),
            ("vertex_potential", Beside::Numbers(parts.vertex_potential.into_vec())),
            ("edge_potential", Beside::Numbers(parts.edge_potential.into_vec())),
            ("harmonic_coefficients", Beside::Numbers(parts.harmonic_coefficients)),
        ];
        Ok((found.report, beside))
    }
}

impl Asked for FlattenRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let found = self.run(asking.surface()?, &asking.watched()).map_err(failure)?;
        let flat = found.flat;
        let mut beside = vec![
            ("edges", ends(&found.surface, &flat.cut)),
            ("corners", Beside::Triples(flat.opened.faces().to_vec())),
            ("vertex_map", Beside::Indices(flat.opened.vertex_map().iter().map(|v| v.0).collect())),
            ("face_distortion", Beside::Numbers(flat.face_distortion().into_vec())),
            ("coordinates", Beside::Plane(flat.uv.into_vec())),
        ];
        beside.extend(found.inserted.map(|mesh| ("mesh", Beside::Mesh(mesh))));
        Ok((flat.report, beside))
    }
}

impl Asked for InfoRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        Ok((self.run(asking.mesh()?), Vec::new()))
    }
}

impl Asked for MedialRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let found = self.run(&asking.surface()?, &asking.context).map_err(failure)?;
        let report = MedialReport::from(&found);
        let beside = vec![
            ("centres", Beside::Points(found.balls.iter().map(|ball| ball.centre).collect())),
            ("radii", Beside::Numbers(found.balls.iter().map(|ball| ball.radius).collect())),
            ("edges", Beside::Pairs(found.edges)),
            ("overlaps", Beside::Pairs(report.overlaps.clone())),
        ];
        Ok((report, beside))
    }
}

impl Asked for AlignedDistanceRequest {
    type Told = Progress;

    fn ask(&self, asking: &Asking<'_, Progress>) -> Outcome<Self> {
        let [a, b] = asking.meshes()?;
        Ok((self.run(a, b, &asking.context, Some(asking.watch)).map_err(failure)?, Vec::new()))
    }
}

impl Asked for AlignRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let [moving, fixed] = asking.meshes()?;
        let found = self.run(moving, fixed, Coordinates::default(), &asking.watched()).map_err(failure)?;
        Ok((found.report, vec![("mesh", Beside::Mesh(found.mesh))]))
    }
}

impl Asked for RepairRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let found = self.run(asking.mesh()?, &asking.context).map_err(failure)?;
        let mesh = shifted(found.mesh, &found.report.rounding)?;
        Ok((found.report, vec![("mesh", mesh)]))
    }
}

impl Asked for RemeshRequest {
    type Told = Share;

    fn ask(&self, asking: &Asking<'_, Share>) -> Outcome<Self> {
        let answer = self.run(asking.mesh()?, &asking.watched()).map_err(failure)?;
        let mesh = shifted(answer.found.mesh, &answer.report.rounding)?;
        Ok((answer.report, vec![("mesh", mesh)]))
    }
}
