//! Points known up to a radius, triangles near them, and polygons cut along chords.
//!
//! `u = 2^-53`. Correct rounding gives `|fl(x) - x| <= u |fl(x)|` and `<= u |x|`, plus at most 2^-1075 below the normal numbers,
//! which `TINY` covers: coordinates are at most 2^200 ([`crate::Pair`]), so nothing overflows, and every constant below leaves
//! room for the products of several `u`.

/// A point or a difference of points.
pub type Point = [f64; 3];

const U: f64 = f64::EPSILON / 2.0;
/// More than all that underflow can take away, even from a square before its root is taken.
const TINY: f64 = f64::from_bits((1023 - 500) << 52);
/// More than the rounding of a few operations in a row on numbers of one sign.
const UP: f64 = 1.0 + 18.0 * U;
const DOWN: f64 = 1.0 - 18.0 * U;
/// More than the root of 3 and the rounding of a few operations.
const ROOT_3: f64 = 1.7321;
/// Corners of a polygon, at most.
pub const MOST_CORNERS: usize = 64;

/// A corner of a polygon: each coordinate of the exact point differs from `origin + offset` by at most `radius`. The origin is the
/// first corner of the face of A, and the same for all that is computed for this face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// From the origin.
    pub offset: Point,
    /// Bound on the error of each coordinate.
    pub radius: f64,
}

fn size(p: Point) -> f64 {
    p[0].abs().max(p[1].abs()).max(p[2].abs())
}

fn sub(p: Point, q: Point) -> Point {
    [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
}

/// `p - t e`.
fn less(p: Point, t: f64, e: Point) -> Point {
    [p[0] - t * e[0], p[1] - t * e[1], p[2] - t * e[2]]
}

/// `s p + t q`.
fn mix(s: f64, p: Point, t: f64, q: Point) -> Point {
    [s * p[0] + t * q[0], s * p[1] + t * q[1], s * p[2] + t * q[2]]
}

fn dot(p: Point, q: Point) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}

fn cross(p: Point, q: Point) -> Point {
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}

/// The corners of a face as a polygon. The differences carry one rounding each.
pub fn whole(face: [Point; 3]) -> [Corner; 3] {
    face.map(|p| {
        let offset = sub(p, face[0]);
        Corner { offset, radius: 2.0 * U * size(offset) + TINY }
    })
}

/// The exact point `(1 - t) p + t q`, for `t` in [0, 1] a multiple of 2^-52, so that `1 - t` is exact. Two products and a sum
/// round by at most `2 u m (1 + 3 u)`.
pub fn between(p: &Corner, q: &Corner, t: f64) -> Corner {
    let s = 1.0 - t;
    let offset = mix(s, p.offset, t, q.offset);
    let m = s * size(p.offset) + t * size(q.offset);
    Corner { offset, radius: UP * (s * p.radius + t * q.radius + 2.25 * U * m) + TINY }
}

/// The exact mean of the corners of a face with these weights; none unless they are nonnegative with a sum that is neither huge nor
/// tiny. Each quotient is off by `4 u` of itself, each coordinate by at most `8 u m`.
pub fn mean(face: [Point; 3], weights: Point) -> Option<Corner> {
    let sum = weights[0] + weights[1] + weights[2];
    if !(weights.iter().all(|w| *w >= 0.0) && (1e-250..=1e250).contains(&sum)) {
        return None;
    }
    let [(v, p), (w, q)] = [1, 2].map(|i| (weights[i] / sum, sub(face[i], face[0])));
    let m = v * size(p) + w * size(q);
    Some(Corner { offset: mix(v, p, w, q), radius: 10.0 * U * m + TINY })
}

/// One end of a chord: the point of side `side`, which leads from corner `side` to the next, at `t` in [0, 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct End {
    /// The side.
    pub side: usize,
    /// A multiple of 2^-52; at 0 the end is the corner itself.
    pub t: f64,
}

