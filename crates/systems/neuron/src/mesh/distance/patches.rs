//! Parts of the wall, and the bounds on their distance from the surface of the cones.

use super::pieces::depth;
use super::search::{Bounds, Patch};
use super::solid::Solid;
use glam::DVec3;

/// Width of an enclosure of the depth of a point, in radii.
const DEPTH_WIDTH: f64 = 0.005;

/// A Bézier patch with `S` control points along each direction.
#[derive(Clone, Copy)]
pub(in crate::mesh) struct Net<const S: usize> {
    pub(in crate::mesh) points: [[DVec3; S]; S],
}

impl<const S: usize> Net<S> {
    /// Both halves along the second index, by de Casteljau's algorithm.
    fn halves(&self) -> [Self; 2] {
        let (mut first, mut second) = (*self, *self);
        for (k, row) in self.points.iter().enumerate() {
            let mut row = *row;
            for round in 0..S {
                first.points[k][round] = row[0];
                second.points[k][S - 1 - round] = row[S - 1 - round];
                for i in 0..S - 1 - round {
                    row[i] = row[i].midpoint(row[i + 1]);
                }
            }
        }
        [first, second]
    }

    fn transposed(&self) -> Self {
        Self { points: std::array::from_fn(|i| std::array::from_fn(|j| self.points[j][i])) }
    }

    /// A point of the patch at parameters that are multiples of `1 / n`.
    pub(super) fn at(&self, u: f64, v: f64) -> DVec3 {
        let line = |mut row: [DVec3; S], t: f64| {
            for round in 1..S {
                for i in 0..S - round {
                    row[i] = row[i].lerp(row[i + 1], t);
                }
            }
            row[0]
        };
        line(self.points.map(|row| line(row, v)), u)
    }

    /// A bound on `|S_uu| + 2 |S_uv| + |S_vv|`, from differences of control points. An eighth of it times the squared step bounds the
    /// distance of triangles on a grid from the patch.
    pub(super) fn bend(&self) -> f64 {
        let degree = (S - 1) as f64;
        let second = |net: &Self| {
            let rows = net.points.iter();
            rows.flat_map(|row| row.windows(3))
                .map(|p| (p[0] - p[1] * 2.0 + p[2]).length())
                .fold(0.0, f64::max)
        };
        let mixed = self
            .points
            .windows(2)
            .flat_map(|rows| (0..S - 1).map(|k| rows[0][k] - rows[1][k] - rows[0][k + 1] + rows[1][k + 1]))
            .map(DVec3::length)
            .fold(0.0, f64::max);
        degree * (degree - 1.0) * (second(self) + second(&self.transposed())) + 2.0 * degree * degree * mixed
    }
}

impl<const S: usize> Patch for Net<S> {
    fn divided(&self) -> [Self; 4] {
        let [a, b] = self.halves().map(|half| half.transposed().halves());
        [a[0], a[1], b[0], b[1]]
    }
}

/// Bounds on the distance of the points of a patch from the surface of the union of the cones.
///
/// # Definition
/// Outside of the union the distance from a cone is convex, so that the greatest one over a patch is attained at control points. Points
/// inside leave the union if they are moved far enough: the length of the move bounds their distance from its surface. A ball that fits
/// into a cone bounds it from below. Distances are divided by the radius of the nearest ball.
pub(super) fn bounds<const S: usize>(solid: &Solid, net: &Net<S>) -> Bounds {
    let hull = net.points.as_flattened();
    let last = S - 1;
    let corners = [net.points[0][0], net.points[0][last], net.points[last][0], net.points[last][last]];
    let centre = corners.iter().sum::<DVec3>() / 4.0;
    let reach = hull.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
    let middle = solid.nearest(centre);
    let mut upper = solid.cones[middle.cone].within(hull).min(middle.upper + reach);
    let mut lower = [0.0_f64; 2];
    let mut sample = None;
    for corner in corners {
        let nearest = solid.nearest(corner);
        let cone = &solid.cones[nearest.cone];
        if nearest.cone != middle.cone {
            upper = upper.min(cone.within(hull));
        }
        let distance = nearest.lower.max(-nearest.upper) - solid.rounding;
        let next = cone.samples[usize::from(nearest.t > 0.5)];
        let in_radii = distance / cone.radius(nearest.t);
        if sample.is_none() || in_radii > lower[1] {
            (lower[1], sample) = (in_radii.max(0.0), Some(next));
        }
        lower[0] = lower[0].max(distance);
    }
    let inside = solid.exit(hull, centre, reach);
    let upper = upper.max(inside).max(0.0) + solid.rounding;
    let radius = solid.least_radius(centre, middle.upper, reach);
    let sample = sample.unwrap_or_default();
    Bounds { upper: [upper, upper / radius], lower, sample, is_settled: false }
}

/// What a point of a patch inside the union says of its distance from the surface, better than a ball in one cone does: between branches at
/// a small angle the surface is much farther away than that. `None` if the point is outside.
pub(super) fn witness<const S: usize>(solid: &Solid, net: &Net<S>) -> Option<Bounds> {
    let point = net.at(0.5, 0.5);
    let nearest = solid.nearest(point);
    if nearest.upper >= 0.0 {
        return None;
    }
    let cone = &solid.cones[nearest.cone];
    let radius = cone.radius(nearest.t);
    let most = solid.exit(&[point], point, solid.rounding);
    let distance = depth(solid, point, most, DEPTH_WIDTH * radius);
    let lower = [distance, distance / radius];
    let sample = cone.samples[usize::from(nearest.t > 0.5)];
    Some(Bounds { upper: [f64::INFINITY; 2], lower, sample, is_settled: false })
}
