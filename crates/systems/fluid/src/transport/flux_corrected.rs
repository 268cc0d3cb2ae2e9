//! Flux-corrected transport: conservative, second order, within bounds.

use super::Cells;

/// Largest Courant number of a substep that keeps bounds, with a margin for rounding.
const SUBSTEP_CFL: f64 = 1.0 - 1e-9;

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

    /// One step of Euler's method.
    fn euler(&self, density: &[f64], step: f64) -> Vec<f64> {
        let Fluxes { mut after, surplus, wanted } = self.fluxes(density, step);
        let bounds = self.bounds(density, &after);
        // The shares of its inflow and outflow that the bounds of a cell allow.
        let shares: Vec<[f64; 2]> = (0..density.len())
            .map(|i| {
                let [least, most] = bounds[i];
                let rooms = [most - after[i], after[i] - least];
                [0, 1].map(|k| share(rooms[k] * self.areas[i], wanted[i][k]))
            })
            .collect();
        let mut gained = vec![0.0; density.len()];
        for (side, amount) in self.sides.iter().zip(surplus) {
            let (from, to) = (side.from as usize, side.to as usize);
            let ([inflow, outflow], [other_inflow, other_outflow]) = (shares[from], shares[to]);
            let kept = positive(amount) * smaller(outflow, other_inflow)
                - positive(-amount) * smaller(inflow, other_outflow);
            gained[from] -= kept;
            gained[to] += kept;
        }
        self.add(&mut after, &gained);
        after
    }

    /// A step with donor-cell fluxes, and what central fluxes would do in addition.
    fn fluxes(&self, density: &[f64], step: f64) -> Fluxes {
        let mut gained = vec![0.0; density.len()];
        let mut surplus = Vec::with_capacity(self.sides.len());
        let mut wanted = vec![[0.0; 2]; density.len()];
        for side in &self.sides {
            let (from, to) = (side.from as usize, side.to as usize);
            let passed = step * side.flow;
            let moved = passed * density[from];
            gained[from] -= moved;
            gained[to] += moved;
            let amount = 0.5 * passed * (density[to] - density[from]);
            let (along, against) = (positive(amount), positive(-amount));
            wanted[from] = [wanted[from][0] + against, wanted[from][1] + along];
            wanted[to] = [wanted[to][0] + along, wanted[to][1] + against];
            surplus.push(amount);
        }
        let mut after = density.to_vec();
        self.add(&mut after, &gained);
        Fluxes { after, surplus, wanted }
    }

    /// Adds amounts to densities.
    fn add(&self, density: &mut [f64], amounts: &[f64]) {
        for ((x, amount), area) in density.iter_mut().zip(amounts).zip(self.areas) {
            *x += amount / area;
        }
    }

    /// The least and the greatest value around each cell, before and after.
    fn bounds(&self, before: &[f64], after: &[f64]) -> Vec<[f64; 2]> {
        let own: Vec<[f64; 2]> =
            before.iter().zip(after).map(|(&x, &y)| if x < y { [x, y] } else { [y, x] }).collect();
        let mut around = own.clone();
        let widened = |[least, most]: [f64; 2], other: [f64; 2]| {
            [if other[0] < least { other[0] } else { least }, if other[1] > most { other[1] } else { most }]
        };
        for side in &self.sides {
            let (from, to) = (side.from as usize, side.to as usize);
            around[from] = widened(around[from], own[to]);
            around[to] = widened(around[to], own[from]);
        }
        around
    }
}

/// What a step moves through the sides of cells.
struct Fluxes {
    /// The densities after a step with donor-cell fluxes.
    after: Vec<f64>,
    /// For each side the amount by which the central flux exceeds that, from its first cell to its second.
    surplus: Vec<f64>,
    /// For each cell the inflow and the outflow by these amounts.
    wanted: Vec<[f64; 2]>,
}

/// The smaller number.
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The number, or zero if it is negative.
fn positive(x: f64) -> f64 {
    if x > 0.0 { x } else { 0.0 }
}

/// The share of an amount for which there is room.
fn share(room: f64, wanted: f64) -> f64 {
    if wanted <= room {
        1.0
    } else if room > 0.0 {
        room / wanted
    } else {
        0.0
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
