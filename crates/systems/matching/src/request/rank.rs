//! Which of many meshes is nearest to a template.

use crate::align::Alignment;
use crate::rank::{Kind, Measure, RankError, RankOptions, Report as Standings, Row, Work, rank};
use crate::{Meshes, TaskObserver};
use pompeiu_core::TriMesh;
use pompeiu_core::request::{Conclusion, Limit, Report, Request};
use pompeiu_core::run::{RunContext, StopReason};
use pompeiu_hausdorff::{Tolerance, ToleranceKind};
use serde::{Deserialize, Serialize};

#[cfg(feature = "clap")]
use pompeiu_core::request::values::magnitude;

/// Rank meshes by their distance from a template.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct RankRequest {
    /// The number of the best to find; those that tie with the last are reported, too.
    #[cfg_attr(feature = "clap", arg(long, value_parser = clap::value_parser!(u32).range(1..), value_name = "K"))]
    pub top: u32,
    /// Measure every target in full.
    #[cfg_attr(feature = "clap", arg(long))]
    pub all: bool,
    /// The distance to rank by.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub direction: Measure,
    /// The alignment of targets with the template before the distance; distances are then those of the targets as moved.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub align: Alignment,
    /// Largest width of the proven intervals.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = magnitude, allow_negative_numbers = true, value_name = "X")
    )]
    pub tolerance: f64,
    /// The unit of the tolerance.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub tolerance_kind: ToleranceKind,
}

impl Default for RankRequest {
    fn default() -> Self {
        Self {
            top: 10,
            all: false,
            direction: Measure::default(),
            align: Alignment::default(),
            tolerance: Tolerance::DEFAULT_FRACTION,
            tolerance_kind: ToleranceKind::default(),
        }
    }
}

impl Request for RankRequest {
    const NAME: &'static str = "rank";
    const LIMITS: &'static [Limit] = &[Limit::Threads, Limit::Time, Limit::Memory];
    type Report = RankReport;
}

/// The places of targets by their distance from a template. Lengths are in the unit of the meshes.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct RankReport {
    /// The ranked ones, best first; then those left open, and the discarded ones, by their lower bounds; then what cannot be used.
    pub targets: Vec<Row>,
    /// The reason for which the ranking ended: `tolerance` unless targets are left open.
    pub stop: StopReason,
    /// The work done.
    pub work: Work,
}

impl RankReport {
    /// The targets of a kind.
    pub fn of(&self, kind: Kind) -> impl Iterator<Item = &Row> {
        self.targets.iter().filter(move |row| row.status == kind)
    }

    /// The report, unless no target can be used.
    ///
    /// # Errors
    /// [`RankError::NoneUsable`].
    pub fn if_usable(self) -> Result<Self, RankError> {
        let failed: Vec<&Row> = self.of(Kind::Failed).collect();
        match failed[..] {
            [first, ..] if failed.len() == self.targets.len() => Err(RankError::NoneUsable {
                count: failed.len(),
                first: first.message.clone().unwrap_or_default(),
            }),
            _ => Ok(self),
        }
    }
}

impl From<Standings> for RankReport {
    fn from(Standings { standings, stop, work }: Standings) -> Self {
        Self { targets: standings.into_iter().map(Row::from).collect(), stop, work }
    }
}

impl Report for RankReport {
    fn stop(&self) -> StopReason {
        self.stop
    }

    /// A target that is open, or cannot be used, leaves the ranking incomplete.
    fn conclusion(&self) -> Conclusion {
        if [Kind::Open, Kind::Failed].into_iter().any(|kind| self.of(kind).next().is_some()) {
            Conclusion::Incomplete
        } else {
            Conclusion::AsAsked
        }
    }
}

impl RankRequest {
    /// The options without limits.
    pub fn options(&self) -> RankOptions<'static> {
        RankOptions {
            measure: self.direction,
            alignment: self.align,
            top: self.top as usize,
            all: self.all,
            tolerance: self.tolerance_kind.of(self.tolerance),
            ..RankOptions::default()
        }
    }

    /// Ranks meshes.
    ///
    /// # Errors
    /// [`RankError`], also if none of the meshes can be used.
    pub fn run<M: Meshes>(
        &self,
        template: &TriMesh,
        meshes: &M,
        context: &RunContext<'_>,
        observer: Option<&dyn TaskObserver>,
    ) -> Result<RankReport, RankError> {
        let options = RankOptions { limits: context.limits(), observer, ..self.options() };
        RankReport::from(rank(template, meshes, &options)?).if_usable()
    }
}
