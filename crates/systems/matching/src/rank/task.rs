//! The tasks: pure functions of a template, a mesh and a request, whose results are plain values.

use super::bounds::{box_upper_bound, support_lower_bound};
use super::summary::Summary;
use super::template::Template;
use crate::align::{AlignError, Matrix, affine, align, matrix};
use pompeiu_core::mesh::transform;
use pompeiu_core::{FaceId, MeshError, TriMesh};
use pompeiu_hausdorff::{DirectedReport, Enclosure, HausdorffOptions, StopReason, Target, Tolerance};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Something to be done with one target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Task {
    /// The target, in the order they were given in.
    pub target: usize,
    /// What to do.
    pub action: Action,
}

/// What a task does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// [`look`].
    Look,
    /// [`refine`].
    Refine(Request),
}

/// How narrow an enclosure is wanted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Its width, as a fraction of the diagonal of the joint box.
    pub tolerance: f64,
    /// A distance beyond which it does not matter any more.
    pub threshold: Option<f64>,
    /// The map of the target, as found when it was looked at.
    pub transform: Option<Matrix>,
}

/// What came of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Of [`Action::Look`].
    Seen(Sight),
    /// Of [`Action::Refine`].
    Refined(Refined),
    /// The target cannot be used, and why.
    Failed(String),
}

/// What a first look tells about a target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sight {
    /// Vertices of the target.
    pub vertices: usize,
    /// Faces of the target.
    pub faces: usize,
    /// The map that brings it onto the template, if one was wanted.
    pub transform: Option<Matrix>,
    /// The diagonal of the joint box of the template and the target as moved.
    pub diagonal: f64,
    /// Proven lower bound, from directions.
    pub support_lower: f64,
    /// Proven lower bound, from a few points of the target.
    pub probe_lower: f64,
    /// Proven upper bound, from boxes.
    pub upper: f64,
    /// Point–triangle distances evaluated.
    pub distances: u64,
}

/// What a search tells about a target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refined {
    /// Proven lower bound.
    pub lower: f64,
    /// Proven upper bound; none where the search ended beyond the threshold and knows of none.
    pub upper: Option<f64>,
    /// Point–triangle distances evaluated.
    pub distances: u64,
    /// Trees built.
    pub trees: u64,
}

/// Does a task with the mesh of its target.
pub fn perform(template: &Template, mesh: &TriMesh, action: &Action) -> Outcome {
    match action {
        Action::Look => match look(template, mesh) {
            Ok(sight) => Outcome::Seen(sight),
            Err(error) => Outcome::Failed(error.to_string()),
        },
        Action::Refine(request) => match refine(template, mesh, request) {
            Ok(refined) => Outcome::Refined(refined),
            Err(error) => Outcome::Failed(error.to_string()),
        },
    }
}

/// Points of a target that are measured at first sight.
const PROBES: usize = 64;

/// Width of the enclosure of their distance, as a fraction of the joint diagonal.
const PROBE_TOLERANCE: f64 = 1e-3;

/// Aligns a target, and encloses its distance without a tree of it.
///
/// # Errors
/// [`AlignError`], when it cannot be aligned.
///
/// # Cost
/// O(n + m), a few closest-point questions, and the alignment.
pub fn look(template: &Template, mesh: &TriMesh) -> Result<Sight, AlignError> {
    let measure = template.options.measure;
    let map = match &template.fixed {
        Some(fixed) => align(mesh, fixed, template.options.alignment)?,
        None => None,
    };
    let transform = map.map(|map| matrix(&map));
    let mesh = moved(mesh, transform.as_ref()).map_err(|_| AlignError::Sizes)?;
    let summary = Summary::new(&mesh);
    let [one, other] = [template.summary.aabb(), summary.aabb()];
    let probed = template.target.as_ref().map(|target| probe(&mesh, target));
    Ok(Sight {
        vertices: summary.vertices,
        faces: summary.faces,
        transform,
        diagonal: one.union(other).diagonal(),
        support_lower: support_lower_bound(&template.summary, &summary, measure),
        probe_lower: probed.as_ref().map_or(0.0, |report| report.distance.lower()),
        upper: box_upper_bound(&one, &other, measure),
        distances: probed.map_or(0, |report| report.work.distances),
    })
}

