//! Discrete differential operators on triangle surfaces.
//!
//! Functions are linear on each face and continuous at vertices (conforming, Lagrange), or at the midpoints of edges only
//! (nonconforming, Crouzeix–Raviart); tangent fields are constant on each face.
//!
//! | item | content |
//! |---|---|
//! | gradients | [`gradient`], [`crouzeix_raviart_gradient`], and their adjoints [`divergence`], [`crouzeix_raviart_divergence`], [`curl`], [`crouzeix_raviart_curl`] |
//! | Laplacians and masses | [`cotan_laplacian`], [`crouzeix_raviart_laplacian`], [`mass_matrix`], [`face_mass`] |
//! | fields | [`FaceField`], [`field_inner_product`], [`rotation_field`], [`tangent_field`], [`random_field`], [`FieldSource`]: fields by their names, [`vertex_values`] |
//! | [`hodge`] | potentials with boundary conditions, and harmonic fields |
//! | [`HeatMethod`] | distances along the surface |

mod error;
mod expression;
mod field;
mod field_source;
mod gradient;
mod heat;
pub mod hodge;
mod laplacian;
mod mass;
mod sources;

pub use error::OperatorError;
pub use expression::{ExpressionError, vertex_values};
pub use field::{FaceField, add_scaled, check_field, difference, field_inner_product, field_norm, rotated};
pub use field_source::{FieldSource, FieldSourceError, SourcedField};
pub use gradient::{
    crouzeix_raviart_curl, crouzeix_raviart_divergence, crouzeix_raviart_gradient,
    crouzeix_raviart_gradient_matrix, curl, divergence, gradient, gradient_matrix,
};
pub use heat::{HeatMethod, HeatOptions};
pub use hodge::{Boundary, HarmonicBasis, Splitting};
pub use laplacian::{cotan_laplacian, crouzeix_raviart_laplacian};
pub use mass::{face_mass, mass_matrix};
pub use sources::{random_field, rotation_field, tangent_field};
