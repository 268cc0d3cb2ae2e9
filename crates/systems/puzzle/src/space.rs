//! The segments of all borders, to test that a new course of a border meets no other.

use pompeiu_planar::segments_meet;
use std::collections::BTreeMap;

/// A corner on the lattice.
pub(crate) type Corner = [i64; 2];

/// The segments of all borders, in the cells of a grid.
pub(crate) struct Space {
    side: i64,
    cells: BTreeMap<[i64; 2], Vec<(usize, [Corner; 2])>>,
}

impl Space {
    pub(crate) fn new<'b>(borders: impl Iterator<Item = &'b [Corner]>, unit: f64) -> Self {
        let mut space = Self { side: (0.3 * unit).max(1.0) as i64, cells: BTreeMap::new() };
        for (border, corners) in borders.enumerate() {
            space.insert(border, corners);
        }
        space
    }

    /// The grid cells that overlap the bounding box of a segment.
    fn around(&self, [a, b]: [Corner; 2]) -> impl Iterator<Item = [i64; 2]> + use<> {
        let cell = |x: i64| x.div_euclid(self.side);
        let low = [0, 1].map(|k| cell(a[k].min(b[k])));
        let high = [0, 1].map(|k| cell(a[k].max(b[k])));
        (low[0]..=high[0]).flat_map(move |x| (low[1]..=high[1]).map(move |y| [x, y]))
    }

    fn insert(&mut self, border: usize, path: &[Corner]) {
        for pair in path.windows(2) {
            let segment = [pair[0], pair[1]];
            for cell in self.around(segment).collect::<Vec<_>>() {
                self.cells.entry(cell).or_default().push((border, segment));
            }
        }
    }

    pub(crate) fn replace(&mut self, border: usize, old: &[Corner], path: &[Corner]) {
        for cell in old.windows(2).flat_map(|pair| self.around([pair[0], pair[1]])).collect::<Vec<_>>() {
            if let Some(segments) = self.cells.get_mut(&cell) {
                segments.retain(|(other, _)| *other != border);
            }
        }
        self.insert(border, path);
    }

    /// Whether a path that would replace a border meets other borders only at its ends, and does not meet itself.
    pub(crate) fn is_free(&self, border: usize, path: &[Corner]) -> bool {
        let last = path.len() - 2;
        let ends = [path[0], path[last + 1]];
        path.windows(2).enumerate().all(|(i, pair)| {
            let segment = [pair[0], pair[1]];
            let itself = path
                .windows(2)
                .enumerate()
                .skip(i + 2)
                .all(|(_, other)| !meet(segment, [other[0], other[1]]));
            itself
                && self.around(segment).all(|cell| {
                    let near = self.cells.get(&cell).into_iter().flatten();
                    near.filter(|(other, _)| *other != border).all(|(_, other)| {
                        // The first and the last segment may touch segments that share the end point, and only there.
                        let shared = ends.iter().any(|e| other.contains(e) && segment.contains(e));
                        if shared { !overlaps(segment, *other) } else { !meet(segment, *other) }
                    })
                })
        })
    }
}

fn meet(a: [Corner; 2], b: [Corner; 2]) -> bool {
    // Integers below 2^53 are exact as doubles.
    segments_meet(a.map(|p| p.map(|x| x as f64)), b.map(|p| p.map(|x| x as f64)))
}

/// Whether two segments with a common end overlap.
fn overlaps([a, b]: [Corner; 2], [c, d]: [Corner; 2]) -> bool {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
    let cross = u[0] * v[1] - u[1] * v[0];
    let dot = u[0] * v[0] + u[1] * v[1];
    let same_start = a == c || b == d;
    cross == 0 && if same_start { dot > 0 } else { dot < 0 }
}
