//! Closed curves from segments in any order.

use crate::Point;
use crate::outline::distance;

/// Ends of segments, sorted by their abscissas.
struct Ends {
    sorted: Vec<(f64, usize)>,
}

impl Ends {
    fn new(ends: impl Iterator<Item = Point>) -> Self {
        let mut sorted: Vec<(f64, usize)> = ends.enumerate().map(|(i, p)| (p[0], i)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        Self { sorted }
    }

    /// The segments whose end has an abscissa within a distance of that of a point.
    fn beside(&self, p: Point, near: f64) -> impl Iterator<Item = usize> + '_ {
        // A hair more, which rounding may need.
        let reach = near + 4.0 * f64::EPSILON * (near + p[0].abs());
        let first = self.sorted.partition_point(|(x, _)| *x < p[0] - reach);
        self.sorted[first..].iter().take_while(move |(x, _)| *x <= p[0] + reach).map(|(_, i)| *i)
    }
}

/// Removes segments that do not continue into a closed curve: rounding leaves some where the curve meets itself in a thin triangle.
fn closed(segments: &[[Point; 2]], near: f64) -> Vec<[Point; 2]> {
    let mut kept = segments.to_vec();
    loop {
        let ends = [0, 1].map(|end| Ends::new(kept.iter().map(|segment| segment[end])));
        let follows =
            |at: Point, end: usize| ends[end].beside(at, near).any(|i| distance(kept[i][end], at) <= near);
        let next: Vec<[Point; 2]> =
            kept.iter().copied().filter(|[a, b]| follows(*b, 0) && follows(*a, 1)).collect();
        if next.len() == kept.len() {
            return kept;
        }
        kept = next;
    }
}

/// Joins segments into closed curves where one ends within a distance of the start of another: the nearest, and of several the first.
pub(crate) fn joined(segments: &[[Point; 2]], near: f64) -> Vec<Vec<Point>> {
    let segments = closed(segments, near);
    let starts = Ends::new(segments.iter().map(|segment| segment[0]));
    let mut is_left = vec![true; segments.len()];
    let mut found = Vec::new();
    for first in 0..segments.len() {
        if !std::mem::replace(&mut is_left[first], false) {
            continue;
        }
        let [start, mut end] = segments[first];
        let mut points = vec![start];
        loop {
            let away = |i: usize| distance(segments[i][0], end);
            let next = starts.beside(end, near).filter(|i| is_left[*i]);
            let next = next.min_by(|i, j| away(*i).total_cmp(&away(*j)).then(i.cmp(j)));
            let next = next.filter(|i| away(*i) <= near && away(*i) <= distance(start, end));
            let Some(next) = next else { break };
            is_left[next] = false;
            let [from, to] = segments[next];
            if points.last().is_some_and(|p| distance(*p, from) > near) {
                points.push(from);
            }
            end = to;
        }
        if distance(start, end) <= near {
            found.push(points);
        }
    }
    found
}
