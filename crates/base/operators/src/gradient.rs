//! Gradients of both kinds of functions, and their adjoints: divergence and curl.
//!
//! With `s_i` the side from corner `i` to the next and `A` the area of a face, the hat function of the corner opposite `s_i`
//! has the gradient `J s_i / (2A)`, and the function that is 1 at the midpoint of `s_i` and 0 at the other two midpoints has
//! `−J s_i / A`.

use crate::OperatorError;
use crate::field::{FaceField, check_field, check_values};
use pompeiu_core::FaceId;
use pompeiu_core::mesh::VertexData;
use pompeiu_solve::SparseMatrix;
use pompeiu_surface::plane::{Vec2, cross, dot, quarter_turn};
use pompeiu_surface::{EdgeData, HalfedgeId, Surface, SurfaceMesh};

/// `G_v a`: the gradient of the function with these values at vertices.
///
/// # Definition
/// The continuous function that is linear on each face; its gradient is constant on each face.
/// # Errors
/// [`OperatorError::ValueLength`].
/// # Cost
/// O(F), without a matrix.
pub fn gradient(surface: &Surface, values: &VertexData<f64>) -> Result<FaceField, OperatorError> {
    check_values(values, surface.mesh().vertices())?;
    Ok(FaceField::from_fn(surface.mesh().faces(), |face| face_gradient(surface, face, values)))
}

#[inline]
pub(crate) fn face_gradient(surface: &Surface, face: FaceId, values: &VertexData<f64>) -> Vec2 {
    let sides = surface.sides(face);
    let [a, b, c] = surface.mesh().face(face).map(|v| values[v]);
    // The sides add up to zero, so differences of values suffice, and a large constant costs no digits.
    let (p, q) = (b - a, c - a);
    let twice = 2.0 * surface.face_area(face);
    let opposite_b = quarter_turn(sides[2]);
    let opposite_c = quarter_turn(sides[0]);
    [0, 1].map(|i| (p * opposite_b[i] + q * opposite_c[i]) / twice)
}

/// `G_e b`: the gradient, face by face, of the function with these values at the midpoints of edges.
///
/// # Definition
/// The function that is linear on each face and agrees with its neighbours at midpoints of edges (Crouzeix and Raviart).
/// # Errors
/// [`OperatorError::ValueLength`].
/// # Cost
/// O(F), without a matrix.
/// # Source
/// `crouzeix_conforming_1973`, `polthier_identifying_2003`.
pub fn crouzeix_raviart_gradient(
    surface: &Surface,
    values: &EdgeData<f64>,
) -> Result<FaceField, OperatorError> {
    let mesh = surface.mesh();
    check_values(values, mesh.edges())?;
    Ok(FaceField::from_fn(mesh.faces(), |face| {
        let sides = surface.sides(face);
        let [a, b, c] = SurfaceMesh::face_halfedges(face).map(|h| values[mesh.edge(h)]);
        let (p, q) = (b - a, c - a);
        let area = surface.face_area(face);
        let (second, third) = (quarter_turn(sides[1]), quarter_turn(sides[2]));
        [0, 1].map(|i| -(p * second[i] + q * third[i]) / area)
    }))
}

/// `−G_vᵀ M u`: the divergence of a field at vertices, integrated against their hat functions.
///
/// At the boundary it includes the flow through it. Divide by [`Surface::vertex_areas`] for values per area.
///
/// # Errors
/// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`].
pub fn divergence(surface: &Surface, field: &FaceField) -> Result<VertexData<f64>, OperatorError> {
    check_field(surface.mesh(), field)?;
    Ok(scatter_to_vertices(surface, |h| -0.5 * cross(surface.vector(h), field[h.face()])))
}

/// `(J G_v)ᵀ M u`: the curl of a field at vertices, integrated against their hat functions.
///
/// # Errors
/// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`].
pub fn curl(surface: &Surface, field: &FaceField) -> Result<VertexData<f64>, OperatorError> {
    check_field(surface.mesh(), field)?;
    Ok(scatter_to_vertices(surface, |h| -0.5 * dot(surface.vector(h), field[h.face()])))
}

/// Sums a term of each half-edge at the vertex opposite to it.
fn scatter_to_vertices(surface: &Surface, term: impl Fn(HalfedgeId) -> f64) -> VertexData<f64> {
    let mesh = surface.mesh();
    let mut sums = VertexData::filled(mesh.vertices(), 0.0);
    for h in mesh.face_ids().flat_map(SurfaceMesh::face_halfedges) {
        sums[mesh.tail(h.previous())] += term(h);
    }
    sums
}

/// `(J G_e)ᵀ M u`: the curl of a field at edges, integrated against the functions of their midpoints.
///
/// It is the jump of the tangential component times the length of the edge; zero if that component is continuous across the edge.
///
/// # Errors
/// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`].
pub fn crouzeix_raviart_curl(surface: &Surface, field: &FaceField) -> Result<EdgeData<f64>, OperatorError> {
    check_field(surface.mesh(), field)?;
    Ok(scatter_to_edges(surface, |h| dot(surface.vector(h), field[h.face()])))
}

/// `−G_eᵀ M u`: the divergence of a field at edges, integrated against the functions of their midpoints.
///
/// # Errors
/// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`].
pub fn crouzeix_raviart_divergence(
    surface: &Surface,
    field: &FaceField,
) -> Result<EdgeData<f64>, OperatorError> {
    check_field(surface.mesh(), field)?;
    Ok(scatter_to_edges(surface, |h| cross(surface.vector(h), field[h.face()])))
}

/// Sums a term of each half-edge at its edge.
fn scatter_to_edges(surface: &Surface, term: impl Fn(HalfedgeId) -> f64) -> EdgeData<f64> {
    let mesh = surface.mesh();
    let mut sums = EdgeData::filled(mesh.edges(), 0.0);
    for h in mesh.face_ids().flat_map(SurfaceMesh::face_halfedges) {
        sums[mesh.edge(h)] += term(h);
    }
    sums
}

/// `G_v` as a matrix: rows `2 f` and `2 f + 1` are the components on face `f`, columns are vertices.
///
/// # Errors
/// None for a valid surface; those of [`SparseMatrix::from_triplets`].
pub fn gradient_matrix(surface: &Surface) -> Result<SparseMatrix, OperatorError> {
    let mesh = surface.mesh();
    matrix(surface, mesh.vertices(), 0.5, |h| mesh.tail(h.previous()).index())
}

/// `G_e` as a matrix: rows `2 f` and `2 f + 1` are the components on face `f`, columns are edges.
///
/// # Errors
/// None for a valid surface; those of [`SparseMatrix::from_triplets`].
pub fn crouzeix_raviart_gradient_matrix(surface: &Surface) -> Result<SparseMatrix, OperatorError> {
    let mesh = surface.mesh();
    matrix(surface, mesh.edges(), -1.0, |h| mesh.edge(h).index())
}

fn matrix(
    surface: &Surface,
    columns: usize,
    factor: f64,
    column: impl Fn(HalfedgeId) -> usize,
) -> Result<SparseMatrix, OperatorError> {
    let mesh = surface.mesh();
    let mut entries = Vec::with_capacity(6 * mesh.faces());
    for face in mesh.face_ids() {
        let area = surface.face_area(face);
        for h in SurfaceMesh::face_halfedges(face) {
            let turned = quarter_turn(surface.vector(h));
            for (i, x) in turned.into_iter().enumerate() {
                entries.push((2 * face.index() + i, column(h), factor * x / area));
            }
        }
    }
    Ok(SparseMatrix::from_triplets(2 * mesh.faces(), columns, &entries)?)
}
