//! Asking for a distance: in one line, or with options.

use crate::engine::{self, Question};
use crate::observer::Observer;
use crate::report::{DirectedReport, Direction, SymmetricReport};
use crate::target::Target;
use crate::tolerance::{OptionError, Tolerance, check_threshold};
use crate::{classic, coarse};
use pompeiu_core::TriMesh;
use pompeiu_core::run::{Limits, on_threads};
use std::num::NonZeroUsize;
use std::time::{Duration, Instant};

/// Encloses how far the points of A are from B: `h(A, B)`, not symmetric.
///
/// The tolerance is [`Tolerance::DEFAULT_FRACTION`] of the joint diagonal; use [`Query`] for anything else.
///
/// # Shapes and units
/// Any two meshes in one unit of length.
/// # Accuracy
/// Certified, see the [crate documentation](crate).
/// # Cost
/// O(m log m) to build the tree of B. The search is near-linear in the faces of A on ordinary meshes; no bound of that
/// kind holds for all.
/// # Source
/// Definition and the branch-and-bound frame: `sacht_cascading_2024` in `REFERENCES.bib`; mixture bounds and cuts are ours.
pub fn directed_hausdorff(a: &TriMesh, b: &TriMesh) -> DirectedReport {
    Query::new().directed(a, b)
}

/// Encloses `H(A, B) = max(h(A, B), h(B, A))`; see [`directed_hausdorff`].
pub fn symmetric_hausdorff(a: &TriMesh, b: &TriMesh) -> SymmetricReport {
    Query::new().symmetric(a, b)
}

/// Which search answers a query.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Cover, generate and cut.
    #[default]
    Fast,
    /// The textbook branch and bound of [`crate::classic`]: a baseline and an oracle for small meshes.
    Classic,
}

/// A question about the distance between two meshes.
///
/// # Example
/// ```
/// use pompeiu_core::TriMesh;
/// use pompeiu_hausdorff::{Query, Target, Tolerance};
///
/// let triangle = |z| TriMesh::new(vec![[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]], vec![[0, 1, 2]]);
/// let target = Target::new(&triangle(0.0)?);
/// let query = Query::new().tolerance(Tolerance::Absolute(1e-9))?;
/// for z in [1.0, 2.0, 3.0] {
///     assert!(query.directed_to(&triangle(z)?, &target).distance.contains(z));
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Query {
    tolerance: Tolerance,
    threshold: Option<f64>,
    threads: Option<NonZeroUsize>,
    time_limit: Option<Duration>,
    memory_limit: Option<usize>,
    stages: Vec<f64>,
    method: Method,
}

impl Query {
    /// A question with the default tolerance, no limits, and the threads of the current pool.
    pub fn new() -> Self {
        Self::default()
    }

    /// How narrow the enclosure should be.
    ///
    /// # Errors
    /// [`OptionError::Tolerance`] unless it is finite and not negative.
    pub fn tolerance(mut self, tolerance: Tolerance) -> Result<Self, OptionError> {
        let value = tolerance.value();
        if !(0.0..f64::INFINITY).contains(&value) {
            return Err(OptionError::Tolerance(value));
        }
        self.tolerance = tolerance;
        Ok(self)
    }

    /// Asks only whether the distance is at most this length: the search ends with the first proof of either answer, which
    /// is read off the enclosure. Undecided when both lie within the tolerance.
    ///
    /// # Errors
    /// [`OptionError::Threshold`] unless it is finite and not negative.
    pub fn threshold(mut self, threshold: f64) -> Result<Self, OptionError> {
        self.threshold = Some(check_threshold(threshold)?);
        Ok(self)
    }

    /// Runs on this many threads instead of those of the current pool. The answer is the same.
    ///
    /// # Errors
    /// [`OptionError::Limit`] for none.
    pub fn threads(mut self, threads: usize) -> Result<Self, OptionError> {
        self.threads = Some(Limits::threads(threads)?);
        Ok(self)
    }

    /// Stops after this time, with a wider enclosure. Building a tree is not interrupted.
    #[must_use]
    pub fn time_limit(mut self, limit: Duration) -> Self {
        self.time_limit = Some(limit);
        self
    }

    /// Stops before taking more memory than this many bytes, meshes and trees included, with a wider enclosure.
    #[must_use]
    pub fn memory_limit(mut self, bytes: usize) -> Self {
        self.memory_limit = Some(bytes);
        self
    }

