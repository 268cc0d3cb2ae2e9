//! How much of simple enclosing shapes an outline fills, and measures of the whole shape.

use super::sampling::{closed_length, distance};
use pompeiu_core::mesh::edit::Random;
use pompeiu_planar::{Outline, Point};
use std::f64::consts::{FRAC_PI_4, PI};

/// The area relative to that of simple enclosing shapes: near 1 for simple shapes.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Coverage {
    /// Area over that of the convex hull.
    pub hull: f64,
    /// Area over that of the smallest enclosing rectangle of any orientation.
    pub rectangle: f64,
    /// Area over that of the smallest enclosing circle.
    pub circle: f64,
}

/// Measures of the whole shape.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Global {
    /// 4π area over length squared: 1 for a circle, less for all other shapes.
    pub compactness: f64,
    /// The length of the convex hull over that of the outline: 1 for convex shapes.
    pub convexity: f64,
    /// The shorter over the longer side of the smallest enclosing rectangle.
    pub aspect: f64,
    /// π/4 times the square of the diameter (the greatest distance of two points), over the area: 1 for a circle.
    pub diameter: f64,
}

impl Coverage {
    pub(super) fn of(outline: &Outline) -> Self {
        let hull = outline.hull();
        let area = outline.area();
        let [a, b] = least_rectangle(&hull);
        let radius = least_circle(&hull).1;
        Self {
            hull: area / polygon_area(&hull),
            rectangle: area / (a * b),
            circle: area / (PI * radius * radius),
        }
    }
}

impl Global {
    pub(super) fn of(outline: &Outline) -> Self {
        let hull = outline.hull();
        let (area, length) = (outline.area(), outline.length());
        let [a, b] = least_rectangle(&hull);
        let diameter = diameter(&hull);
        Self {
            compactness: 4.0 * PI * area / (length * length),
            convexity: closed_length(&hull) / length,
            aspect: if a < b { a / b } else { b / a },
            diameter: FRAC_PI_4 * diameter * diameter / area,
        }
    }
}

fn polygon_area(points: &[Point]) -> f64 {
    let origin = points[0];
    let at = |p: Point| [p[0] - origin[0], p[1] - origin[1]];
    let sum: f64 = points
        .windows(2)
        .map(|pair| {
            let [a, b] = [at(pair[0]), at(pair[1])];
            a[0] * b[1] - a[1] * b[0]
        })
        .sum();
    0.5 * sum
}

/// Relative difference below which two areas count as equal.
const SAME_AREA: f64 = 1e-12;

/// The first corner, starting from another, after which a unimodal function along a convex polygon does not increase.
fn climb(n: usize, from: usize, value: impl Fn(usize) -> f64) -> usize {
    let (mut at, mut steps) = (from, 0);
    while steps < n && value((at + 1) % n) >= value(at) {
        at = (at + 1) % n;
        steps += 1;
    }
    at
}

/// The sides of the minimum-area enclosing rectangle of a convex polygon; one of them contains a side of the polygon.
///
/// # Source
/// `toussaint_solving_1983`.
fn least_rectangle(hull: &[Point]) -> [f64; 2] {
    let n = hull.len();
    let mut best = (f64::INFINITY, [0.0_f64; 2]);
    let [mut far, mut right, mut left] = [0, 0, 0];
    for i in 0..n {
        let (a, b) = (hull[i], hull[(i + 1) % n]);
        let side = distance(a, b);
        let u = [(b[0] - a[0]) / side, (b[1] - a[1]) / side];
        let along = |k: usize| u[0] * (hull[k][0] - a[0]) + u[1] * (hull[k][1] - a[1]);
        let up = |k: usize| u[0] * (hull[k][1] - a[1]) - u[1] * (hull[k][0] - a[0]);
        right = climb(n, if i == 0 { 1 % n } else { right }, along);
        far = climb(n, if i == 0 { right } else { far }, up);
        left = climb(n, if i == 0 { far } else { left }, |k| -along(k));
        let (width, height) = (along(right) - along(left), up(far));
        // Of rectangles with equal areas the longest, so that rounding does not decide.
        let ratio = width * height / best.0;
        let is_longer = width.max(height) > best.1[0].max(best.1[1]);
        if ratio < 1.0 - SAME_AREA || (ratio <= 1.0 + SAME_AREA && is_longer) {
            best = (width * height, [width, height]);
        }
    }
    best.1
}

/// The greatest distance of two corners of a convex polygon.
fn diameter(hull: &[Point]) -> f64 {
    let n = hull.len();
    let mut far = 1 % n;
    let mut most: f64 = 0.0;
    for i in 0..n {
        let (a, b) = (hull[i], hull[(i + 1) % n]);
        far = climb(n, far, |k| (b[0] - a[0]) * (hull[k][1] - a[1]) - (b[1] - a[1]) * (hull[k][0] - a[0]));
        most = most.max(distance(a, hull[far])).max(distance(b, hull[far]));
    }
    most
}

/// The smallest enclosing circle, by incremental insertion (`welzl_smallest_1991`, without recursion).
fn least_circle(points: &[Point]) -> (Point, f64) {
    // In random order the expected cost is linear.
    let mut points = points.to_vec();
    let mut random = Random::new(points.len() as u64);
    for i in (1..points.len()).rev() {
        points.swap(i, random.below(i as u32 + 1) as usize);
    }
    let through_two = |a: Point, b: Point| ([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])], 0.5 * distance(a, b));
    let is_outside = |circle: &(Point, f64), p: Point| distance(circle.0, p) > circle.1 * (1.0 + 1e-14);
    let mut circle = (points[0], 0.0);
    for (i, &p) in points.iter().enumerate() {
        if !is_outside(&circle, p) {
            continue;
        }
        circle = (p, 0.0);
        for (j, &q) in points[..i].iter().enumerate() {
            if !is_outside(&circle, q) {
                continue;
            }
            circle = through_two(p, q);
            for &r in &points[..j] {
                if is_outside(&circle, r) {
                    circle = through_three(p, q, r).unwrap_or(circle);
                }
            }
        }
    }
    circle
}

fn through_three(a: Point, b: Point, c: Point) -> Option<(Point, f64)> {
    let centre = circumcentre(a, b, c)?;
    Some((centre, distance(a, centre)))
}

/// The circumcentre of three points; `None` if they are collinear.
pub(super) fn circumcentre(a: Point, b: Point, c: Point) -> Option<Point> {
    let (u, v) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
    let d = 2.0 * (u[0] * v[1] - u[1] * v[0]);
    let (uu, vv) = (u[0] * u[0] + u[1] * u[1], v[0] * v[0] + v[1] * v[1]);
    let centre = [a[0] + (v[1] * uu - u[1] * vv) / d, a[1] + (u[0] * vv - v[0] * uu) / d];
    centre.iter().all(|x| x.is_finite()).then_some(centre)
}
