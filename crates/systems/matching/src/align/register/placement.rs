//! A rotation, a scale and a translation.

use super::super::pose::Pose;
use glam::{DMat3, DVec3};

/// The map `x ↦ rotation·(scale·x) + translation`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Placement {
    pub(super) pose: Pose,
    pub(super) scale: f64,
}

impl Placement {
    /// The map with this rotation and scale that takes the second point to the first.
    pub(super) fn centred(rotation: DMat3, scale: f64, [to, from]: [DVec3; 2]) -> Self {
        Self { pose: Pose { rotation, translation: to - rotation * (scale * from) }, scale }
    }

    pub(super) fn apply(&self, x: DVec3) -> DVec3 {
        self.pose.apply(self.scale * x)
    }

    /// This map, followed by a scaling and a rotation about a point, and a translation.
    pub(super) fn then(&self, factor: f64, turn: DVec3, about: DVec3, shift: DVec3) -> Self {
        let grown = Pose { translation: about + factor * (self.pose.translation - about), ..self.pose };
        Self { pose: grown.then(turn, about, shift), scale: factor * self.scale }
    }

    /// The angle between the rotations of two maps, in radians.
    pub(super) fn angle(&self, other: &Self) -> f64 {
        let between = self.pose.rotation.transpose() * other.pose.rotation;
        let trace = between.x_axis.x + between.y_axis.y + between.z_axis.z;
        libm::acos((0.5 * (trace - 1.0)).clamp(-1.0, 1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_and_turn_leave_the_point_they_are_about_in_place() {
        let start = Placement::centred(DMat3::from_rotation_z(0.3), 2.0, [DVec3::ONE, DVec3::X]);
        assert!((start.apply(DVec3::X) - DVec3::ONE).length() < 1e-15);
        let x = DVec3::new(0.2, -0.7, 0.4);
        let about = start.apply(x);
        let moved = start.then(1.5, DVec3::new(0.1, 0.2, -0.4), about, DVec3::ZERO);
        assert!((moved.apply(x) - about).length() < 1e-15);
        let other = DVec3::new(-1.0, 0.1, 0.3);
        let grown = moved.apply(other).distance(about) / start.apply(other).distance(about);
        assert!((grown - 1.5).abs() < 1e-14 && (moved.scale - 3.0).abs() < 1e-15);
        let turned = DVec3::new(0.1, 0.2, -0.4).length();
        assert!((start.angle(&moved) - turned).abs() < 1e-12);
    }
}
