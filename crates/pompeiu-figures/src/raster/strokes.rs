//! Marks in the picture: lines, discs and heads of arrows, drawn over faces.

use super::camera::{Camera, is_drawn};
use crate::Rgb;
use crate::panel::{Mark, MarkShape};
use crate::theme::Colors;

/// How far around a mark a rim in the colour of the background keeps it apart from the mesh, in pixels.
const RIM: f64 = 1.25;

/// Length and half width of an arrow's head, in widths of its line.
const HEAD: [f64; 2] = [4.5, 2.0];

/// How far marks are pulled to the eye, in half extents of all there is, so that they do not sink into the surface
/// they lie on.
const LIFT: f64 = 0.004;

/// A part of a mark, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    shape: Shape,
    /// Nearness at the two ends.
    near: [f64; 2],
    color: Rgb,
    behind: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    /// All that is within a radius of a segment.
    Capsule { ends: [[f64; 2]; 2], radius: f64 },
    /// A triangle whose first corner is the far end.
    Head([[f64; 2]; 3]),
}

/// The strokes of a mark, in the order in which they are drawn.
pub(super) fn strokes(mark: &Mark, camera: &Camera, colors: &Colors) -> Vec<Stroke> {
    let ends = match mark.shape {
        MarkShape::Point(at) => [at, at],
        MarkShape::Segment(ends) | MarkShape::Arrow(ends) => ends,
    };
    if !(ends.into_iter().all(is_drawn) && mark.width > 0.0 && mark.width.is_finite()) {
        return Vec::new();
    }
    let seen = ends.map(|end| camera.see(end));
    let radius = 0.5 * mark.width;
    let lift = camera.nearness(LIFT + radius / camera.scale);
    let near = seen.map(|end| end.near + lift);
    let [from, to] = seen.map(|end| end.at);
    let behind = if mark.behind.is_nan() { 0.0 } else { mark.behind.clamp(0.0, 1.0) };
    let stroke = |shape, color, behind| Stroke { shape, near, color, behind };
    let color = mark.color.unwrap_or(colors.mark);
    let capsule = |ends, radius| Shape::Capsule { ends, radius };
    if !matches!(mark.shape, MarkShape::Arrow(_)) {
        let rim = stroke(capsule([from, to], radius + RIM), colors.background, 0.0);
        return vec![rim, stroke(capsule([from, to], radius), color, behind)];
    }
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
    if length <= 0.0 {
        return vec![stroke(capsule([from, to], radius), color, behind)];
    }
    let [x, y] = along.map(|c| c / length);
    // A short arrow is all head.
    let head = if HEAD[0] * mark.width < length { HEAD[0] * mark.width } else { length };
    let half = HEAD[1] * mark.width * head / (HEAD[0] * mark.width);
    let neck = [to[0] - head * x, to[1] - head * y];
    let corners = [to, [neck[0] - half * y, neck[1] + half * x], [neck[0] + half * y, neck[1] - half * x]];
    vec![stroke(capsule([from, neck], radius), color, behind), stroke(Shape::Head(corners), color, behind)]
}

impl Stroke {
    /// Smallest and largest coordinates.
    pub(super) fn bounds(&self) -> [[f64; 2]; 2] {
        let (points, radius): (&[[f64; 2]], f64) = match &self.shape {
            Shape::Capsule { ends, radius } => (ends, *radius),
            Shape::Head(corners) => (corners, 0.0),
        };
        let mut bounds = [points[0]; 2];
        for point in points {
            for axis in 0..2 {
                if point[axis] < bounds[0][axis] {
                    bounds[0][axis] = point[axis];
                }
                if point[axis] > bounds[1][axis] {
                    bounds[1][axis] = point[axis];
                }
            }
        }
        [bounds[0].map(|c| c - radius), bounds[1].map(|c| c + radius)]
    }

    /// Colour and opacity at a place where the mesh is as near as given; none beyond the stroke.
    pub(super) fn at(&self, place: [f64; 2], surface: f64) -> Option<(Rgb, f64)> {
        let part = match self.shape {
            Shape::Capsule { ends: [from, to], radius } => {
                let along = [to[0] - from[0], to[1] - from[1]];
                let offset = [place[0] - from[0], place[1] - from[1]];
                let length_sq = along[0] * along[0] + along[1] * along[1];
                let foot = (along[0] * offset[0] + along[1] * offset[1]) / length_sq;
                let part = if length_sq > 0.0 { foot.clamp(0.0, 1.0) } else { 0.0 };
                let [x, y] = [offset[0] - part * along[0], offset[1] - part * along[1]];
                (x * x + y * y <= radius * radius).then_some(part)
            }
            Shape::Head([p, q, r]) => {
                let side = |from: [f64; 2], to: [f64; 2]| {
                    (to[0] - from[0]) * (place[1] - from[1]) - (to[1] - from[1]) * (place[0] - from[0])
                };
                let sides = [side(p, q), side(q, r), side(r, p)];
                let inside = sides.iter().all(|&s| s >= 0.0) || sides.iter().all(|&s| s <= 0.0);
                inside.then_some(1.0)
            }
        }?;
        let near = self.near[0] + part * (self.near[1] - self.near[0]);
        Some((self.color, if near >= surface { 1.0 } else { self.behind }))
    }
}
