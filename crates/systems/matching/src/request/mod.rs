//! What can be asked, as every door offers it: [`AlignRequest`], and questions about two meshes of which one may be moved onto the
//! other first.

mod align;
mod deviation;
mod distance;
mod moved;

pub use align::{AlignReport, AlignRequest, AlignTiming, Aligned};
pub use deviation::{AlignedDeviationReport, AlignedDeviationRequest};
pub use distance::{AlignedDistanceReport, AlignedDistanceRequest};
pub use moved::{MovedFirst, RequestError, moved};
