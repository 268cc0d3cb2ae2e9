//! Shortening the part of a strip that pieces need.

use super::apart::too_near;
use super::body::Pose;
use super::strip::Strip;
use pompeiu_core::run::Control;
use pompeiu_planar::bounds;

/// How much shorter a strip with up to so many pieces is made at once at first, relative to its length; less with the square root of
/// their number for more, because all of them have to come apart. What is left of that after each failure, and the least.
const FIRST_STEP: f64 = 0.04;
const FEW: f64 = 100.0;
const NEXT_STEP: f64 = 0.7;
const LEAST_STEP: f64 = 0.004;

/// How much shorter a strip is made without moves of many single pieces, as long as that works.
const SQUEEZES: [f64; 2] = [0.01, 0.003];

/// Rounds of steps and moves after a strip became shorter, in squeezes, and after it became longer again.
const ROUNDS: usize = 20;
const SQUEEZING_ROUNDS: usize = 2;
const MORE_ROUNDS: usize = 5;

/// Factor by which a strip becomes longer where pieces do not come apart.
const EXPANSION: f64 = 1.004;

/// Pairs of pieces that are looked at, for each of few pieces; for any larger number of pieces, and for each one more. Squeezes have a
/// part of that in addition.
const WORK_EACH_OF_FEW: u64 = 60_000;
const WORK: u64 = 2_500_000;
const WORK_EACH: u64 = 4_000;
const SQUEEZING_PART: u64 = 10;

/// Rounds in which pairs that are too near are kept farther apart, those after which the strip becomes longer, and by which factor.
const CORRECTIONS: usize = 40;
const CORRECTIONS_AT_ONCE: usize = 4;
const CORRECTING_EXPANSION: f64 = 1.001;

/// The least by which such a pair is kept farther apart, relative to the side of a piece.
const LEAST_CORRECTION: f64 = 1e-4;

/// What paths keep more than a cut, relative to the side of a piece, so that rounding takes nothing from it.
pub(super) const ROUNDING: f64 = 1e-9;

/// The strip whose pieces lie apart, and its length.
struct Best {
    length: f64,
    poses: Vec<Pose>,
}

/// How an attempt to shorten a strip goes on.
struct Attempt {
    /// How much shorter it becomes, relative to its length.
    step: f64,
    rounds: usize,
    /// Whether it may become longer again, but not as long as it was.
    may_expand: bool,
    /// The work after which it ends.
    most_work: u64,
}

/// Places on a shorter part of a strip, for pieces that lie apart on it. `tell` is called with the share of the work that is done.
///
/// # Definition
/// The strip is made shorter, pieces that then overlap are separated, and the strip becomes a little longer while that fails. Places
/// are taken only if all paths are a cut apart and half a cut from the edges, decided on all their sides.
///
/// # Cost
/// A counted number of pairs of pieces that are looked at, whatever comes of it; less where shorter strips fail.
///
/// # Source
/// `imamichi_iterated_2009` for separation by descent and exchanges, `umetani_solving_2009` for the weights of a guided local search,
/// `gardeyn_open_2025` for strips that become shorter step by step. Overlaps are squared depths in fields of distances here, not
/// no-fit polygons or circles.
pub(super) fn shrink(mut strip: Strip<'_>, control: &Control, tell: &dyn Fn(f64)) -> Vec<Pose> {
    let mut best = Best { length: strip.size[1], poses: strip.poses.clone() };
    let pieces = best.poses.len() as u64;
    let whole = (WORK_EACH_OF_FEW * pieces).min(WORK + WORK_EACH * pieces);
    let mut step = FIRST_STEP * (FEW / pieces as f64).sqrt().min(1.0);
    loop {
        tell((strip.work as f64 / whole as f64).min(1.0));
        let most_work = strip.work + whole / SQUEEZING_PART;
        for step in SQUEEZES {
            let squeeze = Attempt { step, rounds: SQUEEZING_ROUNDS, may_expand: false, most_work };
            while squeeze.run(&mut strip, &mut best, control) {}
        }
        if strip.work >= whole || step < LEAST_STEP || control.is_stopped() {
            return best.poses;
        }
        let attempt = Attempt { step, rounds: ROUNDS, may_expand: true, most_work: whole };
        if !attempt.run(&mut strip, &mut best, control) {
            step *= NEXT_STEP;
        }
    }
}

impl Attempt {
    /// Whether a shorter strip was found.
    fn run(&self, strip: &mut Strip<'_>, best: &mut Best, control: &Control) -> bool {
        strip.restart(&best.poses, best.length, (1.0 - self.step) * best.length);
        let mut is_separated = strip.separate(self.rounds, self.most_work, control);
        while self.may_expand && !is_separated && strip.size[1] * EXPANSION < best.length {
            if strip.work > self.most_work || control.is_stopped() {
                return false;
            }
            strip.scale(EXPANSION);
            is_separated = strip.separate(MORE_ROUNDS, self.most_work, control);
        }
        if !is_separated || !self.correct(strip, best.length, control) {
            return false;
        }
        let length = strip.length();
        let is_shorter = length < best.length;
        if is_shorter {
            *best = Best { length, poses: strip.poses.clone() };
        }
        is_shorter
    }

    /// Moves pieces that are nearly apart until their paths are, and to the beginning of the strip; false if that fails.
    fn correct(&self, strip: &mut Strip<'_>, most: f64, control: &Control) -> bool {
        let (unit, kerf) = (strip.unit, strip.kerf);
        let least = kerf + ROUNDING * unit;
        for round in 1..=CORRECTIONS {
            let paths = strip.paths();
            let found = too_near(&paths, least);
            if found.is_empty() {
                let around = paths.iter().map(|path| bounds(path));
                let [low, high] = around.fold(bounds(&[]), |[a, b], [c, d]| {
                    [[0, 1].map(|k| a[k].min(c[k])), [0, 1].map(|k| b[k].max(d[k]))]
                });
                for pose in &mut strip.poses {
                    pose.at[1] += 0.5 * kerf - low[1];
                }
                return low[0] >= 0.5 * kerf && high[0] <= strip.size[0] - 0.5 * kerf;
            }
            if control.is_stopped() {
                return false;
            }
            for (i, j, distance) in found {
                strip.keep_more(i, j, (least - distance).max(LEAST_CORRECTION * unit));
            }
            if round % CORRECTIONS_AT_ONCE == 0 {
                if strip.size[1] * CORRECTING_EXPANSION >= most {
                    return false;
                }
                strip.scale(CORRECTING_EXPANSION);
            }
            strip.relax(self.most_work.max(strip.work + 1), control);
        }
        false
    }
}
