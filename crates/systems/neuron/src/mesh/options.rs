//! How a neuron is meshed, what is said of the mesh, and why there is none.

use pompeiu_core::run::{Control, Limits, ProgressObserver, StopReason};
use pompeiu_volume::VolumeError;

/// How a neuron is meshed.
#[derive(Clone)]
pub struct MeshOptions<'o> {
    /// Parts of each block along each edge, 1 to 8: a section has five times the square of it as cells.
    pub parts: usize,
    /// Length of a block along a branch, in radii, 0.25 to 20.
    pub layer: f64,
    /// Whether the distance of the wall from the tubes is enclosed.
    pub measure: bool,
    /// Limits on time and memory.
    pub limits: Limits,
    /// Is told how many nodes are done.
    pub progress: Option<&'o dyn ProgressObserver>,
}

impl Default for MeshOptions<'_> {
    fn default() -> Self {
        Self { parts: 2, layer: 2.0, measure: true, limits: Limits::default(), progress: None }
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
        Ok(())
    }
}

/// What is said of a mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MeshReport {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of cells.
    pub hexahedra: usize,
    /// The least scaled Jacobian at the 27 points of each cell whose coordinates are 0, ½ and 1.
    pub min_scaled_jacobian: f64,
    /// Whether the Jacobian determinant is proven positive over every cell.
    pub certified: bool,
    /// Bounds on the greatest distance of a point of the mesh's wall from the tubes, in micrometres; left out where it was not measured.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub surface_distance: Option<SurfaceDistance>,
    /// Branches that were too short to be meshed, in sentences; left out where there are none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Vec::is_empty"))]
    #[cfg_attr(feature = "schema", schemars(with = "Option<Vec<String>>"))]
    pub left_out: Vec<String>,
}

/// Bounds on the greatest distance of a point of the wall from the tubes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SurfaceDistance {
    /// At least this.
    pub lower: f64,
    /// At most this.
    pub upper: f64,
}

/// What ended a stage, in the words of a sentence.
pub(crate) fn ended_by(reason: StopReason) -> &'static str {
    match reason {
        StopReason::Time => "the time limit",
        StopReason::Memory => "the memory limit",
        _ => "request",
    }
}

/// Whether to go on.
pub(crate) fn go_on(control: &Control) -> Result<(), MeshError> {
    if control.is_stopped() {
        return Err(MeshError::Stopped(control.reason().unwrap_or(StopReason::Cancelled)));
    }
    Ok(())
}

/// Why a neuron cannot be meshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// A sample without a radius.
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
    /// A node whose cells stay folded.
    #[error(
        "line {line}: the node at sample {sample} with {arms} branches cannot be meshed: the least scaled Jacobian found is {quality:.3}"
    )]
    Node {
        /// A sample of the node.
        sample: i64,
        /// Its line, from 1.
        line: usize,
        /// Branches that meet there.
        arms: usize,
        /// The best that was found.
        quality: f64,
    },
    /// The mesh would not fit into memory.
    #[error(
        "the mesh would have about {cells} cells and take {needed} MiB, more than the limit of {limit} MiB"
    )]
    Memory {
        /// Cells, estimated.
        cells: usize,
        /// MiB, estimated.
        needed: usize,
        /// MiB that may be used.
        limit: usize,
    },
    /// It was stopped before there was a mesh.
    #[error("ended by {} before the mesh was done", ended_by(*.0))]
    Stopped(StopReason),
    /// An option is out of range.
    #[error("the {what} is {value}; expected {expected}")]
    Option {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
        /// What it must be.
        expected: &'static str,
    },
    /// There is no cell.
    #[error("the mesh has no hexahedron")]
    NoCell,
    /// A cell of a mesh from elsewhere is folded.
    #[error(
        "cell {cell} (the first is 0) is folded or stands on its head: its scaled Jacobian is {quality:.3}"
    )]
    Folded {
        /// The worst cell.
        cell: usize,
        /// Its scaled Jacobian.
        quality: f64,
    },
    /// A side of the box around a mesh is no end.
    #[error("the side {side} is no end of the mesh: {problem}")]
    Side {
        /// The side.
        side: &'static str,
        /// Why.
        problem: &'static str,
    },
    /// A name that is no side of a box.
    #[error("{name:?} is no side of a box; expected -x, +x, -y, +y, -z or +z")]
    UnknownSide {
        /// The name.
        name: String,
    },
    /// A place where nothing can be refined.
    #[error("{place} {problem}")]
    Place {
        /// Its name.
        place: String,
        /// Why.
        problem: &'static str,
    },
    /// Numbers of ends are not those of vertices.
    #[error("there are {found} labels of ends for {vertices} vertices")]
    Labels {
        /// Labels there are.
        found: usize,
        /// Vertices there are.
        vertices: usize,
    },
    /// Cells do not fit together.
    #[error("the mesh is wrong: {0}")]
    Volume(#[from] VolumeError),
}
