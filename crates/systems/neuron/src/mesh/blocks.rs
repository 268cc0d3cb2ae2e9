//! Coarse cells, and their refinement into equal parts.

use std::collections::HashMap;

/// A vertex of the refinement: the corners that it is a combination of, with integer weights, in order of corners. Cells that share a
/// face give the same combinations to the vertices on it, so that the refinement conforms where the cells do.
pub(super) type Key = [(u32, u32); 8];

/// No corner.
const NONE: (u32, u32) = (u32::MAX, 0);

/// The places of the eight corners of a cell.
const PLACES: [[usize; 3]; 8] =
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

/// Vertices of a refinement into `parts` along each edge.
pub(super) struct Refinement {
    parts: usize,
    index: HashMap<Key, u32>,
    /// The keys, in order of the vertices.
    pub(super) keys: Vec<Key>,
}

impl Refinement {
    pub(super) fn new(parts: usize) -> Self {
        Self { parts, index: HashMap::new(), keys: Vec::new() }
    }

    /// The vertex of a key.
    pub(super) fn vertex(&mut self, key: Key) -> u32 {
        *self.index.entry(key).or_insert_with(|| {
            self.keys.push(key);
            (self.keys.len() - 1) as u32
        })
    }

    /// The vertices of a cell, by their places along its axes, the first fastest.
    pub(super) fn lattice(&mut self, block: [u32; 8]) -> Vec<u32> {
        let n = self.parts;
        let mut lattice = Vec::with_capacity((n + 1).pow(3));
        for k in 0..=n {
            for j in 0..=n {
                for i in 0..=n {
                    lattice.push(self.vertex(key(block, [i, j, k], n)));
                }
            }
        }
        lattice
    }

    /// The fine cells of a cell, from its vertices.
    pub(super) fn cells<'l>(&self, lattice: &'l [u32]) -> impl Iterator<Item = [u32; 8]> + 'l {
        let n = self.parts;
        let at = move |i: usize, j: usize, k: usize| lattice[i + (n + 1) * (j + (n + 1) * k)];
        (0..n.pow(3)).map(move |c| {
            let (i, j, k) = (c % n, c / n % n, c / n / n);
            PLACES.map(|[a, b, c]| at(i + a, j + b, k + c))
        })
    }
}

/// The key of a place in a cell.
fn key(block: [u32; 8], place: [usize; 3], n: usize) -> Key {
    let mut key = [NONE; 8];
    for ((entry, corner), side) in key.iter_mut().zip(block).zip(PLACES) {
        let weight: usize =
            (0..3).map(|axis| if side[axis] == 1 { place[axis] } else { n - place[axis] }).product();
        if weight > 0 {
            *entry = (corner, weight as u32);
        }
    }
    key.sort_unstable();
    key
}

/// The corners of a key and their weights, which add up to one.
pub(super) fn weights(key: &Key) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
    let total: u32 = key.iter().map(|(_, weight)| weight).sum();
    key.iter()
        .filter(|entry| **entry != NONE)
        .map(move |&(corner, weight)| (corner as usize, f64::from(weight) / f64::from(total)))
}
