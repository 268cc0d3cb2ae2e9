//! Cutting triangle surfaces open, and flattening them one-to-one.
//!
//! A cut is a set of edges. [`open`] gives each vertex one copy for every fan into which the cut divides its faces; this is
//! combinatorial and exact. [`choose_cut`] finds edges after which every component is a disk.
//!
//! [`flatten`] maps the opened surface to the plane, and decides exactly, on the coordinates as stored, whether the map is
//! one-to-one.
//!
//! | item | what it is |
//! |---|---|
//! | [`FlattenRequest`], [`CutRequest`] | all that can be asked, as the command and Python offer it |
//! | [`flatten`], [`FlattenOptions`], [`Flattening`] | the flat map, with a free boundary or a convex one |
//! | [`FlattenReport`], [`Distortion`] | whether the map is one-to-one, and its distortion |
//! | [`choose_cut`], [`CutOptions`], [`CutStrategy`] | choosing the edges to cut |
//! | [`open`], [`Opened`] | the surface after the cut, and the original vertex of each copy |
//! | [`straighten`], [`Straightened`] | a cut that runs straight across faces, inserted into the mesh |
//! | [`farthest_pair`] | the two points of a set that are farthest apart |
//!
//! ```
//! use pompeiu_core::mesh::shapes::torus;
//! use pompeiu_flatten::{CutOptions, FlattenOptions, choose_cut, flatten, open};
//! use pompeiu_surface::EmbeddedSurface;
//!
//! let torus = EmbeddedSurface::new(&torus(2.0, 0.7, 24, 16)?)?;
//! let cut = choose_cut(&torus, &CutOptions::default())?;
//! let opened = open(torus.mesh(), &cut)?;
//! assert_eq!((opened.mesh().euler_characteristic(), opened.mesh().boundary_loops().len()), (1, 1));
//!
//! let flat = flatten(&torus, &FlattenOptions::default())?;
//! assert!(flat.report.is_one_to_one());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod atlas;
mod chart;
mod charts;
mod check;
mod chords;
mod components;
mod creases;
mod cut;
mod distortion;
mod divide;
mod error;
mod flatten;
mod lengthen;
mod map;
mod opened;
mod options;
mod pack;
mod report;
mod request;
mod seams;
#[cfg(feature = "figures")]
pub mod show;
mod straight;
mod symmetry;
mod watch;

pub use charts::Charts;
pub use cut::{CutError, CutOptions, CutStrategy, Opened, choose_cut, farthest_pair, open};
pub use distortion::{Distortion, MeanMax, Spread};
pub use error::FlattenError;
pub use flatten::{Flattening, flatten};
pub use map::{Conformal, ConvexBoundary, RingKind, VirtualBoundary, Weights};
pub use options::{FlattenOptions, Method};
pub use report::{CutReport, FlattenReport, PartReport, Timing};
pub use request::{
    Boundary, CutAnswer, CutEdges, CutRequest, Energy, FlatSurface, FlattenRequest, OpenedReport, Strategy,
};
pub use straight::{Straightened, straighten};
pub use symmetry::{SymmetryError, SymmetryPlane};
