//! Where vertices can be: the points that the file of the result can hold, in the frame in which is computed.

use super::connectivity::DynamicMesh;
use glam::DVec3;
use pompeiu_core::geom::Frame;
use pompeiu_core::mesh::Grid;

#[derive(Clone, Copy, Debug)]
pub(super) struct Places {
    pub(super) frame: Frame,
    pub(super) grid: Grid,
}

impl Places {
    /// The place near a point of the frame.
    #[inline]
    pub(super) fn near(&self, p: DVec3) -> DVec3 {
        if self.grid.holds_all() {
            p
        } else {
            DVec3::from_array(self.frame.map(self.grid.round(self.frame.unmap(p.to_array()))))
        }
    }

    /// Brings a mesh into the frame, with each vertex at its place.
    pub(super) fn bring_in(&self, mesh: &mut DynamicMesh) {
        mesh.map_positions(|p| self.frame.map(self.round(p)));
    }

    /// Moves each vertex of a mesh in the frame to its place.
    pub(super) fn settle(&self, mesh: &mut DynamicMesh) {
        if !self.grid.holds_all() {
            mesh.positions.iter_mut().for_each(|p| *p = self.near(*p));
        }
    }

    /// Brings a mesh back from the frame, with each vertex at its place to the bit.
    pub(super) fn bring_out(&self, mesh: &mut DynamicMesh) {
        mesh.map_positions(|p| self.round(self.frame.unmap(p)));
    }

    fn round(&self, p: [f64; 3]) -> [f64; 3] {
        if self.grid.holds_all() { p } else { self.grid.round(p) }
    }
}
