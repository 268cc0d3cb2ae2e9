//! The splitting of fields, factored once for many.

use pompeiu_operators::hodge::{Fixed, edge_system, vertex_system};
use pompeiu_operators::{
    Boundary, FaceField, HarmonicBasis, OperatorError, Splitting, add_scaled, check_field, difference,
    divergence, edge_curl, edge_gradient, field_inner_product, field_norm, gradient, rotated,
};
use pompeiu_solve::{LinearSolver, SemidefiniteCholesky};
use pompeiu_surface::Surface;
use pompeiu_surface::plane::Vec2;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// A surface made ready to split fields.
///
/// # Definition
/// In the primal splitting `u = G_v a + J G_e b + h`, with a continuous and b agreeing at midpoints of edges. The first two
/// ranges are orthogonal, because the integral of `∇a · J∇b` over a face is a sum of differences of a along its sides, which
/// the faces on both sides of an edge count with opposite signs. So the parts are the orthogonal projections of u, and each
/// potential solves a positive semi-definite system of its own:
///
/// ```text
/// G_vᵀ M G_v a = G_vᵀ M u        G_eᵀ M G_e b = (J G_e)ᵀ M u
/// ```
///
/// The harmonic part is the projection onto an explicit basis, not what is left over: that the three add up to u is
/// a check of all of them.
///
/// # Cost
/// Two sparse factorizations and one solve for each basis field to set up; two solves for each field to split.
///
/// # Source
/// `polthier_identifying_2003`, `wardetzky_discrete_2006`; definite systems instead of a saddle point for b are ours.
#[derive(Debug)]
pub struct HodgeSolver<'s> {
    surface: &'s Surface,
    splitting: Splitting,
    boundary: Boundary,
    vertices: SemidefiniteCholesky,
    edges: SemidefiniteCholesky,
    basis: HarmonicBasis,
    times: SetupTimes,
}

/// How long setting up took.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SetupTimes {
    /// Assembling and factoring both Laplacians, one after the other; with two threads they are done side by side.
    pub factor: Duration,
    /// Finding the harmonic fields.
    pub basis: Duration,
}

/// What a step gives, and how long it took.
fn timed<T>(step: impl FnOnce() -> Result<T, OperatorError>) -> Result<(T, Duration), OperatorError> {
    let start = Instant::now();
    Ok((step()?, start.elapsed()))
}

/// A divergence or curl.
type Adjoint = fn(&Surface, &[Vec2]) -> Result<Vec<f64>, OperatorError>;

struct Potentials {
    vertices: Vec<f64>,
    edges: Vec<f64>,
    harmonic_defect: f64,
}

/// A field split into three parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Decomposition {
    /// The gradient.
    pub gradient: FaceField,
    /// The rotated gradient.
    pub rotated: FaceField,
    /// The harmonic part.
    pub harmonic: FaceField,
    /// The potential at vertices: of the gradient in the primal splitting, of the rotated gradient in the dual. Its mean is
    /// zero on each component where no boundary condition fixes it.
    pub vertex_potential: Vec<f64>,
    /// The potential at midpoints of edges: of the rotated gradient in the primal splitting, of the gradient in the dual.
    pub edge_potential: Vec<f64>,
    /// The coefficients of the harmonic part in the basis of the solver.
    pub harmonic_coefficients: Vec<f64>,
    /// How well it was done.
    pub quality: Quality,
}

/// What was measured of a splitting: how far it can be trusted.
///
/// All zero for the zero field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quality {
    /// `‖u − sum of parts‖ / ‖u‖`.
    pub residual: f64,
    /// Inner products of the parts over `‖u‖²`; zero in exact arithmetic.
    pub inner_products: InnerProducts,
    /// Norms of the field and its parts.
    pub norms: Norms,
    /// No part is farther from the true one than this, over `‖u‖`.
    ///
    /// It is the residual plus how far the harmonic part is from the harmonic fields, which is measured by projecting it onto
    /// both other spaces. The residual is the sum of the errors of the parts; the first two lie in their spaces, the third does
    /// up to that distance, and the spaces are orthogonal, so no error is longer than both together. This is proven for
    /// exact arithmetic; evaluating it in doubles adds a few units of rounding.
    pub part_error: f64,
}

/// Inner products of the three parts, over the squared norm of the field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InnerProducts {
    /// Gradient and rotated gradient.
    pub gradient_rotated: f64,
    /// Gradient and harmonic part.
    pub gradient_harmonic: f64,
    /// Rotated gradient and harmonic part.
    pub rotated_harmonic: f64,
}

/// Norms of a field and its parts: roots of integrals of squared lengths.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Norms {
    /// The field.
    pub field: f64,
    /// The gradient.
    pub gradient: f64,
    /// The rotated gradient.
    pub rotated: f64,
    /// The harmonic part.
    pub harmonic: f64,
}

impl<'s> HodgeSolver<'s> {
    /// Assembles and factors both Laplacians and finds the harmonic fields.
    ///
    /// # Errors
    /// [`OperatorError::Solve`] if a Laplacian cannot be factored, which very thin faces can cause.
    pub fn new(
        surface: &'s Surface,
        splitting: Splitting,
        boundary: Boundary,
    ) -> Result<Self, OperatorError> {
        let fixed = Fixed::of(splitting, boundary);
        let (edges, vertices) = rayon::join(
            || timed(|| edge_system(surface, fixed == Fixed::Edges)),
            || {
                let (vertices, factor) = timed(|| vertex_system(surface, fixed == Fixed::Vertices))?;
                let (basis, time) = timed(|| HarmonicBasis::primal(surface, fixed, &vertices))?;
                Ok::<_, OperatorError>((vertices, factor, basis, time))
            },
        );
        let ((edges, of_edges), (vertices, of_vertices, primal_basis, of_basis)) = (edges?, vertices?);
        let times = SetupTimes { factor: of_edges + of_vertices, basis: of_basis };
        let basis = match splitting {
            Splitting::Primal => primal_basis,
            Splitting::Dual => primal_basis.turned(),
        };
        Ok(Self { surface, splitting, boundary, vertices, edges, basis, times })
    }

