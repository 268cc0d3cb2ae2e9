//! Results for people to look at: pages to explore in a browser, pictures for papers and logs.
//!
//! Nothing is computed here that is not already in a result, except what a search has left at coarser tolerances, which is
//! searched for again.

mod page;
mod stages;

pub use page::{DeviationReport, ReportedMesh};
pub use stages::search_stages;
