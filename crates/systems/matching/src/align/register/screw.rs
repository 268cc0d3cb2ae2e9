//! The screw motion from one pose to another: a rotation about an axis and a translation along it.

use super::placement::Placement;
use glam::{DQuat, DVec3};

/// A rotation counts as zero if the sine of half its angle is below this.
const LEAST_TURN: f64 = 1e-9;

/// A rotation about an axis with a translation along it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Screw {
    /// Of length 1; zero if there is no rotation.
    pub(super) axis: DVec3,
    /// A point of the axis.
    pub(super) point: DVec3,
    pub(super) slide: f64,
}

impl Screw {
    /// The motion from the first pose to the second, ignoring scale. Of the points of the axis, the one nearest to `about` is
    /// returned.
    ///
    /// # Source
    /// Chasles' theorem: `ball_treatise_1900`.
    pub(super) fn between(first: &Placement, second: &Placement, about: DVec3) -> Self {
        let turn = second.pose.rotation * first.pose.rotation.transpose();
        let factor = second.scale / first.scale;
        // The image of the point.
        let there = second.pose.translation + turn * (factor * (about - first.pose.translation));
        let shift = there - about;
        let q = DQuat::from_mat3(&turn);
        let (sine, cosine) = (q.xyz().length(), q.w);
        if sine < LEAST_TURN {
            return Self { axis: DVec3::ZERO, point: about, slide: shift.length() };
        }
        let sign = if cosine < 0.0 { -1.0 } else { 1.0 };
        let axis = sign * q.xyz() / sine;
        let slide = axis.dot(shift);
        let across = shift - slide * axis;
        let point = about + 0.5 * (across + axis.cross(across) * (cosine.abs() / sine));
        Self { axis, point, slide }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::pose::Pose;
    use super::*;
    use glam::DMat3;
    use pompeiu_core::mesh::Random;

    #[test]
    fn axis_point_and_slide_come_back() {
        let mut random = Random::new(12);
        let mut vector = || DVec3::from_array(std::array::from_fn(|_| random.signed_unit()));
        for degrees in [1e-3, 30.0, 90.0, 120.0, 179.999, 180.0] {
            let (axis, on_axis, about) = (vector().normalize(), vector(), vector());
            let turn = DMat3::from_axis_angle(axis, f64::to_radians(degrees));
            let slide = 0.3;
            let first = Placement {
                pose: Pose {
                    rotation: DMat3::from_axis_angle(vector().normalize(), 1.0),
                    translation: vector(),
                },
                scale: 1.0,
            };
            let translation = on_axis + turn * (first.pose.translation - on_axis) + slide * axis;
            let second =
                Placement { pose: Pose { rotation: turn * first.pose.rotation, translation }, scale: 1.0 };
            let found = Screw::between(&first, &second, about);
            let same = if degrees == 180.0 { found.axis.dot(axis).signum() } else { 1.0 };
            assert!((found.axis - same * axis).length() < 1e-6, "{degrees}: {found:?} {axis}");
            assert!((found.slide - same * slide).abs() < 1e-6, "{degrees}: {found:?}");
            // The point is on the axis, next to the given one.
            assert!((found.point - on_axis).cross(axis).length() < 1e-6, "{degrees}: {found:?}");
            assert!((found.point - about).dot(axis).abs() < 1e-6, "{degrees}: {found:?}");
        }
        let still =
            Placement { pose: Pose { rotation: DMat3::IDENTITY, translation: DVec3::ZERO }, scale: 1.0 };
        let slid = Placement { pose: Pose { translation: DVec3::X * 2.0, ..still.pose }, ..still };
        let found = Screw::between(&still, &slid, DVec3::Y);
        assert_eq!((found.axis, found.slide), (DVec3::ZERO, 2.0));
    }
}
