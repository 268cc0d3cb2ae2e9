//! Whimsies: pieces whose outlines are given.

use super::{Tab, lock_by_tabs};
use crate::puzzle::Corner;
use crate::{Puzzle, PuzzleError};
use pompeiu_core::mesh::edit::Random;
use pompeiu_planar::{Outline, Point, distance_to_outline, resample};

/// The area of a whimsy, over the mean area of a piece.
const AREA: f64 = 2.0;

/// Arrangements that are tried, and places for each whimsy in one of them.
const ARRANGEMENTS: usize = 100;
const PLACES: usize = 40;

/// Corners of a whimsy at most: silhouettes of pictures have thousands.
const CORNERS: usize = 240;

/// Room around a whimsy, over the mean side of a piece.
const ROOM: f64 = 0.1;

/// A whimsy about the middle of its box, in steps of the lattice, and how far it reaches from there.
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

/// Outlines scaled and placed within an outline on the lattice: of some random arrangements the one with the most room around each.
///
/// # Errors
/// [`PuzzleError::Whimsy`] for one that finds no room in any.
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

/// Random places with at least some room around each, and the least room; or which of the shapes found none.
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

/// Gives borders as few tabs as hold whimsies and all else together; tabs go out of whimsies rather than into them.
pub(super) fn hold(puzzle: &mut Puzzle, tab: Tab) {
    let shapes: Vec<Option<Outline>> = (0..puzzle.pieces())
        .map(|piece| {
            puzzle.whimsies.contains(&piece).then(|| Outline::new(puzzle.outline(piece)).ok()).flatten()
        })
        .collect();
    lock_by_tabs(puzzle, tab, &|piece, p| shapes[piece].as_ref().is_some_and(|shape| shape.contains(p)));
}
