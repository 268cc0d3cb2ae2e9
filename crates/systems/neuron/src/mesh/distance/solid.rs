//! The union of the round cones of a skeleton, with proven bounds on the distance from it.

use super::boxes::Boxes;
use crate::cone::MeasuredCone;
use crate::mesh::least_shift::{Half, facing_of, least_shift};
use crate::mesh::tube::is_ball;
use crate::{RoundCone, Skeleton};
use glam::DVec3;

/// Rounding of a distance, relative to the greatest coordinate and radius.
///
/// # Accuracy
/// With u = 2⁻⁵³ and M the sum of the greatest coordinate and the greatest radius. Points of patches are means or convex
/// combinations of points of at most M, over at most 14 levels with 6 operations each: 84 u M. Points on cones have at most
/// 20 operations with vectors of at most M. A distance from a cone or a triangle has at most 24 operations with lengths of at most
/// 4 M. Together less than 300 u M, which is more than doubled.
const ROUNDING: f64 = 640.0 * 1.110_223_024_625_156_5e-16;

/// A cone of the skeleton.
pub(super) struct Cone {
    pub(super) shape: RoundCone,
    measured: MeasuredCone,
    /// The samples at its ends.
    pub(super) samples: [usize; 2],
    /// The slope of the radius; the lateral surface exists if it is between -1 and 1.
    slope: f64,
}

impl Cone {
    fn new(cone: RoundCone, samples: [usize; 2]) -> Self {
        let length = cone.ends[0].distance(cone.ends[1]);
        let change = cone.radii[1] - cone.radii[0];
        let slope = if length > 0.0 { change / length } else { f64::INFINITY };
        Self { shape: cone, measured: MeasuredCone::new(cone), samples, slope }
    }

    /// The slope of the radius along the axis, if the cone has a lateral surface.
    pub(super) fn lateral_slope(&self) -> Option<f64> {
        (self.slope.abs() < 1.0).then_some(self.slope)
    }

    /// The distance of a point, and the parameter of the nearest ball.
    pub(super) fn distance(&self, p: DVec3) -> (f64, f64) {
        self.measured.distance(p)
    }

    /// The radius at a parameter.
    pub(super) fn radius(&self, t: f64) -> f64 {
        self.shape.radii[0] + (self.shape.radii[1] - self.shape.radii[0]) * t
    }

    /// A lower bound on the radius of the nearest ball of any point within `reach` of one whose nearest ball is at `t`.
    ///
    /// The nearest ball moves along the axis by at most `1 / √(1 − k²)` times what the point moves, `k` the slope.
    fn least_radius(&self, t: f64, reach: f64) -> f64 {
        let [least, most] = [f64::min, f64::max].map(|of| of(self.shape.radii[0], self.shape.radii[1]));
        // The greater ball contains the others, and counts as the nearest one where they touch it from inside, too.
        if self.slope.is_nan() || self.slope.abs() >= 1.0 {
            return most;
        }
        let change = self.slope.abs() * reach / (1.0 - self.slope * self.slope).sqrt();
        (self.radius(t) - change).max(least)
    }

    /// The direction from the nearest ball's centre to a point.
    pub(super) fn outwards(&self, p: DVec3, t: f64) -> DVec3 {
        let [a, b] = self.shape.ends;
        let (away, axis) = (p - a.lerp(b, t), b - a);
        away.try_normalize()
            .unwrap_or_else(|| axis.try_normalize().unwrap_or(DVec3::X).any_orthonormal_vector())
    }

    /// A lower bound on the distance of all points of a convex hull, moved by `shift`, from the cone, negative inside: that from
    /// the half-space with this unit normal that contains the cone.
    pub(super) fn beyond(&self, hull: &[DVec3], shift: DVec3, normal: DVec3) -> f64 {
        let [a, b] = self.shape.ends;
        let support = self.shape.radii[0].max(normal.dot(b - a) + self.shape.radii[1]);
        let least = hull.iter().map(|p| normal.dot(*p + shift - a)).fold(f64::INFINITY, f64::min);
        least - support
    }

