//! Asking a system by its name: its request from JSON or TOML, its answer as the command prints it.

use crate::call::{ArrayOf, Ask};
use crate::error::CallError;
use crate::meshes::{Loaded, Meshes, Said, Texture};
use crate::outputs::{self, Compared, Flat, Found};
use crate::watch::{Watcher, Watching};
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::{Coordinates, Rounding, unreferenced_vertices, without_unreferenced};
use pompeiu::core::request::{Answer, Conclusion, InfoReport, InfoRequest, Report, Request, Timing};
use pompeiu::core::run::{Instant, Limits, RunContext};
use pompeiu::flatten::FlattenRequest;
use pompeiu::hausdorff::{PreparedPair, RepairRequest};
use pompeiu::matching::request::{AlignRequest, AlignedDeviationRequest, AlignedDistanceRequest};
use pompeiu::options::{options_of, options_of_toml, request_from};
use pompeiu::remesh::{RemeshRequest, SimplifyRequest};
use pompeiu::surface::{EmbeddedSurface, GeometryError, SurfaceError, orient};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};
use std::time::Duration;

/// What passes beside the JSON of an answer.
pub(crate) enum Beside {
    /// Numbers in rows of so many.
    Numbers(Vec<f64>, usize),
    /// Indices in rows of so many.
    Indices(Vec<u32>, usize),
    /// A mesh.
    Mesh(Loaded),
}

/// What a system found: its report, what passes beside it, what can be shown of it, and what a person should know.
pub(crate) struct Outcome<R> {
    report: R,
    beside: Vec<(&'static str, Beside)>,
    shown: Option<Found>,
    notes: Vec<String>,
}

impl<R> Outcome<R> {
    fn new(report: R) -> Self {
        Self { report, beside: Vec::new(), shown: None, notes: Vec::new() }
    }
}

/// What a system is asked about, and what it runs with.
pub(crate) struct Asking<'a> {
    ids: &'a [u32],
    given: Vec<&'a Loaded>,
    context: RunContext<'a>,
    watching: &'a Watching<'a>,
}

impl<'a> Asking<'a> {
    fn meshes<Q: Request, const N: usize>(&self) -> Result<[&'a Loaded; N], CallError> {
        let found = self.given.len();
        self.given.clone().try_into().map_err(|_| CallError::Count { command: Q::NAME, expected: N, found })
    }
}

