//! Options, report and errors of meshing.

use super::linear::LinearShares;
use crate::Skeleton;
use pompeiu_core::run::{Control, Limits, ProgressObserver, StopReason};
use pompeiu_volume::VolumeError;
use std::fmt;

/// Options of meshing.
#[derive(Clone)]
pub struct MeshOptions<'o> {
    /// Parts of each block along each edge, 1 to 8: a section has five times its square cells.
    pub parts: usize,
    /// Length of a block along a branch, in radii, 0.25 to 20.
    pub layer: f64,
    /// Whether to enclose the distance of the wall from the cones.
    pub measure: bool,
    /// Tolerated distance of the wall from the cones, both ways, in radii, above 0. It changes the mesh only at nodes where that would be farther.
    pub within: f64,
    /// The skeleton whose cones the wall is compared with, if it is not the one that is meshed: that of the file, before smoothing.
    pub reference: Option<&'o Skeleton>,
    /// Limits on time and memory.
    pub limits: Limits,
    /// Receives the number of finished nodes.
    pub progress: Option<&'o dyn ProgressObserver>,
}

impl Default for MeshOptions<'_> {
    fn default() -> Self {
        Self {
            parts: 2,
            layer: 2.0,
            measure: true,
            within: WITHIN,
            reference: None,
            limits: Limits::default(),
            progress: None,
        }
    }
}

impl MeshOptions<'_> {
    pub(super) fn check(&self) -> Result<(), MeshError> {
        let wrong = |what, value, expected| Err(MeshError::Option { what, value, expected });
        if !(1..=8).contains(&self.parts) {
            return wrong("number of parts of a block", self.parts as f64, "1 to 8");
        }
        if !(0.25..=20.0).contains(&self.layer) {
            return wrong("length of a block in radii", self.layer, "0.25 to 20");
        }
        if !(self.within > 0.0 && self.within.is_finite()) {
            return wrong("tolerated distance in radii", self.within, "a finite number above 0");
        }
        Ok(())
    }
}

/// Distance of the wall from the cones that is tolerated by default, in radii.
const WITHIN: f64 = 0.2;

/// The report of a mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MeshReport {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of cells.
    pub hexahedra: usize,
    /// A lower bound on the scaled Jacobian over every whole cell, proven, rounding included; within 0.001 of the least value unless a cell is nearly folded.
    pub min_scaled_jacobian: f64,
    /// Whether the Jacobian determinant is proven positive over every cell.
    pub certified: bool,
    /// Cells over which the Jacobian determinant is not proven positive, the worst first; omitted if there are none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<UnprovenCell>>"))]
    pub unproven: Vec<UnprovenCell>,
    /// What the trilinear cells keep that stand for tricubic ones in files, three along each edge; omitted for trilinear cells.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub linear: Option<LinearShares>,
    /// The distance of the mesh's wall from the surface of the skeleton's cones, both ways; omitted if it was not computed.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub wall: Option<WallDistance>,
    /// Sentences about branches that are not meshed, because they are too short or the cells of their nodes would be folded; omitted if there are none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<String>>"))]
    pub left_out: Vec<String>,
    /// Sentences about branches whose axis is more than a tenth of a radius from the samples, because they turn too sharply to be followed;
    /// omitted if there are none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<String>>"))]
    pub moved: Vec<String>,
}

impl MeshReport {
    /// Number of cells that are proven to be folded.
    pub fn folded(&self) -> usize {
        self.unproven.iter().filter(|cell| cell.folded).count()
    }
}

/// So many cells as the subject of a sentence, with its verb.
pub(crate) fn cells_are(count: usize) -> String {
    if count == 1 { "1 cell is".to_owned() } else { format!("{count} cells are") }
}

/// A cell over which the Jacobian determinant is not proven positive: it is folded, or nearly.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct UnprovenCell {
    /// Its number, or that of the patch; the first is 0.
    pub cell: usize,
    /// Its least scaled Jacobian at points: not above 0 if it is folded there.
    pub scaled_jacobian: f64,
    /// Whether the Jacobian determinant is proven to be zero or negative at a point of the cell.
    pub folded: bool,
    /// The mean of its corners, in micrometres.
    pub centre: [f64; 3],
    /// The nearest sample, by its number in the file; omitted without a skeleton.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub sample: Option<i64>,
    /// The line of this sample, from 1; omitted without a skeleton.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub line: Option<usize>,
}

/// The distance of the wall from the surface of the union of the cones of the skeleton in the file, both ways.
///
/// # Definition
/// The cones are those between neighbouring samples; at a soma that is a ball, neurites begin in its centre with their own radius.
/// Round ends of the cones beyond flat ends of the mesh are left out. Distances in radii are divided by the radius of the skeleton's
/// ball that is nearest to the point.
/// # Accuracy
/// The bounds are proven, rounding included.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct WallDistance {
    /// The tolerated distance, in radii.
    pub within: f64,
    /// The greatest distance of a point of the wall from the surface of the cones.
    pub wall_to_cones: DirectedDistance,
    /// The greatest distance of a point of the surface of the cones from the wall.
    pub cones_to_wall: DirectedDistance,
    /// Samples next to points that are proven to be farther away than is tolerated, the farthest first; omitted if there are none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<BeyondSample>>"))]
    pub beyond: Vec<BeyondSample>,
}

impl WallDistance {
    /// Bounds on the greater one of both distances, in radii.
    pub fn in_radii(&self) -> [f64; 2] {
        let [a, b] = [&self.wall_to_cones, &self.cones_to_wall];
        [a.lower_radii.max(b.lower_radii), a.upper_radii.max(b.upper_radii)]
    }

