//! A rotation and a translation.

use glam::{DMat3, DVec3};

/// The map `x ↦ rotation·x + translation`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) rotation: DMat3,
    pub(super) translation: DVec3,
}

impl Pose {
    pub(super) fn apply(&self, x: DVec3) -> DVec3 {
        self.rotation * x + self.translation
    }

    /// This pose, followed by a rotation by the vector `turn` about a point, and a translation.
    pub(super) fn then(&self, turn: DVec3, about: DVec3, shift: DVec3) -> Self {
        let by = rotation(turn);
        Self {
            rotation: orthogonal(by * self.rotation),
            translation: by * (self.translation - about) + about + shift,
        }
    }
}

/// The rotation about the direction of a vector by its length, in radians.
pub(super) fn rotation(turn: DVec3) -> DMat3 {
    let angle = turn.length();
    let axis = turn / angle;
    if !axis.is_finite() {
        return DMat3::IDENTITY;
    }
    let (sin, cos) = (libm::sin(angle), libm::cos(angle));
    let across = |v: DVec3| v * cos + axis.cross(v) * sin + axis * (axis.dot(v) * (1.0 - cos));
    DMat3::from_cols(across(DVec3::X), across(DVec3::Y), across(DVec3::Z))
}

/// One step of Newton's iteration for the nearest orthogonal matrix, so that rounding does not accumulate over many rotations.
fn orthogonal(r: DMat3) -> DMat3 {
    r * (DMat3::IDENTITY * 1.5 - (r.transpose() * r) * 0.5)
}

/// The 24 rotations that permute the axes; the four that keep each axis on its line come first.
pub(super) fn axis_rotations() -> impl Iterator<Item = DMat3> {
    const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];
    let axes = [DVec3::X, DVec3::Y, DVec3::Z];
    let signs = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]];
    ORDERS.into_iter().flat_map(move |[i, j, _]| {
        signs.into_iter().map(move |[s, t]| {
            let (first, second) = (axes[i] * s, axes[j] * t);
            DMat3::from_cols(first, second, first.cross(second))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axis_rotations_are_the_group_of_the_cube() {
        let all: Vec<DMat3> = axis_rotations().collect();
        assert_eq!((all.len(), all[0]), (24, DMat3::IDENTITY));
        for (i, r) in all.iter().enumerate() {
            assert_eq!(r.determinant(), 1.0);
            assert!(all[..i].iter().all(|other| other != r));
        }
    }

    #[test]
    fn many_turns_stay_a_rotation() {
        let mut pose = Pose { rotation: DMat3::IDENTITY, translation: DVec3::ZERO };
        let turn = DVec3::new(0.1, -0.2, 0.05);
        for _ in 0..10_000 {
            pose = pose.then(turn, DVec3::ONE, DVec3::ZERO);
        }
        let off = pose.rotation.transpose() * pose.rotation - DMat3::IDENTITY;
        assert!(off.to_cols_array().iter().all(|x| x.abs() < 1e-15));
        assert!((pose.apply(DVec3::ONE) - DVec3::ONE).length() < 1e-11);
    }
}
