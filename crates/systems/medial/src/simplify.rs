//! Simplifying many balls to few.

use crate::ball::{Ball, distance};
use crate::quadric::Quadric;
use crate::sample::Sample;
use crate::shrink::Shrunk;
use glam::DVec3;
use pompeiu_core::run::Control;
use rayon::prelude::*;
use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

/// Number of nearest samples whose balls become neighbours.
const NEIGHBOURS: usize = 6;

/// Cost of a collapse by its length alone, relative to the fourth power of the diagonal.
const STABILITY: f64 = 1e-5;

/// Balls, their adjacency, and the planes that each should touch.
#[derive(Clone, Debug)]
pub(super) struct Net {
    balls: Vec<Ball>,
    quadrics: Vec<Quadric>,
    beside: Vec<BTreeSet<u32>>,
    /// Incremented when a ball changes.
    versions: Vec<u32>,
    is_left: Vec<bool>,
    left: usize,
}

/// The cost of a collapse, and the merged ball.
struct Collapse {
    cost: f64,
    ball: Ball,
}

impl Net {
    /// The balls of samples. The plane of each sample is assigned to its ball or, without one, to that of the nearest sample with a
    /// ball; so is the plane of the sample nearest to the ball's second contact point.
    pub(super) fn new(samples: &[Sample], shrunk: &[Option<Shrunk>]) -> Self {
        let kept: Vec<usize> = (0..samples.len()).filter(|&i| shrunk[i].is_some()).collect();
        let balls: Vec<Ball> = shrunk.iter().flatten().map(|found| found.ball).collect();
        let n = balls.len();
        let mut net = Self {
            balls,
            quadrics: vec![Quadric::default(); n],
            beside: vec![BTreeSet::new(); n],
            versions: vec![0; n],
            is_left: vec![true; n],
            left: n,
        };
        if n == 0 {
            return net;
        }
        let nearest_of = |p: DVec3, among: &mut dyn Iterator<Item = usize>| {
            let distance = |i: usize| (samples[i].place - p).length_squared();
            among.map(|i| (distance(i), i)).min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0, |(_, i)| i)
        };
        let mut number = vec![0_u32; samples.len()];
        for (k, &i) in kept.iter().enumerate() {
            number[i] = k as u32;
        }
        let owners: Vec<u32> = (0..samples.len())
            .into_par_iter()
            .map(|i| {
                let is_own = shrunk[i].is_some();
                number[if is_own { i } else { nearest_of(samples[i].place, &mut kept.iter().copied()) }]
            })
            .collect();
        for (sample, &owner) in samples.iter().zip(&owners) {
            net.quadrics[owner as usize] += plane(sample);
        }
        let opposites: Vec<usize> = kept
            .par_iter()
            .map(|&i| {
                nearest_of(shrunk[i].map_or(DVec3::ZERO, |found| found.opposite), &mut (0..samples.len()))
            })
            .collect();
        for (k, &opposite) in opposites.iter().enumerate() {
            net.quadrics[k] += plane(&samples[opposite]);
            net.link(k as u32, owners[opposite]);
        }
        let around: Vec<Vec<usize>> = (0..samples.len())
            .into_par_iter()
            .map(|i| {
                let place = samples[i].place;
                let mut others: Vec<(f64, usize)> = (0..samples.len())
                    .filter(|&j| j != i)
                    .map(|j| ((samples[j].place - place).length_squared(), j))
                    .collect();
                let count = NEIGHBOURS.min(others.len());
                if count < others.len() {
                    others.select_nth_unstable_by(count, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                }
                others[..count].iter().map(|(_, j)| *j).collect()
            })
            .collect();
        for (i, near) in around.iter().enumerate() {
            for &j in near {
                net.link(owners[i], owners[j]);
            }
        }
        net
    }

    pub(super) fn len(&self) -> usize {
        self.balls.len()
    }

    fn link(&mut self, a: u32, b: u32) {
        if a != b {
            self.beside[a as usize].insert(b);
            self.beside[b as usize].insert(a);
        }
    }

