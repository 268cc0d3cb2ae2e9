//! The Jacobian determinant of a trilinear cell: certificates over the whole cell, and quality.

use crate::parameter_box::{ParameterBox, greatest, least};
use glam::DVec3;

/// What is known about the Jacobian determinant of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Jacobian {
    /// Proven positive over the whole cell.
    Positive,
    /// Proven to be zero or negative at a point of the cell.
    Folded,
    /// Neither is proven, because of the limit on subdivisions or of rounding.
    Undecided,
}

/// Corners by their position along the three axes of the cell: `CORNER[u][v][w]`.
const CORNER: [[[usize; 2]; 2]; 2] = [[[0, 4], [3, 7]], [[1, 5], [2, 6]]];

/// Largest number of times that a cell is divided into eight to find a proof.
const DEPTH: usize = 6;

/// Rounding of a Bernstein coefficient, relative to the product of the greatest edge lengths along the three axes.
///
/// # Accuracy
/// With u = 2⁻⁵³: each edge is a difference of two vertices, relatively exact to u in each component. A determinant of three edges
/// has six terms of at most `|a| |b| |c|` with four operations each: its error is at most 48 u `|a| |b| |c|`, that of the edges
/// included. A coefficient is a mean of at most eight such determinants, which adds at most 8 u. Each of at most 24 halvings, three times
/// the depth of [`scaled_jacobian_bound`](crate::scaled_jacobian_bound), takes two means in sequence, 4 u each: 96 u. The sum is 152 u.
const ROUNDING: f64 = 256.0 * 1.110_223_024_625_156_5e-16;

/// Three layers of nine coefficients.
type Coefficients = [[[f64; 3]; 3]; 3];

/// Whether the Jacobian determinant of the trilinear map with these corners is positive over the whole cell.
///
/// # Definition
/// The determinant is a polynomial of degree two along each axis. It lies between the least and the greatest of its 27 Bernstein
/// coefficients; at the corners of the cell it equals the coefficient there. A cell with coefficients of both signs is divided into
/// eight.
/// # Accuracy
/// [`Jacobian::Positive`] and [`Jacobian::Folded`] hold for the corners as stored, rounding included.
/// # Source
/// `johnen_hexahedra_2017` for coefficients that bound the determinant of a hexahedron.
pub fn certify(corners: &[DVec3; 8]) -> Jacobian {
    let (coefficients, scale) = coefficients(corners);
    decide(&coefficients, ROUNDING * scale, DEPTH)
}

fn decide(coefficients: &Coefficients, doubt: f64, depth: usize) -> Jacobian {
    let all = || coefficients.iter().flatten().flatten();
    if all().all(|&c| c > doubt) {
        return Jacobian::Positive;
    }
    let corners =
        [0, 2].into_iter().flat_map(|i| [0, 2].map(|j| [coefficients[i][j][0], coefficients[i][j][2]]));
    // Also reached where a number is not finite.
    if corners.flatten().any(|value| value < -doubt) {
        return Jacobian::Folded;
    }
    if depth == 0 || !all().all(|c| c.is_finite()) {
        return Jacobian::Undecided;
    }
    let mut result = Jacobian::Positive;
    for part in &eighths(coefficients) {
        match decide(part, doubt, depth - 1) {
            Jacobian::Folded => return Jacobian::Folded,
            Jacobian::Undecided => result = Jacobian::Undecided,
            Jacobian::Positive => (),
        }
    }
    result
}

/// The coefficients over both halves of the cell along an axis, by de Casteljau's algorithm.
fn halves(from: &Coefficients, axis: usize) -> [Coefficients; 2] {
    let [mut first, mut second] = [*from; 2];
    for p in 0..3 {
        for q in 0..3 {
            let at = |k: usize| match axis {
                0 => [k, p, q],
                1 => [p, k, q],
                _ => [p, q, k],
            };
            let get = |k: usize| {
                let [i, j, l] = at(k);
                from[i][j][l]
            };
            let (a, b, c) = (get(0), get(1), get(2));
            let (ab, bc) = (0.5 * (a + b), 0.5 * (b + c));
            let middle = 0.5 * (ab + bc);
            for (k, (before, after)) in [(a, middle), (ab, bc), (middle, c)].into_iter().enumerate() {
                let [i, j, l] = at(k);
                first[i][j][l] = before;
                second[i][j][l] = after;
            }
        }
    }
    [first, second]
}

