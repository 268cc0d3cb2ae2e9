//! How deep points lie in a piece.

use pompeiu_planar::{Outline, Point, distance_sq_to_segment};
use std::ops::Range;

/// Largest number of squares in a row of the finest grid.
const MOST_SQUARES: f64 = 1024.0;

/// The sides of the squares of each grid, relative to those of the finest.
const GRIDS: [f64; 3] = [1.0, 5.0, 25.0];

/// A point so near to the line through two others, relative to the lengths, is not told to be on one side of it.
const NEAR: f64 = 1e-12;

/// Depths are told from that of a square's centre where they differ by this share more than rounding: of the difference, and of the
/// largest coordinate.
const SURE: f64 = 1e-9;
const ROUNDED: f64 = 1e-14;

/// The distance of points from the outline of a piece, negative outside, in the part of the plane around a point.
///
/// That part is divided into squares, by three grids. For each square that is needed, the depth of its centre is found once, and the sides
/// that can be nearest to one of its points, among those of the square of the coarser grid. As no depth changes faster than its point
/// moves, that of the centre decides for most points; for the others these sides do: between the centre and another point of the square no
/// other sides lie.
pub(super) struct Depths {
    sides: Vec<[Point; 2]>,
    grids: [Grid; 3],
    /// What rounding may change of a depth.
    rounding: f64,
}

/// The squares of one size.
struct Grid {
    low: Point,
    side: f64,
    row: usize,
    /// For each square its number, counted from 1; 0 where it was not needed yet.
    numbers: Vec<u32>,
    squares: Vec<Square>,
    /// The sides near to each square that was needed.
    near: Vec<[Point; 2]>,
}

struct Square {
    centre: Point,
    /// The depth of the centre.
    depth: f64,
    /// The places of the sides near to it.
    near: Range<usize>,
}

impl Grid {
    fn new(middle: Point, reach: f64, side: f64) -> Self {
        let row = (2.0 * reach / side) as usize + 1;
        let low = [middle[0] - reach, middle[1] - reach];
        Self { low, side, row, numbers: vec![0; row * row], squares: Vec::new(), near: Vec::new() }
    }

    /// The square of a point; none beyond the grid.
    fn square(&self, p: Point) -> Option<[usize; 2]> {
        let (x, y) = ((p[0] - self.low[0]) / self.side, (p[1] - self.low[1]) / self.side);
        let end = self.row as f64;
        (x >= 0.0 && y >= 0.0 && x < end && y < end).then_some([x as usize, y as usize])
    }

    fn centre(&self, square: [usize; 2]) -> Point {
        [
            self.low[0] + (square[0] as f64 + 0.5) * self.side,
            self.low[1] + (square[1] as f64 + 0.5) * self.side,
        ]
    }
}

impl Depths {
    /// For points within `reach` of `middle`, many of them within about `side` of each other.
    pub(super) fn new(outline: &Outline, middle: Point, reach: f64, side: f64) -> Self {
        let side = side.max(2.0 * reach / MOST_SQUARES);
        let [low, high] = outline.bounds();
        let largest = low.iter().chain(&high).fold(reach, |most: f64, x| most.max(x.abs()));
        Self {
            sides: outline.sides().collect(),
            grids: GRIDS.map(|factor| Grid::new(middle, reach, factor * side)),
            rounding: ROUNDED * largest,
        }
    }

    /// Whether a point lies inside, farther than `depth`, at least 0, from the outline.
    pub(super) fn is_deeper(&mut self, p: Point, depth: f64) -> bool {
        let Some(square) = self.square(0, p) else {
            return is_far(&self.sides, p, depth) && is_inside(&self.sides, p);
        };
        if let Some(is_deeper) = self.is_surely_deeper(square, p, depth) {
            return is_deeper;
        }
        let grid = &self.grids[0];
        let Square { centre, depth: of_centre, near } = &grid.squares[square];
        let near = &grid.near[near.clone()];
        is_far(near, p, depth)
            && match is_crossed_evenly(near, *centre, p) {
                Some(is_even) => (*of_centre > 0.0) == is_even,
                None => is_inside(&self.sides, p),
            }
    }

    /// Whether it is seen at once that all points within a radius of one are not deeper than `depth`, which may be negative.
    pub(super) fn are_shallower(&mut self, p: Point, radius: f64, depth: f64) -> bool {
        let square = self.square(0, p);
        square.is_some_and(|square| self.is_surely_deeper(square, p, depth - radius) == Some(false))
    }

    /// Whether a point in a square of the finest grid is deeper, if the depth of the centre decides that.
    fn is_surely_deeper(&self, square: usize, p: Point, depth: f64) -> Option<bool> {
        let Square { centre, depth: of_centre, .. } = &self.grids[0].squares[square];
        let more = of_centre - depth;
        let (u, v) = (p[0] - centre[0], p[1] - centre[1]);
        let sure = (1.0 - SURE) * more.abs() - self.rounding;
        (sure > 0.0 && u * u + v * v < sure * sure).then_some(more > 0.0)
    }

