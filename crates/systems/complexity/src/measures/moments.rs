//! Moments of the area.

use pompeiu_planar::Outline;

/// Moments of the area about its centroid.
///
/// # Definition
/// Normalised moments `η_pq = μ_pq / A^((p+q)/2+1)`, integrated exactly over the polygon, and Hu's invariants of them. Parts around
/// which the outline winds twice count twice.
///
/// # Source
/// `hu_visual_1962`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Moments {
    /// Hu's seven invariants; the last one changes its sign under reflection.
    pub hu: Vec<f64>,
    /// Ratio of the greater to the lesser standard deviation of the area along its principal axes: 1 for a circle and a square.
    pub elongation: f64,
    /// The area of the ellipse with the same second moments over the area: 1 for ellipses, greater for shapes that spread out.
    pub spread: f64,
}

impl Moments {
    pub(super) fn of(outline: &Outline) -> Self {
        let area = outline.area();
        let centre = outline.centroid();
        let unit = area.sqrt();
        // m[p][q] of the polygon scaled to area 1.
        let mut m = [[0.0; 4]; 4];
        for [a, b] in outline.sides() {
            let [[ax, ay], [bx, by]] = [a, b].map(|p| [0, 1].map(|k| (p[k] - centre[k]) / unit));
            let w = ax * by - ay * bx;
            m[2][0] += w / 12.0 * (ax * ax + ax * bx + bx * bx);
            m[0][2] += w / 12.0 * (ay * ay + ay * by + by * by);
            m[1][1] += w / 24.0 * (2.0 * ax * ay + ax * by + bx * ay + 2.0 * bx * by);
            m[3][0] += w / 20.0 * (ax * ax * ax + ax * ax * bx + ax * bx * bx + bx * bx * bx);
            m[0][3] += w / 20.0 * (ay * ay * ay + ay * ay * by + ay * by * by + by * by * by);
            m[2][1] += w / 60.0
                * (ax * ax * (3.0 * ay + by) + 2.0 * ax * bx * (ay + by) + bx * bx * (ay + 3.0 * by));
            m[1][2] += w / 60.0
                * (ay * ay * (3.0 * ax + bx) + 2.0 * ay * by * (ax + bx) + by * by * (ax + 3.0 * bx));
        }
        let (n20, n02, n11) = (m[2][0], m[0][2], m[1][1]);
        let (n30, n03, n21, n12) = (m[3][0], m[0][3], m[2][1], m[1][2]);
        let (a, b) = (n30 + n12, n21 + n03);
        let (c, d) = (n30 - 3.0 * n12, 3.0 * n21 - n03);
        let hu = vec![
            n20 + n02,
            (n20 - n02).powi(2) + 4.0 * n11 * n11,
            c * c + d * d,
            a * a + b * b,
            c * a * (a * a - 3.0 * b * b) + d * b * (3.0 * a * a - b * b),
            (n20 - n02) * (a * a - b * b) + 4.0 * n11 * a * b,
            d * a * (a * a - 3.0 * b * b) - c * b * (3.0 * a * a - b * b),
        ];
        let half = 0.5 * hu[1].max(0.0).sqrt();
        let (most, least) = (0.5 * hu[0] + half, 0.5 * hu[0] - half);
        // An outline that crosses itself may have moments that no area has.
        let elongation = if least > 0.0 { (most / least).sqrt() } else { f64::MAX };
        let spread = 4.0 * std::f64::consts::PI * (most * least).max(0.0).sqrt();
        Self { hu, elongation, spread }
    }
}
