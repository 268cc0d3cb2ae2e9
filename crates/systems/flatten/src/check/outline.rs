//! Intersections of outlines.

use super::orientation;
use pompeiu_surface::SurfaceMesh;
use pompeiu_surface::plane::Vec2;

/// The segments of the boundary loops, by the vertices at their ends.
pub(crate) fn outline(mesh: &SurfaceMesh) -> Vec<[u32; 2]> {
    let loops = mesh.boundary_loops().iter().flat_map(|&h| mesh.boundary_loop(h));
    loops.map(|h| [mesh.tail(h).0, mesh.head(h).0]).collect()
}

/// The pairs of segments with a common point other than a common end vertex, as indices into the list.
///
/// An outline without such a pair is a simple closed curve. If all faces of a disk have the same orientation and its outline is
/// simple, it is mapped one-to-one: the number of faces over a point of the plane is the winding number of the outline around it,
/// which is 0 or 1.
///
/// # Cost
/// O(n log n), plus the pairs of segments whose projections on an axis overlap.
pub(crate) fn outline_crossings(segments: &[[u32; 2]], uv: &[Vec2]) -> Vec<[usize; 2]> {
    let ends = |s: usize| segments[s].map(|v| uv[v as usize]);
    let range = |s: usize, k: usize| {
        let [a, b] = ends(s);
        if a[k] < b[k] { (a[k], b[k]) } else { (b[k], a[k]) }
    };
    let mut order: Vec<usize> = (0..segments.len()).collect();
    order.sort_by(|&s, &t| range(s, 0).0.total_cmp(&range(t, 0).0));
    let mut open: Vec<usize> = Vec::new();
    let mut found = Vec::new();
    for s in order {
        let (left, _) = range(s, 0);
        let (low, high) = range(s, 1);
        open.retain(|&t| range(t, 0).1 >= left);
        for &t in &open {
            let (lower, upper) = range(t, 1);
            if lower <= high && low <= upper && meet(segments[s], segments[t], uv) {
                found.push([s.min(t), s.max(t)]);
            }
        }
        open.push(s);
    }
    found.sort_unstable();
    found
}

/// Whether two segments have a common point other than a common end vertex.
fn meet(s: [u32; 2], t: [u32; 2], uv: &[Vec2]) -> bool {
    let place = |v: u32| uv[v as usize];
    let shared: Vec<u32> = s.into_iter().filter(|v| t.contains(v)).collect();
    match shared[..] {
        [] => cross_or_touch(s.map(place), t.map(place)),
        [v] => {
            let other = |e: [u32; 2]| place(if e[0] == v { e[1] } else { e[0] });
            let (p, q) = (other(s), other(t));
            // With a common end, they share more if they are collinear and on the same side of it.
            orientation(place(v), p, q) == 0.0
                && (lies_between(place(v), q, p) || lies_between(place(v), p, q))
        }
        _ => true,
    }
}

fn cross_or_touch([a, b]: [Vec2; 2], [c, d]: [Vec2; 2]) -> bool {
    let sides = [orientation(a, b, c), orientation(a, b, d), orientation(c, d, a), orientation(c, d, b)];
    let apart = |x: f64, y: f64| (x > 0.0 && y < 0.0) || (x < 0.0 && y > 0.0);
    if apart(sides[0], sides[1]) && apart(sides[2], sides[3]) {
        return true;
    }
    (sides[0] == 0.0 && lies_between(a, b, c))
        || (sides[1] == 0.0 && lies_between(a, b, d))
        || (sides[2] == 0.0 && lies_between(c, d, a))
        || (sides[3] == 0.0 && lies_between(c, d, b))
}

/// Whether a point on the line through `a` and `b` lies between them.
fn lies_between(a: Vec2, b: Vec2, p: Vec2) -> bool {
    (0..2).all(|k| (a[k] <= p[k] && p[k] <= b[k]) || (b[k] <= p[k] && p[k] <= a[k]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[Vec2]) -> Vec<[usize; 2]> {
        let n = points.len() as u32;
        let segments: Vec<[u32; 2]> = (0..n).map(|i| [i, (i + 1) % n]).collect();
        outline_crossings(&segments, points)
    }

    #[test]
    fn simple_outlines_have_none() {
        assert!(polygon(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).is_empty());
        // A straight corner is no crossing.
        assert!(polygon(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]]).is_empty());
    }

    #[test]
    fn crossing_touching_and_folding_back_are_found() {
        assert_eq!(polygon(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]), [[0, 2]]);
        // A vertex on a side: both sides at the vertex touch it.
        assert_eq!(polygon(&[[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]]), [[0, 2], [0, 3]]);
        // A spike without width.
        assert_eq!(polygon(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [1.0, 1.0]]), [[0, 1], [0, 2]]);
        // Two vertices at the same position.
        let pinched = [[0.0, 0.0], [1.0, 1.0], [2.0, 0.0], [2.0, 2.0], [1.0, 1.0], [0.0, 2.0]];
        assert_eq!(polygon(&pinched).len(), 4);
    }

    #[test]
    fn the_last_bit_counts() {
        let above = f64::from_bits(0.5_f64.to_bits() + 1);
        let with = |x: f64| polygon(&[[0.0, 0.0], [1.0, 1.0], [1.0, -1.0], [x, 0.5], [0.0, -1.0]]);
        assert!(!with(0.5).is_empty());
        assert!(with(above).is_empty());
    }
}
