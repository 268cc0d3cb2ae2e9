//! Short curves along a velocity.

use crate::State;
use crate::square::Square;
use crate::transport::Backtrace;
use pompeiu_core::FaceId;
use pompeiu_surface::plane::norm;
use pompeiu_surface::{EmbeddedSurface, Ray};

/// Largest number of curves; fewer on surfaces with fewer faces.
const CURVES: usize = 160;

/// Number of segments of each curve.
const PARTS: usize = 6;

/// Length of the curve with the greatest speed, relative to the square root of the area.
const REACH: f64 = 0.09;

/// Points slower than this share of the greatest speed have no curve.
const SLOW: f64 = 0.02;

/// A surface prepared for short curves along a velocity, starting at points distributed evenly by area.
#[derive(Debug)]
pub struct Streaks<'s> {
    surface: &'s EmbeddedSurface,
    backtrace: Backtrace<'s>,
    seeds: Vec<FaceId>,
}

impl<'s> Streaks<'s> {
    /// Prepares a surface.
    pub fn new(surface: &'s EmbeddedSurface) -> Self {
        let intrinsic = surface.surface();
        let count = CURVES.min(intrinsic.mesh().faces());
        let spacing = intrinsic.area() / count as f64;
        let (mut seeds, mut passed) = (Vec::with_capacity(count), 0.0);
        for face in intrinsic.mesh().face_ids() {
            passed += intrinsic.face_area(face);
            while passed > (seeds.len() as f64 + 0.5) * spacing && seeds.len() < count {
                seeds.push(face);
            }
        }
        Self { surface, backtrace: Backtrace::new(intrinsic), seeds }
    }

    /// The curves of a flow: all cover the same time, so that length shows speed.
    pub fn curves(&self, state: &State) -> Vec<Vec<[f64; 3]>> {
        let velocity = self.backtrace.at_vertices(&state.velocity);
        let fastest = velocity.iter().map(|&u| norm(u)).fold(0.0, |m, x| if x > m { x } else { m });
        if fastest <= 0.0 {
            return Vec::new();
        }
        let time = REACH * self.surface.surface().area().sqrt() / fastest / PARTS as f64;
        let curve = |&seed: &FaceId| {
            let intrinsic = self.surface.surface();
            let (mut face, mut point) = (seed, intrinsic.point(seed, [1.0 / 3.0; 3]));
            let mut curve = vec![self.place(face, point)];
            for _ in 0..PARTS {
                let u = self.backtrace.at_point(&velocity, face, intrinsic.barycentric(face, point));
                if norm(u) < SLOW * fastest {
                    break;
                }
                let ray = Ray { face, point, direction: u, length: time * norm(u) };
                let (end, path) = self.backtrace.tracer().path(&ray);
                curve.extend(path[1..].iter().map(|&(face, point)| self.place(face, point)));
                (face, point) = (end.face, end.point);
            }
            curve
        };
        self.seeds.iter().map(curve).filter(|curve| curve.len() > 1).collect()
    }

    fn place(&self, face: FaceId, point: [f64; 2]) -> [f64; 3] {
        let shares = self.surface.surface().barycentric(face, point);
        let corners = self.surface.corner_positions(face);
        [0, 1, 2].map(|i| (0..3).map(|k| shares[k] * corners[k][i]).sum())
    }
}

/// Starting points along each side of the square.
const SQUARE_SEEDS: usize = 13;

/// The curves of a flow in the square.
pub(super) fn square_curves(square: &Square) -> Vec<Vec<[f64; 3]>> {
    let seeds = (0..SQUARE_SEEDS * SQUARE_SEEDS)
        .map(|k| [k % SQUARE_SEEDS, k / SQUARE_SEEDS].map(|i| (i as f64 + 0.5) / SQUARE_SEEDS as f64));
    let speed = |[u, v]: [f64; 2]| u.hypot(v);
    let fastest = square.velocity().into_iter().map(speed).fold(0.0, |m, x| if x > m { x } else { m });
    if fastest <= 0.0 {
        return Vec::new();
    }
    let time = REACH / fastest / PARTS as f64;
    let curve = |seed: [f64; 2]| {
        let (mut place, mut curve) = (seed, vec![[seed[0], seed[1], 0.0]]);
        for _ in 0..PARTS {
            let u = square.velocity_at(place);
            if speed(u) < SLOW * fastest {
                break;
            }
            place = [0, 1].map(|k| place[k] + time * u[k]);
            if !place.iter().all(|x| (0.0..=1.0).contains(x)) {
                break;
            }
            curve.push([place[0], place[1], 0.0]);
        }
        curve
    };
    seeds.map(curve).filter(|curve| curve.len() > 1).collect()
}
