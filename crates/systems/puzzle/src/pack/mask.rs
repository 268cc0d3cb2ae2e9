//! The cells of a grid that a piece needs.

use pompeiu_planar::Point;

/// The cells within a distance of a piece, as runs of each row.
pub(super) struct Mask {
    /// Cells across, and rows.
    pub(super) size: [usize; 2],
    /// The first and the last but one cell of each run; those of a row lie together.
    runs: Vec<[usize; 2]>,
    /// Where the runs of each row begin, and the end.
    rows: Vec<usize>,
    /// The corner of the first cell.
    pub(super) low: Point,
    /// The mean row of its cells.
    pub(super) height: f64,
}

impl Mask {
    /// All cells of some side that have a point within a distance of the points inside a closed path, and some that have not.
    pub(super) fn new(path: &[Point], away: f64, side: f64) -> Self {
        let bound = |k: usize, f: fn(f64, f64) -> f64, from: f64| path.iter().map(|p| p[k]).fold(from, f);
        let low = [0, 1].map(|k| bound(k, f64::min, f64::INFINITY) - away);
        let high = [0, 1].map(|k| bound(k, f64::max, f64::NEG_INFINITY) + away);
        let size = [0, 1].map(|k| ((high[k] - low[k]) / side).floor() as usize + 1);
        let sides = || path.iter().zip(path.iter().cycle().skip(1));
        let mut all: Vec<Vec<[usize; 2]>> = vec![Vec::new(); size[1]];
        let column = |x: f64| ((x - low[0]) / side).floor().clamp(0.0, (size[0] - 1) as f64) as usize;
        let row = |y: f64| ((y - low[1]) / side).floor().clamp(0.0, (size[1] - 1) as f64) as usize;
        // A hair more than the distance, which rounding may need.
        let away = away + 1e-9 * side;
        for (a, b) in sides() {
            let (a, b) = if a[1] <= b[1] { (a, b) } else { (b, a) };
            for (y, runs) in all.iter_mut().enumerate().take(row(b[1] + away) + 1).skip(row(a[1] - away)) {
                // The part of the side within the distance of the row, widened by it.
                let [from, to] = [y as f64, y as f64 + 1.0].map(|y| low[1] + y * side);
                let at = |y: f64| {
                    let t = if b[1] > a[1] { ((y - a[1]) / (b[1] - a[1])).clamp(0.0, 1.0) } else { 0.0 };
                    a[0] + t * (b[0] - a[0])
                };
                let ends = if b[1] > a[1] { [at(from - away), at(to + away)] } else { [a[0], b[0]] };
                runs.push([column(ends[0].min(ends[1]) - away), column(ends[0].max(ends[1]) + away) + 1]);
            }
        }
        // What lies inside, by the even–odd rule along the middle of each row.
        for (y, runs) in all.iter_mut().enumerate() {
            let middle = low[1] + (y as f64 + 0.5) * side;
            let mut crossed: Vec<f64> = sides()
                .filter(|(a, b)| (a[1] > middle) != (b[1] > middle))
                .map(|(a, b)| a[0] + (middle - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
                .collect();
            crossed.sort_by(f64::total_cmp);
            runs.extend(crossed.chunks_exact(2).map(|ends| [column(ends[0]), column(ends[1]) + 1]));
        }
        let mut mask = Self { size, runs: Vec::new(), rows: vec![0], low, height: 0.0 };
        let (mut cells, mut sum) = (0.0, 0.0);
        for (y, mut runs) in all.into_iter().enumerate() {
            runs.sort_unstable();
            let first = mask.runs.len();
            for [from, to] in runs {
                match mask.runs[first..].last_mut() {
                    Some(last) if from <= last[1] => last[1] = last[1].max(to),
                    _ => mask.runs.push([from, to]),
                }
            }
            let count: usize = mask.runs[first..].iter().map(|[from, to]| to - from).sum();
            cells += count as f64;
            sum += count as f64 * y as f64;
            mask.rows.push(mask.runs.len());
        }
        mask.height = sum / cells;
        mask
    }

    /// The runs of a row.
    fn row(&self, y: usize) -> &[[usize; 2]] {
        &self.runs[self.rows[y]..self.rows[y + 1]]
    }
}

/// The cells of a sheet, and which of them are taken.
#[derive(Clone)]
pub(super) struct Cells {
    size: [usize; 2],
    words: usize,
    bits: Vec<u64>,
}

impl Cells {
    pub(super) fn new(size: [usize; 2]) -> Self {
        let words = size[0].div_ceil(64);
        Self { size, words, bits: vec![0; words * size[1]] }
    }

    /// The last taken cell of a row from `from` to before `to`.
    fn last_taken(&self, y: usize, [from, to]: [usize; 2]) -> Option<usize> {
        let row = &self.bits[y * self.words..(y + 1) * self.words];
        let (first, last) = (from / 64, (to - 1) / 64);
        for word in (first..=last).rev() {
            let mut bits = row[word];
            if word == last {
                bits &= u64::MAX >> (63 - (to - 1) % 64);
            }
            if word == first {
                bits &= u64::MAX << (from % 64);
            }
            if bits != 0 {
                return Some(64 * word + 63 - bits.leading_zeros() as usize);
            }
        }
        None
    }

    /// The first place of a mask, by rows from `from` on, where no cell is taken.
    pub(super) fn place(&self, mask: &Mask, from: usize) -> Option<[usize; 2]> {
        if mask.size[0] > self.size[0] || mask.size[1] > self.size[1] {
            return None;
        }
        let mut blocked = 0;
        for y in from..=self.size[1] - mask.size[1] {
            let mut x = 0;
            'places: while x + mask.size[0] <= self.size[0] {
                for k in 0..mask.size[1] {
                    // The row that was in the way last is looked at first.
                    let row = (blocked + k) % mask.size[1];
                    for [a, b] in mask.row(row) {
                        if let Some(taken) = self.last_taken(y + row, [x + a, x + b]) {
                            // All places before have this cell in the same run.
                            x = taken + 1 - a;
                            blocked = row;
                            continue 'places;
                        }
                    }
                }
                return Some([x, y]);
            }
        }
        None
    }

    /// Takes the cells of a mask.
    pub(super) fn take(&mut self, mask: &Mask, [x, y]: [usize; 2]) {
        for row in 0..mask.size[1] {
            let start = (y + row) * self.words;
            for [a, b] in mask.row(row) {
                for cell in x + a..x + b {
                    self.bits[start + cell / 64] |= 1 << (cell % 64);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn masks_hold_all_that_is_near_and_little_else() {
        let triangle = [[0.3, 0.2], [8.4, 1.7], [2.6, 6.1]];
        for away in [0.0, 0.7] {
            let mask = Mask::new(&triangle, away, 0.25);
            let outline = pompeiu_planar::Outline::new(triangle.to_vec()).unwrap();
            let holds = |p: Point| {
                let [x, y] = [0, 1].map(|k| ((p[k] - mask.low[k]) / 0.25).floor());
                x >= 0.0 && y >= 0.0 && (y as usize) < mask.size[1] && {
                    mask.row(y as usize).iter().any(|[a, b]| (*a..*b).contains(&(x as usize)))
                }
            };
            for i in 0..200 {
                for j in 0..200 {
                    let p = [0.06 * f64::from(i) - 1.5, 0.06 * f64::from(j) - 2.0];
                    let off = pompeiu_planar::distance_to_outline(p, &outline);
                    let is_near = outline.contains(p) || off < away - 1e-9;
                    assert!(!is_near || holds(p), "{p:?} is near");
                    assert!(!holds(p) || outline.contains(p) || off < 1.5 * away + 0.8, "{p:?} is far");
                }
            }
        }
    }

    #[test]
    fn places_are_the_first_that_are_free() {
        let mut cells = Cells::new([150, 20]);
        let square = |side: f64| Mask::new(&[[0.0, 0.0], [side, 0.0], [side, side], [0.0, side]], 0.0, 1.0);
        // Nine cells and the one on whose edge the side lies.
        let mask = square(9.0);
        assert_eq!(mask.size, [10, 10]);
        for i in 0..15 {
            assert_eq!(cells.place(&mask, 0), Some([10 * i, 0]));
            cells.take(&mask, [10 * i, 0]);
        }
        assert_eq!(cells.place(&mask, 0), Some([0, 10]));
        assert_eq!((cells.place(&mask, 11), cells.place(&square(160.0), 0)), (None, None));
        assert_eq!(cells.last_taken(3, [0, 150]), Some(149));
    }
}
