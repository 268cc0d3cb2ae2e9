//! What is answered.

use crate::certificate::CertificateAnswer;
use crate::deviation::{BandReport, Deviation, DirectedDeviation, LeftOut};
use crate::{Direction, Enclosure, PreparedPair, StopReason};
use pompeiu_core::request::{Conclusion, Report};

/// How far two meshes deviate from each other, and whether that is within a tolerance. Lengths are in the unit of the meshes; faces have the
/// numbers that they have in the files, though parts were left out.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct DeviationReport {
    /// The length beyond which shares and regions were asked for; absent if none was.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub threshold: Option<f64>,
    /// Whether both surfaces are within the threshold or the bands; absent without either.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub verdict: Option<Verdict>,
    /// The share of the area in each tolerance band; absent if there is none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub bands: Option<BandReport>,
    /// The parts that were left out of both; absent if none were to be.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub left_out: Option<BothLeftOut>,
    /// Small parts of which alone the largest distance is, of A and of B.
    pub outliers: Vec<Outlier>,
    /// The outcome of the certificate; absent if none was requested.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub certificate: Option<CertificateAnswer>,
    /// The deviation.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub deviation: Deviation,
}

/// The parts that were left out of each mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct BothLeftOut {
    /// Of A.
    pub a: LeftOut,
    /// Of B.
    pub b: LeftOut,
}

/// A connected part with little of the area, of which the largest distance is, while everything else is within half of it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Outlier {
    /// The direction whose largest distance it is.
    pub direction: Direction,
    /// Its share of the area of the mesh, rounded.
    pub share: f64,
    /// All larger parts are within this distance.
    pub others_within: f64,
}

/// Shares of the area below which a component is probably junk.
const JUNK: f64 = 0.01;

/// The outliers of both directions, before faces are renumbered.
pub(super) fn outliers(deviation: &Deviation, pair: &PreparedPair<'_>) -> Vec<Outlier> {
    let of = |found: &DirectedDeviation| {
        // Parts are not looked for when the time is over, and of wide enclosures little is known.
        if found.first_stop().is_early() {
            return None;
        }
        let (share, others_within) = found.outlying_component(pair.measured(found.direction), JUNK)?;
        Some(Outlier { direction: found.direction, share, others_within })
    };
    [&deviation.a_to_b, &deviation.b_to_a].into_iter().filter_map(of).collect()
}

impl DirectedDeviation {
    /// Why the work ended: of the search for the largest distance or of the statistics, whichever a limit ended first.
    pub fn first_stop(&self) -> StopReason {
        if self.distance.stop.is_early() { self.distance.stop } else { self.stop }
    }
}

impl Report for DeviationReport {
    /// The reason of the direction that ended early, if one did.
    fn stop(&self) -> StopReason {
        let reasons = [self.deviation.a_to_b.first_stop(), self.deviation.b_to_a.first_stop()];
        let of_bands = self.bands.iter().flat_map(|bands| [bands.a_to_b.stop, bands.b_to_a.stop]);
        let early = reasons.into_iter().chain(of_bands).find(|stop| stop.is_early());
        early
            .or_else(|| reasons.into_iter().find(|stop| *stop != StopReason::Tolerance))
            .unwrap_or(reasons[0])
    }

    /// A question about a tolerance is answered or not; otherwise limits decide.
    fn conclusion(&self) -> Conclusion {
        let conclusion = match &self.verdict {
            Some(verdict) => verdict.conclusion(),
            None if self.stop().is_early() => Conclusion::Incomplete,
            None => Conclusion::AsAsked,
        };
        let is_unproven = self.certificate.as_ref().is_some_and(|answer| answer.written.is_none());
        if is_unproven && conclusion == Conclusion::AsAsked { Conclusion::Incomplete } else { conclusion }
    }
}

/// The answer to the question whether both surfaces are within a tolerance of each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "snake_case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum VerdictAnswer {
    /// Proven to be within.
    Within,
    /// Proven not to be.
    Out,
    /// The intervals are too wide to tell.
    Undecided,
}

impl VerdictAnswer {
    /// Of both surfaces.
    pub(super) fn of_both(answers: [Self; 2]) -> Self {
        match answers {
            [Self::Within, Self::Within] => Self::Within,
            both if both.contains(&Self::Out) => Self::Out,
            _ => Self::Undecided,
        }
    }

    /// Whether an enclosed value is at most a bound.
    pub(super) fn of(found: Enclosure, most: f64) -> Self {
        if found.upper() <= most {
            Self::Within
        } else if found.lower() > most {
            Self::Out
        } else {
            Self::Undecided
        }
    }
}

/// The question whether both surfaces are within a tolerance of each other, and its answer.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Verdict {
    /// Whether both surfaces are within the threshold of each other, or in the bands, but for the share of each that is allowed.
    pub answer: VerdictAnswer,
    /// The share of the area of each surface that may be outside.
    pub allowed: f64,
    /// The answer in a sentence, with the tolerance, what is outside of it and the worst place.
    pub sentence: String,
}

impl Verdict {
    /// What follows from it.
    pub(super) fn conclusion(&self) -> Conclusion {
        match self.answer {
            VerdictAnswer::Within => Conclusion::AsAsked,
            VerdictAnswer::Out => Conclusion::Refuted,
            VerdictAnswer::Undecided => Conclusion::Incomplete,
        }
    }
}
