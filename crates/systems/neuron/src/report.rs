//! Reports on a neuron.

use crate::{
    FlowReport, MeshReport, Problem, Repair, Skeleton, SkeletonDeviation, SplineReport, TransportReport,
    problems,
};
use pompeiu_core::run::StopReason;

/// The report of a skeleton.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SkeletonReport {
    /// Number of samples.
    pub samples: usize,
    /// Number of branches: paths between roots, furcations and tips.
    pub branches: usize,
    /// Number of samples without children.
    pub tips: usize,
    /// Defects that deserve attention before it is meshed.
    pub problems: Vec<Problem>,
    /// The repairs, one sentence each; omitted if none were requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub repairs: Option<Vec<String>>,
    /// The deviation due to smoothing and resampling; omitted if neither was requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub deviation: Option<SkeletonDeviation>,
}

impl SkeletonReport {
    /// The report of a skeleton.
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

/// The report of a neuron: one entry for each stage that ran.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct NeuronReport {
    /// The skeleton; omitted if a mesh was given.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub skeleton: Option<SkeletonReport>,
    /// The mesh.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub mesh: Option<MeshReport>,
    /// Of the stage check: whether every cell of a mesh is proven valid and its wall proven to be as near to the cones as is tolerated; omitted if
    /// that is not decided.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub meshable: Option<bool>,
    /// Splines over the mesh.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub spline: Option<SplineReport>,
    /// The flow.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub flow: Option<FlowReport>,
    /// The transport.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub transport: Option<TransportReport>,
    /// Whether the splines over the mesh agree with those in files; omitted unless they were compared.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub agrees: Option<bool>,
    /// The work that a limit ended, in one sentence; omitted if none was.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub ended: Option<String>,
    /// The reason for which the computation ended.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub stop: StopReason,
    /// Whether only the skeleton was to be checked: then problems refute that it can be meshed.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub is_check: bool,
    /// Wall-clock time of each stage that ran.
    #[cfg_attr(feature = "serde", serde(rename = "timing_ms"))]
    pub timing: Timing,
}

impl Default for NeuronReport {
    fn default() -> Self {
        Self {
            skeleton: None,
            mesh: None,
            meshable: None,
            spline: None,
            flow: None,
            transport: None,
            agrees: None,
            ended: None,
            stop: StopReason::Tolerance,
            is_check: false,
            timing: Timing::default(),
        }
    }
}

/// Wall-clock time of each stage that ran, in milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Timing {
    /// Reading and checking the skeleton or mesh.
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
    /// The whole run.
    pub total: f64,
}