/// The target as moved.
fn moved<'m>(mesh: &'m TriMesh, by: Option<&Matrix>) -> Result<Cow<'m, TriMesh>, MeshError> {
    by.map_or(Ok(Cow::Borrowed(mesh)), |by| transform(mesh, &affine(by)).map(Cow::Owned))
}

/// How far some corners of a mesh are from a target: corners of faces at equal steps, as a mesh of points. What holds for a
/// part of a mesh is a lower bound for all of it.
fn probe(mesh: &TriMesh, target: &Target) -> DirectedReport {
    let faces = mesh.faces().len();
    let count = PROBES.min(faces);
    let points = (0..count).map(|i| mesh.corners(FaceId((i * faces / count) as u32))[i % 3]).collect();
    let points = TriMesh::new(points, (0..count as u32).map(|i| [i; 3]).collect())
        .expect("points of a mesh have valid coordinates");
    directed_to(&points, target, PROBE_TOLERANCE, None)
}

/// A directed distance with a tolerance and a threshold that were checked with the options; the defaults take the place of
/// those of a request that were not.
fn directed_to(from: &TriMesh, to: &Target, tolerance: f64, threshold: Option<f64>) -> DirectedReport {
    let tolerance = Tolerance::RelativeToDiagonal(tolerance);
    let options = HausdorffOptions { tolerance, threshold, ..HausdorffOptions::default() };
    let options = if options.check().is_ok() { options } else { HausdorffOptions::default() };
    options.directed_to(from, to).expect("the options were checked")
}

/// Encloses the distance of a target as moved, or shows that it exceeds the threshold.
///
/// # Errors
/// [`MeshError`], when the moved mesh leaves the supported range; it does not if the map is that of a [`look`].
///
/// # Cost
/// One search for each direction that counts, and the tree of the target where distances from it do; a search that ends
/// below the threshold starts again without one.
pub fn refine(template: &Template, mesh: &TriMesh, request: &Request) -> Result<Refined, MeshError> {
    let mesh = moved(mesh, request.transform.as_ref())?;
    let mut found = Refined { lower: 0.0, upper: Some(0.0), distances: 0, trees: 0 };
    // The tree of the template is there: the direction that needs no other comes first, and may be enough.
    if let Some(target) = &template.target {
        found.include(search(&mesh, target, request));
    }
    let beyond = request.threshold.is_some_and(|threshold| found.lower > threshold);
    if template.options.measure.has_template_to_target() {
        if beyond {
            found.upper = None;
        } else {
            found.trees = 1;
            found.include(search(&template.mesh, &Target::new(&mesh), request));
        }
    }
    Ok(found)
}

impl Refined {
    /// The larger of two distances.
    fn include(&mut self, (enclosure, distances): (Enclosure, u64)) {
        let larger = |x, y| if x > y { x } else { y };
        self.lower = larger(self.lower, enclosure.lower());
        self.upper = self.upper.map(|upper| larger(upper, enclosure.upper()));
        self.distances += distances;
    }
}

/// A directed search. A threshold ends it on either side; where the distance turns out to be below, the enclosure is
/// still to be narrowed.
fn search(from: &TriMesh, to: &Target, request: &Request) -> (Enclosure, u64) {
    let first = directed_to(from, to, request.tolerance, request.threshold);
    if request.threshold.is_none() {
        return (first.distance, first.work.distances);
    }
    let below = request.threshold.is_some_and(|t| first.distance.lower() <= t);
    if first.stop != StopReason::Threshold || !below {
        return (first.distance, first.work.distances);
    }
    let second = directed_to(from, to, request.tolerance, None);
    let distances = first.work.distances + second.work.distances;
    let [one, other] = [first.distance, second.distance];
    let lower = if one.lower() > other.lower() { one.lower() } else { other.lower() };
    let upper = if one.upper() < other.upper() { one.upper() } else { other.upper() };
    (Enclosure::new(lower, upper).unwrap_or(other), distances)
}

impl From<Result<Outcome, String>> for Outcome {
    fn from(result: Result<Outcome, String>) -> Self {
        result.unwrap_or_else(Self::Failed)
    }
}
