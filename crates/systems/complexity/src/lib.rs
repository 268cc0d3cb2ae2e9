//! Shape complexity in the plane: measures of outlines, rankings compared with those of people, clusters.
//!
//! Each measure is defined by a formula in the file of its family. It is invariant under translation, rotation, scaling, and the
//! choice of the outline's first point.
//!
//! | item | what it is |
//! |---|---|
//! | [`Measures`], [`MeasureOptions`] | boundary, curvature, skeleton, moments, coverage, global, of one outline |
//! | [`Measure`] | a measure by name, and the direction in which it grows |
//! | [`ranks`], [`compare_rankings`], [`Agreement`] | rankings, and the agreement of two |
//! | [`cluster`], [`Clusters`] | k-medoids with silhouettes |
//! | [`generate`] | shapes of growing complexity, seeded |
//! | [`analyse`], [`ComplexityReport`] | the whole analysis of many shapes |
//! | [`ComplexityRequest`], [`NamedShape`] | the same for files and folders, with options as every door offers them |
//!
//! ```
//! use pompeiu_complexity::{MeasureOptions, Measures, generate};
//!
//! let simple = Measures::of(&generate::polyline(5, 1, generate::PointOrder::Angle)?, &MeasureOptions::default())?;
//! let complex = Measures::of(&generate::polyline(25, 1, generate::PointOrder::Random)?, &MeasureOptions::default())?;
//! assert!(complex.curvature.total > simple.curvature.total);
//! assert!(complex.boundary.m25 < simple.boundary.m25);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod analyse;
mod cluster;
mod error;
pub mod generate;
mod measures;
mod ranking;
mod report;
mod request;
#[cfg(feature = "figures")]
pub mod show;

pub use analyse::{AnalyseOptions, Shape, analyse};
pub use cluster::{
    Clusters, adjusted_rand, cluster, faster_pam, matched_accuracy, optimal_medoids, silhouettes,
};
pub use error::ComplexityError;
pub use measures::{
    Boundary, Coverage, Curvature, Direction, Global, Measure, MeasureOptions, Measures, Moments, Skeleton,
};
pub use ranking::{Agreement, compare_rankings, kendall, ranks, spearman};
pub use report::{ComplexityReport, FailedShape, RankedShape, ShapeReport, Timing};
pub use request::{
    ComplexityAnswer, ComplexityRequest, ComplexityRequestError, NamedShape, RankingError, RankingSource,
};
