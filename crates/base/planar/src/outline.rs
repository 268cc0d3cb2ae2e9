//! Closed polygons and regions.

use crate::Point;

/// A closed polygon with at least three corners, counter-clockwise, of finite coordinates. It may cross itself.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    points: Vec<Point>,
}

/// Why points do not form an outline.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// Too few points.
    #[error("the outline has {found} different points in a row; at least 3 are needed")]
    Few {
        /// Points that differ from the one before.
        found: usize,
    },
    /// A coordinate is not finite, or too large to be squared.
    #[error("point {index} of the outline is ({x}, {y}); coordinates must be finite, of at most {most:e}")]
    Coordinate {
        /// Its place in the list.
        index: usize,
        /// Its first coordinate.
        x: f64,
        /// Its second coordinate.
        y: f64,
        /// The greatest coordinate there may be.
        most: f64,
    },
    /// The area is zero.
    #[error(
        "the outline of {corners} corners encloses no area: they lie on a line, or parts on both sides of a crossing cancel each other; move them apart"
    )]
    Flat {
        /// Its corners.
        corners: usize,
    },
}

impl Outline {
    /// The greatest coordinate: its fourth power, which moments need, is still finite.
    pub const MAX_COORDINATE: f64 = 1e60;

    /// A closed polygon through these points; the last one is joined with the first one.
    ///
    /// Consecutive duplicates are removed. Clockwise polygons are reversed; the first point stays first.
    ///
    /// # Errors
    /// [`OutlineError`] for fewer than three points, coordinates that are not finite or beyond [`Outline::MAX_COORDINATE`], and no area.
    pub fn new(mut points: Vec<Point>) -> Result<Self, OutlineError> {
        let is_usable = |p: &Point| p.iter().all(|x| x.abs() <= Self::MAX_COORDINATE);
        if let Some(index) = points.iter().position(|p| !is_usable(p)) {
            let [x, y] = points[index];
            return Err(OutlineError::Coordinate { index, x, y, most: Self::MAX_COORDINATE });
        }
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        if points.len() < 3 {
            return Err(OutlineError::Few { found: points.len() });
        }
        let area = signed_area(&points);
        if area == 0.0 {
            return Err(OutlineError::Flat { corners: points.len() });
        }
        if area < 0.0 {
            points[1..].reverse();
        }
        Ok(Self { points })
    }

    /// The corners.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// The corners, without copying.
    pub fn into_points(self) -> Vec<Point> {
        self.points
    }

    /// The sides, each from a corner to the next one.
    pub fn sides(&self) -> impl Iterator<Item = [Point; 2]> + '_ {
        let next = self.points.iter().cycle().skip(1);
        self.points.iter().zip(next).map(|(a, b)| [*a, *b])
    }

    /// The length of the curve.
    pub fn length(&self) -> f64 {
        self.sides().map(|[a, b]| distance(a, b)).sum()
    }

    /// The enclosed area; parts around which the curve winds twice count twice.
    pub fn area(&self) -> f64 {
        signed_area(&self.points)
    }

    /// The centroid of the area.
    pub fn centroid(&self) -> Point {
        // Relative to a corner, so that an outline far from the origin loses no digits.
        let origin = self.points[0];
        let (mut doubled, mut sum) = (0.0, [0.0; 2]);
        for [a, b] in self.sides() {
            let (a, b) = (minus(a, origin), minus(b, origin));
            let w = cross(a, b);
            doubled += w;
            for k in 0..2 {
                sum[k] += w * (a[k] + b[k]);
            }
        }
        [0, 1].map(|k| origin[k] + sum[k] / (3.0 * doubled))
    }

    /// The lower left and upper right corner of its box.
    pub fn bounds(&self) -> [Point; 2] {
        bounds(&self.points)
    }

    /// Whether a point lies inside, by the even–odd rule. Points on the curve may be either.
    pub fn contains(&self, p: Point) -> bool {
        let mut is_inside = false;
        let Some(&last) = self.points.last() else { return false };
        let mut b = last;
        for &next in &self.points {
            let a = std::mem::replace(&mut b, next);
            if (a[1] > p[1]) != (b[1] > p[1]) {
                let turn = robust::orient2d(coord(a), coord(b), coord(p));
                if (turn > 0.0) == (b[1] > a[1]) {
                    is_inside = !is_inside;
                }
            }
        }
        is_inside
    }

    /// The outline with every point mapped.
    ///
    /// # Errors
    /// [`OutlineError`] if the result is no outline.
    pub fn map(&self, to: impl FnMut(Point) -> Point) -> Result<Self, OutlineError> {
        Self::new(self.points.iter().copied().map(to).collect())
    }

    /// The convex hull, counter-clockwise, without corners on its sides.
    pub fn hull(&self) -> Vec<Point> {
        let mut points = self.points.clone();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
        points.dedup();
        let mut hull: Vec<Point> = Vec::new();
        let mut half = |points: &mut dyn Iterator<Item = &Point>| {
            let start = hull.len();
            for &p in points {
                while hull.len() >= start + 2
                    && robust::orient2d(coord(hull[hull.len() - 2]), coord(hull[hull.len() - 1]), coord(p))
                        <= 0.0
                {
                    hull.pop();
                }
                hull.push(p);
            }
            hull.pop();
        };
        half(&mut points.iter());
        half(&mut points.iter().rev());
        hull
    }
}

