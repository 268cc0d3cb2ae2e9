//! Scheduling of tasks: a state machine that depends on results, never on clocks or threads.

use super::options::{Measure, RankError, RankOptions};
use super::report::{Bound, Report, Standing, Status, Work, ranks};
use super::task::{Action, Outcome, Request, Sight, Task};
use pompeiu_core::run::StopReason;
use pompeiu_hausdorff::Tolerance;

/// Smallest number of targets in the first round of searches: their upper bounds discard many of the others. Each further round of
/// the same tolerance has twice as many, so that there are few rounds and enough tasks for many workers.
const FIRST_ROUND: usize = 8;

/// A ranking in progress.
///
/// [`Ranking::round`] lists the tasks of a round, none when the ranking is complete; [`Ranking::merge`] takes their results in the
/// same order. The next tasks depend on the results of whole rounds, and on the names but not the order of the targets.
#[derive(Clone, Debug)]
pub struct Ranking {
    measure: Measure,
    top: usize,
    all: bool,
    tolerances: Vec<Tolerance>,
    candidates: Vec<Candidate>,
    /// Candidates by name, which breaks ties.
    by_name: Vec<usize>,
    round: Vec<Task>,
    /// Rounds with the current tolerance so far.
    rounds_of_tolerance: u32,
    /// Why the ranking ended before it was complete.
    stopped: Option<StopReason>,
    work: Work,
}

#[derive(Clone, Debug)]
struct Candidate {
    name: String,
    state: State,
}

#[derive(Clone, Debug)]
enum State {
    Unseen,
    Seen(Box<Seen>),
    Failed(String),
}

#[derive(Clone, Debug)]
struct Seen {
    sight: Sight,
    lower: f64,
    upper: f64,
    /// The method that proved the lower bound.
    bound: Bound,
    /// Number of tolerances reached.
    reached: usize,
    discarded: bool,
    /// Why a search of the target ended early; it is not searched again.
    stopped: Option<StopReason>,
}

impl Ranking {
    /// A ranking of targets with these names; equal names are distinguished by their order.
    ///
    /// # Errors
    /// Those of [`RankOptions::check`], and [`RankError::NoTargets`].
    pub fn new(names: Vec<String>, options: &RankOptions<'_>) -> Result<Self, RankError> {
        options.check()?;
        if names.is_empty() {
            return Err(RankError::NoTargets);
        }
        let mut by_name: Vec<usize> = (0..names.len()).collect();
        by_name.sort_by(|&i, &j| names[i].cmp(&names[j]));
        let tolerances = options.tolerances();
        let searches = tolerances.iter().map(|t| (*t, 0)).collect();
        let round = by_name.iter().map(|&target| Task { target, action: Action::Look }).collect();
        Ok(Self {
            measure: options.measure,
            top: options.top,
            all: options.all,
            tolerances,
            candidates: names.into_iter().map(|name| Candidate { name, state: State::Unseen }).collect(),
            by_name,
            round,
            rounds_of_tolerance: 0,
            stopped: None,
            work: Work { searches, ..Work::default() },
        })
    }

    /// The tasks of this round; none when the ranking is complete.
    pub fn round(&self) -> &[Task] {
        &self.round
    }

    /// Whether later rounds may need a target; if not, its mesh can be dropped.
    pub fn wants(&self, target: usize) -> bool {
        !self.round.is_empty()
            && match self.candidates.get(target).map(|candidate| &candidate.state) {
                Some(State::Unseen) => true,
                Some(State::Seen(seen)) => !seen.discarded && self.is_wide(seen),
                _ => false,
            }
    }

    /// Whether an enclosure can still be narrowed.
    fn is_wide(&self, seen: &Seen) -> bool {
        seen.stopped.is_none() && seen.reached < self.tolerances.len()
    }

    /// The number of targets.
    pub fn targets(&self) -> usize {
        self.candidates.len()
    }

    /// Ends the ranking: there are no more tasks, and the report lists open targets.
    pub fn stop(&mut self, reason: StopReason) {
        if !self.round.is_empty() {
            self.stopped = Some(reason);
            self.round.clear();
        }
    }

    /// The number of targets that are settled: measured in full, discarded or failed.
    pub fn settled(&self) -> usize {
        (0..self.candidates.len()).filter(|&target| !self.wants(target)).count()
    }

    /// Takes the results of the round, in the order of its tasks, and selects the next tasks.
    ///
    /// # Errors
    /// [`RankError::Results`] and [`RankError::Answer`]; the round then stays unchanged.
    pub fn merge(&mut self, outcomes: Vec<Outcome>) -> Result<(), RankError> {
        if outcomes.len() != self.round.len() {
            return Err(RankError::Results { expected: self.round.len(), found: outcomes.len() });
        }
        self.merge_done(outcomes.into_iter().map(Some).collect(), || StopReason::Cancelled)
    }

