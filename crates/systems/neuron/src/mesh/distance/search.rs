//! The greatest distance of the points of patches, enclosed by dividing them.

use pompeiu_core::run::Control;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Width at which an enclosure is good enough, in radii.
const WIDTH: f64 = 0.02;

/// The same, as a share of a distance above what is tolerated.
const RELATIVE_WIDTH: f64 = 0.05;

/// Most divisions of a patch along each direction.
const MOST_LEVELS: usize = 14;

/// From so many divisions on, one of the patches that are divided together is looked at more closely.
const LEVEL_OF_WITNESSES: usize = 4;

/// Patches that are divided together.
const BATCH: usize = 4096;

/// The same once a distance is known to be more than is tolerated: what is left is its width.
const LEVELS_BEYOND: usize = 7;

/// The same if only a yes is wanted: a mesh with distances near what is tolerated is improved instead.
const LEVELS_WHETHER: usize = 4;

/// Most patches that are evaluated: so many, and so many for each one in the beginning.
const LEAST_BUDGET: usize = 1_000_000;
const MOST_PER_PATCH: usize = 100;

/// What is known of the distances of the points of a patch: in micrometres, and in radii.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    /// No point has a greater one.
    pub(super) upper: [f64; 2],
    /// A point has at least this one.
    pub(super) lower: [f64; 2],
    /// The sample next to that point.
    pub(super) sample: usize,
    /// Whether what is left between them is not the size of the patch, so that dividing it does not narrow them.
    pub(super) is_settled: bool,
}

/// A part of a surface.
pub(super) trait Patch: Copy + Send + Sync {
    /// Parts that cover it.
    fn divided(&self) -> [Self; 4];
}

/// The greatest distance, enclosed.
pub(super) struct Enclosure<P> {
    pub(super) lower: [f64; 2],
    pub(super) upper: [f64; 2],
    /// The sample next to the point with the greatest distance in radii.
    pub(super) sample: usize,
    /// Samples next to points that are farther away than is tolerated, with the greatest such distance.
    pub(super) beyond: BTreeMap<usize, [f64; 2]>,
    /// Patches that are not divided because that does not decide whether their distances are tolerated.
    pub(super) settled: Vec<P>,
    settled_upper: [f64; 2],
    goal: Goal,
}

/// What is wanted of distances.
#[derive(Clone, Copy, PartialEq, Eq, Default)]
pub(in crate::mesh) enum Wanted {
    /// Whether they are soon proven to be tolerated, and where they are not.
    Whether,
    /// Whether they are tolerated, and how great they are where they are not.
    Where,
    /// How great they are.
    #[default]
    Enclosed,
}

/// What an enclosure is for.
#[derive(Clone, Copy, Default)]
pub(super) struct Goal {
    /// The tolerated distance, in radii.
    pub(super) within: f64,
    /// Whether another surface is known to be farther away than is tolerated, so that this one decides nothing.
    pub(super) is_decided: bool,
    pub(super) wanted: Wanted,
}

impl<P> Enclosure<P> {
    fn new(goal: Goal) -> Self {
        Self {
            lower: [0.0; 2],
            upper: [0.0; 2],
            sample: 0,
            beyond: BTreeMap::new(),
            settled: Vec::new(),
            settled_upper: [0.0; 2],
            goal,
        }
    }

    /// Whether neither that all distances are tolerated nor that one is not is known, because of settled patches.
    pub(super) fn is_settled(&self) -> bool {
        let Goal { within, is_decided, .. } = self.goal;
        !is_decided && self.lower[1] <= within && self.upper[1] <= within && !self.settled.is_empty()
    }

    /// The upper bounds of all patches, the settled ones too.
    pub(super) fn uppers(&self) -> [f64; 2] {
        [0, 1].map(|k| self.upper[k].max(self.settled_upper[k]))
    }

    /// Takes what is known of the settled patches from better bounds.
    pub(super) fn resolve(&mut self, better: Self) {
        if better.lower[1] > self.lower[1] {
            self.sample = better.sample;
        }
        self.settled_upper = better.uppers();
        self.lower = [0, 1].map(|k| self.lower[k].max(better.lower[k]));
        for (sample, distance) in better.beyond {
            let most = self.beyond.entry(sample).or_insert(distance);
            if distance[1] > most[1] {
                *most = distance;
            }
        }
    }

