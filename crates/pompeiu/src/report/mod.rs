//! What was found, for people to look at: pages to explore in a browser, pictures for papers and logs.
//!
//! Here results meet pictures: nothing is computed that is not already in a result, but for what a search has left at coarser
//! tolerances, which is searched for again.

mod deviation;
mod fields;
mod names;
mod stages;

pub use deviation::{DeviationReport, ReportedMesh};
pub use fields::FieldsReport;
pub use stages::search_stages;
