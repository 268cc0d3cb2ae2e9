//! Convex parts of a face of A, in barycentric coordinates, and how a line cuts them.
//!
//! A face is cut along lines. Each new corner lies on an edge of the polygon that is cut, at `p + t (q - p)` for some `t`, in exact
//! arithmetic; so the parts of these exact polygons partition the face, and its area. What is stored are the corners rounded, by
//! at most 3 u in each coordinate for every cut (u = 2^-53): [`Polygon::displacement`] and [`Polygon::share_error`] account for it.
//!
//! With each corner goes the value there of a function above the distance and of one below it. The one above is convex, so
//! its linear interpolation on any triangle between corners lies above it; the one below is concave.

use super::linear::{greater, lesser, mean, mean_of_positive};
use pompeiu_core::spatial::Slot;

/// Corners of a polygon at most: every cut may add one.
pub(super) const MOST_CORNERS: usize = 8;

/// One number for each corner; what lies beyond the number of corners repeats the last one.
pub(super) type Row = [f64; MOST_CORNERS];

/// The rounding unit.
const UNIT: f64 = 0.5 * f64::EPSILON;
/// Interpolating a value between two others rounds three times, each time relative to no more than the sum of both.
const INTERPOLATION: f64 = 4.0 * f64::EPSILON;
/// A part with a smaller fraction of a polygon is not worth a cut.
const LEAST_PART: f64 = 1e-10;
/// A cut between two opposite corners that leaves less than this fraction on one side is compared with others.
const LEAST_APART: f64 = 0.01;

/// A convex part of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outline {
    pub(super) count: usize,
    /// The weights of the second and of the third corner of the face, at each corner of this part.
    pub(super) v: Row,
    pub(super) w: Row,
    /// Cuts between the face and this part.
    pub(super) depth: u32,
}

/// A convex part of a face, and what is known of the distance from B on it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon {
    pub(super) outline: Outline,
    /// Values at the corners of a function below the distance from B.
    pub(super) lower: Row,
    /// Values at the corners of a function above it.
    pub(super) upper: Row,
    /// Values at the corners of a function that is below the distance from faces of B which are not on the list of this polygon.
    pub(super) beyond: Row,
}

/// A part of a face, and a face of B near its centre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub(super) polygon: Polygon,
    pub(super) near: Slot,
}

