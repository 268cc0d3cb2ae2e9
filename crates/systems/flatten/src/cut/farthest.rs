//! The diameter of a point set.

use pompeiu_core::geom::Aabb;

/// Up to this many points are searched pair by pair.
const LEAF: usize = 16;

/// A subset of the points: a range of their order, and its bounding box.
struct Part {
    from: usize,
    to: usize,
    aabb: Aabb,
    halves: Option<[usize; 2]>,
}

/// The indices of two points at the greatest distance; of equal distances the first pair found, `None` for fewer than two points.
///
/// # Accuracy
/// Compares rounded squared distances. Only pairs in boxes with a smaller bound are skipped.
/// # Cost
/// O(n²) at worst, on a sphere for instance close to O(n log n).
pub fn farthest_pair(points: &[[f64; 3]]) -> Option<[usize; 2]> {
    if points.len() < 2 {
        return None;
    }
    let mut order: Vec<usize> = (0..points.len()).collect();
    let mut parts = Vec::new();
    let root = divide(points, &mut order, 0, &mut parts);
    let mut best = (-1.0, [0, 1]);
    // The last pair pushed is searched first.
    let mut open = vec![(f64::INFINITY, root, root)];
    while let Some((bound, a, b)) = open.pop() {
        if bound <= best.0 {
            continue;
        }
        let (p, q) = (&parts[a], &parts[b]);
        let mut next: Vec<(f64, usize, usize)> = match (p.halves, q.halves) {
            (None, None) => {
                for &i in &order[p.from..p.to] {
                    for &j in &order[q.from..q.to] {
                        let distance = distance_sq(points[i], points[j]);
                        if i != j && distance > best.0 {
                            best = (distance, [i.min(j), i.max(j)]);
                        }
                    }
                }
                continue;
            }
            (Some([c, d]), Some(_)) if a == b => vec![(0.0, c, c), (0.0, c, d), (0.0, d, d)],
            (Some([c, d]), other) if other.is_none() || p.to - p.from >= q.to - q.from => {
                vec![(0.0, c, b), (0.0, d, b)]
            }
            (_, Some([c, d])) => vec![(0.0, a, c), (0.0, a, d)],
            (Some([c, d]), None) => vec![(0.0, c, b), (0.0, d, b)],
        };
        for pair in &mut next {
            pair.0 = bound_sq(&parts[pair.1], &parts[pair.2]);
        }
        next.sort_by(|x, y| x.0.total_cmp(&y.0));
        open.extend(next);
    }
    (best.0 >= 0.0).then_some(best.1)
}

pub(super) fn distance(p: [f64; 3], q: [f64; 3]) -> f64 {
    distance_sq(p, q).sqrt()
}

fn distance_sq(p: [f64; 3], q: [f64; 3]) -> f64 {
    let d = [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

/// An upper bound on the rounded squared distances between points of two subsets. Rounding is monotone, so the bound, computed in
/// the same way from greater differences, is not below any such distance.
fn bound_sq(p: &Part, q: &Part) -> f64 {
    let (p, q) = (&p.aabb, &q.aabb);
    let side = |k: usize| {
        let (one, other) = ((p.upper[k] - q.lower[k]).abs(), (q.upper[k] - p.lower[k]).abs());
        if one > other { one } else { other }
    };
    let d = [side(0), side(1), side(2)];
    d[0] * d[0] + d[1] * d[1] + d[2] * d[2]
}

/// Splits points across the longest side of their bounding box.
fn divide(points: &[[f64; 3]], order: &mut [usize], from: usize, parts: &mut Vec<Part>) -> usize {
    let mut aabb = Aabb::EMPTY;
    for &i in order.iter() {
        aabb.add(points[i]);
    }
    let count = order.len();
    let index = parts.len();
    parts.push(Part { from, to: from + count, aabb, halves: None });
    if count > LEAF {
        let side = |k: usize| aabb.upper[k] - aabb.lower[k];
        let axis = (0..3).fold(0, |best, k| if side(k) > side(best) { k } else { best });
        let middle = count / 2;
        order.select_nth_unstable_by(middle, |&i, &j| {
            points[i][axis].total_cmp(&points[j][axis]).then(i.cmp(&j))
        });
        let (low, high) = order.split_at_mut(middle);
        let first = divide(points, low, from, parts);
        let second = divide(points, high, from + middle, parts);
        parts[index].halves = Some([first, second]);
    }
    index
}
