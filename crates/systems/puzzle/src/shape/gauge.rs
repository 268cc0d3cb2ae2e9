//! The shape-matching metric of a site and a point: the factor by which the shape around the site must grow to reach the point.

use pompeiu_planar::{Outline, Point};

/// The value of the metric if the ray from the site to a point meets the outline several times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Answer {
    /// The least factor, of the outermost intersection: the metric of the star hull.
    Least,
    /// The greatest factor, of the innermost intersection: the metric of the part of the shape visible from the site.
    Greatest,
    /// The signed distance to the shape instead of a factor, negative inside. It is continuous everywhere.
    #[default]
    #[cfg_attr(feature = "clap", value(name = "distance"))]
    #[cfg_attr(feature = "serde", serde(rename = "distance"))]
    SignedDistance,
}

/// The part of the outline that must meet the point.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Variant {
    /// The corner that comes nearest to the point.
    Points,
    /// A side.
    #[default]
    Edges,
}

/// The factor if no side is met: the shape never reaches the point.
const NEVER: f64 = 1e3;

/// The factor by which an outline around the origin must be scaled to reach a point.
///
/// # Definition
/// Edges: for each side from a to b that the ray through q meets, q = αa + βb with α, β ≥ 0, and the factor is α + β. If the
/// outline is star-shaped about the origin, there is one such side, and the factor is Minkowski's gauge; otherwise `is_least`
/// selects a side. Points: the factor max(0, q·v / v·v) of the corner v for which the scaled corner comes nearest to q; of several
/// equally near ones, `is_least` selects one.
///
/// If the ray meets no side: 1000 times the distance from the origin, relative to the outline's size.
///
/// # Source
/// The definitions with points and with edges are those of the posts of 2021 on interlocking parts; the selection is ours.
pub fn gauge(outline: &Outline, q: Point, variant: Variant, is_least: bool) -> f64 {
    let better = |new: f64, old: f64| if is_least { new < old } else { new > old };
    let norm = libm::hypot(q[0], q[1]);
    if norm == 0.0 {
        return 0.0;
    }
    match variant {
        Variant::Points => {
            let mut best = (f64::INFINITY, 0.0);
            for v in outline.points() {
                let along = (q[0] * v[0] + q[1] * v[1]) / (v[0] * v[0] + v[1] * v[1]);
                let factor = if along > 0.0 { along } else { 0.0 };
                let miss = libm::hypot(q[0] - factor * v[0], q[1] - factor * v[1]);
                if miss < best.0 || (miss == best.0 && better(factor, best.1)) {
                    best = (miss, factor);
                }
            }
            best.1
        }
        Variant::Edges => {
            let mut best = None;
            for [a, b] in outline.sides() {
                let whole = cross(a, b);
                let (alpha, beta) = (cross(q, b) / whole, cross(a, q) / whole);
                if alpha >= 0.0 && beta >= 0.0 {
                    let factor = alpha + beta;
                    if best.is_none_or(|old| better(factor, old)) {
                        best = Some(factor);
                    }
                }
            }
            let [low, high] = outline.bounds();
            let size = libm::hypot(high[0] - low[0], high[1] - low[1]);
            best.filter(|factor| factor.is_finite()).unwrap_or(NEVER * norm / size)
        }
    }
}

/// The number of intersections of the outline with the ray from the origin through a point.
pub fn meetings(outline: &Outline, q: Point) -> usize {
    outline
        .sides()
        .filter(|[a, b]| {
            // Half-open, so that a corner counts once.
            let (from, to) = (cross(q, *a), cross(q, *b));
            (from >= 0.0) != (to >= 0.0) && {
                let whole = cross(*a, *b);
                (cross(q, *b) - cross(q, *a)) / whole > 0.0
            }
        })
        .count()
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PieceName;
    use pompeiu_core::mesh::edit::Random;

    fn centred(points: Vec<Point>) -> Outline {
        let outline = Outline::new(points).unwrap();
        let [x, y] = outline.centroid();
        outline.map(|p| [p[0] - x, p[1] - y]).unwrap()
    }

    #[test]
    fn the_gauge_of_a_square_is_the_maximum_norm_and_that_of_a_disc_the_euclidean_one() {
        let square = centred(PieceName::Square.points());
        let turn = |i: u32| libm::sincos(std::f64::consts::TAU * f64::from(i) / 720.0);
        let disc = centred((0..720).map(|i| [turn(i).1, turn(i).0]).collect());
        let mut random = Random::new(3);
        for _ in 0..500 {
            let q = [random.signed_unit(), random.signed_unit()];
            for is_least in [true, false] {
                let found = gauge(&square, q, Variant::Edges, is_least);
                assert!((found - 2.0 * q[0].abs().max(q[1].abs())).abs() <= 1e-15, "{q:?} {found}");
                let scaled = gauge(&square, q.map(|x| 8.0 * x), Variant::Edges, is_least);
                assert_eq!(scaled, 8.0 * found);
                let round = gauge(&disc, q, Variant::Edges, is_least);
                assert!((round / libm::hypot(q[0], q[1]) - 1.0).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn points_come_nearer_to_edges_the_more_there_are() {
        let error = |per_side: usize| {
            let corners = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
            let points = (0..4 * per_side).map(|i| {
                let (a, b) = (corners[i / per_side], corners[(i / per_side + 1) % 4]);
                let t = (i % per_side) as f64 / per_side as f64;
                [0, 1].map(|k| a[k] + t * (b[k] - a[k]))
            });
            let square = Outline::new(points.collect()).unwrap();
            let mut most: f64 = 0.0;
            for i in 0..40_000 {
                let q = [i % 200, i / 200].map(|k| (f64::from(k) + 0.5) / 200.0 - 0.5);
                let truth = 2.0 * q[0].abs().max(q[1].abs());
                most = most.max((gauge(&square, q, Variant::Points, true) - truth).abs());
            }
            most
        };
        // Published for this map: .495, .135, .030, .0077 for 4, 16, 64, 256 points.
        for (per_side, published) in [(1, 0.495), (4, 0.135), (16, 0.030), (64, 0.0077)] {
            let found = error(per_side);
            assert!((found / published - 1.0).abs() < 0.03, "{per_side}: {found}");
        }
    }

    #[test]
    fn rays_meet_a_tabbed_piece_three_times_and_the_answers_differ_there_only() {
        let piece = centred(PieceName::Classic.points());
        let mut thrice = 0;
        for i in 0..10_000 {
            let q = [i % 100, i / 100].map(|k| (f64::from(k) + 0.5) / 100.0 - 0.5);
            let [least, greatest] = [true, false].map(|is_least| gauge(&piece, q, Variant::Edges, is_least));
            if meetings(&piece, q) > 1 {
                thrice += 1;
                assert!(least < greatest);
            } else {
                assert!((least - greatest).abs() < 1e-12);
            }
        }
        assert!((1_000..4_000).contains(&thrice), "{thrice} of 10,000");
    }
}
