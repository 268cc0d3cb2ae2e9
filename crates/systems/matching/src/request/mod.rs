//! What can be asked, as every door offers it: [`AlignRequest`], [`RankRequest`], [`MatrixRequest`], and questions about two meshes of
//! which one may be moved onto the other first.

mod align;
mod deviation;
mod distance;
mod matrix;
mod moved;
mod rank;

pub use align::{AlignReport, AlignRequest, AlignTiming, Aligned};
pub use deviation::{AlignedDeviationReport, AlignedDeviationRequest};
pub use distance::{AlignedDistanceReport, AlignedDistanceRequest};
pub use matrix::{MatrixReport, MatrixRequest, MatrixRequestError};
pub use moved::{MovedFirst, RequestError, moved};
pub use rank::{RankReport, RankRequest};
