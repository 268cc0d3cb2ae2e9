//! The tasks: pure functions of a template, a mesh and a request, whose results are plain values.

use super::bounds::{box_upper_bound, support_lower_bound};
use super::options::Measure;
use super::summary::Summary;
use super::template::Template;
use crate::align::{AlignError, Matrix, affine, align, matrix};
use crate::tasks::{MeasuredTo, bytes_of, holding};
use pompeiu_core::mesh::transform;
use pompeiu_core::{FaceId, MeshError, TriMesh};
use pompeiu_hausdorff::{DirectedReport, HausdorffOptions, OptionError, StopReason, Target, Tolerance};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// A task for one target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Task {
    /// The index of the target in the input.
    pub target: usize,
    /// The action.
    pub action: Action,
}

/// The action of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// [`look`].
    Look,
    /// [`refine`].
    Refine(Request),
}

/// A request for an enclosure.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Request {
    /// Its width.
    #[serde(flatten)]
    pub tolerance: Tolerance,
    /// A distance beyond which the target no longer matters.
    pub threshold: Option<f64>,
    /// The map of the target, from its first look.
    pub transform: Option<Matrix>,
}

/// The result of a task.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The result of [`Action::Look`].
    Seen(Sight),
    /// The result of [`Action::Refine`].
    Refined(Box<Refined>),
    /// The target cannot be used, for this reason.
    Failed(String),
}

/// The result of a first look at a target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sight {
    /// Vertices of the target.
    pub vertices: usize,
    /// Faces of the target.
    pub faces: usize,
    /// The map that aligns it to the template, if requested.
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

/// The results of searches for a target: the reports of the directed distances that were needed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Refined {
    /// The distance from target to template.
    pub target_to_template: Option<DirectedReport>,
    /// The distance from template to target; not searched if the other one exceeds the threshold.
    pub template_to_target: Option<DirectedReport>,
}

impl Refined {
    fn reports(&self) -> impl Iterator<Item = &DirectedReport> {
        self.target_to_template.iter().chain(&self.template_to_target)
    }

    /// Proven lower bound.
    pub fn lower(&self) -> f64 {
        self.reports().map(|report| report.distance.lower()).fold(0.0, larger)
    }

    /// Proven upper bound; `None` if a required distance was not searched.
    pub fn upper(&self, measure: Measure) -> Option<f64> {
        let missing = (measure.has_target_to_template() && self.target_to_template.is_none())
            || (measure.has_template_to_target() && self.template_to_target.is_none());
        (!missing).then(|| self.reports().map(|report| report.distance.upper()).fold(0.0, larger))
    }

    /// Point–triangle distances evaluated.
    pub fn distances(&self) -> u64 {
        self.reports().map(|report| report.work.distances).sum()
    }

    /// Trees of targets that were built.
    pub fn trees(&self) -> u64 {
        u64::from(self.template_to_target.is_some())
    }

    /// Why a search ended early, if one did: the bounds are then wider than asked.
    pub fn stop(&self) -> Option<StopReason> {
        self.reports().map(|report| report.stop).find(|stop| stop.is_early())
    }
}

fn larger(x: f64, y: f64) -> f64 {
    if x > y { x } else { y }
}

impl Outcome {
    /// Whether the task was completed, and not ended early by a limit or an observer: such a result is always the same.
    pub fn is_complete(&self) -> bool {
        match self {
            Self::Seen(_) => true,
            Self::Refined(refined) => refined.stop().is_none(),
            Self::Failed(_) => false,
        }
    }
}

/// Runs a task with the mesh of its target.
///
/// The limits and the observer of `search` apply to each search; tolerance and threshold come from the task. The memory limit
/// covers the template, the mesh and the search together. [`HausdorffOptions::default`] sets no limits.
pub fn perform(
    template: &Template,
    mesh: &TriMesh,
    action: &Action,
    search: &HausdorffOptions<'_>,
) -> Outcome {
    match action {
        Action::Look => match look(template, mesh) {
            Ok(sight) => Outcome::Seen(sight),
            Err(error) => Outcome::Failed(error.to_string()),
        },
        Action::Refine(request) => match refine(template, mesh, request, search) {
            Ok(refined) => Outcome::Refined(Box::new(refined)),
            Err(error) => Outcome::Failed(error.to_string()),
        },
    }
}

/// Number of points of a target that are measured in its first look.
const PROBES: usize = 64;

