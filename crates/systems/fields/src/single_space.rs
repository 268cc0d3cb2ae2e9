//! The decomposition with a single function space for both potentials, which is incorrect.

use crate::scale::{normalized, restore};
use pompeiu_core::mesh::ElementData;
use pompeiu_operators::hodge::{DirichletPotential, conforming_system, crouzeix_raviart_system};
use pompeiu_operators::{
    Boundary, FaceField, OperatorError, Splitting, check_field, crouzeix_raviart_curl,
    crouzeix_raviart_divergence, crouzeix_raviart_gradient, curl, difference, divergence,
    field_inner_product, field_norm, gradient, rotated,
};
use pompeiu_solve::{LinearSolver, SemidefiniteCholesky};
use pompeiu_surface::Surface;

/// A space of functions that are linear on each face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionSpace {
    /// Continuous: one value at each vertex.
    Conforming,
    /// Continuous at midpoints of edges: one value at each edge.
    Nonconforming,
}

/// The orthogonal projections of a field onto gradients and onto rotated gradients of a single function space.
///
/// For comparison only; use [`HodgeSolver`](crate::HodgeSolver) to decompose fields.
///
/// # Limits
/// *Conforming:* the two ranges are orthogonal but too small. The residual is not harmonic: on a torus of 768 faces it has 770
/// dimensions instead of 2, so that even the rotated gradient of a function continuous at midpoints has a residual.
///
/// *Nonconforming:* the two ranges overlap. The gradient of such a function also has a component among the rotated gradients, so
/// the two parts are not orthogonal and do not add up to the field.
///
/// # Source
/// `wardetzky_discrete_2006`.
#[derive(Debug)]
pub struct SingleSpaceSolver<'s> {
    surface: &'s Surface,
    space: FunctionSpace,
    gradients: SemidefiniteCholesky,
    rotated: SemidefiniteCholesky,
}

/// The two projections of a field, and the residual.
#[derive(Clone, Debug, PartialEq)]
pub struct SingleSpaceParts {
    /// The nearest gradient.
    pub gradient: FaceField,
    /// The nearest rotated gradient.
    pub rotated: FaceField,
    /// The field less both.
    pub residual: FaceField,
    /// Inner product of the gradient and the rotated gradient, over the squared norm of the field.
    pub gradient_rotated: f64,
    /// Inner products of the residual with the gradient and with the rotated gradient, likewise.
    pub residual_products: [f64; 2],
}

impl<'s> SingleSpaceSolver<'s> {
    /// Assembles and factors the Laplacian with and without the boundary condition.
    ///
    /// # Errors
    /// [`OperatorError::Solve`] if it cannot be factored, which very thin faces can cause.
    pub fn new(
        surface: &'s Surface,
        space: FunctionSpace,
        boundary: Boundary,
    ) -> Result<Self, OperatorError> {
        let rotated_is_fixed =
            DirichletPotential::of(Splitting::Primal, boundary) == DirichletPotential::CrouzeixRaviart;
        let system = match space {
            FunctionSpace::Conforming => conforming_system,
            FunctionSpace::Nonconforming => crouzeix_raviart_system,
        };
        let (gradients, rotated) = (system(surface, !rotated_is_fixed)?, system(surface, rotated_is_fixed)?);
        Ok(Self { surface, space, gradients, rotated })
    }

    /// Projects a field onto both ranges.
    ///
    /// # Errors
    /// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`], [`OperatorError::FieldTooLarge`],
    /// [`OperatorError::Solve`].
    pub fn split(&self, field: &FaceField) -> Result<SingleSpaceParts, OperatorError> {
        let surface = self.surface;
        check_field(surface.mesh(), field)?;
        let (near_one, exponent) = normalized(field);
        let (given, field) = (field, &near_one);
        let (mut gradient, mut rotated) = match self.space {
            FunctionSpace::Conforming => {
                let [a, b] = self.potentials(divergence(surface, field)?, curl(surface, field)?)?;
                (gradient(surface, &a)?, rotated(&gradient(surface, &b)?))
            }
            FunctionSpace::Nonconforming => {
                let divergence = crouzeix_raviart_divergence(surface, field)?;
                let [a, b] = self.potentials(divergence, crouzeix_raviart_curl(surface, field)?)?;
                (crouzeix_raviart_gradient(surface, &a)?, rotated(&crouzeix_raviart_gradient(surface, &b)?))
            }
        };
        let mut residual = difference(&difference(field, &gradient), &rotated);
        let norm = field_norm(surface, field);
        let over = |value: f64| if norm > 0.0 { value / norm / norm } else { 0.0 };
        let product = |u: &FaceField, w: &FaceField| over(field_inner_product(surface, u, w));
        let gradient_rotated = product(&gradient, &rotated);
        let residual_products = [product(&residual, &gradient), product(&residual, &rotated)];
        for part in [&mut gradient, &mut rotated, &mut residual] {
            restore(part.as_flattened_mut(), exponent, given)?;
        }
        Ok(SingleSpaceParts { gradient, rotated, residual, gradient_rotated, residual_products })
    }

    /// The potentials of both projections, from the divergence and the curl.
    fn potentials<I>(
        &self,
        mut divergence: ElementData<I, f64>,
        mut curl: ElementData<I, f64>,
    ) -> Result<[ElementData<I, f64>; 2], OperatorError> {
        for value in &mut divergence {
            *value = -*value;
        }
        self.gradients.solve_in_place(&mut divergence)?;
        self.rotated.solve_in_place(&mut curl)?;
        Ok([divergence, curl])
    }
}
