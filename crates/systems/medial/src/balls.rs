//! Medial balls from balls shrunk to touch the surface.

use crate::ball::{Ball, distance};
use crate::cover::{self, Deviation};
use crate::error::MedialError;
use crate::sample::{self, Sample};
use crate::{shrink, simplify};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::Instant;
use pompeiu_core::run::{Control, Limits, StopReason, on_threads};
use pompeiu_core::spatial::{Bvh, Winding};
use pompeiu_surface::EmbeddedSurface;
use std::num::NonZeroUsize;
use std::time::Duration;

/// Options of medial balls.
#[derive(Clone, Debug)]
pub struct MedialOptions {
    /// Number of balls after simplification; fewer if fewer are distinct.
    pub balls: NonZeroUsize,
    /// Number of surface points from which balls are shrunk.
    pub samples: NonZeroUsize,
    /// Width of the enclosure of the distance from the surface to the balls, relative to the diagonal of the bounding box of the
    /// surface.
    pub tolerance: f64,
    /// Limits on time and threads.
    pub limits: Limits,
}

impl Default for MedialOptions {
    fn default() -> Self {
        Self {
            balls: const { NonZeroUsize::new(30).unwrap() },
            samples: const { NonZeroUsize::new(2000).unwrap() },
            tolerance: 1e-3,
            limits: Limits::default(),
        }
    }
}

/// Medial balls of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Medial {
    /// The balls.
    pub balls: Vec<Ball>,
    /// Pairs of balls that are adjacent along the medial axis, each in increasing order. They connect all balls of a connected
    /// component.
    pub edges: Vec<[u32; 2]>,
    /// Number of shrunk balls before simplification.
    pub shrunk: usize,
    /// The deviation between balls and surface.
    pub deviation: Deviation,
    /// The reason for which the computation ended.
    pub stop: StopReason,
    /// Wall-clock time.
    pub time: Duration,
}

impl Medial {
    /// The pairs of balls that overlap.
    ///
    /// # Cost
    /// O(n²).
    pub fn overlaps(&self) -> Vec<[u32; 2]> {
        let n = self.balls.len();
        let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| [i, j]));
        pairs.filter(|p| overlap(p.map(|i| &self.balls[i]))).map(|p| p.map(|i| i as u32)).collect()
    }
}

fn overlap([a, b]: [&Ball; 2]) -> bool {
    distance(a.centre, b.centre) < a.radius + b.radius
}

/// Computes a few medial balls that fill a closed surface.
///
/// # Definition
/// From points distributed evenly over the surface, balls are shrunk along the normals until they touch the surface at a second
/// point; their centres are near the medial axis. Edges join the balls of neighbouring points, and of the two points that a ball
/// touches. Edges are then collapsed one at a time until the requested number of balls is left; each time the one whose merged ball
/// is nearest to its tangent planes is chosen.
///
/// # Accuracy
/// Balls of a capsule: within one percent. In general the deviation bounds the error in both directions.
///
/// # Errors
/// [`MedialError`]: the surface has a boundary, or no ball fits.
///
/// # Cost
/// O(s² + s log n) for s samples and n faces, and the bounds of the deviation.
///
/// # Source
/// `ma_medial_2012` for the shrinking balls, `li_computing_2015` and `thiery_sphere_2013` for the quadric.
pub fn medial_balls(surface: &EmbeddedSurface, options: &MedialOptions) -> Result<Medial, MedialError> {
    if options.tolerance.is_nan() || options.tolerance <= 0.0 {
        return Err(MedialError::Tolerance { value: options.tolerance });
    }
    let mesh = surface.mesh();
    if let Some(&h) = mesh.boundary_loops().first() {
        let loops = mesh.boundary_loops().len();
        return Err(MedialError::Open { loops, vertex: mesh.tail(h) });
    }
    let control = Control::start(&options.limits);
    on_threads(options.limits.threads, || fill(surface, options, &control))
}

fn fill(
    surface: &EmbeddedSurface,
    options: &MedialOptions,
    control: &Control,
) -> Result<Medial, MedialError> {
    let began = Instant::now();
    let mesh = surface.mesh();
    let faces: Vec<[u32; 3]> = mesh.face_ids().map(|face| mesh.face(face).map(|v| v.0)).collect();
    let positions = surface.positions().as_slice().to_vec();
    let whole = TriMesh::new(positions, faces).map_err(|_| MedialError::NoBall { samples: 0 })?;
    // In a frame of size one, squares neither overflow nor underflow.
    let frame = Frame::of(&Aabb::of_faces(&whole));
    let bvh = Bvh::build(&whole, &frame);
    let samples: Vec<Sample> = sample::spread(surface, &frame, options.samples.get());
    let diagonal = frame.length_in(Aabb::of_faces(&whole).diagonal());
    let shrunk = shrink::balls(&bvh, &samples, 0.5 * diagonal);
    let start = simplify::Net::new(&samples, &shrunk);
    let count = start.len();
    if count == 0 {
        return Err(MedialError::NoBall { samples: samples.len() });
    }
    let (mut balls, edges) = start.simplified(options.balls.get(), diagonal, control);
    let winding = Winding::new(&whole);
    let is_inside = |p: [f64; 3]| winding.about(frame.unmap(p)).is_inside();
    let mut deviation = cover::deviation(&bvh, is_inside, &balls, options.tolerance * diagonal, control);
    deviation = Deviation {
        surface_to_balls: deviation.surface_to_balls.map(|bound| frame.length_out(bound)),
        balls_to_surface: frame.length_out(deviation.balls_to_surface),
    };
    for ball in &mut balls {
        *ball = Ball { centre: frame.unmap(ball.centre), radius: frame.length_out(ball.radius) };
    }
    Ok(Medial {
        balls,
        edges,
        shrunk: count,
        deviation,
        stop: control.reason().unwrap_or(StopReason::Tolerance),
        time: began.elapsed(),
    })
}
