//! The report of a ranking.

use crate::align::Matrix;
use pompeiu_core::run::StopReason;
use pompeiu_hausdorff::Tolerance;
use serde::{Serialize, Serializer};

/// The targets in their order, and the work done.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// Ranked targets first, best first; then open and discarded ones, each by their lower bounds; then those that failed.
    pub standings: Vec<Standing>,
    /// Why the ranking ended: [`StopReason::Tolerance`] unless targets are left open.
    pub stop: StopReason,
    /// The work done.
    pub work: Work,
}

impl Report {
    /// The ranked targets, best first.
    pub fn ranked(&self) -> impl Iterator<Item = &Standing> {
        self.standings.iter().filter(|standing| standing.status == Status::Ranked)
    }

    /// The targets that a limit or an observer left unsettled, most promising first.
    pub fn open(&self) -> impl Iterator<Item = &Standing> {
        self.standings.iter().filter(|standing| matches!(standing.status, Status::Open(_)))
    }
}

/// The result for a target. A [`Row`](super::Row) is what is serialised of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// The index of the target in the input.
    pub target: usize,
    /// Its name.
    pub name: String,
    /// The evidence that settled it.
    pub status: Status,
    /// The first and the last possible rank given the enclosures of all targets, counted from 1. They are equal if the rank is
    /// decided; `None` if the target failed. An unread target may have any rank.
    pub ranks: Option<[usize; 2]>,
    /// Proven lower bound on its distance.
    pub lower: Option<f64>,
    /// Proven upper bound on its distance.
    pub upper: Option<f64>,
    /// Numbers of vertices and faces, if it was read.
    pub size: Option<[usize; 2]>,
    /// The map that aligned it to the template.
    pub transform: Option<Matrix>,
}

/// The evidence that settled the place of a target.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// It is among the best, or tied with the last of them.
    Ranked,
    /// The ranking ended, for this reason, before it was decided whether the target is among the best.
    Open(StopReason),
    /// It is proven not to be among the best, by this bound.
    Discarded(Bound),
    /// It cannot be used, for this reason.
    Failed(String),
}

/// The method that proved a lower bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// Support functions in fixed directions.
    Supports,
    /// The distances of a few of its points.
    Probes,
    /// A search with this tolerance.
    Search(Tolerance),
}

/// Amounts of work, in counts that do not depend on the machine or the number of threads.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Work {
    /// Targets read.
    pub looks: usize,
    /// Searches by tolerance: the last is the requested one, the others are relative to the joint diagonal.
    #[serde(serialize_with = "by_value")]
    #[cfg_attr(feature = "schema", schemars(with = "Vec<(f64, usize)>"))]
    pub searches: Vec<(Tolerance, usize)>,
    /// Trees of targets built.
    pub trees: u64,
    /// Point–triangle distances evaluated.
    pub distances: u64,
    /// Rounds.
    pub rounds: usize,
}

/// Serialises the numbers of tolerances, without their kinds.
fn by_value<S: Serializer>(searches: &[(Tolerance, usize)], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(searches.iter().map(|(tolerance, count)| (tolerance.value(), count)))
}

/// The possible ranks of each target.
pub(super) fn ranks(enclosures: &[Option<[f64; 2]>]) -> Vec<Option<[usize; 2]>> {
    let sorted = |end: usize| {
        let mut ends: Vec<f64> = enclosures.iter().flatten().map(|enclosure| enclosure[end]).collect();
        ends.sort_by(f64::total_cmp);
        ends
    };
    let (lowers, uppers) = (sorted(0), sorted(1));
    let range = |[lower, upper]: [f64; 2]| {
        // Targets that are certainly nearer, and targets that may be, including itself.
        [uppers.partition_point(|u| *u < lower) + 1, lowers.partition_point(|l| *l <= upper)]
    };
    enclosures.iter().map(|enclosure| enclosure.map(range)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_are_ranges_where_enclosures_meet() {
        let found = ranks(&[Some([1.0, 2.0]), None, Some([0.0, 0.5]), Some([2.0, 3.0]), Some([4.0, 4.0])]);
        assert_eq!(found, [Some([2, 3]), None, Some([1, 1]), Some([2, 3]), Some([4, 4])]);
        assert_eq!(ranks(&[Some([0.0, 0.0]); 3]), [Some([1, 3]); 3]);
    }
}
