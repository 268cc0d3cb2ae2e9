//! The outcome as one JSON object.

use super::run::{Outcome, directions};
use crate::json::{Bounds, MeshFile, Point, WitnessPoints, milliseconds};
use pompeiu::hausdorff::Enclosure;
use pompeiu::hausdorff::deviation::{
    DeviationWork, DirectedDeviation, Histogram, Percentile, Region, Statistics,
};
use serde::Serialize;

/// The outcome on one line.
pub(super) fn json(outcome: &Outcome) -> serde_json::Result<String> {
    let deviation = &outcome.deviation;
    let [a_to_b, b_to_a] = directions(deviation).map(|(_, directed)| directed);
    let report = Report {
        a: MeshFile::from(&outcome.a),
        b: MeshFile::from(&outcome.b),
        unit: &outcome.unit,
        accuracy: outcome.accuracy,
        threshold: outcome.threshold,
        distance: deviation.distance.into(),
        a_to_b: Directed::new(a_to_b),
        b_to_a: Directed::new(b_to_a),
        greater_percentiles: deviation.greater_percentiles.as_deref().map(percentiles),
        pooled: deviation.pooled.as_ref().map(Numbers::from),
        timing_ms: Timing {
            read: milliseconds(outcome.read),
            build: milliseconds(a_to_b.work.build + b_to_a.work.build),
            search: milliseconds(a_to_b.work.search + b_to_a.work.search),
            refine: milliseconds(a_to_b.work.refine + b_to_a.work.refine),
            total: milliseconds(outcome.total),
        },
    };
    Ok(serde_json::to_string(&report)? + "\n")
}

#[derive(Serialize)]
struct Report<'o> {
    a: MeshFile<'o>,
    b: MeshFile<'o>,
    unit: &'o str,
    accuracy: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    threshold: Option<f64>,
    /// Of the greater direction.
    distance: Bounds,
    a_to_b: Directed,
    b_to_a: Directed,
    /// Null where a mesh has no area.
    greater_percentiles: Option<Vec<PercentileEnds>>,
    pooled: Option<Numbers>,
    timing_ms: Timing,
}

#[derive(Serialize)]
struct Directed {
    distance: Bounds,
    witness: WitnessPoints,
    /// Null where the mesh has no area.
    statistics: Option<Numbers>,
    #[serde(skip_serializing_if = "Option::is_none")]
    vertices_inside: Option<usize>,
    regions: Vec<Place>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    beyond_threshold: Vec<Place>,
    stop: &'static str,
    work: Work,
}

impl Directed {
    fn new(directed: &DirectedDeviation) -> Self {
        let places = |regions: &[Region]| regions.iter().map(Place::from).collect();
        Self {
            distance: directed.distance.distance.into(),
            witness: WitnessPoints::new(&directed.distance.witness, directed.direction),
            statistics: directed.statistics.as_ref().map(Numbers::from),
            vertices_inside: directed.sides.as_ref().map(super::run::inside),
            regions: places(&directed.regions),
            beyond_threshold: places(&directed.beyond_threshold),
            stop: directed.stop.name(),
            work: directed.work.into(),
        }
    }
}

#[derive(Serialize)]
struct Numbers {
    area: f64,
    mean: Bounds,
    rms: Bounds,
    percentiles: Vec<PercentileEnds>,
    #[serde(skip_serializing_if = "Option::is_none")]
    share_above_threshold: Option<Bounds>,
    histogram: HistogramEnds,
}

impl From<&Statistics> for Numbers {
    fn from(statistics: &Statistics) -> Self {
        Self {
            area: statistics.area,
            mean: statistics.mean.into(),
            rms: statistics.rms.into(),
            percentiles: percentiles(&statistics.percentiles),
            share_above_threshold: statistics.above.map(|above| above.share.into()),
            histogram: (&statistics.histogram).into(),
        }
    }
}

#[derive(Serialize)]
struct PercentileEnds {
    share: f64,
    lower: f64,
    upper: f64,
}

fn percentiles(all: &[Percentile]) -> Vec<PercentileEnds> {
    let share = |p: &Percentile| PercentileEnds {
        share: p.share,
        lower: p.distance.lower(),
        upper: p.distance.upper(),
    };
    all.iter().map(share).collect()
}

#[derive(Serialize)]
struct HistogramEnds {
    edges: Vec<f64>,
    /// Shares of the area.
    bins: Vec<Bounds>,
    cumulative: Vec<Bounds>,
}

impl From<&Histogram> for HistogramEnds {
    fn from(histogram: &Histogram) -> Self {
        let bounds = |all: &[Enclosure]| all.iter().map(|e| Bounds::from(*e)).collect();
        Self {
            edges: histogram.edges.clone(),
            bins: bounds(&histogram.bins),
            cumulative: bounds(&histogram.cumulative),
        }
    }
}

#[derive(Serialize)]
struct Place {
    peak: Bounds,
    /// The point with the largest distance met, and a nearest one on the other mesh.
    at: Point,
    nearest: Point,
    level: f64,
    area: f64,
    centre: [f64; 3],
    lowest: [f64; 3],
    highest: [f64; 3],
    faces: Vec<u32>,
}

impl From<&Region> for Place {
    fn from(region: &Region) -> Self {
        Self {
            peak: region.peak.into(),
            at: region.witness.from.into(),
            nearest: region.witness.to.into(),
            level: region.level,
            area: region.area,
            centre: region.centre,
            lowest: region.aabb.lower,
            highest: region.aabb.upper,
            faces: region.faces.iter().map(|face| face.0).collect(),
        }
    }
}

#[derive(Serialize)]
struct Work {
    pieces: u64,
    looks: u64,
    distances: u64,
    rounds: u32,
}

impl From<DeviationWork> for Work {
    fn from(work: DeviationWork) -> Self {
        Self { pieces: work.pieces, looks: work.looks, distances: work.distances, rounds: work.rounds }
    }
}

#[derive(Serialize)]
struct Timing {
    read: f64,
    build: f64,
    search: f64,
    refine: f64,
    total: f64,
}
