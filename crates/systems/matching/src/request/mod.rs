//! What can be asked, as every door offers it: [`AlignRequest`], and questions about two meshes of which one may be moved onto the
//! other first.

mod align;
mod distance;
mod moved;

pub use align::{AlignReport, AlignRequest, AlignTiming, Aligned};
pub use distance::{AlignedDistanceReport, AlignedDistanceRequest};
pub use moved::{MovedFirst, RequestError, moved};
