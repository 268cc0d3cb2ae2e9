//! Drawing marks: lines, discs and arrow heads.

use super::camera::{Camera, is_drawn};
use crate::Rgb;
use crate::panel::{Mark, MarkShape};
use crate::theme::Colors;

/// Width in pixels of the outline, in the background colour, that separates a mark from the mesh.
const RIM: f64 = 1.25;

/// Opacity of the outline behind the mesh, relative to that of the mark.
const RIM_BEHIND: f64 = 0.6;

/// Extent of the outline beyond the sharp corners of an arrow head, in widths of the outline.
const RIM_TIP: f64 = 2.0;

/// Length and half width of an arrow head, in line widths.
const HEAD: [f64; 2] = [4.5, 2.0];

/// Displacement of marks towards the eye, in half extents of the geometry, so that they are not hidden by the surface they lie on.
const LIFT: f64 = 0.004;

/// A part of a mark, in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stroke {
    shape: Shape,
    /// Nearness at both ends.
    near: [f64; 2],
    color: Rgb,
    behind: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Shape {
    /// All points within a radius of a segment.
    Capsule { ends: [[f64; 2]; 2], radius: f64 },
    /// A triangle whose first corner is the tip.
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
    let color = mark.color.unwrap_or(colors.mark);
    if matches!(mark.shape, MarkShape::Arrow(_)) {
        return arrow([from, to], near, mark.width, [color, colors.background], behind);
    }
    let capsule = |radius, color, behind| Stroke {
        shape: Shape::Capsule { ends: [from, to], radius },
        near,
        color,
        behind,
    };
    vec![capsule(radius + RIM, colors.background, RIM_BEHIND * behind), capsule(radius, color, behind)]
}

/// The strokes of an arrow between two positions in the picture, with a colour and an outline colour.
pub(super) fn arrow(
    [from, to]: [[f64; 2]; 2],
    near: [f64; 2],
    width: f64,
    [color, rim]: [Rgb; 2],
    behind: f64,
) -> Vec<Stroke> {
    let along = [to[0] - from[0], to[1] - from[1]];
    let length = (along[0] * along[0] + along[1] * along[1]).sqrt();
    if length <= 0.0 {
        return Vec::new();
    }
    let [x, y] = along.map(|c| c / length);
    // A short arrow is only a head.
    let full = HEAD[0] * width;
    let head = if full < length { full } else { length };
    let half = HEAD[1] * width * head / full;
    let neck = [to[0] - head * x, to[1] - head * y];
    let head = |rim: f64| {
        let (tip, back, side) = (RIM_TIP * rim, rim, half + RIM_TIP * rim);
        let at = |ahead: f64, aside: f64| [neck[0] + ahead * x - aside * y, neck[1] + ahead * y + aside * x];
        Shape::Head([[to[0] + tip * x, to[1] + tip * y], at(-back, side), at(-back, -side)])
    };
    let line = |rim: f64| Shape::Capsule { ends: [from, neck], radius: 0.5 * width + rim };
    let stroke = |shape, color, behind| Stroke { shape, near, color, behind };
    let rims = [line(RIM), head(RIM)].map(|shape| stroke(shape, rim, RIM_BEHIND * behind));
    rims.into_iter().chain([line(0.0), head(0.0)].map(|shape| stroke(shape, color, behind))).collect()
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

    /// Colour and opacity at a position, given the nearness of the mesh; `None` outside the stroke.
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
