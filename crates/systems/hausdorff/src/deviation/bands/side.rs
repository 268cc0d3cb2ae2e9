//! On which side of a surface a part of another one lies as a whole.

use super::boundary::Boundary;
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use pompeiu_core::spatial::Winding;

/// What rounding may do to a winding number, generously.
const ROUNDING: f64 = 1e-6;

/// Tells inside from outside of a mesh.
pub(super) struct SideOf<'s> {
    frame: &'s Frame,
    winding: Winding,
    boundary: Boundary,
}

impl<'s> SideOf<'s> {
    pub(super) fn new(mesh: &TriMesh, frame: &'s Frame) -> Self {
        Self { frame, winding: Winding::new(mesh), boundary: Boundary::new(mesh, frame) }
    }

    pub(super) fn is_closed(&self) -> bool {
        self.boundary.is_empty()
    }

    /// Whether all points up to a radius around a point, in the frame, that are reached on ways which do not meet the surface are
    /// inside; none if that is not known.
    pub(super) fn is_inside(&self, centre: [f64; 3], radius: f64) -> Option<bool> {
        let number = self.winding.about(self.frame.unmap(centre));
        let size = number.value.abs();
        let doubt = number.error + ROUNDING + self.boundary.variation(DVec3::from_array(centre), radius);
        ((size - 0.5).abs() > doubt).then_some(size > 0.5)
    }
}
