//! What all of a simplification share, and the measurement of its results.

use super::collapses::Collapses;
use super::lengths::NotWithin;
use super::marked::Marked;
use super::places::Places;
use super::simplify_options::{Simplified, SimplifyError, SimplifyOptions, SimplifyTarget, SimplifyTiming};
use pompeiu_core::mesh::Rounding;
use pompeiu_core::run::{Control, Instant, Limits, RunContext, StopReason};
use pompeiu_core::spatial::bvh::Bvh;
use pompeiu_core::{MeshError, TriMesh};
use pompeiu_hausdorff::{HausdorffOptions, symmetric_hausdorff};

/// Share of the distance that the local tests may use; the rest covers their rounding.
const LOCAL_SHARE: f64 = 0.9999;

/// What all of a simplification share.
pub(super) struct Run<'r> {
    pub(super) mesh: &'r TriMesh,
    pub(super) options: &'r SimplifyOptions<'r>,
    pub(super) places: Places,
    pub(super) rounding: Rounding,
    pub(super) bvh: &'r Bvh,
    pub(super) control: Control,
    /// The limits, counted from the start.
    pub(super) context: RunContext<'r>,
}

impl Run<'_> {
    /// Goes from level to level, the finest first.
    pub(super) fn levels(
        &self,
        mut work: Collapses<'_>,
        targets: &[SimplifyTarget],
        mut started: Instant,
    ) -> Result<Vec<Simplified>, SimplifyError> {
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
            let result = self.measured(&work.surface, work.count, target, started)?;
            found.push(self.guarded(result)?);
            started = Instant::now();
        }
        Ok(found)
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
        surface: &Marked,
        collapses: usize,
        target: SimplifyTarget,
        started: Instant,
    ) -> Result<Simplified, SimplifyError> {
        let mesh = self.mesh_of(surface)?;
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
            collapses,
            stop: self.control.reason().unwrap_or(StopReason::Tolerance),
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

    /// Counts the faces of a result that intersect, where that is asked for.
    pub(super) fn guarded(&self, mut result: Simplified) -> Result<Simplified, SimplifyError> {
        let intersections = self.options.intersections.after(self.control.reason());
        result.intersections = intersections.of(&result.mesh, self.mesh)?;
        Ok(result)
    }
}
