//! Affine maps.

use crate::mesh::{MeshError, TriMesh};

/// The map `x ↦ linear·x + translation`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    /// Rows of the linear part.
    pub linear: [[f64; 3]; 3],
    /// Image of the origin.
    pub translation: [f64; 3],
}

impl Affine {
    /// The map that leaves every point where it is.
    pub const IDENTITY: Self =
        Self { linear: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], translation: [0.0; 3] };

    /// Scales about the origin by a factor per axis.
    pub const fn scale([x, y, z]: [f64; 3]) -> Self {
        Self { linear: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]], ..Self::IDENTITY }
    }

    /// Moves by a vector.
    pub const fn translate(translation: [f64; 3]) -> Self {
        Self { translation, ..Self::IDENTITY }
    }

    /// Rotates about an axis through the origin, counterclockwise seen from the tip of the axis. Quarter turns about a coordinate
    /// axis are exact. `None` if the axis has length zero or anything is not finite.
    pub fn rotate(axis: [f64; 3], degrees: f64) -> Option<Self> {
        let largest =
            axis.into_iter().fold(0.0, |m: f64, x| if x.abs() > m || x.is_nan() { x.abs() } else { m });
        if !(largest > 0.0 && largest.is_finite() && degrees.is_finite()) {
            return None;
        }
        let scaled = axis.map(|x| x / largest);
        let norm = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        let [x, y, z] = scaled.map(|x| x / norm);
        let [c, s] = cosine_and_sine(degrees);
        let t = 1.0 - c;
        let linear = [
            [t * x * x + c, t * x * y - s * z, t * x * z + s * y],
            [t * x * y + s * z, t * y * y + c, t * y * z - s * x],
            [t * x * z - s * y, t * y * z + s * x, t * z * z + c],
        ];
        Some(Self { linear, translation: [0.0; 3] })
    }

    /// Where the map takes a point.
    pub fn apply(&self, p: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|i| {
            let [a, b, c] = self.linear[i];
            a * p[0] + b * p[1] + c * p[2] + self.translation[i]
        })
    }
}

/// Cosine and sine of an angle in degrees; exact at quarter turns.
fn cosine_and_sine(degrees: f64) -> [f64; 2] {
    let turned = degrees % 360.0;
    let quarters = (turned / 90.0).round();
    let rest = (turned - 90.0 * quarters).to_radians();
    let (cos, sin) = (libm::cos(rest), libm::sin(rest));
    match (quarters as i32).rem_euclid(4) {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// Maps every vertex. A map that mirrors reverses the orientation of closed meshes; faces keep their vertex order.
///
/// # Errors
/// [`MeshError`] if a coordinate leaves the supported range.
pub fn transform(mesh: &TriMesh, map: &Affine) -> Result<TriMesh, MeshError> {
    TriMesh::new(mesh.positions().iter().map(|&p| map.apply(p)).collect(), mesh.faces().to_vec())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shapes::measure::{assert_close, assert_solid};
    use crate::mesh::shapes::tetrahedron;

    #[test]
    fn quarter_turns_are_exact_and_follow_the_right_hand() {
        let turn = Affine::rotate([0.0, 0.0, 2.0], 90.0).unwrap();
        assert_eq!(turn.apply([1.0, 2.0, 3.0]), [-2.0, 1.0, 3.0]);
        let turn = Affine::rotate([0.0, 0.0, 1e-300], -450.0).unwrap();
        assert_eq!(turn.apply([1.0, 2.0, 3.0]), [2.0, -1.0, 3.0]);
    }

    #[test]
    fn rotations_keep_lengths_and_the_axis() {
        let axis = [1.0, -2.0, 0.5];
        for degrees in [0.0, 30.0, 45.0, 123.4, 359.0, -1e4] {
            let map = Affine::rotate(axis, degrees).unwrap();
            for i in 0..3 {
                assert_close(map.apply(axis)[i], axis[i]);
                for j in 0..3 {
                    let dot: f64 = (0..3).map(|k| map.linear[i][k] * map.linear[j][k]).sum();
                    assert_close(dot, if i == j { 1.0 } else { 0.0 });
                }
            }
            let trace: f64 = (0..3).map(|i| map.linear[i][i]).sum();
            assert!((trace - 1.0 - 2.0 * degrees.to_radians().cos()).abs() < 1e-12);
        }
    }

    #[test]
    fn an_axis_without_direction_is_refused() {
        for axis in [[0.0; 3], [f64::NAN, 1.0, 0.0], [1.0, f64::NAN, 0.0], [f64::INFINITY, 0.0, 0.0]] {
            assert_eq!(Affine::rotate(axis, 1.0), None);
        }
        assert_eq!(Affine::rotate([1.0, 0.0, 0.0], f64::NAN), None);
    }

    #[test]
    fn meshes_are_scaled_and_moved() {
        let mesh = tetrahedron(1.0).unwrap();
        let moved = transform(&mesh, &Affine::translate([1.0, 2.0, 3.0])).unwrap();
        assert_eq!(moved.positions()[0][2], mesh.positions()[0][2] + 3.0);
        let scaled = transform(&mesh, &Affine::scale([2.0, 3.0, 4.0])).unwrap();
        assert_solid(&scaled, 24.0 / (6.0 * 2.0_f64.sqrt()));
        assert!(matches!(transform(&mesh, &Affine::scale([1e302; 3])), Err(MeshError::TooLarge { .. })));
    }
}
