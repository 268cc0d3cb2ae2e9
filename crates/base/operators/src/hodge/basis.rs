//! Harmonic fields from homology generators.

use super::spaces::{Boundary, DirichletPotential, Splitting, conforming_system};
use crate::OperatorError;
use crate::field::{FaceField, add_scaled, check_field, field_inner_product, rotated};
use crate::gradient::{divergence, face_gradient};
use pompeiu_core::FaceId;
use pompeiu_core::mesh::VertexData;
use pompeiu_solve::{DenseCholesky, LinearSolver, SemidefiniteCholesky};
use pompeiu_surface::plane::{Vec2, add, dot, quarter_turn, scale};
use pompeiu_surface::{Chain, EdgeData, HalfedgeId, Surface, SurfaceMesh, tree_cotree};
use rayon::prelude::*;

/// An orthonormal basis of the harmonic fields of a surface: the fields orthogonal to all gradients and rotated gradients.
///
/// # Definition
/// Each generator of the first cohomology is a closed form with integer values on edges. Exactly one field, constant on each face,
/// has these circulations along the sides. It has no curl at any edge, because both faces of an edge agree on the circulation.
/// Subtracting its projection onto the gradients leaves a harmonic field: one sparse solve each, no eigenvalues. The fields are
/// then orthonormalised in the inner product of fields.
///
/// The dimension is 2g for a closed component of genus g and 2g + b − 1 for one with b boundary loops.
///
/// # Cost
/// One factorization of the cotangent Laplacian; for k fields k solves and O(V k² + k³), in parallel with the same bits at any
/// number of threads. 16 bytes per face and 8 per vertex for each field.
///
/// # Source
/// `wardetzky_discrete_2006` for the spaces; loops from [`tree_cotree`].
#[derive(Clone, Debug)]
pub struct HarmonicBasis {
    fields: Vec<FaceField>,
}

impl HarmonicBasis {
    /// The basis for a splitting and a boundary condition.
    ///
    /// # Errors
    /// [`OperatorError::Solve`] if the Laplacian cannot be factored, which very thin faces can cause.
    pub fn new(surface: &Surface, splitting: Splitting, boundary: Boundary) -> Result<Self, OperatorError> {
        let fixed = DirichletPotential::of(splitting, boundary);
        let solver = conforming_system(surface, fixed == DirichletPotential::Conforming)?;
        let basis = Self::primal(surface, fixed, &solver)?;
        Ok(match splitting {
            Splitting::Primal => basis,
            Splitting::Dual => basis.turned(),
        })
    }

    /// The basis for the primal splitting; the Laplacian of [`conforming_system`] is given.
    ///
    /// # Errors
    /// [`OperatorError::Solve`] if a system cannot be solved.
    pub fn primal(
        surface: &Surface,
        fixed: DirichletPotential,
        solver: &SemidefiniteCholesky,
    ) -> Result<Self, OperatorError> {
        let forms = tree_cotree(surface.mesh(), fixed.relative()).forms;
        let mut combinations = Combinations::new(surface, forms, solver)?;
        combinations.orthonormalize()?;
        Ok(Self { fields: combinations.fields() })
    }

    /// Each field rotated by a quarter turn: the basis of the other splitting.
    #[must_use]
    pub fn turned(&self) -> Self {
        Self { fields: self.fields.iter().map(rotated).collect() }
    }

    /// How many fields there are.
    pub fn dimension(&self) -> usize {
        self.fields.len()
    }

    /// The fields, orthonormal.
    pub fn fields(&self) -> &[FaceField] {
        &self.fields
    }

    /// The coefficients of the harmonic part of a field: its inner products with the basis.
    ///
    /// # Errors
    /// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`].
    pub fn coefficients(&self, surface: &Surface, field: &FaceField) -> Result<Vec<f64>, OperatorError> {
        check_field(surface.mesh(), field)?;
        Ok(self.fields.par_iter().map(|basis| field_inner_product(surface, field, basis)).collect())
    }

    /// The field with these coefficients; missing ones are zero.
    pub fn combination(&self, faces: usize, coefficients: &[f64]) -> FaceField {
        let mut sum = FaceField::filled(faces, [0.0; 2]);
        for (field, &coefficient) in self.fields.iter().zip(coefficients) {
            add_scaled(&mut sum, coefficient, field);
        }
        sum
    }
}

