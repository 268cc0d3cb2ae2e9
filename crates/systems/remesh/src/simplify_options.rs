//! What simplification is asked for, and what it returns.

use super::connectivity::ConnectivityError;
use super::features::{FeatureError, Features};
use super::guard::{IntersectionCount, Intersections, Intersects};
use super::lengths::{LengthError, NotWithin, check_length};
use pompeiu_core::mesh::repair::RepairError;
use pompeiu_core::mesh::{Coordinates, Rounding, TooCoarse};
use pompeiu_core::run::{Limits, ProgressObserver, StopReason};
use pompeiu_core::{MeshError, TriMesh, VertexId};
use pompeiu_hausdorff::SymmetricReport;
use std::time::Duration;

/// When simplification ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SimplifyTarget {
    /// As few faces as can be reached while the Pompeiu–Hausdorff distance from the input is at most this length.
    Within(f64),
    /// At most this many faces, or as few as can be reached; the distance follows.
    Faces(usize),
}

/// The effort to make the distance small at a given number of faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Effort {
    /// Quadric errors alone decide.
    Fast,
    /// Every collapse is tested, as for a distance: some ten to twenty times the time of fast, mostly a third to a half of its distance.
    #[default]
    Best,
}

/// Options of [`simplify`](super::simplify()).
#[derive(Clone)]
pub struct SimplifyOptions<'o> {
    /// When it ends.
    pub target: SimplifyTarget,
    /// How much time is spent to make the distance small where a number of faces is asked for.
    pub effort: Effort,
    /// What is kept. By default nothing, not even the corners of boundaries; with any feature boundaries are curves that are kept, too.
    pub features: Features<'o>,
    /// Whether a mesh that is no oriented manifold is repaired first.
    pub repair: bool,
    /// The coordinates of the file that the result is for: every vertex is where the file can hold it, so that what is proven is true
    /// of the file.
    pub coordinates: Coordinates,
    /// The treatment of faces of the result that intersect.
    pub intersections: Intersections,
    /// Time and threads. When the time is over, the mesh reached so far is returned; it keeps the distance.
    pub limits: Limits,
    /// Is told how far the collapses have come.
    pub progress: Option<&'o dyn ProgressObserver>,
}

impl SimplifyOptions<'_> {
    /// No limits, and nobody who watches.
    pub fn new(target: SimplifyTarget) -> Self {
        Self {
            target,
            effort: Effort::default(),
            features: Features::default(),
            repair: false,
            coordinates: Coordinates::default(),
            intersections: Intersections::Ignore,
            limits: Limits::default(),
            progress: None,
        }
    }

    /// The targets of some levels, the finest first, if they make sense for a mesh with this diagonal.
    pub(super) fn targets(&self, diagonal: f64, levels: usize) -> Result<Vec<SimplifyTarget>, SimplifyError> {
        if levels == 0 {
            return Err(SimplifyError::NoLevels);
        }
        if diagonal == 0.0 {
            return Err(SimplifyError::OnePosition);
        }
        let halved = |times: usize| match self.target {
            SimplifyTarget::Within(d) => SimplifyTarget::Within(d * (-(times as f64)).exp2()),
            SimplifyTarget::Faces(n) => {
                let factor = 1_usize.checked_shl(times as u32).unwrap_or(usize::MAX);
                SimplifyTarget::Faces(n.saturating_mul(factor))
            }
        };
        let targets = (0..levels).rev().map(halved);
        targets.map(|target| Self::check(target, diagonal).map(|()| target)).collect()
    }

    fn check(target: SimplifyTarget, diagonal: f64) -> Result<(), SimplifyError> {
        match target {
            SimplifyTarget::Within(d) => Ok(check_length("distance", d, diagonal)?),
            SimplifyTarget::Faces(0) => Err(SimplifyError::NoFaces),
            SimplifyTarget::Faces(_) => Ok(()),
        }
    }
}

/// A simplified mesh and how far it is from the input.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The mesh; vertices without faces are left out.
    pub mesh: TriMesh,
    /// The edges of the mesh that are on curves, if [features](SimplifyOptions::features) were asked for: boundaries, creases and
    /// selected edges of the input.
    pub kept: Vec<[VertexId; 2]>,
    /// What was asked for.
    pub target: SimplifyTarget,
    /// What rounding to the coordinates of the file does to the input.
    pub rounding: Rounding,
    /// Both directed distances, enclosed: A is the input, B the result.
    pub distance: SymmetricReport,
    /// How many pairs of faces intersect, where that was asked for.
    pub intersections: Option<IntersectionCount>,
    /// Number of edges collapsed.
    pub collapses: usize,
    /// Why the number of faces asked for was not reached; none where it was, or where a limit ended the computation.
    pub refusals: Option<Refusals>,
    /// Why it ended: [`StopReason::Tolerance`] if the number of faces is reached, or no further edge can be collapsed within the distance;
    /// [`StopReason::Stalled`] if no further edge can be collapsed, though there are more faces than asked for.
    pub stop: StopReason,
    /// The time that it took.
    pub timing: SimplifyTiming,
}

/// The reasons for which the edges of a result cannot be collapsed, where it has more faces than asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Refusals {
    /// Number of edges of the result.
    pub edges: usize,
    /// Number of edges whose collapse would change the topology.
    pub topology: usize,
    /// Number of edges whose collapse would change a curve that is kept.
    pub features: usize,
    /// Number of edges whose collapse would turn a face over.
    pub normals: usize,
    /// Number of edges whose collapse would make faces intersect.
    pub intersections: usize,
    /// A number of faces below which no surface of this topology is.
    pub least_faces: usize,
}

/// Wall-clock times of a simplification; milliseconds in JSON.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SimplifyTiming {
    /// Collapsing edges, preparation included.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub collapse: Duration,
    /// Measuring the distance of the result.
    #[cfg_attr(feature = "serde", serde(serialize_with = "pompeiu_core::run::as_milliseconds::serialize"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub distance: Duration,
}

/// Why a mesh was not simplified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimplifyError {
    /// A length cannot be converted to the unit of the mesh.
    #[error(transparent)]
    Unit(#[from] pompeiu_core::request::LengthError),
    /// The faces are no oriented manifold.
    #[error(transparent)]
    Connectivity(#[from] ConnectivityError),
    /// The distance makes no sense.
    #[error(transparent)]
    Length(#[from] LengthError),
    /// What is to be kept makes no sense.
    #[error(transparent)]
    Features(#[from] FeatureError),
    /// The mesh could not be repaired.
    #[error(transparent)]
    Repair(#[from] RepairError),
    /// No target is asked for, or more than one.
    #[error("what to reach is given in one way: within, relative or faces; choose one")]
    OneTarget,
    /// The effort applies where a number of faces is asked for.
    #[error(
        "the effort is for a number of faces; within a distance every collapse is tested, so leave it out"
    )]
    EffortWithin,
    /// The mesh has no size.
    #[error("all vertices of faces are at one position, so there is no surface to simplify")]
    OnePosition,
    /// No face was asked for.
    #[error("the number of faces is 0; at least 1 is needed")]
    NoFaces,
    /// No level of detail was asked for.
    #[error("the number of levels is 0; at least 1 is needed")]
    NoLevels,
    /// The numbers of the file are too coarse for the distance.
    #[error(transparent)]
    TooCoarse(#[from] TooCoarse),
    /// The result is no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The distance of the result could not be confirmed.
    #[error(transparent)]
    NotWithin(#[from] NotWithin),
    /// Faces of the result intersect.
    #[error(transparent)]
    Intersects(#[from] Intersects),
}