    /// Collapses edges until `count` balls are left or no edge is; returns the balls and their edges.
    pub(super) fn simplified(
        mut self,
        most: usize,
        diagonal: f64,
        control: &Control,
    ) -> (Vec<Ball>, Vec<[u32; 2]>) {
        let mut heap = BinaryHeap::new();
        for a in 0..self.balls.len() as u32 {
            for &b in self.beside[a as usize].iter().filter(|&&b| b > a) {
                heap.push(self.entry(a, b, diagonal));
            }
        }
        while self.left > most && !control.is_stopped() {
            let Some(Reverse((_, a, b, versions))) = heap.pop() else { break };
            let now = [a, b].map(|i| self.versions[i as usize]);
            if versions != now || !self.is_left[a as usize] || !self.is_left[b as usize] {
                continue;
            }
            self.balls[a as usize] = self.collapse(a, b, diagonal).ball;
            let other = self.quadrics[b as usize];
            self.quadrics[a as usize] += other;
            self.is_left[b as usize] = false;
            self.left -= 1;
            self.versions[a as usize] += 1;
            for c in std::mem::take(&mut self.beside[b as usize]) {
                self.beside[c as usize].remove(&b);
                self.link(a, c);
            }
            for &c in &self.beside[a as usize] {
                heap.push(self.entry(a.min(c), a.max(c), diagonal));
            }
        }
        let mut number = vec![0_u32; self.balls.len()];
        let mut balls = Vec::with_capacity(self.left);
        for i in (0..self.balls.len()).filter(|&i| self.is_left[i]) {
            number[i] = balls.len() as u32;
            balls.push(self.balls[i]);
        }
        let mut edges = Vec::new();
        for a in (0..self.balls.len()).filter(|&i| self.is_left[i]) {
            let further = self.beside[a].iter().filter(|&&b| b as usize > a);
            edges.extend(further.map(|&b| [number[a], number[b as usize]]));
        }
        (balls, edges)
    }

    #[allow(clippy::type_complexity, reason = "an entry of one heap")]
    fn entry(&self, a: u32, b: u32, diagonal: f64) -> Reverse<(u64, u32, u32, [u32; 2])> {
        let cost = self.collapse(a, b, diagonal).cost;
        // Costs are nonnegative, so their bits have the same order.
        Reverse((cost.to_bits(), a, b, [a, b].map(|i| self.versions[i as usize])))
    }

    /// The ball that replaces two: the minimum of their quadric, either of them, or the one halfway, whichever has the least cost.
    fn collapse(&self, a: u32, b: u32, diagonal: f64) -> Collapse {
        let [p, q] = [a, b].map(|i| self.balls[i as usize]);
        let mut quadric = self.quadrics[a as usize];
        quadric += self.quadrics[b as usize];
        let between = Ball {
            centre: [0, 1, 2].map(|k| 0.5 * (p.centre[k] + q.centre[k])),
            radius: 0.5 * (p.radius + q.radius),
        };
        let apart = distance(p.centre, q.centre);
        // If planes are few or nearly parallel, balls elsewhere also touch them.
        let least = quadric.least().filter(|ball| {
            distance(ball.centre, between.centre) <= apart && (ball.radius - between.radius).abs() <= apart
        });
        let candidates = [least, Some(p), Some(q), Some(between)];
        let value = |ball: &Ball| {
            let value = quadric.at(ball);
            if value > 0.0 { value } else { 0.0 }
        };
        let mut best = (value(&p), p);
        for ball in candidates.into_iter().flatten() {
            let value = value(&ball);
            if value < best.0 {
                best = (value, ball);
            }
        }
        // The part of the path from one ball to the other that lies outside of the larger one.
        let gap = apart - (p.radius - q.radius).abs();
        let share = if gap > 0.0 && apart > 0.0 { gap / apart } else { 0.0 };
        let squared = diagonal * diagonal;
        Collapse { cost: (best.0 / (squared * squared) + STABILITY) * share * share, ball: best.1 }
    }
}

fn plane(sample: &Sample) -> Quadric {
    Quadric::of_plane(sample.place.to_array(), sample.normal.to_array(), sample.area)
}
