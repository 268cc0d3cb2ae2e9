//! What can be asked: the options of [`FlattenRequest`], [`CutRequest`] and [`MedialRequest`], as every door offers them.

mod cut;
mod flatten;
mod medial;

pub use cut::{CutAnswer, CutEdges, CutRequest, OpenedReport, Strategy};
pub use flatten::{Boundary, Energy, FlatSurface, FlattenRequest};
pub use medial::{MedialReport, MedialRequest, MedialTiming};
