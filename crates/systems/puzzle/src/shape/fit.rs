//! The similarity of each piece to the shape.

use super::pose::Pose;
use super::target::Target;
use crate::Puzzle;
use pompeiu_planar::{Outline, Point, hausdorff, intersection_area};
use rayon::prelude::*;

/// The shape in its best pose on a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// The pose of the shape of area 1 times the scale, in the unit of the outline.
    pub pose: Pose,
    /// The scale: the square root of its area.
    pub scale: f64,
    /// Intersection over union: the common area over the area of the union.
    pub iou: f64,
    /// The Pompeiu–Hausdorff distance of the two curves.
    pub hausdorff: f64,
}

/// Initial steps of the search, relative to the size of the piece: two coordinates, angle, scale; and the number of halvings.
const STEPS: [f64; 4] = [0.05, 0.05, 0.1, 0.05];
const HALVINGS: usize = 5;

/// Copies that are tried on a piece.
const NEAR: usize = 4;

/// Details of curves that the search ignores, relative to the size of the piece.
const DETAIL: f64 = 0.004;

/// The best similarity found for each piece: starting from the nearest copies, by a coordinate search on the common area.
///
/// # Accuracy
/// The areas are exact but for rounding. The pose is not proven to be the best, so the true similarity is at least the given one.
pub(super) fn fits(puzzle: &Puzzle, target: &Target, poses: &[Pose]) -> Vec<Option<Fit>> {
    let few = simple(&target.outline, DETAIL);
    (0..puzzle.pieces())
        .into_par_iter()
        .map(|piece| {
            let outline = Outline::new(puzzle.outline(piece)).ok()?;
            let size = outline.area().sqrt();
            let rough = simple(&outline, DETAIL * size);
            let centre = outline.centroid();
            let away = |pose: &Pose| libm::hypot(pose.place[0] - centre[0], pose.place[1] - centre[1]);
            let mut near: Vec<Pose> = poses.to_vec();
            near.sort_by(|a, b| away(a).total_cmp(&away(b)));
            near.truncate(NEAR);
            let likeness = |a: &Outline, b: &Outline| {
                let common = intersection_area(a, b);
                common / (a.area() + b.area() - common)
            };
            let value = |shape: &Outline, piece: &Outline, pose: &Pose, scale: f64| {
                pose.apply(shape, scale).map_or(0.0, |moved| likeness(&moved, piece))
            };
            let starts = near.iter().map(|pose| (value(&few, &rough, pose, size), *pose));
            let (iou, pose) = starts.max_by(|a, b| a.0.total_cmp(&b.0))?;
            let (pose, scale) = search(pose, size, iou, |pose, scale| value(&few, &rough, pose, scale));
            let moved = pose.apply(&target.outline, scale).ok()?;
            Some(Fit { pose, scale, iou: likeness(&moved, &outline), hausdorff: hausdorff(&moved, &outline) })
        })
        .collect()
}

fn search(pose: Pose, size: f64, iou: f64, value: impl Fn(&Pose, f64) -> f64) -> (Pose, f64) {
    let (mut best, mut pose, mut scale) = (iou, pose, size);
    let mut factor = 1.0;
    for _ in 0..=HALVINGS {
        let mut improved = true;
        while improved {
            improved = false;
            for k in 0..4 {
                for sign in [1.0, -1.0] {
                    let step = sign * factor * STEPS[k];
                    let (mut to, mut new_scale) = (pose, scale);
                    match k {
                        0 | 1 => to.place[k] += step * size,
                        2 => to.angle += step,
                        _ => new_scale *= 1.0 + step,
                    }
                    let found = value(&to, new_scale);
                    if found > best {
                        (best, pose, scale) = (found, to, new_scale);
                        improved = true;
                        break;
                    }
                }
            }
        }
        factor *= 0.5;
    }
    (pose, scale)
}

/// An outline without details below a distance.
fn simple(outline: &Outline, distance: f64) -> Outline {
    let points = outline.points();
    // Closed: simplified from the first corner to the one farthest from it and back.
    let far = |p: &Point| libm::hypot(p[0] - points[0][0], p[1] - points[0][1]);
    let middle = (0..points.len()).max_by(|i, j| far(&points[*i]).total_cmp(&far(&points[*j]))).unwrap_or(0);
    let mut closed = points.to_vec();
    closed.push(points[0]);
    let mut kept = crate::puzzle::simplify_points(&closed[..=middle], distance);
    kept.pop();
    kept.extend(crate::puzzle::simplify_points(&closed[middle..], distance));
    kept.pop();
    Outline::new(kept).unwrap_or_else(|_| outline.clone())
}
