//! Round cones: the balls of two neighbouring samples and all balls between them.

use glam::DVec3;

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Steps of a golden-section search: they shrink the interval to 2⁻³⁰.
const STEPS: usize = 44;

/// The balls around the points of a segment, with radii linear between its ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundCone {
    /// Centres of the two ends.
    pub ends: [DVec3; 2],
    /// Their radii.
    pub radii: [f64; 2],
}

impl RoundCone {
    /// The least value of `|p − q(t)| − r(t)` over the balls: outside of the cone the distance from its surface, inside minus the
    /// depth; and the parameter `t` in `[0, 1]` that attains it.
    ///
    /// # Definition
    /// The centre of the nearest ball is at `x + k h / √(1 − k²)` along the axis, where `x` is the position of the point along the
    /// axis, `h` its distance from it, and `k` the slope of the radius.
    pub fn distance(&self, p: DVec3) -> (f64, f64) {
        MeasuredCone::new(*self).distance(p)
    }

    /// The least value of `|p(s) − q(t)| − r(s) − r(t)` over the balls of both cones: negative exactly if they overlap, and then
    /// minus the depth. Also the parameters `s` and `t`.
    ///
    /// # Accuracy
    /// The function is convex in `(s, t)`. The minimum over `t` has a closed form; over `s` a golden-section search is accurate to
    /// 2⁻³⁰ of the axis.
    pub fn gap(&self, other: &Self) -> (f64, f64, f64) {
        let at = |s: f64| {
            let (distance, t) = other.distance(self.ends[0].lerp(self.ends[1], s));
            (distance - (self.radii[0] + (self.radii[1] - self.radii[0]) * s), t)
        };
        let (mut low, mut high) = (0.0, 1.0);
        let (mut x, mut y) = (1.0 - GOLDEN, GOLDEN);
        let (mut fx, mut fy) = (at(x).0, at(y).0);
        for _ in 0..STEPS {
            if fx <= fy {
                high = y;
                (y, fy) = (x, fx);
                x = high - GOLDEN * (high - low);
                fx = at(x).0;
            } else {
                low = x;
                (x, fx) = (y, fy);
                y = low + GOLDEN * (high - low);
                fy = at(y).0;
            }
        }
        let places = [0.0, 0.5 * (low + high), 1.0];
        let all = places.map(|s| {
            let (gap, t) = at(s);
            (gap, s, t)
        });
        all.into_iter().fold(all[0], |best, next| if next.0 < best.0 { next } else { best })
    }

    /// The corners of its bounding box.
    pub(crate) fn bounds(&self) -> [DVec3; 2] {
        let [a, b] = self.ends;
        let [ra, rb] = self.radii.map(DVec3::splat);
        [(a - ra).min(b - rb), (a + ra).max(b + rb)]
    }
}

/// A cone with what distances of many points from it have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeasuredCone {
    pub(crate) shape: RoundCone,
    length: f64,
    /// The slope of the radius, and the cosine of this angle.
    slope: f64,
    cosine: f64,
}

impl MeasuredCone {
    #[inline]
    pub(crate) fn new(shape: RoundCone) -> Self {
        let length = (shape.ends[1] - shape.ends[0]).length();
        let slope = (shape.radii[1] - shape.radii[0]) / length;
        Self { shape, length, slope, cosine: (1.0 - slope * slope).sqrt() }
    }

    /// That of [`RoundCone::distance`].
    #[inline]
    pub(crate) fn distance(&self, p: DVec3) -> (f64, f64) {
        let Self { shape: RoundCone { ends: [a, b], radii: [ra, rb] }, length, slope, cosine } = *self;
        // One ball contains all others, or the axis has no length. Where they touch from inside, both are as near.
        if slope.is_nan() || slope.abs() >= 1.0 {
            return if rb > ra { (p.distance(b) - rb, 1.0) } else { (p.distance(a) - ra, 0.0) };
        }
        let axis = b - a;
        let along = (p - a).dot(axis) / length;
        let beside = ((p - a).length_squared() - along * along).max(0.0).sqrt();
        let place = (along + slope * beside / cosine).clamp(0.0, length);
        let t = place / length;
        (p.distance(a + axis * t) - (ra + (rb - ra) * t), t)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Balls compared on each cone.
    const N: usize = 200;

    #[test]
    fn distances_and_gaps_are_those_of_the_densest_balls() {
        let mut state = 7_u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..60 {
            let mut point = || DVec3::new(random(), random(), random());
            let ends = [point(), point(), point(), point()];
            let mut radius = || 0.4 * random();
            let cones = [
                RoundCone { ends: [ends[0], ends[1]], radii: [radius(), radius()] },
                RoundCone { ends: [ends[2], ends[3]], radii: [radius(), radius()] },
            ];
            let ball = |cone: &RoundCone, s: f64| {
                (cone.ends[0].lerp(cone.ends[1], s), cone.radii[0] + (cone.radii[1] - cone.radii[0]) * s)
            };
            let mut least = f64::INFINITY;
            for i in 0..=N {
                for j in 0..=N {
                    let (p, r) = ball(&cones[0], i as f64 / N as f64);
                    let (q, t) = ball(&cones[1], j as f64 / N as f64);
                    least = least.min(p.distance(q) - r - t);
                }
            }
            let (gap, s, t) = cones[0].gap(&cones[1]);
            assert!(gap <= least + 1e-12 && gap > least - 0.02, "{gap} {least}");
            let ((p, r), (q, u)) = (ball(&cones[0], s), ball(&cones[1], t));
            assert!((p.distance(q) - r - u - gap).abs() < 1e-9);
        }
    }
}
