//! The mesh around a node, and the shape of its cells.

use glam::DVec3;
use pompeiu_volume::{Refinement, scaled_jacobian, scaled_jacobian_bound};

/// Parameters along each axis of a cell at which its shape is measured.
pub(super) const PLACES: [f64; 3] = [0.0, 0.5, 1.0];

/// The end of an arm: where the mesh of the tube begins.
#[derive(Clone)]
pub(super) struct Section {
    /// Length along the tube, from the node.
    pub(super) at: f64,
    /// The direction of the first corner: corners lie at 45°, 135°, … from it, counter-clockwise about the outward tangent.
    pub(super) side: DVec3,
    /// Its corners in the core and on the wall, as indices among the block corners of the node.
    pub(super) inner: [u32; 4],
    pub(super) outer: [u32; 4],
}

/// The mesh around a node.
#[derive(Clone)]
pub(super) struct NodeMesh {
    pub(super) blocks: Vec<[u32; 8]>,
    /// Number of corners of blocks.
    pub(super) corners: usize,
    /// The key and index of each fine vertex.
    pub(super) refinement: Refinement,
    pub(super) positions: Vec<DVec3>,
    pub(super) sections: Vec<Section>,
    /// The least scaled Jacobian of its cells.
    pub(super) quality: f64,
    /// Whether it was only improved until it was valid and near.
    pub(super) is_sketch: bool,
}

/// The least scaled Jacobian over all cells, but for the gap of its bounds.
pub(super) fn quality(cells: &[[u32; 8]], positions: &[DVec3]) -> f64 {
    let at_points = quality_at_points(cells, positions);
    let bound = |cell: &[u32; 8]| scaled_jacobian_bound(&cell.map(|v| positions[v as usize]), at_points);
    if at_points > 0.0 { cells.iter().map(bound).fold(at_points, f64::min) } else { at_points }
}

/// The least scaled Jacobian at 27 points of each cell.
pub(super) fn quality_at_points(cells: &[[u32; 8]], positions: &[DVec3]) -> f64 {
    cells
        .iter()
        .map(|cell| scaled_jacobian(&cell.map(|v| positions[v as usize])))
        .fold(f64::INFINITY, f64::min)
}
