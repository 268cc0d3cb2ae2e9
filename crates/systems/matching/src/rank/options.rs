//! What is asked for.

use crate::align::{AlignError, Alignment};
use crate::tasks::TaskObserver;
use pompeiu_core::run::Limits;
use pompeiu_hausdorff::{OptionError, Tolerance};
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

/// How to rank. Serialised without what a run may take, which is no part of the question.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RankOptions<'o> {
    /// Which distance.
    pub measure: Measure,
    /// How targets may be moved onto the template first.
    pub alignment: Alignment,
    /// How many of the best are wanted; those that tie with the last come too.
    pub top: usize,
    /// Whether every target gets its full enclosure and rank, not only the best.
    pub all: bool,
    /// Width of a full enclosure; the joint box is that of the template and a target.
    #[serde(flatten)]
    pub tolerance: Tolerance,
    /// Time, memory and threads. Preparing the template and aligning a target are not interrupted. The limits on memory and
    /// on pieces apply to each search; with a memory limit, targets are searched one after another.
    #[serde(skip)]
    pub limits: Limits,
    /// Watches the ranking.
    #[serde(skip)]
    pub observer: Option<&'o dyn TaskObserver>,
}

impl Default for RankOptions<'_> {
    /// The ten best by symmetric distance, as they lie, to the default tolerance of a search.
    fn default() -> Self {
        Self {
            measure: Measure::Symmetric,
            alignment: Alignment::None,
            top: 10,
            all: false,
            tolerance: Tolerance::default(),
            limits: Limits::default(),
            observer: None,
        }
    }
}

/// Tolerances on the way to the one asked for, fractions of the joint diagonal. The first is to tell most targets apart, the second most of the others; a
/// search starts anew at each, so that more of them would cost more than they discard.
const ON_THE_WAY: [f64; 2] = [1e-2, 1e-4];

impl RankOptions<'_> {
    /// Whether the numbers make sense.
    ///
    /// # Errors
    /// [`RankError::NoPlaces`], [`RankError::Option`].
    pub fn check(&self) -> Result<(), RankError> {
        if self.top == 0 {
            return Err(RankError::NoPlaces);
        }
        self.tolerance.check()?;
        Ok(())
    }

    /// The tolerances of searches, the last the one asked for. Fractions of the diagonal descend; which others are wider
    /// differs from target to target.
    pub(super) fn tolerances(&self) -> Vec<Tolerance> {
        let coarser = |t: &f64| match self.tolerance {
            Tolerance::RelativeToDiagonal(asked) => *t > asked,
            Tolerance::RelativeToDistance(_) | Tolerance::Absolute(_) => true,
        };
        let on_the_way = ON_THE_WAY.into_iter().filter(|t| !self.all && coarser(t));
        on_the_way.map(Tolerance::RelativeToDiagonal).chain([self.tolerance]).collect()
    }
}

/// What cannot be ranked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RankError {
    /// At least one place must be asked for.
    #[error("the number of places asked for is 0; at least 1 is needed")]
    NoPlaces,
    /// An option of the searches cannot be used.
    #[error(transparent)]
    Option(#[from] OptionError),
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
