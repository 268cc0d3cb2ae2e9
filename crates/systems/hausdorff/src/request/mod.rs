//! What can be asked, as every door offers it: the options of [`DistanceRequest`] and [`RepairRequest`].

mod distance;
mod repair;

pub use distance::{
    AskedTolerance, Comparison, DirectedDistance, Directions, DistanceReport, DistanceRequest,
    ThresholdAnswer, ToleranceKind, TraceRow,
};
pub use repair::{ProvenRepair, ProvenRepairReport, RepairRequest, RepairRequestError};
