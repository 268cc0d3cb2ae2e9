//! The regions that closed curves enclose.

use crate::outline::{bounds, signed_area};
use crate::predicates::{Turn, orientation};
use crate::{Outline, OutlineError, Point, Region};

/// Which points several closed curves enclose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FillRule {
    /// Those around which they wind, in sum, at least once in either direction.
    #[default]
    NonZero,
    /// Those that an odd number of curves surrounds.
    EvenOdd,
}

impl FillRule {
    fn is_filled(self, winding: i64, curves: usize) -> bool {
        match self {
            Self::NonZero => winding != 0,
            Self::EvenOdd => curves % 2 == 1,
        }
    }
}

/// The regions that closed curves enclose together, in the order of their outer curves.
///
/// # Definition
/// A curve has the filled part on one of its sides, is around a region if that is its inside, and a hole of the smallest region around it if
/// that is its outside; with the filled part on both sides or on none it is left out. A curve is inside another one if all its corners are, or
/// lie on that one.
///
/// # Limits
/// Curves that cross each other count as if each one were alone.
///
/// # Errors
/// [`OutlineError`] if a curve is no outline.
///
/// # Cost
/// For each two curves whose boxes lie in each other, the product of their numbers of corners.
pub fn regions(curves: Vec<Vec<Point>>, rule: FillRule) -> Result<Vec<Region>, OutlineError> {
    let signs: Vec<i64> =
        curves.iter().map(|points| if signed_area(points) < 0.0 { -1 } else { 1 }).collect();
    let outlines = curves.into_iter().map(Outline::new).collect::<Result<Vec<_>, _>>()?;
    let around = all_around(&outlines);
    let winding = |i: usize| around[i].iter().map(|j| signs[*j]).sum::<i64>();
    let sides = |i: usize| {
        let (outside, curves) = (winding(i), around[i].len());
        [rule.is_filled(outside + signs[i], curves + 1), rule.is_filled(outside, curves)]
    };
    let is_outer: Vec<bool> = (0..outlines.len()).map(|i| sides(i) == [true, false]).collect();
    let mut holes: Vec<Vec<Outline>> = vec![Vec::new(); outlines.len()];
    for i in (0..outlines.len()).filter(|i| sides(*i) == [false, true]) {
        let of = around[i].iter().filter(|j| is_outer[**j]);
        let smallest = of.min_by(|a, b| outlines[**a].area().total_cmp(&outlines[**b].area()));
        if let Some(outer) = smallest {
            holes[*outer].push(outlines[i].clone());
        }
    }
    let all = outlines.into_iter().zip(holes).zip(is_outer);
    Ok(all.filter(|(_, is_outer)| *is_outer).map(|((outer, holes), _)| Region { outer, holes }).collect())
}

/// For each outline those that it is inside of. Of equal ones, the later is inside.
fn all_around(outlines: &[Outline]) -> Vec<Vec<usize>> {
    let boxes: Vec<([Point; 2], f64)> = outlines.iter().map(|o| (o.bounds(), o.area())).collect();
    let is_around = |j: usize, i: usize| {
        let (([low, high], area), ([lower, higher], larger)) = (boxes[i], boxes[j]);
        (larger, i) > (area, j)
            && (0..2).all(|k| lower[k] <= low[k] && high[k] <= higher[k])
            && outlines[i].points().iter().all(|p| outlines[j].contains(*p) || is_on(&outlines[j], *p))
    };
    let all = 0..outlines.len();
    all.clone().map(|i| all.clone().filter(|j| *j != i && is_around(*j, i)).collect()).collect()
}

fn is_on(outline: &Outline, p: Point) -> bool {
    outline.sides().any(|[a, b]| {
        let [low, high] = bounds(&[a, b]);
        (0..2).all(|k| low[k] <= p[k] && p[k] <= high[k]) && orientation(a, b, p) == Turn::Straight
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A square around the origin, counter-clockwise or clockwise.
    fn square(half: f64, sign: f64) -> Vec<Point> {
        vec![[-half, -half * sign], [half, -half * sign], [half, half * sign], [-half, half * sign]]
    }

    /// Areas and numbers of holes.
    fn areas(curves: &[Vec<Point>], rule: FillRule) -> Vec<(f64, usize)> {
        let found = regions(curves.to_vec(), rule).unwrap();
        found.iter().map(|region| (region.area(), region.holes.len())).collect()
    }

    #[test]
    fn holes_and_islands_are_told_apart_by_the_rule() {
        let same = [square(3.0, 1.0), square(2.0, 1.0), square(1.0, 1.0)];
        assert_eq!(areas(&same, FillRule::EvenOdd), [(36.0 - 16.0, 1), (4.0, 0)]);
        assert_eq!(areas(&same, FillRule::NonZero), [(36.0, 0)]);
        let turned = [square(1.0, 1.0), square(3.0, 1.0), square(2.0, -1.0)];
        assert_eq!(areas(&turned, FillRule::NonZero), [(4.0, 0), (20.0, 1)]);
        let equal = [square(1.0, 1.0), square(1.0, 1.0)];
        assert_eq!(areas(&equal, FillRule::NonZero), [(4.0, 0)]);
    }

    #[test]
    fn curves_beside_each_other_are_regions_of_their_own() {
        let right: Vec<Point> = square(1.0, 1.0).iter().map(|[x, y]| [x + 5.0, *y]).collect();
        let across: Vec<Point> = square(1.0, 1.0).iter().map(|[x, y]| [x + 1.0, *y]).collect();
        assert_eq!(areas(&[square(1.0, 1.0), right], FillRule::EvenOdd), [(4.0, 0), (4.0, 0)]);
        assert_eq!(areas(&[square(1.0, 1.0), across], FillRule::EvenOdd), [(4.0, 0), (4.0, 0)]);
        // A hole that touches the outline in a corner is one.
        let touching = vec![[1.0, 1.0], [0.0, 0.5], [0.5, 0.0]];
        assert_eq!(areas(&[square(1.0, 1.0), touching], FillRule::EvenOdd), [(4.0 - 0.375, 1)]);
    }
}
