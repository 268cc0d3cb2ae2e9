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
}

/// A part of a surface.
pub(super) trait Patch: Copy + Send + Sync {
    /// Parts that cover it.
    fn divided(&self) -> [Self; 4];
}

/// The greatest distance, enclosed.
#[derive(Default)]
pub(super) struct Enclosure {
    pub(super) lower: [f64; 2],
    pub(super) upper: [f64; 2],
    /// The sample next to the point with the greatest distance in radii.
    pub(super) sample: usize,
    /// Samples next to points that are farther away than is tolerated, with the greatest such distance.
    pub(super) beyond: BTreeMap<usize, [f64; 2]>,
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

impl Enclosure {
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

    /// Takes a patch that is not divided.
    fn close(&mut self, bounds: &Bounds) {
        self.upper = [0, 1].map(|k| self.upper[k].max(bounds.upper[k]));
        if self.goal.wanted == Wanted::Whether && bounds.upper[1] > self.goal.within {
            self.beyond.entry(bounds.sample).or_insert(bounds.lower);
        }
    }

    /// Most divisions of a patch along each direction.
    fn most_levels(&self) -> usize {
        if self.goal.wanted == Wanted::Whether {
            return LEVELS_WHETHER;
        }
        if self.goal.is_decided || self.lower[1] > self.goal.within { LEVELS_BEYOND } else { MOST_LEVELS }
    }

    /// Whether a patch has to be divided to narrow the enclosure, or to decide whether distances are tolerated.
    fn is_open(&self, bounds: &Bounds) -> bool {
        let Goal { within, is_decided, wanted } = self.goal;
        let width = if self.lower[1] > within { (RELATIVE_WIDTH * self.lower[1]).max(WIDTH) } else { WIDTH };
        // The width in micrometres is that of the radius of this patch.
        let radius = bounds.upper[0] / bounds.upper[1];
        let decides = !is_decided && self.lower[1] <= within && bounds.upper[1] > within;
        match wanted {
            Wanted::Whether => return bounds.upper[1] > within,
            Wanted::Where if bounds.upper[1] <= within => return false,
            Wanted::Where | Wanted::Enclosed => (),
        }
        decides
            || bounds.upper[1] > self.lower[1] + width
            || bounds.upper[0] > self.lower[0] + width * radius.max(0.0)
    }
}

/// Encloses the greatest distance of the points of patches. `evaluate` bounds those of one patch; `None` if it is not part of the
/// surface. After too many patches the enclosure is as wide as it is then; when the computation is stopped, it is unbounded.
///
/// The result does not depend on the number of threads.
pub(super) fn enclose<P: Patch>(
    patches: &[P],
    goal: Goal,
    control: &Control,
    evaluate: impl Fn(&P) -> Option<Bounds> + Sync,
) -> Enclosure {
    let mut found = Enclosure { goal, ..Enclosure::default() };
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
    let mut left = LEAST_BUDGET.saturating_add(patches.len().saturating_mul(MOST_PER_PATCH));
    // Parts of a batch are divided before the next one is begun: few are kept at a time.
    let mut stack: Vec<(usize, Vec<P>)> = Vec::new();
    for (batch, bounds) in patches.chunks(BATCH).zip(first) {
        stack.push((0, batch.to_vec()));
        let mut known = Some(bounds);
        while let Some((level, active)) = stack.pop() {
            if control.is_stopped() {
                return Enclosure { upper: [f64::INFINITY; 2], ..found };
            }
            let bounds = known.take().unwrap_or_else(|| active.par_iter().map(&evaluate).collect());
            left = left.saturating_sub(active.len());
            bounds.iter().flatten().for_each(|bounds| found.add(bounds));
            let mut divided: Vec<P> = Vec::new();
            for (patch, bounds) in active.iter().zip(&bounds) {
                let Some(bounds) = bounds else { continue };
                if left > 0 && level < found.most_levels() && found.is_open(bounds) {
                    divided.extend(patch.divided());
                } else {
                    found.close(bounds);
                }
            }
            stack.extend(divided.chunks(BATCH).rev().map(|chunk| (level + 1, chunk.to_vec())));
        }
    }
    found
}
