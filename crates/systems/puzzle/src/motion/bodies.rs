//! Pieces as rigid bodies, and the separation of overlapping ones.

use crate::Puzzle;
use pompeiu_planar::{Outline, Point};

/// Distance of sample points along the sides of a piece, relative to the mean side of a piece.
const SPACING: f64 = 0.12;

/// Tolerated overlap, relative to the mean side of a piece.
pub(super) const TOUCH: f64 = 1e-4;

/// The pose of a piece: the displacement of its centroid, and its rotation about it.
pub(super) type Place = [f64; 3];

/// The pieces of a puzzle as movable bodies.
pub(super) struct Bodies {
    shapes: Vec<Shape>,
    pub(super) unit: f64,
}

struct Shape {
    centre: Point,
    /// Relative to the centroid.
    outline: Outline,
    points: Vec<Point>,
    bounds: [Point; 2],
    radius: f64,
    /// The squared radius of gyration of its corners.
    gyration: f64,
}

/// A pose with its sine and cosine.
#[derive(Clone, Copy)]
struct Turned {
    at: Point,
    cosine: f64,
    sine: f64,
}

impl Turned {
    fn of(shape: &Shape, place: Place) -> Self {
        let (sine, cosine) = libm::sincos(place[2]);
        Self { at: [shape.centre[0] + place[0], shape.centre[1] + place[1]], cosine, sine }
    }

    fn arm(self, [x, y]: Point) -> Point {
        [self.cosine * x - self.sine * y, self.sine * x + self.cosine * y]
    }

    fn back(self, p: Point) -> Point {
        let [x, y] = [p[0] - self.at[0], p[1] - self.at[1]];
        [self.cosine * x + self.sine * y, self.cosine * y - self.sine * x]
    }
}

impl Bodies {
    /// `None` if a piece has no area.
    pub(super) fn new(puzzle: &Puzzle) -> Option<Self> {
        let unit = puzzle.unit();
        let shapes: Option<Vec<Shape>> =
            (0..puzzle.pieces()).map(|piece| Shape::new(&puzzle.outline(piece), SPACING * unit)).collect();
        Some(Self { shapes: shapes?, unit })
    }

    /// Separates overlapping pieces, pair by pair, in at most `rounds` rounds. Returns the greatest depth found in the last round.
    ///
    /// Fixed pieces stay. Pairs are skipped if both are fixed or neither has moved.
    pub(super) fn relax(&self, places: &mut [Place], is_fixed: &[bool], rounds: usize) -> f64 {
        let mut deepest = 0.0;
        for _ in 0..rounds {
            deepest = 0.0_f64;
            for a in 0..places.len() {
                for b in a + 1..places.len() {
                    let is_still = |i: usize| is_fixed[i] || places[i] == [0.0; 3];
                    if (is_fixed[a] && is_fixed[b])
                        || (is_still(a) && is_still(b))
                        || !self.is_near(places, a, b)
                    {
                        continue;
                    }
                    deepest = deepest.max(self.push(places, is_fixed, [a, b]));
                    deepest = deepest.max(self.push(places, is_fixed, [b, a]));
                }
            }
            if deepest <= TOUCH * self.unit {
                break;
            }
        }
        deepest
    }

    fn is_near(&self, places: &[Place], a: usize, b: usize) -> bool {
        let [p, q] = [a, b].map(|i| Turned::of(&self.shapes[i], places[i]).at);
        let reach = self.shapes[a].radius + self.shapes[b].radius;
        libm::hypot(p[0] - q[0], p[1] - q[1]) < reach
    }