/// A system as a call asks it.
trait Asked: Request<Report: Serialize> + Serialize + DeserializeOwned {
    /// Runs a request.
    fn ask(&self, asking: &Asking<'_>) -> Result<Outcome<Self::Report>, CallError>;

    /// What can be shown only with the whole answer.
    fn shown(_: &Answer<Self, Self::Report>, found: Option<Found>) -> Option<Found> {
        found
    }
}

/// What is said, and what can be shown of it.
type Answered = (Said, Option<Found>);

macro_rules! systems {
    ($($Request:ty),* $(,)?) => {
        /// Asks a system by its name.
        pub(crate) fn ask(meshes: &mut Meshes, call: &Ask, watcher: &dyn Watcher) -> Result<Answered, CallError> {
            match call.command.as_str() {
                $(<$Request>::NAME => answer::<$Request>(meshes, call, watcher),)*
                other => Err(CallError::Command(other.to_owned(), [$(<$Request>::NAME),*].join(", "))),
            }
        }

        /// The defaults of all options.
        pub(crate) fn defaults() -> Value {
            json!({ $(<$Request>::NAME: options_of(&<$Request>::default()),)* })
        }
    };
}

systems!(
    AlignRequest,
    AlignedDeviationRequest,
    AlignedDistanceRequest,
    FlattenRequest,
    InfoRequest,
    RemeshRequest,
    RepairRequest,
    SimplifyRequest,
);

fn limits(call: &Ask, watcher: &dyn Watcher) -> Result<Limits, CallError> {
    let limited = call.limits;
    let wrong = |error: pompeiu::core::run::LimitError| CallError::Limit(error.to_string());
    Ok(Limits {
        time: limited.time_limit.map(Limits::seconds).transpose().map_err(wrong)?,
        memory: limited.memory_limit,
        threads: limited.threads.map(Limits::threads).transpose().map_err(wrong)?,
        cancel: watcher.cancel(),
        ..Limits::default()
    })
}

fn answer<Q: Asked>(meshes: &mut Meshes, call: &Ask, watcher: &dyn Watcher) -> Result<Answered, CallError> {
    let started = Instant::now();
    let mut options = options_of_toml(&call.config)?;
    options.extend(call.options.clone());
    let request: Q = request_from(options)?;
    let watching = Watching(watcher);
    let given = call.meshes.iter().map(|&id| meshes.get(id)).collect::<Result<Vec<_>, _>>()?;
    let inputs = given.iter().map(|loaded| loaded.input.clone()).collect();
    let context = RunContext::start(limits(call, watcher)?).watched_by(&watching);
    let found = request.ask(&Asking { ids: &call.meshes, given, context, watching: &watching })?;
    let timing = Timing { read: Duration::ZERO, total: started.elapsed() };
    let answer = Answer::new(inputs, request, found.report, timing);
    let (made, arrays, listed) = kept(meshes, found.beside)?;
    let conclusion = answer.report.conclusion();
    let shown = Q::shown(&answer, found.shown);
    let said = json!({
        "answer": answer, "exit_code": conclusion.exit_code(), "meshes": made, "arrays": listed, "notes": found.notes,
    });
    debug_assert!(conclusion.exit_code() != Conclusion::UNUSABLE);
    Ok(((said, arrays), shown))
}

/// Meshes by their names, arrays of bytes, and what they hold by their names.
type Kept = (Map<String, Value>, Vec<Vec<u8>>, Map<String, Value>);

/// Meshes are kept; arrays pass as bytes.
fn kept(meshes: &mut Meshes, beside: Vec<(&'static str, Beside)>) -> Result<Kept, CallError> {
    let (mut made, mut arrays, mut listed) = (Map::new(), Vec::new(), Map::new());
    for (name, one) in beside {
        let (bytes, entries, columns) = match one {
            Beside::Numbers(numbers, columns) => {
                (outputs::bytes_of(&numbers, f64::to_le_bytes), "f64", columns)
            }
            Beside::Indices(indices, columns) => {
                (outputs::bytes_of(&indices, u32::to_le_bytes), "u32", columns)
            }
            Beside::Mesh(loaded) => {
                let id = meshes.keep(loaded);
                made.insert(name.to_owned(), meshes.facts(id)?);
                continue;
            }
        };
        listed.insert(name.to_owned(), json!(ArrayOf { index: arrays.len(), entries, columns }));
        arrays.push(bytes);
    }
    Ok((made, arrays, listed))
}

/// A mesh as a file holds it: where coordinates are counted from the centre, moved by the shift.
fn result(mesh: TriMesh, rounding: &Rounding) -> Result<(&'static str, Beside), CallError> {
    let mesh = match rounding.shift {
        [0.0, 0.0, 0.0] => mesh,
        _ => rounding.written(&mesh).map_err(CallError::of_system)?,
    };
    Ok(("mesh", Beside::Mesh(Loaded::of_mesh(mesh, "result"))))
}

impl Asked for InfoRequest {
    fn ask(&self, asking: &Asking<'_>) -> Result<Outcome<InfoReport>, CallError> {
        let [loaded] = asking.meshes::<Self, 1>()?;
        let report = InfoReport { file: loaded.file.clone(), ..self.run(&loaded.mesh) };
        Ok(Outcome {
            shown: Some(Found::Described(asking.ids[0], Box::new(report.clone()))),
            ..Outcome::new(report)
        })
    }
}

impl Asked for AlignedDistanceRequest {
    fn ask(&self, asking: &Asking<'_>) -> Result<Outcome<Self::Report>, CallError> {
        let [a, b] = asking.meshes::<Self, 2>()?;
        let found = self.run(&a.mesh, &b.mesh, &asking.context, Some(asking.watching));
        Ok(Outcome::new(found.map_err(CallError::of_system)?))
    }
}

impl Asked for AlignedDeviationRequest {
    fn ask(&self, asking: &Asking<'_>) -> Result<Outcome<Self::Report>, CallError> {
        let [a, b] = asking.meshes::<Self, 2>()?;
        let pair = PreparedPair::new(a.mesh.clone(), b.mesh.clone()).keeping(true);
        let (pair, report) = self
            .run(pair, [&a.groups, &b.groups], &asking.context, Some(asking.watching))
            .map_err(CallError::of_system)?;
        let deviation = &report.measured.deviation;
        let beside = vec![
            ("a_to_b", Beside::Numbers(deviation.a_to_b.vertices.clone(), 1)),
            ("b_to_a", Beside::Numbers(deviation.b_to_a.vertices.clone(), 1)),
        ];
        let compared = Compared::new(pair, report.clone(), [a, b], &self.deviation.measures.unit);
        Ok(Outcome { report, beside, shown: Some(Found::Compared(Box::new(compared))), notes: Vec::new() })
    }
}

impl Asked for AlignRequest {
    fn ask(&self, asking: &Asking<'_>) -> Result<Outcome<Self::Report>, CallError> {
        let [moving, fixed] = asking.meshes::<Self, 2>()?;
        let found = self.run(&moving.mesh, &fixed.mesh, Coordinates::default(), &asking.context);
        let found = found.map_err(CallError::of_system)?;
        let mesh = Beside::Mesh(Loaded::of_mesh(found.mesh, moving.name()));
        Ok(Outcome { beside: vec![("mesh", mesh)], ..Outcome::new(found.report) })
    }
}

impl Asked for RepairRequest {
    fn ask(&self, asking: &Asking<'_>) -> Result<Outcome<Self::Report>, CallError> {
        let [loaded] = asking.meshes::<Self, 1>()?;
        let found = self.run(&loaded.mesh, &asking.context).map_err(CallError::of_system)?;
        let shown = Found::beside(asking.ids[0], "repaired", &found.mesh, found.report.distance);
        let mesh = result(found.mesh, &found.report.rounding)?;
        Ok(Outcome { beside: vec![mesh], shown: Some(shown), ..Outcome::new(found.report) })
    }
}

impl Asked for SimplifyRequest {
    fn ask(&self, asking: &Asking<'_>) -> Result<Outcome<Self::Report>, CallError> {
        let [loaded] = asking.meshes::<Self, 1>()?;
        let mut found = self.run(&loaded.mesh, &[], &asking.context).map_err(CallError::of_system)?;
        let level = found.levels.remove(0);
        let shown = Found::beside(asking.ids[0], "simplified", &level.mesh, Some(level.distance.distance));
        let mut beside = vec![result(level.mesh, &found.report.rounding)?];
        for (name, level) in ["finer_1", "finer_2", "finer_3", "finer_4", "finer_5", "finer_6", "finer_7"]
            .into_iter()
            .zip(found.levels)
        {
            beside.push((name, result(level.mesh, &found.report.rounding)?.1));
        }
        Ok(Outcome { beside, shown: Some(shown), ..Outcome::new(found.report) })
    }
}

impl Asked for RemeshRequest {
    fn ask(&self, asking: &Asking<'_>) -> Result<Outcome<Self::Report>, CallError> {
        let [loaded] = asking.meshes::<Self, 1>()?;
        let answer = self.run(&loaded.mesh, &asking.context).map_err(CallError::of_system)?;
        let mesh = result(answer.found.mesh.clone(), &answer.report.rounding)?;
        let shown = Found::Remeshed(asking.ids[0], Box::new(answer.found));
        Ok(Outcome { beside: vec![mesh], shown: Some(shown), ..Outcome::new(answer.report) })
    }
}

/// The mesh as an oriented surface: without vertices in no face, and with faces turned to agree, which is told.
fn surface(loaded: &Loaded, notes: &mut Vec<String>) -> Result<(TriMesh, EmbeddedSurface), CallError> {
    let mut mesh = loaded.mesh.clone();
    if unreferenced_vertices(&mesh) > 0 {
        notes.push(format!("{}: vertices in no face were left out", loaded.name()));
        mesh = without_unreferenced(&mesh);
    }
    let surface = match EmbeddedSurface::new(&mesh) {
        Err(GeometryError::Surface(SurfaceError::Misoriented { .. })) => {
            mesh = orient(&mesh).map_err(CallError::of_system)?;
            notes.push(format!("{}: faces were turned over to agree", loaded.name()));
            EmbeddedSurface::new(&mesh)
        }
        surface => surface,
    };
    Ok((mesh, surface.map_err(CallError::of_system)?))
}

impl Asked for FlattenRequest {
    fn ask(&self, asking: &Asking<'_>) -> Result<Outcome<Self::Report>, CallError> {
        let [loaded] = asking.meshes::<Self, 1>()?;
        let mut notes = Vec::new();
        let (mesh, surface) = surface(loaded, &mut notes)?;
        let found = self.run(surface, &asking.context).map_err(CallError::of_system)?;
        let mesh = found.inserted.clone().unwrap_or(mesh);
        let (coordinates, corners) = (found.flat.uv.to_vec(), found.flat.opened.faces().to_vec());
        let beside = vec![
            ("coordinates", Beside::Numbers(coordinates.as_flattened().to_vec(), 2)),
            ("corners", Beside::Indices(corners.as_flattened().to_vec(), 3)),
        ];
        let mut textured = Loaded::of_mesh(mesh, "result");
        textured.texture = Some(Texture { coordinates, corners });
        let report = found.flat.report.clone();
        let shown = Found::Flat(Box::new(Flat {
            name: loaded.name().to_owned(),
            surface: found.surface,
            map: found.flat,
        }));
        let beside = beside.into_iter().chain([("mesh", Beside::Mesh(textured))]).collect();
        Ok(Outcome { report, beside, shown: Some(shown), notes })
    }
}
