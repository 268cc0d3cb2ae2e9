//! Eight triangles at a time, as seen from a point: vectors of lanes.
//!
//! Functions go over all lanes one operation at a time, without closures: so they are compiled for the instruction set of their caller.

use pompeiu_core::geom::point_triangle::{LANES, TriangleBlock};
use pompeiu_core::spatial::bvh::LEAST_SQUARE;

/// A number for each of eight triangles, and a vector.
pub(super) type Lanes = [f64; LANES];
pub(super) type Vectors = [Lanes; 3];

/// Eight triangles as seen from a point.
pub(super) struct Seen {
    /// The ways from their nearest points to it, and the squares of these.
    pub(super) way: Vectors,
    pub(super) distances_sq: Lanes,
    /// Their unit normals, on its side; shorter where digits are lost.
    pub(super) normal: Vectors,
}

/// The corners of eight triangles as seen from a point.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn from_point(point: [f64; 3], block: &TriangleBlock) -> [Vectors; 3] {
    let o = broadcast(point);
    [minus(&block[0], &o), minus(&block[1], &o), minus(&block[2], &o)]
}

/// Looks at eight triangles, of which these are the corners as seen from a point.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn seen([a, b, c]: &[Vectors; 3]) -> Seen {
    let (ab, ac, bc) = (minus(b, a), minus(c, a), minus(c, b));
    let edges = nearer(from_edge(a, &ab), from_edge(a, &ac));
    let edges = nearer(edges, from_edge(b, &bc));
    let normal = cross(&ab, &ac);
    let square = dot(&normal, &normal);
    let (height, v, w) = (dot(&normal, a), dot(&cross(&ac, a), &normal), dot(&cross(a, &ab), &normal));
    let mut foot = [0.0; LANES];
    let mut side = [0.0; LANES];
    let own_length = inverse_length(&square);
    for l in 0..LANES {
        foot[l] = -height[l] / square[l];
        side[l] = if height[l] > 0.0 { -own_length[l] } else { own_length[l] };
    }
    let foot = times(&foot, &normal);
    let mut foot_square = dot(&foot, &foot);
    for l in 0..LANES {
        // What is no number counts as outside.
        let least = if v[l] < w[l] { v[l] } else { w[l] };
        let most = v[l] + w[l];
        let beside = if least >= 0.0 { most } else { f64::INFINITY };
        foot_square[l] = if beside <= square[l] { foot_square[l] } else { f64::INFINITY };
    }
    let (way, distances_sq) = nearer((foot, foot_square), edges);
    Seen { way, distances_sq, normal: times(&side, &normal) }
}

/// How far eight triangles reach along a direction each.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn reach(g: &Vectors, [a, b, c]: [&Vectors; 3]) -> Lanes {
    let (x, y, z) = (dot(g, a), dot(g, b), dot(g, c));
    let mut reach = [0.0; LANES];
    for l in 0..LANES {
        let most = if x[l] > y[l] { x[l] } else { y[l] };
        reach[l] = if most > z[l] { most } else { z[l] };
    }
    reach
}

/// From the nearest points of edges to the centre, and the squares of these ways.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn from_edge(p: &Vectors, edge: &Vectors) -> (Vectors, Lanes) {
    let (along, square) = (dot(p, edge), dot(edge, edge));
    let mut r = [[0.0; LANES]; 3];
    let mut t = [0.0; LANES];
    for l in 0..LANES {
        let x = -along[l] / square[l];
        let x = if x > 0.0 { x } else { 0.0 };
        t[l] = if x < 1.0 { x } else { 1.0 };
    }
    for k in 0..3 {
        for l in 0..LANES {
            r[k][l] = -(p[k][l] + t[l] * edge[k][l]);
        }
    }
    (r, dot(&r, &r))
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
fn nearer(x: (Vectors, Lanes), y: (Vectors, Lanes)) -> (Vectors, Lanes) {
    let (mut r, mut square) = y;
    for l in 0..LANES {
        for k in 0..3 {
            r[k][l] = if x.1[l] < y.1[l] { x.0[k][l] } else { y.0[k][l] };
        }
        square[l] = if x.1[l] < y.1[l] { x.1[l] } else { y.1[l] };
    }
    (r, square)
}

/// The longer vectors.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn longer(x: &Vectors, y: &Vectors) -> Vectors {
    let (xx, yy) = (dot(x, x), dot(y, y));
    let mut out = [[0.0; LANES]; 3];
    for k in 0..3 {
        for l in 0..LANES {
            out[k][l] = if yy[l] > xx[l] { y[k][l] } else { x[k][l] };
        }
    }
    out
}

/// One by a length, given its square; less where digits of the square are lost.
#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn inverse_length(square: &Lanes) -> Lanes {
    let mut inverse = [0.0; LANES];
    for l in 0..LANES {
        let square = if square[l] > LEAST_SQUARE { square[l] } else { LEAST_SQUARE };
        inverse[l] = 1.0 / square.sqrt();
    }
    inverse
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn broadcast(a: [f64; 3]) -> Vectors {
    [[a[0]; LANES], [a[1]; LANES], [a[2]; LANES]]
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn times(s: &Lanes, a: &Vectors) -> Vectors {
    let mut out = [[0.0; LANES]; 3];
    for k in 0..3 {
        for l in 0..LANES {
            out[k][l] = s[l] * a[k][l];
        }
    }
    out
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn minus(a: &Vectors, b: &Vectors) -> Vectors {
    let mut out = [[0.0; LANES]; 3];
    for k in 0..3 {
        for l in 0..LANES {
            out[k][l] = a[k][l] - b[k][l];
        }
    }
    out
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn dot(a: &Vectors, b: &Vectors) -> Lanes {
    let mut out = [0.0; LANES];
    for l in 0..LANES {
        out[l] = a[0][l] * b[0][l] + a[1][l] * b[1][l] + a[2][l] * b[2][l];
    }
    out
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "compiled once per instruction set of its caller")]
pub(super) fn cross(a: &Vectors, b: &Vectors) -> Vectors {
    let mut out = [[0.0; LANES]; 3];
    for l in 0..LANES {
        out[0][l] = a[1][l] * b[2][l] - a[2][l] * b[1][l];
        out[1][l] = a[2][l] * b[0][l] - a[0][l] * b[2][l];
        out[2][l] = a[0][l] * b[1][l] - a[1][l] * b[0][l];
    }
    out
}
