//! Flow of triangle surfaces to least area, and remeshing with a proven distance from the input.
//!
//! | item | what it is |
//! |---|---|
//! | [`mean_curvature_flow`] | flow in time, and to minimal surfaces |
//! | [`remesh::simplify`] | few faces within a distance that is proven |
//! | [`remesh::remesh`] | nearly equilateral faces of a wanted size |
//! | [`remesh::DynamicMesh`] | halfedge connectivity that can be edited |

mod mean_curvature;
pub mod remesh;
#[cfg(feature = "figures")]
pub mod show;

pub use mean_curvature::*;
