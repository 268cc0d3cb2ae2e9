//! Kept of refinement, until statistics are as narrow as asked.
//!
//! Faces are cut anew for each criterion, from nothing: so nothing is kept of them but what statistics need. Work is dealt out in tasks of
//! fixed sizes, whose outcomes are put together in task order, so that the pieces are the same at any number of threads.

use super::bounds::FaceBounds;
use super::criterion::Criterion;
use super::distribution::Distribution;
use super::linear::{greater, lesser};
use super::pieces::Pieces;
use super::select::{flag, keep_the_worst, suffices};
use super::statistics::{StatisticsQuery, Summary, is_narrow};
use super::task::{Faces, Made};
use pompeiu_core::spatial::Slot;
use rayon::prelude::*;

/// The area times width that a piece may leave undecided at first: this part of what the mean may, shared out among all faces.
const FIRST_PART: f64 = 1.0;
/// The first criterion is calibrated by so many samples of so many faces, of meshes with more than this many; how often, the parts of the
/// allowed width between which it should leave what is left, and how far it is changed at a time.
const SAMPLES: usize = 64;
const FACES_OF_SAMPLE: (usize, usize) = (4, 16);
const LEAST_CALIBRATED: usize = 4 * SAMPLES * FACES_OF_SAMPLE.0;
/// Part of the faces that samples should have.
const SAMPLED: f64 = 0.01;
const CALIBRATIONS: usize = 4;
const AIMED: (f64, f64) = (0.5, 0.85);
/// A criterion that leaves no fewer than this part of the pieces of the one before is coarse enough: pieces are what they are for other reasons.
const LEAST_FEWER: f64 = 0.9;
const MOST_FACTOR: f64 = 5.0;
/// The same of percentiles, which a few faces show less well: the greatest part of the allowed width; how far around one pieces are
/// made narrower, as a factor, and what more than in proportion.
const AIMED_AT_PERCENTILES: f64 = 0.8;
const BESIDE_PERCENTILES: f64 = 1.2;
const NARROWER: f64 = 0.7;
/// How much finer each round is.
const FINER: f64 = 0.25;
/// Kept that make only statistics of parts of the distribution narrower.
pub(super) const FOCUSED_ROUNDS: u32 = 8;
/// Kept must narrow what is not yet narrow enough by this factor, so many of them as a rule: focused ones each, once there are so
/// many pieces; the others one of three.
pub(super) const LEAST_PROGRESS: f64 = 0.95;
const MANY_PIECES: usize = 1 << 12;
pub(super) const ROUNDS_WITHOUT_PROGRESS: u32 = 3;
/// Criteria are not made finer than this part of the first one.
const FINEST: f64 = 1e-15;
/// Faces of a task at most, and tasks that there should be.
const TASK: usize = 64;
const TASKS: usize = 256;
/// Tasks between two looks at the limits.
pub(super) const TASKS_PER_ROUND: usize = 64;
/// Pieces of a face, at least and at most, whatever the limit on pieces leaves.
const PIECES_OF_FACE: (usize, usize) = (16, 1 << 17);

/// The statistics that are asked for, and the limits on pieces.
pub(super) struct RefinementOptions<'a> {
    pub(super) asked: &'a StatisticsQuery<'a>,
    pub(super) accuracy: f64,
    /// About the mean distance.
    pub(super) mean: f64,
    /// Widths that never matter.
    pub(super) floor: f64,
    /// Area of all faces.
    pub(super) total: f64,
    /// Cells that the overlay of both meshes has, about.
    pub(super) cells: usize,
    pub(super) most_pieces: usize,
    /// Whether pieces are summed up at once, and not kept.
    pub(super) summed: bool,
}

/// What refining came to.
pub(super) struct Refined {
    pub(super) pieces: Pieces,
    /// By face.
    pub(super) bounds: Vec<FaceBounds>,
    /// None where the area may be zero.
    pub(super) summary: Option<Summary>,
    /// Whether statistics are as narrow as asked.
    pub(super) tight: bool,
    pub(super) looks: u64,
    pub(super) distances: u64,
    pub(super) rounds: u32,
}