/// An outline with holes.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// What is around it.
    pub outer: Outline,
    /// What is cut out of it.
    pub holes: Vec<Outline>,
}

impl Region {
    /// The area without the holes.
    pub fn area(&self) -> f64 {
        self.outer.area() - self.holes.iter().map(Outline::area).sum::<f64>()
    }
}

/// Half the sum of cross products, relative to the first point.
pub(crate) fn signed_area(points: &[Point]) -> f64 {
    let Some(&origin) = points.first() else { return 0.0 };
    let next = points.iter().cycle().skip(1);
    0.5 * points.iter().zip(next).map(|(a, b)| cross(minus(*a, origin), minus(*b, origin))).sum::<f64>()
}

/// The least and the greatest coordinates of points; infinite, the wrong way round, where there are none.
pub fn bounds(points: &[Point]) -> [Point; 2] {
    points.iter().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
        [[0, 1].map(|k| low[k].min(p[k])), [0, 1].map(|k| high[k].max(p[k]))]
    })
}

pub(crate) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn distance(a: Point, b: Point) -> f64 {
    let [x, y] = minus(a, b);
    (x * x + y * y).sqrt()
}

pub(crate) fn coord([x, y]: Point) -> robust::Coord<f64> {
    robust::Coord { x, y }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_outline_is_refused() {
        let few = Outline::new(vec![[0.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]);
        assert_eq!(few, Err(OutlineError::Few { found: 2 }));
        assert_eq!(
            Outline::new(vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]]),
            Err(OutlineError::Flat { corners: 3 })
        );
        for bad in [f64::NAN, f64::INFINITY, 1e61] {
            let points = vec![[0.0, 0.0], [1.0, bad], [1.0, 1.0]];
            assert!(matches!(Outline::new(points), Err(OutlineError::Coordinate { index: 1, .. })));
        }
    }

    #[test]
    fn measures_of_a_rectangle_with_a_notch() {
        let points = vec![
            [0.0, 0.0],
            [0.0, 4.0],
            [2.0, 4.0],
            [2.0, 3.0],
            [4.0, 3.0],
            [4.0, 4.0],
            [6.0, 4.0],
            [6.0, 0.0],
        ];
        let outline = Outline::new(points).unwrap();
        assert_eq!((outline.points()[0], outline.points()[1]), ([0.0, 0.0], [6.0, 0.0]));
        assert_eq!((outline.area(), outline.length()), (22.0, 22.0));
        let [x, y] = outline.centroid();
        assert!((x - 3.0).abs() < 1e-15 && (y - (24.0 * 2.0 - 2.0 * 3.5) / 22.0).abs() < 1e-15);
        assert_eq!(outline.hull().len(), 4);
        assert!(
            outline.contains([3.0, 2.9]) && !outline.contains([3.0, 3.1]) && !outline.contains([7.0, 1.0])
        );
    }
}
