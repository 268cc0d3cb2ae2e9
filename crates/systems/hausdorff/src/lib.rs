//! Certified Pompeiu–Hausdorff distance between triangle meshes.
//!
//! # Definition
//! For compact sets A and B, `h(A, B) = max over a in A of min over b in B of |a - b|` is the directed distance and
//! `H(A, B) = max(h(A, B), h(B, A))` the symmetric one. A and B are the unions of the faces of two meshes: all points of
//! all faces count, and nothing but them. Neither orientation, nor welding, nor manifoldness matters.
//!
//! # What is proven
//! [`directed_hausdorff`] and [`symmetric_hausdorff`] return an [`Enclosure`] `lower <= h <= upper` of the distance
//! between the meshes as stored, rounding included, and the pair of points that proves `lower`:
//! * every part of A was discarded by a bound on its distance from B that is at most `upper`: the maximum, over the
//!   corners of a convex piece, of a convex function that dominates the distance from B ([`Proof`]);
//! * the distance of the witness from every face of B was bounded from below in interval arithmetic.
//!
//! The rounding model is written down in [`rounding`].
//!
//! # Example
//! ```
//! use pompeiu_core::TriMesh;
//! use pompeiu_hausdorff::symmetric_hausdorff;
//!
//! // A square folded along one diagonal, and along the other: all vertices coincide.
//! let corners = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
//! let a = TriMesh::new(corners.clone(), vec![[0, 1, 2], [0, 2, 3]])?;
//! let b = TriMesh::new(corners, vec![[0, 1, 3], [1, 2, 3]])?;
//! let distance = symmetric_hausdorff(&a, &b).distance;
//! assert!(distance.contains(1.0 / 3.0_f64.sqrt()));
//! assert!(distance.gap() < 2e-12);
//! # Ok::<(), pompeiu_core::MeshError>(())
//! ```

pub mod certificate;
mod certify;
pub mod classic;
mod coarse;
pub mod deviation;
pub mod digits;
mod engine;
mod observer;
mod options;
mod planar;
mod prepared;
mod query;
mod report;
mod request;
pub mod rounding;
mod search;
#[cfg(feature = "figures")]
pub mod show;
mod target;
mod tolerance;

pub use deviation::{Deviation, DeviationOptions, DirectedDeviation};
pub use observer::{Discard, MeanSoFar, Observer, Progress, Proof, RemainingPiece, Stage};
pub use options::{HausdorffOptions, Method};
pub use prepared::{Held, PreparedPair};
pub use query::{directed_hausdorff, symmetric_hausdorff};
pub use report::{
    DirectedReport, Direction, Enclosure, PointPair, StopReason, SurfacePoint, SymmetricReport, Timing,
    Witness, WorkCount,
};
pub use request::{
    AskedTolerance, BothLeftOut, Comparison, DeviationMeasures, DeviationReport, DeviationRequest,
    DeviationRequestError, DirectedDeviationReport, DirectedDistance, Directions, DistanceReport,
    DistanceRequest, MeasuredParts, NamedFaces, Outlier, ProvenRepair, ProvenRepairReport, RepairRequest,
    RepairRequestError, Statement, ThresholdAnswer, ToleranceKind, TraceRow, UnprovenStatement, Verdict,
    VerdictAnswer, VerifyReport, VerifyRequest,
};
pub use target::Target;
pub use tolerance::{OptionError, Tolerance};