/// Right-hand sides per task; fixed, so that bits do not depend on the number of threads.
const COLUMNS: usize = 16;

/// Number of orthonormalisation passes: the second removes what rounding left after the first.
const PASSES: usize = 2;

/// Closed forms, and the gradients that make their fields harmonic.
///
/// A harmonic field is `w + ∇p`, with `w` the field of a closed form, nonzero near a few edges, and a potential `p`. Forms,
/// potentials and coefficients are stored; dense fields are made one at a time. As a harmonic field is orthogonal to gradients,
/// `⟨w + ∇p, h⟩ = ⟨w, h⟩` for any other harmonic field h: a sum over the faces along the form.
struct Combinations<'s> {
    surface: &'s Surface,
    forms: Vec<Chain>,
    /// For each form, the faces along it with its field there, times their area.
    weights: Vec<Vec<(FaceId, Vec2)>>,
    /// All faces along forms.
    along: Vec<FaceId>,
    /// Coefficients of forms in the fields, lower triangular, stored column by column; one column for each form.
    coefficients: Vec<f64>,
    /// Potentials of the fields: vertex by vertex, a value for each field.
    potentials: Vec<f64>,
}

impl<'s> Combinations<'s> {
    /// Each form with the gradient that makes it harmonic.
    fn new(
        surface: &'s Surface,
        forms: Vec<Chain>,
        solver: &SemidefiniteCholesky,
    ) -> Result<Self, OperatorError> {
        let (mesh, count) = (surface.mesh(), forms.len());
        let columns: Vec<Vec<f64>> = forms
            .par_chunks(COLUMNS)
            .map(|forms| {
                let mut columns = Vec::with_capacity(forms.len() * mesh.vertices());
                for form in forms {
                    // The divergence is −G_vᵀ M u, so the potential comes out with the other sign and is added.
                    columns.extend(divergence(surface, &field_of(surface, &values(mesh, [(form, 1.0)])))?);
                }
                solver.solve_in_place(&mut columns)?;
                Ok(columns)
            })
            .collect::<Result<_, OperatorError>>()?;
        let mut potentials = vec![0.0; count * mesh.vertices()];
        for (part, columns) in columns.iter().enumerate() {
            for (v, at_vertex) in potentials.chunks_exact_mut(count).enumerate() {
                let values = columns.iter().skip(v).step_by(mesh.vertices());
                at_vertex[part * COLUMNS..].iter_mut().zip(values).for_each(|(to, value)| *to = *value);
            }
        }
        drop(columns);
        let weights: Vec<Vec<(FaceId, Vec2)>> = forms.par_iter().map(|form| weights(surface, form)).collect();
        let mut along: Vec<FaceId> = weights.iter().flatten().map(|weight| weight.0).collect();
        along.sort_unstable();
        along.dedup();
        let mut coefficients = vec![0.0; count * count];
        (0..count).for_each(|i| coefficients[i * count + i] = 1.0);
        Ok(Self { surface, forms, weights, along, coefficients, potentials })
    }

    /// Applies a function to each field, restricted to some faces; elsewhere the field is zero.
    ///
    /// Fields are made a few at a time, because their potentials are stored interleaved.
    fn each<T: Send>(&self, faces: &[FaceId], make: impl Fn(FaceField) -> T + Sync) -> Vec<T> {
        const SIDE_BY_SIDE: usize = 8;
        let (mesh, count) = (self.surface.mesh(), self.forms.len());
        let starts: Vec<usize> = (0..count).step_by(SIDE_BY_SIDE).collect();
        let parts: Vec<Vec<T>> = starts
            .into_par_iter()
            .map(|start| {
                let indices = start..(start + SIDE_BY_SIDE).min(count);
                let mut potentials = vec![VertexData::filled(mesh.vertices(), 0.0); indices.len()];
                for (v, values) in self.potentials.chunks_exact(count).enumerate() {
                    for (potential, value) in potentials.iter_mut().zip(&values[indices.clone()]) {
                        potential.as_mut_slice()[v] = *value;
                    }
                }
                let make_one = |(j, potential): (usize, VertexData<f64>)| {
                    let parts = self.forms[..=j].iter().enumerate();
                    let parts = parts.map(|(i, form)| (form, self.coefficients[i * count + j]));
                    let values = values(mesh, parts);
                    let mut field = FaceField::filled(mesh.faces(), [0.0; 2]);
                    for &face in faces {
                        let vector = vector_of(self.surface, &values, face);
                        field[face] = add(vector, face_gradient(self.surface, face, &potential));
                    }
                    make(field)
                };
                indices.zip(potentials).map(make_one).collect()
            })
            .collect();
        parts.into_iter().flatten().collect()
    }

