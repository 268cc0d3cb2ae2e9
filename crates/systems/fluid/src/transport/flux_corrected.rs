//! Flux-corrected transport: conservative, second order, within bounds.

use super::Cells;

/// Largest Courant number of a substep that keeps bounds, with a margin for rounding.
const SUBSTEP_CFL: f64 = 0.9;

impl Cells<'_> {
    /// Transports a density for some time, in substeps.
    ///
    /// # Definition
    /// Donor-cell fluxes, which keep bounds, plus the part of the difference to central fluxes that does not exceed the values of
    /// the neighbours before and after (Zalesak's flux correction); the strong-stability-preserving Runge–Kutta method of third
    /// order. The outflow of one cell is the inflow of another, so mass is conserved to rounding.
    /// # Source
    /// `zalesak_fully_1979`, `shu_efficient_1988`.
    pub(crate) fn carry(&self, density: &mut [f64], time: f64) {
        let substeps = substeps(self.cfl(time));
        let step = time / substeps as f64;
        for _ in 0..substeps {
            let first = self.euler(density, step);
            let mut second = self.euler(&first, step);
            mix(&mut second, 0.25, density, 0.75);
            let third = self.euler(&second, step);
            mix(density, 1.0 / 3.0, &third, 2.0 / 3.0);
        }
    }

    /// Each side with its cells: for a positive amount the donor comes first.
    fn sides<'a>(&'a self, amounts: &'a [f64]) -> impl Iterator<Item = ([usize; 2], f64)> + 'a {
        self.ends.iter().zip(amounts).map(|(&[a, b], &amount)| {
            let (a, b) = (a as usize, b as usize);
            (if amount > 0.0 { [a, b] } else { [b, a] }, amount.abs())
        })
    }

    /// One step of Euler's method.
    fn euler(&self, density: &[f64], step: f64) -> Vec<f64> {
        let mut after = density.to_vec();
        let mut surplus = Vec::with_capacity(self.ends.len());
        for (&[a, b], &flow) in self.ends.iter().zip(&self.flows) {
            let (a, b) = (a as usize, b as usize);
            let donor = if flow > 0.0 { density[a] } else { density[b] };
            let moved = step * flow * donor;
            after[a] -= moved / self.areas[a];
            after[b] += moved / self.areas[b];
            surplus.push(step * flow * (0.5 * (density[a] + density[b]) - donor));
        }
        let bounds = self.bounds(density, &after);
        // The possible inflow and outflow of each cell, and the shares that the bounds allow.
        let mut wanted = vec![[0.0; 2]; density.len()];
        for ([giver, taker], amount) in self.sides(&surplus) {
            wanted[taker][0] += amount;
            wanted[giver][1] += amount;
        }
        let share = |room: f64, wanted: f64| {
            if wanted <= room {
                1.0
            } else if room > 0.0 {
                room / wanted
            } else {
                0.0
            }
        };
        let shares: Vec<[f64; 2]> = (0..density.len())
            .map(|i| {
                let [least, most] = bounds[i];
                let rooms = [most - after[i], after[i] - least];
                [0, 1].map(|k| share(rooms[k] * self.areas[i], wanted[i][k]))
            })
            .collect();
        for ([giver, taker], amount) in self.sides(&surplus) {
            let (a, b) = (shares[taker][0], shares[giver][1]);
            let kept = amount * if a < b { a } else { b };
            after[giver] -= kept / self.areas[giver];
            after[taker] += kept / self.areas[taker];
        }
        after
    }

    /// The least and the greatest value around each cell, before and after.
    fn bounds(&self, before: &[f64], after: &[f64]) -> Vec<[f64; 2]> {
        let own: Vec<[f64; 2]> =
            before.iter().zip(after).map(|(&x, &y)| if x < y { [x, y] } else { [y, x] }).collect();
        let mut around = own.clone();
        let widen = |bounds: &mut [f64; 2], other: [f64; 2]| {
            if other[0] < bounds[0] {
                bounds[0] = other[0];
            }
            if other[1] > bounds[1] {
                bounds[1] = other[1];
            }
        };
        for (&[a, b], &flow) in self.ends.iter().zip(&self.flows) {
            if flow != 0.0 {
                widen(&mut around[a as usize], own[b as usize]);
                widen(&mut around[b as usize], own[a as usize]);
            }
        }
        around
    }
}

/// The number of substeps for a Courant number.
fn substeps(cfl: f64) -> usize {
    let count = (cfl / SUBSTEP_CFL).ceil();
    if count > 1.0 { count as usize } else { 1 }
}

/// `a := share · a + other · b`.
fn mix(a: &mut [f64], share: f64, b: &[f64], other: f64) {
    for (x, y) in a.iter_mut().zip(b) {
        *x = share * *x + other * y;
    }
}