impl Outline {
    /// A whole face.
    pub(super) const WHOLE: Self = Self {
        count: 3,
        v: [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        w: [0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0],
        depth: 0,
    };

    /// How far the stored corners are from the exact ones, in each of the two weights.
    pub(super) fn displacement(&self) -> f64 {
        3.0 * UNIT * f64::from(self.depth)
    }

    /// How far the computed share of a triangle of the fan is from the exact one. With coordinates off by e, differences are
    /// off by 2 e + u, both products and their difference by 4 (2 e + u) + 3 u.
    pub(super) fn share_error(&self) -> f64 {
        8.0 * self.displacement() + 8.0 * UNIT
    }

    /// Triangles between the first corner and each two that follow each other, by the places of the latter.
    pub(super) fn fan(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        (2..self.count).map(|i| [0, i - 1, i])
    }

    /// The fraction of the area of the face that a triangle has, rounded.
    pub(super) fn share_of(&self, [i, j, k]: [usize; 3]) -> f64 {
        let (v, w) = (&self.v, &self.w);
        ((v[j] - v[i]) * (w[k] - w[i]) - (w[j] - w[i]) * (v[k] - v[i])).abs()
    }

    /// The fraction of the area of the face, rounded.
    pub(super) fn share(&self) -> f64 {
        self.fan().map(|triangle| self.share_of(triangle)).sum()
    }

    /// What each corner counts in the integral of a function that is linear on each triangle of the fan; rounded.
    pub(super) fn weights(&self) -> Row {
        let mut weights = [0.0; MOST_CORNERS];
        for triangle in self.fan() {
            let third = self.share_of(triangle) * (1.0 / 3.0);
            for j in triangle {
                weights[j] += third;
            }
        }
        weights
    }

    /// The mean of the corners.
    pub(super) fn centre(&self) -> [f64; 2] {
        let part = 1.0 / self.count as f64;
        [&self.v, &self.w].map(|row| row[..self.count].iter().sum::<f64>() * part)
    }

    /// Cuts where a linear function with these values at the corners vanishes, if that leaves something on both sides: where it is
    /// positive, and where it is negative. Any values give a partition: the cut leads from one place on the boundary to another.
    pub(super) fn cut(&self, side: &Row) -> Option<[Self; 2]> {
        let n = self.count;
        let empty = Self { count: 0, v: [0.0; MOST_CORNERS], w: [0.0; MOST_CORNERS], depth: self.depth + 1 };
        let mut parts = [empty; 2];
        let mut places = 0;
        for i in 0..n {
            let j = if i + 1 == n { 0 } else { i + 1 };
            let (here, next) = (side[i], side[j]);
            places += usize::from(here == 0.0);
            let at = [self.v[i], self.w[i]];
            // A value that is no number counts to neither side, and then too few places are found.
            if here >= 0.0 {
                parts[0].push(at)?;
            }
            if here <= 0.0 {
                parts[1].push(at)?;
            }
            if here > 0.0 && next < 0.0 || here < 0.0 && next > 0.0 {
                places += 1;
                let t = here / (here - next);
                let at = [at[0] + t * (self.v[j] - at[0]), at[1] + t * (self.w[j] - at[1])];
                parts[0].push(at)?;
                parts[1].push(at)?;
            }
        }
        if places != 2 || parts[0].count < 3 || parts[1].count < 3 {
            return None;
        }
        for part in &mut parts {
            let (last, rest) = (part.count - 1, part.count..MOST_CORNERS);
            let (v, w) = (part.v[last], part.w[last]);
            part.v[rest.clone()].fill(v);
            part.w[rest].fill(w);
        }
        let (s, t) = (parts[0].share(), parts[1].share());
        let least = LEAST_PART * (s + t);
        (s > least && t > least).then_some(parts)
    }

    /// None where there is no room.
    fn push(&mut self, [v, w]: [f64; 2]) -> Option<()> {
        *self.v.get_mut(self.count)? = v;
        self.w[self.count] = w;
        self.count += 1;
        Some(())
    }

    /// The same as [`Outline::cut`], with where the corners come from.
    fn cut_at(&self, side: &Row) -> Option<[(Part, Self); 2]> {
        let n = self.count;
        let mut places = 0;
        let mut parts = [Part::EMPTY; 2];
        for i in 0..n {
            let j = if i + 1 == n { 0 } else { i + 1 };
            let (here, next) = (side[i], side[j]);
            if here == 0.0 {
                places += 1;
            }
            // A value that is no number counts to neither side, and then too few places are found.
            if here >= 0.0 {
                parts[0].push(i, i, 0.0)?;
            }
            if here <= 0.0 {
                parts[1].push(i, i, 0.0)?;
            }
            if here > 0.0 && next < 0.0 || here < 0.0 && next > 0.0 {
                places += 1;
                let t = here / (here - next);
                parts[0].push(i, j, t)?;
                parts[1].push(i, j, t)?;
            }
        }
        if places != 2 || parts[0].count < 3 || parts[1].count < 3 {
            return None;
        }
        let outlines = [self.part(&parts[0]), self.part(&parts[1])];
        let (s, t) = (outlines[0].share(), outlines[1].share());
        let least = LEAST_PART * (s + t);
        (s > least && t > least).then_some([(parts[0], outlines[0]), (parts[1], outlines[1])])
    }

    /// Cuts between two corners that are opposite of each other, or where that leaves little on one side, from the corner and to the
    /// corner or the middle of an edge that leave most. No part has more corners than the whole.
    ///
    /// Corners may lie so close together that every way between two of them leaves nothing on one side.
    pub(super) fn cut_apart(&self) -> Option<[Self; 2]> {
        self.cut(&self.apart())
    }

    /// Values at the corners of a side for [`Outline::cut_apart`].
    fn apart(&self) -> Row {
        let lesser_part = |side: &Row| {
            let parts = self.cut(side).filter(|parts| parts.iter().all(|part| part.count <= self.count));
            parts.map_or(0.0, |[one, two]| lesser(one.share(), two.share()))
        };
        let mut best = self.between(0, self.count / 2, false);
        let mut most = lesser_part(&best);
        if most >= LEAST_APART * self.share() {
            return best;
        }
        for from in 0..self.count {
            for to in 0..self.count {
                for on_edge in [false, true] {
                    let side = self.between(from, to, on_edge);
                    let part = lesser_part(&side);
                    if part > most {
                        (best, most) = (side, part);
                    }
                }
            }
        }
        best
    }

    /// Values at the corners of a side that is crossed from one corner to another one, or to the middle of the edge that follows it.
    fn between(&self, from: usize, to: usize, on_edge: bool) -> Row {
        let places_to = |corner: usize| (corner + self.count - from) % self.count;
        let last = places_to(to);
        let at = |corner: usize| match places_to(corner) {
            0 => 0.0,
            place if place == last && !on_edge => 0.0,
            place if place <= last => 1.0,
            _ => -1.0,
        };
        std::array::from_fn(|corner| at(corner.min(self.count - 1)))
    }

    /// Halves a part with three corners across its longest edge, and interpolates a function with these values at the corners, rounded down.
    pub(super) fn halve_triangle(
        &self,
        length_squared: impl Fn([f64; 2]) -> f64,
        values: &Row,
    ) -> [(Self, Row); 2] {
        let mut longest = (f64::NEG_INFINITY, 0);
        for i in 0..3 {
            let j = (i + 1) % 3;
            let square = length_squared([self.v[j] - self.v[i], self.w[j] - self.w[i]]);
            longest = if square > longest.0 { (square, i) } else { longest };
        }
        Self::halves(longest.1).map(|part| (self.part(&part), part.between(values, -INTERPOLATION)))
    }

    /// Halves a part with three corners across the edge from corner `i` to the next one.
    fn halves(i: usize) -> [Part; 2] {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        [[[i, i], [i, j], [k, k]], [[i, j], [j, j], [k, k]]].map(|corners| {
            let mut part = Part::EMPTY;
            for [from, to] in corners {
                // There is room for three.
                let _ = part.push(from, to, 0.5);
            }
            part
        })
    }

    fn part(&self, part: &Part) -> Self {
        let coordinate = |row: &Row| part.row(|from, to, t| row[from] + t * (row[to] - row[from]));
        Self { count: part.count, v: coordinate(&self.v), w: coordinate(&self.w), depth: self.depth + 1 }
    }
}

impl Polygon {
    /// A whole face, of which only is known that distances are neither negative nor above the largest.
    pub(super) fn whole(largest: f64) -> Self {
        Self::unknown(Outline::WHOLE, largest)
    }