/// The coefficients over the eight parts of the cell between halves along each axis, the first axis fastest.
fn eighths(from: &Coefficients) -> [Coefficients; 8] {
    let mut parts = [*from; 8];
    for axis in 0..3 {
        let count = 1 << axis;
        for part in 0..count {
            [parts[part], parts[part + count]] = halves(&parts[part], axis);
        }
    }
    parts
}

/// Edges along each axis, by their position along the other two.
fn edges(corners: &[DVec3; 8]) -> [[[DVec3; 2]; 2]; 3] {
    let p = |u: usize, v: usize, w: usize| corners[CORNER[u][v][w]];
    let both = |f: &dyn Fn(usize, usize) -> DVec3| [[f(0, 0), f(0, 1)], [f(1, 0), f(1, 1)]];
    [
        both(&|v, w| p(1, v, w) - p(0, v, w)),
        both(&|u, w| p(u, 1, w) - p(u, 0, w)),
        both(&|u, v| p(u, v, 1) - p(u, v, 0)),
    ]
}

/// The Bernstein coefficients, and the product of the greatest edge lengths.
fn coefficients(corners: &[DVec3; 8]) -> (Coefficients, f64) {
    let edges = edges(corners);
    let [along_u, along_v, along_w] = &edges;
    let sum = means(along_v, along_w, |v, w| v.cross(*w), along_u, |u, area| u.dot(*area));
    (sum, edges.iter().map(|edges| greatest(edges.as_flattened())).product())
}

/// The Bernstein coefficients of a product of three functions that are linear along two axes each, given by their coefficients: the first one's
/// along the first and third axis, the second one's along the first and second, the third one's along the second and third. `product` multiplies
/// the first two, and `times` this by the third.
fn means<V, P>(
    first: &[[V; 2]; 2],
    second: &[[V; 2]; 2],
    product: impl Fn(&V, &V) -> P,
    third: &[[V; 2]; 2],
    times: impl Fn(&V, &P) -> f64,
) -> Coefficients {
    /// 1 / C(2, i).
    const WEIGHT: [f64; 3] = [1.0, 0.5, 1.0];
    let mut sum = [[[0.0; 3]; 3]; 3];
    for (a2, b2, c2, a1) in (0..16).map(|bits| (bits >> 2 & 1, bits >> 3, bits >> 1 & 1, bits & 1)) {
        let product = product(&first[a1][c2], &second[a2][b2]);
        for c1 in 0..2 {
            for b1 in 0..2 {
                let (i, j, k) = (a1 + a2, b1 + b2, c1 + c2);
                sum[i][j][k] += WEIGHT[i] * WEIGHT[j] * WEIGHT[k] * times(&third[b1][c1], &product);
            }
        }
    }
    sum
}

/// The derivatives along the three axes at a point of the unit cube.
fn derivatives(edges: &[[[DVec3; 2]; 2]; 3], [u, v, w]: [f64; 3]) -> [DVec3; 3] {
    let at = |e: &[[DVec3; 2]; 2], s: f64, t: f64| e[0][0].lerp(e[1][0], s).lerp(e[0][1].lerp(e[1][1], s), t);
    [at(&edges[0], v, w), at(&edges[1], u, w), at(&edges[2], u, v)]
}

/// Rounding of an edge, or of a mean of edges, relative to the greatest one along its axis: u for each component, and at most 16 means with u
/// each for vectors of three components. Less than 32 u, doubled.
const LENGTH_ROUNDING: f64 = 64.0 * 1.110_223_024_625_156_5e-16;

/// A box of parameters of a trilinear cell.
#[derive(Clone)]
pub(crate) struct LinearBox {
    coefficients: Coefficients,
    doubt: f64,
    /// The derivatives along each axis at the corners of the box, by their position along the other two.
    slopes: [[[DVec3; 2]; 2]; 3],
    /// Rounding of the length of a derivative.
    off: [f64; 3],
}