impl End {
    fn corner(self, polygon: &[Corner]) -> Corner {
        let (p, q) = (&polygon[self.side], &polygon[(self.side + 1) % polygon.len()]);
        if self.t == 0.0 { *p } else { between(p, q, self.t) }
    }
}

/// Appends the part of a polygon from one end of a chord round to the other. The two parts, for both orders of the ends, are convex
/// polygons whose union is the polygon.
pub fn part(polygon: &[Corner], from: End, to: End, into: &mut Vec<Corner>) {
    into.push(from.corner(polygon));
    let mut i = from.side;
    while i != to.side {
        i = (i + 1) % polygon.len();
        into.push(polygon[i]);
    }
    if to.t != 0.0 {
        into.push(to.corner(polygon));
    }
}

/// A face of B, seen from the origin of a face of A.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Its corners.
    pub corners: [Point; 3],
    /// From the first corner to the second, from it to the third, from the second to the third.
    edges: [Point; 3],
    lengths_sq: [f64; 3],
    /// The largest coordinate of a corner.
    size: f64,
    /// For the foot of a perpendicular: where that from the third corner meets the first edge, its direction, its squared length.
    along: f64,
    height: Point,
    height_sq: f64,
}

impl Facet {
    /// The face with these corners.
    pub fn new(face: [Point; 3], origin: Point) -> Self {
        let corners = face.map(|p| sub(p, origin));
        let [a, b, c] = corners;
        let edges = [sub(b, a), sub(c, a), sub(c, b)];
        let lengths_sq = edges.map(|e| dot(e, e));
        let along = dot(edges[1], edges[0]) / lengths_sq[0];
        let height = less(edges[1], along, edges[0]);
        let size = size(a).max(size(b)).max(size(c));
        Self { corners, edges, lengths_sq, size, along, height, height_sq: dot(height, height) }
    }

    /// From the nearest of up to four points of the face to `p`: the foot of the perpendicular, and the nearest points of the sides.
    /// Each is `c + v e + w f` with `v, w >= 0` and `v + w <= 1` exactly: a rounded sum below 1 is a sum below 1.
    pub fn to(&self, p: Point) -> Point {
        let from_a = sub(p, self.corners[0]);
        let t = dot(from_a, self.edges[0]) / self.lengths_sq[0];
        let beside = less(from_a, t, self.edges[0]);
        let w = dot(beside, self.height) / self.height_sq;
        let v = t - w * self.along;
        let foot = less(less(from_a, v, self.edges[0]), w, self.edges[1]);
        let side = |from: Point, i: usize| {
            let s = dot(from, self.edges[i]) / self.lengths_sq[i];
            let s = if s > 0.0 { if s < 1.0 { s } else { 1.0 } } else { 0.0 };
            less(from, s, self.edges[i])
        };
        let is_inside = v >= 0.0 && w >= 0.0 && v + w < 1.0;
        // Away from its sides the foot is the nearest point; beside them it may be lost in rounding where the face is thin.
        if is_inside && v > 1e-3 && w > 1e-3 && v + w < 0.999 && self.is_plump() {
            return foot;
        }
        let sides = [side(from_a, 0), side(from_a, 1), side(sub(p, self.corners[1]), 2)];
        let mut best = if is_inside { foot } else { sides[0] };
        for d in sides {
            best = if dot(d, d) < dot(best, best) { d } else { best };
        }
        best
    }

    /// Whether the height is not small beside the first edge.
    fn is_plump(&self) -> bool {
        self.height_sq > 1e-4 * self.lengths_sq[0]
    }

    /// At least the distance of the exact corner from this face.
    ///
    /// With `M` the largest coordinate, `x - y` for the point `y` of [`Facet::to`] is off by at most `11 u M`: corners from the
    /// origin `u`, their differences from x `2 u`, the edges `2 u`, times weights `2 u`, two subtractions, whose results are
    /// differences from points of the face, `2 u` each. A length is at most the root of 3 times the largest coordinate.
    pub fn at_most(&self, x: &Corner) -> f64 {
        let d = self.to(x.offset);
        UP * dot(d, d).sqrt() + ROOT_3 * (x.radius + 13.0 * U * self.size.max(size(x.offset)) + TINY)
    }

