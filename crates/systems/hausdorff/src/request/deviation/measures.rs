//! What is measured of a deviation, and how narrow it is enclosed.

use super::super::watch::Watch;
use super::DeviationRequestError;
use crate::deviation::{DeviationOptions, DirectedDeviation};
use crate::{Observer, StopReason};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::request::{Length, Limit, Report, Request};
use pompeiu_core::run::{Limits, RunContext};

#[cfg(feature = "clap")]
use pompeiu_core::request::values::fraction;

/// Percentages of an area.
type Percentiles = Vec<f64>;

/// The least percentile: what is below is a share that was meant as one.
const LEAST_PERCENTILE: f64 = 1.0;

/// Measure how far one mesh deviates from another one.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DeviationMeasures {
    /// Say whether both are within this length of each other, such as 0.1, 0.1mm with the unit given, or 0.5% of the diagonal of both meshes; enclose the
    /// share of the area that is farther, and list the regions beyond it.
    #[cfg_attr(
        feature = "clap",
        arg(long = "within", alias = "threshold", allow_negative_numbers = true, value_name = "LENGTH")
    )]
    pub threshold: Option<Length>,
    /// Tell inside from outside whatever the surfaces are, by generalised winding numbers: distances inside the other mesh are shown negative. Where
    /// both surfaces are closed and oriented, and few of their faces intersect, that is the default.
    #[cfg_attr(feature = "clap", arg(long))]
    pub signed: bool,
    /// Do not tell inside from outside unless tolerance bands ask for it.
    #[cfg_attr(feature = "clap", arg(long, conflicts_with = "signed"))]
    pub unsigned: bool,
    /// Largest width of the intervals of mean, root mean square and percentiles, relative to their values; widths below 1e-9 of the diagonal of
    /// both meshes always suffice.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = fraction, allow_negative_numbers = true, value_name = "X")
    )]
    pub accuracy: f64,
    /// Percentiles to enclose, in percent of the area, such as 50 for the median.
    #[cfg_attr(feature = "clap", arg(long, value_parser = percentiles, value_name = "LIST"))]
    pub percentiles: Percentiles,
    /// Bins of the histogram.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub bins: usize,
    /// The number of worst regions to list.
    #[cfg_attr(feature = "clap", arg(long, value_name = "K"))]
    pub regions: usize,
    /// Pieces that the faces of a mesh may be cut into before intervals stay wider than asked; by default 4,000,000, or twelve for each face of
    /// both meshes if that is more.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub most_pieces: Option<usize>,
    /// The unit of the coordinates, such as mm; files have none.
    #[cfg_attr(feature = "clap", arg(long, value_name = "NAME"))]
    pub unit: String,
}

impl Default for DeviationMeasures {
    fn default() -> Self {
        let DeviationOptions { accuracy, percentiles, bins, regions, signed, .. } =
            DeviationOptions::default();
        let percentiles = percentiles.into_iter().map(|share| (share * 1e12).round() / 1e10).collect();
        let unit = String::new();
        Self {
            threshold: None,
            signed,
            unsigned: false,
            accuracy,
            percentiles,
            bins,
            regions,
            most_pieces: None,
            unit,
        }
    }
}

impl Request for DeviationMeasures {
    const NAME: &'static str = "directed_deviation";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time, Limit::Memory];
    type Report = DirectedDeviationReport;
}

/// How far one mesh deviates from another one. Lengths are in the unit of the meshes.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DirectedDeviationReport {
    /// The length beyond which shares and regions were asked for; null if none was.
    pub threshold: Option<f64>,
    /// The deviation.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub deviation: DirectedDeviation,
}

impl Report for DirectedDeviationReport {
    fn stop(&self) -> StopReason {
        self.deviation.first_stop()
    }
}

impl DeviationMeasures {
    /// The options of the analysis of meshes whose joint box has this diagonal, without limits of a context and without an observer.
    ///
    /// # Errors
    /// [`DeviationRequestError::Length`], [`DeviationRequestError::Percentile`] and [`DeviationRequestError::SignedAndUnsigned`].
    pub fn options(&self, diagonal: f64) -> Result<DeviationOptions<'static>, DeviationRequestError> {
        let wrong = |percent: &&f64| !(LEAST_PERCENTILE..100.0).contains(*percent);
        if let Some(percent) = self.percentiles.iter().find(wrong) {
            return Err(DeviationRequestError::Percentile(*percent));
        }
        if self.signed && self.unsigned {
            return Err(DeviationRequestError::SignedAndUnsigned);
        }
        Ok(DeviationOptions {
            accuracy: self.accuracy,
            threshold: self.threshold.as_ref().map(|length| length.of(&self.unit, diagonal)).transpose()?,
            percentiles: self.percentiles.iter().map(|percent| percent / 100.0).collect(),
            bins: self.bins,
            regions: self.regions,
            signed: self.signed,
            signed_where_closed: !self.unsigned,
            limits: Limits { pieces: self.most_pieces, ..Limits::default() },
            observer: None,
        })
    }

    /// Measures how far A is from B.
    ///
    /// # Errors
    /// [`DeviationRequestError`].
    pub fn run(
        &self,
        a: &TriMesh,
        b: &TriMesh,
        context: &RunContext<'_>,
        observer: Option<&dyn Observer>,
    ) -> Result<DirectedDeviationReport, DeviationRequestError> {
        let watch = Watch::new(context, observer);
        let options = self.options(Aabb::of_faces(a).union(Aabb::of_faces(b)).diagonal())?;
        let limits = Limits { pieces: self.most_pieces, ..context.limits() };
        let options = DeviationOptions { limits, observer: Some(&watch), ..options };
        let deviation = options.directed(a, b)?;
        Ok(DirectedDeviationReport { threshold: options.threshold, deviation })
    }
}

/// Percentages, separated by commas.
#[cfg(feature = "clap")]
fn percentiles(text: &str) -> Result<Percentiles, String> {
    let percentage = |part: &str| match part.trim().parse::<f64>() {
        Ok(percent) if (LEAST_PERCENTILE..100.0).contains(&percent) => Ok(percent),
        _ => Err(format!("`{part}` is not a percentage of at least 1 and below 100")),
    };
    text.split(',').map(percentage).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[cfg(feature = "clap")]
    #[test]
    fn percentages_lie_between_1_and_100() {
        assert_eq!(percentiles("50, 99.5").unwrap(), [50.0, 99.5]);
        for wrong in ["0", "0.5", "100", "nan", "", "50,,90", "-1"] {
            assert!(percentiles(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn percentages_become_shares_and_shares_are_refused() {
        let options = DeviationMeasures::default().options(1.0).unwrap();
        assert_eq!(options.percentiles, DeviationOptions::DEFAULT_PERCENTILES);
        for wrong in [0.5, 100.0, f64::NAN] {
            let measures = DeviationMeasures { percentiles: vec![50.0, wrong], ..Default::default() };
            assert!(measures.options(1.0).is_err(), "{wrong}");
        }
        let both = DeviationMeasures { signed: true, unsigned: true, ..Default::default() };
        assert!(both.options(1.0).is_err());
    }
}
