//! Harmonic fields, from loops.

use super::spaces::{Boundary, DirichletPotential, Splitting, conforming_system};
use crate::OperatorError;
use crate::field::{FaceField, add_scaled, check_field, field_inner_product, field_norm, rotated};
use crate::gradient::{divergence, gradient};
use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use pompeiu_solve::{LinearSolver, SemidefiniteCholesky};
use pompeiu_surface::plane::quarter_turn;
use pompeiu_surface::{Chain, EdgeData, Surface, SurfaceMesh, tree_cotree};

/// An orthonormal basis of the harmonic fields of a surface: those orthogonal to all gradients and rotated gradients.
///
/// # Definition
/// Each generator of the first cohomology is a closed form with integer values on edges; there is exactly one constant field
/// on each face with these circulations along its sides. It has no curl at any edge, because both faces of an edge agree on
/// it. Taking off the gradient nearest to it leaves a harmonic field: one sparse solve each, no eigenvalues. The fields are
/// then made orthonormal, in the inner product of fields.
///
/// The dimension is 2g for a closed component of genus g and 2g + b − 1 for one with b boundary loops.
///
/// # Cost
/// One factorization of the cotangent Laplacian, one solve for each field, O(F k²) for k fields; 16 bytes per face each.
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

    /// The basis for the primal splitting, with the Laplacian of [`conforming_system`] given.
    ///
    /// # Errors
    /// [`OperatorError::Solve`] if a system cannot be solved.
    pub fn primal(
        surface: &Surface,
        fixed: DirichletPotential,
        solver: &SemidefiniteCholesky,
    ) -> Result<Self, OperatorError> {
        let forms = tree_cotree(surface.mesh(), fixed.relative()).forms;
        let mut fields: Vec<FaceField> = forms.iter().map(|form| field_of(surface, form)).collect();
        take_off_gradients(surface, solver, &mut fields)?;
        orthonormalize(surface, &mut fields);
        Ok(Self { fields })
    }

    /// Each field turned by a quarter: the basis of the other splitting.
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
        Ok(self.fields.iter().map(|basis| field_inner_product(surface, field, basis)).collect())
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

/// The field with the circulations of a closed form along the sides of every face.
fn field_of(surface: &Surface, form: &Chain) -> FaceField {
    let mesh = surface.mesh();
    let mut values = EdgeData::filled(mesh.edges(), 0.0);
    for &(edge, sign) in form {
        values[edge] += f64::from(sign);
    }
    FaceField::from_fn(mesh.faces(), |face| {
        let [p, q, _] = SurfaceMesh::face_halfedges(face).map(|h| {
            let value = values[mesh.edge(h)];
            if mesh.is_along(h) { value } else { -value }
        });
        let sides = surface.sides(face);
        let (first, second) = (quarter_turn(sides[0]), quarter_turn(sides[1]));
        let twice = 2.0 * surface.face_area(face);
        [0, 1].map(|i| (q * first[i] - p * second[i]) / twice)
    })
}

/// Leaves what is orthogonal to all gradients; all fields in one solve.
fn take_off_gradients(
    surface: &Surface,
    solver: &SemidefiniteCholesky,
    fields: &mut [FaceField],
) -> Result<(), OperatorError> {
    let mut potentials = Vec::with_capacity(fields.len() * solver.unknowns());
    for field in &*fields {
        potentials.extend(divergence(surface, field)?);
    }
    solver.solve_in_place(&mut potentials)?;
    for (field, potential) in fields.iter_mut().zip(potentials.chunks_exact(solver.unknowns())) {
        let potential = VertexData::from_fn(potential.len(), |v: VertexId| potential[v.index()]);
        // The divergence is −G_vᵀ M u, so the potential comes out with the other sign and is added.
        add_scaled(field, 1.0, &gradient(surface, &potential)?);
    }
    Ok(())
}

/// Gram and Schmidt, twice.
fn orthonormalize(surface: &Surface, fields: &mut [FaceField]) {
    for i in 0..fields.len() {
        let (done, rest) = fields.split_at_mut(i);
        let field = &mut rest[0];
        for _ in 0..2 {
            for earlier in &*done {
                let s = field_inner_product(surface, field, earlier);
                add_scaled(field, -s, earlier);
            }
            let norm = field_norm(surface, field);
            for u in field.iter_mut() {
                *u = u.map(|x| x / norm);
            }
        }
    }
}
