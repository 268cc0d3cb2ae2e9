//! Deviation analysis.

use crate::arrays::array_of_rows;
use crate::errors::Raise;
use crate::mesh::Mesh;
use crate::query::limits;
use crate::report::{Directed, Pair};
use crate::wait;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pompeiu::core::run::Limits;
use pompeiu::hausdorff::deviation::{self as library, DeviationOptions, DirectedDeviation, FaceDeviation};
use pompeiu::hausdorff::{Direction, Enclosure};
use pyo3::prelude::*;

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
    most_pieces: usize,
    threads: Option<usize>,
    /// In seconds.
    time_limit: Option<f64>,
    /// In bytes.
    memory_limit: Option<usize>,
}

impl Options {
    fn options(self) -> PyResult<DeviationOptions<'static>> {
        let options = DeviationOptions {
            accuracy: self.accuracy,
            threshold: self.threshold,
            percentiles: self.percentiles,
            bins: self.bins,
            regions: self.regions,
            signed: self.signed,
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

type Ends = (f64, f64);

fn ends(enclosure: &Enclosure) -> Ends {
    (enclosure.lower(), enclosure.upper())
}

fn row(enclosure: &Enclosure) -> [f64; 2] {
    ends(enclosure).into()
}

#[derive(IntoPyObject)]
struct Histogram<'py> {
    edges: Bound<'py, PyArray1<f64>>,
    bins: Bound<'py, PyArray2<f64>>,
    cumulative: Bound<'py, PyArray2<f64>>,
}

#[derive(IntoPyObject)]
struct Statistics<'py> {
    area: f64,
    mean: Ends,
    rms: Ends,
    percentiles: Vec<(f64, Ends)>,
    above: Option<(f64, Ends)>,
    histogram: Histogram<'py>,
}

impl<'py> Statistics<'py> {
    fn new(py: Python<'py>, statistics: library::Statistics) -> PyResult<Self> {
        let histogram = statistics.histogram;
        Ok(Self {
            area: statistics.area,
            mean: ends(&statistics.mean),
            rms: ends(&statistics.rms),
            percentiles: percentiles(&statistics.percentiles),
            above: statistics.above.map(|above| (above.threshold, ends(&above.share))),
            histogram: Histogram {
                edges: histogram.edges.into_pyarray(py),
                bins: array_of_rows(py, histogram.bins.iter().map(row).collect())?,
                cumulative: array_of_rows(py, histogram.cumulative.iter().map(row).collect())?,
            },
        })
    }
}

fn percentiles(percentiles: &[library::Percentile]) -> Vec<(f64, Ends)> {
    percentiles.iter().map(|p| (p.share, ends(&p.distance))).collect()
}

#[derive(IntoPyObject)]
struct Region<'py> {
    faces: Bound<'py, PyArray1<u32>>,
    area: f64,
    centre: (f64, f64, f64),
    lower_corner: (f64, f64, f64),
    upper_corner: (f64, f64, f64),
    peak: Ends,
    witness: Pair,
    level: f64,
}

fn regions(py: Python<'_>, regions: Vec<library::Region>) -> Vec<Region<'_>> {
    let region = |region: library::Region| Region {
        faces: region.faces.iter().map(|face| face.0).collect::<Vec<_>>().into_pyarray(py),
        area: region.area,
        centre: region.centre.into(),
        lower_corner: region.aabb.lower.into(),
        upper_corner: region.aabb.upper.into(),
        peak: ends(&region.peak),
        witness: region.witness.into(),
        level: region.level,
    };
    regions.into_iter().map(region).collect()
}

#[derive(IntoPyObject)]
struct Work {
    pieces: u64,
    looks: u64,
    distances: u64,
    rounds: u32,
}

#[derive(IntoPyObject)]
struct Seconds {
    build: f64,
    search: f64,
    refine: f64,
}

#[derive(IntoPyObject)]
pub(crate) struct OneWay<'py> {
    direction: &'static str,
    distance: Directed,
    statistics: Option<Statistics<'py>>,
    face_max: Bound<'py, PyArray2<f64>>,
    face_min: Bound<'py, PyArray2<f64>>,
    face_mean: Bound<'py, PyArray2<f64>>,
    vertex_distances: Bound<'py, PyArray1<f64>>,
    vertex_error: f64,
    signed_vertex_distances: Option<Bound<'py, PyArray1<f64>>>,
    vertex_winding: Option<Bound<'py, PyArray1<f64>>>,
    face_winding: Option<Bound<'py, PyArray1<f64>>>,
    regions: Vec<Region<'py>>,
    beyond_threshold: Vec<Region<'py>>,
    stop: &'static str,
    work: Work,
    timing: Seconds,
}

