//! Where triangles go beyond a length from a surface.
//!
//! Over one face the distance is that from its plane, a linear function, so what is within a length ends at a line: a triangle over one
//! face is divided there at once, and one over two faces where both planes are as far. Where more are near, triangles are halved until few of their parts are
//! over more than two.

use super::pieces::Fate;
use crate::deviation::linear::greater;
use crate::rounding::Rounding;
use glam::DVec3;
use pompeiu_core::geom::Aabb;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::spatial::{Bvh, Slot, Workspace};
use std::ops::ControlFlow;

/// The points at a length from a surface, in a frame.
pub(super) struct Level<'l> {
    bvh: &'l Bvh,
    length: f64,
    /// What rounding may make of the distance of a point.
    rounding: f64,
}

impl<'l> Level<'l> {
    pub(super) fn new(bvh: &'l Bvh, length: f64, rounding: Rounding) -> Self {
        Self { bvh, length, rounding: rounding.least_tolerance() }
    }

    /// What becomes of a triangle that is not within the length, given the distances and nearest faces of its corners.
    pub(super) fn fate(
        &self,
        corners: [[f64; 3]; 3],
        near: [(f64, Slot); 3],
        workspace: &mut Workspace,
    ) -> Fate {
        let points = corners.map(DVec3::from_array);
        let centre = (points[0] + points[1] + points[2]) / 3.0;
        let radius = points.iter().map(|p| p.distance(centre)).fold(0.0, greater);
        let nearest = self.bvh.nearest(centre.to_array(), near[0].1, workspace);
        if nearest.distance_sq.sqrt() - radius > self.length + self.rounding {
            return Fate::LeftOut;
        }
        let distances = near.map(|(distance, _)| distance);
        let is_beyond = distances.iter().all(|distance| distance + self.rounding >= self.length);
        if is_beyond && self.is_beyond(points) {
            return Fate::LeftOut;
        }
        let slots = [nearest.slot, near[0].1, near[1].1, near[2].1];
        let planes = slots.map(|slot| self.heights(points, slot));
        let is_over = |heights: &[f64; 3], k: usize| (heights[k].abs() - distances[k]).abs() <= self.rounding;
        let mut known = planes.iter().flatten();
        if let Some(heights) = known.clone().find(|heights| (0..3).all(|k| is_over(heights, k))) {
            return self.end(*heights).map_or(Fate::Open(false), Fate::Divided);
        }
        let Some(first) = known.next() else { return Fate::Open(false) };
        let mut pairs = known.filter(|other| (0..3).all(|k| is_over(first, k) || is_over(other, k)));
        let between = pairs.find_map(|other| self.between(*first, *other));
        between.map_or(Fate::Open(false), Fate::Divided)
    }

    /// The heights of the corners of a triangle over the plane of a face; none if that has no plane.
    fn heights(&self, points: [DVec3; 3], slot: Slot) -> Option<[f64; 3]> {
        let [a, b, c] = self.bvh.corners(slot).map(DVec3::from_array);
        let normal = (b - a).cross(c - a).try_normalize()?;
        Some(points.map(|p| normal.dot(p - a)))
    }

    /// How much nearer than the length each corner of a triangle is to a plane, on the side of its farthest corner, if that changes sign.
    fn end(&self, heights: [f64; 3]) -> Option<[f64; 3]> {
        let farthest =
            heights.into_iter().fold(0.0_f64, |most, h| if h.abs() > most.abs() { h } else { most });
        self.line(heights.map(|h| self.length - h * farthest.signum()))
    }

    /// How much farther from one plane than from the other each corner of a triangle is, if that changes sign and the corners are on one side of each.
    fn between(&self, one: [f64; 3], other: [f64; 3]) -> Option<[f64; 3]> {
        let side = |heights: [f64; 3]| heights.iter().sum::<f64>().signum();
        let (s, t) = (side(one), side(other));
        self.line([0, 1, 2].map(|k| s * one[k] - t * other[k]))
    }

    /// The values of a linear function, if it changes sign. A corner where it is zero but for rounding does not make a part of its own.
    fn line(&self, values: [f64; 3]) -> Option<[f64; 3]> {
        let values = values.map(|value| if value.abs() <= self.rounding { 0.0 } else { value });
        (values.iter().any(|value| *value > 0.0) && values.iter().any(|value| *value < 0.0)).then_some(values)
    }

    /// Whether planes separate a triangle by the length but for rounding from all faces. A length that rounding may make zero separates nothing.
    fn is_beyond(&self, points: [DVec3; 3]) -> bool {
        let least = self.length - self.rounding;
        if least <= 0.0 {
            return false;
        }
        let Aabb { lower, upper } = Aabb::of_points(&points.map(|p| p.to_array()));
        let is_near = |aabb: &Aabb| {
            let gap = |k: usize| greater(greater(lower[k] - aabb.upper[k], aabb.lower[k] - upper[k]), 0.0);
            (0..3).map(|k| gap(k) * gap(k)).sum::<f64>() < self.length * self.length
        };
        let visit = |slot| {
            let face = self.bvh.corners(slot).map(DVec3::from_array);
            if are_separated(points, face, least) {
                ControlFlow::Continue(())
            } else {
                ControlFlow::Break(())
            }
        };
        self.bvh.walk(&mut Vec::new(), is_near, visit).is_continue()
    }
}

/// Whether two triangles are found to be a length apart but for rounding: by planes whose normal is that of the second, or leads from its nearest point to
/// the centroid or a corner of the first.
fn are_separated(points: [DVec3; 3], face: [DVec3; 3], least: f64) -> bool {
    let [a, b, c] = face;
    let centre = (points[0] + points[1] + points[2]) / 3.0;
    let separates = |direction: DVec3| {
        let Some(unit) = direction.try_normalize() else { return false };
        let lower = |p: f64, q: DVec3| f64::min(p, unit.dot(q - centre));
        let upper = |p: f64, q: DVec3| f64::max(p, unit.dot(q - centre));
        points.into_iter().fold(f64::INFINITY, lower) - face.into_iter().fold(f64::NEG_INFINITY, upper)
            >= least
    };
    let normal = (b - a).cross(c - a);
    let closest = |p: DVec3| {
        let weights = closest_barycentric(p.to_array(), face.map(|q| q.to_array()));
        p - (a + (b - a) * weights[1] + (c - a) * weights[2])
    };
    separates(if normal.dot(centre - a) < 0.0 { -normal } else { normal })
        || [centre, points[0], points[1], points[2]].into_iter().any(|p| separates(closest(p)))
}
