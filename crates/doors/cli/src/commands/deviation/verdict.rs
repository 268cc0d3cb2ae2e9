//! Whether two meshes are within a tolerance.

use super::bands;
use super::full::percentage;
use super::run::{Outcome, directions, percent};
use crate::exit::Exit;
use crate::numbers::shortest;
use crate::page::brief;
use pompeiu::hausdorff::Enclosure;
use pompeiu::hausdorff::deviation::{Deviation, DirectedDeviation};
use serde::Serialize;

/// The answer to the question whether both surfaces are within a tolerance of each other.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) enum Answer {
    /// Proven to be within.
    Within,
    /// Proven not to be.
    Out,
    /// The intervals are too wide to tell.
    Undecided,
}

impl Answer {
    /// Of both surfaces.
    pub(super) fn of_both(answers: [Self; 2]) -> Self {
        match answers {
            [Self::Within, Self::Within] => Self::Within,
            both if both.contains(&Self::Out) => Self::Out,
            _ => Self::Undecided,
        }
    }
}

/// The question and its answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct Verdict {
    /// Whether both surfaces are within the threshold of each other, or in the bands, but for the share of each that is allowed.
    pub(super) answer: Answer,
    /// The share of the area of each surface that may be outside.
    pub(super) allowed: f64,
}

impl Verdict {
    /// With nothing allowed, the largest distance decides; else the shares of the areas that are farther. A surface without area has
    /// no share that is farther.
    pub(super) fn of(deviation: &Deviation, threshold: f64, allowed: f64) -> Self {
        let answer = if allowed == 0.0 {
            answer(deviation.distance, threshold)
        } else {
            let shares = directions(deviation)
                .map(|(_, directed)| share(directed).map_or(Answer::Within, |share| answer(share, allowed)));
            Answer::of_both(shares)
        };
        Self { answer, allowed }
    }

    pub(super) fn exit(self) -> Exit {
        match self.answer {
            Answer::Within => Exit::Done,
            Answer::Out => Exit::Above,
            Answer::Undecided => Exit::Undecided,
        }
    }

    /// The sentence that a person acts on.
    pub(super) fn sentence(self, outcome: &Outcome) -> String {
        let head = match self.answer {
            Answer::Within => "WITHIN TOLERANCE",
            Answer::Out => "OUT OF TOLERANCE",
            Answer::Undecided => "UNDECIDED AT TOLERANCE",
        };
        let unit = &outcome.unit;
        let length = |text: String| if unit.is_empty() { text } else { format!("{text} {unit}") };
        let allowed = match self.allowed {
            0.0 => String::new(),
            share => format!(" ({} % of each area may be)", percent(share)),
        };
        match (&outcome.bands, outcome.threshold) {
            (Some(found), _) => {
                let is_within = self.answer == Answer::Within && self.allowed == 0.0;
                format!("{head} {}{allowed}", bands::sentence(found, outcome.names, &length, is_within))
            }
            (None, threshold) => {
                let threshold = threshold.unwrap_or(0.0);
                format!("{head} {}", self.beyond(outcome, threshold, &length, &allowed))
            }
        }
    }

    /// What is farther than the threshold.
    fn beyond(
        self,
        Outcome { deviation, names, .. }: &Outcome,
        threshold: f64,
        length: &dyn Fn(String) -> String,
        allowed: &str,
    ) -> String {
        let of = |name: &str, (_, directed): (&str, &DirectedDeviation)| match share(directed) {
            Some(share) => format!("{} of {name}'s area", percentage(share)),
            None => format!("{name} has no area"),
        };
        let [a, b] = directions(deviation);
        let is_free = |(_, directed): (&str, &DirectedDeviation)| {
            share(directed).is_none_or(|share| share.upper() == 0.0)
        };
        let (threshold, worst) = (length(shortest(threshold)), length(brief(deviation.distance)));
        if self.answer == Answer::Within && is_free(a) && is_free(b) {
            return format!("{threshold}: nothing is beyond it; worst {worst}");
        }
        let [left, right] = [of(names[0], a), of(names[1], b)];
        format!("{threshold}: beyond it {left}, {right}{allowed}; worst {worst}")
    }
}

fn share(directed: &DirectedDeviation) -> Option<Enclosure> {
    directed.statistics.as_ref()?.above.as_ref().map(|above| above.share)
}

/// Whether an enclosed value is at most a bound.
pub(super) fn answer(found: Enclosure, most: f64) -> Answer {
    if found.upper() <= most {
        Answer::Within
    } else if found.lower() > most {
        Answer::Out
    } else {
        Answer::Undecided
    }
}
