//! From the skeleton of a neuron to flow and transport inside it.
//!
//! A skeleton is a tree of samples, which are balls with a centre and a radius, as in SWC files. Two neighbours span a round cone;
//! the neuron is the union of all cones.
//!
//! | item | what it is |
//! |---|---|
//! | [`read_swc`], [`write_swc`], [`SwcRow`] | the file, in all its dialects |
//! | [`Skeleton`], [`Sample`], [`Soma`], [`Repair`] | the tree, and repairs of it |
//! | [`problems`], [`Problem`] | defects that would harm a mesh, with their places |
//! | [`meshability`], [`Meshability`] | whether there is a mesh as asked, and where and why not |
//! | [`smooth`], [`SkeletonDeviation`] | smoothing and resampling, with the deviation from the input |
//! | [`mesh_neuron`], [`MeshOptions`], [`NeuronMesh`] | a conforming hexahedral mesh, every cell proven unfolded |
//! | [`cubic_neuron`], [`CubicMesh`], [`SplineReport`] | the same with tricubic cells, and splines over them |
//! | [`refined_splines`], [`RefineAt`] | splines refined at nodes, ends, the wall, or near points |
//! | [`neuron_flow`], [`FlowParameters`], [`Flow`] | steady viscous flow, conservative cell by cell |
//! | [`transport`], [`transport_in_flow`], [`Parameters`], [`read_transport_config`] | diffusion and motors in both directions, conservative and without negative concentrations |
//! | [`NeuronMesh::from_hexahedra`], [`CubicMesh::from_hexahedra`], [`Ends`] | the same for imported meshes |
//! | `NeuronRequest`, `NeuronAnswer`, `NeuronSource`, [`MaterialCells`] | all stages in one call, with options as every door offers them (feature `serde`) |
//! | `Checkpoint` | the state of a transport, from which another run goes on (feature `serde`) |
//! | [`NeuronReport`], [`SkeletonReport`] | reports on a neuron and its skeleton |
//! | [`RoundCone`], [`Curve`] | the tubes and their smooth axes |
//!
//! ```
//! use pompeiu_neuron::{ProblemKind, Skeleton, problems, read_swc};
//!
//! // Two neurites that leave a soma side by side, 1 µm apart, each 1 µm thick to either side.
//! let rows = read_swc(b"1 1 0 0 0 3 -1\n2 3 9 0 0 1 1\n3 3 9 1 0 1 1\n")?;
//! let skeleton = Skeleton::new(&rows)?;
//! assert_eq!(skeleton.branches().len(), 2);
//! assert_eq!(problems(&skeleton)[0].kind, ProblemKind::Inside);
//! # Ok::<(), pompeiu_neuron::SwcError>(())
//! ```

mod cells;
#[cfg(feature = "serde")]
mod checkpoint;
mod cone;
mod curve;
mod error;
mod flow;
mod mesh;
mod prepare;
mod problems;
mod refine;
mod report;
#[cfg(feature = "serde")]
mod request;
#[cfg(feature = "figures")]
mod show;
mod skeleton;
mod smooth;
#[cfg(feature = "serde")]
mod source;
mod spline;
mod swc;
mod transport;

pub use cells::MaterialCells;
#[cfg(feature = "serde")]
pub use checkpoint::{Checkpoint, CheckpointError, RunIdentity};
pub use cone::RoundCone;
pub use curve::{ArcLength, Curve};
pub use error::SwcError;
pub use flow::{
    Drive, Flow, FlowEnd, FlowError, FlowOptions, FlowParameters, FlowReport, FlowSolution, FlowSystem,
    NEWTON_TOLERANCE, neuron_flow,
};
pub use mesh::{
    BeyondSample, Cap, CubicMesh, DirectedDistance, Ends, FoldedNode, LinearShares, MeshError, MeshOptions,
    MeshReport, NeuronMesh, Side, UnprovenCell, WallDistance, cubic_neuron, mesh_neuron,
};
pub use prepare::{Preparation, PreparedSkeleton, prepare};
pub use problems::{MOST_TURN, Meshability, Problem, ProblemKind, meshability, problems};
pub use refine::{RefineAt, RefineOptions, refined_splines, refined_vtu};
pub use report::{NeuronReport, SkeletonReport, Timing};
#[cfg(feature = "serde")]
pub use request::{NeuronAnswer, NeuronRequest, NeuronRequestError, ParameterTable, Stage, Transported};
#[cfg(feature = "figures")]
pub use show::{NeuronPage, NeuronSurface};
pub use skeleton::{Repair, RepairAction, SOMA, Sample, Skeleton, Soma};
pub use smooth::{SkeletonDeviation, SmoothOptions, smooth};
#[cfg(feature = "serde")]
pub use source::NeuronSource;
pub use spline::{LevelReport, SplineReport};
pub use swc::{SwcRow, read_swc, write_swc};
pub use transport::{
    Discretisation, FlowCells, FlowField, Frame, Parameters, TimeScheme, TipReport, Transport,
    TransportError, TransportOptions, TransportReport, TransportState, potential_flow, read_transport_config,
    transport, transport_in_flow,
};
