//! Mass matrices.

use crate::OperatorError;
use pompeiu_solve::SparseMatrix;
use pompeiu_surface::Surface;

/// The consistent mass matrix of continuous linear functions: `aᵀ M c` is the integral of their product, exactly.
///
/// The lumped matrix is the diagonal [`Surface::vertex_areas`], the row sums of this one.
///
/// # Shapes and units
/// V × V, symmetric positive definite, areas.
/// # Definition
/// A face of area A adds A/6 on the diagonal and A/12 off it.
/// # Errors
/// None for a valid surface; those of [`SparseMatrix::from_triplets`].
pub fn mass_matrix(surface: &Surface) -> Result<SparseMatrix, OperatorError> {
    let mesh = surface.mesh();
    let mut entries = Vec::with_capacity(9 * mesh.faces());
    for face in mesh.face_ids() {
        let twelfth = surface.face_area(face) / 12.0;
        let corners = mesh.face(face).map(pompeiu_core::VertexId::index);
        for i in corners {
            entries.extend(corners.map(|j| (i, j, if i == j { 2.0 * twelfth } else { twelfth })));
        }
    }
    Ok(SparseMatrix::from_triplets(mesh.vertices(), mesh.vertices(), &entries)?)
}

/// The mass matrix of fields: the area of each face, twice, on the diagonal.
///
/// # Errors
/// None for a valid surface; those of [`SparseMatrix::diagonal`].
pub fn face_mass(surface: &Surface) -> Result<SparseMatrix, OperatorError> {
    let areas: Vec<f64> = surface.face_areas().into_iter().flat_map(|area| [area, area]).collect();
    Ok(SparseMatrix::diagonal(&areas)?)
}
