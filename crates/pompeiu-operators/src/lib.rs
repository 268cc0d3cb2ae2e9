//! Discrete differential operators on triangle surfaces, and what is solved with them.
//!
//! Functions are linear on each face and agree at vertices (conforming, Lagrange), or at the midpoints of edges only
//! (nonconforming, Crouzeix–Raviart); tangent fields are constant on each face. With `M` the areas of faces, `J` the quarter
//! turn in every face, `G_v` and `G_e` the gradients of the two kinds of functions, any field splits into three parts that
//! are orthogonal to each other,
//!
//! ```text
//! u = G_v a + J G_e b + h,
//! ```
//!
//! a gradient, a rotated gradient, and a harmonic field. See [`HodgeSolver`], and [`Audit`] for why one kind of function is
//! not enough.
//!
//! ```
//! use pompeiu_core::mesh::shapes::torus;
//! use pompeiu_operators::{Boundary, HodgeSolver, Splitting};
//! use pompeiu_surface::EmbeddedSurface;
//!
//! let torus = EmbeddedSurface::new(&torus(2.0, 0.7, 24, 16)?)?;
//! let solver = HodgeSolver::new(torus.surface(), Splitting::Primal, Boundary::Tangential)?;
//! assert_eq!(solver.basis().dimension(), 2);
//!
//! // Rotation about the axis of the torus: no divergence, but it winds around the hole.
//! let mesh = torus.mesh();
//! let field: Vec<_> = mesh.face_ids().map(|face| torus.to_tangent(face, [0.0, 0.0, 1.0])).collect();
//! let parts = solver.decompose(&field)?;
//! assert!(parts.quality.residual < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod field;
mod gradient;
mod heat;
pub mod hodge;
mod laplacian;
mod mass;
mod sources;

pub use error::OperatorError;
pub use field::{FaceField, check_field, field_inner_product, field_norm, rotated};
pub use gradient::{
    divergence, edge_curl, edge_divergence, edge_gradient, edge_gradient_matrix, gradient, gradient_matrix,
    vertex_curl,
};
pub use heat::HeatMethod;
pub use hodge::{Audit, Boundary, Decomposition, HarmonicBasis, HodgeSolver, Splitting};
pub use laplacian::{cotan_laplacian, edge_laplacian};
pub use mass::{face_mass, mass_matrix};
pub use sources::{random_field, rotation_field, tangent_field};
