//! Changing the triangles of a surface.

mod connectivity;
mod cover;
mod edit;
mod options;
mod quadric;
mod simplify;
mod within;

pub use connectivity::{ConnectivityError, DynamicMesh};
pub use edit::Illegal;
pub use options::{Simplified, SimplifyError, SimplifyOptions, SimplifyTarget, SimplifyTiming};
pub use simplify::simplify;
