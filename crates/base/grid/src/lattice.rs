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

    /// The lattice points around a position with their weights. Positions outside are moved to the nearest one on the lattice.
    fn around(&self, place: [f64; 2]) -> [(usize, f64); 4] {
        let mut low = [0; 2];
        let mut high = [0; 2];
        let mut share = [0.0; 2];
        for k in 0..2 {
            let n = self.points[k];
            let at = place[k] * self.per_length - self.origin[k];
            if self.periodic[k] {
                let wrapped = at.rem_euclid(n as f64);
                let first = wrapped.floor();
                share[k] = wrapped - first;
                low[k] = first as usize % n;
                high[k] = (low[k] + 1) % n;
            } else {
                let most = (n - 1) as f64;
                let kept = if at > 0.0 { if at < most { at } else { most } } else { 0.0 };
                low[k] = (kept as usize).min(n.saturating_sub(2));
                high[k] = (low[k] + 1).min(n - 1);
                share[k] = kept - low[k] as f64;
            }
        }
        let index = |i: usize, j: usize| j * self.points[0] + i;
        [
            (index(low[0], low[1]), (1.0 - share[0]) * (1.0 - share[1])),
            (index(high[0], low[1]), share[0] * (1.0 - share[1])),
            (index(low[0], high[1]), (1.0 - share[0]) * share[1]),
            (index(high[0], high[1]), share[0] * share[1]),
        ]
    }

    /// The interpolated value at a position.
    pub fn sample(&self, values: &[f64], place: [f64; 2]) -> f64 {
        self.around(place).into_iter().map(|(index, share)| share * values[index]).sum()
    }

    /// The least and the greatest of the values around a position.
    pub fn range(&self, values: &[f64], place: [f64; 2]) -> [f64; 2] {
        let around = self.around(place).into_iter().map(|(index, _)| values[index]);
        around.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], x| {
            [if x < least { x } else { least }, if x > most { x } else { most }]
        })
    }
}