    /// The same of a part of a face.
    pub(super) fn unknown(outline: Outline, largest: f64) -> Self {
        Self {
            outline,
            lower: [0.0; MOST_CORNERS],
            upper: [largest; MOST_CORNERS],
            beyond: [f64::INFINITY; MOST_CORNERS],
        }
    }

    /// The integral of how far apart the functions are, where the one below is not negative, as sums have it; as a part of that over
    /// the face. `weights` are those of the outline.
    ///
    /// Where the function below changes its sign, its positive part is not linear: at a corner where both surfaces touch, the function
    /// above is zero and the one below may be far less, and cutting it off at the corners would call the piece narrow.
    pub(super) fn mass(&self, weights: &Row) -> f64 {
        let Self { outline, lower, upper, .. } = self;
        if lower.iter().all(|x| *x >= 0.0) {
            return self.mass_at_most(weights);
        }
        let of_triangle = |triangle: [usize; 3]| {
            let [upper, lower] = [upper, lower].map(|row| triangle.map(|j| row[j]));
            outline.share_of(triangle) * (mean(upper) - mean_of_positive(lower))
        };
        outline.fan().map(of_triangle).sum()
    }

    /// The integral of how far apart the functions are, below zero as well.
    #[inline]
    pub(super) fn mass_at_most(&self, weights: &Row) -> f64 {
        integral(weights, &std::array::from_fn(|j| self.upper[j] - self.lower[j]))
    }

    /// The greatest width between the functions, where the one below is not negative, is no greater.
    pub(super) fn most_width(&self) -> f64 {
        let (mut apart, mut upper) = (0.0, 0.0);
        for j in 0..self.outline.count {
            apart = greater(apart, self.upper[j] - self.lower[j]);
            upper = greater(upper, self.upper[j]);
        }
        lesser(apart, upper)
    }

    /// See [`Outline::cut`].
    pub(super) fn cut(&self, side: &Row) -> Option<[Self; 2]> {
        Some(self.outline.cut_at(side)?.map(|(part, outline)| self.part(&part, outline)))
    }

    /// See [`Outline::cut_apart`].
    pub(super) fn cut_apart(&self) -> Option<[Self; 2]> {
        self.cut(&self.outline.apart())
    }

    /// Halves a triangle across the edge from corner `i` to the next one.
    pub(super) fn halve(&self, i: usize) -> [Self; 2] {
        Outline::halves(i).map(|part| self.part(&part, self.outline.part(&part)))
    }

