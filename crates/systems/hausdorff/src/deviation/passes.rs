//! Passes over all faces, whose pieces are summed up and not kept.
//!
//! The first criterion is calibrated so that one pass is enough as a rule. Where statistics come out too wide, all faces are cut again: what was
//! summed up cannot be taken back. So a limit that ends a later pass leaves what the one before it found.

use super::bounds::FaceBounds;
use super::criterion::Criterion;
use super::entry::{Moments, Sum};
use super::grid::{Ruler, SharedGrids};
use super::linear::{greater, lesser};
use super::pieces::{Pieces, Summed};
use super::refine::{
    FOCUSED_ROUNDS, LEAST_PROGRESS, ROUNDS_WITHOUT_PROGRESS, Refined, Refinement, TASKS_PER_ROUND,
};
use super::rough::Rough;
use super::statistics::{Summary, is_narrow};
use super::task;
use pompeiu_core::spatial::Slot;
use rayon::prelude::*;

/// The part of the allowed width at which a later pass aims, and how much finer it is, at least and at most.
const AIMED: f64 = 0.7;
const FINER: (f64, f64) = (0.5, 1.0 / 64.0);

impl Refinement<'_> {
    pub(super) fn run_in_passes(mut self, mut criterion: Criterion) -> Refined {
        let (accuracy, floor) = (self.options.accuracy, criterion.floor);
        let mut best: Option<Refined> = None;
        let (mut focused_passes, mut doubt_before) = (0, f64::INFINITY);
        let (mut least_excess, mut without_progress) = (f64::INFINITY, 0);
        loop {
            let mut pass = self.pass(&criterion);
            let is_stopped = self.faces.control.is_stopped();
            if let Some(before) = best.take() {
                pass.include_work(&before);
                if is_stopped {
                    return Refined {
                        looks: pass.looks,
                        distances: pass.distances,
                        rounds: pass.rounds,
                        ..before
                    };
                }
            }
            let Some(summary) = &pass.summary else {
                return Refined { tight: true, ..pass };
            };
            let means = [summary.mean, summary.rms];
            let means_are_tight = means.into_iter().all(|ends| is_narrow(ends, accuracy, floor));
            let focus = self.focus(summary);
            let tight = means_are_tight && focus.is_empty();
            if tight || is_stopped {
                return Refined { tight, ..pass };
            }
            if means_are_tight {
                let doubt = self.doubt(summary);
                if focused_passes == FOCUSED_ROUNDS || doubt > LEAST_PROGRESS * doubt_before {
                    return pass;
                }
                doubt_before = doubt;
                focused_passes += 1;
                let worst =
                    summary.percentiles.iter().fold(1.0, |worst, ends| greater(worst, self.excess(*ends)));
                criterion.focus_mass = finer(lesser(criterion.focus_mass, criterion.mass), worst);
                criterion.focus_on(focus);
            } else {
                let excess = means.into_iter().fold(0.0, |worst, ends| greater(worst, self.excess(ends)));
                without_progress += 1;
                if excess < LEAST_PROGRESS * least_excess {
                    (least_excess, without_progress) = (excess, 0);
                }
                if without_progress == ROUNDS_WITHOUT_PROGRESS {
                    return pass;
                }
                criterion.mass = finer(criterion.mass, excess);
            }
            best = Some(pass);
        }
    }

    /// Cuts all faces.
    fn pass(&mut self, criterion: &Criterion) -> Refined {
        let faces = self.faces;
        let task = self.task();
        let unknown = FaceBounds::unknown([0.0; 3], Slot::default(), faces.largest);
        let mut bounds = vec![unknown; self.order.len()];
        let ruler = Ruler::new(self.options.total, faces.rounding, self.options.floor);
        let grids = SharedGrids::new(ruler, &criterion.focus);
        let level = self.options.asked.threshold;
        let (mut moments, mut up_to) = (Moments::default(), Sum::default());
        let (mut looks, mut distances, mut pieces) = (0, 0, 0);
        let mut left = self.order.len();
        let rough = self.tell_mean.is_some().then(|| Rough::new(faces, self.order, task * TASKS_PER_ROUND));
        self.tell_mean_of(rough.as_ref(), 0, moments);
        for (i, round) in self.order.chunks(task * TASKS_PER_ROUND).enumerate() {
            let most = self.most(pieces, round.len());
            let made: Vec<task::Summed> = round
                .par_chunks(task)
                .with_max_len(1)
                .map(|task| faces.sum_task(task, criterion, most, &grids, level))
                .collect();
            for (task, made) in round.chunks(task).zip(made) {
                looks += made.looks;
                distances += made.distances;
                pieces += made.entries;
                moments = moments.plus(made.moments);
                up_to = up_to.plus(made.up_to);
                for (face, of_face) in task.iter().zip(made.bounds) {
                    bounds[*face as usize] = of_face;
                }
            }
            left -= round.len();
            self.tell_mean_of(rough.as_ref(), i + 1, moments);
            (self.watch)(looks, pieces, left);
        }
        let up_to = level.map(|level| (level, up_to));
        let summed = Summed { moments, areas: grids.areas().into_iter().collect(), up_to };
        let summary = Summary::of(&summed, self.options.asked, faces.largest);
        Refined { pieces: Pieces::Summed(summed), bounds, summary, tight: false, looks, distances, rounds: 1 }
    }
}

impl Refinement<'_> {
    /// Tells between which ends the mean lies after so many rounds.
    fn tell_mean_of(&mut self, rough: Option<&Rough>, rounds: usize, done: Moments) {
        if let (Some(tell), Some(rough)) = (&mut self.tell_mean, rough)
            && let Some(mean) = rough.mean(rounds, done, self.faces.largest)
        {
            let within =
                self.known_mean.map_or(mean, |(low, high)| (greater(low, mean.0), lesser(high, mean.1)));
            self.known_mean = Some(within);
            tell(within);
        }
    }
}

impl Refined {
    /// Counts what an earlier pass took.
    fn include_work(&mut self, before: &Self) {
        self.looks += before.looks;
        self.distances += before.distances;
        self.rounds += before.rounds;
    }
}

/// What pieces may leave undecided in the next pass, where statistics are so many times too wide.
fn finer(mass: f64, excess: f64) -> f64 {
    let (least, most) = FINER;
    let part = AIMED / excess;
    mass * greater(lesser(part, least), most)
}
