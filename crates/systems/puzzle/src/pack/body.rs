//! Pieces on a strip, and how deep they lie in each other.

use super::field::Field;
use pompeiu_planar::{Point, bounds};

/// A piece about its middle.
pub(super) struct Body {
    /// Its path.
    pub(super) path: Vec<Point>,
    /// The point that is its origin.
    pub(super) middle: Point,
    /// The distance of its farthest corner.
    pub(super) radius: f64,
    /// Points of its path, and the circle around each few of them.
    samples: Vec<Point>,
    groups: Vec<(Point, f64)>,
    field: Field,
}

/// Distance of the samples along straight parts, and of the nodes of fields, relative to the side of a piece.
const SAMPLES: f64 = 0.09;
const NODES: f64 = 1.0 / 32.0;

/// The distance of corners that are no samples from the segments between samples, relative to the side of a piece.
const FLAT: f64 = 2e-3;

impl Body {
    /// A path, with distances up to a distance from it.
    pub(super) fn new(path: &[Point], away: f64, unit: f64) -> Self {
        let [low, high] = bounds(path);
        let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
        let path: Vec<Point> = path.iter().map(|p| [p[0] - middle[0], p[1] - middle[1]]).collect();
        let radius = path.iter().map(|p| libm::hypot(p[0], p[1])).fold(0.0, f64::max);
        let samples = samples(&path, unit);
        let groups: Vec<(Point, f64)> = samples.chunks(GROUP).map(circle).collect();
        let largest = groups.iter().map(|(_, radius)| *radius).fold(0.0, f64::max);
        let field = Field::new(&path, away + largest, NODES * unit);
        Self { path, middle, radius, samples, groups, field }
    }
}

/// Points for which one look at a field may tell that all are far.
const GROUP: usize = 5;

/// A circle around points.
fn circle(points: &[Point]) -> (Point, f64) {
    let [low, high] = bounds(points);
    let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
    let radius = points.iter().map(|p| libm::hypot(p[0] - middle[0], p[1] - middle[1])).fold(0.0, f64::max);
    (middle, radius)
}

/// Corners and points between them that follow a path.
fn samples(path: &[Point], unit: f64) -> Vec<Point> {
    let corners = flattened(path, FLAT * unit);
    let mut found = Vec::new();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let parts = (libm::hypot(b[0] - a[0], b[1] - a[1]) / (SAMPLES * unit)).ceil().max(1.0);
        found.extend((0..parts as usize).map(|i| {
            let t = i as f64 / parts;
            [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])]
        }));
    }
    found
}

/// The corners without those that are within a distance of the segments between the others.
fn flattened(path: &[Point], within: f64) -> Vec<Point> {
    let mut kept = vec![path[0]];
    let mut from = 0;
    for to in 2..=path.len() {
        let (a, b) = (path[from], path[to % path.len()]);
        let is_flat = path[from + 1..to].iter().all(|p| {
            let (u, v) = ([b[0] - a[0], b[1] - a[1]], [p[0] - a[0], p[1] - a[1]]);
            let along = u[0] * v[0] + u[1] * v[1];
            let norm_sq = u[0] * u[0] + u[1] * u[1];
            let across = u[0] * v[1] - u[1] * v[0];
            (0.0..=norm_sq).contains(&along) && across * across <= within * within * norm_sq
        });
        if !is_flat {
            from = to - 1;
            kept.push(path[from]);
        }
    }
    kept
}

/// Where a piece lies: turned about its middle, which is moved.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pose {
    pub(super) at: Point,
    pub(super) angle: f64,
    /// Cosine and sine of the angle.
    turn: Point,
}

impl Pose {
    pub(super) fn new(at: Point, angle: f64) -> Self {
        let (sine, cosine) = libm::sincos(angle);
        Self { at, angle, turn: [cosine, sine] }
    }

    #[inline]
    fn turned(&self, [x, y]: Point) -> Point {
        let [c, s] = self.turn;
        [c * x - s * y, s * x + c * y]
    }

    #[inline]
    fn turned_back(&self, [x, y]: Point) -> Point {
        let [c, s] = self.turn;
        [c * x + s * y, c * y - s * x]
    }

    #[inline]
    pub(super) fn apply(&self, p: Point) -> Point {
        let [x, y] = self.turned(p);
        [x + self.at[0], y + self.at[1]]
    }
}

/// What overlaps add up to for one piece.
pub(super) trait Sum: Default {
    /// A point too deep by some length, the derivative of that by the displacement of the piece, and where the point lies from its middle.
    fn add(&mut self, depth: f64, slope: Point, arm: Point);
}

/// The sum of squared depths.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Energy(pub(super) f64);

impl Sum for Energy {
    #[inline]
    fn add(&mut self, depth: f64, _: Point, _: Point) {
        self.0 += depth * depth;
    }
}

/// The sum of squared depths with its derivatives by displacement and turn, and those of second order as Gauss and Newton have them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Push {
    pub(super) energy: f64,
    pub(super) deepest: f64,
    gradient: [f64; 3],
    matrix: [[f64; 3]; 3],
}

