//! What can be asked, as every door offers it: the options of [`DistanceRequest`], [`RepairRequest`] and [`VerifyRequest`].

mod distance;
mod repair;
mod verify;

pub use distance::{
    AskedTolerance, Comparison, DirectedDistance, Directions, DistanceReport, DistanceRequest,
    ThresholdAnswer, ToleranceKind, TraceRow,
};
pub use repair::{ProvenRepair, ProvenRepairReport, RepairRequest, RepairRequestError};
pub use verify::{Statement, UnprovenStatement, VerifyReport, VerifyRequest};
