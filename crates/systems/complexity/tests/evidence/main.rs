//! Evidence that does not come from the code: closed forms, invariances, brute force, published arithmetic.

#![allow(clippy::unwrap_used, reason = "tests may panic")]

mod clusters;
mod measures;
mod pictures;
mod rankings;
mod requests;

use pompeiu_planar::{Outline, Point};

fn circle(corners: usize) -> Outline {
    let at = |i: usize| {
        let angle = std::f64::consts::TAU * i as f64 / corners as f64;
        [angle.cos(), angle.sin()]
    };
    Outline::new((0..corners).map(at).collect()).unwrap()
}

/// The outline rotated, scaled, translated, and starting at another corner.
fn elsewhere(outline: &Outline, angle: f64, scale: f64, shift: Point, start: usize) -> Outline {
    let (s, c) = angle.sin_cos();
    let mut points: Vec<Point> = outline
        .points()
        .iter()
        .map(|[x, y]| [shift[0] + scale * (c * x - s * y), shift[1] + scale * (s * x + c * y)])
        .collect();
    points.rotate_left(start % outline.points().len());
    Outline::new(points).unwrap()
}
