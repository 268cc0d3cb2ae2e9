//! What is said of a neuron.

use crate::{
    FlowReport, MeshReport, Problem, Repair, Skeleton, SkeletonDeviation, SplineReport, TransportReport,
    problems,
};

/// What is said of a skeleton.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SkeletonReport {
    /// Number of samples.
    pub samples: usize,
    /// Number of branches: paths between roots, furcations and tips.
    pub branches: usize,
    /// Number of samples that no other continues.
    pub tips: usize,
    /// What deserves attention before it is meshed.
    pub problems: Vec<Problem>,
    /// What a repair did, a sentence each; left out where none was asked for.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub repairs: Option<Vec<String>>,
    /// How far smoothing and resampling moved it; left out where neither was asked for.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub deviation: Option<SkeletonDeviation>,
}

impl SkeletonReport {
    /// Looks at a skeleton.
    pub fn new(
        skeleton: &Skeleton,
        repairs: Option<&[Repair]>,
        deviation: Option<SkeletonDeviation>,
    ) -> Self {
        Self {
            samples: skeleton.samples().len(),
            branches: skeleton.branches().len(),
            tips: skeleton.tips().count(),
            problems: problems(skeleton),
            repairs: repairs.map(|repairs| repairs.iter().map(ToString::to_string).collect()),
            deviation,
        }
    }
}

/// What is said of a neuron: one entry for each stage that ran.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NeuronReport {
    /// The skeleton; left out where a mesh was given.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub skeleton: Option<SkeletonReport>,
    /// The mesh.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub mesh: Option<MeshReport>,
    /// Splines over the mesh.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub spline: Option<SplineReport>,
    /// The flow.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub flow: Option<FlowReport>,
    /// The transport.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub transport: Option<TransportReport>,
    /// Time spent on each stage that ran, by the clock.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

/// Milliseconds spent on each stage that ran.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Timing {
    /// Reading and looking at the skeleton or mesh.
    pub skeleton: f64,
    /// Meshing.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub mesh: Option<f64>,
    /// Splines.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub spline: Option<f64>,
    /// Flow.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub flow: Option<f64>,
    /// Transport.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub transport: Option<f64>,
    /// From the file to the report.
    pub total: f64,
}