    /// Reaches these tolerances on the way, fractions of the joint diagonal in descending order, and shows the observer at
    /// each what is left of A. Those not coarser than the tolerance asked for are passed over; the search then goes on to
    /// that tolerance, and shows that last stage too. Costs memory for every piece that may still hold the maximum, and a
    /// query for each.
    ///
    /// # Errors
    /// [`OptionError::Stage`] unless positive, finite and descending.
    pub fn stages(mut self, tolerances: &[f64]) -> Result<Self, OptionError> {
        let mut before = f64::INFINITY;
        for (index, &tolerance) in tolerances.iter().enumerate() {
            if !(0.0 < tolerance && tolerance < before) {
                return Err(OptionError::Stage { index, tolerance });
            }
            before = tolerance;
        }
        self.stages = tolerances.to_vec();
        Ok(self)
    }

    /// Which search to use.
    #[must_use]
    pub fn method(mut self, method: Method) -> Self {
        self.method = method;
        self
    }

    /// Encloses `h(A, B)`.
    pub fn directed(&self, a: &TriMesh, b: &TriMesh) -> DirectedReport {
        self.directed_observed(a, b, &mut ())
    }

    /// Encloses `h(A, B)` while an observer watches.
    pub fn directed_observed(&self, a: &TriMesh, b: &TriMesh, observer: &mut dyn Observer) -> DirectedReport {
        self.on_threads(|| self.one_direction(a, b, Direction::AToB, self.deadline(), observer))
    }

    /// Encloses `h(A, B)` for a prepared B, whose memory counts towards the limit. [`Method::Classic`] does not apply.
    pub fn directed_to(&self, a: &TriMesh, b: &Target) -> DirectedReport {
        self.directed_to_observed(a, b, &mut ())
    }

    /// Encloses `h(A, B)` for a prepared B while an observer watches.
    pub fn directed_to_observed(
        &self,
        a: &TriMesh,
        b: &Target,
        observer: &mut dyn Observer,
    ) -> DirectedReport {
        self.on_threads(|| {
            engine::search(&self.question(Direction::AToB, self.deadline()), a, b, None, observer)
        })
    }

    /// Encloses `H(A, B)`, with both directed distances.
    pub fn symmetric(&self, a: &TriMesh, b: &TriMesh) -> SymmetricReport {
        self.symmetric_observed(a, b, &mut ())
    }

    /// Encloses `H(A, B)` while an observer watches. The first direction takes at most half of the time limit.
    pub fn symmetric_observed(
        &self,
        a: &TriMesh,
        b: &TriMesh,
        observer: &mut dyn Observer,
    ) -> SymmetricReport {
        self.on_threads(|| {
            let deadline = self.deadline();
            let half = self.time_limit.and_then(|limit| Instant::now().checked_add(limit / 2));
            let a_to_b = self.one_direction(a, b, Direction::AToB, half, observer);
            let b_to_a = self.one_direction(b, a, Direction::BToA, deadline, observer);
            SymmetricReport { distance: a_to_b.distance.max(b_to_a.distance), a_to_b, b_to_a }
        })
    }

    fn deadline(&self) -> Option<Instant> {
        self.time_limit.and_then(|limit| Instant::now().checked_add(limit))
    }

    fn on_threads<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        on_threads(self.threads, work)
    }

    fn one_direction(
        &self,
        a: &TriMesh,
        b: &TriMesh,
        direction: Direction,
        deadline: Option<Instant>,
        observer: &mut dyn Observer,
    ) -> DirectedReport {
        let started = Instant::now();
        let question = self.question(direction, deadline);
        if self.method == Method::Classic {
            return classic::search(&question, a, b, observer);
        }
        if self.memory_limit.is_some_and(|limit| limit < engine::bytes_to_start(a, b)) {
            return coarse::bound(&question, a, b);
        }
        let target = Target::without_neighbours(b);
        let build = started.elapsed();
        let mut report = engine::search(&question, a, &target, Some(b), observer);
        report.timing.build += build;
        report
    }

    fn question(&self, direction: Direction, deadline: Option<Instant>) -> Question<'_> {
        Question {
            direction,
            tolerance: self.tolerance,
            threshold: self.threshold,
            deadline,
            memory_limit: self.memory_limit,
            stages: &self.stages,
        }
    }
}