impl<'py> OneWay<'py> {
    fn new(py: Python<'py>, report: DirectedDeviation) -> PyResult<Self> {
        let of_faces = |end: fn(&FaceDeviation) -> &Enclosure| {
            array_of_rows(py, report.faces.iter().map(|face| row(end(face))).collect())
        };
        let signed = report.signed_vertices();
        let (vertex_winding, face_winding) =
            report.sides.map(|sides| (sides.vertex_winding, sides.face_winding)).unzip();
        Ok(Self {
            direction: match report.direction {
                Direction::AToB => "a_to_b",
                Direction::BToA => "b_to_a",
            },
            face_max: of_faces(|face| &face.max)?,
            face_min: of_faces(|face| &face.min)?,
            face_mean: of_faces(|face| &face.mean)?,
            distance: report.distance.into(),
            statistics: report.statistics.map(|statistics| Statistics::new(py, statistics)).transpose()?,
            vertex_distances: report.vertices.into_pyarray(py),
            vertex_error: report.vertex_error,
            signed_vertex_distances: signed.map(|distances| distances.into_pyarray(py)),
            vertex_winding: vertex_winding.map(|numbers| numbers.into_pyarray(py)),
            face_winding: face_winding.map(|numbers| numbers.into_pyarray(py)),
            regions: regions(py, report.regions),
            beyond_threshold: regions(py, report.beyond_threshold),
            stop: report.stop.name(),
            work: Work {
                pieces: report.work.pieces,
                looks: report.work.looks,
                distances: report.work.distances,
                rounds: report.work.rounds,
            },
            timing: Seconds {
                build: report.work.build.as_secs_f64(),
                search: report.work.search.as_secs_f64(),
                refine: report.work.refine.as_secs_f64(),
            },
        })
    }
}

#[derive(IntoPyObject)]
pub(crate) struct BothWays<'py> {
    lower: f64,
    upper: f64,
    a_to_b: OneWay<'py>,
    b_to_a: OneWay<'py>,
    greater_percentiles: Option<Vec<(f64, Ends)>>,
    pooled: Option<Statistics<'py>>,
}

/// How far A deviates from B.
#[pyfunction]
pub(crate) fn directed_deviation<'py>(
    py: Python<'py>,
    a: &Bound<'py, Mesh>,
    b: &Bound<'py, Mesh>,
    options: Options,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<OneWay<'py>> {
    let options = options.options()?;
    let (a, b) = (a.get(), b.get());
    let report = wait::run(py, progress, |watch| {
        DeviationOptions { observer: Some(watch), ..options }.directed(a.inner(), b.inner())
    })?;
    OneWay::new(py, report.map_err(Raise::raise)?)
}

/// How far A and B deviate from each other.
#[pyfunction]
pub(crate) fn deviation<'py>(
    py: Python<'py>,
    a: &Bound<'py, Mesh>,
    b: &Bound<'py, Mesh>,
    options: Options,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<BothWays<'py>> {
    let options = options.options()?;
    let (a, b) = (a.get(), b.get());
    let report = wait::run(py, progress, |watch| {
        DeviationOptions { observer: Some(watch), ..options }.symmetric(a.inner(), b.inner())
    })?
    .map_err(Raise::raise)?;
    Ok(BothWays {
        lower: report.distance.lower(),
        upper: report.distance.upper(),
        a_to_b: OneWay::new(py, report.a_to_b)?,
        b_to_a: OneWay::new(py, report.b_to_a)?,
        greater_percentiles: report.greater_percentiles.as_deref().map(percentiles),
        pooled: report.pooled.map(|statistics| Statistics::new(py, statistics)).transpose()?,
    })
}
