//! Generated shapes of growing complexity, the same for the same seed on every machine.

use crate::ComplexityError;
use pompeiu_core::mesh::edit::Random;
use pompeiu_planar::contour::staircases;
use pompeiu_planar::{Outline, Point, catmull_rom};

/// The order in which a curve passes through its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointOrder {
    /// The order in which they were drawn: the curve may cross itself.
    Random,
    /// By direction from their mean.
    Angle,
}

/// Approximate number of points of a curve.
const CURVE_POINTS: usize = 4000;

/// The closed Catmull–Rom curve through points drawn uniformly from the unit square. More points give a more complex shape.
///
/// # Errors
/// [`ComplexityError::Option`] for fewer than 3 or more than 1000 points; [`ComplexityError::Outline`] if they enclose no area.
pub fn polyline(points: usize, seed: u64, order: PointOrder) -> Result<Outline, ComplexityError> {
    if !(3..=1000).contains(&points) {
        return Err(ComplexityError::Option {
            what: "number of points",
            value: points as f64,
            expected: "it must lie between 3 and 1000",
        });
    }
    let mut random = Random::new(seed);
    let mut unit = || 0.5 + 0.5 * random.signed_unit();
    let mut through: Vec<Point> = (0..points).map(|_| [unit(), unit()]).collect();
    if order == PointOrder::Angle {
        let n = points as f64;
        let mean = [0, 1].map(|k| through.iter().map(|p| p[k]).sum::<f64>() / n);
        let angle = |p: &Point| libm::atan2(p[1] - mean[1], p[0] - mean[0]);
        through.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    }
    Ok(Outline::new(catmull_rom(&through, CURVE_POINTS.div_ceil(points)))?)
}

/// A disc of pixels extended by random walks. Level 0 is the disc; each level starts a walk at every border pixel, straight in a
/// random one of the four directions, with a random number of steps up to `steps`, and adds the pixels visited.
///
/// # Shapes and units
/// In pixels. The outline runs along pixel sides around the part that contains the centre, without the holes.
///
/// # Errors
/// [`ComplexityError::Option`] for a radius below 2 or above 2000, more than 64 levels, or walks longer than the radius.
pub fn noisy_circle(radius: u32, level: u32, steps: u32, seed: u64) -> Result<Outline, ComplexityError> {
    let out_of_range =
        |what, value: u32, expected| Err(ComplexityError::Option { what, value: f64::from(value), expected });
    if !(2..=2000).contains(&radius) {
        return out_of_range("radius", radius, "it must lie between 2 and 2000 pixels");
    }
    if level > 64 {
        return out_of_range("level", level, "it must be at most 64");
    }
    if !(1..=radius).contains(&steps) {
        return out_of_range("length of walks", steps, "it must be at least 1, and at most the radius");
    }
    let reach = (radius + level * steps + 2) as usize;
    let width = 2 * reach + 1;
    let square = |i: usize| (i.abs_diff(reach)).pow(2);
    let is_inside = |i: usize| square(i % width) + square(i / width) <= (radius as usize).pow(2);
    let mut pixels: Vec<f32> = (0..width * width).map(|i| if is_inside(i) { 1.0 } else { 0.0 }).collect();
    let mut random = Random::new(seed);
    let neighbours = [1, -1, width.cast_signed(), -width.cast_signed()];
    for _ in 0..level {
        let is_border = |i: &usize| {
            pixels[*i] > 0.5 && neighbours.iter().any(|step| pixels[i.wrapping_add_signed(*step)] < 0.5)
        };
        let border: Vec<usize> = (0..pixels.len()).filter(is_border).collect();
        for mut at in border {
            let step = neighbours[random.below(4) as usize];
            for _ in 0..random.below(steps + 1) {
                at = at.wrapping_add_signed(step);
                pixels[at] = 1.0;
            }
        }
    }
    let found = staircases(&pixels, width, 0.5);
    let outlines = found.into_iter().filter_map(|contour| Outline::new(contour.points).ok());
    let largest = outlines.max_by(|a, b| a.area().total_cmp(&b.area()));
    largest.ok_or(ComplexityError::Empty)
}
