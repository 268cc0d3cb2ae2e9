//! Splitting with one kind of function only: to see why it fails.

use pompeiu_operators::hodge::{Fixed, edge_system, vertex_system};
use pompeiu_operators::{
    Boundary, FaceField, OperatorError, Splitting, check_field, difference, divergence, edge_curl,
    edge_divergence, edge_gradient, field_inner_product, field_norm, gradient, rotated, vertex_curl,
};
use pompeiu_solve::{LinearSolver, SemidefiniteCholesky};
use pompeiu_surface::Surface;
use pompeiu_surface::plane::Vec2;

/// A kind of function that is linear on each face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FunctionKind {
    /// Continuous: one value at each vertex.
    Conforming,
    /// Agreeing at midpoints of edges: one value at each edge.
    Nonconforming,
}

/// Both projections of a field, onto gradients and onto rotated gradients of functions of one kind.
///
/// Kept to show what goes wrong; [`HodgeSolver`](crate::HodgeSolver) is the one to use.
///
/// # Limits
/// *Conforming:* the two ranges are orthogonal but too small. What is left over is not harmonic: on a torus of 768
/// faces it has 770 dimensions instead of 2, so that even a rotated gradient of a function that agrees at midpoints leaves some.
///
/// *Nonconforming:* the two ranges overlap. The gradient of such a function also has a part among the rotated
/// gradients, so the two parts are not orthogonal and do not add up to the field.
///
/// # Source
/// `wardetzky_discrete_2006`.
#[derive(Debug)]
pub struct OneKindSolver<'s> {
    surface: &'s Surface,
    kind: FunctionKind,
    gradients: SemidefiniteCholesky,
    rotated: SemidefiniteCholesky,
}

/// What the two projections of a field are, and what they miss.
#[derive(Clone, Debug, PartialEq)]
pub struct OneKindParts {
    /// The nearest gradient.
    pub gradient: FaceField,
    /// The nearest rotated gradient.
    pub rotated: FaceField,
    /// The field less both.
    pub left_over: FaceField,
    /// Inner product of the gradient and the rotated gradient, over the squared norm of the field.
    pub gradient_rotated: f64,
    /// Inner products of what is left over with the gradient and with the rotated gradient, likewise.
    pub left_over_products: [f64; 2],
}

impl<'s> OneKindSolver<'s> {
    /// Assembles and factors the Laplacian, twice: with the condition at the boundary and without.
    ///
    /// # Errors
    /// [`OperatorError::Solve`] if it cannot be factored, which very thin faces can cause.
    pub fn new(surface: &'s Surface, kind: FunctionKind, boundary: Boundary) -> Result<Self, OperatorError> {
        let rotated_is_fixed = Fixed::of(Splitting::Primal, boundary) == Fixed::Edges;
        let system = match kind {
            FunctionKind::Conforming => vertex_system,
            FunctionKind::Nonconforming => edge_system,
        };
        let (gradients, rotated) = (system(surface, !rotated_is_fixed)?, system(surface, rotated_is_fixed)?);
        Ok(Self { surface, kind, gradients, rotated })
    }

    /// Projects a field onto both ranges.
    ///
    /// # Errors
    /// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`]; [`OperatorError::Solve`] when values overflow.
    pub fn split(&self, field: &[Vec2]) -> Result<OneKindParts, OperatorError> {
        let surface = self.surface;
        check_field(surface.mesh(), field)?;
        let (mut potential, mut rotated_potential) = match self.kind {
            FunctionKind::Conforming => (divergence(surface, field)?, vertex_curl(surface, field)?),
            FunctionKind::Nonconforming => (edge_divergence(surface, field)?, edge_curl(surface, field)?),
        };
        for value in &mut potential {
            *value = -*value;
        }
        self.gradients.solve_in_place(&mut potential)?;
        self.rotated.solve_in_place(&mut rotated_potential)?;
        let of = match self.kind {
            FunctionKind::Conforming => gradient,
            FunctionKind::Nonconforming => edge_gradient,
        };
        let (gradient, rotated) = (of(surface, &potential)?, rotated(&of(surface, &rotated_potential)?));
        let left_over = difference(&difference(field, &gradient), &rotated);
        let norm = field_norm(surface, field);
        let over = |value: f64| if norm > 0.0 { value / norm / norm } else { 0.0 };
        let product = |u: &[Vec2], w: &[Vec2]| over(field_inner_product(surface, u, w));
        Ok(OneKindParts {
            gradient_rotated: product(&gradient, &rotated),
            left_over_products: [product(&left_over, &gradient), product(&left_over, &rotated)],
            gradient,
            rotated,
            left_over,
        })
    }
}
