//! Interpolation of values on a lattice.

/// Values at the points `(origin + index) · spacing` of a lattice, bilinear between them.
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    /// Points along x and y.
    pub points: [usize; 2],
    /// Position of the first point, in spacings.
    pub origin: [f64; 2],
    /// Spacings per unit of length.
    pub per_length: f64,
    /// Whether the lattice is periodic along x and y.
    pub periodic: [bool; 2],
}

impl Lattice {
    /// The position of a point.
    pub fn position(&self, index: usize) -> [f64; 2] {
        let (i, j) = (index % self.points[0], index / self.points[0]);
        [(self.origin[0] + i as f64) / self.per_length, (self.origin[1] + j as f64) / self.per_length]
    }

    /// The indices along an axis before and after a position, and how far it is from the first. Positions outside are moved to the nearest
    /// one on the lattice.
    #[inline]
    fn along(&self, k: usize, place: f64) -> (usize, usize, f64) {
        let n = self.points[k];
        let at = place * self.per_length - self.origin[k];
        if self.periodic[k] {
            let wrapped = at.rem_euclid(n as f64);
            let first = wrapped.floor();
            let low = first as usize % n;
            (low, (low + 1) % n, wrapped - first)
        } else {
            let most = (n - 1) as f64;
            let kept = if at > 0.0 { if at < most { at } else { most } } else { 0.0 };
            let low = (kept as usize).min(n.saturating_sub(2));
            (low, (low + 1).min(n - 1), kept - low as f64)
        }
    }

    /// The interpolated value at a position.
    #[inline]
    pub fn sample(&self, values: &[f64], place: [f64; 2]) -> f64 {
        let (left, right, x) = self.along(0, place[0]);
        let (below, above, y) = self.along(1, place[1]);
        let rows = [below * self.points[0], above * self.points[0]];
        (1.0 - x) * (1.0 - y) * values[rows[0] + left]
            + x * (1.0 - y) * values[rows[0] + right]
            + (1.0 - x) * y * values[rows[1] + left]
            + x * y * values[rows[1] + right]
    }

    /// The least and the greatest of the values around a position.
    pub fn range(&self, values: &[f64], place: [f64; 2]) -> [f64; 2] {
        let (left, right, _) = self.along(0, place[0]);
        let (below, above, _) = self.along(1, place[1]);
        let rows = [below * self.points[0], above * self.points[0]];
        let around = [rows[0] + left, rows[0] + right, rows[1] + left, rows[1] + right].map(|i| values[i]);
        around.into_iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
            [if x < least { x } else { least }, if x > most { x } else { most }]
        })
    }
}
