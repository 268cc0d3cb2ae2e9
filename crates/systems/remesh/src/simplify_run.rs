//! What all of a simplification share, and the measurement of its results.

use super::collapses::Collapses;
use super::guard::{IntersectionCount, Intersections, MOST_PAIRS};
use super::least_faces::least_faces;
use super::lengths::NotWithin;
use super::marked::Marked;
use super::places::Places;
use super::simplify_options::{
    Refusals, Simplified, SimplifyError, SimplifyOptions, SimplifyTarget, SimplifyTiming,
};
use pompeiu_core::mesh::Rounding;
use pompeiu_core::run::{Control, Instant, Limits, RunContext, StopReason};
use pompeiu_core::spatial::self_intersections;
use pompeiu_core::{MeshError, TriMesh};
use pompeiu_hausdorff::{HausdorffOptions, symmetric_hausdorff};

/// Share of the distance that the local tests may use; the rest covers their rounding.
const LOCAL_SHARE: f64 = 0.9999;

/// Faces are kept apart from a surface of so many times the faces asked for, the last of these without faces that intersect: tests of finer
/// ones take most of the time, and find nothing.
const KEPT_APART_FROM: [usize; 2] = [64, 16];

/// Whether a surface may be a result.
pub(super) enum Verdict {
    /// Faces intersect that must not: it is to be made again with faces kept apart.
    MustKeepApart,
    /// It may, with the pairs of faces that intersect where they were sought.
    May(Option<IntersectionCount>),
}

/// What all of a simplification share.
pub(super) struct Run<'r> {
    pub(super) mesh: &'r TriMesh,
    pub(super) options: &'r SimplifyOptions<'r>,
    pub(super) places: Places,
    pub(super) rounding: Rounding,
    pub(super) control: Control,
    /// The limits, counted from the start.
    pub(super) context: RunContext<'r>,
}

impl<'r> Run<'r> {
    /// Goes from level to level, the finest first. Where faces of a result intersect that must not, it starts again and keeps them apart all
    /// the time: most results have none without that, in less time.
    pub(super) fn levels(
        &self,
        start: impl Fn() -> Result<Collapses<'r>, SimplifyError>,
        targets: &[SimplifyTarget],
        started: Instant,
    ) -> Result<Vec<Simplified>, SimplifyError> {
        if let Some(found) = self.levels_from(start()?, targets, started)? {
            return Ok(found);
        }
        let found = self.levels_from(self.kept_apart(start, targets)?, targets, started)?;
        Ok(found.unwrap_or_default())
    }

