//! Helmholtz–Hodge decomposition of many fields with one factorization.

use crate::DecompositionOptions;
use crate::scale::{normalized, restore, times_power_of_two};
use pompeiu_core::mesh::{ElementData, VertexData};
use pompeiu_core::run::Instant;
use pompeiu_operators::hodge::{DirichletPotential, conforming_system, crouzeix_raviart_system};
use pompeiu_operators::{
    Boundary, FaceField, HarmonicBasis, OperatorError, Splitting, add_scaled, check_field,
    crouzeix_raviart_curl, crouzeix_raviart_gradient, difference, divergence, field_inner_product,
    field_norm, gradient, rotated,
};
use pompeiu_solve::{LinearSolver, SemidefiniteCholesky};
use pompeiu_surface::{EdgeData, Surface};
use rayon::prelude::*;
use std::time::Duration;

/// The Helmholtz–Hodge decomposition of fields on one surface, factored once.
///
/// # Definition
/// In the primal splitting `u = G_v a + J G_e b + h`, where a is continuous and b is continuous at midpoints of edges. The first
/// two ranges are orthogonal: the integral of `∇a · J∇b` over a face is a sum of differences of a along its sides, which the two
/// faces at an edge count with opposite signs. So the parts are the orthogonal projections of u, and each potential solves a
/// positive semi-definite system of its own:
///
/// ```text
/// G_vᵀ M G_v a = G_vᵀ M u        G_eᵀ M G_e b = (J G_e)ᵀ M u
/// ```
///
/// The harmonic part is the projection onto an explicit basis, not the remainder. That the three parts add up to u is therefore a
/// check of all of them.
///
/// # Cost
/// Two sparse factorizations and one solve per basis field to prepare; two solves per decomposed field.
///
/// # Source
/// `polthier_identifying_2003`, `wardetzky_discrete_2006`; definite systems instead of a saddle point for b are ours.
#[derive(Debug)]
pub struct HodgeSolver<'s> {
    surface: &'s Surface,
    options: DecompositionOptions,
    vertices: SemidefiniteCholesky,
    edges: SemidefiniteCholesky,
    basis: HarmonicBasis,
    times: SetupTimes,
}

/// Wall-clock times of the preparation; the two add up to its total.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SetupTimes {
    /// Until both Laplacians were assembled and factored, in parallel.
    pub factor: Duration,
    /// From then until the harmonic fields were found. With two threads these are started while the second Laplacian is factored.
    pub basis: Duration,
}

struct Potentials {
    vertices: VertexData<f64>,
    edges: EdgeData<f64>,
    harmonic_defect: f64,
}

/// The three parts of a field.
#[derive(Clone, Debug, PartialEq)]
pub struct Decomposition {
    /// The gradient.
    pub gradient: FaceField,
    /// The rotated gradient.
    pub rotated: FaceField,
    /// The harmonic part.
    pub harmonic: FaceField,
    /// The potential at vertices: of the gradient in the primal splitting, of the rotated gradient in the dual. It has mean zero on
    /// each component where no boundary condition fixes it.
    pub vertex_potential: VertexData<f64>,
    /// The potential at midpoints of edges: of the rotated gradient in the primal splitting, of the gradient in the dual.
    pub edge_potential: EdgeData<f64>,
    /// The coefficients of the harmonic part in the basis of the solver.
    pub harmonic_coefficients: Vec<f64>,
    /// Measured errors.
    pub quality: Quality,
}

