//! Options of a ranking.

use crate::align::{AlignError, Alignment};
use crate::tasks::TaskObserver;
use pompeiu_core::run::Limits;
use pompeiu_hausdorff::{OptionError, Tolerance};
use serde::{Deserialize, Serialize};

/// The distance by which targets are ranked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Measure {
    /// The symmetric distance, the larger of the two directed ones.
    #[default]
    Both,
    /// The distance of the template from the target: finds shapes of which the template is a part.
    FromTemplate,
    /// The distance of the target from the template: finds parts of the template.
    ToTemplate,
}

impl Measure {
    /// Whether the directed distance from target to template is needed.
    pub(super) fn has_target_to_template(self) -> bool {
        self != Self::FromTemplate
    }

    /// Whether the directed distance from template to target is needed.
    pub(super) fn has_template_to_target(self) -> bool {
        self != Self::ToTemplate
    }
}

/// Options of a ranking.
#[derive(Clone, Debug)]
pub struct RankOptions<'o> {
    /// The distance.
    pub measure: Measure,
    /// The maps allowed for aligning targets to the template first.
    pub alignment: Alignment,
    /// The number of best targets to report; ties with the last are reported, too.
    pub top: usize,
    /// Whether every target gets its full enclosure and rank, not only the best.
    pub all: bool,
    /// Width of a full enclosure. The joint box is that of the template and a target.
    pub tolerance: Tolerance,
    /// Time, memory and threads. Preparing the template and aligning a target are not interrupted. The limits on memory and
    /// on pieces apply to each search; with a memory limit, targets are searched one after another.
    pub limits: Limits,
    /// Receives progress.
    pub observer: Option<&'o dyn TaskObserver>,
}

impl Default for RankOptions<'_> {
    /// The ten best by symmetric distance, without alignment, with the default tolerance of a search.
    fn default() -> Self {
        Self {
            measure: Measure::Both,
            alignment: Alignment::None,
            top: 10,
            all: false,
            tolerance: Tolerance::default(),
            limits: Limits::default(),
            observer: None,
        }
    }
}

/// Intermediate tolerances, relative to the joint diagonal. The first separates most targets, the second most of the rest. A search
/// starts anew at each, so more of them would cost more than they save.
const ON_THE_WAY: [f64; 2] = [1e-2, 1e-4];

impl RankOptions<'_> {
    /// Checks that the options are valid.
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

    /// The tolerances of searches; the last is the requested one. Relative tolerances decrease; whether an absolute one is wider
    /// depends on the target.
    pub(super) fn tolerances(&self) -> Vec<Tolerance> {
        let coarser = |t: &f64| match self.tolerance {
            Tolerance::RelativeToDiagonal(asked) => *t > asked,
            Tolerance::RelativeToDistance(_) | Tolerance::Absolute(_) => true,
        };
        let on_the_way = ON_THE_WAY.into_iter().filter(|t| !self.all && coarser(t));
        on_the_way.map(Tolerance::RelativeToDiagonal).chain([self.tolerance]).collect()
    }
}

/// Errors of a ranking.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RankError {
    /// No ranks were requested.
    #[error("the number of places asked for is 0; at least 1 is needed")]
    NoPlaces,
    /// An option of the searches is invalid.
    #[error(transparent)]
    Option(#[from] OptionError),
    /// No target can be used.
    #[error("none of the {count} targets can be used; the first: {first}")]
    NoneUsable {
        /// Number of targets.
        count: usize,
        /// What is wrong with the first of them.
        first: String,
    },
    /// There are no targets.
    #[error("there are no targets; at least 1 is needed")]
    NoTargets,
    /// No mesh can be aligned to the template.
    #[error("the template cannot be aligned to: {0}")]
    Template(AlignError),
    /// The number of results differs from that of tasks.
    #[error("the round has {expected} tasks, but {found} results were handed back")]
    Results {
        /// Tasks of the round.
        expected: usize,
        /// Results.
        found: usize,
    },
    /// A result does not match its task.
    #[error("the result for target {target} does not answer what was asked of it")]
    Answer {
        /// The target, counted from 0.
        target: usize,
    },
}
