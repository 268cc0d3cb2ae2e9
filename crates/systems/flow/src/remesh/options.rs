//! What simplification is asked for, and what it returns.

use super::connectivity::ConnectivityError;
use pompeiu_core::run::{Limits, ProgressObserver, StopReason};
use pompeiu_core::{MeshError, TriMesh};
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

/// Options of [`simplify`](super::simplify()).
#[derive(Clone)]
pub struct SimplifyOptions<'o> {
    /// When it ends.
    pub target: SimplifyTarget,
    /// Time and threads. When the time is over, the mesh reached so far is returned; it keeps the distance.
    pub limits: Limits,
    /// Is told how far the collapses have come.
    pub progress: Option<&'o dyn ProgressObserver>,
}

impl SimplifyOptions<'_> {
    /// Least distance that can be asked for, as a fraction of the diagonal of the bounding box: some 4,500 units in the last place
    /// of the largest coordinate.
    const LEAST_DISTANCE: f64 = 1e-12;

    /// No limits, and nobody who watches.
    pub fn new(target: SimplifyTarget) -> Self {
        Self { target, limits: Limits::default(), progress: None }
    }

    /// The targets of some levels, the finest first, if they make sense for a mesh with this diagonal.
    pub(super) fn targets(&self, diagonal: f64, levels: usize) -> Result<Vec<SimplifyTarget>, SimplifyError> {
        if levels == 0 {
            return Err(SimplifyError::NoLevels);
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
        let least = Self::LEAST_DISTANCE * diagonal;
        match target {
            SimplifyTarget::Within(d) if !(d > 0.0 && d < f64::INFINITY) => Err(SimplifyError::Distance(d)),
            SimplifyTarget::Within(distance) if distance < least => {
                Err(SimplifyError::BelowRounding { distance, least })
            }
            SimplifyTarget::Faces(0) => Err(SimplifyError::NoFaces),
            _ => Ok(()),
        }
    }
}

/// A simplified mesh and how far it is from the input.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The mesh; vertices without faces are left out.
    pub mesh: TriMesh,
    /// What was asked for.
    pub target: SimplifyTarget,
    /// Both directed distances, enclosed: A is the input, B the result.
    pub distance: SymmetricReport,
    /// Number of edges collapsed.
    pub collapses: usize,
    /// Why it ended: [`StopReason::Tolerance`] if no further edge can be collapsed or the number of faces is reached.
    pub stop: StopReason,
    /// How long it took.
    pub timing: SimplifyTiming,
}

/// Wall-clock times of a simplification.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SimplifyTiming {
    /// Collapsing edges, preparation included.
    pub collapse: Duration,
    /// Measuring the distance of the result.
    pub distance: Duration,
}

/// Why a mesh was not simplified.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimplifyError {
    /// The faces are no oriented manifold.
    #[error(transparent)]
    Connectivity(#[from] ConnectivityError),
    /// The distance is not a positive finite number.
    #[error("the distance is {0}; it must be a positive finite number")]
    Distance(f64),
    /// The distance is too small for double precision.
    #[error(
        "the distance {distance} is below {least}, the least that double precision resolves for these coordinates; ask for more"
    )]
    BelowRounding {
        /// What was asked for.
        distance: f64,
        /// The least that can be asked for.
        least: f64,
    },
    /// No face was asked for.
    #[error("the number of faces is 0; at least 1 is needed")]
    NoFaces,
    /// No level of detail was asked for.
    #[error("the number of levels is 0; at least 1 is needed")]
    NoLevels,
    /// The result is no mesh.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// The distance of the result could not be confirmed.
    #[error("the result is up to {upper} away from the input, more than the {distance} asked for")]
    NotWithin {
        /// What was asked for.
        distance: f64,
        /// The proven upper bound.
        upper: f64,
    },
}
