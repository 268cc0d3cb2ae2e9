//! The options of a deviation analysis.

use crate::observer::Observer;
use crate::rounding::Rounding;
use crate::tolerance::{OptionError, check_threshold};
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::Limits;

/// The options of a deviation analysis: how far two meshes deviate from each other, where, and over how much of the area.
///
/// # Definition
/// See [`Statistics`](super::Statistics) for what is computed, and [`Deviation`](super::Deviation) for the two directions.
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
/// use pompeiu_hausdorff::DeviationOptions;
///
/// // A triangle, and one that leans away from it by up to 0.3.
/// let flat = TriMesh::new(vec![[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]], vec![[0, 1, 2]])?;
/// let leaning = TriMesh::new(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.3], [0.0, 1.0, 0.0]], vec![[0, 1, 2]])?;
/// let options = DeviationOptions { threshold: Some(0.15), ..DeviationOptions::default() };
/// let report = options.directed(&leaning, &flat)?;
/// let statistics = report.statistics.unwrap();
/// assert!(statistics.mean.contains(0.1));
/// assert!(statistics.above.unwrap().share.contains(0.25));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct DeviationOptions<'o> {
    /// How narrow enclosures should be, relative to their lower ends; of the share above the threshold, absolutely. Positive.
    pub accuracy: f64,
    /// A distance: the share of the area beyond it is enclosed, and the regions beyond it are listed.
    pub threshold: Option<f64>,
    /// The shares of the area whose percentiles are wanted, each between 0 and 1, both excluded.
    pub percentiles: Vec<f64>,
    /// How many bins the histogram has.
    pub bins: usize,
    /// How many regions are listed, of each kind.
    pub regions: usize,
    /// Whether to find out on which side of the other mesh vertices and faces lie.
    pub signed: bool,
    /// Whether to do so where both meshes are closed and oriented, and few of their faces intersect: there the faces nearest to a point tell on
    /// which side it is, which takes little time. A limit on memory leaves it out.
    pub signed_where_closed: bool,
    /// Time, memory, pieces and threads. When a limit is reached, refining stops with wider enclosures, and
    /// [`DirectedDeviation::stop`](super::DirectedDeviation::stop) says which it was. Where limits leave no room to look at faces at
    /// all, no more is said than that no distance exceeds an upper end of the largest. One piece for each face is needed
    /// otherwise; without a limit on pieces it is [`DeviationOptions::DEFAULT_PIECES`] in each direction, or
    /// [`DeviationOptions::PIECES_PER_FACE`] if that is more. Building a tree is not interrupted; it is not begun where less time is
    /// left than it takes.
    pub limits: Limits,
    /// Watches the work: of its methods only [`Observer::progress`] is called, first by the search for the largest distance, then
    /// by refining, with pieces looked at and left, and [`Observer::mean`] if that is wanted.
    pub observer: Option<&'o dyn Observer>,
}

impl Default for DeviationOptions<'_> {
    fn default() -> Self {
        Self {
            accuracy: Self::DEFAULT_ACCURACY,
            threshold: None,
            percentiles: Self::DEFAULT_PERCENTILES.to_vec(),
            bins: Self::DEFAULT_BINS,
            regions: Self::DEFAULT_REGIONS,
            signed: false,
            signed_where_closed: false,
            limits: Limits::default(),
            observer: None,
        }
    }
}

impl DeviationOptions<'_> {
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
    /// The same for each face of both meshes, where that is more.
    pub const PIECES_PER_FACE: usize = 12;

    /// The width in a frame that always suffices, of meshes with this joint box.
    pub(super) fn floor(frame: &Frame, joint: &Aabb, rounding: Rounding) -> f64 {
        Self::FLOOR * frame.length_in(joint.diagonal()) + 4.0 * rounding.bound(0)
    }

    /// Whether the options make sense.
    ///
    /// # Errors
    /// [`OptionError::Accuracy`] unless finite and positive; [`OptionError::Threshold`] unless finite and not negative;
    /// [`OptionError::Share`] for a percentile that does not lie between 0 and 1.
    pub fn check(&self) -> Result<(), OptionError> {
        if !(self.accuracy > 0.0 && self.accuracy < f64::INFINITY) {
            return Err(OptionError::Accuracy(self.accuracy));
        }
        self.threshold.map_or(Ok(()), check_threshold)?;
        match self.percentiles.iter().find(|q| !(**q > 0.0 && **q < 1.0)) {
            Some(&share) => Err(OptionError::Share(share)),
            None => Ok(()),
        }
    }
}
