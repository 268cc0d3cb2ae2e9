//! Rotations whose exact entries are known.

use super::Aabb;
use crate::exact::Interval;
use glam::{DMat3, DQuat};

/// A rotation by a quaternion of integers: its matrix has integers over one integer as entries, so it is exactly a rotation, and entries
/// are rounded once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    /// The integers, the real part last.
    quaternion: [f64; 4],
    /// The matrix, rounded.
    rows: [[f64; 3]; 3],
    /// How far from the origin the points are that it was made for.
    reach: f64,
}

impl Turn {
    /// Integers of quaternions, at most: entries and their sums stay below 2^53, and angles are off by about a millionth.
    const MOST: f64 = (1_u64 << 20) as f64;
    /// What [`Turn::apply`] is off by, in units of `2^-53` times the distance from the origin. An entry, its product and two sums are off by
    /// one each, relative to a sum of magnitudes; the matrix of the magnitudes of a rotation lengthens vectors by at most `sqrt(3)`.
    const ERROR: f64 = 8.0;

    /// The nearest to a rotation, for points of a box.
    pub(super) fn near(rotation: DMat3, aabb: &Aabb) -> Self {
        let quaternion = DQuat::from_mat3(&rotation).normalize();
        let quaternion = quaternion.to_array().map(|component| (Self::MOST * component).round());
        let (numerators, denominator) = matrix(quaternion);
        let rows = numerators.map(|row| row.map(|entry| entry / denominator));
        Self { quaternion, rows, reach: Self::reach_of(aabb) }
    }

    /// The greatest distance of a point of a box from the origin, rounded up.
    pub(super) fn reach_of(aabb: &Aabb) -> f64 {
        let far = |k: usize| f64::max(aabb.lower[k].abs(), aabb.upper[k].abs());
        let sum: f64 = [0, 1, 2].map(|k| far(k) * far(k)).iter().sum();
        sum.sqrt() * (1.0 + 8.0 * f64::EPSILON)
    }

    /// How far what [`Turn::apply`] makes of a point that it was made for may be from the exact image.
    pub(super) fn error(&self) -> f64 {
        Self::ERROR * 0.5 * f64::EPSILON * self.reach
    }

    #[inline]
    pub(super) fn apply(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        self.rows.map(|[a, b, c]| a * x + b * y + c * z)
    }

    /// Turns back, rounded.
    #[inline]
    pub(super) fn back(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        [0, 1, 2].map(|k| self.rows[0][k] * x + self.rows[1][k] * y + self.rows[2][k] * z)
    }

    /// Encloses the exact image of a point.
    pub(super) fn enclosure(&self, [x, y, z]: [Interval; 3]) -> [Interval; 3] {
        let (numerators, denominator) = matrix(self.quaternion);
        let denominator = Interval::point(denominator);
        numerators.map(|row| {
            let [a, b, c] = row.map(Interval::point);
            (a * x + b * y + c * z).divide_by_positive(denominator)
        })
    }
}

/// The matrix of a quaternion of integers: the integers that are its entries when they are divided by the last result.
fn matrix([x, y, z, w]: [f64; 4]) -> ([[f64; 3]; 3], f64) {
    let numerators = [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ];
    (numerators, w * w + x * x + y * y + z * z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Random;
    use glam::DVec3;

    #[test]
    fn matrices_are_rotations_and_images_are_enclosed() {
        let mut random = Random::new(5);
        let around = Aabb::of_points(&[[-1.0; 3], [1.0; 3]]);
        for _ in 0..2000 {
            let [a, b, c, d]: [f64; 4] = std::array::from_fn(|_| random.signed_unit());
            let rotation = DMat3::from_quat(DQuat::from_xyzw(a, b, c, d).normalize());
            let turn = Turn::near(rotation, &around);
            // All numbers are integers below 2^42, so the products of this test are exact in 128 bits.
            let (numerators, denominator) = matrix(turn.quaternion);
            let rows = numerators.map(|row| row.map(|entry| entry as i128));
            let of = |i: usize, j: usize| (0..3).map(|k| rows[i][k] * rows[j][k]).sum::<i128>();
            let square = (denominator as i128).pow(2);
            for i in 0..3 {
                for j in 0..3 {
                    assert_eq!(of(i, j), if i == j { square } else { 0 });
                }
            }
            let p: [f64; 3] = std::array::from_fn(|_| random.signed_unit());
            let image = turn.apply(p);
            let wanted = rotation * DVec3::from_array(p);
            assert!((DVec3::from_array(image) - wanted).length() < 1e-5);
            assert!((DVec3::from_array(turn.back(image)) - DVec3::from_array(p)).length() < 1e-15);
            let enclosed = turn.enclosure(p.map(Interval::point));
            let off: f64 = (0..3)
                .map(|k| {
                    (image[k] - enclosed[k].lower()).abs().max((image[k] - enclosed[k].upper()).abs()).powi(2)
                })
                .sum();
            assert!(off.sqrt() <= turn.error(), "{off} for {}", turn.error());
        }
    }
}
