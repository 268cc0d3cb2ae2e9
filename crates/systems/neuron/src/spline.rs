//! What is said of splines over a mesh.

use pompeiu_volume::{BezierMesh, SplineSpace};

/// What is said of the cubic splines over a tricubic mesh: twice continuously differentiable in each patch, continuous across patches.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SplineReport {
    /// Number of functions.
    pub functions: usize,
    /// The greatest difference of their sum from one.
    pub partition_of_unity_error: f64,
}

impl SplineReport {
    /// Counts the splines with this many elements along each edge of each patch, and adds them up.
    pub fn new(mesh: &BezierMesh, elements: usize) -> Self {
        let space = SplineSpace::new(mesh, elements);
        Self { functions: space.functions(), partition_of_unity_error: space.partition_of_unity_error() }
    }
}
