//! Reports on splines over a tricubic mesh.

use pompeiu_volume::{BezierMesh, HierarchicalSplines, SplineSpace};

/// The report of the cubic splines over a tricubic mesh: twice continuously differentiable in each patch, continuous across
/// patches.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SplineReport {
    /// Number of functions.
    pub functions: usize,
    /// The greatest deviation of their sum from one.
    pub partition_of_unity_error: f64,
    /// Each level of refinement, coarsest first; omitted without refinement.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<LevelReport>>"))]
    pub levels: Vec<LevelReport>,
}

/// The report of one level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LevelReport {
    /// Elements that are not refined further.
    pub elements: usize,
    /// Active functions.
    pub functions: usize,
}

impl SplineReport {
    /// The report of splines with this many elements along each edge of each patch.
    pub fn new(mesh: &BezierMesh, elements: usize) -> Self {
        let space = SplineSpace::new(mesh, elements);
        let off = space.partition_of_unity_error();
        Self { functions: space.functions(), partition_of_unity_error: off, levels: Vec::new() }
    }

    /// The report of refined splines.
    pub fn of_refined(splines: &HierarchicalSplines) -> Self {
        let counts = splines.elements_of_levels().into_iter().zip(splines.functions_of_levels());
        Self {
            functions: splines.functions(),
            partition_of_unity_error: splines.partition_of_unity_error(),
            levels: counts.map(|(elements, &functions)| LevelReport { elements, functions }).collect(),
        }
    }
}
