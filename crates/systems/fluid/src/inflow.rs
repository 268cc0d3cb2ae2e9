//! Flow through the boundary.

use crate::FluidError;
use pompeiu_core::VertexId;
use pompeiu_operators::{FaceField, crouzeix_raviart_gradient, crouzeix_raviart_laplacian};
use pompeiu_solve::SemidefiniteCholesky;
use pompeiu_surface::{EdgeData, Surface, SurfaceMesh};

/// Largest imbalance of inflow and outflow of a component, relative to the flow.
const IMBALANCE: f64 = 1e-9;

/// The field without divergence and vorticity with a given flow through the boundary.
///
/// # Definition
/// The gradient of the Crouzeix–Raviart function with that flow as Neumann data. Its flow is equal on both sides of each inner
/// edge, and it is orthogonal to rotated gradients and to harmonic fields that are tangential at the boundary.
#[derive(Debug)]
pub(crate) struct Inflow {
    field: FaceField,
    /// Inflow through each edge per time.
    through: EdgeData<f64>,
    /// Outflow of the dual cells of boundary vertices through the boundary.
    at_vertices: Vec<(VertexId, f64)>,
}

impl Inflow {
    /// From the inflow speeds at boundary edges, negative for outflow.
    pub(crate) fn new(surface: &Surface, speeds: &EdgeData<f64>) -> Result<Self, FluidError> {
        let mesh = surface.mesh();
        let mut through = EdgeData::from_fn(mesh.edges(), |edge| {
            if mesh.is_boundary_edge(edge) { speeds[edge] * surface.edge_length(edge) } else { 0.0 }
        });
        balance(mesh, &mut through)?;
        let component = |edge| Some(mesh.component(mesh.ends(edge)[0]) as u32);
        let group: Vec<Option<u32>> = mesh.edge_ids().map(component).collect();
        let laplacian = crouzeix_raviart_laplacian(surface)?;
        let system = SemidefiniteCholesky::new(laplacian, &vec![false; mesh.edges()], &group)?;
        let mut potential = EdgeData::from_fn(mesh.edges(), |edge| -through[edge]);
        system.solve_refined_in_place(&mut potential)?;
        let field = crouzeix_raviart_gradient(surface, &potential)?;
        let mut out = vec![0.0; mesh.vertices()];
        for edge in mesh.edge_ids().filter(|&edge| through[edge] != 0.0) {
            for v in mesh.ends(edge) {
                out[v.index()] -= 0.5 * through[edge];
            }
        }
        let at_vertices = mesh.vertex_ids().zip(out).filter(|(_, flow)| *flow != 0.0).collect();
        Ok(Self { field, through, at_vertices })
    }

    pub(crate) fn field(&self) -> &FaceField {
        &self.field
    }

    pub(crate) fn through_edges(&self) -> &EdgeData<f64> {
        &self.through
    }

    pub(crate) fn at_vertices(&self) -> &[(VertexId, f64)] {
        &self.at_vertices
    }
}

/// Checks that inflow and outflow of each component balance, and removes the remaining rounding error.
fn balance(mesh: &SurfaceMesh, through: &mut EdgeData<f64>) -> Result<(), FluidError> {
    let of = |edge| mesh.component(mesh.ends(edge)[0]);
    // In, out.
    let mut sums = vec![[0.0; 2]; mesh.components()];
    for (edge, &flow) in through.entries() {
        sums[of(edge)][usize::from(flow < 0.0)] += flow.abs();
    }
    for (component, &[into, out]) in sums.iter().enumerate() {
        if (into - out).abs() > IMBALANCE * (into + out) {
            return Err(FluidError::Imbalance { component, into, out });
        }
    }
    for edge in mesh.edge_ids() {
        let [into, out] = sums[of(edge)];
        if through[edge] < 0.0 {
            through[edge] *= into / out;
        }
    }
    Ok(())
}