impl LinearBox {
    pub(crate) fn new(corners: &[DVec3; 8]) -> Self {
        let (coefficients, scale) = coefficients(corners);
        let slopes = edges(corners);
        let off = slopes.map(|edges| LENGTH_ROUNDING * greatest(edges.as_flattened()));
        Self { coefficients, doubt: ROUNDING * scale, slopes, off }
    }

    /// The part with these coefficients, on these sides along the axes.
    fn part(&self, coefficients: Coefficients, sides: [usize; 3]) -> Self {
        let mut part = Self { coefficients, doubt: self.doubt, slopes: self.slopes, off: self.off };
        for (axis, slopes) in part.slopes.iter_mut().enumerate() {
            let [first, second] = [[1, 2], [0, 2], [0, 1]][axis].map(|other| sides[other]);
            for row in slopes.iter_mut() {
                row[1 - second] = 0.5 * (row[0] + row[1]);
            }
            slopes[1 - first] = [0.5 * (slopes[0][0] + slopes[1][0]), 0.5 * (slopes[0][1] + slopes[1][1])];
        }
        part
    }
}

impl ParameterBox for LinearBox {
    fn coefficients(&self, mut act: impl FnMut(f64, f64)) {
        let mut lengths = [[[0.0; 2]; 2]; 3];
        for ((to, from), off) in lengths.iter_mut().zip(&self.slopes).zip(self.off) {
            for (length, slope) in to.as_flattened_mut().iter_mut().zip(from.as_flattened()) {
                *length = slope.length() + off;
            }
        }
        let [along_u, along_v, along_w] = &lengths;
        let sizes = means(along_v, along_w, |v, w| v * w, along_u, |u, area| u * area);
        let determinants = self.coefficients.as_flattened().as_flattened();
        for (determinant, size) in determinants.iter().zip(sizes.as_flattened().as_flattened()) {
            act(determinant - self.doubt, *size);
        }
    }

    fn attained(&self) -> f64 {
        let [along_u, along_v, along_w] = &self.slopes;
        let at = |k: usize| {
            let [u, v, w] = [k & 1, k >> 1 & 1, k >> 2];
            let size = along_u[v][w].length() * along_v[u][w].length() * along_w[u][v].length();
            if size > 0.0 { self.coefficients[2 * u][2 * v][2 * w] / size } else { 0.0 }
        };
        least(&std::array::from_fn::<f64, 8, _>(at))
    }

    fn divided(&self) -> [Self; 8] {
        let coefficients = eighths(&self.coefficients);
        std::array::from_fn(|k| self.part(coefficients[k], [k & 1, k >> 1 & 1, k >> 2]))
    }
}

/// The least scaled Jacobian at the 27 points of a cell whose coordinates are 0, ½ and 1: the determinant over the product of the
/// lengths of the three derivatives. 1 for a box, 0 or less where the cell is folded.
///
/// # Accuracy
/// The least over these points, not over the cell: [`scaled_jacobian_bound`](crate::scaled_jacobian_bound) is proven over the whole cell.
pub fn scaled_jacobian(corners: &[DVec3; 8]) -> f64 {
    const PLACES: [f64; 3] = [0.0, 0.5, 1.0];
    let edges = edges(corners);
    let mut least = f64::INFINITY;
    for u in PLACES {
        for v in PLACES {
            for w in PLACES {
                let [a, b, c] = derivatives(&edges, [u, v, w]);
                let size = a.length() * b.length() * c.length();
                let scaled = if size > 0.0 { a.dot(b.cross(c)) / size } else { 0.0 };
                least = least.min(scaled);
            }
        }
    }
    least
}

/// The volume of a cell, with sign.
///
/// # Definition
/// The integral of a polynomial is the mean of its Bernstein coefficients.
pub fn volume(corners: &[DVec3; 8]) -> f64 {
    coefficients(corners).0.iter().flatten().flatten().sum::<f64>() / 27.0
}
