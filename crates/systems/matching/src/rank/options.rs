//! What is asked for.

use crate::align::{AlignError, Alignment};
use serde::{Deserialize, Serialize};

/// Which distance ranks the targets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Measure {
    /// `H`, the larger of the two directed distances.
    #[default]
    Symmetric,
    /// How far the template's points are from the target: is the template a part of it?
    TemplateToTarget,
    /// How far the target's points are from the template: is it a part of the template?
    TargetToTemplate,
}

impl Measure {
    /// Whether distances of the target's points from the template count.
    pub(super) fn has_target_to_template(self) -> bool {
        self != Self::TemplateToTarget
    }

    /// Whether distances of the template's points from the target count.
    pub(super) fn has_template_to_target(self) -> bool {
        self != Self::TargetToTemplate
    }
}

/// How to rank.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Options {
    /// Which distance.
    pub measure: Measure,
    /// How targets may be moved onto the template first.
    pub alignment: Alignment,
    /// How many of the best are wanted; those that tie with the last come too.
    pub top: usize,
    /// Whether every target gets its full enclosure and rank, not only the best.
    pub all: bool,
    /// Width of a full enclosure, as a fraction of the diagonal of the joint box of template and target.
    pub tolerance: f64,
}

impl Default for Options {
    /// The ten best by symmetric distance, as they lie, to the default tolerance of a search.
    fn default() -> Self {
        Self {
            measure: Measure::Symmetric,
            alignment: Alignment::None,
            top: 10,
            all: false,
            tolerance: pompeiu_hausdorff::Tolerance::DEFAULT_FRACTION,
        }
    }
}

/// Tolerances on the way to the one asked for. The first is to tell most targets apart, the second most of the others; a
/// search starts anew at each, so that more of them would cost more than they discard.
const ON_THE_WAY: [f64; 2] = [1e-2, 1e-4];

impl Options {
    /// Whether the numbers make sense.
    ///
    /// # Errors
    /// [`RankError::NoPlaces`], [`RankError::Tolerance`].
    pub fn check(&self) -> Result<(), RankError> {
        if self.top == 0 {
            return Err(RankError::NoPlaces);
        }
        if !(0.0..f64::INFINITY).contains(&self.tolerance) {
            return Err(RankError::Tolerance(self.tolerance));
        }
        Ok(())
    }

    /// The tolerances of searches, descending, the last the one asked for.
    pub(super) fn tolerances(&self) -> Vec<f64> {
        let coarser = |t: &f64| *t > self.tolerance && !self.all;
        ON_THE_WAY.into_iter().filter(coarser).chain([self.tolerance]).collect()
    }
}

/// What cannot be ranked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RankError {
    /// Nobody wants none.
    #[error("the number of places asked for is 0; at least 1 is needed")]
    NoPlaces,
    /// The tolerance is negative or not a finite number.
    #[error("the tolerance is {0}; it must be a finite number that is not negative")]
    Tolerance(f64),
    /// There is nothing to rank.
    #[error("there are no targets; at least 1 is needed")]
    NoTargets,
    /// The template cannot be aligned to.
    #[error("the template cannot be aligned to: {0}")]
    Template(AlignError),
    /// The results handed back are not those of the round.
    #[error("the round has {expected} tasks, but {found} results were handed back")]
    Results {
        /// Tasks of the round.
        expected: usize,
        /// Results.
        found: usize,
    },
    /// A result does not answer its task.
    #[error("the result for target {target} does not answer what was asked of it")]
    Answer {
        /// The target, counted from 0.
        target: usize,
    },
}