    /// A tolerance with which the distance is accepted: its upper bound with two digits, rounded up.
    pub fn sufficient(&self) -> f64 {
        let upper = self.in_radii()[1];
        let digit = libm::pow(10.0, libm::floor(libm::log10(upper)) - 1.0);
        let rounded = (upper / digit).ceil() / (1.0 / digit);
        if rounded >= upper { rounded } else { upper }
    }

    /// Whether the distance is proven to be tolerated, or not to be; `None` if neither is proven.
    pub fn is_within(&self) -> Option<bool> {
        let [lower, upper] = self.in_radii();
        if upper <= self.within {
            return Some(true);
        }
        (lower > self.within).then_some(false)
    }
}

/// Bounds on the greatest distance of the points of one surface from another.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DirectedDistance {
    /// Lower bound, in micrometres.
    pub lower: f64,
    /// Upper bound, in micrometres.
    pub upper: f64,
    /// Lower bound on the greatest distance in radii.
    pub lower_radii: f64,
    /// Upper bound on the greatest distance in radii.
    pub upper_radii: f64,
    /// The sample next to the point that attains the lower bound in radii, by its number in the file.
    pub sample: i64,
}

/// A sample next to a point that is farther from the other surface than is tolerated.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BeyondSample {
    /// The sample, by its number in the file.
    pub sample: i64,
    /// Its line, from 1.
    pub line: usize,
    /// A distance that is attained there, in micrometres.
    pub distance: f64,
    /// The same in radii.
    pub radii: f64,
}

/// The reason for ending a stage, as part of a sentence.
pub(crate) fn ended_by(reason: StopReason) -> &'static str {
    match reason {
        StopReason::Time => "the time limit",
        StopReason::Memory => "the memory limit",
        _ => "request",
    }
}

/// Returns an error if the computation should stop.
pub(crate) fn go_on(control: &Control) -> Result<(), MeshError> {
    if control.is_stopped() {
        return Err(MeshError::Stopped(control.reason().unwrap_or(StopReason::Cancelled)));
    }
    Ok(())
}

/// A node whose cells stay folded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoldedNode {
    /// A sample of the node, by its number in the file.
    pub sample: i64,
    /// Its line, from 1.
    pub line: usize,
    /// Branches that meet there.
    pub arms: usize,
    /// The best of the least scaled Jacobians found.
    pub quality: f64,
}

impl fmt::Display for FoldedNode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { sample, arms, quality, .. } = self;
        let branches = if *arms == 1 { "branch" } else { "branches" };
        write!(
            f,
            "the node at sample {sample} with {arms} {branches} cannot be meshed: the least scaled Jacobian found is {quality:.3}"
        )
    }
}

/// The first node in full, and the samples of the others.
fn of_nodes(nodes: &[FoldedNode]) -> String {
    let Some((first, others)) = nodes.split_first() else { return String::new() };
    let others: Vec<String> = others.iter().map(|node| node.sample.to_string()).collect();
    let nor =
        if others.is_empty() { String::new() } else { format!("; nor can those at {}", others.join(", ")) };
    format!("line {}: {first}{nor}", first.line)
}

/// Why a neuron cannot be meshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A sample has no radius.
    #[error("line {line}: sample {sample} has the radius 0; --repair takes it from its neighbours")]
    ZeroRadius {
        /// The sample.
        sample: i64,
        /// Its line, from 1.
        line: usize,
    },
    /// No branch has a length.
    #[error(
        "there is no branch to mesh: the skeleton is points only, or every branch is too short for its radius"
    )]
    NoBranch,
    /// The cells of nodes stay folded.
    #[error("{}", of_nodes(.0))]
    Nodes(Vec<FoldedNode>),
    /// The memory limit is too small.
    #[error(
        "the mesh would have about {cells} cells and take {needed} MiB, more than the limit of {limit} MiB"
    )]
    Memory {
        /// Cells, estimated.
        cells: usize,
        /// Estimated need in MiB.
        needed: usize,
        /// The limit in MiB.
        limit: usize,
    },
    /// The computation was stopped.
    #[error("ended by {} before the mesh was done", ended_by(*.0))]
    Stopped(StopReason),
    /// An option is out of range.
    #[error("the {what} is {value}; expected {expected}")]
    Option {
        /// The option.
        what: &'static str,
        /// Its value.
        value: f64,
        /// The valid range.
        expected: &'static str,
    },
    /// There are no cells.
    #[error("the mesh has no hexahedron")]
    NoCell,
    /// A cell of an imported mesh is folded.
    #[error(
        "cell {cell} (the first is 0) is folded or stands on its head: its scaled Jacobian is {quality:.3}"
    )]
    Folded {
        /// The worst cell.
        cell: usize,
        /// Its scaled Jacobian.
        quality: f64,
    },
    /// A side of the bounding box is no end.
    #[error("the side {side} is no end of the mesh: {problem}")]
    Side {
        /// The side.
        side: &'static str,
        /// Why.
        problem: &'static str,
    },
    /// The name is not that of a side.
    #[error("{name:?} is no side of a box; expected -x, +x, -y, +y, -z or +z")]
    UnknownSide {
        /// The name.
        name: String,
    },
    /// A place for refinement is invalid.
    #[error("{place} {problem}")]
    Place {
        /// Its name.
        place: String,
        /// The reason.
        problem: &'static str,
    },
    /// The number of labels is not that of vertices.
    #[error("there are {found} labels of ends for {vertices} vertices")]
    Labels {
        /// Number of labels.
        found: usize,
        /// Number of vertices.
        vertices: usize,
    },
    /// The mesh does not conform.
    #[error("the mesh is wrong: {0}")]
    Volume(#[from] VolumeError),
}
