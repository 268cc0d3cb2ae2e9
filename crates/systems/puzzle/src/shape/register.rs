//! Registration of point sets by similarities.

use super::pose::Pose;
use pompeiu_planar::Point;

/// A similarity that maps points close to others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Registered {
    /// Rotation, reflection and translation, after scaling.
    pub pose: Pose,
    /// The scale.
    pub scale: f64,
    /// The root mean square distance of the points to the nearest ones.
    pub rms: f64,
}

/// Steps before most starts are discarded, and the largest number of steps.
const FIRST_STEPS: usize = 5;
const MOST_STEPS: usize = 60;

/// Number of starts that are continued.
const KEPT: usize = 3;

/// Number of initial rotations.
const TURNS: usize = 8;

/// Ends when the error falls by less than this share.
const SETTLED: f64 = 1e-7;

/// Registers points on others by iterated closest points: repeatedly the least-squares similarity between points and their nearest
/// ones, from eight rotations.
///
/// Both sets should have about the same density everywhere; neither may be empty.
///
/// # Cost
/// Product of the numbers of points for each step.
///
/// # Source
/// `besl_method_1992`; the similarity is that of `umeyama_least_1991`, in the plane in closed form.
pub fn register(points: &[Point], to: &[Point], mirrors: bool) -> Option<Registered> {
    let (a, b) = (Spread::of(points)?, Spread::of(to)?);
    let hands: &[bool] = if mirrors { &[false, true] } else { &[false] };
    let mut starts: Vec<Registered> = Vec::new();
    for is_mirrored in hands {
        for i in 0..TURNS {
            let angle = std::f64::consts::TAU * i as f64 / TURNS as f64;
            let scale = b.size / a.size;
            let mut start = Registered {
                pose: Pose { place: [0.0; 2], angle, is_mirrored: *is_mirrored },
                scale,
                rms: f64::INFINITY,
            };
            let moved = apply(&start, a.centre);
            start.pose.place = [0, 1].map(|k| b.centre[k] - moved[k]);
            starts.push(steps(points, to, start, FIRST_STEPS));
        }
    }
    starts.sort_by(|x, y| x.rms.total_cmp(&y.rms));
    starts.truncate(KEPT);
    let ends = starts.into_iter().map(|start| steps(points, to, start, MOST_STEPS));
    ends.min_by(|x, y| x.rms.total_cmp(&y.rms))
}

/// Registration from one start.
pub(super) fn steps(points: &[Point], to: &[Point], start: Registered, most: usize) -> Registered {
    let mut now = start;
    for _ in 0..most {
        let pairs: Vec<(Point, Point)> = points
            .iter()
            .map(|p| {
                let q = apply(&now, *p);
                (*p, nearest(q, to))
            })
            .collect();
        let next = similarity(&pairs, now.pose.is_mirrored).unwrap_or(now);
        if next.rms >= (1.0 - SETTLED) * now.rms {
            return if next.rms < now.rms { next } else { now };
        }
        now = next;
    }
    now
}

fn apply(of: &Registered, p: Point) -> Point {
    let turned = of.pose.turn();
    let [x, y] = turned.vector(p.map(|x| of.scale * x));
    [of.pose.place[0] + x, of.pose.place[1] + y]
}

fn nearest(q: Point, to: &[Point]) -> Point {
    let mut best = (f64::INFINITY, q);
    for p in to {
        let d = (p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]);
        if d < best.0 {
            best = (d, *p);
        }
    }
    best.1
}

struct Spread {
    centre: Point,
    size: f64,
}

impl Spread {
    fn of(points: &[Point]) -> Option<Self> {
        let n = points.len() as f64;
        let centre = [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
        let squares = points.iter().map(|p| (p[0] - centre[0]).powi(2) + (p[1] - centre[1]).powi(2));
        let size = (squares.sum::<f64>() / n).sqrt();
        (size > 0.0 && size.is_finite()).then_some(Self { centre, size })
    }
}

/// The least-squares similarity from the first to the second points of pairs, in complex numbers: with p and q relative to their
/// means, the factor is Σ p̄ q / Σ |p|².
fn similarity(pairs: &[(Point, Point)], is_mirrored: bool) -> Option<Registered> {
    let n = pairs.len() as f64;
    let hand = if is_mirrored { -1.0 } else { 1.0 };
    let from = |p: Point| [hand * p[0], p[1]];
    let mean = |of: &dyn Fn(&(Point, Point)) -> Point| {
        [0, 1].map(|k| pairs.iter().map(|pair| of(pair)[k]).sum::<f64>() / n)
    };
    let (a, b) = (mean(&|pair| from(pair.0)), mean(&|pair| pair.1));
    let (mut real, mut imaginary, mut own) = (0.0, 0.0, 0.0);
    for (p, q) in pairs {
        let p = from(*p);
        let (p, q) = ([p[0] - a[0], p[1] - a[1]], [q[0] - b[0], q[1] - b[1]]);
        real += p[0] * q[0] + p[1] * q[1];
        imaginary += p[0] * q[1] - p[1] * q[0];
        own += p[0] * p[0] + p[1] * p[1];
    }
    let size = libm::hypot(real, imaginary);
    if !(own > 0.0 && size > 0.0) {
        return None;
    }
    let (cosine, sine) = (real / own, imaginary / own);
    let place = [b[0] - cosine * a[0] + sine * a[1], b[1] - sine * a[0] - cosine * a[1]];
    let missed: f64 = pairs
        .iter()
        .map(|(p, q)| {
            let p = from(*p);
            let x = place[0] + cosine * p[0] - sine * p[1] - q[0];
            let y = place[1] + sine * p[0] + cosine * p[1] - q[1];
            x * x + y * y
        })
        .sum();
    let rms = (missed / n).sqrt();
    let pose = Pose { place, angle: libm::atan2(imaginary, real), is_mirrored };
    Some(Registered { pose, scale: size / own, rms })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PieceName;
    use pompeiu_planar::{Outline, resample};

    #[test]
    fn a_copy_is_found_however_it_lies() {
        let points = resample(&Outline::new(PieceName::Bird.points()).unwrap(), 150, 0);
        for (angle, is_mirrored) in [(0.3, false), (2.0, true), (-2.9, false)] {
            let pose = Pose { place: [4.0, -7.0], angle, is_mirrored };
            let truth = Registered { pose, scale: 2.5, rms: 0.0 };
            let to: Vec<Point> = points.iter().map(|p| apply(&truth, *p)).collect();
            let found = register(&points, &to, true).unwrap();
            assert!(found.rms < 1e-9 && (found.scale - 2.5).abs() < 1e-9, "{found:?}");
            assert_eq!(found.pose.is_mirrored, is_mirrored);
        }
        assert_eq!(register(&[[1.0, 1.0]], &points, true), None);
    }
}
