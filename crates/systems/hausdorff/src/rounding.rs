//! The rounding model: what separates computed numbers from proven ones.
//!
//! Everything is computed in a [`Frame`] in which all coordinates of A and B are at most `M`
//! in magnitude (about 1 where the meshes lie together). Let `u = 2^-53`, so that a rounded operation is off by at most
//! `u` times its result; the bounds below are in units of `u M`, to first order in `u`, each rounded up generously, and
//! the constants are rounded up again to cover the terms of second order and underflow (far below `u M`, since `M >= 1/4`).
//!
//! The model of a rounded operation, and how errors of several add up, are those of `higham_accuracy_2002`.
//!
//! **Frame.** Mapping a coordinate rounds once, by at most `u M`, so each vertex moves by less than `sqrt(3) u M`: 2. Only
//! vertices outside the box that the frame was made for can move at all, so B and the certified lower bound are not touched.
//!
//! **A turned frame** (`deviation/frame.rs`) moves each vertex by at most 8 more, of A and of B: 16 for a distance. Its M bounds the distance of all points
//! from the origin, and a unit is a quarter larger there (`OF_TURNED`), so that every constant below has room for 24 more than is counted. The certified lower
//! bound encloses the exact image of the point of A and is lowered by 8 for B (`Target::moved`). Areas come from enclosures and from exact determinants
//! before the rotation, which keeps them.
//!
//! **A distance to a face** is computed as `|((p - a) - w (c - a)) - v (b - a)|` with `v, w >= 0` and `v + w <= 1` up to
//! rounding, so it belongs to a point of the face, and where `v` and `w` came from does not matter. Per coordinate:
//! `p - a` is off by 2, `v (b - a)` and `w (c - a)` together by 4 (each difference and each product, weighted), the two
//! subtractions by 4 and 6; together 16, in three coordinates below 28. Squares, their sum and the square root are off by
//! `3 u` relative to a distance of at most `2 sqrt(3) M`: below 11. `v + w` may exceed 1 by `u`: 4. Together below 43.
//!
//! **A mixture** of at most 8 such distances, with weights divided by their sum, is off by `11 u` relative: below 39.
//! With the former, below 82, and below 84 with the frame's: [`EVALUATION`] leaves room.
//!
//! **Other faces for some in one plane** (`planar`) may be 10 from them, `MOST_MOVED`: with the former below 94. The certified lower bound is lowered by how far
//! they are.
//!
//! **A cut** places its end points at `p + t (q - p)`: 2 for the difference, 2 for the product, 1 for the sum per
//! coordinate; below 9 in space. The two parts of a piece therefore cover it up to 9 units, over which the distance from
//! B changes by as much at most: [`CUT`] for every cut between a face and the piece.
//!
//! **An overlay** places its points at `t_0 + v (t_1 - t_0) + w (t_2 - t_0)` with `v, w >= 0` and `v + w <= 1` up to rounding, or on a
//! side as a cut does. By the count for faces above they lie within 28 units of the triangle, and what covers its sides
//! within 9 of them: together below 40, the same as four cuts.
//!
//! **A separating plane** of a deviation analysis is computed as `g . (p - c) - max_j g . (t_j - c)` with g of length one. Differences
//! are off by 2 per coordinate, both together by `4 sqrt(3)` along g; products by as much, sums and the last difference by at
//! most `12 sqrt(3)`: below 35. The length of g is off by `4 u` relative, of a result of at most `4 sqrt(3) M`: below 28.
//! Together below 63, and below 65 with the frame's: [`EVALUATION`] leaves room. A deviation analysis computes this at the corners
//! of a face of A and interpolates; that interpolation, and corners of pieces that are placed by weights and not by cuts, are
//! accounted for in `deviation/candidates.rs`.
//!
//! **A plane in front of a box** (`deviation/planes.rs`) is computed as `|r| + (r . w) / |r|` with `r = c - y` for the point y of the box nearest to c
//! and `w = p - c`. A component of r is one difference of stored numbers, or zero where c lies between the sides, so r has the signs of the exact one,
//! and the plane through y with normal r touches the box whatever its digits are: only its value at p is off. The length of r is off by `3 u`
//! relative, of at most `2 sqrt(3) M`: below 11. Components of r and w are off by 2, products and sums of `r . w` by at most `5 u` of
//! `|r| |w|`, and the division adds 4: together below `4 + 12 sqrt(3) + 4` times M, less than 30. The length of `r / |r|` is off by `4 u`, of a result of at
//! most `2 sqrt(3) M`: below 14; the last sum by 4 sqrt(3), 7. Together below 62, as for separating planes. The least of such values over a
//! face is interpolated at the middle of an edge for each of its halves, and rounded down there (`Part::between` in `deviation/polygon.rs`), so that
//! halving adds nothing. Corners of parts are placed up to 28 from where they are said to be. Together below 90: less than twice [`EVALUATION`], which
//! is what values on pieces are lowered by.
//!
//! **What distances of corners say** (`deviation/corners.rs`) is computed as `sqrt((d - r) (d + r))` with `r = |p - c|`. Any stored point will do for c, so only the length of r is
//! off, by less than `5 u` of itself, which a factor of `1 + 16 u` makes up for; d, off by less than 45, is lowered by twice [`EVALUATION`] first. Both differences, the product and the root
//! are off by `u` of their results, together by `2 u` of at most `2 sqrt(3) M`: 7. The value is lowered by twice [`EVALUATION`] once more.
//!
//! **Sums on grids** (`deviation/grid.rs`) count areas in units of an integer. A weight times a power of two is exact; its quotient by an integer below 2^42 is off
//! by `u` relative, and the factor that rounds it outwards by 16 u more than makes up for it; a conversion to an integer rounds down, and one is added
//! where it must not. Sums and prefix sums of integers are exact. Converting a sum to a double is off by `u` relative, and adding up the levels of
//! several grids by `u` for each of at most 128: less than the 2048 u by which results are widened.
//!
//! **The lower bound** is computed in interval arithmetic and needs no model. The search counts on it to lie no more than
//! [`LOWER`] units below the plain computed distance; where it does not, the enclosure comes out wider, not wrong.

