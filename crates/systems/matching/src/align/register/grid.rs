//! Points within a radius of a point.

use glam::DVec3;
use std::collections::HashMap;

/// Points sorted into cubes as wide as the query radius.
#[derive(Debug)]
pub(super) struct Grid {
    radius: f64,
    cells: HashMap<[i64; 3], Vec<u32>>,
}

impl Grid {
    pub(super) fn new(radius: f64) -> Self {
        Self { radius, cells: HashMap::new() }
    }

    fn cell(&self, p: DVec3) -> [i64; 3] {
        (p / self.radius).to_array().map(|x| x.floor() as i64)
    }

    pub(super) fn insert(&mut self, index: u32, p: DVec3) {
        self.cells.entry(self.cell(p)).or_default().push(index);
    }

    /// The points in the cubes around a point, which include all within the radius, in an order that depends only on the input
    /// order.
    pub(super) fn near(&self, p: DVec3) -> impl Iterator<Item = u32> + '_ {
        let [x, y, z] = self.cell(p);
        (0..27).flat_map(move |k| {
            let key = [x + k % 3 - 1, y + k / 3 % 3 - 1, z + k / 9 - 1];
            self.cells.get(&key).into_iter().flatten().copied()
        })
    }
}