    /// The fields.
    fn fields(&self) -> Vec<FaceField> {
        self.each(&self.surface.mesh().face_ids().collect::<Vec<_>>(), |field| field)
    }

    /// The inner products of the forms with a field.
    fn products(&self, field: &FaceField) -> impl Iterator<Item = f64> {
        self.weights
            .iter()
            .map(|weights| weights.iter().map(|&(face, weight)| dot(weight, field[face])).sum())
    }

    /// Orthonormalises the fields in order, as Gram–Schmidt does, by the Cholesky factor of their Gram matrix.
    fn orthonormalize(&mut self) -> Result<(), OperatorError> {
        let count = self.forms.len();
        let mut factors: Vec<DenseCholesky> = Vec::new();
        for _ in 0..PASSES {
            // Column j: the inner products of all forms with field j.
            let columns = self.each(&self.along, |field| self.products(&field).collect::<Vec<f64>>());
            let mut gram = columns.concat();
            for factor in &factors {
                factor.solve_lower_in_place(&mut gram)?;
            }
            for i in 0..count {
                for j in 0..i {
                    let mean = f64::midpoint(gram[j * count + i], gram[i * count + j]);
                    gram[j * count + i] = mean;
                }
            }
            let factor = DenseCholesky::new(count, gram)?;
            factor.solve_lower_in_place(&mut self.coefficients)?;
            factor.solve_lower_in_place(&mut self.potentials)?;
            factors.push(factor);
        }
        Ok(())
    }
}

/// The values at edges of a sum of forms.
fn values<'f>(mesh: &SurfaceMesh, parts: impl IntoIterator<Item = (&'f Chain, f64)>) -> EdgeData<f64> {
    let mut values = EdgeData::filled(mesh.edges(), 0.0);
    for (form, coefficient) in parts {
        for &(edge, sign) in form {
            values[edge] += coefficient * f64::from(sign);
        }
    }
    values
}

/// The field with the circulations of a closed form along the sides of every face.
fn field_of(surface: &Surface, values: &EdgeData<f64>) -> FaceField {
    FaceField::from_fn(surface.mesh().faces(), |face| vector_of(surface, values, face))
}

fn vector_of(surface: &Surface, values: &EdgeData<f64>, face: FaceId) -> Vec2 {
    let mesh = surface.mesh();
    let [p, q, _] = SurfaceMesh::face_halfedges(face).map(|h| {
        let value = values[mesh.edge(h)];
        if mesh.is_along(h) { value } else { -value }
    });
    let sides = surface.sides(face);
    let (first, second) = (quarter_turn(sides[0]), quarter_turn(sides[1]));
    let twice = 2.0 * surface.face_area(face);
    [0, 1].map(|i| (q * first[i] - p * second[i]) / twice)
}

/// The faces along a form with its field there, times their area.
fn weights(surface: &Surface, form: &Chain) -> Vec<(FaceId, Vec2)> {
    let mesh = surface.mesh();
    let values = values(mesh, [(form, 1.0)]);
    let mut faces: Vec<FaceId> = form
        .iter()
        .flat_map(|&(edge, _)| {
            let h = mesh.edge_halfedge(edge);
            [Some(h), mesh.twin(h)]
        })
        .flatten()
        .map(HalfedgeId::face)
        .collect();
    faces.sort_unstable();
    faces.dedup();
    let weight = |face| scale(surface.face_area(face), vector_of(surface, &values, face));
    faces.into_iter().map(|face| (face, weight(face))).collect()
}
