//! What can be asked: the options of [`ComplexityRequest`], as every door offers them.

mod against;

pub use against::{RankingError, RankingSource};

use crate::{
    AnalyseOptions, ComplexityError, ComplexityReport, FailedShape, Measure, MeasureOptions, Shape, analyse,
};
use pompeiu_core::request::{Conclusion, Limit, Report, Request};
use pompeiu_core::run::{Control, RunContext, StopReason};
use pompeiu_planar::silhouette::{Foreground, SilhouetteOptions};
use pompeiu_planar::{DrawnShape, FileError, ShapeError, ShapeSource, shapes_in};
use rayon::prelude::*;
use std::path::PathBuf;

/// Measure how complex the shapes in a folder are, rank and cluster them.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize),
    serde(default, deny_unknown_fields)
)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ComplexityRequest {
    /// The measure that ranks the shapes.
    #[cfg_attr(feature = "clap", arg(long, value_name = "MEASURE"))]
    pub rank_by: String,
    /// Compare with another ranking: a file with lines name,place, 1 for the simplest shape; in Python also the place of each name.
    #[cfg_attr(feature = "clap", arg(long, value_name = "RANKING.csv"))]
    pub against: Option<RankingSource>,
    /// Divide the shapes into so many clusters around shapes of their own.
    #[cfg_attr(feature = "clap", arg(long, value_name = "K"))]
    pub clusters: Option<usize>,
    /// The features that clusters are made by: measures, or log:MEASURE for ln(1 + value).
    #[cfg_attr(feature = "clap", arg(long, value_delimiter = ',', value_name = "LIST"))]
    pub features: Vec<String>,
    /// Standard deviation of the Gaussian that smooths outlines for curvature, as a share of their length.
    #[cfg_attr(feature = "clap", arg(long, value_name = "SHARE"))]
    pub smoothing: f64,
    /// The level between shape and background of a picture, from 0 (black) to 1 (white); Otsu's by default.
    #[cfg_attr(feature = "clap", arg(long, value_name = "LEVEL"))]
    pub level: Option<f64>,
    /// The part of a picture that is the shape.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub foreground: Foreground,
    /// Follow the sides of pixels instead of the smoothest curve within half a pixel of them.
    #[cfg_attr(feature = "clap", arg(long))]
    pub staircase: bool,
}

impl Default for ComplexityRequest {
    fn default() -> Self {
        let AnalyseOptions { rank_by, features, measure, .. } = AnalyseOptions::default();
        let SilhouetteOptions { level, foreground, staircase } = SilhouetteOptions::default();
        Self {
            rank_by,
            against: None,
            clusters: None,
            features,
            smoothing: measure.smoothing,
            level,
            foreground,
            staircase,
        }
    }
}

impl Request for ComplexityRequest {
    const NAME: &'static str = "complexity";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time];
    type Report = ComplexityReport;
}

impl Report for ComplexityReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    fn conclusion(&self) -> Conclusion {
        let is_complete = self.failed.is_empty() && !self.stop.is_early();
        if is_complete { Conclusion::AsAsked } else { Conclusion::Incomplete }
    }
}

/// A shape to measure, or a folder of them.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedShape {
    /// Its name in the report; shapes in folders have their paths.
    pub name: String,
    /// Where it comes from.
    pub source: ShapeSource,
}

impl NamedShape {
    /// A file or a folder under its path.
    pub fn file(path: PathBuf) -> Self {
        Self { name: path.display().to_string(), source: ShapeSource::File(path) }
    }
}

/// What was measured.
#[derive(Clone, Debug)]
pub struct ComplexityAnswer {
    /// The shapes that were read.
    pub shapes: Vec<Shape>,
    /// The report.
    pub report: ComplexityReport,
}