    fn add(&mut self, bounds: &Bounds) {
        let within = self.goal.within;
        self.lower[0] = self.lower[0].max(bounds.lower[0]);
        if bounds.lower[1] > self.lower[1] {
            self.lower[1] = bounds.lower[1];
            self.sample = bounds.sample;
        }
        if bounds.lower[1] > within {
            let most = self.beyond.entry(bounds.sample).or_insert(bounds.lower);
            if bounds.lower[1] > most[1] {
                *most = bounds.lower;
            }
        }
    }

    /// The open patch that may be farthest away.
    fn farthest<'a>(&self, active: &'a [(P, Option<Bounds>)]) -> Option<&'a P> {
        let upper = |bounds: &Option<Bounds>| {
            bounds.as_ref().filter(|bounds| self.is_open(bounds)).map(|bounds| bounds.upper[1])
        };
        let open = active.iter().filter_map(|(patch, bounds)| Some((patch, upper(bounds)?)));
        open.max_by(|a, b| a.1.total_cmp(&b.1)).map(|(patch, _)| patch)
    }

    /// Takes a patch that is not divided.
    fn close(&mut self, bounds: &Bounds) {
        self.upper = [0, 1].map(|k| self.upper[k].max(bounds.upper[k]));
        if self.goal.wanted == Wanted::Whether && bounds.upper[1] > self.goal.within {
            self.beyond.entry(bounds.sample).or_insert(bounds.lower);
        }
    }

    /// Takes a patch that is open and whose bounds are not narrowed by dividing it.
    fn settle(&mut self, patch: P, bounds: &Bounds) {
        if bounds.upper[1] > self.goal.within && self.goal.wanted != Wanted::Whether {
            self.settled_upper = [0, 1].map(|k| self.settled_upper[k].max(bounds.upper[k]));
            self.settled.push(patch);
        } else {
            self.close(bounds);
        }
    }

    /// Most divisions of a patch along each direction.
    fn most_levels(&self) -> usize {
        if self.goal.wanted == Wanted::Whether {
            return LEVELS_WHETHER;
        }
        if self.goal.is_decided || self.lower[1] > self.goal.within { LEVELS_BEYOND } else { MOST_LEVELS }
    }

    /// Whether a patch has to be divided to decide whether distances are tolerated.
    fn decides(&self, bounds: &Bounds) -> bool {
        let Goal { within, is_decided, .. } = self.goal;
        !is_decided && self.lower[1] <= within && bounds.upper[1] > within
    }

    /// Whether a patch has to be divided to narrow the enclosure, or to decide whether distances are tolerated.
    fn is_open(&self, bounds: &Bounds) -> bool {
        let Goal { within, wanted, .. } = self.goal;
        let width = if self.lower[1] > within { (RELATIVE_WIDTH * self.lower[1]).max(WIDTH) } else { WIDTH };
        // The width in micrometres is that of the radius of this patch.
        let radius = bounds.upper[0] / bounds.upper[1];
        match wanted {
            Wanted::Whether => return bounds.upper[1] > within,
            Wanted::Where if bounds.upper[1] <= within => return false,
            Wanted::Where | Wanted::Enclosed => (),
        }
        self.decides(bounds)
            || bounds.upper[1] > self.lower[1] + width
            || bounds.upper[0] > self.lower[0] + width * radius.max(0.0)
    }
}

