//! The energy density of a cell at a point.

#[cfg(test)]
use glam::DVec3;

/// The energy density of a Jacobian matrix with columns a, b, c.
#[derive(Clone, Copy, Debug)]
pub(super) enum Shape {
    /// `(|J|² / (3 χ(det)^{2/3}))^{3/2}` with `χ(d) = (d + √(d² + ε²)) / 2`: finite for folded cells.
    MeanRatio { epsilon: f64 },
    /// `(|a| |b| |c| / det)^power`, the power from 1 to 15: infinite for folded cells.
    Scaled { power: i32 },
}

impl Shape {
    /// Mean ratios, regularised as far as the least determinant, relative to the size of its cell, needs it.
    pub(super) fn untangling(least: f64) -> Self {
        Self::MeanRatio { epsilon: if least > 0.0 { 1e-9 } else { (0.1 * -least).clamp(1e-4, 0.2) } }
    }

    /// The energy density and its derivatives with respect to the columns, of one cell: those of many are compared with it.
    #[cfg(test)]
    pub(super) fn cost(self, [a, b, c]: [DVec3; 3]) -> (f64, [DVec3; 3]) {
        let cofactors = [b.cross(c), c.cross(a), a.cross(b)];
        let det = a.dot(cofactors[0]);
        match self {
            Self::MeanRatio { epsilon } => {
                let root = (det * det + epsilon * epsilon).sqrt();
                // Avoids cancellation if the determinant is negative.
                let chi = if det > 0.0 {
                    0.5 * (det + root)
                } else {
                    0.5 * epsilon * epsilon / (root - det).max(1e-300)
                };
                let slope = chi / root.max(1e-300);
                let norm = a.length_squared() + b.length_squared() + c.length_squared();
                // (norm / 3)^1.5 / chi
                let power = (norm / 3.0).sqrt();
                let cost = power * norm / 3.0 / chi;
                let by_norm = 0.5 * power / chi;
                let by_det = -cost / chi * slope;
                let columns = [a, b, c];
                (cost, [0, 1, 2].map(|k| columns[k] * (2.0 * by_norm) + cofactors[k] * by_det))
            }
            Self::Scaled { power } => {
                let columns = [a, b, c];
                let size: f64 = columns.iter().map(|e| e.length()).product();
                if det <= 1e-9 * size || det <= 0.0 {
                    return (f64::INFINITY, [DVec3::ZERO; 3]);
                }
                let cost = (size / det).powi(power);
                let factor = cost * f64::from(power);
                (
                    cost,
                    [0, 1, 2]
                        .map(|k| (columns[k] / columns[k].length_squared() - cofactors[k] / det) * factor),
                )
            }
        }
    }
}
