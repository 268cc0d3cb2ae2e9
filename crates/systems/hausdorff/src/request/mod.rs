//! What can be asked, as every door offers it: the options of [`DistanceRequest`], [`DeviationRequest`], [`RepairRequest`] and [`VerifyRequest`].

mod deviation;
mod distance;
mod repair;
mod verify;
mod watch;

pub use deviation::{
    BothLeftOut, DeviationMeasures, DeviationReport, DeviationRequest, DeviationRequestError,
    DirectedDeviationReport, MeasuredParts, NamedFaces, Outlier, Verdict, VerdictAnswer,
};
pub use distance::{
    AskedTolerance, Comparison, DirectedDistance, Directions, DistanceReport, DistanceRequest,
    ThresholdAnswer, ToleranceKind, TraceRow,
};
pub use repair::{ProvenRepair, ProvenRepairReport, RepairRequest, RepairRequestError};
pub use verify::{Statement, UnprovenStatement, VerifyReport, VerifyRequest};
