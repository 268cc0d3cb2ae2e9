//! Whimsies: pieces with given outlines.

use super::{Tab, lock_by_tabs};
use crate::space::Corner;
use crate::{Puzzle, PuzzleError};
use pompeiu_core::mesh::edit::Random;
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, Point, distance_to_outline, resample};

/// The area of a whimsy, relative to the mean area of a piece.
const AREA: f64 = 2.0;

/// Arrangements to try, and positions for each whimsy in an arrangement.
const ARRANGEMENTS: usize = 100;
const PLACES: usize = 40;

/// Largest number of corners of a whimsy: silhouettes of pictures have thousands.
const CORNERS: usize = 240;

/// Clearance around a whimsy, relative to the mean side of a piece.
const ROOM: f64 = 0.1;

/// A whimsy about the centre of its bounding box, in lattice steps, with its radius.
struct Shape {
    corners: Vec<Point>,
    radius: f64,
}

impl Shape {
    fn new(whimsy: &Outline, unit: f64) -> Self {
        let scale = (AREA / whimsy.area()).sqrt() * unit;
        let is_fine = whimsy.points().len() > CORNERS;
        let few = if is_fine { resample(whimsy, CORNERS, 0) } else { whimsy.points().to_vec() };
        let [[left, low], [right, high]] = whimsy.bounds();
        let middle = [0.5 * (left + right), 0.5 * (low + high)];
        let corners: Vec<Point> = few.iter().map(|p| [0, 1].map(|k| scale * (p[k] - middle[k]))).collect();
        let radius = corners.iter().map(|p| libm::hypot(p[0], p[1])).fold(0.0, f64::max);
        Self { corners, radius }
    }
}

/// Scales outlines and places them within an outline on the lattice: of some random arrangements, the one with the largest
/// clearance.
///
/// # Errors
/// [`PuzzleError::Whimsy`] for a whimsy that fits in no arrangement.
pub(super) fn placed(
    whimsies: &[Outline],
    outline: &Outline,
    pieces: usize,
    random: &mut Random,
) -> Result<Vec<Vec<Corner>>, PuzzleError> {
    if whimsies.is_empty() {
        return Ok(Vec::new());
    }
    let unit = (outline.area() / pieces as f64).sqrt();
    let shapes: Vec<Shape> = whimsies.iter().map(|whimsy| Shape::new(whimsy, unit)).collect();
    let mut best: Option<(f64, Vec<Point>)> = None;
    let mut reached = 0;
    for _ in 0..ARRANGEMENTS {
        match arrangement(&shapes, outline, ROOM * unit, random) {
            Ok((room, places)) if best.as_ref().is_none_or(|(most, _)| room > *most) => {
                best = Some((room, places));
            }
            Ok(_) => (),
            Err(index) => reached = reached.max(index),
        }
    }
    let Some((_, places)) = best else { return Err(PuzzleError::Whimsy { index: reached }) };
    let at = |(shape, place): (&Shape, Point)| {
        let mut corners: Vec<Corner> =
            shape.corners.iter().map(|p| [0, 1].map(|k| (place[k] + p[k]).round() as i64)).collect();
        corners.dedup();
        corners
    };
    Ok(shapes.iter().zip(places).map(at).collect())
}

/// Random positions with at least some clearance around each, and the smallest clearance; or the shape that did not fit.
fn arrangement(
    shapes: &[Shape],
    outline: &Outline,
    least: f64,
    random: &mut Random,
) -> Result<(f64, Vec<Point>), usize> {
    let [low, high] = outline.bounds();
    let (mut taken, mut narrowest) = (Vec::<Point>::new(), f64::INFINITY);
    for (index, shape) in shapes.iter().enumerate() {
        let mut tries = 0;
        let (room, place) = loop {
            let p = [0, 1].map(|k| low[k] + (high[k] - low[k]) * (0.5 + 0.5 * random.signed_unit()));
            let others = taken
                .iter()
                .zip(shapes)
                .map(|(q, other)| libm::hypot(p[0] - q[0], p[1] - q[1]) - other.radius);
            let room = others.fold(distance_to_outline(p, outline), f64::min) - shape.radius;
            if room > least && outline.contains(p) {
                break (room, p);
            }
            tries += 1;
            if tries == PLACES {
                return Err(index);
            }
        };
        narrowest = narrowest.min(room);
        taken.push(place);
    }
    Ok((narrowest, taken))
}

/// Adds the fewest tabs that hold whimsies and all other pieces together; tabs preferably extend out of whimsies, not into them.
pub(super) fn hold(puzzle: &mut Puzzle, tab: Tab, neck: f64, control: &Control) {
    let shapes: Vec<Option<Outline>> = (0..puzzle.pieces())
        .map(|piece| {
            puzzle.whimsies.contains(&piece).then(|| Outline::new(puzzle.outline(piece)).ok()).flatten()
        })
        .collect();
    lock_by_tabs(puzzle, (tab, &[neck]), control, &|piece, p| {
        shapes[piece].as_ref().is_some_and(|shape| shape.contains(p))
    });
}
