//! What a running search tells, and how it is told to stop.

use crate::report::{Direction, Enclosure};
use pompeiu_core::FaceId;
use std::fmt;
use std::ops::ControlFlow;

/// How far a search has come. Lengths are in the unit of the meshes; the bounds are not yet certified.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The direction searched.
    pub direction: Direction,
    /// Largest distance met so far.
    pub lower: f64,
    /// Largest bound of a piece that is not yet discarded, or of one that was.
    pub upper: f64,
    /// Faces and pieces examined so far.
    pub examined: u64,
    /// Faces and pieces known to be left; cutting adds to them.
    pub left: u64,
    /// About the share of the call that is done, between 0 and 1: of a deviation all stages of all directions, else what was examined as a
    /// share of what is known. It says nothing of time, and can fall where cutting adds pieces.
    pub share: f64,
}

impl Progress {
    /// With the share of what is known to be there that was examined.
    pub(crate) fn new(direction: Direction, [lower, upper]: [f64; 2], examined: u64, left: u64) -> Self {
        let share = examined as f64 / examined.saturating_add(left).max(1) as f64;
        Self { direction, lower, upper, examined, left, share }
    }

    /// The same as a stage that takes a call from one share to another.
    pub(crate) fn as_stage(self, [from, to]: [f64; 2]) -> Self {
        Self { share: from + self.share * (to - from), ..self }
    }
}

/// Why no point of a discarded piece is farther from B than its bound.
#[derive(Clone, Debug, PartialEq)]
pub enum Proof {
    /// All corners are that near to this one face, and the distance from a convex set is a convex function.
    Face(FaceId),
    /// At every corner the weighted mean of the distances from these faces is at most the bound; the mean is convex, and
    /// nowhere below the distance from the nearest of them.
    Mixture(Vec<(FaceId, f64)>),
}

/// A piece of a face of A that needs no further look.
#[derive(Clone, Debug, PartialEq)]
pub struct Discard {
    /// The face of A that the piece is a part of.
    pub face: FaceId,
    /// Corners of the piece, in the unit of the meshes.
    pub corners: [[f64; 3]; 3],
    /// The faces of B, and their weights.
    pub proof: Proof,
    /// Proven bound on the distance of the piece from B.
    pub bound: f64,
}

/// The state of a search at one of the tolerances asked for by [`HausdorffOptions::stages`](crate::HausdorffOptions::stages).
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// The direction searched.
    pub direction: Direction,
    /// The tolerance of this stage, a length.
    pub tolerance: f64,
    /// The same as a fraction of the joint diagonal.
    pub fraction: f64,
    /// Largest distance met so far, rounded.
    pub lower: f64,
    /// Proven upper bound.
    pub upper: f64,
    /// What is left of A: pieces that may still hold a point farther than `lower`.
    pub remaining: Vec<RemainingPiece>,
    /// Point–triangle distances evaluated since the start.
    pub distances: u64,
    /// Wall-clock time since the start.
    pub elapsed: std::time::Duration,
}

/// A piece of A that may still hold the maximum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RemainingPiece {
    /// The face that it is a part of.
    pub face: FaceId,
    /// Its corners, in the unit of the meshes.
    pub corners: [[f64; 3]; 3],
    /// Proven bound on its distance from B.
    pub bound: f64,
}

/// What is known of the mean distance of a direction while it is being enclosed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MeanSoFar {
    /// From the corners and centroids of about a thousand faces: nothing is proven of it.
    Sampled(f64),
    /// Proven to hold the mean over the area.
    Enclosed(Enclosure),
}

/// Watches a search. Calls come from one thread at a time, in an order that does not depend on the number of threads.
///
/// Methods take `&self`, so that one observer can be among the options of several searches; what it collects goes into a
/// `Mutex` or an atomic.
pub trait Observer: Send + Sync {
    /// Called a few times a second at least on long searches; [`ControlFlow::Break`] ends the search with what is proven.
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        let _ = progress;
        ControlFlow::Continue(())
    }

    /// Whether [`Observer::discard`] should be called; it costs time and memory.
    fn wants_discards(&self) -> bool {
        false
    }

    /// Called for every piece of A that is discarded by the fast method. Unless a limit, a threshold or this observer ends the
    /// search early, the pieces cover A where no stages were asked for, and overlap little; with stages, pieces that a finer
    /// tolerance looks at again come again.
    fn discard(&self, discard: &Discard) {
        let _ = discard;
    }

    /// Whether [`Observer::mean`] should be called; it takes one more look at what is known of each face.
    fn wants_mean(&self) -> bool {
        false
    }

    /// Called by a deviation analysis of a surface with an area: once with a sampled mean before faces are cut, and, where
    /// triangles of pieces are summed up at once, while they are cut, with enclosures of which each lies in the one before.
    fn mean(&self, direction: Direction, mean: MeanSoFar) {
        let _ = (direction, mean);
    }

    /// Called after each stage that was reached, and once more at the tolerance asked for. Not called where no stages were asked
    /// for.
    fn stage(&self, stage: &Stage) {
        let _ = stage;
    }
}

/// Watches nothing.
impl Observer for () {}

impl fmt::Debug for dyn Observer + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Observer")
    }
}
