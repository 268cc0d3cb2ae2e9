//! Transforms of nodes.

use super::document::Node;

/// An affine map: the rows of its linear part, each followed by its translation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::formats) struct Transform([[f64; 4]; 3]);

impl Transform {
    pub(in crate::formats) const IDENTITY: Self =
        Self([[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]);

    /// The local transform of a node; `None` for a projection or a zero quaternion.
    pub(super) fn of_node(node: &Node) -> Option<Self> {
        if let Some(m) = node.matrix {
            let affine = [m[3], m[7], m[11], m[15]] == [0.0, 0.0, 0.0, 1.0];
            return affine.then(|| Self([0, 1, 2].map(|row| [m[row], m[row + 4], m[row + 8], m[row + 12]])));
        }
        let translation = node.translation.unwrap_or([0.0; 3]);
        let scale = node.scale.unwrap_or([1.0; 3]);
        let rotation = rotation(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]))?;
        Some(Self([0, 1, 2].map(|row| {
            let [a, b, c] = rotation[row];
            [a * scale[0], b * scale[1], c * scale[2], translation[row]]
        })))
    }

    /// The map whose linear part has these rows, each followed by its translation.
    pub(in crate::formats) const fn from_rows(rows: [[f64; 4]; 3]) -> Self {
        Self(rows)
    }

    /// The composition that applies `inner` first.
    pub(in crate::formats) fn after(&self, inner: &Self) -> Self {
        Self(self.0.map(|row| {
            [0, 1, 2, 3].map(|column| {
                let own = if column == 3 { row[3] } else { 0.0 };
                linear_combination([row[0], row[1], row[2]], [0, 1, 2].map(|k| inner.0[k][column]), own)
            })
        }))
    }

    pub(in crate::formats) fn apply(&self, point: [f64; 3]) -> [f64; 3] {
        self.0.map(|row| linear_combination([row[0], row[1], row[2]], point, row[3]))
    }

    /// Whether the map reverses orientation.
    pub(in crate::formats) fn mirrors(&self) -> bool {
        // Rows are scaled to size one, so that products of tiny or huge numbers keep the sign.
        let [a, b, c] = self.0.map(|row| {
            let largest =
                row[..3].iter().fold(0.0, |most, x: &f64| if x.abs() > most { x.abs() } else { most });
            row.map(|x| x / largest)
        });
        let determinant = a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]);
        determinant < 0.0
    }

    /// The unit normal of a surface after the map, for its normal before: by the inverse of the transpose. As it is where the map has no
    /// inverse.
    pub(in crate::formats) fn apply_to_normal(&self, normal: [f64; 3]) -> [f64; 3] {
        let linear = self.0.map(|row| [row[0], row[1], row[2]]);
        let identity = Self::IDENTITY.0.map(|row| [row[0], row[1], row[2]]);
        if linear == identity {
            return normal;
        }
        // Scaled to size one, so that products neither overflow nor vanish.
        let most =
            linear.iter().flatten().fold(0.0, |most: f64, x| if x.abs() > most { x.abs() } else { most });
        let [a, b, c] = linear.map(|row| row.map(|x| x / most));
        let cross = |p: [f64; 3], q: [f64; 3]| {
            [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
        };
        // The cofactors are the inverse of the transpose times the determinant, of which the sign matters.
        let sign = if self.mirrors() { -1.0 } else { 1.0 };
        let rows = [cross(b, c), cross(c, a), cross(a, b)];
        let image = rows.map(|row| sign * (row[0] * normal[0] + row[1] * normal[1] + row[2] * normal[2]));
        let length = image.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 && length.is_finite() { image.map(|x| x / length) } else { normal }
    }
}

/// The sum of products plus `constant`, leaving out zero terms, so that the identity preserves every bit of a point, even the sign
/// of −0.
fn linear_combination(factors: [f64; 3], values: [f64; 3], constant: f64) -> f64 {
    let mut sum = -0.0;
    for (factor, value) in factors.into_iter().zip(values) {
        if factor != 0.0 {
            sum += factor * value;
        }
    }
    if constant == 0.0 { sum } else { sum + constant }
}

/// The rotation matrix of a nonzero quaternion, which need not have unit length.
fn rotation(quaternion: [f64; 4]) -> Option<[[f64; 3]; 3]> {
    let length = quaternion.iter().map(|c| c * c).sum::<f64>().sqrt();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let [x, y, z, w] = quaternion.map(|c| c / length);
    Some([
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
        [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
        [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
    ])
}
