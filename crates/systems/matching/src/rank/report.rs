//! The answer.

use super::row::Row;
use crate::align::Matrix;
use pompeiu_core::run::StopReason;
use pompeiu_hausdorff::Tolerance;
use serde::{Serialize, Serializer};

/// The targets in their order, and what it took.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Report {
    /// The ranked ones first, best first; then those left open, and those discarded, by their lower bounds; then those that
    /// failed.
    pub standings: Vec<Standing>,
    /// Why the ranking ended: [`StopReason::Tolerance`] unless targets are left open.
    pub stop: StopReason,
    /// What it took.
    pub work: Work,
}

impl Report {
    /// The ranked ones, best first.
    pub fn ranked(&self) -> impl Iterator<Item = &Standing> {
        self.standings.iter().filter(|standing| standing.status == Status::Ranked)
    }

    /// Those that a limit or an observer left unsettled, the most promising first.
    pub fn open(&self) -> impl Iterator<Item = &Standing> {
        self.standings.iter().filter(|standing| matches!(standing.status, Status::Open(_)))
    }
}

/// Where a target stands. Serialised as a [`Row`].
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(into = "Row")]
pub struct Standing {
    /// The target, in the order they were given in.
    pub target: usize,
    /// Its name.
    pub name: String,
    /// How it was settled.
    pub status: Status,
    /// The first and the last rank that the enclosures of all targets leave possible, counted from 1; the same where the
    /// rank is decided, none where the target failed. One that was not looked at yet may have any.
    pub ranks: Option<[usize; 2]>,
    /// Proven lower bound on its distance.
    pub lower: Option<f64>,
    /// Proven upper bound on its distance.
    pub upper: Option<f64>,
    /// Vertices and faces, where it could be looked at.
    pub size: Option<[usize; 2]>,
    /// The map that brought it onto the template.
    pub transform: Option<Matrix>,
}

/// How a target was settled.
#[derive(Clone, Debug, PartialEq)]
pub enum Status {
    /// It is among the best, or ties with the last of them.
    Ranked,
    /// The ranking ended, for this reason, before it was known whether it is among the best.
    Open(StopReason),
    /// It is proven not to be, by this bound.
    Discarded(Bound),
    /// It cannot be used, and why.
    Failed(String),
}

/// What proved a lower bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// How far it reaches in fixed directions.
    Supports,
    /// A few of its points.
    Probes,
    /// A search with this tolerance.
    Search(Tolerance),
}

/// How much was done, in counts that do not depend on the machine or on the number of threads.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Work {
    /// Targets looked at.
    pub looks: usize,
    /// Searches, by their tolerance: the last is the one asked for, the others are fractions of the joint diagonal.
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

/// What every target is known to be, in the end.
pub(super) fn ranks(enclosures: &[Option<[f64; 2]>]) -> Vec<Option<[usize; 2]>> {
    let sorted = |end: usize| {
        let mut ends: Vec<f64> = enclosures.iter().flatten().map(|enclosure| enclosure[end]).collect();
        ends.sort_by(f64::total_cmp);
        ends
    };
    let (lowers, uppers) = (sorted(0), sorted(1));
    let range = |[lower, upper]: [f64; 2]| {
        // Those that are certainly nearer, and those that may be: itself is among the latter.
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
