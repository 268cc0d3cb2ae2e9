//! Convex parts of a face of A, in barycentric coordinates, and how a line cuts them.
//!
//! A face is cut along lines. Each new corner lies on an edge of the polygon that is cut, at `p + t (q - p)` for some `t`, in exact
//! arithmetic; so the parts of these exact polygons partition the face, and its area. What is stored are the corners rounded, by
//! at most 3 u in each coordinate for every cut (u = 2^-53): [`Polygon::displacement`] and [`Polygon::share_error`] account for it.
//!
//! With each corner goes the value there of a function above the distance and of one below it. The one above is convex, so
//! its linear interpolation on any triangle between corners lies above it; the one below is concave.

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

/// A convex part of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Polygon {
    pub(super) count: usize,
    /// The weights of the second and of the third corner of the face, at each corner of this polygon.
    pub(super) v: Row,
    pub(super) w: Row,
    /// Values at the corners of a function below the distance from B.
    pub(super) lower: Row,
    /// Values at the corners of a function above it.
    pub(super) upper: Row,
    /// Values at the corners of a function that is below the distance from faces of B which are not on the list of this polygon.
    pub(super) beyond: Row,
    /// Cuts between the face and this polygon.
    pub(super) depth: u32,
}

impl Polygon {
    /// A whole face, of which only is known that distances are neither negative nor above the largest.
    pub(super) fn whole(largest: f64) -> Self {
        Self {
            count: 3,
            v: [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            w: [0.0, 0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0],
            lower: [0.0; MOST_CORNERS],
            upper: [largest; MOST_CORNERS],
            beyond: [f64::INFINITY; MOST_CORNERS],
            depth: 0,
        }
    }

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

    /// Widths between the functions, as far as the one below is not negative.
    pub(super) fn widths(&self) -> Row {
        let mut widths = [0.0; MOST_CORNERS];
        for j in 0..MOST_CORNERS {
            widths[j] = self.upper[j] - if self.lower[j] > 0.0 { self.lower[j] } else { 0.0 };
        }
        widths
    }

    /// Cuts where a linear function with these values at the corners vanishes, if that leaves something on both sides. Any values
    /// give a partition: the cut leads from one place on the boundary to another.
    pub(super) fn cut(&self, side: &Row) -> Option<[Self; 2]> {
        let n = self.count;
        let mut places = 0;
        let mut parts = [Builder::new(self), Builder::new(self)];
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
        let [one, two] = parts.map(Builder::finish);
        if places != 2 || one.count < 3 || two.count < 3 {
            return None;
        }
        let (s, t) = (one.share(), two.share());
        let least = LEAST_PART * (s + t);
        (s > least && t > least).then_some([one, two])
    }

    /// Cuts along the shorter way between two corners that are opposite of each other.
    pub(super) fn cut_along_diagonal(&self) -> Option<[Self; 2]> {
        let half = self.count / 2;
        let mut side = [1.0; MOST_CORNERS];
        for (i, side) in side.iter_mut().enumerate() {
            *side = if i == 0 || i == half {
                0.0
            } else if i < half {
                1.0
            } else {
                -1.0
            };
        }
        if self.count > 3 { self.cut(&side) } else { None }
    }

    /// Halves a triangle across the edge from corner `i` to the next one.
    pub(super) fn halve(&self, i: usize) -> [Self; 2] {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let part = |corners: [[usize; 2]; 3]| {
            let mut part = Builder::new(self);
            for [from, to] in corners {
                // There is room for three.
                let _ = part.push(from, to, 0.5);
            }
            part.finish()
        };
        [part([[i, i], [i, j], [k, k]]), part([[i, j], [j, j], [k, k]])]
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

/// A part of a polygon in the making.
struct Builder<'p> {
    whole: &'p Polygon,
    part: Polygon,
}

impl<'p> Builder<'p> {
    fn new(whole: &'p Polygon) -> Self {
        let zero = [0.0; MOST_CORNERS];
        let part = Polygon {
            count: 0,
            v: zero,
            w: zero,
            lower: zero,
            upper: zero,
            beyond: zero,
            depth: whole.depth + 1,
        };
        Self { whole, part }
    }

    /// Adds the point at the fraction `t` of the way between two corners. None where there is no room.
    fn push(&mut self, from: usize, to: usize, t: f64) -> Option<()> {
        let (whole, part) = (self.whole, &mut self.part);
        let n = part.count;
        if n == MOST_CORNERS {
            return None;
        }
        if from == to {
            part.v[n] = whole.v[from];
            part.w[n] = whole.w[from];
            part.lower[n] = whole.lower[from];
            part.upper[n] = whole.upper[from];
            part.beyond[n] = whole.beyond[from];
            part.count += 1;
            return Some(());
        }
        let between = |row: &Row, margin: f64| {
            let (a, b) = (row[from], row[to]);
            if a == b { a } else { a + t * (b - a) + margin * (a.abs() + b.abs()) }
        };
        part.v[n] = between(&whole.v, 0.0);
        part.w[n] = between(&whole.w, 0.0);
        part.lower[n] = between(&whole.lower, -INTERPOLATION);
        part.upper[n] = between(&whole.upper, INTERPOLATION);
        part.beyond[n] = between(&whole.beyond, -INTERPOLATION);
        part.count += 1;
        Some(())
    }

    fn finish(mut self) -> Polygon {
        let part = &mut self.part;
        let last = part.count.saturating_sub(1);
        for row in [&mut part.v, &mut part.w, &mut part.lower, &mut part.upper, &mut part.beyond] {
            let value = row[last];
            row[part.count..].fill(value);
        }
        self.part
    }
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
            let row = std::array::from_fn(|j| value(whole.v[j], whole.w[j]));
            (whole.lower, whole.upper) = (row, row);
            let mut parts = vec![whole];
            let mut turn = 0;
            for side in sides {
                let part = parts.swap_remove(turn % parts.len());
                turn += 7;
                match part.cut(&side).or_else(|| part.cut_along_diagonal()) {
                    Some(two) => parts.extend(two),
                    None if part.count == 3 => parts.extend(part.halve(turn % 3)),
                    None => parts.push(part),
                }
            }
            let total: f64 = parts.iter().map(Polygon::share).sum();
            let error: f64 = parts.iter().map(|part| 6.0 * part.share_error()).sum();
            prop_assert!((total - 1.0).abs() <= error, "{total} {error}");
            for part in &parts {
                prop_assert!((3..=MOST_CORNERS).contains(&part.count));
                for j in 0..MOST_CORNERS {
                    let exact = value(part.v[j], part.w[j]);
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
        assert_eq!((one.count, two.count, one.share(), two.share()), (3, 3, 0.5, 0.5));
    }
}
