//! Geometry processing with guarantees.

pub use pompeiu_core as core;
pub use pompeiu_hausdorff as hausdorff;
pub use pompeiu_io as io;
