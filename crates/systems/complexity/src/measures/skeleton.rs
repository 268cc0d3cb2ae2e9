//! The medial axis.

use super::coverage::circumcentre;
use super::sampling::{Samples, distance};
use pompeiu_planar::{Outline, Point};
use spade::{DelaunayTriangulation, Point2, Triangulation};

/// The medial axis: the centres of the circles inside the shape that touch the outline twice or more.
///
/// # Definition
/// The edges of the Voronoi diagram of 500 points at equal arc lengths that lie inside, if the two points that generate an edge are
/// at least 5 % of the outline's length apart along it. Lengths are relative to the square root of the area.
///
/// # Accuracy
/// The circumcentres of thin triangles lose digits: nine digits remain under motions and scaling.
///
/// # Limits
/// For outlines that cross themselves, the inside is defined by the even–odd rule.
///
/// # Source
/// `ogniewicz_hierarchic_1995` prunes by the length along the outline in the same way.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Skeleton {
    /// Length of the axis.
    pub length: f64,
    /// Number of its ends.
    pub ends: usize,
    /// Number of points where three or more branches meet.
    pub junctions: usize,
    /// Mean radius of the circles along the axis.
    pub radius: f64,
    /// Standard deviation of the radius over its mean: 0 for shapes of constant width.
    pub variation: f64,
}

/// The smallest length along the outline between the two points that generate an edge, as a share of its length.
const APART: f64 = 0.05;

/// Ends of edges closer than this, relative to the square root of the area, are merged.
const ONE_PLACE: f64 = 1e-6;

/// An edge of the axis: its ends, and the radius of its circles.
struct Edge {
    ends: [Point; 2],
    radius: f64,
}

impl Skeleton {
    pub(super) fn of(outline: &Outline, samples: &Samples) -> Self {
        let unit = outline.area().sqrt();
        // Tested against the polygon of the samples, whose corners are those of the triangles.
        let edges =
            Outline::new(samples.points.clone()).map_or_else(|_| Vec::new(), |polygon| axis(&polygon));
        let length: f64 = edges.iter().map(|edge| distance(edge.ends[0], edge.ends[1])).sum();
        let (ends, junctions) = degrees(&edges, ONE_PLACE * unit);
        // Weighted by length; if the axis is a point, all circles have equal weight.
        let weight =
            |edge: &Edge| if length > ONE_PLACE * unit { distance(edge.ends[0], edge.ends[1]) } else { 1.0 };
        let total: f64 = edges.iter().map(weight).sum();
        let mean = |of: &dyn Fn(&Edge) -> f64| {
            if total > 0.0 {
                edges.iter().map(|edge| weight(edge) * of(edge)).sum::<f64>() / total
            } else {
                0.0
            }
        };
        let radius = mean(&|edge| edge.radius);
        let deviation = mean(&|edge| (edge.radius - radius).powi(2)).sqrt();
        let variation = if radius > 0.0 { deviation / radius } else { 0.0 };
        Self { length: length / unit, ends, junctions, radius: radius / unit, variation }
    }
}

/// The edges of the axis.
fn axis(outline: &Outline) -> Vec<Edge> {
    let points = outline.points();
    let n = points.len();
    let mut triangulation: DelaunayTriangulation<Point2<f64>> = DelaunayTriangulation::new();
    // Coincident points are one vertex; the first of them is its representative.
    let mut names = Vec::with_capacity(n);
    for (i, [x, y]) in points.iter().enumerate() {
        if let Ok(vertex) = triangulation.insert(Point2::new(*x, *y))
            && vertex.index() == names.len()
        {
            names.push(i);
        }
    }
    let centre = |corners: [Point; 3]| {
        let middle = [0, 1].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0);
        if outline.contains(middle) { circumcentre(corners[0], corners[1], corners[2]) } else { None }
    };
    let centres: Vec<Option<Point>> = triangulation
        .all_faces()
        .map(|face| {
            let face = face.as_inner()?;
            centre(face.positions().map(|p| [p.x, p.y]))
        })
        .collect();
    let mut edges = Vec::new();
    for edge in triangulation.undirected_edges() {
        let [a, b] = edge.vertices().map(|vertex| names[vertex.fix().index()]);
        let along = a.abs_diff(b);
        if (along.min(n - along) as f64) < APART * n as f64 {
            continue;
        }
        let side = edge.as_directed();
        let faces = [side.face(), side.rev().face()].map(|face| centres[face.fix().index()]);
        if let [Some(p), Some(q)] = faces {
            let middle = [0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1])];
            edges.push(Edge { ends: [p, q], radius: distance(middle, points[a]) });
        }
    }
    edges
}

/// The number of ends and of junctions, after merging ends that are close together.
fn degrees(edges: &[Edge], near: f64) -> (usize, usize) {
    let mut places: Vec<(Point, usize)> =
        edges.iter().enumerate().flat_map(|(i, edge)| edge.ends.map(|p| (p, i))).collect();
    places.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]).then(a.0[1].total_cmp(&b.0[1])).then(a.1.cmp(&b.1)));
    let mut parent: Vec<usize> = (0..places.len()).collect();
    for i in 0..places.len() {
        for j in i + 1..places.len() {
            if places[j].0[0] - places[i].0[0] > near {
                break;
            }
            if distance(places[i].0, places[j].0) <= near {
                let (a, b) = (root(&mut parent, i), root(&mut parent, j));
                parent[a.max(b)] = a.min(b);
            }
        }
    }
    let mut of_edge = vec![Vec::new(); edges.len()];
    for (i, (_, edge)) in places.iter().enumerate() {
        of_edge[*edge].push(root(&mut parent, i));
    }
    let mut degree = vec![0_usize; places.len()];
    for ends in of_edge.iter().filter(|ends| ends[0] != ends[1]) {
        for end in ends {
            degree[*end] += 1;
        }
    }
    let count = |is: &dyn Fn(usize) -> bool| degree.iter().filter(|d| is(**d)).count();
    (count(&|d| d == 1), count(&|d| d > 2))
}

fn root(parent: &mut [usize], mut i: usize) -> usize {
    while parent[i] != i {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    i
}
