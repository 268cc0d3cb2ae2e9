//! What a query answers.

mod enclosure;
mod witness;

pub use enclosure::Enclosure;
pub use pompeiu_core::run::StopReason;
pub use witness::{PointPair, SurfacePoint, Witness};

use std::time::Duration;

/// One of the two directed distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Direction {
    /// The distance of points of A from B.
    #[cfg_attr(feature = "serde", serde(rename = "a_to_b"))]
    AToB,
    /// The distance of points of B from A.
    #[cfg_attr(feature = "serde", serde(rename = "b_to_a"))]
    BToA,
}

impl Direction {
    /// From which share of a call for both directions to which this one takes it.
    pub(crate) fn share_of_both(self) -> [f64; 2] {
        match self {
            Self::AToB => [0.0, 0.5],
            Self::BToA => [0.5, 1.0],
        }
    }
}

/// The work that was done, in counts that do not depend on the machine or the number of threads.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WorkCount {
    /// Closest-point questions asked of the tree.
    pub queries: u64,
    /// Point–triangle distances evaluated.
    pub distances: u64,
    /// Pieces of A examined, whole faces included.
    pub pieces: u64,
    /// Matrix games solved for mixture bounds.
    pub games: u64,
    /// Pieces cut in two.
    pub cuts: u64,
    /// Deepest piece, in cuts.
    pub depth: u32,
}

impl WorkCount {
    pub(crate) fn add(&mut self, other: &Self) {
        self.queries += other.queries;
        self.distances += other.distances;
        self.pieces += other.pieces;
        self.games += other.games;
        self.cuts += other.cuts;
        self.depth = self.depth.max(other.depth);
    }
}

/// Wall-clock time of the parts of a query. Serialised in milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Timing {
    /// Building trees; zero where a prepared target was given.
    #[cfg_attr(feature = "serde", serde(with = "pompeiu_core::run::as_milliseconds"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub build: Duration,
    /// Everything else.
    #[cfg_attr(feature = "serde", serde(with = "pompeiu_core::run::as_milliseconds"))]
    #[cfg_attr(feature = "schema", schemars(with = "f64"))]
    pub search: Duration,
}

/// The answer to a directed query.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DirectedReport {
    /// Encloses h of the meshes as stored, in their unit.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub distance: Enclosure,
    /// A point of A at least `distance.lower()` away from all of B, and a point of B nearest to it.
    pub witness: Witness,
    /// The reason for which the search ended.
    pub stop: StopReason,
    /// The width of the enclosure that was asked for, in the unit of the meshes.
    pub tolerance: f64,
    /// The work that was done.
    pub work: WorkCount,
    /// The time that it took.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

impl DirectedReport {
    /// The same of a distance that is known to be no greater than a length.
    pub(crate) fn at_most(self, length: Option<f64>) -> Self {
        let lesser = length.filter(|length| *length < self.distance.upper());
        let narrower = lesser.and_then(|upper| Enclosure::new(self.distance.lower(), upper));
        Self { distance: narrower.unwrap_or(self.distance), ..self }
    }

    /// This report and a later one of the same distance in one: the better of both ends, and the work and time of both.
    #[must_use]
    pub fn narrowed_by(&self, later: &Self) -> Self {
        let (best, other) =
            if later.distance.lower() < self.distance.lower() { (self, later) } else { (later, self) };
        let (upper, other_upper) = (best.distance.upper(), other.distance.upper());
        let upper = if other_upper < upper { other_upper } else { upper };
        let mut work = best.work;
        work.add(&other.work);
        Self {
            // Both intervals hold the distance, so that their ends do not cross.
            distance: Enclosure::new(best.distance.lower(), upper).unwrap_or(best.distance),
            witness: best.witness,
            stop: later.stop,
            tolerance: later.tolerance,
            work,
            timing: Timing {
                build: self.timing.build + later.timing.build,
                search: self.timing.search + later.timing.search,
            },
        }
    }
}

/// The answer to a symmetric query: both directed ones.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SymmetricReport {
    /// Encloses `H = max(h(A, B), h(B, A))`.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub distance: Enclosure,
    /// From A to B.
    pub a_to_b: DirectedReport,
    /// From B to A: the witness leads from B to A.
    pub b_to_a: DirectedReport,
}