use pompeiu_core::geom::{Aabb, Frame};

/// Error of a bound at the corners of a piece, frame included, in units of `u M`.
pub const EVALUATION: f64 = 96.0;
/// Error that each cut adds, in units of `u M`.
pub const CUT: f64 = 10.0;
/// Room left for the certified lower bound below the computed one, in units of `u M`.
pub const LOWER: f64 = 96.0;
/// How much larger a unit is in a turned frame.
const OF_TURNED: f64 = 1.25;
/// Cuts that the least tolerance leaves room for.
const CUTS_IN_FLOOR: f64 = 40.0;

/// The error bounds of one search, as lengths in its frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rounding {
    unit: f64,
}

impl Rounding {
    /// For coordinates of at most `max_coordinate` in magnitude.
    pub fn new(max_coordinate: f64) -> Self {
        let m = if max_coordinate > 0.25 { max_coordinate } else { 0.25 };
        Self { unit: m * (0.5 * f64::EPSILON) }
    }

    /// For points of a box in a frame.
    pub(crate) fn in_frame(frame: &Frame, aabb: &Aabb) -> Self {
        let max_coordinate = frame.max_coordinate(aabb);
        Self::new(if frame.is_turned() { OF_TURNED * max_coordinate } else { max_coordinate })
    }

    /// How far a computed bound of a piece after `depth` cuts may lie below a true one.
    #[inline]
    pub fn bound(&self, depth: u32) -> f64 {
        (EVALUATION + CUT * f64::from(depth)) * self.unit
    }

    /// See [`CUT`].
    pub fn cut(&self) -> f64 {
        CUT * self.unit
    }

    /// The length `u M` that the constants count.
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// The greatest coordinate.
    pub fn size(&self) -> f64 {
        self.unit * (2.0 / f64::EPSILON)
    }

    /// See [`LOWER`].
    pub fn lower(&self) -> f64 {
        LOWER * self.unit
    }

    /// The least tolerance that a search can reach: some 1e-13 of the size of the coordinates.
    pub fn least_tolerance(&self) -> f64 {
        2.0 * (LOWER + EVALUATION + CUT * CUTS_IN_FLOOR) * self.unit
    }
}
