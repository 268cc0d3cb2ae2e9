//! Whether triangles and segments in space meet, decided exactly.

use robust::{Coord, Coord3D, orient2d, orient3d};
use std::cmp::Ordering;

/// Corners of a triangle.
type Triangle = [[f64; 3]; 3];

/// Where a segment meets a triangle: a point of both, rounded.
type Place = [f64; 3];

/// On which side of the plane of a triangle a point lies.
fn side(t: &Triangle, p: [f64; 3]) -> Ordering {
    let [a, b, c, p] = [t[0], t[1], t[2], p].map(|[x, y, z]| Coord3D { x, y, z });
    sign(orient3d(a, b, c, p))
}

fn sign(x: f64) -> Ordering {
    x.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// The orientation of three points in the projection along an axis.
fn turn(axis: usize, p: [f64; 3], q: [f64; 3], r: [f64; 3]) -> Ordering {
    let flat = |p: [f64; 3]| Coord { x: p[(axis + 1) % 3], y: p[(axis + 2) % 3] };
    sign(orient2d(flat(p), flat(q), flat(r)))
}

/// An axis along which the projection of a triangle has an area; `None` if the triangle has none.
fn seen_along([a, b, c]: &Triangle) -> Option<usize> {
    (0..3).find(|&axis| turn(axis, *a, *b, *c) != Ordering::Equal)
}

fn middle(p: [f64; 3], q: [f64; 3]) -> Place {
    [0, 1, 2].map(|k| 0.5 * p[k] + 0.5 * q[k])
}

/// A common point of two faces other than the vertices and edges that neighbours share, rounded; `None` if there is none.
///
/// Both are closed triangles. Corners at the same position count as shared. With one shared corner, the faces must meet elsewhere,
/// too; with two, they must overlap in a plane; with three, they are the same triangle.
///
/// # Accuracy
/// The answer is exact where no product of three differences of coordinates underflows or overflows: always for coordinates that are
/// multiples of 2^-200 below 2^200. Triangles without area meet nothing.
/// # Source
/// Signs of determinants: `shewchuk_predicates_1997`, through the crate `robust`.
pub fn common_point(s: &Triangle, t: &Triangle) -> Option<Place> {
    let axes = (seen_along(s)?, seen_along(t)?);
    let mut shared = Vec::with_capacity(3);
    for (i, p) in s.iter().enumerate() {
        shared.extend(t.iter().position(|q| p == q).map(|j| (i, j)));
    }
    match shared[..] {
        [] => disjoint_corners(s, t, axes),
        [(i, j)] => opposite_edge(s, i, t, axes.1).or_else(|| opposite_edge(t, j, s, axes.0)),
        [one, two] => folded(s, t, [one, two], axes.0),
        _ => Some([0, 1, 2].map(|k| (s[0][k] + s[1][k] + s[2][k]) / 3.0)),
    }
}

/// Whether triangles without a common corner meet.
fn disjoint_corners(s: &Triangle, t: &Triangle, axes: (usize, usize)) -> Option<Place> {
    let apart = |s: &Triangle, t: &Triangle| {
        let sides = t.map(|p| side(s, p));
        sides[0] != Ordering::Equal && sides[0] == sides[1] && sides[1] == sides[2]
    };
    if apart(s, t) || apart(t, s) {
        return None;
    }
    let edges = |t: &Triangle| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let of_s = edges(s).into_iter().find_map(|e| meet(e, t, axes.1));
    of_s.or_else(|| edges(t).into_iter().find_map(|e| meet(e, s, axes.0)))
}

/// Intersects the edge opposite a shared corner with the other triangle.
fn opposite_edge(s: &Triangle, corner: usize, t: &Triangle, axis: usize) -> Option<Place> {
    meet([s[(corner + 1) % 3], s[(corner + 2) % 3]], t, axis)
}

/// Whether triangles with a common edge overlap: both in one plane and on the same side of the edge.
fn folded(s: &Triangle, t: &Triangle, [one, two]: [(usize, usize); 2], axis: usize) -> Option<Place> {
    let (p, q) = (s[3 - one.0 - two.0], t[3 - one.1 - two.1]);
    let (a, b) = (s[one.0], s[two.0]);
    let same = side(s, q) == Ordering::Equal && turn(axis, a, b, p) == turn(axis, a, b, q);
    same.then(|| middle(a, b))
}

/// Where a closed segment meets a closed triangle whose projection along the axis has an area.
fn meet([p, q]: [[f64; 3]; 2], t: &Triangle, axis: usize) -> Option<Place> {
    match (side(t, p), side(t, q)) {
        (Ordering::Equal, Ordering::Equal) => meet_in_plane([p, q], t, axis),
        (a, b) if a == b => None,
        (Ordering::Equal, _) => is_inside(p, t, axis).then_some(p),
        (_, Ordering::Equal) => is_inside(q, t, axis).then_some(q),
        _ => {
            let turns = [0, 1, 2].map(|i| side(&[p, q, t[i]], t[(i + 1) % 3]));
            let passes = |away| turns.iter().all(|turn| *turn != away);
            (passes(Ordering::Less) || passes(Ordering::Greater)).then(|| crossing([p, q], t))
        }
    }
}

/// Whether a point in the plane of a triangle lies in it.
fn is_inside(p: [f64; 3], t: &Triangle, axis: usize) -> bool {
    let turns = [0, 1, 2].map(|i| turn(axis, t[i], t[(i + 1) % 3], p));
    !(turns.contains(&Ordering::Less) && turns.contains(&Ordering::Greater))
}

/// Where a segment in the plane of a triangle meets it.
fn meet_in_plane([p, q]: [[f64; 3]; 2], t: &Triangle, axis: usize) -> Option<Place> {
    if let Some(inside) = [p, q].into_iter().find(|x| is_inside(*x, t, axis)) {
        return Some(inside);
    }
    let crosses = |i: usize| {
        let (a, b) = (t[i], t[(i + 1) % 3]);
        let differ = |x: Ordering, y: Ordering| x != y || x == Ordering::Equal;
        // If both ends lie along one edge, either one was found inside or the segment lies beyond one end of the edge.
        let along = turn(axis, a, b, p) == Ordering::Equal && turn(axis, a, b, q) == Ordering::Equal;
        !along
            && differ(turn(axis, a, b, p), turn(axis, a, b, q))
            && differ(turn(axis, p, q, a), turn(axis, p, q, b))
    };
    (0..3).find(|&i| crosses(i)).map(|i| middle(t[i], t[(i + 1) % 3]))
}

/// Where the segment crosses the plane of the triangle.
fn crossing([p, q]: [[f64; 3]; 2], [a, b, c]: &Triangle) -> Place {
    let minus = |x: [f64; 3], y: [f64; 3]| [0, 1, 2].map(|k| x[k] - y[k]);
    let (u, v) = (minus(*b, *a), minus(*c, *a));
    let normal = [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    let height = |x: [f64; 3]| (0..3).map(|k| normal[k] * (x[k] - a[k])).sum::<f64>();
    let (h, g) = (height(p), height(q));
    let s = h / (h - g);
    let s = if s > 0.0 { if s < 1.0 { s } else { 1.0 } } else { 0.0 };
    [0, 1, 2].map(|k| p[k] + s * (q[k] - p[k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FLAT: Triangle = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];

    fn meets(t: Triangle) -> bool {
        let found = [common_point(&FLAT, &t), common_point(&t, &FLAT)].map(|p| p.is_some());
        assert_eq!(found[0], found[1], "{t:?}");
        found[0]
    }

    #[test]
    fn through_beside_and_touching() {
        assert!(meets([[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 9.0, 0.5]]));
        assert!(!meets([[3.0, 3.0, -1.0], [3.0, 3.0, 1.0], [9.0, 9.0, 0.5]]));
        assert!(meets([[2.0, 2.0, 0.0], [3.0, 3.0, 1.0], [3.0, 3.0, 2.0]]), "a corner on an edge");
        assert!(!meets([[2.0, 2.0_f64.next_up(), 0.0], [3.0, 3.0, 1.0], [3.0, 3.0, 2.0]]));
        assert!(meets([[1.0, 1.0, 0.0], [1.5, 1.0, 0.0], [1.0, 1.5, 0.0]]), "one inside the other");
        assert!(meets([[-1.0, 1.0, 0.0], [5.0, 1.0, 0.0], [-1.0, 1.5, 0.0]]), "across in the plane");
        assert!(!meets([[5.0, 0.0, 0.0], [6.0, 0.0, 0.0], [5.0, 1.0, 0.0]]), "further along an edge");
        assert!(!meets([[1.0, 1.0, 1e-300], [2.0, 1.0, 1e-300], [1.0, 2.0, 1e-300]]));
    }

    #[test]
    fn neighbours_meet_beyond_what_they_share_only() {
        assert!(!meets([[0.0; 3], [-1.0, 0.0, 0.0], [0.0, -1.0, 1.0]]), "one corner");
        assert!(meets([[0.0; 3], [1.0, 1.0, 1.0], [1.0, 1.0, -1.0]]), "through the face");
        assert!(meets([[0.0; 3], [1.0, 0.0, 0.0], [0.0, -1.0, 1.0]]), "along an edge");
        assert!(!meets([FLAT[0], FLAT[1], [0.0, -4.0, 0.0]]), "flat beside an edge");
        assert!(!meets([FLAT[0], FLAT[1], [0.0, 4.0, 1e-9]]), "nearly folded");
        assert!(meets([FLAT[0], FLAT[1], [1.0, 1.0, 0.0]]), "folded");
        assert!(meets([FLAT[2], FLAT[0], FLAT[1]]), "the same");
        assert!(!meets([[1.0, 1.0, -1.0], [1.0, 1.0, 0.0], [1.0, 1.0, 1.0]]), "no area");
    }

    fn point() -> impl Strategy<Value = [f64; 3]> {
        let x = || (-3..4_i32).prop_map(f64::from);
        [x(), x(), x()]
    }

    proptest! {
        /// Tests points with integer barycentric coordinates in one triangle against the other, exactly in integers.
        #[test]
        fn a_common_point_of_the_lattice_is_found(
            s in [point(), point(), point()], t in [point(), point(), point()],
        ) {
            prop_assume!(s.iter().all(|p| !t.contains(p)));
            prop_assume!(seen_along(&s).is_some() && seen_along(&t).is_some());
            let found = common_point(&s, &t);
            prop_assert_eq!(found.is_some(), common_point(&t, &s).is_some());
            let axis = seen_along(&t).unwrap_or(0);
            let corner_inside = s.iter().any(|p| side(&t, *p) == Ordering::Equal && is_inside(*p, &t, axis));
            prop_assert!(!corner_inside || found.is_some());
            if let Some(p) = found {
                for t in [s, t] {
                    let off = crate::geom::point_triangle::distance_sq(p, t[0], t[1], t[2]);
                    prop_assert!(off < 1e-20 || side(&s, t[0]) == Ordering::Equal, "{off}");
                }
            } else {
                // No point sampled on one triangle is at distance zero from the other.
                for (i, j) in (0..8).flat_map(|i| (0..8 - i).map(move |j| (f64::from(i) / 7.0, f64::from(j) / 7.0))) {
                    let p = [0, 1, 2].map(|k| s[0][k] + i * (s[1][k] - s[0][k]) + j * (s[2][k] - s[0][k]));
                    prop_assert!(crate::geom::point_triangle::distance_sq(p, t[0], t[1], t[2]) > 1e-12);
                }
            }
        }
    }
}
