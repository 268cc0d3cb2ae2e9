//! Remeshing, and simplification with a proven distance from the input.
//!
//! | item | what it is |
//! |---|---|
//! | [`simplify()`] | few faces within a distance that is proven |
//! | [`remesh()`] | nearly equilateral faces of a wanted size |
//! | [`DynamicMesh`] | halfedge connectivity that can be edited |
//! | [`Carrier`] | texture coordinates and colours on the result |

mod anchors;
mod angles;
mod batch;
mod candidates;
mod carried;
mod collapses;
mod confined;
mod connectivity;
mod cover;
mod crossing;
mod curvature;
mod edit;
mod face_tree;
mod features;
mod fit;
mod flips;
mod folds;
mod guard;
mod held;
mod improve;
mod isotropic;
mod least_faces;
mod lengths;
mod local;
mod marked;
mod near;
mod places;
mod quadric;
mod quality;
mod queue;
mod reference;
mod remesh_options;
mod request;
mod run;
mod samples;
mod schedule;
#[cfg(feature = "figures")]
pub mod show;
mod simplify;
mod simplify_options;
mod simplify_run;
mod sizing;
mod smooth;
mod splits;
mod star;
mod trial;
mod triangle;
mod untangle;
mod within;

pub use carried::{Carrier, CarryError, CornerValues};
pub use connectivity::{ConnectivityError, DynamicMesh};
pub use edit::Illegal;
pub use features::{FeatureError, Features};
pub use guard::{IntersectionCount, Intersections, Intersects};
pub use lengths::{LengthError, NotWithin};
pub use quality::{Quality, Range, angles};
pub use remesh_options::{RemeshError, RemeshOptions, RemeshTiming, Remeshed};
pub use request::{
    Kept, LevelReport, RemeshAnswer, RemeshReport, RemeshRequest, SimplifyAnswer, SimplifyReport,
    SimplifyRequest,
};
pub use run::remesh;
pub use simplify::{simplify, simplify_levels};
pub use simplify_options::{
    Effort, Refusals, Simplified, SimplifyError, SimplifyOptions, SimplifyTarget, SimplifyTiming,
};
pub use sizing::{LengthField, Sizing};