    /// Takes the results of the round; `None` for tasks that were not done, which end the ranking for this reason.
    pub(super) fn merge_done(
        &mut self,
        outcomes: Vec<Option<Outcome>>,
        reason: impl FnOnce() -> StopReason,
    ) -> Result<(), RankError> {
        for (task, outcome) in self.round.iter().zip(&outcomes) {
            let Some(outcome) = outcome else { continue };
            let fits = match (&task.action, outcome) {
                (_, Outcome::Failed(_)) => true,
                (Action::Look, Outcome::Seen(sight)) => sight.is_sound(),
                (Action::Refine(request), Outcome::Refined(refined)) => {
                    let beyond = request.threshold.is_some_and(|threshold| refined.lower() > threshold);
                    beyond || refined.upper(self.measure).is_some()
                }
                _ => false,
            };
            if !fits {
                return Err(RankError::Answer { target: task.target });
            }
        }
        if outcomes.is_empty() {
            return Ok(());
        }
        self.work.rounds += 1;
        let mut whole = true;
        for (task, outcome) in std::mem::take(&mut self.round).into_iter().zip(outcomes) {
            match outcome {
                Some(outcome) => self.take(&task, outcome),
                None => whole = false,
            }
        }
        self.discard();
        if whole {
            self.round = self.next_round();
        } else {
            self.stopped = Some(reason());
        }
        Ok(())
    }

    fn take(&mut self, task: &Task, outcome: Outcome) {
        let state = &mut self.candidates[task.target].state;
        match (outcome, &mut *state) {
            (Outcome::Seen(sight), _) => {
                self.work.looks += 1;
                self.work.distances += sight.distances;
                *state = State::Seen(Box::new(Seen::new(sight)));
            }
            (Outcome::Refined(refined), State::Seen(seen)) => {
                let Action::Refine(request) = &task.action else { return };
                let tolerance = self.tolerances[seen.reached];
                self.work.searches[seen.reached].1 += 1;
                self.work.trees += refined.trees();
                self.work.distances += refined.distances();
                if refined.lower() > seen.lower {
                    (seen.lower, seen.bound) = (refined.lower(), Bound::Search(tolerance));
                }
                if let Some(upper) = refined.upper(self.measure).filter(|upper| *upper < seen.upper) {
                    seen.upper = upper;
                }
                if request.threshold.is_some_and(|threshold| refined.lower() > threshold) {
                    // The search ended early. Beyond the threshold the target is discarded, or searched again if the threshold has
                    // changed.
                    return;
                }
                seen.stopped = refined.stop();
                if seen.stopped.is_none() {
                    seen.reached += 1;
                }
                // Searches often end with a narrower enclosure than asked.
                while self.tolerances.get(seen.reached).is_some_and(|t| seen.is_within(t)) {
                    seen.reached += 1;
                }
                if self.tolerances.last().is_some_and(|t| seen.is_within(t)) {
                    (seen.reached, seen.stopped) = (self.tolerances.len(), None);
                }
            }
            (Outcome::Failed(message), _) => *state = State::Failed(message),
            (Outcome::Refined(_), _) => (),
        }
    }

    /// The k-th least upper bound: targets that are certainly farther are not among the k best.
    fn threshold(&self) -> Option<f64> {
        if self.all {
            return None;
        }
        let mut uppers: Vec<f64> = self.seen().map(|(_, seen)| seen.upper).collect();
        uppers.sort_by(f64::total_cmp);
        uppers.get(self.top - 1).copied()
    }

    /// The state of each usable target, by name.
    fn seen(&self) -> impl Iterator<Item = (usize, &Seen)> {
        self.by_name.iter().filter_map(|&target| match &self.candidates[target].state {
            State::Seen(seen) => Some((target, seen.as_ref())),
            _ => None,
        })
    }

    fn discard(&mut self) {
        let threshold = self.threshold().unwrap_or(f64::INFINITY);
        for candidate in &mut self.candidates {
            if let State::Seen(seen) = &mut candidate.state {
                // Recomputed each time: if a target fails after another was discarded, the other may count again.
                seen.discarded = seen.lower > threshold;
            }
        }
    }

    /// The most promising of the targets with the widest tolerance.
    fn next_round(&mut self) -> Vec<Task> {
        let open = |seen: &Seen| !seen.discarded && self.is_wide(seen);
        let mut behind: Vec<(usize, &Seen)> = self.seen().filter(|(_, seen)| open(seen)).collect();
        let Some(least) = behind.iter().map(|(_, seen)| seen.reached).min() else { return Vec::new() };
        behind.retain(|(_, seen)| seen.reached == least);
        behind.sort_by(|(_, a), (_, b)| a.lower.total_cmp(&b.lower).then(a.upper.total_cmp(&b.upper)));
        let begun = self.work.searches[least].1 > 0;
        let rounds = if begun { self.rounds_of_tolerance + 1 } else { 0 };
        let first = self.top.max(FIRST_ROUND);
        let most = if self.all { usize::MAX } else { first.saturating_mul(1 << rounds.min(31)) };
        let threshold = self.threshold();
        let tolerance = self.tolerances[least];
        let task = |(target, seen): &(usize, &Seen)| {
            let request = Request { tolerance, threshold, transform: seen.sight.transform };
            Task { target: *target, action: Action::Refine(request) }
        };
        let round = behind.iter().take(most).map(task).collect();
        self.rounds_of_tolerance = rounds;
        round
    }

