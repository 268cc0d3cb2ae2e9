//! A map as position and angles for other programs.

use super::super::Matrix;
use serde::Serialize;

/// Below this cosine of the second angle, the other two rotations have the same axis (gimbal lock).
const GIMBAL: f64 = 1e-9;

/// The fields of `ParaView`'s filter "Transform", which applies `T·Rz·Rx·Ry·S` to columns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct TransformSettings {
    /// The field Translate, in the unit of the meshes.
    pub translate: [f64; 3],
    /// The field Rotate: angles about x, y and z in degrees.
    pub rotate: [f64; 3],
    /// The field Scale: the same factor along all axes.
    pub scale: [f64; 3],
}

impl TransformSettings {
    /// From a rotation and uniform scale, given as a matrix.
    pub(super) fn of(matrix: &Matrix, scale: f64) -> Self {
        let r = |i: usize, j: usize| matrix[i][j] / scale;
        let cosine = r(2, 0).hypot(r(2, 2));
        let about_x = libm::atan2(r(2, 1), cosine);
        let (about_y, about_z) = if cosine > GIMBAL {
            (libm::atan2(-r(2, 0), r(2, 2)), libm::atan2(-r(0, 1), r(1, 1)))
        } else {
            (0.0, libm::atan2(r(1, 0), r(0, 0)))
        };
        Self {
            translate: [0, 1, 2].map(|i| matrix[i][3]),
            rotate: [about_x, about_y, about_z].map(f64::to_degrees),
            scale: [scale; 3],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::Random;

    /// The filter's matrix: the product of its steps.
    fn product(settings: &TransformSettings) -> Matrix {
        let turn = |axis: usize, degrees: f64| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            let mut m = [[0.0; 4]; 4];
            m[axis][axis] = 1.0;
            m[3][3] = 1.0;
            (m[i][i], m[j][j], m[i][j], m[j][i]) = (cos, cos, -sin, sin);
            m
        };
        let times = |a: Matrix, b: Matrix| -> Matrix {
            std::array::from_fn(|i| std::array::from_fn(|j| (0..4).map(|k| a[i][k] * b[k][j]).sum()))
        };
        let [x, y, z] = settings.rotate;
        let mut scale = [[0.0; 4]; 4];
        (scale[0][0], scale[1][1], scale[2][2]) = settings.scale.into();
        scale[3][3] = 1.0;
        let mut all = times(times(times(turn(2, z), turn(0, x)), turn(1, y)), scale);
        for (row, shift) in all.iter_mut().zip(settings.translate) {
            row[3] = shift;
        }
        all
    }

    #[test]
    fn the_steps_of_the_filter_make_the_matrix() {
        let mut random = Random::new(77);
        for case in 0..200 {
            let angle = |x: f64| if case % 10 == 0 { 90.0 * (3.0 * x).round() } else { 180.0 * x };
            let settings = TransformSettings {
                translate: std::array::from_fn(|_| random.signed_unit()),
                rotate: std::array::from_fn(|_| angle(random.signed_unit())),
                scale: [1.0 + 0.9 * random.signed_unit(); 3],
            };
            let matrix = product(&settings);
            let again = product(&TransformSettings::of(&matrix, settings.scale[0]));
            let off = matrix.as_flattened().iter().zip(again.as_flattened()).map(|(a, b)| (a - b).abs());
            assert!(off.fold(0.0, f64::max) < 1e-9, "{settings:?} {matrix:?} {again:?}");
        }
    }
}
