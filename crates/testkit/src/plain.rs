//! Distances in ordinary arithmetic, by the regions of a triangle; slow, short and on its own.

type Vector = [f64; 3];

/// Distance between a point and a triangle, which may be a segment or a point.
///
/// The distance to some point of the triangle that is nearest up to rounding: of a needle perhaps one on its sides.
pub fn point_triangle(p: Vector, [a, b, c]: [Vector; 3]) -> f64 {
    let (ab, ac, ap) = (sub(b, a), sub(c, a), sub(p, a));
    let n = cross(ab, ac);
    let area_sq = dot(n, n);
    let (v, w) = (dot(cross(ap, ac), n) / area_sq, dot(cross(ab, ap), n) / area_sq);
    let sides = least([point_segment(p, a, b), point_segment(p, b, c), point_segment(p, c, a)]);
    if area_sq > 0.0 && v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
        let foot = norm([0, 1, 2].map(|k| ap[k] - v * ab[k] - w * ac[k]));
        return if foot < sides { foot } else { sides };
    }
    sides
}

/// Distance between a point and a segment.
pub fn point_segment(p: Vector, a: Vector, b: Vector) -> f64 {
    let edge = sub(b, a);
    let length_sq = dot(edge, edge);
    let t = if length_sq > 0.0 { (dot(sub(p, a), edge) / length_sq).clamp(0.0, 1.0) } else { 0.0 };
    norm([0, 1, 2].map(|k| p[k] - a[k] - t * edge[k]))
}

/// Distance between a point and the nearest of some triangles.
pub fn point_triangles(p: Vector, triangles: &[[Vector; 3]]) -> f64 {
    triangles.iter().map(|t| point_triangle(p, *t)).fold(f64::INFINITY, |m, d| if d < m { d } else { m })
}

/// Distance between two points.
pub fn point_point(p: Vector, q: Vector) -> f64 {
    norm(sub(p, q))
}

/// Area of a triangle.
pub fn area([a, b, c]: [Vector; 3]) -> f64 {
    0.5 * norm(cross(sub(b, a), sub(c, a)))
}

fn least(values: [f64; 3]) -> f64 {
    values.into_iter().fold(f64::INFINITY, |m, d| if d < m { d } else { m })
}

fn sub(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn norm(a: Vector) -> f64 {
    dot(a, a).sqrt()
}