    /// The current state; the final report once there are no tasks left.
    pub fn report(&self) -> Report {
        let enclosures: Vec<_> = self
            .candidates
            .iter()
            .map(|candidate| match &candidate.state {
                State::Seen(seen) => Some([seen.lower, seen.upper]),
                State::Unseen => Some([0.0, f64::INFINITY]),
                State::Failed(_) => None,
            })
            .collect();
        let ranks = ranks(&enclosures);
        let stop = self.stop_reason();
        let mut standings: Vec<Standing> = self
            .by_name
            .iter()
            .map(|&target| {
                let candidate = &self.candidates[target];
                let seen = match &candidate.state {
                    State::Seen(seen) => Some(seen),
                    _ => None,
                };
                Standing {
                    target,
                    name: candidate.name.clone(),
                    status: match &candidate.state {
                        State::Seen(seen) if seen.discarded => Status::Discarded(seen.bound),
                        State::Seen(seen) if seen.reached < self.tolerances.len() => {
                            Status::Open(seen.stopped.unwrap_or(stop))
                        }
                        // If others are open, a narrow enclosure alone does not place the target among the best.
                        State::Seen(_) if stop.is_early() && !self.is_placed(ranks[target]) => {
                            Status::Open(stop)
                        }
                        State::Seen(_) => Status::Ranked,
                        State::Failed(message) => Status::Failed(message.clone()),
                        State::Unseen => Status::Open(stop),
                    },
                    ranks: ranks[target],
                    lower: seen.map(|seen| seen.lower),
                    upper: seen.map(|seen| seen.upper),
                    size: seen.map(|seen| [seen.sight.vertices, seen.sight.faces]),
                    transform: seen.and_then(|seen| seen.sight.transform),
                }
            })
            .collect();
        let kind = |standing: &Standing| match standing.status {
            Status::Ranked => 0,
            Status::Open(_) => 1,
            Status::Discarded(_) => 2,
            Status::Failed(_) => 3,
        };
        let ends = |standing: &Standing| [standing.lower, standing.upper].map(|x| x.unwrap_or(f64::INFINITY));
        // Stable, so that ties stay in the order of their names.
        standings.sort_by(|a, b| {
            let by_kind = kind(a).cmp(&kind(b));
            let by_rank = if kind(a) == 0 { a.ranks.cmp(&b.ranks) } else { std::cmp::Ordering::Equal };
            let ([l, u], [m, v]) = (ends(a), ends(b));
            by_kind.then(by_rank).then(l.total_cmp(&m)).then(u.total_cmp(&v))
        });
        Report { standings, stop, work: self.work.clone() }
    }

    /// Why the ranking ended; `Cancelled` before it has.
    fn stop_reason(&self) -> StopReason {
        let unsettled = (!self.round.is_empty()).then_some(StopReason::Cancelled);
        let of_target = || self.seen().filter(|(_, seen)| !seen.discarded).find_map(|(_, seen)| seen.stopped);
        self.stopped.or(unsettled).or_else(of_target).unwrap_or(StopReason::Tolerance)
    }

    /// Whether these ranks are among the requested ones.
    fn is_placed(&self, ranks: Option<[usize; 2]>) -> bool {
        self.all || ranks.is_some_and(|[_, last]| last <= self.top)
    }
}

impl Seen {
    fn new(sight: Sight) -> Self {
        let probed = sight.probe_lower > sight.support_lower;
        let lower = if probed { sight.probe_lower } else { sight.support_lower };
        // Both bounds are proven, so they cannot cross; this also protects against manipulated results.
        let upper = if sight.upper > lower { sight.upper } else { lower };
        let bound = if probed { Bound::Probes } else { Bound::Supports };
        Self { lower, upper, bound, sight, reached: 0, discarded: false, stopped: None }
    }

    /// Whether the enclosure meets this tolerance.
    fn is_within(&self, tolerance: &Tolerance) -> bool {
        let width = match *tolerance {
            Tolerance::RelativeToDiagonal(t) => t * self.sight.diagonal,
            Tolerance::RelativeToDistance(t) => t * self.lower,
            Tolerance::Absolute(t) => t,
        };
        self.upper - self.lower <= width
    }
}

impl Sight {
    fn is_sound(&self) -> bool {
        let finite = |x: f64| (0.0..f64::INFINITY).contains(&x);
        [self.support_lower, self.probe_lower, self.upper, self.diagonal].into_iter().all(finite)
    }
}