/// Encloses the greatest distance of the points of patches. `evaluate` bounds those of one patch; `None` if it is not part of the
/// surface. `witness` finds a better lower bound for one patch, if there is any, with more work. After too many patches the enclosure is as wide as it is then; when the computation is stopped, it is unbounded.
///
/// What decides whether distances are tolerated is divided first: it takes less work than a narrow enclosure of many patches.
///
/// The result does not depend on the number of threads.
pub(super) fn enclose<P: Patch>(
    patches: &[P],
    goal: Goal,
    control: &Control,
    (evaluate, witness): (impl Fn(&P) -> Option<Bounds> + Sync, impl Fn(&P) -> Option<Bounds>),
) -> Enclosure<P> {
    let mut found = Enclosure::new(goal);
    // Lower bounds first, whichever patch they are of: the others need not be divided for what these decide.
    let mut first: Vec<Vec<Option<Bounds>>> = Vec::with_capacity(patches.len().div_ceil(BATCH));
    for batch in patches.chunks(BATCH) {
        if control.is_stopped() {
            return Enclosure { upper: [f64::INFINITY; 2], ..found };
        }
        let bounds: Vec<Option<Bounds>> = batch.par_iter().map(&evaluate).collect();
        bounds.iter().flatten().for_each(|bounds| found.add(bounds));
        first.push(bounds);
    }
    let left = LEAST_BUDGET.saturating_add(patches.len().saturating_mul(MOST_PER_PATCH));
    let mut search = Search { found, left, later: Vec::new(), evaluate, witness, control };
    let mut goes_on = true;
    for (batch, bounds) in patches.chunks(BATCH).zip(first) {
        let known = batch.iter().copied().zip(bounds).collect();
        goes_on = goes_on && search.divide(0, known, true);
    }
    let mut later = std::mem::take(&mut search.later);
    later.sort_by_key(|(level, ..)| *level);
    for run in later.chunk_by(|a, b| a.0 == b.0).flat_map(|run| run.chunks(BATCH)) {
        let known = run.iter().map(|(_, patch, bounds)| (*patch, Some(*bounds))).collect();
        goes_on = goes_on && search.divide(run[0].0, known, false);
    }
    if goes_on { search.found } else { Enclosure { upper: [f64::INFINITY; 2], ..search.found } }
}

/// The division of patches.
struct Search<'s, P, E, W> {
    found: Enclosure<P>,
    /// Patches that may still be evaluated.
    left: usize,
    /// Patches that decide nothing, with how often they are divided already.
    later: Vec<(usize, P, Bounds)>,
    evaluate: E,
    witness: W,
    control: &'s Control,
}

impl<P: Patch, E: Fn(&P) -> Option<Bounds> + Sync, W: Fn(&P) -> Option<Bounds>> Search<'_, P, E, W> {
    /// Divides patches whose bounds are known, or only those that decide; returns whether the computation goes on.
    fn divide(&mut self, level: usize, known: Vec<(P, Option<Bounds>)>, only_what_decides: bool) -> bool {
        // Parts of a batch are divided before the next one is begun: few are kept at a time.
        let mut stack: Vec<(usize, Vec<P>)> = Vec::new();
        let mut next = Some((level, known));
        while let Some((level, active)) = next {
            if self.control.is_stopped() {
                return false;
            }
            self.left = self.left.saturating_sub(active.len());
            active.iter().filter_map(|(_, bounds)| bounds.as_ref()).for_each(|bounds| self.found.add(bounds));
            if level >= LEVEL_OF_WITNESSES
                && let Some(farthest) = self.found.farthest(&active)
                && let Some(known) = (self.witness)(farthest)
            {
                self.found.add(&known);
            }
            let mut divided: Vec<P> = Vec::new();
            for (patch, bounds) in active {
                let Some(bounds) = bounds else { continue };
                let found = &mut self.found;
                if self.left == 0 || level >= found.most_levels() || !found.is_open(&bounds) {
                    found.close(&bounds);
                } else if bounds.is_settled {
                    found.settle(patch, &bounds);
                } else if only_what_decides && !found.decides(&bounds) {
                    self.later.push((level, patch, bounds));
                } else {
                    divided.extend(patch.divided());
                }
            }
            stack.extend(divided.chunks(BATCH).rev().map(|chunk| (level + 1, chunk.to_vec())));
            next = stack.pop().map(|(level, patches)| {
                let known = patches.par_iter().map(|patch| (*patch, (self.evaluate)(patch))).collect();
                (level, known)
            });
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A part of this size, whose bounds are as wide.
    #[derive(Clone, Copy)]
    struct Part(f64);

    impl Patch for Part {
        fn divided(&self) -> [Self; 4] {
            [Self(0.5 * self.0); 4]
        }
    }

    #[test]
    fn what_decides_is_not_left_for_narrow_bounds() {
        // To narrow the bounds of all parts takes ten times as many as there may be.
        let patches = vec![Part(1.0); 3000];
        let goal = Goal { within: 0.2, ..Goal::default() };
        let bounds =
            |part: &Part| Some(Bounds { upper: [part.0; 2], lower: [0.0; 2], sample: 0, is_settled: false });
        let found = enclose(&patches, goal, &Control::default(), (bounds, |_: &Part| None));
        assert_eq!((found.lower[1], found.uppers()[1]), (0.0, 0.125));
    }
}
