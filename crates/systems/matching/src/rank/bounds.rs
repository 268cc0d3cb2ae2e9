//! Proven bounds on the distance of two meshes, from their summaries alone.

use super::options::Measure;
use super::summary::{Summary, lines};
use pompeiu_core::exact::Interval;
use pompeiu_core::geom::Aabb;

/// A proven lower bound from the support functions of the two meshes in fixed directions.
///
/// # Definition
/// For a unit vector u let `s_A(u)` be the greatest `u·a` over A. The point of A that attains it is at least `s_A(u) − s_B(u)` away
/// from all of B, so that `h(A, B) ≥ s_A(u) − s_B(u)` and `H(A, B) ≥ |s_A(u) − s_B(u)|`, for any compact sets. The best of 98
/// directions is returned, rounded down.
/// # Limits
/// It depends on convex hulls only: two meshes with the same hull get zero.
pub fn support_lower_bound(template: &Summary, target: &Summary, measure: Measure) -> f64 {
    let rounding = Interval::point(template.rounding()) + Interval::point(target.rounding());
    let mut best = 0.0;
    for (line, (one, other)) in lines().iter().zip(template.reaches().iter().zip(target.reaches())) {
        let norm = Interval::point(f64::from(line.iter().map(|x| x * x).sum::<i32>())).sqrt();
        // The excess of the template over the target, in both directions of the line.
        let beyond =
            [[one[1], other[1]], [other[0], one[0]]].map(|[x, y]| Interval::point(x) - Interval::point(y));
        for reach in beyond {
            let bounds = [
                (measure.has_template_to_target(), reach - rounding),
                (measure.has_target_to_template(), -reach - rounding),
            ];
            for (_, bound) in bounds.into_iter().filter(|(counts, _)| *counts) {
                let bound = bound.divide_by_positive(norm).lower();
                best = if bound > best { bound } else { best };
            }
        }
    }
    best
}

/// A proven upper bound from the two bounding boxes.
///
/// # Definition
/// Every side of the bounding box of B contains a point of B. So the distance of a point of A from B is at most its greatest
/// distance from any point of one such side, which is bounded over the corners of the bounding box of A.
pub fn box_upper_bound(template: &Aabb, target: &Aabb, measure: Measure) -> f64 {
    let mut bound = 0.0;
    for (counts, from, to) in [
        (measure.has_template_to_target(), template, target),
        (measure.has_target_to_template(), target, template),
    ] {
        let directed = if counts { directed_box_upper_bound(from, to) } else { 0.0 };
        bound = if directed > bound { directed } else { bound };
    }
    bound
}

fn directed_box_upper_bound(from: &Aabb, to: &Aabb) -> f64 {
    let mut least = f64::INFINITY;
    for axis in 0..3 {
        for side in [to.lower[axis], to.upper[axis]] {
            let extents = [0, 1, 2].map(|k| {
                let (lower, upper) = if k == axis { (side, side) } else { (to.lower[k], to.upper[k]) };
                let one = (Interval::point(from.upper[k]) - Interval::point(lower)).upper();
                let other = (Interval::point(upper) - Interval::point(from.lower[k])).upper();
                if one > other { one } else { other }
            });
            let bound = norm_upper(extents);
            least = if bound < least { bound } else { least };
        }
    }
    least
}

/// The length of a vector of nonnegative entries, rounded up; squares neither overflow nor underflow.
fn norm_upper(extents: [f64; 3]) -> f64 {
    let longest = extents.into_iter().fold(0.0, |m: f64, x| if x > m { x } else { m });
    if longest <= 0.0 {
        return 0.0;
    }
    let longest = Interval::point(longest);
    let squares = extents.map(|x| Interval::point(x).divide_by_positive(longest).square());
    ((squares[0] + squares[1] + squares[2]).sqrt() * longest).upper()
}
