//! Separating pieces that overlap on a strip: steps of all pieces, then moves of single ones.

use super::body::{Pose, Push};
use super::strip::Strip;
use pompeiu_core::run::Control;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

/// Share of the steps to the least sum that all pieces take at once: of two pieces that overlap, both move.
const SHARE: f64 = 0.6;

/// Damping of steps, and the longest, relative to the side of a piece.
const DAMPING: f64 = 1e-3;
const LONGEST_STEP: f64 = 0.1;

/// Steps end when so many leave more than this share of the sum.
const STEPS: usize = 24;
const SLOW: f64 = 0.7;

/// Places that are looked at for a piece: other angles, places near and far, and those of other pieces.
const TURNS: usize = 8;
const ANYWHERE: usize = 8;
const EXCHANGES: usize = 6;

/// The distance of places that are near, in sides of a piece.
const NEARBY: f64 = 2.0;

/// Places that may cost so many times what the present one does, before steps from them.
const RAW: f64 = 8.0;

/// Places from which steps are taken, and how many.
const REFINED: usize = 4;
const REFINING_STEPS: usize = 8;

/// A new place of a piece, in exchange with another one or not, and what it costs more.
#[derive(Clone, Copy, Debug)]
struct Move {
    cost: f64,
    pose: Pose,
    exchange: Option<(usize, Pose)>,
    work: u64,
}

