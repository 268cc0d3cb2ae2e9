//! Flows between cells.

use pompeiu_core::VertexId;
use pompeiu_operators::FaceField;
use pompeiu_surface::plane::{cross, sub};
use pompeiu_surface::{EdgeId, HalfedgeId, Surface};
use rayon::prelude::*;

/// Flows between cells across their common sides.
#[derive(Debug)]
pub(crate) struct Cells<'c> {
    /// The area of each cell.
    pub(super) areas: &'c [f64],
    /// The sides through which something flows.
    pub(super) sides: Vec<Side>,
    /// For each cell its outflow per time, over its area.
    outflow_rates: Vec<f64>,
}

/// A side with the cells that it divides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Side {
    /// The cell out of which the flow comes.
    pub(super) from: u32,
    /// The cell into which it goes.
    pub(super) to: u32,
    /// The area that passes per time, positive.
    pub(super) flow: f64,
}

impl<'c> Cells<'c> {
    /// From the two cells at each side, and the flow from the first of them to the second.
    pub(crate) fn new(ends: &[[u32; 2]], areas: &'c [f64], flows: &[f64]) -> Self {
        let mut outflow_rates = vec![0.0; areas.len()];
        let mut sides = Vec::with_capacity(flows.len());
        // Not a number is kept, so that it is seen in the Courant number.
        for (&[first, second], &flow) in ends.iter().zip(flows).filter(|(_, flow)| **flow != 0.0) {
            let [from, to] = if flow > 0.0 { [first, second] } else { [second, first] };
            let flow = flow.abs();
            outflow_rates[from as usize] += flow;
            sides.push(Side { from, to, flow });
        }
        for (rate, area) in outflow_rates.iter_mut().zip(areas) {
            *rate /= area;
        }
        Self { areas, sides, outflow_rates }
    }

    /// The barycentric dual cells of vertices, which meet along the segments from midpoints of edges to centroids of faces. `ends`
    /// are those of the edges, then one for each vertex with a flow through the boundary, `through`.
    ///
    /// For a field that is divergence-free against hat functions, the net flow into each cell is zero.
    pub(crate) fn dual(
        surface: &Surface,
        ends: &[[u32; 2]],
        areas: &'c [f64],
        velocity: &FaceField,
        through: &[(VertexId, f64)],
    ) -> Self {
        let mesh = surface.mesh();
        // Into the cell of the head of a half-edge, across the segment from its midpoint to the centroid of its face.
        let into_head = |h: HalfedgeId| {
            let (sides, i) = (surface.sides(h.face()), h.corner());
            cross(velocity[h.face()], sub(sides[(i + 1) % 3], sides[(i + 2) % 3])) / 6.0
        };
        let across = |edge: u32| {
            let h = mesh.edge_halfedge(EdgeId(edge));
            into_head(h) - mesh.twin(h).map_or(0.0, into_head)
        };
        let edges = (0..mesh.edges() as u32).into_par_iter().with_min_len(4096);
        let mut flows: Vec<f64> = edges.map(across).collect();
        flows.extend(through.iter().map(|(_, flow)| flow));
        Self::new(ends, areas, &flows)
    }

    /// The Courant number: the greatest share of its content that flows out of a cell in a step.
    pub(crate) fn cfl(&self, step: f64) -> f64 {
        step * self.outflow_rates.iter().fold(0.0, |m, &x| if x > m || x.is_nan() { x } else { m })
    }
}
