//! Tabs on borders.

use super::Tab;
use crate::Puzzle;
use crate::puzzle::Corner;
use pompeiu_core::mesh::edit::Random;
use pompeiu_planar::segments_meet;
use std::collections::BTreeMap;

/// Heights of tabs that are tried, over the mean side of a piece.
const HEIGHTS: [f64; 6] = [0.30, 0.25, 0.20, 0.15, 0.11, 0.08];

/// Half the width of the neck over the height.
const NECK: f64 = 0.30;

/// How far the middle of a tab may lie from that of its border, over its length.
const SHIFTS: [f64; 5] = [0.0, -0.08, 0.08, -0.2, 0.2];

/// Corners of a round head.
const HEAD: usize = 14;

/// Gives every border between two pieces a tab where one fits.
pub(super) fn add(puzzle: &mut Puzzle, tab: Tab, random: &mut Random) {
    let unit = puzzle.unit() / puzzle.step;
    let mut space = Space::new(puzzle, unit);
    for border in 0..puzzle.borders.len() {
        if puzzle.borders[border].right.is_none() {
            continue;
        }
        let side = if random.below(2) == 0 { 1.0 } else { -1.0 };
        let shift = 0.05 * random.signed_unit();
        // On the longest segment.
        let corners = puzzle.borders[border].corners.clone();
        let length = |i: usize| {
            let [x, y] = [0, 1].map(|k| (corners[i + 1][k] - corners[i][k]) as f64);
            libm::hypot(x, y)
        };
        let at = (0..corners.len() - 1)
            .max_by(|i, j| length(*i).total_cmp(&length(*j)).then(j.cmp(i)))
            .unwrap_or(0);
        let ends = [corners[at], corners[at + 1]];
        let tries =
            HEIGHTS.iter().flat_map(|h| SHIFTS.iter().flat_map(move |s| [1.0, -1.0].map(|d| (*h, *s, d))));
        for (height, place, turn) in tries {
            let Some(path) = shape(tab, ends, height * unit, 0.5 + shift + place, side * turn) else {
                continue;
            };
            let path = [&corners[..at], &path, &corners[at + 2..]].concat();
            if space.is_free(border, &path) {
                space.replace(border, &corners, &path);
                puzzle.borders[border].corners = path;
                break;
            }
        }
    }
}

/// The border with a tab: from one end to the neck, around the head, to the other end. None where it is too short for that.
fn shape(tab: Tab, [a, b]: [Corner; 2], height: f64, place: f64, side: f64) -> Option<Vec<Corner>> {
    let u = [b[0] - a[0], b[1] - a[1]].map(|x| x as f64);
    let length = libm::hypot(u[0], u[1]);
    let (along, across) = ([u[0] / length, u[1] / length], [-u[1] / length * side, u[0] / length * side]);
    let neck = NECK * height;
    let middle = place * length;
    if middle - 1.6 * neck < 0.0 || middle + 1.6 * neck > length {
        return None;
    }
    let at = |x: f64, y: f64| [0, 1].map(|k| a[k] + (along[k] * (middle + x) + across[k] * y).round() as i64);
    let mut path = vec![a, at(-neck, 0.0)];
    match tab {
        Tab::None => return None,
        Tab::Dovetail => path.extend([at(-1.6 * neck, height), at(1.6 * neck, height)]),
        Tab::Knob => {
            // A circle that the neck meets above its widest place from below.
            let radius = 0.5 * height * 0.85;
            let centre = height - radius;
            let from = libm::asin((0.8 * neck / radius).min(1.0));
            let sweep = std::f64::consts::TAU - 2.0 * from;
            for i in 0..=HEAD {
                let angle = from + sweep * i as f64 / HEAD as f64;
                path.push(at(-radius * libm::sin(angle), centre - radius * libm::cos(angle)));
            }
        }
    }
    path.extend([at(neck, 0.0), b]);
    path.dedup();
    Some(path)
}

/// The segments of all borders, by the cells of a grid.
struct Space {
    side: i64,
    cells: BTreeMap<[i64; 2], Vec<(usize, [Corner; 2])>>,
}

impl Space {
    fn new(puzzle: &Puzzle, unit: f64) -> Self {
        let mut space = Self { side: (0.3 * unit).max(1.0) as i64, cells: BTreeMap::new() };
        for (border, of) in puzzle.borders.iter().enumerate() {
            space.insert(border, &of.corners);
        }
        space
    }

    /// The cells that the box of a segment meets.
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

    fn replace(&mut self, border: usize, old: &[Corner], path: &[Corner]) {
        for cell in old.windows(2).flat_map(|pair| self.around([pair[0], pair[1]])).collect::<Vec<_>>() {
            if let Some(segments) = self.cells.get_mut(&cell) {
                segments.retain(|(other, _)| *other != border);
            }
        }
        self.insert(border, path);
    }

    /// Whether a path that would replace a border meets no other border but in its ends, and not itself.
    fn is_free(&self, border: usize, path: &[Corner]) -> bool {
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
                        // The first and the last segment may touch what ends where they end, and no more than that.
                        let shared = ends.iter().any(|e| other.contains(e) && segment.contains(e));
                        if shared { !overlaps(segment, *other) } else { !meet(segment, *other) }
                    })
                })
        })
    }
}

fn meet(a: [Corner; 2], b: [Corner; 2]) -> bool {
    // Integers below 2^53 are doubles.
    segments_meet(a.map(|p| p.map(|x| x as f64)), b.map(|p| p.map(|x| x as f64)))
}

/// Whether two segments that share an end run along each other.
fn overlaps([a, b]: [Corner; 2], [c, d]: [Corner; 2]) -> bool {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [d[0] - c[0], d[1] - c[1]]);
    let cross = u[0] * v[1] - u[1] * v[0];
    let dot = u[0] * v[0] + u[1] * v[1];
    let same_start = a == c || b == d;
    cross == 0 && if same_start { dot > 0 } else { dot < 0 }
}