/// Measured errors of a decomposition. All are zero for the zero field.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Quality {
    /// `‖u − sum of parts‖ / ‖u‖`.
    pub residual: f64,
    /// Bound on the distance of each part from the true one, relative to `‖u‖`.
    ///
    /// It is the residual plus the distance of the harmonic part from the harmonic fields, which is measured by projecting it onto
    /// both other spaces. The residual is the sum of the errors of the parts. The first two parts lie in their spaces, the third
    /// lies in its space up to that distance, and the spaces are orthogonal, so no error exceeds the sum. This is proven for exact
    /// arithmetic; evaluating it in doubles adds a few rounding errors. Fields are first scaled by a power of two; the loss of
    /// components below the range of normal doubles is included.
    pub part_error: f64,
    /// Inner products of the parts over `‖u‖²`; zero in exact arithmetic.
    pub inner_products: InnerProducts,
    /// Norms of the field and its parts.
    pub norms: Norms,
}

/// Inner products of the three parts, over the squared norm of the field.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
    /// Assembles and factors both Laplacians and computes the harmonic fields.
    ///
    /// # Errors
    /// [`OperatorError::Solve`] if a Laplacian cannot be factored.
    pub fn new(surface: &'s Surface, options: &DecompositionOptions) -> Result<Self, OperatorError> {
        let start = Instant::now();
        let dirichlet = DirichletPotential::of(options.splitting, options.boundary);
        let (edges, vertices) = rayon::join(
            || {
                let fixed = dirichlet == DirichletPotential::CrouzeixRaviart;
                let edges = crouzeix_raviart_system(surface, fixed)?;
                Ok::<_, OperatorError>((edges, start.elapsed()))
            },
            || {
                let vertices = conforming_system(surface, dirichlet == DirichletPotential::Conforming)?;
                let factored = start.elapsed();
                let basis = HarmonicBasis::primal(surface, dirichlet, &vertices)?;
                Ok::<_, OperatorError>((vertices, factored, basis))
            },
        );
        let ((edges, edges_factored), (vertices, vertices_factored, primal)) = (edges?, vertices?);
        let factor = edges_factored.max(vertices_factored);
        let basis = match options.splitting {
            Splitting::Primal => primal,
            Splitting::Dual => primal.turned(),
        };
        let times = SetupTimes { factor, basis: start.elapsed().saturating_sub(factor) };
        Ok(Self { surface, options: *options, vertices, edges, basis, times })
    }

    /// The surface.
    pub fn surface(&self) -> &'s Surface {
        self.surface
    }

    /// The splitting.
    pub fn splitting(&self) -> Splitting {
        self.options.splitting
    }

    /// The boundary condition.
    pub fn boundary(&self) -> Boundary {
        self.options.boundary
    }

    /// The wall-clock times of the preparation.
    pub fn setup_times(&self) -> SetupTimes {
        self.times
    }

    /// The harmonic fields.
    pub fn basis(&self) -> &HarmonicBasis {
        &self.basis
    }

    /// Both potentials of the primal splitting of a field; and the distance of another field, harmonic up to rounding, from the
    /// harmonic fields, as the norms of its projections onto both ranges.
    fn potentials(&self, field: &FaceField, harmonic: &FaceField) -> Result<Potentials, OperatorError> {
        let surface = self.surface;
        let (mut vertices, mut edges) = (divergence(surface, field)?, crouzeix_raviart_curl(surface, field)?);
        for value in &mut vertices {
            *value = -*value;
        }
        let mut defect_sq = 0.0;
        if self.basis.dimension() > 0 {
            defect_sq += solve_with(&self.vertices, &mut vertices, &divergence(surface, harmonic)?)?;
            defect_sq += solve_with(&self.edges, &mut edges, &crouzeix_raviart_curl(surface, harmonic)?)?;
        } else {
            self.vertices.solve_in_place(&mut vertices)?;
            self.edges.solve_in_place(&mut edges)?;
        }
        Ok(Potentials { vertices, edges, harmonic_defect: defect_sq.sqrt() })
    }

    /// Decomposes a field.
    ///
    /// # Errors
    /// [`OperatorError::FieldLength`], [`OperatorError::NonFiniteField`]; [`OperatorError::FieldTooLarge`] if a result
    /// exceeds the range of doubles; [`OperatorError::Solve`].
    pub fn decompose(&self, field: &FaceField) -> Result<Decomposition, OperatorError> {
        check_field(self.surface.mesh(), field)?;
        let (near_one, exponent) = normalized(field);
        let mut parts = self.decompose_near_one(&near_one)?;
        let norms = parts.quality.norms;
        if norms.field > 0.0 {
            // In the subnormal range each component errs by at most the least positive double.
            const LEAST: f64 = f64::from_bits(1);
            let absolute = LEAST + times_power_of_two(LEAST, -exponent);
            parts.quality.part_error += (2.0 * self.surface.area()).sqrt() / norms.field * absolute;
        }
        let mut norms = [norms.field, norms.gradient, norms.rotated, norms.harmonic];
        for values in [
            parts.gradient.as_flattened_mut(),
            parts.rotated.as_flattened_mut(),
            parts.harmonic.as_flattened_mut(),
            &mut parts.vertex_potential,
            &mut parts.edge_potential,
            &mut parts.harmonic_coefficients,
            &mut norms,
        ] {
            restore(values, exponent, field)?;
        }
        let [field, gradient, rotated, harmonic] = norms;
        parts.quality.norms = Norms { field, gradient, rotated, harmonic };
        Ok(parts)
    }

    /// Decomposes a field whose components are of moderate magnitude.
    fn decompose_near_one(&self, field: &FaceField) -> Result<Decomposition, OperatorError> {
        let harmonic_coefficients = self.basis.coefficients(self.surface, field)?;
        let harmonic = self.basis.combination(field.len(), &harmonic_coefficients);
        let turned_back = |u: &FaceField| u.map(|&[x, y]| [y, -x]);
        let mut potentials = match self.options.splitting {
            Splitting::Primal => self.potentials(field, &harmonic)?,
            Splitting::Dual => self.potentials(&turned_back(field), &turned_back(&harmonic))?,
        };
        let conforming = gradient(self.surface, &potentials.vertices)?;
        let (gradient, rotated) = match self.options.splitting {
            Splitting::Primal => {
                (conforming, rotated(&crouzeix_raviart_gradient(self.surface, &potentials.edges)?))
            }
            Splitting::Dual => {
                // −J u = G_v a + J G_e b + h, so u = J G_v a − G_e b + J h.
                for value in &mut potentials.edges {
                    *value = -*value;
                }
                (crouzeix_raviart_gradient(self.surface, &potentials.edges)?, rotated(&conforming))
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

    /// Decomposes many fields, in parallel; each as [`decompose`](Self::decompose) would.
    ///
    /// # Errors
    /// Those of [`decompose`](Self::decompose), for the first field that has one.
    pub fn decompose_many(&self, fields: &[FaceField]) -> Result<Vec<Decomposition>, OperatorError> {
        let parts: Vec<_> = fields.par_iter().map(|field| self.decompose(field)).collect();
        parts.into_iter().collect()
    }

    fn quality(&self, field: &FaceField, parts: [&FaceField; 3], harmonic_defect: f64) -> Quality {
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
        let inner = |u: &FaceField, w: &FaceField| {
            over(over(field_inner_product(surface, u, w), norms.field), norms.field)
        };
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

/// Solves for two right-hand sides at once, the first in place; returns `xᵀ b` for the second, where `L x = b`.
///
/// That is `xᵀ L x`, the squared norm of the gradient of x.
fn solve_with<I>(
    solver: &SemidefiniteCholesky,
    first: &mut ElementData<I, f64>,
    b: &ElementData<I, f64>,
) -> Result<f64, OperatorError> {
    let mut both = [first.as_slice(), b.as_slice()].concat();
    solver.solve_in_place(&mut both)?;
    let (solution, x) = both.split_at(b.len());
    first.copy_from_slice(solution);
    Ok(x.iter().zip(b).map(|(x, b)| x * b).sum::<f64>().abs())
}
