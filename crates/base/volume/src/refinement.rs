//! Regular lattices in cells; cells that share a face share the lattice points on it.

use std::collections::HashMap;

/// A lattice point: the corners that it combines, with integer weights, in order of corners. Cells that share a face use the same
/// combinations on it, so that lattices conform where the cells do.
pub type RefinementKey = [(u32, u32); 8];

/// No corner.
const NONE: (u32, u32) = (u32::MAX, 0);

/// The positions of the eight corners of a cell, in the order of VTK.
pub const CORNER_PLACES: [[usize; 3]; 8] =
    [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

/// Numbers for the points of a lattice with `parts` steps along each edge of cells.
#[derive(Clone, Debug)]
pub struct Refinement {
    parts: usize,
    index: HashMap<RefinementKey, u32>,
    keys: Vec<RefinementKey>,
}

impl Refinement {
    /// A numbering without points.
    pub fn new(parts: usize) -> Self {
        Self { parts, index: HashMap::new(), keys: Vec::new() }
    }

    /// The keys, in the order of their numbers.
    pub fn keys(&self) -> &[RefinementKey] {
        &self.keys
    }

    /// The number of a key; a new key gets the next number.
    pub fn vertex(&mut self, key: RefinementKey) -> u32 {
        *self.index.entry(key).or_insert_with(|| {
            self.keys.push(key);
            (self.keys.len() - 1) as u32
        })
    }

    /// The numbers of the lattice points of a cell, the first axis fastest.
    pub fn lattice(&mut self, cell: [u32; 8]) -> Vec<u32> {
        let n = self.parts;
        let mut lattice = Vec::with_capacity((n + 1).pow(3));
        for k in 0..=n {
            for j in 0..=n {
                for i in 0..=n {
                    lattice.push(self.vertex(key(cell, [i, j, k], n)));
                }
            }
        }
        lattice
    }

    /// The cells between the points of a lattice, the first axis fastest.
    pub fn cells<'l>(&self, lattice: &'l [u32]) -> impl Iterator<Item = [u32; 8]> + 'l {
        let n = self.parts;
        let at = move |i: usize, j: usize, k: usize| lattice[i + (n + 1) * (j + (n + 1) * k)];
        (0..n.pow(3)).map(move |c| {
            let (i, j, k) = (c % n, c / n % n, c / n / n);
            CORNER_PLACES.map(|[a, b, c]| at(i + a, j + b, k + c))
        })
    }
}

/// The key of a lattice point of a cell.
fn key(cell: [u32; 8], place: [usize; 3], n: usize) -> RefinementKey {
    let mut key = [NONE; 8];
    for ((entry, corner), side) in key.iter_mut().zip(cell).zip(CORNER_PLACES) {
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
pub fn key_weights(key: &RefinementKey) -> impl Iterator<Item = (usize, f64)> + Clone + '_ {
    let total: u32 = key.iter().map(|(_, weight)| weight).sum();
    key.iter()
        .filter(|entry| **entry != NONE)
        .map(move |&(corner, weight)| (corner as usize, f64::from(weight) / f64::from(total)))
}
