//! Charts.

use super::error::{check_bounds, check_finite, check_increasing, check_length};
use super::{PageError, PlaceId, PlayerId, ScaleId, Text};
use serde::Serialize;

/// A chart. What is proven is drawn full, what is possible lighter.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Chart {
    /// A name that scripts and tests find it by; may be empty.
    pub key: String,
    /// What it shows, in a sentence.
    pub title: Text,
    /// The horizontal axis.
    pub x: ChartAxis,
    /// The vertical axis.
    pub y: ChartAxis,
    /// What is drawn, the first one at the bottom.
    pub series: Vec<Series>,
    /// The scale that values along the horizontal axis belong to: its threshold is marked, and histograms have its colours.
    pub scale: Option<ScaleId>,
    /// Whether a click sets the threshold of that scale.
    pub sets_threshold: bool,
    /// The player whose steps are the entries of lines, points and bars: the present one is marked, and a click goes to another one.
    pub player: Option<PlayerId>,
}

/// An axis of a chart.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ChartAxis {
    /// What is along it, with the unit.
    pub label: String,
    /// Whether equal lengths are equal factors. What is not positive is left out then.
    pub logarithmic: bool,
    /// Whether numbers are fractions, to be shown as per cent.
    pub percent: bool,
    /// Where it begins; without that, at the least value.
    pub low: Option<f64>,
    /// Where it ends; without that, at the greatest value.
    pub high: Option<f64>,
}

/// Something drawn in a chart.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "camelCase")]
pub enum Series {
    /// A curve through points.
    Line {
        /// What it is; shown where there are several.
        label: String,
        /// Places, increasing.
        x: Vec<f64>,
        /// Values there.
        y: Vec<f64>,
    },
    /// A curve that is only known to lie between two others.
    Band {
        /// What it is; shown where there are several.
        label: String,
        /// Places, increasing.
        x: Vec<f64>,
        /// Enclosures of the values there.
        y: Vec<[f64; 2]>,
        /// Whether the curve never rises, so that between two places it lies in the box of their enclosures.
        falling: bool,
    },
    /// Shares by value.
    Histogram {
        /// Ends of the bins, increasing, one more than there are bins.
        edges: Vec<f64>,
        /// Enclosures of the shares.
        shares: Vec<[f64; 2]>,
    },
    /// Points.
    Scatter {
        /// What they are; shown where there are several.
        label: String,
        /// The points.
        points: Vec<ScatterPoint>,
    },
    /// A bar for each step of the player. It needs no other series and no horizontal axis beside it.
    Bars {
        /// Their heights.
        values: Vec<f64>,
    },
}

/// A point of a scatter plot.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ScatterPoint {
    /// Where it is.
    pub at: [f64; 2],
    /// What it is.
    pub label: String,
    /// Where it leads.
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

    /// The places that its points lead to.
    pub(super) fn places(&self) -> impl Iterator<Item = PlaceId> {
        let points = match self {
            Self::Scatter { points, .. } => points.as_slice(),
            _ => &[],
        };
        points.iter().filter_map(|point| point.place)
    }
}