impl Strip<'_> {
    /// Whether pieces become separated within some rounds of steps and moves, and with an amount of work in all.
    pub(super) fn separate(&mut self, rounds: usize, most_work: u64, control: &Control) -> bool {
        for _ in 0..rounds {
            let depths = self.relax(most_work, control);
            let deep: Vec<usize> = (0..depths.len()).filter(|i| depths[*i] > self.no_depth()).collect();
            if deep.is_empty() {
                return true;
            }
            if self.work > most_work || control.is_stopped() {
                return false;
            }
            self.weigh();
            self.move_each(deep, most_work);
        }
        false
    }

    /// Moves all pieces at once, until none is too deep or the sum hardly gets less; returns their depths.
    pub(super) fn relax(&mut self, most_work: u64, control: &Control) -> Vec<f64> {
        let pieces = self.poses.len();
        let mut found = vec![Push::default(); pieces];
        let mut has_moved = vec![true; pieces];
        let mut last = f64::INFINITY;
        for step in 1.. {
            found = self.pushes(&found, &has_moved);
            let deepest = found.iter().map(|push| push.deepest).fold(0.0, f64::max);
            if deepest <= self.no_depth() || self.work > most_work || control.is_stopped() {
                break;
            }
            if step % STEPS == 0 {
                let sum: f64 = found.iter().map(|push| push.energy).sum();
                if sum > SLOW * last {
                    break;
                }
                last = sum;
            }
            for i in 0..pieces {
                has_moved[i] = found[i].energy > 0.0;
                if has_moved[i] {
                    self.poses[i] = self.stepped(&self.poses[i], &found[i], SHARE);
                }
            }
        }
        found.into_iter().map(|push| push.deepest).collect()
    }

    /// A pose after a share of the step to the least sum.
    fn stepped(&self, pose: &Pose, push: &Push, share: f64) -> Pose {
        let length = 0.5 * self.unit;
        let most = LONGEST_STEP * self.unit;
        let [x, y, turn] = push.step(length, DAMPING).map(|step| (share * step).clamp(-most, most));
        Pose::new([pose.at[0] + x, pose.at[1] + y], pose.angle + turn / length)
    }

    /// Moves single pieces, one after the other in random order.
    fn move_each(&mut self, mut pieces: Vec<usize>, most_work: u64) {
        for i in (1..pieces.len()).rev() {
            pieces.swap(i, self.random.below(i as u32 + 1) as usize);
        }
        for piece in pieces {
            if self.work > most_work {
                return;
            }
            self.move_one(piece);
        }
    }

    /// Puts a piece where it costs less, alone or in exchange with another one.
    fn move_one(&mut self, piece: usize) {
        let (here, work) = self.energy(piece, &self.poses[piece], piece, f64::INFINITY);
        self.work += work;
        if here <= 0.0 {
            return;
        }
        let tries = self.tries(piece);
        let this = &*self;
        let found = tries.par_iter().map(|(pose, other)| this.raw(piece, here, pose, *other));
        let mut found: Vec<Move> = found.collect();
        self.work += found.iter().map(|found| found.work).sum::<u64>();
        // Sorting is stable: of equal ones the first comes first.
        found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        found.truncate(REFINED);
        found.retain(|found| found.cost < f64::INFINITY);
        let this = &*self;
        let refined: Vec<Move> = found.par_iter().map(|found| this.refined(piece, here, found)).collect();
        self.work += refined.iter().map(|found| found.work).sum::<u64>();
        let best = refined.into_iter().min_by(|a, b| a.cost.total_cmp(&b.cost));
        if let Some(Move { pose, exchange, .. }) = best.filter(|best| best.cost < 0.0) {
            self.put(piece, pose);
            if let Some((other, pose)) = exchange {
                self.put(other, pose);
            }
        }
    }

    /// Places to look at for a piece, and the piece that is there; the piece itself where there is none.
    fn tries(&mut self, piece: usize) -> Vec<(Pose, usize)> {
        let now = self.poses[piece];
        let turned = |k: usize| Pose::new(now.at, now.angle + k as f64 * 2.0 * PI / TURNS as f64);
        let mut tries: Vec<(Pose, usize)> = (1..TURNS).map(|k| (turned(k), piece)).collect();
        for k in 0..ANYWHERE {
            let is_far = k % 2 == 0;
            let at = [0, 1].map(|axis| {
                let random = self.random.signed_unit();
                if is_far {
                    0.5 * (1.0 + random) * self.size[axis]
                } else {
                    now.at[axis] + NEARBY * self.unit * random
                }
            });
            tries.push((Pose::new(at, now.angle + PI * self.random.signed_unit()), piece));
        }
        let mut around = Vec::new();
        self.near.each(now.at, |other| around.push(other));
        for k in 0..EXCHANGES {
            let other = if k % 2 == 0 {
                around.get(self.random.below(around.len() as u32) as usize).copied()
            } else {
                Some(self.random.below(self.poses.len() as u32) as usize)
            };
            tries.extend(other.filter(|other| *other != piece).map(|other| (self.poses[other], other)));
        }
        tries
    }

    /// The cost of a place without steps, over quarters of a turn where pieces are exchanged.
    fn raw(&self, piece: usize, here: f64, pose: &Pose, other: usize) -> Move {
        if other == piece {
            let (cost, work) = self.energy(piece, pose, piece, RAW * here);
            return Move { cost: cost - here, pose: *pose, exchange: None, work };
        }
        let (there, mut work) = self.energy(other, &self.poses[other], piece, f64::INFINITY);
        let both = here + there;
        let mut best = |piece: usize, pose: &Pose, without: usize, most: f64| {
            let turned = (0..4).map(|k| Pose::new(pose.at, pose.angle + f64::from(k) * FRAC_PI_2));
            let costs = turned.map(|pose| {
                let (cost, more) = self.energy(piece, &pose, without, most);
                work += more;
                (cost, pose)
            });
            costs.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, *pose))
        };
        let (first, pose) = best(piece, pose, other, RAW * both);
        let (second, exchanged) = if first <= RAW * both {
            best(other, &self.poses[piece], piece, RAW * both - first)
        } else {
            (f64::INFINITY, self.poses[piece])
        };
        Move { cost: first + second - both, pose, exchange: Some((other, exchanged)), work }
    }

    /// A move after some steps of the pieces that move.
    fn refined(&self, piece: usize, here: f64, from: &Move) -> Move {
        let Move { mut pose, exchange, .. } = *from;
        let mut work = 0;
        let mut refine = |piece: usize, pose: &mut Pose, without: usize| {
            for _ in 0..REFINING_STEPS {
                let (push, more) = self.push(piece, pose, without);
                work += more;
                if push.energy <= 0.0 {
                    break;
                }
                *pose = self.stepped(pose, &push, 1.0);
            }
            let (cost, more) = self.energy(piece, pose, without, f64::INFINITY);
            work += more;
            cost
        };
        let Some((other, mut exchanged)) = exchange else {
            let cost = refine(piece, &mut pose, piece) - here;
            return Move { cost, pose, exchange, work };
        };
        let after = refine(piece, &mut pose, other) + refine(other, &mut exchanged, piece);
        let (there, more) = self.energy(other, &self.poses[other], piece, f64::INFINITY);
        let cost = after + self.energy_of_pair([piece, other], [&pose, &exchanged]) - here - there;
        Move { cost, pose, exchange: Some((other, exchanged)), work: work + more }
    }
}
