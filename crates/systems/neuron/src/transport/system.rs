//! The finite-volume equations of transport, and the fluxes between unknowns.

use super::discretisation::Discretisation;
use super::error::TransportError;
use super::flow::FlowField;
use super::parts::lists;
use super::problem::Parameters;
use pompeiu_solve::SparseMatrix;
use rayon::prelude::*;

/// A row, a column, and the value added there.
type Entry = (usize, usize, f64);

/// The equations: unknown `3 i + s` is kind s in cell i.
pub(super) struct System<'s> {
    pub(super) mesh: &'s Discretisation,
    pub(super) flow: &'s FlowField,
    pub(super) parameters: &'s Parameters,
    pub(super) inlet: u32,
}

/// A flux from one unknown to another per second; `None` is the outside.
pub(super) struct Flux {
    pub(super) from: Option<usize>,
    pub(super) to: Option<usize>,
    pub(super) amount: f64,
}

impl System<'_> {
    /// Signed speeds of the two kinds on motors.
    fn speeds(&self) -> [(usize, f64); 2] {
        [(1, self.parameters.speed_plus), (2, -self.parameters.speed_minus)]
    }

    /// The given free concentration at an end, and the incoming concentrations on motors.
    fn given(&self, cap: u32) -> (Option<f64>, [f64; 3]) {
        let p = self.parameters;
        if cap == self.inlet {
            (p.inlet_free, [0.0, p.inlet_plus, 0.0])
        } else {
            (p.tips_free, [0.0, 0.0, p.tips_minus])
        }
    }

    /// Volumes times a rate, in 1/s, plus the outflow of each unknown. Each part of the partition is assembled by one thread.
    pub(super) fn matrix(&self, rate: f64) -> Result<SparseMatrix, TransportError> {
        let n = 3 * self.mesh.volumes.len();
        let parts = &self.mesh.parts;
        let cells = lists(parts.iter().copied());
        let mut links: Vec<Vec<u32>> = vec![Vec::new(); cells.len()];
        for (k, ([a, b], _)) in self.mesh.links.iter().enumerate() {
            let [a, b] = [a, b].map(|&cell| parts[cell as usize] as usize);
            links[a].push(k as u32);
            if a != b {
                links[b].push(k as u32);
            }
        }
        let rows: Vec<Vec<Entry>> = cells
            .par_iter()
            .zip(&links)
            .enumerate()
            .map(|(part, (cells, links))| self.rows(part as u32, cells, links, rate))
            .collect();
        let mut entries = rows.concat();
        for (end, &out) in self.mesh.ends.iter().zip(&self.flow.out) {
            let at = 3 * end.cell as usize;
            if self.given(end.cap).0.is_some() {
                entries.push((at, at, self.parameters.diffusion * end.conductance));
            }
            for (kind, speed) in self.speeds() {
                entries.push((at + kind, at + kind, (speed * out).max(0.0)));
            }
        }
        Ok(SparseMatrix::from_triplets(n, n, &entries)?)
    }

    /// The rows of the cells of a part, without outflow through ends; entries at one place are in the same order for any parts.
    fn rows(&self, part: u32, cells: &[u32], links: &[u32], rate: f64) -> Vec<Entry> {
        let p = self.parameters;
        let mut entries = Vec::with_capacity(7 * cells.len() + 12 * links.len());
        for &cell in cells {
            let (at, volume) = (3 * cell as usize, self.mesh.volumes[cell as usize]);
            entries.extend([
                (at, at, volume * (rate + p.attach_plus + p.attach_minus)),
                (at, at + 1, -volume * p.detach_plus),
                (at, at + 2, -volume * p.detach_minus),
                (at + 1, at + 1, volume * (rate + p.detach_plus)),
                (at + 1, at, -volume * p.attach_plus),
                (at + 2, at + 2, volume * (rate + p.detach_minus)),
                (at + 2, at, -volume * p.attach_minus),
            ]);
        }
        let is_own = |unknown: usize| self.mesh.parts[unknown / 3] == part;
        for &k in links {
            let ([a, b], conductance) = self.mesh.links[k as usize];
            let (a, b) = (3 * a as usize, 3 * b as usize);
            let d = p.diffusion * conductance;
            let mut add = |entry: Entry| entries.extend(is_own(entry.0).then_some(entry));
            [(a, a, d), (a, b, -d), (b, b, d), (b, a, -d)].into_iter().for_each(&mut add);
            for (kind, speed) in self.speeds() {
                let q = speed * self.flow.through[k as usize];
                // From the source to the destination.
                let (from, to) = if q > 0.0 { (a + kind, b + kind) } else { (b + kind, a + kind) };
                [(from, from, q.abs()), (to, from, -q.abs())].into_iter().for_each(&mut add);
            }
        }
        entries
    }

    /// The inflow through the ends that does not depend on the state.
    pub(super) fn source(&self) -> Vec<f64> {
        let mut source = vec![0.0; 3 * self.mesh.volumes.len()];
        for (end, &out) in self.mesh.ends.iter().zip(&self.flow.out) {
            let at = 3 * end.cell as usize;
            let (free, carried) = self.given(end.cap);
            if let Some(free) = free {
                source[at] += self.parameters.diffusion * end.conductance * free;
            }
            for (kind, speed) in self.speeds() {
                source[at + kind] += (-speed * out).max(0.0) * carried[kind];
            }
        }
        source
    }

    /// The fluxes between unknowns and through the ends: always the same list, in the same order.
    pub(super) fn each_flux(&self, values: &[f64], mut act: impl FnMut(Flux)) {
        let p = self.parameters;
        let mut between = |from: usize, to: usize, amount: f64| {
            act(Flux { from: Some(from), to: Some(to), amount });
        };
        for (i, &volume) in self.mesh.volumes.iter().enumerate() {
            let at = 3 * i;
            let [free, plus, minus] = [values[at], values[at + 1], values[at + 2]];
            between(at, at + 1, volume * (p.attach_plus * free - p.detach_plus * plus));
            between(at, at + 2, volume * (p.attach_minus * free - p.detach_minus * minus));
        }
        for (&([a, b], conductance), &through) in self.mesh.links.iter().zip(&self.flow.through) {
            let (a, b) = (3 * a as usize, 3 * b as usize);
            between(a, b, p.diffusion * conductance * (values[a] - values[b]));
            for (kind, speed) in self.speeds() {
                let q = speed * through;
                between(a + kind, b + kind, q * values[if q > 0.0 { a } else { b } + kind]);
            }
        }
        self.each_end_flux(values, act);
    }

    /// The fluxes through the ends.
    pub(super) fn each_end_flux(&self, values: &[f64], mut act: impl FnMut(Flux)) {
        for (end, &out) in self.mesh.ends.iter().zip(&self.flow.out) {
            let at = 3 * end.cell as usize;
            let (free, carried) = self.given(end.cap);
            if let Some(free) = free {
                let amount = self.parameters.diffusion * end.conductance * (free - values[at]);
                act(Flux { from: None, to: Some(at), amount });
            }
            for (kind, speed) in self.speeds() {
                let q = speed * out;
                let amount = -q * if q > 0.0 { values[at + kind] } else { carried[kind] };
                act(Flux { from: None, to: Some(at + kind), amount });
            }
        }
    }

    /// The volume of the cell of an unknown.
    pub(super) fn volume(&self, unknown: usize) -> f64 {
        self.mesh.volumes[unknown / 3]
    }

    pub(super) fn mass(&self, values: &[f64]) -> f64 {
        values.iter().enumerate().map(|(k, x)| self.volume(k) * x).sum()
    }

    /// Mean concentrations over the faces of each flat end.
    pub(super) fn at_ends(&self, values: &[f64], caps: usize) -> Vec<[f64; 3]> {
        let mut sums = vec![([0.0; 3], 0.0); caps];
        for end in &self.mesh.ends {
            let (sum, area) = &mut sums[end.cap as usize];
            *area += end.area;
            for (kind, sum) in sum.iter_mut().enumerate() {
                *sum += end.area * values[3 * end.cell as usize + kind];
            }
        }
        sums.into_iter().map(|(sum, area)| sum.map(|x| x / area)).collect()
    }
}