    /// At most the distance of the exact corner from every point of this face.
    ///
    /// First by the box around the face, then by planes: for g with largest coordinate 1 and each point y of the face,
    /// `|x - y| |g| >= g . (x - y) >= min_j g . (x - t_j)`. Differences are off by `radius + 3 u M`, the product by
    /// `6 u M |g|_1`, what is taken from it rounds by `2 u M |g|_1`.
    pub fn at_least(&self, x: &Corner, enough: f64) -> f64 {
        let m = self.size.max(size(x.offset));
        let error = x.radius + 4.0 * U * m + TINY;
        let from = self.corners.map(|c| sub(x.offset, c));
        let gaps = [0, 1, 2].map(|k| {
            let (least, most) =
                (from[0][k].min(from[1][k]).min(from[2][k]), from[0][k].max(from[1][k]).max(from[2][k]));
            (least.max(-most) - error).max(0.0)
        });
        let mut best = DOWN * dot(gaps, gaps).sqrt() - TINY;
        if best >= enough {
            return best;
        }
        let without = |v: Point, i: usize| {
            let once = |v: Point| {
                let t = dot(v, self.edges[i]) / self.lengths_sq[i];
                less(v, t, self.edges[i])
            };
            once(once(v))
        };
        let normal = cross(self.height, self.edges[0]);
        let directions = [
            self.to(x.offset),
            if dot(normal, from[0]) < 0.0 { normal.map(|n| -n) } else { normal },
            without(from[0], 0),
            without(from[0], 1),
            without(from[1], 2),
        ];
        for g in directions {
            let largest = size(g);
            let g = g.map(|x| x / largest);
            let sum = g[0].abs() + g[1].abs() + g[2].abs();
            let least = from.map(|d| dot(g, d)).into_iter().fold(f64::INFINITY, f64::min);
            let bound = DOWN * ((least - sum * (x.radius + 14.0 * U * m + TINY)) / dot(g, g).sqrt());
            // Not a number where there is no direction: `largest` is 0 or not finite.
            if largest > 0.0 && largest < f64::INFINITY && bound > best {
                best = bound;
            }
        }
        best
    }

    /// Across side `side` into the face, along it; as long as its normal and this side together.
    pub fn inward(&self, side: usize) -> Point {
        let edge = sub(self.corners[(side + 1) % 3], self.corners[side]);
        cross(cross(self.edges[0], self.edges[1]), edge)
    }

    /// Where the plane through side `side` that stands on this face crosses a polygon: the end at which the polygon leaves the side of
    /// the face, and that at which it comes back. None where it does not do so once. Any rounding gives a chord.
    pub fn crossing(&self, side: usize, polygon: &[Corner]) -> Option<[End; 2]> {
        let inward = self.inward(side);
        let mut heights = [0.0; MOST_CORNERS];
        for (height, corner) in heights.iter_mut().zip(polygon) {
            *height = dot(inward, sub(corner.offset, self.corners[side]));
        }
        let (n, mut ends) = (polygon.len(), [None; 2]);
        for i in 0..n {
            let (s, next) = (heights[i], heights[(i + 1) % n]);
            if (s >= 0.0) != (next >= 0.0) {
                let end = &mut ends[usize::from(next >= 0.0)];
                let t = (s / (s - next) * PLACES).floor() / PLACES;
                let past = End { side: (i + 1) % n, t: 0.0 };
                let new = if t < 1.0 { End { side: i, t: if t > 0.0 { t } else { 0.0 } } } else { past };
                if end.replace(new).is_some() {
                    return None;
                }
            }
        }
        ends[0].zip(ends[1]).filter(|(out, back)| out.side != back.side).map(|(out, back)| [out, back])
    }
}

/// 2^52: positions on a side are multiples of its inverse.
pub const PLACES: f64 = (1_u64 << 52) as f64;
