//! Where the pieces of a drawing lie.

use super::options::PieceDrawing;
use crate::pack::path;
use crate::{Place, Puzzle};
use pompeiu_planar::{Point, segments_meet};

/// Pieces as drawn: their paths, in place, where those are moved to, and the area that the drawing shows: its corner and its size.
pub(super) struct Laid {
    pub(super) paths: Vec<Vec<Point>>,
    pub(super) places: Vec<Place>,
    pub(super) area: [Point; 2],
}

/// Displacements tried grow by this factor, and start with it.
const FIRST_PULL: f64 = 0.1;
const NEXT_PULL: f64 = 1.2;
const MOST_PULL: f64 = 8.0;

/// What is empty around the pieces, relative to the longer side of the puzzle.
const MARGIN: f64 = 0.03;

/// The area of a puzzle with pieces pulled apart.
pub(super) fn around(puzzle: &Puzzle, pull: f64) -> [Point; 2] {
    let [width, height] = puzzle.size();
    let margin = MARGIN * width.max(height);
    let [x, y] = [0.5 * width * pull + margin, 0.5 * height * pull + margin];
    [[-x, -y], [width + 2.0 * x, height + 2.0 * y]]
}

impl Laid {
    pub(super) fn new(puzzle: &Puzzle, drawing: &PieceDrawing<'_>) -> Self {
        let pieces = 0..puzzle.pieces();
        let is_in_place = drawing.packing.is_none() && drawing.pull <= 0.0;
        let kerf = if is_in_place { 0.0 } else { drawing.kerf };
        let paths: Vec<Vec<Point>> = pieces.map(|piece| path(puzzle, piece, kerf)).collect();
        if let Some(packing) = drawing.packing {
            return Self { paths, places: packing.places.clone(), area: [[0.0; 2], packing.sheet] };
        }
        let mut pull = drawing.pull.max(0.0);
        let mut laid = Self { places: pulled(puzzle, &paths, pull), paths, area: [[0.0; 2]; 2] };
        if !is_in_place {
            pull = pull.max(FIRST_PULL);
            laid.places = pulled(puzzle, &laid.paths, pull);
            while pull < MOST_PULL && laid.meet() {
                pull *= NEXT_PULL;
                laid.places = pulled(puzzle, &laid.paths, pull);
            }
        }
        laid.area = around(puzzle, pull);
        laid
    }

    /// The path of a piece where it lies.
    pub(super) fn path(&self, piece: usize) -> Vec<Point> {
        self.paths[piece].iter().map(|p| self.places[piece].apply(*p)).collect()
    }

    /// Whether two paths meet.
    fn meet(&self) -> bool {
        let moved: Vec<Vec<Point>> = (0..self.paths.len()).map(|piece| self.path(piece)).collect();
        let sides = |path: &[Point], i: usize| [path[i], path[(i + 1) % path.len()]];
        let is_apart = |[a, b]: [Point; 2], [c, d]: [Point; 2]| {
            (0..2).any(|k| a[k].max(b[k]) < c[k].min(d[k]) || c[k].max(d[k]) < a[k].min(b[k]))
        };
        let bounds: Vec<[Point; 2]> = moved
            .iter()
            .map(|path| {
                path.iter().fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], p| {
                    [[0, 1].map(|k| low[k].min(p[k])), [0, 1].map(|k| high[k].max(p[k]))]
                })
            })
            .collect();
        (0..moved.len()).any(|a| {
            (0..a).any(|b| {
                !is_apart(bounds[a], bounds[b])
                    && (0..moved[a].len()).any(|i| {
                        let side = sides(&moved[a], i);
                        !is_apart(side, bounds[b])
                            && (0..moved[b].len()).any(|k| segments_meet(side, sides(&moved[b], k)))
                    })
            })
        })
    }
}

/// Pieces pulled away from the middle, by a factor of their distance from there.
fn pulled(puzzle: &Puzzle, paths: &[Vec<Point>], pull: f64) -> Vec<Place> {
    let size = puzzle.size();
    let middle = |points: &[Point], k: usize| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64;
    let shift = |points: &Vec<Point>| [0, 1].map(|k| pull * (middle(points, k) - 0.5 * size[k]));
    paths.iter().map(|points| Place { turn: 0.0, shift: shift(points) }).collect()
}
