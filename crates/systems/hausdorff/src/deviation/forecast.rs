//! About how much of an area is up to how far away.

use super::linear::{Corners, greater, lesser};

/// Places on a grid between which slopes may change, at least.
const LEAST_RISE: f64 = 0.25;

/// About how much area is up to how far away: where to look for percentiles.
///
/// How the area of a triangle with a linear function is distributed over its values is a piecewise linear density with three
/// corners. Where these corners are, and how much the slope changes there, is summed up on a grid.
pub(super) struct Forecast {
    per_length: f64,
    /// Changes of slope at the places of the grid.
    bends: Vec<f64>,
    /// Areas that lie at a place as far as the grid can tell.
    lumps: Vec<f64>,
}

impl Forecast {
    const PLACES: usize = 4096;

    pub(super) fn new(largest: f64) -> Self {
        // One more at each end, for what reaches over it.
        let zero = vec![0.0; Self::PLACES + 4];
        Self { per_length: Self::PLACES as f64 / largest, bends: zero.clone(), lumps: zero }
    }

    pub(super) fn add(&mut self, v: Corners, area: f64) {
        let at = |x: f64| 1.0 + lesser(greater(x * self.per_length, 0.0), Self::PLACES as f64);
        let [a, b, c] = super::linear::ascending(v).map(at);
        let share = |row: &mut [f64], x: f64, amount: f64| {
            // Casting saturates, and takes what is no number for zero.
            let place = (x as usize).min(Self::PLACES + 2);
            let part = x - place as f64;
            row[place] += amount * (1.0 - part);
            row[place + 1] += amount * part;
        };
        if c - a < 1.0 {
            share(&mut self.lumps, (a + b + c) * (1.0 / 3.0), area);
            return;
        }
        let (rise, fall) = (greater(b - a, LEAST_RISE), greater(c - b, LEAST_RISE));
        let height = 2.0 * area / (rise + fall);
        share(&mut self.bends, b - rise, height / rise);
        share(&mut self.bends, b, -height / rise - height / fall);
        share(&mut self.bends, b + fall, height / fall);
    }

    pub(super) fn plus(mut self, other: &Self) -> Self {
        let both = self.bends.iter_mut().chain(&mut self.lumps);
        for (sum, more) in both.zip(other.bends.iter().chain(&other.lumps)) {
            *sum += more;
        }
        self
    }

    /// About the least distances that shares of the area do not exceed.
    pub(super) fn levels(&self, shares: &[f64]) -> Vec<f64> {
        let (mut slope, mut density, mut sum) = (0.0, 0.0, 0.0);
        let step = |(bend, lump): (&f64, &f64)| {
            let before = density;
            density += slope;
            slope += bend;
            sum += 0.5 * (before + density) + lump;
            sum
        };
        let sums: Vec<f64> = self.bends.iter().zip(&self.lumps).map(step).collect();
        let of_share = |share: &f64| {
            let wanted = share * sum;
            let place = sums.partition_point(|sum| *sum < wanted);
            let before = if place > 0 { sums[place - 1] } else { 0.0 };
            let here = sums.get(place).copied().unwrap_or(wanted);
            let part = if here > before { (wanted - before) / (here - before) } else { 0.0 };
            greater(place as f64 - 2.0 + part, 0.0) / self.per_length
        };
        shares.iter().map(of_share).collect()
    }
}