/// The same while pieces are kept.
#[derive(Default)]
struct Kept {
    distribution: Distribution,
    bounds: Vec<FaceBounds>,
    summary: Option<Summary>,
    tight: bool,
    looks: u64,
    distances: u64,
    rounds: u32,
}

impl From<Kept> for Refined {
    fn from(kept: Kept) -> Self {
        let Kept { distribution, bounds, summary, tight, looks, distances, rounds } = kept;
        Self { pieces: Pieces::Kept(distribution), bounds, summary, tight, looks, distances, rounds }
    }
}

/// The rounds of one direction.
pub(super) struct Refinement<'r> {
    pub(super) faces: &'r Faces<'r>,
    /// The faces, neighbours close together.
    pub(super) order: &'r [u32],
    pub(super) options: &'r RefinementOptions<'r>,
    /// Told between tasks how many looks were made, how many pieces there are, and how many faces are left.
    pub(super) watch: &'r mut dyn FnMut(u64, usize, usize),
    /// Told between tasks between which ends the mean lies, where pieces are summed up at once and somebody wants to know.
    pub(super) tell_mean: Option<&'r mut dyn FnMut((f64, f64))>,
    /// What was told last.
    pub(super) known_mean: Option<(f64, f64)>,
}

impl Refinement<'_> {
    pub(super) fn run(self) -> Refined {
        let RefinementOptions { accuracy, floor, total, .. } = *self.options;
        let width = accuracy * self.options.mean + floor;
        let first = FIRST_PART * width * total / self.options.cells as f64;
        // What has no area has no statistics, but distances of faces.
        let floor = if total > 0.0 { floor } else { width };
        let mut criterion = Criterion { mass: first, focus: Vec::new(), focus_mass: f64::INFINITY, floor };
        self.calibrate(&mut criterion);
        if self.options.summed { self.run_in_passes(criterion) } else { self.run_in_rounds(criterion) }
    }

    /// Keeps pieces, and cuts those faces again that are not narrow enough.
    fn run_in_rounds(mut self, mut criterion: Criterion) -> Refined {
        let RefinementOptions { accuracy, asked, .. } = *self.options;
        let floor = criterion.floor;
        let first = criterion.mass;
        let mut refined = Kept::default();
        self.cut_all(&criterion, &mut refined);
        let mut focused_rounds = 0;
        let mut doubt_before = f64::INFINITY;
        let (mut least_excess, mut without_progress) = (f64::INFINITY, 0);
        loop {
            refined.summary = Summary::of(&refined.distribution, asked, self.faces.largest);
            let Some(summary) = &refined.summary else {
                refined.tight = true;
                return refined.into();
            };
            let means_are_tight =
                [summary.mean, summary.rms].into_iter().all(|ends| is_narrow(ends, accuracy, floor));
            let excess = greater(self.excess(summary.mean), self.excess(summary.rms));
            let of_percentiles = summary.percentiles.iter().map(|ends| self.excess(*ends));
            let excess_of_focus = of_percentiles.fold(1.0, greater);
            let doubt = self.doubt(summary);
            let focus = self.focus(summary);
            refined.tight = means_are_tight && focus.is_empty();
            if refined.tight || self.faces.control.is_stopped() {
                return refined.into();
            }
            if means_are_tight {
                let is_stuck =
                    doubt > LEAST_PROGRESS * doubt_before && refined.distribution.len() >= MANY_PIECES;
                if focused_rounds == FOCUSED_ROUNDS || is_stuck {
                    return refined.into();
                }
                doubt_before = doubt;
                criterion.focus_mass = lesser(criterion.focus_mass, criterion.mass);
                criterion.focus_on(focus);
                focused_rounds += 1;
            } else {
                without_progress += 1;
                if excess < LEAST_PROGRESS * least_excess {
                    (least_excess, without_progress) = (excess, 0);
                }
                if without_progress == ROUNDS_WITHOUT_PROGRESS {
                    return refined.into();
                }
            }
            // Until there is a face to be cut anew.
            loop {
                let mass = if means_are_tight { &mut criterion.focus_mass } else { &mut criterion.mass };
                *mass *= FINER;
                // Equal where both are zero, as on faces whose area rounds to zero.
                if *mass <= FINEST * first {
                    return refined.into();
                }
                let mut flagged = flag(&criterion, &refined.distribution);
                if !means_are_tight {
                    keep_the_worst(&mut flagged, excess, &refined.distribution);
                }
                let suffices =
                    || !means_are_tight || suffices(&criterion, excess_of_focus, &refined.distribution);
                if flagged.iter().any(|flag| *flag) && suffices() {
                    self.cut_again(&flagged, &criterion, &mut refined);
                    break;
                }
            }
        }
    }

    /// Makes the first criterion such that a few faces come out about as narrow as all should be.
    fn calibrate(&self, criterion: &mut Criterion) {
        let count = self.order.len();
        if count < LEAST_CALIBRATED {
            return;
        }
        let (faces, order, asked) = (self.faces, self.order, self.options.asked);
        let most = self.most(0, count);
        let size = (SAMPLED * (count / SAMPLES) as f64) as usize;
        let size = size.clamp(FACES_OF_SAMPLE.0, FACES_OF_SAMPLE.1);
        let mut pieces_before = usize::MAX;
        for trials_left in (0..CALIBRATIONS).rev() {
            let trial = &*criterion;
            let of_sample = |i: usize| {
                let first = (2 * i + 1) * count / (2 * SAMPLES);
                let some = &order[first..count.min(first + size)];
                faces.cut_task(some, trial, most, |_| true, None).portion
            };
            let sample = Distribution { portions: (0..SAMPLES).into_par_iter().map(of_sample).collect() };
            let Some(summary) = Summary::of(&sample, asked, faces.largest) else { return };
            if self.faces.control.is_stopped() {
                return;
            }
            let part = greater(self.excess(summary.mean), self.excess(summary.rms));
            let (least, most) = AIMED;
            let pieces = sample.len();
            let is_coarse = part < least && pieces as f64 > LEAST_FEWER * pieces_before as f64;
            pieces_before = pieces;
            let is_good = part.is_nan() || part <= 0.0 || is_coarse || (least..=most).contains(&part);
            // What the percentiles came out of.
            let tried = lesser(criterion.focus_mass, criterion.mass);
            if !is_good {
                // A coarser criterion may leave far more than in proportion, so that it must be tried.
                let most_factor = if trials_left > 0 { MOST_FACTOR } else { 1.0 };
                let factor = 0.5 * (least + most) / part;
                criterion.mass *= factor.clamp(1.0 / MOST_FACTOR, most_factor);
            }
            let worst =
                summary.percentiles.iter().fold(0.0, |worst, ends| greater(worst, self.excess(*ends)));
            let is_focused = worst <= AIMED_AT_PERCENTILES || worst.is_nan();
            if !is_focused {
                let wide = |ends: &&(f64, f64)| self.excess(**ends) > AIMED_AT_PERCENTILES;
                let around = |ends: &(f64, f64)| (ends.0 / BESIDE_PERCENTILES, ends.1 * BESIDE_PERCENTILES);
                criterion.focus = summary.percentiles.iter().filter(wide).map(around).collect();
                criterion.focus_mass =
                    tried * greater(NARROWER * AIMED_AT_PERCENTILES / worst, 1.0 / MOST_FACTOR);
            }
            if is_good && is_focused {
                return;
            }
        }
    }

    /// Faces of one task.
    pub(super) fn task(&self) -> usize {
        self.order.len().div_ceil(TASKS).clamp(1, TASK)
    }

    /// Pieces that each of some faces may be cut into.
    pub(super) fn most(&self, pieces: usize, faces: usize) -> usize {
        let (least, most) = PIECES_OF_FACE;
        (self.options.most_pieces.saturating_sub(pieces) / faces).clamp(least, most)
    }

    fn cut_all(&mut self, criterion: &Criterion, refined: &mut Kept) {
        refined.rounds += 1;
        let faces = self.faces;
        let task = self.task();
        let unknown = FaceBounds::unknown([0.0; 3], Slot::default(), faces.largest);
        refined.bounds = vec![unknown; self.order.len()];
        let mut left = self.order.len();
        let mut pieces = 0;
        for round in self.order.chunks(task * TASKS_PER_ROUND) {
            let most = self.most(pieces, round.len());
            let made: Vec<Made> = round
                .par_chunks(task)
                .with_max_len(1)
                .map(|task| faces.cut_task(task, criterion, most, |_| true, None))
                .collect();
            for (task, made) in round.chunks(task).zip(made) {
                refined.looks += made.looks;
                refined.distances += made.distances;
                pieces += made.portion.entries.len();
                refined.distribution.portions.push(made.portion);
                for (face, bounds) in task.iter().zip(made.bounds) {
                    refined.bounds[*face as usize] = bounds;
                }
            }
            left -= round.len();
            (self.watch)(refined.looks, pieces, left);
        }
    }

    /// Cuts the flagged faces again.
    fn cut_again(&mut self, flagged: &[bool], criterion: &Criterion, refined: &mut Kept) {
        refined.rounds += 1;
        let (faces, order) = (self.faces, self.order);
        let task = self.task();
        let mut left = flagged.iter().filter(|flag| **flag).count();
        let mut pieces = refined.distribution.len();
        let tasks: Vec<usize> =
            flagged.chunks(task).enumerate().filter(|(_, f)| f.contains(&true)).map(|(i, _)| i).collect();
        for round in tasks.chunks(TASKS_PER_ROUND) {
            let flags = |i: usize| &flagged[i * task..flagged.len().min((i + 1) * task)];
            let count = round.iter().map(|i| flags(*i).iter().filter(|flag| **flag).count()).sum();
            let most = self.most(pieces, count);
            let made: Vec<Made> = round
                .par_iter()
                .with_max_len(1)
                .map(|&i| {
                    let some = &order[i * task..order.len().min((i + 1) * task)];
                    let before = (&refined.distribution.portions[i], &refined.bounds[..]);
                    faces.cut_task(some, criterion, most, |face| flags(i)[face], Some(before))
                })
                .collect();
            for (i, made) in round.iter().zip(made) {
                refined.looks += made.looks;
                refined.distances += made.distances;
                let before = &mut refined.distribution.portions[*i];
                pieces = pieces + made.portion.entries.len() - before.entries.len();
                *before = made.portion;
                for (face, bounds) in order[i * task..].iter().zip(made.bounds) {
                    refined.bounds[*face as usize] = bounds;
                }
            }
            left -= count;
            (self.watch)(refined.looks, pieces, left);
            if self.faces.control.is_stopped() {
                return;
            }
        }
    }

    /// How many times wider than allowed an enclosure is.
    pub(super) fn excess(&self, (low, high): (f64, f64)) -> f64 {
        (high - low) / (self.options.accuracy * low + self.options.floor)
    }

    /// Ranges of distances in which pieces keep a statistic from being as narrow as asked.
    pub(super) fn focus(&self, summary: &Summary) -> Vec<(f64, f64)> {
        let RefinementOptions { accuracy, floor, asked, .. } = *self.options;
        let mut focus: Vec<(f64, f64)> =
            summary.percentiles.iter().copied().filter(|ends| !is_narrow(*ends, accuracy, floor)).collect();
        if let Some(((low, high), threshold)) = summary.above.zip(asked.threshold)
            && high - low > accuracy
        {
            focus.push((threshold, threshold));
        }
        focus
    }

    /// Sum of the widths that are too great, each relative to what is allowed.
    pub(super) fn doubt(&self, summary: &Summary) -> f64 {
        let RefinementOptions { accuracy, floor, .. } = *self.options;
        let excess = |width: f64, allowed: f64| greater(width / allowed - 1.0, 0.0);
        let percentiles = summary.percentiles.iter();
        let of_percentiles: f64 =
            percentiles.map(|(low, high)| excess(high - low, accuracy * low + floor)).sum();
        of_percentiles + summary.above.map_or(0.0, |(low, high)| excess(high - low, accuracy))
    }
}
