//! What a flow returns.

use super::discs::Discs;
use super::existence::Cone;
use super::gradient::GradientNorm;
use super::pinch::Neck;
use super::scheme::Scheme;
use super::stability::Stability;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::Rounding;
use pompeiu_remesh::IntersectionCount;
use std::time::Duration;

/// The reason for which a flow ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub enum FlowStop {
    /// The gradient along the normal is as small as asked.
    Stationary,
    /// The time was reached.
    Time,
    /// The number of steps was reached.
    Steps,
    /// A neck has become too narrow for the mesh, or the surface has shrunk to almost nothing.
    Pinched,
    /// No step makes the area less, or hardly, though the gradient is larger than asked.
    Stalled,
    /// Triangles have become so thin that nothing can be said of the surface; remeshing did not help, or was not to be used.
    Degenerate,
    /// The limit on the time of the computation was reached.
    Limit,
    /// The observer asked for it.
    Cancelled,
}

impl FlowStop {
    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stationary => "stationary",
            Self::Time => "time",
            Self::Steps => "steps",
            Self::Pinched => "pinched",
            Self::Stalled => "stalled",
            Self::Degenerate => "degenerate",
            Self::Limit => "limit",
            Self::Cancelled => "cancelled",
        }
    }
}

/// The constraint that decided the size of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[non_exhaustive]
pub enum StepReason {
    /// The surface given.
    Start,
    /// The scheme asked for.
    Scheme,
    /// An implicit step smooths the surface before Newton's method.
    Smoothing,
    /// The Hessian is not positive definite; it was blended with the stiffness matrix.
    NotDefinite,
    /// Newton's step would make the area greater, or turn a face over: gradient descent instead.
    AreaWouldRise,
    /// Newton's matrix could not be factored: gradient descent instead.
    NotFactored,
    /// No connected minimal surface exists, so the surface flows in time.
    NoMinimalSurface,
    /// Edges were flipped and vertices moved within the surface.
    Improved,
    /// The surface was remeshed.
    Remeshed,
}

impl StepReason {
    /// The name in commands and reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::Scheme => "scheme",
            Self::Smoothing => "smoothing",
            Self::NotDefinite => "not-definite",
            Self::AreaWouldRise => "area-would-rise",
            Self::NotFactored => "not-factored",
            Self::NoMinimalSurface => "no-minimal-surface",
            Self::Improved => "improved",
            Self::Remeshed => "remeshed",
        }
    }
}

/// The surface after a step.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FlowRecord {
    /// Time of the flow, in squared lengths; none once a step without a length in time was made.
    pub time: Option<f64>,
    /// Area of the surface.
    pub area: f64,
    /// The gradient of the area.
    pub gradient: GradientNorm,
    /// The scheme that moved the surface.
    pub scheme: Scheme,
    /// Why.
    pub reason: StepReason,
}

/// A quantity before and after.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Change {
    /// Of the surface given.
    pub initial: f64,
    /// Of the result.
    pub r#final: f64,
}

/// Where a flow ended, and how it came there. As data it has the numbers of vertices and faces in place of the surface. Lengths are in the unit of
/// the mesh, times in its square.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Flow {
    /// The surface it ended in.
    #[cfg_attr(feature = "serde", serde(flatten, serialize_with = "counts"))]
    #[cfg_attr(feature = "schema", schemars(with = "Counts"))]
    pub mesh: TriMesh,
    /// The reason for which it ended.
    pub stop: FlowStop,
    /// Number of steps.
    pub steps: usize,
    /// Area.
    pub area: Change,
    /// Volume of the cone from the origin over the surface: that enclosed if it is closed. None for a surface with a boundary
    /// that slides.
    pub volume: Option<Change>,
    /// The gradient of the area at the end.
    pub gradient: GradientNorm,
    /// By how much the area changes with the volume, where that is kept: twice the mean curvature.
    pub pressure: Option<f64>,
    /// Every step, the surface given first.
    pub history: Vec<FlowRecord>,
    /// Whether a stationary surface is a local minimum.
    pub stability: Option<Stability>,
    /// The discs that span the boundary loops one by one, where there are two.
    pub discs: Option<Discs>,
    /// A cone that separates the two boundary loops so that no connected minimal surface spans them.
    pub cone: Option<Cone>,
    /// The place of the largest gradient of a flow that stalled, or of the thinnest triangle of one that became degenerate.
    pub place: Option<[f64; 3]>,
    /// The neck that pinches off.
    pub neck: Option<Neck>,
    /// The effect on the last surface of rounding to the coordinates of the file; area and gradient are those before.
    pub rounding: Rounding,
    /// The number of pairs of faces of the result that intersect, where requested.
    pub intersections: Option<IntersectionCount>,
    /// The time that it took.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: FlowTiming,
}

/// The numbers of vertices and faces of a surface.
#[cfg(feature = "serde")]
#[derive(serde::Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
struct Counts {
    /// Number of vertices of the surface it ended in.
    vertices: usize,
    /// Number of its faces.
    faces: usize,
}

#[cfg(feature = "serde")]
fn counts<S: serde::Serializer>(mesh: &TriMesh, serializer: S) -> Result<S::Ok, S::Error> {
    let counts = Counts { vertices: mesh.positions().len(), faces: mesh.faces().len() };
    serde::Serialize::serialize(&counts, serializer)
}

/// Wall-clock times of a flow; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FlowTiming {
    /// Steps: assembling, factoring, solving, line searches.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub steps: Duration,
    /// Flips, moves within the surface, remeshing.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub remesh: Duration,
    /// Stability, discs, cone, necks.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub verdict: Duration,
}
