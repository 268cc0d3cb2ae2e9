//! From meshes and options to reports.

use crate::engine::{self, Ordered, Question};
use crate::options::{HausdorffOptions, Method};
use crate::prepared::PreparedPair;
use crate::report::{DirectedReport, Direction, StopReason, SymmetricReport};
use crate::target::Target;
use crate::tolerance::OptionError;
use crate::{classic, coarse};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::Instant;
use pompeiu_core::run::on_threads;

/// Encloses how far the points of A are from B: `h(A, B)`, not symmetric.
///
/// The tolerance is [`Tolerance::DEFAULT_FRACTION`](crate::Tolerance::DEFAULT_FRACTION) of the joint diagonal; use
/// [`HausdorffOptions`] for anything else.
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
    let pair = PreparedPair::for_one_distance(a, b);
    HausdorffOptions::default().one_direction(&pair, Direction::AToB, None)
}

/// Encloses `H(A, B) = max(h(A, B), h(B, A))`; see [`directed_hausdorff`].
pub fn symmetric_hausdorff(a: &TriMesh, b: &TriMesh) -> SymmetricReport {
    HausdorffOptions::default().both_directions(a, b)
}

impl HausdorffOptions<'_> {
    /// Encloses `h(A, B)`.
    ///
    /// # Errors
    /// [`HausdorffOptions::check`].
    pub fn directed(&self, a: &TriMesh, b: &TriMesh) -> Result<DirectedReport, OptionError> {
        self.check()?;
        let deadline = self.limits.deadline();
        let pair = PreparedPair::for_one_distance(a, b);
        Ok(on_threads(self.limits.threads, || self.one_direction(&pair, Direction::AToB, deadline)))
    }

    /// The directed distance of a prepared pair in a direction: [`HausdorffOptions::directed`] with trees that are kept.
    ///
    /// # Errors
    /// [`HausdorffOptions::check`].
    pub fn directed_of(
        &self,
        pair: &PreparedPair<'_>,
        direction: Direction,
    ) -> Result<DirectedReport, OptionError> {
        self.check()?;
        let deadline = self.limits.deadline();
        Ok(on_threads(self.limits.threads, || self.one_direction(pair, direction, deadline)))
    }

    /// Encloses `h(A, B)` for a prepared B, whose memory counts towards the limit. [`Method::Classic`] does not apply.
    ///
    /// # Errors
    /// [`HausdorffOptions::check`].
    pub fn directed_to(&self, a: &TriMesh, b: &Target) -> Result<DirectedReport, OptionError> {
        self.check()?;
        let question =
            Question { options: self, direction: Direction::AToB, deadline: self.limits.deadline() };
        Ok(on_threads(self.limits.threads, || engine::search(&question, &Ordered::new(a), b, None)))
    }

    /// Encloses `H(A, B)`, with both directed distances.
    ///
    /// Both directions share the time limit: the first is searched until half of it has passed, and again with what the second
    /// leaves. When the first direction alone exceeds the threshold, the second is bounded in linear time, without a
    /// search; its report says [`StopReason::Threshold`].
    ///
    /// # Errors
    /// [`HausdorffOptions::check`].
    pub fn symmetric(&self, a: &TriMesh, b: &TriMesh) -> Result<SymmetricReport, OptionError> {
        self.check()?;
        Ok(on_threads(self.limits.threads, || self.both_directions(a, b)))
    }

    /// The same of a prepared pair, whose trees are kept. Of a pair with parts the whole meshes are compared.
    ///
    /// # Errors
    /// [`HausdorffOptions::check`].
    pub fn symmetric_of(&self, pair: &PreparedPair<'_>) -> Result<SymmetricReport, OptionError> {
        self.check()?;
        Ok(on_threads(self.limits.threads, || self.both_directions_of(pair)))
    }

    pub(crate) fn both_directions(&self, a: &TriMesh, b: &TriMesh) -> SymmetricReport {
        self.both_directions_of(&PreparedPair::for_one_distance(a, b))
    }

    fn both_directions_of(&self, pair: &PreparedPair<'_>) -> SymmetricReport {
        let deadline = self.limits.deadline();
        let half = self.limits.time.and_then(|limit| Instant::now().checked_add(limit / 2));
        let mut a_to_b = self.one_direction(pair, Direction::AToB, half);
        if self.threshold.is_some_and(|threshold| a_to_b.distance.lower() > threshold) {
            let question = Question { options: self, direction: Direction::BToA, deadline };
            let mut b_to_a = coarse::bound(&question, pair.b(), pair.a(), StopReason::Threshold);
            if b_to_a.stop != StopReason::Tolerance {
                b_to_a.stop = StopReason::Threshold;
            }
            return SymmetricReport { distance: a_to_b.distance.max(b_to_a.distance), a_to_b, b_to_a };
        }
        let b_to_a = self.one_direction(pair, Direction::BToA, deadline);
        if a_to_b.stop == StopReason::Time && deadline.is_some_and(|deadline| Instant::now() < deadline) {
            let again = self.one_direction(pair, Direction::AToB, deadline);
            a_to_b = a_to_b.narrowed_by(&again);
        }
        SymmetricReport { distance: a_to_b.distance.max(b_to_a.distance), a_to_b, b_to_a }
    }

    fn one_direction(
        &self,
        pair: &PreparedPair<'_>,
        direction: Direction,
        deadline: Option<Instant>,
    ) -> DirectedReport {
        let started = Instant::now();
        let [a, b] = match direction {
            Direction::AToB => [pair.a(), pair.b()],
            Direction::BToA => [pair.b(), pair.a()],
        };
        let question = Question { options: self, direction, deadline };
        if self.method == Method::Classic {
            return classic::search(&question, a, b);
        }
        if self.limits.memory.is_some_and(|limit| limit < engine::bytes_to_start(a, b)) {
            return coarse::bound(&question, a, b, StopReason::Memory);
        }
        let control = question.control();
        // Together, so that what one does in series runs beside the other.
        let (target, a) = rayon::join(
            || pair.target_unless_stopped(direction, Frame::of(&Aabb::of_faces(b)), &control),
            || Ordered::new(a),
        );
        let Some(target) = target else {
            return coarse::bound(&question, a.mesh, b, control.reason().unwrap_or(StopReason::Time));
        };
        let build = started.elapsed();
        let mut report = engine::search(&question, &a, &target, Some(b));
        report.timing.build += build;
        report
    }
}
