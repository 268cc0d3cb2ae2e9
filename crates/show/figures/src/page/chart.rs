//! Charts.

use super::error::{check_bounds, check_finite, check_increasing, check_length};
use super::{PageError, PlaceId, PlayerId, ScaleId, Text};
use serde::Serialize;

/// A chart. Proven parts are drawn opaque, possible parts lighter.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Chart {
    /// Identifier for scripts and tests; may be empty.
    pub key: String,
    /// A sentence that says what the chart shows.
    pub title: Text,
    /// The horizontal axis.
    pub x: ChartAxis,
    /// The vertical axis.
    pub y: ChartAxis,
    /// The series; the first one is drawn at the bottom.
    pub series: Vec<Series>,
    /// The scale of the horizontal axis: its threshold is marked, and histograms have its colours.
    pub scale: Option<ScaleId>,
    /// Whether a click sets the threshold of that scale.
    pub sets_threshold: bool,
    /// The player whose steps are the entries of lines, points and bars: the current step is marked, and a click selects another
    /// one.
    pub player: Option<PlayerId>,
}

/// An axis of a chart.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ChartAxis {
    /// The quantity and its unit.
    pub label: String,
    /// Whether the axis is logarithmic. Values that are not positive are then omitted.
    pub logarithmic: bool,
    /// Whether to show fractions as percentages.
    pub percent: bool,
    /// The lower end; by default the least value.
    pub low: Option<f64>,
    /// The upper end; by default the greatest value.
    pub high: Option<f64>,
}

/// A data series of a chart.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "camelCase")]
pub enum Series {
    /// A curve through points.
    Line {
        /// The label; shown if there are several series.
        label: String,
        /// Abscissae, increasing.
        x: Vec<f64>,
        /// Ordinates.
        y: Vec<f64>,
    },
    /// A curve that is known to lie between two others.
    Band {
        /// The label; shown if there are several series.
        label: String,
        /// Abscissae, increasing.
        x: Vec<f64>,
        /// Enclosures of the ordinates.
        y: Vec<[f64; 2]>,
        /// Whether the curve never increases; between two abscissae it then lies in the bounding box of both enclosures.
        falling: bool,
    },
    /// A distribution of shares over values.
    Histogram {
        /// Bin edges, increasing, one more than there are bins.
        edges: Vec<f64>,
        /// Enclosures of the shares.
        shares: Vec<[f64; 2]>,
    },
    /// Points.
    Scatter {
        /// The label; shown if there are several series.
        label: String,
        /// The points.
        points: Vec<ScatterPoint>,
    },
    /// A bar for each step of the player. Allows no other series and no horizontal axis.
    Bars {
        /// Their heights.
        values: Vec<f64>,
    },
}

/// A point of a scatter plot.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ScatterPoint {
    /// Its coordinates.
    pub at: [f64; 2],
    /// Its label.
    pub label: String,
    /// The place shown on a click.
    pub place: Option<PlaceId>,
}

impl Chart {
    pub(super) fn check(&self) -> Result<(), PageError> {
        check_finite("the title of a chart", self.title.numbers())?;
        for axis in [&self.x, &self.y] {
            check_finite("the ends of an axis", axis.low.iter().chain(&axis.high))?;
        }
        self.series.iter().try_for_each(Series::check)
    }
}

impl Series {
    fn check(&self) -> Result<(), PageError> {
        match self {
            Self::Line { x, y, .. } => {
                check_increasing("the places of a curve", x)?;
                check_length("the values of a curve", y.len(), x.len())?;
                check_finite("the values of a curve", y)
            }
            Self::Band { x, y, .. } => {
                check_increasing("the places of a curve", x)?;
                check_length("the enclosures of a curve", y.len(), x.len())?;
                check_bounds("the enclosures of a curve", y)
            }
            Self::Histogram { edges, shares } => {
                check_increasing("the list of ends of the histogram", edges)?;
                check_length("the histogram", shares.len(), edges.len().saturating_sub(1))?;
                check_bounds("the histogram", shares)
            }
            Self::Scatter { points, .. } => check_finite("a scatter plot", points.iter().flat_map(|p| &p.at)),
            Self::Bars { values } => check_finite("the list of bars", values),
        }
    }

    /// The places that its points link to.
    pub(super) fn places(&self) -> impl Iterator<Item = PlaceId> {
        let points = match self {
            Self::Scatter { points, .. } => points.as_slice(),
            _ => &[],
        };
        points.iter().filter_map(|point| point.place)
    }
}
