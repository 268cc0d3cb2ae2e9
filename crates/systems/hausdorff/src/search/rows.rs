//! The faces of B that a piece is compared with, and how far its corners are from them.

use super::game::{MAX_ROWS, Row};
use super::piece::INHERITED;
use super::worker::SlotProof;
use pompeiu_core::spatial::{Nearest, Slot};

/// The rows of a game and the faces they belong to.
#[derive(Default)]
pub(crate) struct Rows {
    slots: [Option<Slot>; MAX_ROWS],
    distances: [Row; MAX_ROWS],
    count: usize,
}

impl Rows {
    pub(crate) fn push(&mut self, slot: Slot, row: Row) {
        self.slots[self.count] = Some(slot);
        self.distances[self.count] = row;
        self.count += 1;
    }

    /// The rows of the game, in the order they came.
    pub(crate) fn distances(&self) -> &[Row] {
        &self.distances[..self.count]
    }

    /// Whether a face is not there yet and another row fits in.
    pub(crate) fn has_room_for(&self, slot: Slot) -> bool {
        self.count < MAX_ROWS && !self.slots[..self.count].contains(&Some(slot))
    }

    /// The face that is nearest at the point with these weights, were distances linear in between.
    pub(crate) fn likely_nearest(&self, corners: [f64; 3]) -> Slot {
        let mut best = (f64::INFINITY, None);
        for (slot, row) in self.slots.iter().zip(self.distances()) {
            let mean = row[0] * corners[0] + row[1] * corners[1] + row[2] * corners[2];
            if mean < best.0 || best.1.is_none() {
                best = (mean, *slot);
            }
        }
        best.1.expect("a game has a row")
    }

    /// The best bound that one face alone gives.
    pub(crate) fn least_bound(&self) -> f64 {
        let greatest = |row: &Row| row[0].max(row[1]).max(row[2]);
        self.distances().iter().map(greatest).fold(f64::INFINITY, f64::min)
    }

    /// The corner farthest from all of the faces, with the nearest of them, if it is farther than a limit.
    pub(crate) fn uncovered_corner(&self, limit: f64) -> Option<(usize, Nearest)> {
        let mut farthest = limit;
        let mut found = None;
        for j in 0..3 {
            let mut least = (f64::INFINITY, None);
            for (slot, row) in self.slots.iter().zip(self.distances()) {
                if row[j] < least.0 {
                    least = (row[j], *slot);
                }
            }
            if let (distance, Some(slot)) = least
                && distance > farthest
            {
                farthest = distance;
                found = Some((j, Nearest { slot, distance_sq: distance * distance }));
            }
        }
        found
    }

    /// The faces, in the order of the rows.
    pub(crate) fn slots(&self) -> impl Iterator<Item = Slot> + '_ {
        self.slots[..self.count].iter().flatten().copied()
    }

    pub(crate) fn mixture(&self, weights: &[f64; MAX_ROWS]) -> SlotProof {
        let used = self.slots.iter().zip(weights).filter(|(_, w)| **w > 0.0);
        SlotProof::Mixture(used.filter_map(|(slot, w)| slot.map(|s| (s, *w))).collect())
    }

    /// What the parts of a piece start from: the nearest face, those of the best mixture, then the latest rows.
    pub(crate) fn inherited(&self, nearest: Slot, weights: &[f64; MAX_ROWS]) -> ([Slot; INHERITED], u8) {
        let mut near = [nearest; INHERITED];
        let mut count = 1;
        let rows = || self.slots.iter().zip(weights).rev().filter_map(|(slot, w)| slot.map(|s| (s, *w)));
        for (slot, _) in rows().filter(|(_, w)| *w > 0.0).chain(rows().filter(|(_, w)| *w <= 0.0)) {
            if count < INHERITED && !near[..count].contains(&slot) {
                near[count] = slot;
                count += 1;
            }
        }
        (near, count as u8)
    }
}
