//! How far points are from a piece.

use pompeiu_planar::{Point, bounds, distance_sq_to_segment};

/// Signed distances from a closed path, negative inside, at the nodes of a grid.
pub(super) struct Field {
    low: Point,
    /// Nodes for a unit of length.
    density: f64,
    /// Nodes across, and rows.
    size: [usize; 2],
    values: Vec<i16>,
    /// The length that is 1 there.
    quantum: f64,
    /// Cells across of a coarser grid, cells for a unit of length, and what distances in each cell are not less than.
    blocks: usize,
    block_density: f64,
    least: Vec<i16>,
}

/// Cells across a block: for its nodes, the sides that may be nearest are looked for together.
const BLOCK: usize = 4;

impl Field {
    /// The distances at all nodes up to a distance outside of the box around the path, with some distance between nodes.
    pub(super) fn new(path: &[Point], away: f64, side: f64) -> Self {
        // The distance is needed on each side of a node.
        let away = away + side;
        let [low, high] = bounds(path);
        let (low, high) = (low.map(|x| x - away), high.map(|x| x + away));
        let size = [0, 1].map(|k| ((high[k] - low[k]) / side).ceil() as usize + 1);
        // No distance is larger than the box.
        let quantum = (high[0] - low[0]).max(high[1] - low[1]) / f64::from(i16::MAX);
        let mut field = Self {
            low,
            density: 1.0 / side,
            size,
            values: vec![0; size[0] * size[1]],
            quantum,
            blocks: size[0].div_ceil(BLOCK),
            block_density: 1.0 / (BLOCK as f64 * side),
            least: Vec::new(),
        };
        let sides: Vec<[Point; 2]> =
            path.iter().zip(path.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]).collect();
        for y in (0..size[1]).step_by(BLOCK) {
            for x in (0..size[0]).step_by(BLOCK) {
                field.fill_block([x, y], &sides, side);
            }
        }
        field.sign(&sides, side);
        field.bound_blocks();
        field
    }

    fn node(&self, [x, y]: [usize; 2], side: f64) -> Point {
        [self.low[0] + x as f64 * side, self.low[1] + y as f64 * side]
    }

    /// Distances in a block of nodes, from the sides that may be nearest to one of them.
    fn fill_block(&mut self, [x, y]: [usize; 2], sides: &[[Point; 2]], side: f64) {
        let half = 0.5 * (BLOCK - 1) as f64 * side;
        let corner = self.node([x, y], side);
        let middle = corner.map(|from| from + half);
        let from_middle: Vec<f64> = sides.iter().map(|s| distance_sq_to_segment(middle, *s).sqrt()).collect();
        // The distance from each node differs from that from the middle by at most half a diagonal.
        let most = from_middle.iter().copied().fold(f64::INFINITY, f64::min) + 3.0 * half;
        let near: Vec<[Point; 2]> =
            sides.iter().zip(from_middle).filter(|(_, d)| *d <= most).map(|(s, _)| *s).collect();
        for j in y..(y + BLOCK).min(self.size[1]) {
            for i in x..(x + BLOCK).min(self.size[0]) {
                let p = self.node([i, j], side);
                let least = near.iter().map(|s| distance_sq_to_segment(p, *s)).fold(f64::INFINITY, f64::min);
                self.values[j * self.size[0] + i] = (least.sqrt() / self.quantum) as i16;
            }
        }
    }

    /// Makes distances inside negative, by the even–odd rule along each row.
    fn sign(&mut self, sides: &[[Point; 2]], side: f64) {
        for y in 0..self.size[1] {
            let [_, height] = self.node([0, y], side);
            let mut crossed: Vec<f64> = sides
                .iter()
                .filter(|[a, b]| (a[1] > height) != (b[1] > height))
                .map(|[a, b]| a[0] + (height - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
                .collect();
            crossed.sort_by(f64::total_cmp);
            for ends in crossed.chunks_exact(2) {
                let [from, to] = [ends[0], ends[1]].map(|x| ((x - self.low[0]) / side).ceil() as usize);
                for value in &mut self.values[y * self.size[0]..][from..to.min(self.size[0])] {
                    *value = -*value;
                }
            }
        }
    }

    /// What distances in each block are not less than: the least at its nodes and those around it, for distances are linear between.
    fn bound_blocks(&mut self) {
        let from = |block: usize, k: usize| (block * BLOCK, (block * BLOCK + BLOCK + 1).min(self.size[k]));
        for y in 0..self.size[1].div_ceil(BLOCK) {
            for x in 0..self.blocks {
                let ((left, right), (low, high)) = (from(x, 0), from(y, 1));
                let rows = (low..high).map(|j| &self.values[j * self.size[0]..][left..right]);
                self.least.push(rows.flatten().copied().fold(i16::MAX, i16::min));
            }
        }
    }

    /// What the distances near a point are not less than; infinite far outside.
    #[inline]
    pub(super) fn least(&self, p: Point) -> f64 {
        let (x, y) = ((p[0] - self.low[0]) * self.block_density, (p[1] - self.low[1]) * self.block_density);
        // Written so that NaN is outside, too.
        if !(x >= 0.0 && y >= 0.0 && (x as usize) < self.blocks) {
            return f64::INFINITY;
        }
        self.least
            .get(y as usize * self.blocks + x as usize)
            .map_or(f64::INFINITY, |least| self.quantum * f64::from(*least))
    }

    /// The four nodes around a point, and where it lies between them; none far outside.
    #[inline]
    fn cell(&self, p: Point) -> Option<([f64; 4], Point)> {
        let (x, y) = ((p[0] - self.low[0]) * self.density, (p[1] - self.low[1]) * self.density);
        // Written so that NaN is outside, too.
        if !(x >= 0.0 && y >= 0.0) {
            return None;
        }
        let (i, j) = (x as usize, y as usize);
        if i + 1 >= self.size[0] || j + 1 >= self.size[1] {
            return None;
        }
        let first = j * self.size[0] + i;
        let (below, above) = (&self.values[first..first + 2], &self.values[first + self.size[0]..][..2]);
        let nodes = [f64::from(below[0]), f64::from(below[1]), f64::from(above[0]), f64::from(above[1])];
        Some((nodes, [x - i as f64, y - j as f64]))
    }

    /// The distance at a point and its gradient.
    #[inline]
    pub(super) fn at(&self, p: Point) -> Option<(f64, Point)> {
        let ([a, b, c, d], [s, t]) = self.cell(p)?;
        let (left, right) = (a + t * (c - a), b + t * (d - b));
        let (lower, upper) = (a + s * (b - a), c + s * (d - c));
        let scale = self.quantum * self.density;
        Some((self.quantum * (left + s * (right - left)), [(right - left) * scale, (upper - lower) * scale]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_planar::{Outline, distance_to_outline};

    #[test]
    fn distances_are_those_of_the_path() {
        let path = vec![[0.3, 0.2], [8.4, 1.7], [5.1, 2.6], [2.6, 6.1]];
        let outline = Outline::new(path.clone()).unwrap();
        let (away, side) = (0.7, 0.1);
        let field = Field::new(&path, away, side);
        let mut seen = [0; 2];
        for i in 0..200 {
            for j in 0..200 {
                let p = [0.06 * f64::from(i) - 1.5, 0.06 * f64::from(j) - 2.0];
                let sign = if outline.contains(p) { -1.0 } else { 1.0 };
                let exact = sign * distance_to_outline(p, &outline);
                let Some((found, slope)) = field.at(p) else {
                    assert!(exact > away, "{p:?}");
                    continue;
                };
                seen[usize::from(found < 0.0)] += 1;
                // The distance differs from that at a node by at most the distance of the node, half a diagonal in the mean.
                assert!((found - exact).abs() < 0.5 * side, "{p:?}: {found} and {exact}");
                assert!(field.least(p) <= found, "{p:?}");
                assert!(libm::hypot(slope[0], slope[1]) < 1.42, "{p:?}: {slope:?}");
            }
        }
        assert!(seen[0] > 10_000 && seen[1] > 4000, "{seen:?}");
    }
}
