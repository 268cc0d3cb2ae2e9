//! Resampling at equal arc lengths, and smooth curves through points.

use crate::outline::distance;
use crate::{Outline, Point};

/// `count` points at equal arc lengths along an outline, the first at the corner `start`. Empty for a count of 0.
pub fn resample(outline: &Outline, count: usize, start: usize) -> Vec<Point> {
    let mut points = outline.points().to_vec();
    let n = points.len();
    points.rotate_left(start % n);
    points.push(points[0]);
    let (lengths, total) = lengths(&points);
    at(&points, &lengths, (0..count).map(|k| total * (k as f64 / count as f64)))
}

/// `count` points at equal arc lengths along an open polyline, including its ends. The polyline itself if it has no length.
pub fn resample_points(points: &[Point], count: usize) -> Vec<Point> {
    let (lengths, total) = lengths(points);
    if total == 0.0 || count < 2 {
        return points.to_vec();
    }
    let mut found = at(points, &lengths, (0..count - 1).map(|k| total * (k as f64 / (count - 1) as f64)));
    found.extend(points.last());
    found
}

/// The arc length up to each point, and the total.
fn lengths(points: &[Point]) -> (Vec<f64>, f64) {
    let mut total = 0.0;
    let mut lengths = Vec::with_capacity(points.len());
    for (i, p) in points.iter().enumerate() {
        if i > 0 {
            total += distance(points[i - 1], *p);
        }
        lengths.push(total);
    }
    (lengths, total)
}

/// The points at increasing arc lengths.
fn at(points: &[Point], lengths: &[f64], places: impl Iterator<Item = f64>) -> Vec<Point> {
    let mut i = 0;
    places
        .map(|place| {
            while i + 2 < points.len() && lengths[i + 1] <= place {
                i += 1;
            }
            let width = lengths[i + 1] - lengths[i];
            let t = if width > 0.0 { ((place - lengths[i]) / width).clamp(0.0, 1.0) } else { 0.0 };
            [0, 1].map(|k| points[i][k] + t * (points[i + 1][k] - points[i][k]))
        })
        .collect()
}

/// The closed uniform Catmull–Rom curve through points, sampled at `steps` points per span; the first sample of each span is the
/// given point.
///
/// # Source
/// `catmull_class_1974`.
pub fn catmull_rom(through: &[Point], steps: usize) -> Vec<Point> {
    let n = through.len();
    let mut curve = Vec::with_capacity(n * steps);
    for i in 0..n {
        let [a, b, c, d] = [i + n - 1, i, i + 1, i + 2].map(|j| through[j % n]);
        for step in 0..steps {
            let t = step as f64 / steps as f64;
            curve.push([0, 1].map(|k| {
                b[k] + 0.5
                    * t
                    * ((c[k] - a[k])
                        + t * ((2.0 * a[k] - 5.0 * b[k] + 4.0 * c[k] - d[k])
                            + t * (3.0 * (b[k] - c[k]) + d[k] - a[k])))
            }));
        }
    }
    curve
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_lie_at_equal_lengths() {
        let l = Outline::new(vec![[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [1.0, 1.0], [1.0, 3.0], [0.0, 3.0]])
            .unwrap();
        let points = resample(&l, 12, 2);
        assert_eq!(
            (points[0], points[1], points[2], points[4]),
            ([3.0, 1.0], [2.0, 1.0], [1.0, 1.0], [1.0, 3.0])
        );
        let open = resample_points(&[[0.0, 0.0], [3.0, 0.0], [3.0, 1.0]], 5);
        assert_eq!(open, [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [3.0, 1.0]]);
    }

    #[test]
    fn the_curve_passes_through_its_points_and_keeps_lines() {
        let through = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0], [1.5, 4.0]];
        let curve = catmull_rom(&through, 4);
        assert_eq!(curve.len(), 20);
        assert!((0..5).all(|i| curve[4 * i] == through[i]));
        assert_eq!(&curve[4..8], &[[1.0, 0.0], [1.25, 0.0], [1.5, 0.0], [1.75, 0.0]]);
    }
}
