//! The lower bound, proven: how far a point of A is from every triangle, in interval arithmetic.
//!
//! No code is shared with the search, which may be wrong about the distance of a point without harm.

use pompeiu_core::exact::Interval;
use pompeiu_core::geom::Frame;
use pompeiu_core::geom::point_triangle::closest_barycentric;

type Point = [f64; 3];
/// Intervals that hold the coordinates of a point.
pub(crate) type Box3 = [Interval; 3];

/// The middle of a box, rounded.
pub(crate) fn middle(x: &Box3) -> Point {
    x.map(|i| 0.5 * (i.lower() + i.upper()))
}

/// Encloses the image of the point with the given barycentric coordinates in a triangle.
///
/// `corners` are in the unit of the mesh; the weights are nonnegative and need not sum to one.
pub(crate) fn point_in_frame(frame: &Frame, corners: [Point; 3], weights: [f64; 3]) -> Box3 {
    let total = weights.iter().map(|&w| Interval::point(w)).fold(Interval::point(0.0), |a, b| a + b);
    let corners = corners.map(|c| frame.enclosure(c));
    [0, 1, 2].map(|k| {
        // The mean lies between the extremes; relative to the first corner, equal coordinates stay exact.
        let offset = (1..3)
            .map(|i| Interval::point(weights[i]) * (corners[i][k] - corners[0][k]))
            .fold(Interval::point(0.0), |a, b| a + b);
        if weights[1] == 0.0 && weights[2] == 0.0 {
            corners[0][k]
        } else if weights[0] == 0.0 && weights[2] == 0.0 {
            corners[1][k]
        } else if weights[0] == 0.0 && weights[1] == 0.0 {
            corners[2][k]
        } else {
            corners[0][k] + offset.divide_by_positive(total)
        }
    })
}

/// A proven lower bound on the distance between a point and each of some triangles.
///
/// For every direction `g`, each point `y` of a triangle with corners `t_j` satisfies
/// `|x - y| |g| >= g . (x - y) >= min_j g . (x - t_j)`: the distance is at least that of a separating plane. Any `g` gives
/// a valid bound, and the direction of the closest point gives the distance itself, so `g` is computed plainly and the
/// inequality is evaluated in intervals.
pub(crate) fn distance_lower_bound(x: Box3, triangles: impl Iterator<Item = [Point; 3]>) -> f64 {
    let mut least = f64::INFINITY;
    for triangle in triangles {
        let bound = triangle_lower_bound(x, triangle);
        if bound < least {
            least = bound;
        }
        if least <= 0.0 {
            return 0.0;
        }
    }
    least
}

fn triangle_lower_bound(x: Box3, triangle: [Point; 3]) -> f64 {
    let offsets = triangle.map(|t| [0, 1, 2].map(|k| x[k] - Interval::point(t[k])));
    let mut best = 0.0;
    for g in directions(middle(&x), triangle) {
        let bound = separation(g, &offsets);
        if bound > best {
            best = bound;
        }
    }
    best
}

/// `min_j g . (x - t_j) / |g|`, rounded down; zero where it is not positive.
fn separation(g: Point, offsets: &[Box3; 3]) -> f64 {
    let g = g.map(Interval::point);
    let norm = (g[0].square() + g[1].square() + g[2].square()).sqrt();
    let mut least = f64::INFINITY;
    for offset in offsets {
        let along = g[0] * offset[0] + g[1] * offset[1] + g[2] * offset[2];
        let bound = along.divide_by_positive(norm).lower();
        least = if bound < least { bound } else { least };
    }
    if least > 0.0 { least } else { 0.0 }
}

/// Directions worth trying: from the closest point, along the normal, and across each edge.
fn directions(x: Point, triangle: [Point; 3]) -> impl Iterator<Item = Point> {
    let [a, b, c] = triangle;
    let weights = closest_barycentric(x, triangle);
    let closest = [0, 1, 2].map(|k| a[k] + weights[1] * (b[k] - a[k]) + weights[2] * (c[k] - a[k]));
    let from_closest = sub(x, closest);
    // The cross product of two edges of a needle is no normal; what is left of x - a without both directions is.
    let height = across(sub(c, a), sub(b, a));
    let normal = across(across(across(sub(x, a), sub(b, a)), height), sub(b, a));
    let edges = [(a, b), (a, c), (b, c)].into_iter().map(move |(p, q)| across(sub(x, p), sub(q, p)));
    [from_closest, normal].into_iter().chain(edges)
}

