//! Options of the complexity command.

use crate::args::Limits;
use clap::{Args, ValueEnum};
use pompeiu::planar::silhouette::{Foreground, SilhouetteOptions};
use std::path::PathBuf;

/// Measure how complex the shapes in a folder are, rank and cluster them
#[derive(Args)]
#[command(after_help = "\
Shapes are pictures (PNG, JPEG, GIF, BMP: the largest part that stands out), drawings (SVG, DXF) and lists of points (TXT, CSV). Of each
the outline counts, without its holes. Files that cannot be used are told, and the others measured.

Measures, by family; + grows with complexity, - falls:
  boundary   boundary-  boundary-500-  boundary-100-  boundary-50-  boundary-25-  boundary-8-
  curvature  t18+  neg5+  sharp+  per-shape+  peaks+  total-curvature+
  skeleton   skeleton-length+  skeleton-ends+  skeleton-junctions+  skeleton-radius-  skeleton-variation+
  moments    elongation+  spread+
  coverage   hull-  rectangle-  circle-
  global     compactness-  convexity-  aspect-  diameter+

Exit codes:
  0  done
  2  an argument or some of the files cannot be used; the others are measured
  3  a limit or Ctrl-C left shapes out

Examples:
  pompeiu complexity shapes/ --report shapes.html
  pompeiu complexity shapes/ --rank-by boundary-25 --against mine.csv
  pompeiu complexity shapes/ --clusters 4 --features log:peaks,log:total-curvature --json")]
pub(crate) struct Complexity {
    /// Folders of shapes, or files
    #[arg(value_name = "FOLDER", required = true)]
    pub(crate) inputs: Vec<PathBuf>,
    /// The measure that ranks the shapes
    #[arg(long, default_value = "total-curvature", value_name = "MEASURE")]
    pub(crate) rank_by: String,
    /// Compare with another ranking: a file with lines `name,place`, 1 for the simplest shape
    #[arg(long, value_name = "RANKING.csv")]
    pub(crate) against: Option<PathBuf>,
    /// Divide the shapes into so many clusters around shapes of their own
    #[arg(long, value_name = "K")]
    pub(crate) clusters: Option<usize>,
    /// What clusters are made by: measures, or log:MEASURE for ln(1 + value)
    #[arg(long, value_delimiter = ',', default_value = "log:peaks,log:total-curvature", value_name = "LIST")]
    pub(crate) features: Vec<String>,
    /// Standard deviation of the Gaussian that smooths outlines for curvature, as a share of their length
    #[arg(long, default_value = "0.004", value_name = "SHARE")]
    pub(crate) smoothing: f64,
    #[command(flatten)]
    pub(crate) silhouette: Silhouette,
    /// Write a page with a gallery that can be sorted, one file that needs no network
    #[arg(long, value_name = "FILE.html")]
    pub(crate) report: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) limits: Limits,
}

/// How the shape in a picture is found.
#[derive(Args)]
pub(crate) struct Silhouette {
    /// The level between shape and background, from 0 (black) to 1 (white); Otsu's by default
    #[arg(long, value_name = "LEVEL")]
    pub(crate) level: Option<f64>,
    /// Which part of a picture is the shape
    #[arg(long, value_enum, default_value_t)]
    pub(crate) foreground: ForegroundName,
    /// Follow the sides of pixels instead of the smoothest curve within half a pixel of them
    #[arg(long)]
    pub(crate) staircase: bool,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum ForegroundName {
    /// What most of the border is not
    #[default]
    Auto,
    /// What is darker than the level
    Dark,
    /// What is lighter than the level
    Light,
}

impl Silhouette {
    pub(crate) fn options(&self) -> SilhouetteOptions {
        let foreground = match self.foreground {
            ForegroundName::Auto => Foreground::Auto,
            ForegroundName::Dark => Foreground::Dark,
            ForegroundName::Light => Foreground::Light,
        };
        SilhouetteOptions { level: self.level, foreground, staircase: self.staircase }
    }
}