/// Width of the enclosure of their distance, relative to the joint diagonal.
const PROBE_TOLERANCE: f64 = 1e-3;

/// Aligns a target, and encloses its distance without building its tree.
///
/// # Errors
/// [`AlignError`] if it cannot be aligned.
///
/// # Cost
/// O(n + m), a few closest-point queries, and the alignment.
pub fn look(template: &Template, mesh: &TriMesh) -> Result<Sight, AlignError> {
    let measure = template.measure;
    let map = match &template.fixed {
        Some(fixed) => align(mesh, fixed, template.alignment)?,
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

/// The directed distance of some corners of a mesh from a target: corners of faces at equal steps, as a mesh of points. A lower
/// bound for a part of a mesh is a lower bound for the whole.
fn probe(mesh: &TriMesh, target: &Target) -> DirectedReport {
    let faces = mesh.faces().len();
    let count = PROBES.min(faces);
    let points = (0..count).map(|i| mesh.corners(FaceId((i * faces / count) as u32))[i % 3]).collect();
    let points = TriMesh::new(points, (0..count as u32).map(|i| [i; 3]).collect())
        .expect("points of a mesh have valid coordinates");
    let tolerance = Tolerance::RelativeToDiagonal(PROBE_TOLERANCE);
    let options = HausdorffOptions { tolerance, ..HausdorffOptions::default() };
    options.directed_to(&points, target).expect("the tolerance is positive and finite")
}

/// Why a target cannot be searched: the request or map does not come from a [`Ranking`](super::Ranking) or a [`look`].
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RefineError {
    /// The moved mesh leaves the supported range.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The tolerance or the threshold is invalid.
    #[error(transparent)]
    Option(#[from] OptionError),
}

/// Encloses the distance of a target as moved, or shows that it exceeds the threshold. [`perform`] describes `search`.
///
/// # Errors
/// [`RefineError`].
///
/// # Cost
/// One search for each required direction, and the tree of the target if the direction to it is required. A search that ends below
/// the threshold is repeated without one.
pub fn refine(
    template: &Template,
    mesh: &TriMesh,
    request: &Request,
    search: &HausdorffOptions<'_>,
) -> Result<Refined, RefineError> {
    let moved = moved(mesh, request.transform.as_ref())?;
    let mut search =
        HausdorffOptions { tolerance: request.tolerance, threshold: request.threshold, ..search.clone() };
    search.check()?;
    // A search counts its own meshes against the memory limit; in addition there are the template or its tree, and the original
    // mesh.
    let original = if matches!(moved, Cow::Owned(_)) { bytes_of(mesh) } else { 0 };
    let mut found = Refined { target_to_template: None, template_to_target: None };
    // The tree of the template exists already, so this direction comes first, and may be sufficient.
    let held = original + template.bytes();
    if let Some(target) = &template.target {
        let mut search = search.clone();
        holding(&mut search, held);
        found.target_to_template = Some(narrowed(&search, |search| search.directed_to(&moved, target))?);
    }
    let beyond = request.threshold.is_some_and(|threshold| found.lower() > threshold);
    if template.measure.has_template_to_target() && !beyond {
        let tree = template.target.as_ref().map_or(0, Target::bytes);
        holding(&mut search, original + tree);
        let held = template.bytes() + bytes_of(&moved);
        let target = MeasuredTo::new(&moved, search.limits.memory.map(|memory| memory.saturating_sub(held)));
        found.template_to_target = Some(narrowed(&search, |search| target.directed(&template.mesh, search))?);
    }
    Ok(found)
}

/// A directed search. A threshold ends it on either side; if the distance is below, the enclosure still has to be narrowed.
fn narrowed(
    options: &HausdorffOptions<'_>,
    search: impl Fn(&HausdorffOptions<'_>) -> Result<DirectedReport, OptionError>,
) -> Result<DirectedReport, OptionError> {
    let first = search(options)?;
    let below = options.threshold.is_some_and(|t| first.distance.lower() <= t);
    if first.stop != StopReason::Threshold || !below {
        return Ok(first);
    }
    let second = search(&HausdorffOptions { threshold: None, ..options.clone() })?;
    Ok(first.narrowed_by(&second))
}

impl From<Result<Outcome, String>> for Outcome {
    fn from(result: Result<Outcome, String>) -> Self {
        result.unwrap_or_else(Self::Failed)
    }
}
