//! The area of the intersection of two outlines.

use crate::Outline;
use crate::outline::{cross, minus};

/// A side directed upwards, and the outline it belongs to.
#[derive(Clone, Copy)]
struct Rising {
    low: [f64; 2],
    high: [f64; 2],
    owner: usize,
}

impl Rising {
    fn x(&self, y: f64) -> f64 {
        let t = (y - self.low[1]) / (self.high[1] - self.low[1]);
        self.low[0] + t.clamp(0.0, 1.0) * (self.high[0] - self.low[0])
    }
}

/// The area of the intersection of two outlines, each by the even–odd rule.
///
/// # Definition
/// The plane is cut into slabs at all corners and crossings of sides. In a slab the sides are ordered, and the intersection
/// consists of trapezoids.
///
/// # Accuracy
/// Rounding only: a small displacement of a crossing changes the area in second order.
///
/// # Cost
/// n² for the crossings, plus the number of sides in each slab.
pub fn intersection_area(a: &Outline, b: &Outline) -> f64 {
    let mut sides: Vec<Rising> = Vec::new();
    for (owner, outline) in [a, b].into_iter().enumerate() {
        for [p, q] in outline.sides() {
            if p[1] != q[1] {
                let (low, high) = if p[1] < q[1] { (p, q) } else { (q, p) };
                sides.push(Rising { low, high, owner });
            }
        }
    }
    sides.sort_by(|s, t| s.low[1].total_cmp(&t.low[1]));
    let mut levels: Vec<f64> = sides.iter().flat_map(|s| [s.low[1], s.high[1]]).collect();
    for (i, s) in sides.iter().enumerate() {
        for t in &sides[i + 1..] {
            if t.low[1] >= s.high[1] {
                break;
            }
            levels.extend(crossing_level(s, t));
        }
    }
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut active: Vec<Rising> = Vec::new();
    let mut next = 0;
    let mut total = 0.0;
    let mut places: Vec<(f64, f64, f64, usize)> = Vec::new();
    for slab in levels.windows(2) {
        let [y0, y1] = [slab[0], slab[1]];
        active.retain(|s| s.high[1] >= y1);
        while next < sides.len() && sides[next].low[1] <= y0 {
            if sides[next].high[1] >= y1 {
                active.push(sides[next]);
            }
            next += 1;
        }
        places.clear();
        places.extend(active.iter().map(|s| {
            let (x0, x1) = (s.x(y0), s.x(y1));
            (0.5 * (x0 + x1), x0, x1, s.owner)
        }));
        places.sort_by(|s, t| s.0.total_cmp(&t.0));
        let mut inside = [false; 2];
        let mut from = 0.0;
        let mut width = 0.0;
        for &(middle, _, _, owner) in &places {
            let was = inside[0] && inside[1];
            inside[owner] = !inside[owner];
            match (was, inside[0] && inside[1]) {
                (false, true) => from = middle,
                (true, false) => width += middle - from,
                _ => (),
            }
        }
        total += width * (y1 - y0);
    }
    total
}

fn crossing_level(s: &Rising, t: &Rising) -> Option<f64> {
    if s.low[0].max(s.high[0]) < t.low[0].min(t.high[0]) || t.low[0].max(t.high[0]) < s.low[0].min(s.high[0])
    {
        return None;
    }
    let (u, v) = (minus(s.high, s.low), minus(t.high, t.low));
    let denominator = cross(u, v);
    let along = cross(minus(t.low, s.low), v) / denominator;
    let other = cross(minus(t.low, s.low), u) / denominator;
    let is_inside = |t: f64| (0.0..=1.0).contains(&t);
    (denominator != 0.0 && is_inside(along) && is_inside(other)).then(|| s.low[1] + along * u[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_squares_and_a_star() {
        let square = Outline::new(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]).unwrap();
        let moved = square.map(|[x, y]| [x + 1.0, y + 0.5]).unwrap();
        assert!((intersection_area(&square, &moved) - 1.5).abs() < 1e-14);
        assert!((intersection_area(&square, &square) - 4.0).abs() < 1e-14);
        let far = square.map(|[x, y]| [x + 3.0, y]).unwrap();
        assert_eq!(intersection_area(&square, &far), 0.0);
        // A square and its rotation by 45 degrees intersect in a regular octagon.
        let root = 2.0_f64.sqrt();
        let diamond =
            Outline::new(vec![[1.0 + root, 1.0], [1.0, 1.0 + root], [1.0 - root, 1.0], [1.0, 1.0 - root]])
                .unwrap();
        let octagon = 8.0 * (root - 1.0);
        assert!((intersection_area(&square, &diamond) - octagon).abs() < 1e-13);
    }
}
