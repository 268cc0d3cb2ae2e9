//! Stiffness matrices.

use crate::OperatorError;
use pompeiu_solve::SparseMatrix;
use pompeiu_surface::{HalfedgeId, Surface, SurfaceMesh};

/// The cotangent Laplacian `G_vᵀ M G_v`.
///
/// Positive semi-definite: its sign is that of `−Δ`, and `aᵀ L a` is the integral of `|∇a|²`. Constants on each component span
/// the kernel. Integrated: divide by areas ([`Surface::vertex_areas`]) for values per area.
///
/// # Shapes and units
/// V × V, symmetric, without unit.
/// # Definition
/// `L_ij = −½ (cot α + cot β)` with the angles opposite the edge, one of them at the boundary; rows add up to zero.
/// # Limits
/// Off-diagonal entries are positive where the opposite angles add up to more than π, that is on edges that are not Delaunay: then
/// there is no maximum principle.
/// # Errors
/// None for a valid surface; those of [`SparseMatrix::from_links`].
/// # Cost
/// O(F).
/// # Source
/// `pinkall_computing_1993`.
pub fn cotan_laplacian(surface: &Surface) -> Result<SparseMatrix, OperatorError> {
    let mesh = surface.mesh();
    let links: Vec<_> = mesh
        .edge_ids()
        .map(|edge| {
            let h = mesh.edge_halfedge(edge);
            let opposite = |h: HalfedgeId| surface.cotangent(h.previous());
            let weight = 0.5 * (opposite(h) + mesh.twin(h).map_or(0.0, opposite));
            (mesh.tail(h).0, mesh.head(h).0, weight)
        })
        .collect();
    Ok(SparseMatrix::from_links(mesh.vertices(), &links)?)
}

/// The Laplacian `G_eᵀ M G_e` of Crouzeix–Raviart functions: linear on faces, continuous at midpoints of edges.
///
/// Positive semi-definite, with constants on each component for kernel, like [`cotan_laplacian`]. It is also
/// `(J G_e)ᵀ M (J G_e)`. At most five entries in a row.
///
/// # Shapes and units
/// E × E, symmetric, without unit.
/// # Definition
/// `L_ij = −2 cot γ` for two edges that meet in the angle γ of a face; rows add up to zero.
/// # Errors
/// None for a valid surface; those of [`SparseMatrix::from_links`].
/// # Cost
/// O(F).
/// # Source
/// `crouzeix_conforming_1973`, `polthier_identifying_2003`.
pub fn crouzeix_raviart_laplacian(surface: &Surface) -> Result<SparseMatrix, OperatorError> {
    let mesh = surface.mesh();
    let links: Vec<_> = mesh
        .face_ids()
        .flat_map(SurfaceMesh::face_halfedges)
        .map(|h| (mesh.edge(h).0, mesh.edge(h.previous()).0, 2.0 * surface.cotangent(h)))
        .collect();
    Ok(SparseMatrix::from_links(mesh.edges(), &links)?)
}
