//! Deviation analysis.

use super::DeviationPage;
use super::limits;
use crate::arrays::array_of_rows;
use crate::errors::Raise;
use crate::json::written;
use crate::mesh::Mesh;
use crate::wait;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pompeiu::core::FaceId;
use pompeiu::core::run::Limits;
use pompeiu::hausdorff::deviation::{Bands, DeviationOptions, DirectedDeviation, FaceDeviation, Region};
use pompeiu::hausdorff::{Enclosure, OptionError};
use pyo3::prelude::*;
use std::mem;
use std::time::Instant;

/// The options of a question, from a dictionary.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Options {
    accuracy: f64,
    threshold: Option<f64>,
    percentiles: Vec<f64>,
    bins: usize,
    regions: usize,
    signed: bool,
    bands: Vec<[f64; 2]>,
    most_pieces: usize,
    threads: Option<usize>,
    /// In seconds.
    time_limit: Option<f64>,
    /// In bytes.
    memory_limit: Option<usize>,
}

impl Options {
    /// The tolerance bands, if there are any.
    fn bands(&self) -> PyResult<Option<Bands>> {
        if self.bands.is_empty() {
            return Ok(None);
        }
        Bands::new(&self.bands).map(Some).map_err(Raise::raise)
    }

    fn options(self) -> PyResult<DeviationOptions<'static>> {
        let options = DeviationOptions {
            accuracy: self.accuracy,
            threshold: self.threshold,
            percentiles: self.percentiles,
            bins: self.bins,
            regions: self.regions,
            // Pages show signs with bands.
            signed: self.signed || !self.bands.is_empty(),
            limits: Limits {
                pieces: Some(self.most_pieces),
                ..limits(self.threads, self.time_limit, self.memory_limit)?
            },
            observer: None,
        };
        options.check().map_err(Raise::raise)?;
        Ok(options)
    }
}

fn row(enclosure: &Enclosure) -> [f64; 2] {
    [enclosure.lower(), enclosure.upper()]
}

/// An array of faces for each region.
type Faces<'py> = Vec<Bound<'py, PyArray1<u32>>>;

/// The faces of regions as arrays.
fn arrays<'py>(py: Python<'py>, regions: &[Region]) -> Faces<'py> {
    let of_region = |region: &Region| PyArray1::from_iter(py, region.faces.iter().map(|face| face.0));
    regions.iter().map(of_region).collect()
}

/// All regions of a report.
fn regions(report: &mut DirectedDeviation) -> impl Iterator<Item = &mut Region> {
    report.regions.iter_mut().chain(&mut report.beyond_threshold)
}

/// Takes the faces out of regions while JSON is written: they pass as arrays.
fn taken(report: &mut DirectedDeviation) -> Vec<Vec<FaceId>> {
    regions(report).map(|region| mem::take(&mut region.faces)).collect()
}

fn put_back(report: &mut DirectedDeviation, faces: Vec<Vec<FaceId>>) {
    for (region, faces) in regions(report).zip(faces) {
        region.faces = faces;
    }
}

/// What of a report passes beside its JSON: arrays, and what that leaves out.
#[derive(IntoPyObject)]
pub(crate) struct Beside<'py> {
    direction: &'static str,
    /// The report of the largest distance, as JSON.
    largest: String,
    face_max: Bound<'py, PyArray2<f64>>,
    face_min: Bound<'py, PyArray2<f64>>,
    face_mean: Bound<'py, PyArray2<f64>>,
    vertex_distances: Bound<'py, PyArray1<f64>>,
    vertex_error: f64,
    signed_vertex_distances: Option<Bound<'py, PyArray1<f64>>>,
    vertex_winding: Option<Bound<'py, PyArray1<f64>>>,
    face_winding: Option<Bound<'py, PyArray1<f64>>>,
    region_faces: Faces<'py>,
    beyond_threshold_faces: Faces<'py>,
    /// Seconds spent on building, searching and refining.
    timing: (f64, f64, f64),
}

