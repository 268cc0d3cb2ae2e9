//! Asking for a deviation analysis.

use super::report::{Deviation, DirectedDeviation};
use super::run::{Outcome, Pair, run};
use super::statistics::{Percentile, Summary, Wanted};
use crate::engine::joint_frame;
use crate::observer::Observer;
use crate::report::Direction;
use crate::target::Target;
use crate::tolerance::{OptionError, check_threshold};
use pompeiu_core::TriMesh;
use pompeiu_core::run::{Limits, on_threads};
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

/// A question about how far two meshes deviate from each other, where, and over how much of the area.
///
/// # Definition
/// See [`Statistics`](super::Statistics) for what is computed, and [`Deviation`] for the two directions.
/// # Accuracy
/// Every statistic is an enclosure of the exact value over all points of all faces, not of samples, rounding included. Faces are
/// cut into pieces on which the distance lies between two linear functions, until the mean and the root of the mean square
/// are as narrow as asked; then where percentiles and the share above the threshold ask for it.
/// # Limits
/// Percentiles where the distribution has a gap, and the share above a threshold at which much of the area lies, may stay wide: of
/// a plate of which half lies at height 1 and half at 2, the median is 1, but any doubt about the area makes it 2.
/// # Cost
/// About linear in the faces of both meshes on ordinary pairs.
/// # Example
/// ```
/// use pompeiu_core::TriMesh;
/// use pompeiu_hausdorff::DeviationQuery;
///
/// // A triangle, and one that leans away from it by up to 0.3.
/// let flat = TriMesh::new(vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], vec![[0, 1, 2]])?;
/// let leaning = TriMesh::new(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.3], [0.0, 1.0, 0.0]], vec![[0, 1, 2]])?;
/// let report = DeviationQuery::new().threshold(0.15)?.directed(&leaning, &flat);
/// let statistics = report.statistics.unwrap();
/// assert!(statistics.mean.contains(0.1));
/// assert!(statistics.above.unwrap().share.contains(0.25));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct DeviationQuery {
    pub(super) accuracy: f64,
    pub(super) floor: f64,
    pub(super) threshold: Option<f64>,
    pub(super) percentiles: Vec<f64>,
    pub(super) bins: usize,
    pub(super) regions: usize,
    pub(super) signed: bool,
    pub(super) most_pieces: usize,
    threads: Option<NonZeroUsize>,
    time_limit: Option<Duration>,
    pub(super) memory_limit: Option<usize>,
}

impl Default for DeviationQuery {
    fn default() -> Self {
        Self {
            accuracy: Self::DEFAULT_ACCURACY,
            floor: Self::FLOOR,
            threshold: None,
            percentiles: Self::DEFAULT_PERCENTILES.to_vec(),
            bins: Self::DEFAULT_BINS,
            regions: Self::DEFAULT_REGIONS,
            signed: false,
            most_pieces: Self::DEFAULT_PIECES,
            threads: None,
            time_limit: None,
            memory_limit: None,
        }
    }
}

impl DeviationQuery {
    /// Width of each enclosure relative to its lower end, by default.
    pub const DEFAULT_ACCURACY: f64 = 0.01;
    /// Widths below this fraction of the joint diagonal always suffice.
    pub const FLOOR: f64 = 1e-9;
    /// Shares whose percentiles are computed by default.
    pub const DEFAULT_PERCENTILES: [f64; 4] = [0.5, 0.9, 0.95, 0.99];
    /// Bins of the histogram, by default.
    pub const DEFAULT_BINS: usize = 64;
    /// Regions listed, by default.
    pub const DEFAULT_REGIONS: usize = 5;
    /// Pieces at most, in each direction, by default.
    pub const DEFAULT_PIECES: usize = 4_000_000;

    /// A question with the defaults, no limits, and the threads of the current pool.
    pub fn new() -> Self {
        Self::default()
    }

    /// How narrow enclosures should be, relative to their lower ends; of the share above the threshold, absolutely.
    ///
    /// # Errors
    /// [`OptionError::Tolerance`] unless it is finite and positive.
    pub fn accuracy(mut self, accuracy: f64) -> Result<Self, OptionError> {
        if !(accuracy > 0.0 && accuracy < f64::INFINITY) {
            return Err(OptionError::Tolerance(accuracy));
        }
        self.accuracy = accuracy;
        Ok(self)
    }

    /// A distance: the share of the area beyond it is enclosed, and the regions beyond it are listed.
    ///
    /// # Errors
    /// [`OptionError::Threshold`] unless it is finite and not negative.
    pub fn threshold(mut self, threshold: f64) -> Result<Self, OptionError> {
        self.threshold = Some(check_threshold(threshold)?);
        Ok(self)
    }

    /// The shares of the area whose percentiles are wanted.
    ///
    /// # Errors
    /// [`OptionError::Share`] unless each lies between 0 and 1, both excluded.
    pub fn percentiles(mut self, shares: &[f64]) -> Result<Self, OptionError> {
        if let Some(&share) = shares.iter().find(|q| !(**q > 0.0 && **q < 1.0)) {
            return Err(OptionError::Share(share));
        }
        self.percentiles = shares.to_vec();
        Ok(self)
    }

