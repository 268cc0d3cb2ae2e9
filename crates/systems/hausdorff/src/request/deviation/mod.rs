//! What can be asked of how far two meshes deviate: where, over how much of the area, on which side, and whether that is within a tolerance.

mod error;
mod measures;
mod parts;
mod report;
mod verdict;

pub use error::DeviationRequestError;
pub use measures::{DeviationMeasures, DirectedDeviationReport};
pub use parts::{MeasuredParts, NamedFaces};
pub use report::{BothLeftOut, DeviationReport, Outlier, Verdict, VerdictAnswer};

use super::watch::Watch;
use crate::deviation::Bands;
use crate::{Observer, PreparedPair};
use pompeiu_core::geom::Aabb;
use pompeiu_core::request::{Band, Limit, Request};
use pompeiu_core::run::{Limits, RunContext};

#[cfg(feature = "clap")]
use pompeiu_core::request::values::share;

/// Show how far two meshes deviate: where, on which side, over how much of the area.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DeviationRequest {
    /// What is measured.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub measures: DeviationMeasures,
    /// Say whether B deviates from A by no less and no more than this, such as -0.05..0.1: negative where B lacks something, positive where
    /// it has more; several bands make classes, and what is in none is too low or too high.
    #[cfg_attr(feature = "clap", arg(long = "band", allow_hyphen_values = true, value_name = "LOW..HIGH"))]
    pub bands: Vec<Band>,
    /// The share of each area that may be farther than the threshold, or outside of all bands, such as 0.01.
    #[cfg_attr(feature = "clap", arg(long, value_parser = share, value_name = "SHARE"))]
    pub allow: Option<f64>,
    /// What is left out.
    #[cfg_attr(feature = "clap", command(flatten))]
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub parts: MeasuredParts,
}

impl Request for DeviationRequest {
    const NAME: &'static str = "deviation";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time, Limit::Memory];
    type Report = DeviationReport;
}

impl DeviationRequest {
    /// Whether the options make sense together, before anything is computed.
    ///
    /// # Errors
    /// [`DeviationRequestError`].
    pub fn check(&self) -> Result<(), DeviationRequestError> {
        self.measures.options(1.0)?.check()?;
        self.tolerance_bands()?;
        if self.measures.threshold.is_some() && !self.bands.is_empty() {
            return Err(DeviationRequestError::TwoTolerances);
        }
        if self.allow.is_some() && self.measures.threshold.is_none() && self.bands.is_empty() {
            return Err(DeviationRequestError::NothingAllowed);
        }
        match self.allow {
            Some(share) if !(share > 0.0 && share <= 1.0) => Err(DeviationRequestError::Allowed(share)),
            _ => self.parts.check(&self.measures.unit),
        }
    }

    /// The tolerance bands in the unit of the meshes, if there are any.
    fn tolerance_bands(&self) -> Result<Option<Bands>, DeviationRequestError> {
        if self.bands.is_empty() {
            return Ok(None);
        }
        let ends: Vec<[f64; 2]> =
            self.bands.iter().map(|band| band.in_unit(&self.measures.unit)).collect::<Result<_, _>>()?;
        Ok(Some(Bands::new(&ends)?))
    }

    /// Measures a pair, or the parts of it that are asked for. The pair is given back with these parts, and with the trees that were made, for
    /// figures. `groups` are the named faces of A and of B, if their files name some. An observer sees how far the work has come, beside that
    /// of the context.
    ///
    /// # Errors
    /// [`DeviationRequestError`].
    pub fn run<'m>(
        &self,
        pair: PreparedPair<'m>,
        groups: [&[NamedFaces]; 2],
        context: &RunContext<'_>,
        observer: Option<&dyn Observer>,
    ) -> Result<(PreparedPair<'m>, DeviationReport), DeviationRequestError> {
        self.check()?;
        let watch = Watch::new(context, observer);
        let bands = self.tolerance_bands()?;
        let pair = if bands.is_some() { pair.keeping(true) } else { pair };
        let diagonal = Aabb::of_faces(pair.a()).union(Aabb::of_faces(pair.b())).diagonal();
        let mut options = self.measures.options(diagonal)?;
        let chosen = self.parts.choose(&pair, groups, &self.measures.unit, &context.limits(), &watch)?;
        let left_out = chosen.as_ref().map(|[a, b]| BothLeftOut { a: a.left_out, b: b.left_out });
        let pair = match chosen {
            Some(parts) => pair.with_parts(parts),
            None => pair,
        };
        options.limits = Limits { pieces: self.measures.most_pieces, ..context.limits() };
        options.signed |= bands.is_some();
        options.observer = Some(&watch);
        let mut deviation = options.symmetric_of(&pair)?;
        let accuracy = options.accuracy;
        let bands =
            bands.map(|bands| deviation.bands_of(&pair, &bands, accuracy, &context.limits(), Some(&watch)));
        let outliers = report::outliers(&deviation, &pair);
        if let Some([a, b]) = pair.parts() {
            deviation.a_to_b.renumber(a, pair.a());
            deviation.b_to_a.renumber(b, pair.b());
        }
        let threshold = options.threshold;
        let mut report = DeviationReport {
            threshold,
            verdict: None,
            bands,
            left_out,
            outliers,
            certificate: None,
            deviation,
        };
        report.judge(self.allow.unwrap_or(0.0), &self.measures.unit);
        Ok((pair, report))
    }
}
