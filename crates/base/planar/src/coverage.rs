//! Where the side of a shape crosses between two pixels, from the shares of them that it covers.

use crate::Point;
use crate::outline::dot;
use std::f64::consts::SQRT_2;

/// Where an outline crosses between the centres of two pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// How far from the middle between both towards the pixel inside, in pixels.
    pub(crate) shift: f64,
    /// How far the outline may be from there, in pixels.
    pub(crate) room: f64,
}

/// How far an outline may be from where both pixels tell that it is, in pixels, by the rounding of levels and of what curves a little.
const AGREED: f64 = 0.02;

/// How far it may be from where levels between the pixels cross that of the outline, in pixels: at corners, and in blurred pictures.
const INTERPOLATED: f64 = 0.15;

/// How far apart the places that both pixels tell may be, in pixels; of a blurred picture they are farther apart.
const SAME: f64 = 0.2;

/// The share covered, or not covered, below which a pixel only tells that the outline is beyond it.
const LEAST: f64 = 0.01;

/// The least cosine of the angle between the normal and the line between both centres: other sides may cross anywhere along it.
const ACROSS: f64 = 0.5;

/// A picture as shares of pixels that a shape covers.
pub(crate) struct Coverage<'v> {
    /// Values row by row, greater inside.
    pub(crate) values: &'v [f32],
    /// Pixels in a row.
    pub(crate) width: usize,
    /// The values of the background, of the outline and of the shape.
    pub(crate) levels: [f64; 3],
}

impl Coverage<'_> {
    /// Where the outline crosses between a pixel inside and one beside it outside, each by row and column; none where both have the same value.
    ///
    /// # Source
    /// `gustavson_anti_2011` for the distance from a straight side, given the share of a pixel that is covered.
    pub(crate) fn crossing(&self, inside: [usize; 2], outside: [usize; 2]) -> Option<Crossing> {
        let pixels = [inside, outside];
        let [a, b] = pixels.map(|[row, column]| f64::from(self.values[row * self.width + column]));
        if a == b {
            return None;
        }
        let shift = (self.levels[1] - b) / (a - b) - 0.5;
        Some(self.agreed(pixels).unwrap_or(Crossing { shift, room: INTERPOLATED }))
    }

    /// Where a straight side crosses that covers of each pixel what is covered of it; none where they differ.
    fn agreed(&self, pixels: [[usize; 2]; 2]) -> Option<Crossing> {
        let [u, v] = pixels.map(|[row, column]| self.slope(row, column));
        let slope = [0, 1].map(|k| (u[k] + v[k]).abs());
        let length = dot(slope, slope).sqrt();
        let normal = slope.map(|x| x / length);
        let across = if pixels[0][0] == pixels[1][0] { normal[0] } else { normal[1] };
        // Not a number where there is no slope.
        if across.is_nan() || across < ACROSS {
            return None;
        }
        let shares = pixels.map(|[row, column]| self.share(row, column));
        let [from_inside, from_outside] = shares.map(|share| distance_to_side(share, normal) / across);
        let places = [0.5 + from_inside, -0.5 + from_outside];
        let weights =
            shares.map(|share| if share.min(1.0 - share) < LEAST { 0.0 } else { share * (1.0 - share) });
        let sum = weights[0] + weights[1];
        let apart = places[1] - places[0];
        let apart = if weights.contains(&0.0) { apart.max(0.0) } else { apart.abs() };
        let is_agreed = sum > 0.0 && apart <= SAME;
        is_agreed.then(|| Crossing {
            shift: (weights[0] * places[0] + weights[1] * places[1]) / sum,
            room: (AGREED + apart).min(INTERPOLATED),
        })
    }

    /// The share of a pixel that is covered: half of it where its value is that of the outline.
    fn share(&self, row: usize, column: usize) -> f64 {
        let [low, level, high] = self.levels;
        let off = f64::from(self.values[row * self.width + column]) - level;
        let range = if off > 0.0 { high - level } else { level - low };
        if range > 0.0 { (0.5 + 0.5 * off / range).clamp(0.0, 1.0) } else { 0.5 }
    }

    /// How shares increase to the right and downwards, from the eight pixels around one. Beyond the picture nothing is covered.
    fn slope(&self, row: usize, column: usize) -> Point {
        let rows = self.values.len() / self.width;
        // Counted from the pixel above on the left.
        let at = |down: usize, right: usize| {
            let (row, column) = (row + down, column + right);
            let is_inside = row > 0 && column > 0 && row <= rows && column <= self.width;
            if is_inside { self.share(row - 1, column - 1) } else { 0.0 }
        };
        let column = |right: usize| at(0, right) + SQRT_2 * at(1, right) + at(2, right);
        let row = |down: usize| at(down, 0) + SQRT_2 * at(down, 1) + at(down, 2);
        [column(2) - column(0), row(2) - row(0)]
    }
}