impl<'py> Beside<'py> {
    fn new(py: Python<'py>, report: &DirectedDeviation) -> PyResult<Self> {
        let of_faces = |end: fn(&FaceDeviation) -> &Enclosure| {
            array_of_rows(py, report.faces.iter().map(|face| row(end(face))).collect())
        };
        let signed = report.signed_vertices();
        let (vertex_winding, face_winding) =
            report.sides.as_ref().map(|sides| (&sides.vertex_winding, &sides.face_winding)).unzip();
        let array = |numbers: &Vec<f64>| PyArray1::from_slice(py, numbers);
        Ok(Self {
            direction: wait::direction(report.direction),
            largest: written(&report.distance)?,
            face_max: of_faces(|face| &face.max)?,
            face_min: of_faces(|face| &face.min)?,
            face_mean: of_faces(|face| &face.mean)?,
            vertex_distances: array(&report.vertices),
            vertex_error: report.vertex_error,
            signed_vertex_distances: signed.map(|distances| distances.into_pyarray(py)),
            vertex_winding: vertex_winding.map(array),
            face_winding: face_winding.map(array),
            region_faces: arrays(py, &report.regions),
            beyond_threshold_faces: arrays(py, &report.beyond_threshold),
            timing: [report.work.build, report.work.search, report.work.refine]
                .map(|span| span.as_secs_f64())
                .into(),
        })
    }
}

/// How far A deviates from B.
#[pyfunction]
pub(crate) fn directed_deviation<'py>(
    py: Python<'py>,
    a: &Bound<'py, Mesh>,
    b: &Bound<'py, Mesh>,
    options: Options,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(String, Beside<'py>)> {
    let options = options.options()?;
    let [a, b] = [a, b].map(|mesh| mesh.clone().unbind());
    let report = wait::run_detached(py, progress, move |watch| {
        DeviationOptions { observer: Some(watch), ..options }.directed(a.get().inner(), b.get().inner())
    })?;
    let mut report = report.map_err(Raise::raise)?;
    let faces = taken(&mut report);
    let text = written(&report)?;
    put_back(&mut report, faces);
    Ok((text, Beside::new(py, &report)?))
}

/// How far A and B deviate from each other, and if bands were given, how much lies in which, as JSON.
#[pyfunction]
#[allow(clippy::type_complexity, reason = "what Python unpacks")]
pub(crate) fn deviation<'py>(
    py: Python<'py>,
    a: &Bound<'py, Mesh>,
    b: &Bound<'py, Mesh>,
    options: Options,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<(String, Beside<'py>, Beside<'py>, DeviationPage, Option<String>)> {
    let bands = options.bands()?;
    let options = options.options()?;
    let threshold = options.threshold;
    let meshes = [a, b];
    let held = meshes.map(|mesh| mesh.clone().unbind());
    let found = wait::run_detached(py, progress, move |watch| {
        let started = Instant::now();
        let options = DeviationOptions { observer: Some(watch), ..options };
        let [a, b] = held.each_ref().map(|mesh| mesh.get().inner());
        let report = options.symmetric(a, b)?;
        let time = options.limits.time.map(|time| time.saturating_sub(started.elapsed()));
        let limits = Limits { time, ..options.limits.clone() };
        let bands = bands.map(|bands| report.bands(a, b, &bands, options.accuracy, &limits, Some(watch)));
        Ok((report, bands))
    })?;
    let (mut report, bands) = found.map_err(|error: OptionError| error.raise())?;
    let text_of_bands = bands.as_ref().map(written).transpose()?;
    let faces = [taken(&mut report.a_to_b), taken(&mut report.b_to_a)];
    let text = written(&report)?;
    let [there, back] = faces;
    put_back(&mut report.a_to_b, there);
    put_back(&mut report.b_to_a, back);
    let [there, back] = [Beside::new(py, &report.a_to_b)?, Beside::new(py, &report.b_to_a)?];
    Ok((text, there, back, DeviationPage::new(meshes, report, threshold, bands), text_of_bands))
}
