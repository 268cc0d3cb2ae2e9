//! Visibility of faces.
//!
//! Corners are rounded to a fine grid, and inside tests are exact in integers: faces with a common edge leave no gap and do not
//! overlap, and the result is the same on every machine.
//!
//! # Source
//! `pineda_parallel_1988`.

use super::camera::Seen;

/// Grid positions per pixel: divisible by 1, 2, 3 and 4 samples, and their halves.
pub(super) const PIXEL: i32 = 768;

/// No face.
pub(super) const NONE: u32 = u32::MAX;

/// The place on the fine grid nearest to a coordinate in pixels. A cast and a comparison, for `floor` is a call on most processors.
fn on_grid(pixels: f64) -> i32 {
    let place = pixels * f64::from(PIXEL) + 0.5;
    let towards_zero = place as i32;
    towards_zero.saturating_sub(i32::from(place < f64::from(towards_zero)))
}

/// A triangle in the picture with nonzero area.
#[derive(Clone, Copy, Debug)]
pub(super) struct Triangle {
    /// Edge functions `a x + b y + c`, one for each corner: zero on the opposite edge, positive inside.
    edges: [[i64; 3]; 3],
    /// The value of each edge function at its corner.
    area: i64,
    /// Smallest and largest coordinates.
    bounds: [[i32; 2]; 2],
    near: [f64; 3],
}

impl Triangle {
    /// The triangle between three points; `None` if its area is zero.
    pub(super) fn new(corners: [Seen; 3]) -> Option<Self> {
        let points = corners.map(|corner| corner.at.map(on_grid));
        let [p, q, r] = points.map(|point| point.map(i64::from));
        let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
        if area == 0 {
            return None;
        }
        let turn = area.signum();
        let edges = [[q, r], [r, p], [p, q]].map(|[from, to]| {
            let [a, b] = [turn * (from[1] - to[1]), turn * (to[0] - from[0])];
            [a, b, -(a * from[0] + b * from[1])]
        });
        let mut bounds = [points[0]; 2];
        for point in points {
            for axis in 0..2 {
                bounds[0][axis] = bounds[0][axis].min(point[axis]);
                bounds[1][axis] = bounds[1][axis].max(point[axis]);
            }
        }
        Some(Self { edges, area: area.abs(), bounds, near: corners.map(|corner| corner.near) })
    }

    pub(super) fn bounds(&self) -> [[i32; 2]; 2] {
        self.bounds
    }

    /// Barycentric coordinates of a position.
    pub(super) fn weights(&self, x: i32, y: i32) -> [f64; 3] {
        let [x, y] = [x, y].map(i64::from);
        let per_area = 1.0 / self.area as f64;
        self.edges.map(|[a, b, c]| (a * x + b * y + c) as f64 * per_area)
    }

    /// Height of each corner over the opposite edge, in pixels.
    pub(super) fn heights(&self) -> [f64; 3] {
        self.edges.map(|[a, b, _]| {
            let [a, b] = [a as f64, b as f64];
            self.area as f64 / (a * a + b * b).sqrt() / f64::from(PIXEL)
        })
    }
}

/// A grid of samples: columns and rows, starting at a pixel.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    /// First pixel.
    pub(super) start: [u32; 2],
    /// Samples in each direction.
    pub(super) size: [usize; 2],
    /// Samples per pixel in each direction.
    pub(super) per_pixel: u32,
}

impl Grid {
    fn spacing(&self) -> i32 {
        PIXEL / self.per_pixel as i32
    }

    /// The position of a sample, in units of the triangles' grid.
    pub(super) fn place(&self, column: usize, row: usize) -> [i32; 2] {
        let spacing = self.spacing();
        let first = self.start.map(|pixel| pixel as i32 * PIXEL + spacing / 2);
        [first[0] + column as i32 * spacing, first[1] + row as i32 * spacing]
    }

    /// The pixel of the panel in which a sample lies.
    pub(super) fn pixel(&self, sample: [usize; 2]) -> [usize; 2] {
        [0, 1].map(|axis| self.start[axis] as usize + sample[axis] / self.per_pixel as usize)
    }

    /// Columns and rows of pixels, counted from the first pixel.
    pub(super) fn pixels(&self) -> impl Iterator<Item = [usize; 2]> + use<> {
        let [columns, rows] = self.size.map(|samples| samples / self.per_pixel as usize);
        (0..rows).flat_map(move |row| (0..columns).map(move |column| [column, row]))
    }

    /// Columns and rows of the samples of a pixel.
    pub(super) fn samples(&self, pixel: [usize; 2]) -> impl Iterator<Item = [usize; 2]> + use<> {
        let side = self.per_pixel as usize;
        let [first, last] = [pixel.map(|at| at * side), pixel.map(|at| (at + 1) * side)];
        (first[1]..last[1]).flat_map(move |row| (first[0]..last[0]).map(move |column| [column, row]))
    }

    /// The samples whose coordinates lie in a closed range, as a half-open range.
    fn range(&self, axis: usize, low: i32, high: i32) -> std::ops::Range<usize> {
        let spacing = self.spacing();
        let first = self.start[axis] as i32 * PIXEL + spacing / 2;
        let from = (low - first + spacing - 1).div_euclid(spacing).max(0) as usize;
        let to = ((high - first).div_euclid(spacing) + 1).max(0) as usize;
        from..to.min(self.size[axis])
    }
}

/// The face visible at each sample of a grid, and its nearness.
#[derive(Debug)]
pub(super) struct Visible {
    pub(super) face: Vec<u32>,
    pub(super) near: Vec<f64>,
}

impl Visible {
    /// Only background.
    pub(super) fn nothing(grid: &Grid) -> Self {
        let places = grid.size[0] * grid.size[1];
        Self { face: vec![NONE; places], near: vec![f64::NEG_INFINITY; places] }
    }

    /// Draws a face over farther ones; of two equally near faces the first one stays.
    pub(super) fn draw(&mut self, grid: &Grid, face: u32, triangle: &Triangle) {
        let [low, high] = triangle.bounds;
        let columns = grid.range(0, low[0], high[0]);
        let spacing = i64::from(grid.spacing());
        // A position on an edge belongs to exactly one of the two faces that share it.
        let least = triangle.edges.map(|[a, b, _]| i64::from(!(a > 0 || (a == 0 && b > 0))));
        let [n, by_q, by_r] =
            [triangle.near[0], triangle.near[1] - triangle.near[0], triangle.near[2] - triangle.near[0]];
        let area = 1.0 / triangle.area as f64;
        for row in grid.range(1, low[1], high[1]) {
            let [x, y] = grid.place(columns.start, row).map(i64::from);
            let mut values = triangle.edges.map(|[a, b, c]| a * x + b * y + c);
            for column in columns.clone() {
                if values[0] >= least[0] && values[1] >= least[1] && values[2] >= least[2] {
                    let near = n + (values[1] as f64 * by_q + values[2] as f64 * by_r) * area;
                    let place = row * grid.size[0] + column;
                    if near > self.near[place] {
                        self.near[place] = near;
                        self.face[place] = face;
                    }
                }
                for corner in 0..3 {
                    values[corner] += triangle.edges[corner][0] * spacing;
                }
            }
        }
    }
}
