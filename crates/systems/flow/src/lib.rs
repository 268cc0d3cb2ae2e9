//! Remeshing of triangle surfaces, with a proven distance from the input.
//!
//! | item | what it is |
//! |---|---|
//! | [`remesh::simplify`] | few faces within a distance that is proven |
//! | [`remesh::remesh`] | nearly equilateral faces of a wanted size |
//! | [`remesh::DynamicMesh`] | halfedge connectivity that can be edited |

pub mod remesh;
