//! A piece as faces of B are compared with it.

use super::super::candidates::Scale;
use super::super::polygon::{MOST_CORNERS, Polygon, Row};
use glam::DVec3;
use pompeiu_core::geom::point_triangle::near_weights;

/// A piece as faces of B are compared with it.
pub(super) struct View {
    pub(super) at: [f64; 2],
    pub(super) centre: DVec3,
    /// The corners, coordinate by coordinate.
    pub(super) corners: [Row; 3],
    pub(super) radius: f64,
    pub(super) margin: f64,
}

impl View {
    pub(super) fn new(scale: &Scale, polygon: &Polygon) -> Self {
        let at = polygon.outline.centre();
        let centre = scale.point(at);
        let margin = scale.margin + scale.displacement(&polygon.outline);
        let mut view = Self { at, centre, corners: scale.points(&polygon.outline), radius: 0.0, margin };
        let square = view.arms().iter().fold(0.0, |r, a| if *a > r { *a } else { r });
        view.radius = square.sqrt();
        view
    }

    /// Squared lengths of the ways from the centre to the corners.
    pub(super) fn arms(&self) -> Row {
        let mut arms = [0.0; MOST_CORNERS];
        for k in 0..3 {
            for j in 0..MOST_CORNERS {
                let way = self.corners[k][j] - self.centre[k];
                arms[j] += way * way;
            }
        }
        arms
    }

    /// Values of `g . (x - centre)` at the corners.
    pub(super) fn along(&self, g: DVec3) -> Row {
        let mut row = [0.0; MOST_CORNERS];
        for k in 0..3 {
            for j in 0..MOST_CORNERS {
                row[j] += g[k] * (self.corners[k][j] - self.centre[k]);
            }
        }
        row
    }

    /// The direction to the centre from the nearest point of a face, or any if there is none.
    pub(super) fn direction_from(&self, [a, b, c]: [DVec3; 3]) -> DVec3 {
        let [v, w] = near_weights(self.centre.to_array(), [a, b, c].map(|p| p.to_array()));
        let away = self.centre - (a + v * (b - a) + w * (c - a));
        let normal = || {
            let n = unit((b - a).cross(c - a)).unwrap_or(DVec3::ZERO);
            if n.dot(self.centre - a) < 0.0 { -n } else { n }
        };
        unit(away).unwrap_or_else(normal)
    }

    /// Whether a face lies outside of a box, or outside of a slab around the plane of the piece.
    pub(super) fn is_beside(
        &self,
        corners: &[[f64; 3]; 3],
        normal: DVec3,
        lower: &[f64; 3],
        upper: &[f64; 3],
        beside: f64,
    ) -> bool {
        let [a, b, c] = corners;
        if (0..3).any(|k| {
            a[k] > upper[k] && b[k] > upper[k] && c[k] > upper[k]
                || a[k] < lower[k] && b[k] < lower[k] && c[k] < lower[k]
        }) {
            return true;
        }
        let h = corners.map(|p| normal.dot(DVec3::from_array(p) - self.centre));
        h.iter().all(|h| *h > beside) || h.iter().all(|h| *h < -beside)
    }
}

/// The direction of a vector of which enough is left to have one.
pub(in super::super) fn unit(v: DVec3) -> Option<DVec3> {
    let length = v.length();
    (length > f64::MIN_POSITIVE.sqrt()).then(|| v / length)
}