    /// The surface.
    pub fn surface(&self) -> &'s Surface {
        self.surface
    }

    /// Which splitting it is.
    pub fn splitting(&self) -> Splitting {
        self.splitting
    }

    /// Which boundary condition it is.
    pub fn boundary(&self) -> Boundary {
        self.boundary
    }

    /// How long setting up took.
    pub fn setup_times(&self) -> SetupTimes {
        self.times
    }

    /// The harmonic fields.
    pub fn basis(&self) -> &HarmonicBasis {
        &self.basis
    }

    /// Both potentials of the primal splitting of a field, and how far another field, harmonic but for rounding, is from the
    /// harmonic fields: the norms of its projections onto both ranges.
    fn potentials(&self, field: &[Vec2], harmonic: &[Vec2]) -> Result<Potentials, OperatorError> {
        let (mut of_vertices, mut of_edges) =
            (divergence(self.surface, field)?, edge_curl(self.surface, field)?);
        for value in &mut of_vertices {
            *value = -*value;
        }
        let mut defect_sq = 0.0;
        for (solver, values, of_harmonic) in [
            (&self.vertices, &mut of_vertices, divergence as Adjoint),
            (&self.edges, &mut of_edges, edge_curl as Adjoint),
        ] {
            if self.basis.dimension() > 0 {
                // ‖G x‖² is xᵀ L x, which is xᵀ b where L x = b.
                let b = of_harmonic(self.surface, harmonic)?;
                values.extend(&b);
                solver.solve_in_place(values)?;
                let x = values.split_off(b.len());
                defect_sq += x.iter().zip(&b).map(|(x, b)| x * b).sum::<f64>().abs();
            } else {
                solver.solve_in_place(values)?;
            }
        }
        Ok(Potentials { vertices: of_vertices, edges: of_edges, harmonic_defect: defect_sq.sqrt() })
    }

    /// Splits a field.
    ///
    /// # Errors
    /// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`]; [`OperatorError::Solve`] when values overflow.
    pub fn decompose(&self, field: &[Vec2]) -> Result<Decomposition, OperatorError> {
        check_field(self.surface.mesh(), field)?;
        let harmonic_coefficients = self.basis.coefficients(self.surface, field)?;
        let harmonic = self.basis.combination(field.len(), &harmonic_coefficients);
        let turned_back = |u: &[Vec2]| -> FaceField { u.iter().map(|&[x, y]| [y, -x]).collect() };
        let mut potentials = match self.splitting {
            Splitting::Primal => self.potentials(field, &harmonic)?,
            Splitting::Dual => self.potentials(&turned_back(field), &turned_back(&harmonic))?,
        };
        let conforming = gradient(self.surface, &potentials.vertices)?;
        let (gradient, rotated) = match self.splitting {
            Splitting::Primal => (conforming, rotated(&edge_gradient(self.surface, &potentials.edges)?)),
            Splitting::Dual => {
                // −J u = G_v a + J G_e b + h, so u = J G_v a − G_e b + J h.
                for value in &mut potentials.edges {
                    *value = -*value;
                }
                (edge_gradient(self.surface, &potentials.edges)?, rotated(&conforming))
            }
        };
        let quality = self.quality(field, [&gradient, &rotated, &harmonic], potentials.harmonic_defect);
        Ok(Decomposition {
            gradient,
            rotated,
            harmonic,
            vertex_potential: potentials.vertices,
            edge_potential: potentials.edges,
            harmonic_coefficients,
            quality,
        })
    }

    /// Splits many fields, in parallel; each as [`decompose`](Self::decompose) would.
    ///
    /// # Errors
    /// Those of [`decompose`](Self::decompose), for the first field in order that has one.
    pub fn decompose_many(&self, fields: &[FaceField]) -> Result<Vec<Decomposition>, OperatorError> {
        let parts: Vec<_> = fields.par_iter().map(|field| self.decompose(field)).collect();
        parts.into_iter().collect()
    }

    fn quality(&self, field: &[Vec2], parts: [&FaceField; 3], harmonic_defect: f64) -> Quality {
        let surface = self.surface;
        let [gradient, rotated, harmonic] = parts;
        let mut rest = difference(field, gradient);
        add_scaled(&mut rest, -1.0, rotated);
        add_scaled(&mut rest, -1.0, harmonic);
        let norms = Norms {
            field: field_norm(surface, field),
            gradient: field_norm(surface, gradient),
            rotated: field_norm(surface, rotated),
            harmonic: field_norm(surface, harmonic),
        };
        let over = |value: f64, by: f64| if by > 0.0 { value / by } else { 0.0 };
        let inner =
            |u: &[Vec2], w: &[Vec2]| over(over(field_inner_product(surface, u, w), norms.field), norms.field);
        let residual = over(field_norm(surface, &rest), norms.field);
        Quality {
            residual,
            inner_products: InnerProducts {
                gradient_rotated: inner(gradient, rotated),
                gradient_harmonic: inner(gradient, harmonic),
                rotated_harmonic: inner(rotated, harmonic),
            },
            norms,
            part_error: residual + over(harmonic_defect, norms.field),
        }
    }
}