    /// Collapses that keep faces apart, from where none intersect yet.
    pub(super) fn kept_apart(
        &self,
        start: impl Fn() -> Result<Collapses<'r>, SimplifyError>,
        targets: &[SimplifyTarget],
    ) -> Result<Collapses<'r>, SimplifyError> {
        let mut work = start()?;
        let Some(&SimplifyTarget::Faces(finest)) = targets.first() else { return Ok(work.keeping_apart()) };
        let mut apart = None;
        for faces in KEPT_APART_FROM.map(|times| finest.saturating_mul(times)) {
            work.leave_faces(faces);
            work.run(&self.control, self.options.progress);
            if self.intersects(&work.surface)? {
                break;
            }
            apart = Some(work.snapshot());
        }
        let work = match apart {
            Some(snapshot) => Collapses::on(snapshot, None, self.places),
            None => start()?,
        };
        Ok(work.keeping_apart())
    }

    /// Goes from level to level; none where faces of a result intersect that can be kept apart.
    fn levels_from(
        &self,
        mut work: Collapses<'_>,
        targets: &[SimplifyTarget],
        mut started: Instant,
    ) -> Result<Option<Vec<Simplified>>, SimplifyError> {
        let mut found = Vec::with_capacity(targets.len());
        for &target in targets {
            match target {
                // Rounding moved vertices before, which the local tests do not see.
                SimplifyTarget::Within(d) => {
                    work.come_within(self.places.frame.length_in(LOCAL_SHARE * d - self.rounding.moved));
                }
                SimplifyTarget::Faces(n) => work.leave_faces(n),
            }
            work.run(&self.control, self.options.progress);
            let Verdict::May(intersections) = self.judge(&work)? else { return Ok(None) };
            let result = Simplified { intersections, ..self.measured(&work, target, started)? };
            found.push(self.guarded(result)?);
            started = Instant::now();
        }
        Ok(Some(found))
    }

    /// Whether a surface may be a result: where intersections are avoided no more pairs of faces intersect than of the input.
    pub(super) fn judge(&self, work: &Collapses<'_>) -> Result<Verdict, SimplifyError> {
        let asked = self.options.intersections;
        if !asked.avoids() || work.keeps_apart() || self.control.is_stopped() {
            return Ok(Verdict::May(None));
        }
        let found = self_intersections(&self.mesh_of(&work.surface)?, MOST_PAIRS);
        let count = IntersectionCount::of(&found);
        if count.pairs == 0 {
            return Ok(Verdict::May(Some(count)));
        }
        // Where all pairs are refused, those of the input would remain.
        let refuses_all = asked == Intersections::Refuse;
        let before = self_intersections(self.mesh, MOST_PAIRS).pairs.len();
        if before < if refuses_all { 1 } else { count.pairs } {
            return Ok(Verdict::MustKeepApart);
        }
        Ok(Verdict::May((!refuses_all).then_some(IntersectionCount { of_input: Some(before), ..count })))
    }

    /// Whether faces of a surface intersect.
    pub(super) fn intersects(&self, surface: &Marked) -> Result<bool, SimplifyError> {
        Ok(!self_intersections(&self.mesh_of(surface)?, 1).pairs.is_empty())
    }

    /// The surface as a mesh where the file can hold it.
    pub(super) fn mesh_of(&self, surface: &Marked) -> Result<TriMesh, MeshError> {
        let mut result = surface.mesh.clone();
        self.places.bring_out(&mut result);
        result.to_mesh()
    }

    /// Measures a surface.
    pub(super) fn measured(
        &self,
        work: &Collapses<'_>,
        target: SimplifyTarget,
        started: Instant,
    ) -> Result<Simplified, SimplifyError> {
        let surface = &work.surface;
        let mesh = self.mesh_of(surface)?;
        let stop = self.control.reason();
        let falls_short = matches!(target, SimplifyTarget::Faces(n) if mesh.faces().len() > n);
        let refusals = (falls_short && stop.is_none())
            .then(|| Refusals { least_faces: least_faces(&surface.mesh), ..work.refusals() });
        let stop = stop.unwrap_or(if falls_short { StopReason::Stalled } else { StopReason::Tolerance });
        let collapse = started.elapsed();
        let measuring = self.measuring(target);
        // Only the limits are not those of the defaults, and limits are always valid.
        let distance =
            measuring.symmetric(self.mesh, &mesh).unwrap_or_else(|_| symmetric_hausdorff(self.mesh, &mesh));
        if let SimplifyTarget::Within(d) = target {
            NotWithin::check(d, &distance)?;
        }
        Ok(Simplified {
            mesh,
            kept: surface.kept(),
            target,
            rounding: self.rounding,
            distance,
            intersections: None,
            collapses: work.count,
            refusals,
            stop,
            timing: SimplifyTiming { collapse, distance: started.elapsed().saturating_sub(collapse) },
        })
    }

    /// How a distance is measured: one that was asked for is proven, whatever the time; one that follows is enclosed as well as time allows.
    pub(super) fn measuring(&self, target: SimplifyTarget) -> HausdorffOptions<'static> {
        let limits = match target {
            SimplifyTarget::Within(_) => Limits::default(),
            SimplifyTarget::Faces(_) => self.context.limits(),
        };
        HausdorffOptions { limits, ..HausdorffOptions::default() }
    }

    /// Counts the faces of a result that intersect, where that is asked for and was not done before.
    pub(super) fn guarded(&self, mut result: Simplified) -> Result<Simplified, SimplifyError> {
        if result.intersections.is_some() {
            return Ok(result);
        }
        // A result that is not finished is not refused for what the end would have mended.
        let intersections = match self.options.intersections {
            Intersections::RefuseNew if self.control.is_stopped() => Intersections::Report,
            asked => asked,
        };
        result.intersections = intersections.of(&result.mesh, self.mesh)?;
        Ok(result)
    }
}