    /// Pushes a piece out of another one at each of its points that lies inside. Returns the greatest depth.
    fn push(&self, places: &mut [Place], is_fixed: &[bool], [from, to]: [usize; 2]) -> f64 {
        let (a, b) = (&self.shapes[from], &self.shapes[to]);
        let mut deepest = 0.0_f64;
        let mut turned = [Turned::of(a, places[from]), Turned::of(b, places[to])];
        for p in &a.points {
            let arm = turned[0].arm(*p);
            let place = [turned[0].at[0] + arm[0], turned[0].at[1] + arm[1]];
            let q = turned[1].back(place);
            if (0..2).any(|k| q[k] <= b.bounds[0][k] || q[k] >= b.bounds[1][k]) {
                continue;
            }
            let Some((depth, out)) = b.depth(q) else { continue };
            deepest = deepest.max(depth);
            if depth <= 0.5 * TOUCH * self.unit {
                continue;
            }
            let out = turned[1].arm(out);
            let arms = [arm, [place[0] - turned[1].at[0], place[1] - turned[1].at[1]]];
            let lever = arms.map(|r| r[0] * out[1] - r[1] * out[0]);
            // The displacement of the point per unit of impulse, for each body; zero for fixed ones.
            let ease = [0, 1].map(|k| {
                let (i, shape) = ([from, to][k], [a, b][k]);
                if is_fixed[i] { 0.0 } else { 1.0 + lever[k] * lever[k] / shape.gyration }
            });
            let push = depth / (ease[0] + ease[1]);
            for (k, sign) in [(0, push), (1, -push)] {
                let (i, shape) = ([from, to][k], [a, b][k]);
                if !is_fixed[i] {
                    let change = [sign * out[0], sign * out[1], sign * lever[k] / shape.gyration];
                    (0..3).for_each(|axis| places[i][axis] += change[axis]);
                    turned[k] = Turned::of(shape, places[i]);
                }
            }
        }
        deepest
    }

    /// The radius of gyration of a piece, which makes rotations comparable with translations.
    pub(super) fn gyration(&self, piece: usize) -> f64 {
        self.shapes[piece].gyration.sqrt()
    }

    /// The centroid of a piece in the assembled puzzle.
    pub(super) fn centre(&self, piece: usize) -> Point {
        self.shapes[piece].centre
    }

    /// Whether the bounding boxes of two pieces overlap.
    pub(super) fn meet(&self, places: &[Place], [a, b]: [usize; 2]) -> bool {
        let bounds = |i: usize| {
            let turned = Turned::of(&self.shapes[i], places[i]);
            self.shapes[i].outline.points().iter().fold(
                [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]],
                |[low, high], p| {
                    let arm = turned.arm(*p);
                    let q = [0, 1].map(|k| turned.at[k] + arm[k]);
                    [[0, 1].map(|k| low[k].min(q[k])), [0, 1].map(|k| high[k].max(q[k]))]
                },
            )
        };
        let [[low, high], [l, h]] = [bounds(a), bounds(b)];
        (0..2).all(|k| low[k] < h[k] && l[k] < high[k])
    }
}

impl Shape {
    fn new(outline: &[Point], spacing: f64) -> Option<Self> {
        let outline = Outline::new(outline.to_vec()).ok()?;
        let centre = outline.centroid();
        let outline = outline.map(|p| [p[0] - centre[0], p[1] - centre[1]]).ok()?;
        let mut points = Vec::new();
        for [a, b] in outline.sides() {
            let count = (libm::hypot(b[0] - a[0], b[1] - a[1]) / spacing).ceil().max(2.0) as usize;
            points.extend((0..count).map(|i| {
                let s = i as f64 / count as f64;
                [0, 1].map(|k| a[k] + s * (b[k] - a[k]))
            }));
        }
        let squares = points.iter().map(|p| p[0] * p[0] + p[1] * p[1]);
        let radius = squares.clone().fold(0.0, f64::max).sqrt();
        let gyration = squares.sum::<f64>() / points.len() as f64;
        Some(Self { centre, bounds: outline.bounds(), outline, points, radius, gyration })
    }

    /// The depth of a point inside, and the direction out; `None` outside.
    fn depth(&self, p: Point) -> Option<(f64, Point)> {
        if !self.outline.contains(p) {
            return None;
        }
        let mut best = (f64::INFINITY, [0.0; 2]);
        for [a, b] in self.outline.sides() {
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
            let t = ((u[0] * v[0] + u[1] * v[1]) / (u[0] * u[0] + u[1] * u[1])).clamp(0.0, 1.0);
            let w = [t * u[0] - v[0], t * u[1] - v[1]];
            let square = w[0] * w[0] + w[1] * w[1];
            if square < best.0 {
                best = (square, w);
            }
        }
        let depth = best.0.sqrt();
        (depth > 0.0).then(|| (depth, best.1.map(|x| x / depth)))
    }
}
