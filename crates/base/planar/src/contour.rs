//! Contours of a level in a picture, by interpolation or along pixel sides.

use crate::Point;

/// A contour: the points of a curve on which the values have the level.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour {
    /// Points in the order of the curve: column and row; the centre of the first pixel is 0, 0. Greater values lie on the left in a
    /// display whose rows go down.
    pub points: Vec<Point>,
    /// Whether the last point is joined with the first; otherwise both lie on the border of the picture.
    pub is_closed: bool,
}

/// The contours of a level by marching squares, with linear interpolation between the centres of pixels.
///
/// # Shapes and units
/// `values` are row by row, `width` in each row.
///
/// # Definition
/// A value is high if it is greater than the level. In a saddle, where two high values are diagonally opposite in a square, the low
/// ones are joined (as scikit-image's `find_contours` does by default). Squares with a value that is not finite have no contour.
///
/// # Limits
/// Where a value is equal to the level, contours pass through the centre of its pixel, and points can coincide.
///
/// # Source
/// `lorensen_marching_1987`, in the plane.
pub fn contours(values: &[f32], width: usize, level: f64) -> Vec<Contour> {
    let height = values.len().checked_div(width).unwrap_or(0);
    if width < 2 || height < 2 {
        return Vec::new();
    }
    Tracer::new(values, width, height, level).trace()
}

/// No successor yet.
const NONE: u32 = u32::MAX;

/// Edges between neighbouring pixels, those along rows first, then those along columns; for each, the edge where the contour
/// continues.
struct Tracer<'v> {
    values: &'v [f32],
    width: usize,
    level: f64,
    along: usize,
    next: Vec<u32>,
    has_last: Vec<bool>,
}

impl<'v> Tracer<'v> {
    fn new(values: &'v [f32], width: usize, height: usize, level: f64) -> Self {
        let along = (width - 1) * height;
        let edges = along + width * (height - 1);
        let mut tracer =
            Self { values, width, level, along, next: vec![NONE; edges], has_last: vec![false; edges] };
        for row in 0..height - 1 {
            let upper = &values[row * width..(row + 1) * width];
            let lower = &values[(row + 1) * width..(row + 2) * width];
            let mut left = [upper[0], lower[0]].map(|x| f64::from(x) > level);
            for column in 0..width - 1 {
                let right = [upper[column + 1], lower[column + 1]].map(|x| f64::from(x) > level);
                if left[0] != left[1] || right != left {
                    tracer.square(row, column, [left[0], right[0], right[1], left[1]]);
                }
                left = right;
            }
        }
        tracer
    }

    /// Links the edges of a square, whose corners are given clockwise from the upper left one.
    fn square(&mut self, row: usize, column: usize, high: [bool; 4]) {
        let corners = [(0, 0), (0, 1), (1, 1), (1, 0)];
        if corners.iter().any(|(r, c)| !self.values[(row + r) * self.width + column + c].is_finite()) {
            return;
        }
        let top = row * (self.width - 1) + column;
        let left = self.along + row * self.width + column;
        // Side k leads from corner k to corner k + 1.
        let sides = [top, left + 1, top + self.width - 1, left];
        // A contour enters where, clockwise, high changes to low, and leaves at the next change from low to high on the other side
        // of the low corners before it: so low corners stay joined.
        for k in 0..4 {
            if high[k] && !high[(k + 1) % 4] {
                let is_rise = |j: &usize| !high[j % 4] && high[(j + 1) % 4];
                let saddle = high[(k + 2) % 4] && !high[(k + 3) % 4];
                let exit = if saddle { (k + 3) % 4 } else { (k + 1..k + 4).find(is_rise).unwrap_or(k) % 4 };
                self.next[sides[exit]] = sides[k] as u32;
                self.has_last[sides[k]] = true;
            }
        }
    }

    fn point(&self, edge: usize) -> Point {
        let (row, column, is_along) = if edge < self.along {
            (edge / (self.width - 1), edge % (self.width - 1), true)
        } else {
            let edge = edge - self.along;
            (edge / self.width, edge % self.width, false)
        };
        let first = row * self.width + column;
        let second = if is_along { first + 1 } else { first + self.width };
        let [a, b] = [first, second].map(|i| f64::from(self.values[i]));
        let t = (self.level - a) / (b - a);
        if is_along { [column as f64 + t, row as f64] } else { [column as f64, row as f64 + t] }
    }

