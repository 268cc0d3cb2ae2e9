//! Changing the triangles of a surface.

mod connectivity;
mod cover;
mod curvature;
mod edit;
mod features;
mod flips;
mod improve;
mod isotropic;
mod marked;
mod near;
mod options;
mod quadric;
mod quality;
mod reference;
mod request;
mod run;
mod simplify;
mod sizing;
mod smooth;
mod within;

pub(crate) use connectivity::NONE;
pub use connectivity::{ConnectivityError, DynamicMesh};
pub use edit::Illegal;
pub use features::Features;
pub use options::{Simplified, SimplifyError, SimplifyOptions, SimplifyTarget, SimplifyTiming};
pub(crate) use quality::angles;
pub use quality::{Quality, Range};
pub use request::{RemeshError, RemeshOptions, RemeshTiming, Remeshed};
pub use run::remesh;
pub use simplify::{simplify, simplify_levels};
pub use sizing::{LengthField, Sizing};