    /// An upper bound on the distance of all points of a convex hull from the cone, negative inside: the distance is convex.
    pub(super) fn within(&self, hull: &[DVec3]) -> f64 {
        hull.iter().map(|p| self.distance(*p).0).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The union of cones.
pub(super) struct Solid {
    pub(super) cones: Vec<Cone>,
    boxes: Boxes,
    /// Bound on the rounding of any distance here, in micrometres.
    pub(super) rounding: f64,
}

/// The ball nearest to a point: the one with the least distance from its surface, negative inside.
#[derive(Clone, Copy)]
pub(super) struct Nearest {
    pub(super) cone: usize,
    pub(super) t: f64,
    /// Bounds on the distance from the union, without rounding.
    pub(super) lower: f64,
    pub(super) upper: f64,
}

impl Solid {
    /// The cones between neighbouring samples. At a ball, neurites begin in its centre with their own radius.
    pub(super) fn new(skeleton: &Skeleton) -> Self {
        let samples = skeleton.samples();
        let mut cones = Vec::with_capacity(samples.len());
        for (i, sample) in samples.iter().enumerate() {
            if is_ball(skeleton, i) || skeleton.degree(i) == 0 {
                let (ends, radii) = ([sample.position; 2], [sample.radius; 2]);
                cones.push(Cone::new(RoundCone { ends, radii }, [i, i]));
            }
            if let Some(parent) = skeleton.parent(i) {
                let pair = [parent, i];
                let ends = pair.map(|k| samples[k].position);
                let mut radii = pair.map(|k| samples[k].radius);
                for side in 0..2 {
                    if is_ball(skeleton, pair[side]) && !is_ball(skeleton, pair[1 - side]) {
                        radii[side] = samples[pair[1 - side]].radius;
                    }
                }
                cones.push(Cone::new(RoundCone { ends, radii }, pair));
            }
        }
        let boxes: Vec<[DVec3; 2]> = cones.iter().map(|cone| cone.shape.bounds()).collect();
        let size = boxes.iter().flatten().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let radius = samples.iter().map(|sample| sample.radius).fold(0.0, f64::max);
        Self { cones, boxes: Boxes::new(&boxes), rounding: ROUNDING * (size + radius) }
    }

    /// The nearest ball.
    pub(super) fn nearest(&self, p: DVec3) -> Nearest {
        let mut found = Nearest { cone: 0, t: 0.0, lower: f64::INFINITY, upper: f64::INFINITY };
        self.boxes.visit(p, f64::INFINITY, |index| {
            let cone = &self.cones[index as usize];
            let (distance, t) = cone.distance(p);
            let lower = cone.beyond(&[p], DVec3::ZERO, cone.outwards(p, t));
            found.lower = found.lower.min(lower);
            if distance < found.upper {
                found = Nearest { cone: index as usize, t, upper: distance, ..found };
            }
            found.upper.max(0.0)
        });
        found
    }

    /// Calls `visit` with each cone whose box is within a distance of a point.
    pub(super) fn near(&self, p: DVec3, distance: f64, mut visit: impl FnMut(&Cone)) {
        self.boxes.visit(p, distance, |index| {
            visit(&self.cones[index as usize]);
            distance
        });
    }

    /// The numbers of the cones whose boxes are within a distance of a point.
    pub(super) fn numbers_near(&self, p: DVec3, distance: f64) -> Vec<usize> {
        let mut found = Vec::new();
        self.boxes.visit(p, distance, |index| {
            found.push(index as usize);
            distance
        });
        found.sort_unstable();
        found
    }

    /// A lower bound on the radius of the nearest ball of any point within `reach` of `p`, whose distance from the union is at most
    /// `distance`.
    pub(super) fn least_radius(&self, p: DVec3, distance: f64, reach: f64) -> f64 {
        let mut least = f64::INFINITY;
        let limit = distance + 2.0 * reach + self.rounding;
        self.near(p, limit.max(0.0), |cone| {
            let (found, t) = cone.distance(p);
            if found <= limit {
                least = least.min(cone.least_radius(t, reach));
            }
        });
        least
    }

    /// The length of a move by which all points of a convex hull around `centre` leave the union; infinite if none was found. 0 if they
    /// are outside.
    ///
    /// The move is the shortest one into half-spaces beyond the cones that the points are in. Where these are several, as in the crotch of a
    /// fork, the half-spaces are those at the place where it ends, and straight moves along the crotch and to its sides are tried.
    pub(super) fn exit(&self, hull: &[DVec3], centre: DVec3, reach: f64) -> f64 {
        let (mut least, facing) = self.leave(hull, (centre, reach), DVec3::ZERO);
        if let Some([a, b]) = facing.filter(|[a, b]| a.dot(*b) < FACING) {
            let (along, across) = ((a + b).normalize_or_zero(), a.cross(b).normalize_or_zero());
            let sides = [along, across, -across, along + across, along - across];
            let straight = sides.into_iter().filter_map(DVec3::try_normalize);
            let straight = straight.map(|side| (self.straight_exit(hull, centre, reach, side), side));
            if let Some((length, side)) = straight.min_by(|a, b| a.0.total_cmp(&b.0))
                && length.is_finite()
            {
                least = least.min(length).min(self.leave(hull, (centre, reach), side * length).0);
            }
        }
        if least.is_finite() {
            return least;
        }
        // Straight moves, where the projections do not end.
        let sides =
            (0..27).map(|k| DVec3::new(f64::from(k % 3), f64::from(k / 3 % 3), f64::from(k / 9)) - 1.0);
        let straight = sides.filter_map(DVec3::try_normalize);
        straight.map(|along| self.straight_exit(hull, centre, reach, along)).fold(f64::INFINITY, f64::min)
    }

    /// The length of a move as [`Solid::exit`]'s, sought from a first one; and where it leaves several cones at once, the normals
    /// of those that face each other most.
    fn leave(
        &self,
        hull: &[DVec3],
        (centre, reach): (DVec3, f64),
        first: DVec3,
    ) -> (f64, Option<[DVec3; 2]>) {
        let (mut shift, mut least, mut facing) = (first, f64::INFINITY, None);
        let mut halves: Vec<Half> = Vec::new();
        let mut cones: Vec<u32> = Vec::new();
        if first != DVec3::ZERO {
            // Where the first move ends, they may be left already.
            self.boxes.visit(centre, reach, |index| {
                cones.push(index);
                reach
            });
            halves = vec![(DVec3::ZERO, 0.0); cones.len()];
        }
        for step in 0..MOST_MOVES {
            let moved = centre + shift;
            let half = |index: u32| {
                let cone = &self.cones[index as usize];
                let normal = cone.outwards(moved, cone.distance(moved).1);
                (normal, self.rounding - cone.beyond(hull, DVec3::ZERO, normal))
            };
            // The half-spaces for which the move was made, and those beyond all other cones.
            let mut is_out = halves.iter().all(|(normal, offset)| normal.dot(shift) >= *offset);
            self.boxes.visit(moved, reach, |index| {
                if !cones.contains(&index) {
                    let (normal, offset) = half(index);
                    if normal.dot(shift) < offset {
                        is_out = false;
                        cones.push(index);
                        halves.push((normal, offset));
                    }
                }
                reach
            });
            // A first move only says where to look.
            if is_out && (step > 0 || first == DVec3::ZERO) {
                let length = shift.length();
                let is_less = length < NOTABLY * least;
                least = least.min(length);
                if halves.len() < 2 || !is_less {
                    break;
                }
            }
            for (known, index) in halves.iter_mut().zip(&cones) {
                *known = half(*index);
            }
            if facing.is_none() {
                facing = facing_of(&halves);
            }
            let deepest = halves.iter().map(|(_, offset)| *offset).fold(0.0, f64::max);
            let wider: Vec<Half> =
                halves.iter().map(|(normal, offset)| (*normal, offset + EXCESS * deepest)).collect();
            match least_shift(&wider).filter(|found| found.length() <= FARTHEST * deepest) {
                Some(found) => shift = found,
                None => break,
            }
        }
        (least, facing)
    }

    /// The length of a move along a unit vector by which all points of a convex hull around `centre` leave the union.
    fn straight_exit(&self, hull: &[DVec3], centre: DVec3, reach: f64, along: DVec3) -> f64 {
        let mut length = 0.0;
        for _ in 0..MOST_MOVES {
            let shift = along * length;
            let moved = centre + shift;
            let mut more = 0.0_f64;
            self.near(moved, reach, |cone| {
                let normal = cone.outwards(moved, cone.distance(moved).1);
                let missing = self.rounding - cone.beyond(hull, shift, normal);
                more = more.max(missing / normal.dot(along).max(LEAST_COSINE));
            });
            if more <= 0.0 {
                return length;
            }
            length += more;
        }
        f64::INFINITY
    }
}

/// Least cosine between a straight move and the normal of a cone: it bounds the length of steps.
const LEAST_COSINE: f64 = 0.2;

/// Most steps of a move.
const MOST_MOVES: u32 = 16;

/// By how much farther half-spaces are taken to be, relative to the farthest one, so that rounding does not leave a move short.
const EXCESS: f64 = 1e-7;

/// A move that is no shorter than this share of the one before is not improved.
const NOTABLY: f64 = 0.99;

/// Cosine between normals below which cones form a crotch; consecutive cones of a tube have nearly the same normals.
const FACING: f64 = 0.5;

/// Longest move into half-spaces, relative to the one into the farthest of them: those of nearly opposite normals meet far away.
const FARTHEST: f64 = 20.0;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ball_within_another_one_is_never_the_nearest() {
        let cone =
            |x: f64| Cone::new(RoundCone { ends: [DVec3::ZERO, DVec3::X * x], radii: [1.0, 0.1] }, [0, 1]);
        let p = DVec3::new(1.1, 0.2, 0.0);
        let contained = cone(0.5);
        assert_eq!(contained.least_radius(contained.distance(p).1, 0.3), 1.0);
        // Nor one that touches it from inside, at the point next to both.
        let touching = Cone::new(RoundCone { ends: [DVec3::ZERO, DVec3::X], radii: [2.0, 1.0] }, [0, 1]);
        let t = touching.distance(DVec3::X * 3.0).1;
        assert_eq!((t, touching.least_radius(t, 0.3)), (0.0, 2.0));
        // Beside a lateral surface, the nearest balls are smaller.
        let tapered = cone(1.5);
        assert!(tapered.least_radius(tapered.distance(p).1, 0.1) < 0.5);
    }

    /// The crotch of two rods at 20 degrees is a half ellipse whose axes are their radius over the sine of 10 degrees, and their radius.
    #[test]
    fn the_way_out_of_a_crotch_is_the_shortest() {
        let half = 10.0_f64.to_radians();
        let rod = |side: f64| {
            let end = DVec3::new(libm::cos(half), side * libm::sin(half), 0.0) * 20.0;
            Cone::new(RoundCone { ends: [DVec3::ZERO, end], radii: [1.0; 2] }, [0, 1])
        };
        let cones = vec![rod(1.0), rod(-1.0)];
        let boxes: Vec<[DVec3; 2]> = cones.iter().map(|cone| cone.shape.bounds()).collect();
        let solid = Solid { cones, boxes: Boxes::new(&boxes), rounding: 1e-12 };
        let long = 1.0 / libm::sin(half);
        for (x, z) in [(5.0, 0.0), (4.0, 0.0), (4.0, 0.3), (5.5, 0.1), (2.0, 0.5), (5.7, 0.0)] {
            let from_ellipse = |k: i32| {
                let angle = 1e-3 * f64::from(k);
                (x - long * libm::cos(angle)).hypot(z - libm::sin(angle))
            };
            let least = (-1571..=1571).map(from_ellipse).fold(f64::INFINITY, f64::min);
            let p = DVec3::new(x, 0.0, z);
            let found = solid.exit(&[p], p, 1e-9);
            assert!((found - least).abs() < 0.02 * least, "{p}: {found}, not {least}");
        }
    }
}