    fn part(&self, part: &Part, outline: Outline) -> Self {
        Self {
            outline,
            lower: part.between(&self.lower, -INTERPOLATION),
            upper: part.between(&self.upper, INTERPOLATION),
            beyond: part.between(&self.beyond, -INTERPOLATION),
        }
    }
}

/// The corners of a part of an outline, each at a fraction of the way between two corners of the whole.
#[derive(Clone, Copy)]
struct Part {
    count: usize,
    corners: [(u8, u8, f64); MOST_CORNERS],
}

impl Part {
    const EMPTY: Self = Self { count: 0, corners: [(0, 0, 0.0); MOST_CORNERS] };

    /// None where there is no room.
    fn push(&mut self, from: usize, to: usize, t: f64) -> Option<()> {
        *self.corners.get_mut(self.count)? = (from as u8, to as u8, t);
        self.count += 1;
        Some(())
    }

    /// Values at the corners of a function that is interpolated from the corners of the whole, moved by a part of them.
    fn between(&self, row: &Row, margin: f64) -> Row {
        self.row(|from, to, t| {
            let (a, b) = (row[from], row[to]);
            if from == to || a == b { a } else { a + t * (b - a) + margin * (a.abs() + b.abs()) }
        })
    }

    fn row(&self, value: impl Fn(usize, usize, f64) -> f64) -> Row {
        let mut row = [0.0; MOST_CORNERS];
        let mut last = 0.0;
        for (j, (place, (from, to, t))) in row.iter_mut().zip(&self.corners).enumerate() {
            if j < self.count {
                last = value(*from as usize, *to as usize, *t);
            }
            *place = last;
        }
        row
    }
}

/// The integral of a function with these values at the corners, from [`Polygon::weights`].
#[inline]
pub(super) fn integral(weights: &Row, row: &Row) -> f64 {
    let mut sum = 0.0;
    for j in 0..MOST_CORNERS {
        sum += weights[j] * row[j];
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Cuts by any numbers partition: shares add up, and the values at corners enclose those of a linear function.
        #[test]
        fn parts_share_out_the_area_and_keep_the_values(
            sides in prop::collection::vec(prop::array::uniform8(-1.0..1.0_f64), 1..40),
            gradient in [-1.0..1.0_f64, -1.0..1.0],
        ) {
            let value = |v: f64, w: f64| 1.0 + gradient[0] * v + gradient[1] * w;
            let mut whole = Polygon::whole(0.0);
            let row = std::array::from_fn(|j| value(whole.outline.v[j], whole.outline.w[j]));
            (whole.lower, whole.upper) = (row, row);
            let mut parts = vec![whole];
            let mut turn = 0;
            for side in &sides {
                let part = parts.swap_remove(turn % parts.len());
                turn += 7;
                match part.cut(side).or_else(|| part.cut_apart()) {
                    Some(two) => parts.extend(two),
                    None if part.outline.count == 3 => parts.extend(part.halve(turn % 3)),
                    None => parts.push(part),
                }
            }
            let total: f64 = parts.iter().map(|part| part.outline.share()).sum();
            let error: f64 = parts.iter().map(|part| 6.0 * part.outline.share_error()).sum();
            prop_assert!((total - 1.0).abs() <= error, "{total} {error}");
            for part in &parts {
                prop_assert_eq!(format!("{:?}", part.outline.cut(&sides[0])), format!("{:?}", part.cut(&sides[0]).map(|parts| parts.map(|part| part.outline))));
                prop_assert!((3..=MOST_CORNERS).contains(&part.outline.count));
                for j in 0..MOST_CORNERS {
                    let exact = value(part.outline.v[j], part.outline.w[j]);
                    prop_assert!(part.lower[j] <= exact + 1e-14 && exact <= part.upper[j] + 1e-14);
                    prop_assert!(part.upper[j] - part.lower[j] < 1e-12);
                }
            }
        }
    }

    /// A line that only touches a polygon does not cut it, nor does one along an edge.
    #[test]
    fn what_leaves_nothing_on_one_side_is_no_cut() {
        let whole = Polygon::whole(1.0);
        for side in [[0.0, 1.0, 1.0], [0.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0; 3], [f64::NAN, 1.0, -1.0]] {
            let mut row = [side[2]; MOST_CORNERS];
            row[..3].copy_from_slice(&side);
            assert!(whole.cut(&row).is_none(), "{side:?}");
        }
        let mut row = [1.0; MOST_CORNERS];
        row[..3].copy_from_slice(&[0.0, -1.0, 1.0]);
        let [one, two] = whole.cut(&row).unwrap();
        assert_eq!(
            (one.outline.count, two.outline.count, one.outline.share(), two.outline.share()),
            (3, 3, 0.5, 0.5)
        );
    }
}
