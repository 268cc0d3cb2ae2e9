//! How far points are from one plane, to a small part of the last place of their coordinates.
//!
//! # Source
//! Sums and products without error: `shewchuk_predicates_1997`.

/// The height of a point over the plane through zero with given slopes, as a sum of two.
fn height([a, b]: [f64; 2], [x, y, z]: [f64; 3]) -> [f64; 2] {
    let difference = |p: f64, q: f64| {
        let d = p - q;
        let r = p - d;
        [d, (p - (d + r)) + (r - q)]
    };
    let (p, q) = (a * x, b * y);
    let [d, e] = difference(z, p);
    let [f, g] = difference(d, q);
    [f, e + g - a.mul_add(x, -p) - b.mul_add(y, -q)]
}

/// How much higher points are than the first, which is little, so that the differences are known to a small part of the last place of coordinates.
fn heights(points: &[[f64; 3]], slopes: [f64; 2]) -> Vec<f64> {
    let [high, low] = height(slopes, points[0]);
    let above_first = |point: &[f64; 3]| {
        let height = height(slopes, *point);
        (height[0] - high) + (height[1] - low)
    };
    points.iter().map(above_first).collect()
}

/// The width of the layer around a plane of given slopes that holds all points; infinite where that is not known.
pub(super) fn width(points: &[[f64; 3]], slopes: [f64; 2]) -> f64 {
    let heights = heights(points, slopes);
    if heights.iter().any(|x| x.is_nan()) {
        return f64::INFINITY;
    }
    let ends = |(least, greatest), x: &f64| (f64::min(least, *x), f64::max(greatest, *x));
    let (least, greatest) = heights.iter().fold((0.0, 0.0), ends);
    greatest - least
}

/// Slopes over which the heights of points have the least squares. Those of a sum of normals are off by several units of the last place.
pub(super) fn fitted(points: &[[f64; 3]], slopes: [f64; 2]) -> [f64; 2] {
    let heights = heights(points, slopes);
    let mean = |of: &dyn Fn(usize) -> f64| (0..points.len()).map(of).sum::<f64>() / points.len() as f64;
    let [x, y, h] = [mean(&|i| points[i][0]), mean(&|i| points[i][1]), mean(&|i| heights[i])];
    let around = |i: usize| [points[i][0] - x, points[i][1] - y, heights[i] - h];
    let moment = |j: usize, k: usize| mean(&|i| around(i)[j] * around(i)[k]);
    let (xx, xy, yy, xh, yh) = (moment(0, 0), moment(0, 1), moment(1, 1), moment(0, 2), moment(1, 2));
    let determinant = xx * yy - xy * xy;
    let better =
        [slopes[0] + (xh * yy - yh * xy) / determinant, slopes[1] + (yh * xx - xh * xy) / determinant];
    if better.iter().all(|slope| slope.is_finite()) { better } else { slopes }
}