/// Why shapes cannot be analysed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ComplexityRequestError {
    /// None of the files can be used.
    #[error("there are no shapes to measure{}", failed.first().map_or_else(String::new, |first| format!(": {first}")))]
    NoShapes {
        /// What is wrong with each.
        failed: Vec<FailedShape>,
    },
    /// The other ranking cannot be used.
    #[error(transparent)]
    Ranking(#[from] RankingError),
    /// Corners that are given are no outline.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// Options or shapes cannot be used.
    #[error(transparent)]
    Analysis(#[from] ComplexityError),
}

impl ComplexityRequest {
    /// Reads shapes, measures them, ranks them and clusters them. Files that cannot be used are in the report, and the others are
    /// measured; shapes that were not read or measured in time are left out.
    ///
    /// # Errors
    /// [`ComplexityRequestError`].
    pub fn run(
        &self,
        shapes: &[NamedShape],
        context: &RunContext<'_>,
    ) -> Result<ComplexityAnswer, ComplexityRequestError> {
        // Wrong names are an error before any file is read.
        for name in std::iter::once(&self.rank_by).chain(&self.features) {
            Measure::named(name.strip_prefix("log:").unwrap_or(name))?;
        }
        let against = self.against.as_ref().map(RankingSource::places).transpose()?;
        let control = context.control();
        let Read { shapes, failed, left_out } = context.on_threads(|| self.read(shapes, &control))?;
        if shapes.is_empty() && !control.is_stopped() {
            return Err(ComplexityRequestError::NoShapes { failed });
        }
        let options = AnalyseOptions {
            measure: MeasureOptions { smoothing: self.smoothing },
            rank_by: self.rank_by.clone(),
            against,
            // What was read in time may be less than the clusters.
            clusters: self.clusters.filter(|_| control.reason().is_none()),
            features: self.features.clone(),
            limits: context.limits(),
            progress: context.progress(),
        };
        let mut report = match control.reason().filter(|_| shapes.is_empty()) {
            Some(stop) => ComplexityReport::empty(&self.rank_by, stop),
            None => analyse(&shapes, &options)?,
        };
        (report.failed, report.left_out) = (failed, left_out);
        Ok(ComplexityAnswer { shapes, report })
    }

    fn read(&self, named: &[NamedShape], control: &Control) -> Result<Read, ShapeError> {
        let mut read = Read::default();
        let mut all: Vec<NamedShape> = Vec::new();
        for NamedShape { name, source } in named {
            match source.file().filter(|path| path.is_dir()).map(shapes_in) {
                Some(Ok(files)) => all.extend(files.into_iter().map(NamedShape::file)),
                Some(Err(error)) => read.failed.push(FailedShape::new(name, &error)),
                None => all.push(NamedShape { name: name.clone(), source: source.clone() }),
            }
        }
        let options =
            SilhouetteOptions { level: self.level, foreground: self.foreground, staircase: self.staircase };
        let one = |NamedShape { name, source }: &NamedShape| {
            (!control.is_stopped()).then(|| (name.clone(), source.shapes(&options)))
        };
        let found: Vec<_> = all.par_iter().map(one).collect();
        for (file, shapes) in found.into_iter().flatten() {
            match shapes {
                Ok((shapes, left_out)) => {
                    for shape in shapes {
                        read.add(&file, shape);
                    }
                    read.left_out.extend(left_out.map(|parts| format!("{file}: {parts}")));
                }
                Err(ShapeError::File { error, .. }) => read.failed.push(FailedShape::new(&file, &error)),
                Err(error) => return Err(error),
            }
        }
        Ok(read)
    }
}

/// What was read of some shapes.
#[derive(Default)]
struct Read {
    shapes: Vec<Shape>,
    failed: Vec<FailedShape>,
    left_out: Vec<String>,
}

impl Read {
    /// Adds a shape of a file. One of several has `#` and its own name after that of the file.
    fn add(&mut self, file: &str, DrawnShape { name, region }: DrawnShape) {
        let file = name.map_or_else(|| file.to_owned(), |name| format!("{file}#{name}"));
        match region {
            Ok(region) => self.shapes.push(Shape { file, outline: region.outer }),
            Err(error) => self.failed.push(FailedShape::new(&file, &error)),
        }
    }
}

impl FailedShape {
    fn new(path: &str, error: &FileError) -> Self {
        Self { path: path.to_owned(), message: error.to_string() }
    }
}
