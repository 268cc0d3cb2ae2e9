//! Factored diffusion of velocities and densities.

use crate::curvature::CurvatureLimit;
use crate::edges::{EdgeViscosity, Terms};
use crate::faces::FaceDiffusion;
use crate::space::Space;
use crate::viscosity::{Viscosity, ViscousPower};
use crate::{Diffusion, FluidError, FluidOptions, Scheme};
use pompeiu_core::mesh::VertexData;
use pompeiu_solve::Cholesky;

/// The factored diffusion operator of a density, for one product of diffusivity and time.
#[derive(Debug)]
pub(super) enum Heat {
    Vertices { product: f64, factor: Cholesky },
    Faces(FaceDiffusion),
}

impl Heat {
    pub(super) fn product(&self) -> f64 {
        match self {
            Self::Vertices { product, .. } => *product,
            Self::Faces(diffusion) => diffusion.product(),
        }
    }
}

/// What the viscous operator is made of, which does not depend on the step.
#[derive(Debug)]
pub(super) enum Power {
    /// For the stream function and harmonic coefficients.
    Stream(Box<ViscousPower>),
    /// For values at midpoints of edges.
    Edges(Terms),
    /// For values on faces, or without viscosity.
    Faces,
}

impl Power {
    pub(super) fn new(
        space: &Space<'_>,
        options: &FluidOptions,
        circulation: &VertexData<f64>,
    ) -> Result<Self, FluidError> {
        let (model, wall) = (options.viscosity_model, options.wall);
        Ok(match options.scheme {
            _ if options.viscosity == 0.0 => Self::Faces,
            Scheme::CrouzeixRaviart => Self::Edges(Terms::new(space, model, wall)?),
            Scheme::Faces if options.diffusion == Diffusion::EdgeLength => Self::Faces,
            _ => Self::Stream(Box::new(ViscousPower::new(space, model, wall, circulation)?)),
        })
    }

    /// The curvature that it contains.
    pub(super) fn limit(&self) -> CurvatureLimit {
        match self {
            Self::Stream(power) => power.limit(),
            Self::Edges(terms) => terms.limit(),
            Self::Faces => CurvatureLimit::NONE,
        }
    }
}

/// The factored viscous operator, for one product of viscosity and time.
#[derive(Debug)]
pub(super) enum Viscous {
    /// Acts on the stream function and harmonic coefficients.
    Stream(Viscosity),
    /// Acts on values at midpoints of edges.
    Edges(EdgeViscosity),
    /// Acts on values on faces.
    Faces(FaceDiffusion),
}

impl Viscous {
    pub(super) fn product(&self) -> f64 {
        match self {
            Self::Stream(viscosity) => viscosity.product(),
            Self::Edges(viscosity) => viscosity.product(),
            Self::Faces(viscosity) => viscosity.product(),
        }
    }
}