/// How far the centre of a pixel is outside a straight side that covers a share of the pixel, in pixels; less than 0 where it is inside. The
/// normal of the side has length 1 and no sign.
fn distance_to_side(share: f64, normal: Point) -> f64 {
    let (more, less) = (normal[0].max(normal[1]), normal[0].min(normal[1]));
    // Below this share, the side cuts off a corner of the pixel.
    let corner = 0.5 * less / more;
    if share < corner {
        0.5 * (more + less) - (2.0 * more * less * share).sqrt()
    } else if share > 1.0 - corner {
        (2.0 * more * less * (1.0 - share)).sqrt() - 0.5 * (more + less)
    } else {
        (0.5 - share) * more
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Outline;

    /// Values of 16 × 16 pixels whose lower part a half-plane covers, with a boundary through a point near the middle.
    fn half_plane(degrees: f64, shift: f64) -> (Vec<f32>, [Point; 2]) {
        let (s, c) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
        let at = |t: f64| [7.5 + t * c, 7.5 + shift + t * s];
        let (a, b) = (at(-60.0), at(60.0));
        let below = Outline::new(vec![a, b, [b[0], 200.0], [a[0], 200.0]]).unwrap();
        // 64 samples across a pixel.
        let fine = below.map(|p| p.map(|x| 64.0 * (x + 0.5) - 0.5)).unwrap();
        let mut values = vec![0.0; 256];
        for (i, share) in crate::fill([&fine], 1024, 1024).iter().enumerate() {
            values[i / 1024 / 64 * 16 + i % 1024 / 64] += share / 4096.0;
        }
        (values, [a, b])
    }

    #[test]
    fn straight_sides_cross_where_their_shares_tell() {
        for degrees in [0.0, 4.0, 17.0, 30.0, 45.0] {
            for shift in [0.05, 0.2, 0.4, 0.7] {
                let (values, [a, b]) = half_plane(degrees, shift);
                let coverage = Coverage { values: &values, width: 16, levels: [0.0, 0.5, 1.0] };
                let value = |row: usize| values[row * 16 + 7];
                let outside = (0..15).rfind(|row| value(*row) <= 0.5).unwrap();
                let found = coverage.crossing([outside + 1, 7], [outside, 7]).unwrap();
                let y = a[1] + (7.0 - a[0]) * (b[1] - a[1]) / (b[0] - a[0]);
                let expected = y - outside as f64 - 0.5;
                let place = format!("{degrees}°, {shift}: {found:?}, {expected}");
                assert!((found.shift - expected).abs() < 0.02 && found.room < 0.1, "{place}");
            }
        }
    }

    #[test]
    fn levels_are_interpolated_where_pixels_differ() {
        // A ramp over three pixels, as blurring makes it.
        let values: Vec<f32> = (0..5).flat_map(|_| [0.0, 0.1, 0.4, 0.8, 1.0]).collect();
        let coverage = Coverage { values: &values, width: 5, levels: [0.0, 0.5, 1.0] };
        let found = coverage.crossing([2, 3], [2, 2]).unwrap();
        assert!((found.shift + 0.25).abs() < 1e-6 && found.room == INTERPOLATED, "{found:?}");
        assert_eq!(coverage.crossing([2, 2], [1, 2]), None);
    }
}