    fn trace(mut self) -> Vec<Contour> {
        let mut found = Vec::new();
        for is_closed in [false, true] {
            for start in 0..self.next.len() {
                if self.next[start] == NONE || (!is_closed && self.has_last[start]) {
                    continue;
                }
                let mut points = vec![self.point(start)];
                let mut edge = start;
                loop {
                    let next = std::mem::replace(&mut self.next[edge], NONE);
                    if next == NONE || next as usize == start {
                        break;
                    }
                    edge = next as usize;
                    points.push(self.point(edge));
                }
                found.push(Contour { points, is_closed });
            }
        }
        found
    }
}

/// The borders between high pixels and the others, as closed curves through pixel corners, which are at half-integers. High pixels
/// lie on the same side as in [`contours`]. The picture is surrounded by low pixels. Two high pixels that touch only at a corner
/// are not joined.
pub fn staircases(values: &[f32], width: usize, level: f64) -> Vec<Contour> {
    let height = values.len().checked_div(width).unwrap_or(0);
    let is_high = |row: isize, column: isize| {
        row >= 0
            && column >= 0
            && (row as usize) < height
            && (column as usize) < width
            && f64::from(values[row as usize * width + column as usize]) > level
    };
    // Directions right, down, left, up along the corners of pixels; corner (r, c) is the upper left one of pixel (r, c).
    let steps: [[isize; 2]; 4] = [[0, 1], [1, 0], [0, -1], [-1, 0]];
    // Whether a step in a direction from a corner has a high pixel on its left and none on its right, with rows going down.
    let is_border = |row: isize, column: isize, direction: usize| {
        let [left, right] = match direction {
            0 => [[-1, 0], [0, 0]],
            1 => [[0, 0], [0, -1]],
            2 => [[0, -1], [-1, -1]],
            _ => [[-1, -1], [-1, 0]],
        };
        is_high(row + left[0], column + left[1]) && !is_high(row + right[0], column + right[1])
    };
    let mut seen = vec![false; (width + 1) * (height + 1)];
    let mut found = Vec::new();
    for row in 0..=height.cast_signed() {
        for column in 0..=width.cast_signed() {
            // Each curve has a step to the right, below a high pixel.
            let index = row as usize * (width + 1) + column as usize;
            if seen[index] || !is_border(row, column, 0) {
                continue;
            }
            let (mut at, mut direction) = ([row, column], 0);
            let mut points = Vec::new();
            loop {
                if direction == 0 {
                    let index = at[0] as usize * (width + 1) + at[1] as usize;
                    if seen[index] {
                        break;
                    }
                    seen[index] = true;
                }
                points.push([at[1] as f64 - 0.5, at[0] as f64 - 0.5]);
                let step = steps[direction];
                at = [at[0] + step[0], at[1] + step[1]];
                // Left turns come first: high pixels that touch only at a corner stay separate.
                let turns = [(direction + 3) % 4, direction, (direction + 1) % 4];
                direction =
                    turns.into_iter().find(|d| is_border(at[0], at[1], *d)).unwrap_or((direction + 2) % 4);
            }
            found.push(Contour { points, is_closed: true });
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_peak_has_a_diamond_and_a_ridge_an_open_contour() {
        let peak = [0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
        let found = contours(&peak, 3, 0.25);
        assert_eq!(found.len(), 1);
        assert!(found[0].is_closed);
        let mut points = found[0].points.clone();
        points.sort_by(|a, b| a.partial_cmp(b).unwrap());
        assert_eq!(points, [[0.25, 1.0], [1.0, 0.25], [1.0, 1.75], [1.75, 1.0]]);
        let ridge = [0.0, 1.0, 0.0, 1.0];
        let found = contours(&ridge, 2, 0.5);
        assert_eq!(found, [Contour { points: vec![[0.5, 0.0], [0.5, 1.0]], is_closed: false }]);
    }

    #[test]
    fn high_pixels_that_touch_at_a_corner_stay_apart() {
        let mut values = vec![0.0; 16];
        values[5] = 1.0;
        values[10] = 1.0;
        assert_eq!(contours(&values, 4, 0.5).len(), 2);
        let stairs = staircases(&values, 4, 0.5);
        assert_eq!(stairs.iter().map(|c| c.points.len()).collect::<Vec<_>>(), [4, 4]);
        values[6] = 1.0;
        let stairs = staircases(&values, 4, 0.5);
        assert_eq!((stairs.len(), stairs[0].points.len()), (1, 8));
    }
}