/// The part of `v` orthogonal to `e`; projecting twice leaves an error relative to the result, not to `v`.
fn across(v: Point, e: Point) -> Point {
    let length_sq = dot(e, e);
    let project = |v: Point| {
        let t = dot(v, e) / length_sq;
        [0, 1, 2].map(|k| v[k] - t * e[k])
    };
    if length_sq > 0.0 { project(project(v)) } else { v }
}

fn sub(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|k| a[k] - b[k])
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::geom::point_triangle::distance_sq;
    use pompeiu_core::{FaceId, TriMesh};
    use pompeiu_testkit::effort::cases;
    use pompeiu_testkit::exact::{Lattice, point_triangle_sq};
    use pompeiu_testkit::strategies::degenerate;
    use proptest::prelude::*;

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![-1.0..1.0, (-4..5_i32).prop_map(|k| f64::from(k) * 0.25)]
    }

    fn point() -> impl Strategy<Value = Point> {
        [coordinate(), coordinate(), coordinate()]
    }

    proptest! {
        #[test]
        fn is_tight_and_never_above_the_distance_to_a_point_of_the_triangle(
            x in point(), t in [point(), point(), point()], s in 0.0..1.0_f64, r in 0.0..1.0_f64
        ) {
            let bound = distance_lower_bound(x.map(Interval::point), std::iter::once(t));
            let (v, w) = (s * (1.0 - r), s * r);
            let y = [0, 1, 2].map(|k| t[0][k] + v * (t[1][k] - t[0][k]) + w * (t[2][k] - t[0][k]));
            let to_y = dot(sub(x, y), sub(x, y)).sqrt();
            prop_assert!(bound <= to_y + 1e-15);
            let d = distance_sq(x, t[0], t[1], t[2]).sqrt();
            prop_assert!(bound <= d + 1e-15, "{bound} {d}");
            prop_assert!(bound >= d - 2e-14, "{bound} {d} {}", d - bound);
        }
    }

    /// Needles, caps, segments and points, seen from anywhere beside, above and far.
    fn awkward() -> impl Strategy<Value = (Point, [Point; 3])> {
        let weights = [0.0..1.0_f64, 0.0..1.0_f64, -0.25..1.0_f64];
        (degenerate(1), weights, point(), 0..18_i32).prop_map(|(mesh, [r, s, t], away, digits)| {
            let corners = mesh.corners(FaceId(0));
            let on = |k: usize| (r * corners[0][k] + s * corners[1][k] + t * corners[2][k]) / (r + s + t);
            let scale = 10_f64.powi(-digits);
            let x = [0, 1, 2].map(|k| on(k) + scale * away[k]);
            (if x.iter().all(|x| x.abs() <= 2.0) { x } else { away }, corners)
        })
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(cases(4000)))]

        #[test]
        fn is_tight_for_triangles_of_any_shape((x, t) in awkward()) {
            let lattice = Lattice::of(&[&TriMesh::new(t.to_vec(), vec![[0, 1, 2]]).unwrap()]);
            let exact_sq = point_triangle_sq(&lattice.point(x), &lattice.triangle(t));
            let exact = lattice.length(&exact_sq);
            let bound = distance_lower_bound(x.map(Interval::point), std::iter::once(t));
            prop_assert!(lattice.length_sq(bound) <= exact_sq, "{bound:e} {exact:e}");
            prop_assert!(bound >= exact - 1e-14, "{bound:e} {exact:e}");
        }
    }

    #[test]
    fn stays_tight_close_to_large_and_thin_triangles() {
        for height in [1.0, 1e-4, 1e-8, 1e-12, 0.0] {
            let t = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, height, 0.0]];
            for distance in [1.0, 1e-5, 1e-10, 1e-14] {
                for x in [[0.3, 0.25 * height, distance], [0.5, -distance, 0.0], [1.0 + distance, 0.0, 0.0]] {
                    let bound = distance_lower_bound(x.map(Interval::point), std::iter::once(t));
                    assert!(bound <= distance + 1e-15 && bound >= distance - 2e-15, "{height} {x:?} {bound}");
                }
            }
        }
    }
}