    /// How many bins the histogram has.
    #[must_use]
    pub fn bins(mut self, bins: usize) -> Self {
        self.bins = bins;
        self
    }

    /// How many regions are listed, of each kind.
    #[must_use]
    pub fn regions(mut self, regions: usize) -> Self {
        self.regions = regions;
        self
    }

    /// Whether to find out on which side of the other mesh vertices and faces lie.
    #[must_use]
    pub fn signed(mut self, signed: bool) -> Self {
        self.signed = signed;
        self
    }

    /// Runs on this many threads instead of those of the current pool. The answer is the same.
    ///
    /// # Errors
    /// [`OptionError::Limit`] for none.
    pub fn threads(mut self, threads: usize) -> Result<Self, OptionError> {
        self.threads = Some(Limits::threads(threads)?);
        Ok(self)
    }

    /// Stops refining after this time, with wider enclosures. Building a tree is not interrupted.
    #[must_use]
    pub fn time_limit(mut self, limit: Duration) -> Self {
        self.time_limit = Some(limit);
        self
    }

    /// Stops refining before pieces, meshes and trees take more than this many bytes, with wider enclosures. What one piece for
    /// each face takes is needed in any case.
    #[must_use]
    pub fn memory_limit(mut self, bytes: usize) -> Self {
        self.memory_limit = Some(bytes);
        self
    }

    /// Stops refining at about this many pieces, with wider enclosures; one for each face is needed in any case. The report then
    /// says [`StopReason::Pieces`](crate::StopReason::Pieces).
    #[must_use]
    pub fn most_pieces(mut self, pieces: usize) -> Self {
        self.most_pieces = pieces;
        self
    }

    /// How far A is from B.
    pub fn directed(&self, a: &TriMesh, b: &TriMesh) -> DirectedDeviation {
        self.directed_observed(a, b, &mut ())
    }

    /// How far A is from B, while an observer watches: of its calls only [`Observer::progress`] is made, first by the search for
    /// the largest distance, then by refining, with pieces looked at and left.
    pub fn directed_observed(
        &self,
        a: &TriMesh,
        b: &TriMesh,
        observer: &mut dyn Observer,
    ) -> DirectedDeviation {
        self.on_threads(|| self.one_direction(a, b, Direction::AToB, self.deadline(1), observer).report)
    }

    /// How far A and B are from each other.
    pub fn symmetric(&self, a: &TriMesh, b: &TriMesh) -> Deviation {
        self.symmetric_observed(a, b, &mut ())
    }

    /// How far A and B are from each other, while an observer watches. The first direction takes at most half of the time limit.
    pub fn symmetric_observed(&self, a: &TriMesh, b: &TriMesh, observer: &mut dyn Observer) -> Deviation {
        self.on_threads(|| {
            let (half, whole) = (self.deadline(2), self.deadline(1));
            let there = self.one_direction(a, b, Direction::AToB, half, observer);
            let back = self.one_direction(b, a, Direction::BToA, whole, observer);
            self.both(a, b, there, back)
        })
    }

    fn both(&self, a: &TriMesh, b: &TriMesh, there: Outcome, back: Outcome) -> Deviation {
        let (frame, ..) = joint_frame(a, b);
        let greater_percentiles = there.summary.as_ref().zip(back.summary.as_ref()).map(|(x, y)| {
            let both = x.percentiles.iter().zip(&y.percentiles);
            let greater = both.map(|(x, y)| super::run::greater_of(*x, *y));
            let published = self.percentiles.iter().zip(greater);
            published
                .map(|(share, (low, high))| Percentile {
                    share: *share,
                    distance: super::statistics::length_out(&frame, low, high),
                })
                .collect()
        });
        let mut pooled = there.distribution;
        pooled.entries.extend_from_slice(&back.distribution.entries);
        let wanted = Wanted {
            percentiles: &self.percentiles,
            threshold: self.threshold.map(|t| frame.length_in(t)),
            bins: self.bins,
        };
        let largest = super::linear::greater(there.report.field.largest, back.report.field.largest);
        let summary = Summary::of(&pooled, &wanted, largest);
        Deviation {
            distance: there.report.distance.distance.max(back.report.distance.distance),
            greater_percentiles,
            pooled: summary.map(|s| s.publish(&pooled, &wanted, self.threshold, largest, &frame)),
            a_to_b: there.report,
            b_to_a: back.report,
        }
    }

    fn one_direction(
        &self,
        from: &TriMesh,
        to: &TriMesh,
        direction: Direction,
        deadline: Option<Instant>,
        observer: &mut dyn Observer,
    ) -> Outcome {
        let started = Instant::now();
        let target = Target::in_frame(to, joint_frame(from, to).0);
        let build = started.elapsed();
        let pair = Pair { from, to, target: &target, direction, deadline };
        let mut outcome = run(self, &pair, observer);
        outcome.report.work.build = build;
        outcome
    }

    /// When a part of the time limit has run out.
    fn deadline(&self, part: u32) -> Option<Instant> {
        self.time_limit.and_then(|limit| Instant::now().checked_add(limit / part))
    }

    fn on_threads<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        on_threads(self.threads, work)
    }
}
