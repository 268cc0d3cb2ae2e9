//! Geometry processing with guarantees.
//!
//! The main question: how far apart are two surfaces, where, and can the number be trusted?
//!
//! ```
//! use pompeiu::prelude::*;
//!
//! let mesh = |z| TriMesh::new(vec![[0.0, 0.0, z], [2.0, 0.0, z], [1.0, 1.0, z]], vec![[0, 1, 2]]);
//! let distance = symmetric_hausdorff(&mesh(0.0)?, &mesh(0.25)?).distance;
//! assert!(distance.lower() <= 0.25 && 0.25 <= distance.upper());
//! # Ok::<(), MeshError>(())
//! ```
//!
//! Files are read with [`io::read_mesh`], options are plain structs such as [`hausdorff::HausdorffOptions`], and many meshes are measured against one
//! with a [`hausdorff::Target`].

#[cfg(feature = "complexity")]
pub use pompeiu_complexity as complexity;
#[cfg(feature = "contact")]
pub use pompeiu_contact as contact;
pub use pompeiu_core as core;
#[cfg(feature = "coupling")]
pub use pompeiu_coupling as coupling;
#[cfg(feature = "fields")]
pub use pompeiu_fields as fields;
#[cfg(feature = "figures")]
pub use pompeiu_figures as figures;
#[cfg(feature = "flatten")]
pub use pompeiu_flatten as flatten;
#[cfg(feature = "flow")]
pub use pompeiu_flow as flow;
#[cfg(feature = "fluid")]
pub use pompeiu_fluid as fluid;
pub use pompeiu_hausdorff as hausdorff;
#[cfg(feature = "io")]
pub use pompeiu_io as io;
#[cfg(feature = "matching")]
pub use pompeiu_matching as matching;
#[cfg(feature = "medial")]
pub use pompeiu_medial as medial;
#[cfg(feature = "neuron")]
pub use pompeiu_neuron as neuron;
#[cfg(feature = "operators")]
pub use pompeiu_operators as operators;
#[cfg(feature = "planar")]
pub use pompeiu_planar as planar;
#[cfg(feature = "puzzle")]
pub use pompeiu_puzzle as puzzle;
#[cfg(feature = "remesh")]
pub use pompeiu_remesh as remesh;
#[cfg(feature = "operators")]
pub use pompeiu_solve as solve;
#[cfg(feature = "operators")]
pub use pompeiu_surface as surface;
#[cfg(feature = "neuron")]
pub use pompeiu_volume as volume;

#[cfg(feature = "serde")]
pub mod options;

/// What most programs need.
pub mod prelude {
    pub use pompeiu_core::{FaceId, MeshError, MeshSummary, TriMesh, VertexId};
    pub use pompeiu_hausdorff::{
        Deviation, DeviationOptions, DirectedDeviation, DirectedReport, Enclosure, HausdorffOptions,
        Observer, OptionError, Progress, Stage, StopReason, SurfacePoint, SymmetricReport, Target, Tolerance,
        Witness, directed_hausdorff, symmetric_hausdorff,
    };
    #[cfg(feature = "io")]
    pub use pompeiu_io::{ReadError, WriteError, read_mesh};
}
