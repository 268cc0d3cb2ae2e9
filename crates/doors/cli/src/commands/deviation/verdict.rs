//! Whether two meshes are within a tolerance.

use super::full::percentage;
use super::run::{directions, percent};
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

/// The question and its answer.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(test, derive(schemars::JsonSchema))]
pub(super) struct Verdict {
    /// Whether both surfaces are within the threshold of each other, but for the share of each that is allowed.
    pub(super) answer: Answer,
    /// The share of the area of each surface that may be farther.
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
            match shares {
                [Answer::Within, Answer::Within] => Answer::Within,
                both if both.contains(&Answer::Out) => Answer::Out,
                _ => Answer::Undecided,
            }
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
    pub(super) fn sentence(
        self,
        deviation: &Deviation,
        threshold: f64,
        unit: &str,
        names: [&str; 2],
    ) -> String {
        let head = match self.answer {
            Answer::Within => "WITHIN TOLERANCE",
            Answer::Out => "OUT OF TOLERANCE",
            Answer::Undecided => "UNDECIDED AT TOLERANCE",
        };
        let length = |text: String| if unit.is_empty() { text } else { format!("{text} {unit}") };
        let allowed = match self.allowed {
            0.0 => String::new(),
            share => format!(" ({} % of each area may be)", percent(share)),
        };
        let of = |name: &str, (_, directed): (&str, &DirectedDeviation)| match share(directed) {
            Some(share) => format!("{} of {name}'s area", percentage(share)),
            None => format!("{name} has no area"),
        };
        let [a, b] = directions(deviation);
        let is_free = |(_, directed): (&str, &DirectedDeviation)| {
            share(directed).is_none_or(|share| share.upper() == 0.0)
        };
        if self.answer == Answer::Within && is_free(a) && is_free(b) {
            return format!(
                "{head} {}: nothing is beyond it; worst {}",
                length(shortest(threshold)),
                length(brief(deviation.distance))
            );
        }
        format!(
            "{head} {}: beyond it {}, {}{allowed}; worst {}",
            length(shortest(threshold)),
            of(names[0], a),
            of(names[1], b),
            length(brief(deviation.distance))
        )
    }
}

fn share(directed: &DirectedDeviation) -> Option<Enclosure> {
    directed.statistics.as_ref()?.above.as_ref().map(|above| above.share)
}

/// Whether an enclosed value is at most a bound.
fn answer(found: Enclosure, most: f64) -> Answer {
    if found.upper() <= most {
        Answer::Within
    } else if found.lower() > most {
        Answer::Out
    } else {
        Answer::Undecided
    }
}