    /// The number of the square of a point in a grid; none beyond it.
    fn square(&mut self, level: usize, p: Point) -> Option<usize> {
        let grid = &self.grids[level];
        let square = grid.square(p)?;
        let at = square[1] * grid.row + square[0];
        if grid.numbers[at] == 0 {
            let centre = grid.centre(square);
            // The last square of a row can reach beyond the coarser grid.
            let coarser = if level + 1 < GRIDS.len() { self.square(level + 1, centre) } else { None };
            self.measure(level, at, centre, coarser);
        }
        Some(self.grids[level].numbers[at] as usize - 1)
    }

    /// Finds the depth of the centre of a square, and the sides near to it, from those of a square of the coarser grid.
    fn measure(&mut self, level: usize, at: usize, centre: Point, coarser: Option<usize>) {
        let (fine, coarse) = self.grids.split_at_mut(level + 1);
        let grid = &mut fine[level];
        let around = coarser.map(|number| &coarse[0].squares[number]);
        let sides = around.map_or(&self.sides[..], |square| &coarse[0].near[square.near.clone()]);
        let is_inside = around
            .and_then(|square| Some(is_crossed_evenly(sides, square.centre, centre)? == (square.depth > 0.0)))
            .unwrap_or_else(|| is_inside(&self.sides, centre));
        let start = grid.near.len();
        let mut least = f64::INFINITY;
        let mut away = Vec::with_capacity(sides.len());
        for side in sides {
            let distance = distance_sq_to_segment(centre, *side).sqrt();
            least = least.min(distance);
            away.push(distance);
        }
        // Twice half the diagonal, and far more than rounding.
        let most = (least + std::f64::consts::SQRT_2 * grid.side) * (1.0 + 1e-9);
        grid.near.extend(sides.iter().zip(away).filter(|(_, away)| *away <= most).map(|(side, _)| *side));
        let depth = if is_inside { least } else { -least };
        grid.squares.push(Square { centre, depth, near: start..grid.near.len() });
        grid.numbers[at] = grid.squares.len() as u32;
    }
}

fn is_far(sides: &[[Point; 2]], p: Point, depth: f64) -> bool {
    sides.iter().all(|side| distance_sq_to_segment(p, *side) > depth * depth)
}

/// Whether the segment between two points crosses sides an even number of times; none where rounding leaves that open.
fn is_crossed_evenly(sides: &[[Point; 2]], p: Point, q: Point) -> Option<bool> {
    let mut is_even = true;
    for [a, b] in sides {
        let ends = [turn(p, q, *a)?, turn(p, q, *b)?];
        if ends[0] != ends[1] && turn(*a, *b, p)? != turn(*a, *b, q)? {
            is_even = !is_even;
        }
    }
    Some(is_even)
}

/// Whether a point lies to the left of the line through two others; none if it lies too near to it.
fn turn(a: Point, b: Point, p: Point) -> Option<bool> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
    let cross = u[0] * v[1] - u[1] * v[0];
    let scale = (u[0].abs() + u[1].abs()) * (v[0].abs() + v[1].abs());
    (cross.abs() > NEAR * scale).then_some(cross > 0.0)
}

/// The even–odd rule.
fn is_inside(sides: &[[Point; 2]], p: Point) -> bool {
    let mut is_inside = false;
    for [a, b] in sides {
        if (a[1] > p[1]) != (b[1] > p[1]) {
            is_inside ^= p[0] < a[0] + (p[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
        }
    }
    is_inside
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_planar::distance_to_outline;

    #[test]
    fn depths_are_those_of_all_sides() {
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * i as f64 / 90.0;
            let radius = 1.0 + 0.4 * libm::sin(9.0 * angle);
            [radius * libm::cos(angle), radius * libm::sin(angle)]
        };
        let outline = Outline::new((0..90).map(at).collect()).unwrap();
        let mut depths = Depths::new(&outline, [0.2, -0.1], 1.2, 0.07);
        let (mut inside, mut shallower) = (0, 0);
        for i in 0..60 {
            for j in 0..60 {
                // Corners of the outline, and points on lines through them, are among these.
                let p = if i == 0 { at(j) } else { [0.05 * f64::from(i) - 1.5, 0.05 * j as f64 - 1.5] };
                let away = distance_to_outline(p, &outline);
                for depth in [0.0, 0.03, 0.3] {
                    let expected = outline.contains(p) && away > depth;
                    if (away - depth).abs() > 1e-12 {
                        assert_eq!(depths.is_deeper(p, depth), expected, "{p:?} {depth}");
                        inside += usize::from(expected);
                    }
                    // The depths of points within a radius are that of their middle, by the radius more at most.
                    let signed = if outline.contains(p) { away } else { -away };
                    if depths.are_shallower(p, 0.02, depth) {
                        assert!(signed + 0.02 < depth + 1e-12, "{p:?} {depth}");
                        shallower += 1;
                    }
                }
            }
        }
        assert!(inside > 500 && shallower > 2000, "{inside} {shallower}");
    }
}
