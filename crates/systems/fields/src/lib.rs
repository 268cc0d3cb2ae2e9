//! Helmholtz–Hodge decomposition of tangent fields that are constant on each face.
//!
//! # Definition
//! With `M` the areas of faces, `J` the quarter turn in every face, `G_v` and `G_e` the gradients of conforming functions
//! (linear on faces, continuous) and nonconforming ones (Crouzeix–Raviart: linear on faces, continuous at midpoints of edges),
//! any field splits into three parts that are orthogonal to each other,
//!
//! ```text
//! u = G_v a + J G_e b + h,
//! ```
//!
//! a gradient, a rotated gradient, and a harmonic field.
//!
//! | item | what it is |
//! |---|---|
//! | [`DecompositionOptions`] | which decomposition |
//! | [`HodgeSolver`] | a surface factored once, to decompose many fields |
//! | [`Decomposition`], [`Quality`] | the three parts and potentials, and a bound on the error of each part |
//! | [`DecomposeRequest`] | what the command and Python ask: a field by its name, split once |
//! | [`DegreesOfFreedom`] | the dimensions of the spaces: why a single function space is not enough |
//! | [`SingleSpaceSolver`] | the decomposition with a single function space, to show how it fails |
#![cfg_attr(feature = "figures", doc = "| [`show`] | pages and pictures of a decomposition |")]
//!
//! ```
//! use pompeiu_core::mesh::shapes::torus;
//! use pompeiu_fields::{DecompositionOptions, HodgeSolver};
//! use pompeiu_operators::FaceField;
//! use pompeiu_surface::EmbeddedSurface;
//!
//! let torus = EmbeddedSurface::new(&torus(2.0, 0.7, 24, 16)?)?;
//! let solver = HodgeSolver::new(torus.surface(), &DecompositionOptions::default())?;
//! assert_eq!(solver.basis().dimension(), 2);
//!
//! // Rotation about the axis of the torus: no divergence, but it winds around the hole.
//! let mesh = torus.mesh();
//! let field = FaceField::from_fn(mesh.faces(), |face| torus.to_tangent(face, [0.0, 0.0, 1.0]));
//! let parts = solver.decompose(&field)?;
//! assert!(parts.quality.residual < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#[cfg(feature = "serde")]
mod data;
mod decomposition;
mod degrees_of_freedom;
mod options;
mod request;
mod scale;
#[cfg(feature = "figures")]
pub mod show;
mod single_space;

pub use decomposition::{Decomposition, HodgeSolver, InnerProducts, Norms, Quality, SetupTimes};
pub use degrees_of_freedom::{DegreesOfFreedom, Ranks};
pub use options::DecompositionOptions;
pub use pompeiu_operators::{Boundary, HarmonicBasis, OperatorError, Splitting};
pub use request::{
    DecomposeAnswer, DecomposeError, DecomposeReport, DecomposeRequest, DecompositionReport,
    DecompositionTiming,
};
pub use single_space::{FunctionSpace, SingleSpaceParts, SingleSpaceSolver};
