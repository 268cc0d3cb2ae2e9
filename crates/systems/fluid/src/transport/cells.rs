//! Flows between cells.

use pompeiu_core::VertexId;
use pompeiu_operators::FaceField;
use pompeiu_surface::plane::{add, cross, scale, sub};
use pompeiu_surface::{Surface, SurfaceMesh};

/// Flows between cells across their common sides.
#[derive(Debug)]
pub(crate) struct Cells<'c> {
    /// The two cells at each side.
    pub(super) ends: &'c [[u32; 2]],
    /// The area of each cell.
    pub(super) areas: &'c [f64],
    /// The flow across each side, from the first of its cells to the second.
    pub(super) flows: Vec<f64>,
    /// For each cell its outflow per time, over its area.
    outflow_rates: Vec<f64>,
}

impl<'c> Cells<'c> {
    pub(crate) fn new(ends: &'c [[u32; 2]], areas: &'c [f64], flows: Vec<f64>) -> Self {
        let mut outflow_rates = vec![0.0; areas.len()];
        for (&[first, second], &flow) in ends.iter().zip(&flows) {
            let from = if flow > 0.0 { first } else { second };
            outflow_rates[from as usize] += flow.abs();
        }
        for (rate, area) in outflow_rates.iter_mut().zip(areas) {
            *rate /= area;
        }
        Self { ends, areas, flows, outflow_rates }
    }

    /// The barycentric dual cells of vertices, which meet along the segments from midpoints of edges to centroids of faces. `ends`
    /// are those of the edges, then one for each vertex with a flow through the boundary, `through`.
    ///
    /// For a field that is divergence-free against hat functions, the net flow into each cell is zero.
    pub(crate) fn dual(
        surface: &Surface,
        ends: &'c [[u32; 2]],
        areas: &'c [f64],
        velocity: &FaceField,
        through: &[(VertexId, f64)],
    ) -> Self {
        let mesh = surface.mesh();
        let mut flows = vec![0.0; mesh.edges()];
        for (face, &u) in velocity.entries() {
            let corners = surface.corners(face);
            let centre = scale(1.0 / 3.0, add(corners[0], add(corners[1], corners[2])));
            for h in SurfaceMesh::face_halfedges(face) {
                let i = h.corner();
                let middle = scale(0.5, add(corners[i], corners[(i + 1) % 3]));
                // The segment from the midpoint to the centroid has the head of the half-edge on its right.
                let flow = cross(u, sub(centre, middle));
                flows[mesh.edge(h).index()] += if mesh.is_along(h) { flow } else { -flow };
            }
        }
        flows.extend(through.iter().map(|(_, flow)| flow));
        Self::new(ends, areas, flows)
    }

    /// The Courant number: the greatest share of its content that flows out of a cell in a step.
    pub(crate) fn cfl(&self, step: f64) -> f64 {
        step * self.outflow_rates.iter().fold(0.0, |m, &x| if x > m || x.is_nan() { x } else { m })
    }
}