impl Sum for Push {
    #[inline]
    fn add(&mut self, depth: f64, slope: Point, arm: Point) {
        let row = [slope[0], slope[1], arm[0] * slope[1] - arm[1] * slope[0]];
        self.energy += depth * depth;
        self.deepest = self.deepest.max(depth);
        for k in 0..3 {
            self.gradient[k] += depth * row[k];
            for l in 0..3 {
                self.matrix[k][l] += row[k] * row[l];
            }
        }
    }
}

impl Push {
    pub(super) fn add_weighted(&mut self, other: &Self, weight: f64) {
        self.energy += weight * other.energy;
        self.deepest = self.deepest.max(other.deepest);
        for k in 0..3 {
            self.gradient[k] += weight * other.gradient[k];
            for l in 0..3 {
                self.matrix[k][l] += weight * other.matrix[k][l];
            }
        }
    }

    /// The step to the least sum, with some damping: a displacement, and an angle times a length.
    pub(super) fn step(&self, length: f64, damping: f64) -> [f64; 3] {
        let mut m = self.matrix;
        let mut g = self.gradient;
        let scale = [1.0, 1.0, 1.0 / length];
        for k in 0..3 {
            g[k] *= scale[k];
            for l in 0..3 {
                m[k][l] *= scale[k] * scale[l];
            }
        }
        let trace = m[0][0] + m[1][1] + m[2][2];
        if trace <= 0.0 {
            return [0.0; 3];
        }
        for (k, row) in m.iter_mut().enumerate() {
            row[k] += damping * trace;
        }
        // The matrix is positive definite.
        let minor = |a: usize, b: usize, c: usize, d: usize| m[a][c] * m[b][d] - m[a][d] * m[b][c];
        let inverse = [
            [minor(1, 2, 1, 2), -minor(0, 2, 1, 2), minor(0, 1, 1, 2)],
            [-minor(1, 2, 0, 2), minor(0, 2, 0, 2), -minor(0, 1, 0, 2)],
            [minor(1, 2, 0, 1), -minor(0, 2, 0, 1), minor(0, 1, 0, 1)],
        ];
        let whole = m[0][0] * inverse[0][0] + m[0][1] * inverse[1][0] + m[0][2] * inverse[2][0];
        inverse.map(|row| -(row[0] * g[0] + row[1] * g[1] + row[2] * g[2]) / whole)
    }
}

/// Whether circles around two pieces are nearer than a gap.
#[inline]
pub(super) fn is_near([a, b]: [&Body; 2], [p, q]: [&Pose; 2], gap: f64) -> bool {
    let between = [p.at[0] - q.at[0], p.at[1] - q.at[1]];
    let reach = a.radius + b.radius + gap;
    between[0] * between[0] + between[1] * between[1] < reach * reach
}

/// Adds what two pieces do to the first one, where they are nearer than a gap.
#[inline]
pub(super) fn pair<S: Sum>([a, b]: [&Body; 2], [p, q]: [&Pose; 2], gap: f64, sum: &mut S) {
    let between = [p.at[0] - q.at[0], p.at[1] - q.at[1]];
    // Points of the first in the second.
    let relative = Pose { at: q.turned_back(between), angle: 0.0, turn: q.turned_back(p.turn) };
    near(a, b, &relative, gap, |sample, _, distance, slope| {
        let [x, y] = q.turned(slope);
        sum.add(gap - distance, [-x, -y], p.turned(sample));
    });
    // Points of the second in the first: they stay where they are, and the first moves.
    let back = [-between[0], -between[1]];
    let relative = Pose { at: p.turned_back(back), angle: 0.0, turn: p.turned_back(q.turn) };
    near(b, a, &relative, gap, |_, local, distance, slope| {
        sum.add(gap - distance, p.turned(slope), p.turned(local));
    });
}

/// Visits all samples of a piece that are nearer to another than a gap: the sample, where it lies in the other, its distance and the
/// gradient of that.
#[inline]
fn near(a: &Body, b: &Body, pose: &Pose, gap: f64, mut visit: impl FnMut(Point, Point, f64, Point)) {
    for (samples, (middle, radius)) in a.samples.chunks(GROUP).zip(&a.groups) {
        // No distance differs more than that of the points.
        if b.field.least(pose.apply(*middle)) >= gap + radius {
            continue;
        }
        for sample in samples {
            let local = pose.apply(*sample);
            if let Some((distance, slope)) = b.field.at(local)
                && distance < gap
            {
                visit(*sample, local, distance, slope);
            }
        }
    }
}

/// Adds what the edges of a strip do to a piece that is nearer than a gap.
#[inline]
pub(super) fn edges<S: Sum>(a: &Body, p: &Pose, [width, length]: [f64; 2], gap: f64, sum: &mut S) {
    let reach = a.radius + gap;
    if (p.at[0] >= reach && p.at[0] <= width - reach) && (p.at[1] >= reach && p.at[1] <= length - reach) {
        return;
    }
    for sample in &a.samples {
        let arm = p.turned(*sample);
        let [x, y] = [arm[0] + p.at[0], arm[1] + p.at[1]];
        for (depth, slope) in [
            (gap - x, [-1.0, 0.0]),
            (gap + x - width, [1.0, 0.0]),
            (gap - y, [0.0, -1.0]),
            (gap + y - length, [0.0, 1.0]),
        ] {
            if depth > 0.0 {
                sum.add(depth, slope, arm);
            }
        }
    }
}
