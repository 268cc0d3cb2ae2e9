//! Results for people to look at: pages to explore in a browser, pictures for papers and logs.
//!
//! Nothing is computed here that is not already in a result, except what a search has left at coarser tolerances, which is
//! searched for again. [`DeviationPage`] shows a result of this crate; [`DeviationContent`] is the same page from plain data.

mod compose;
mod content;
mod page;
mod paper;
mod spread;
mod stages;

pub use content::{
    DeviationContent, DisplayTriangles, Exceedance, Histogram, MeasuredSurface, Region, SearchStage,
    SurfaceDeviation,
};
pub use page::{DeviationFigures, DeviationPage, NamedMesh};
pub use stages::search_stages;
