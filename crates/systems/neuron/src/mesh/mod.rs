//! Hexahedral meshes of neurons.
//!
//! Along each branch there is a tube with five blocks per section: one in the core, four around it up to the wall. At each node the
//! cores of the tubes attach to a small complex, and every quad of the boundary of complex and tubes is extruded to the wall, which
//! is a smooth union of the tubes. All blocks are subdivided into equal parts, and vertices around nodes are optimised for cell
//! quality; or each block is one tricubic cell, whose control points are optimised likewise.

mod assembly;
mod assign;
mod bar;
mod build;
mod causes;
mod cluster;
mod core;
mod cubic;
mod cubic_energy;
mod cubic_follow;
mod cubic_lanes;
mod cubic_node;
mod cut;
mod decide;
mod distance;
mod energy;
mod energy_lanes;
mod exit;
mod folds;
mod follow;
mod import;
mod layout;
mod least_shift;
mod linear;
mod node;
mod node_mesh;
mod options;
mod path;
mod profile;
mod proof;
mod section;
mod shape;
mod sketch;
mod skin;
mod sweep;
mod tube;
mod wall;
mod warp;

pub(crate) use build::concentrations;
pub use build::{Cap, NeuronMesh};
pub(crate) use causes::{Cause, Causes};
pub use cubic::{CubicMesh, cubic_neuron};
pub(crate) use cubic::{LINEAR_PARTS, cubic_vtu};
pub(crate) use decide::decisive_report;
pub use decide::mesh_neuron;
pub use import::{Ends, Side};
pub use linear::LinearShares;
pub(crate) use linear::{Labelled, linear_shares};
pub use options::{
    BeyondSample, DirectedDistance, FoldedNode, MeshError, MeshOptions, MeshReport, UnprovenCell,
    WallDistance,
};
pub(crate) use options::{cells_are, ended_by, go_on};
