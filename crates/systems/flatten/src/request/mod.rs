//! What can be asked: the options of [`FlattenRequest`] and [`CutRequest`], as every door offers them.

mod cut;
mod flatten;

pub use cut::{CutAnswer, CutEdges, CutRequest, OpenedReport, Strategy};
pub use flatten::{Boundary, Energy, FlatSurface, FlattenRequest};
