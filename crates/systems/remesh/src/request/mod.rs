//! What can be asked: the options of [`RemeshRequest`] and [`SimplifyRequest`], as every door offers them.

mod remesh;
mod simplify;

pub use remesh::{RemeshAnswer, RemeshReport, RemeshRequest};
pub use simplify::{Kept, LevelReport, SimplifyAnswer, SimplifyReport, SimplifyRequest};
