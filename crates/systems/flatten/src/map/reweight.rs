//! Convex combination maps that are one-to-one in double precision: weights are changed until no face is nearly degenerate.

use super::boundary::{ConvexBoundary, LoopMirror};
use super::convex::ConvexSystem;
use super::ring::{VirtualBoundary, surrounded};
use super::weights::{Link, Weights, links};
use crate::FlattenError;
use crate::check::flipped_faces;
use crate::distortion::{all_singular_values, best_scale, symmetric_dirichlet};
use crate::watch::Watch;
use pompeiu_core::mesh::VertexData;
use pompeiu_core::run::Instant;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_surface::plane::Vec2;
use pompeiu_surface::{EmbeddedSurface, Surface};
use std::time::Duration;

/// Smallest ratio of the least to the greatest singular value of an acceptable map.
const LEAST_RATIO: f64 = 1e-10;

/// Below this ratio mean value weights are used as they are: made symmetric, they move a vertex that nearly lies on the opposite edge away
/// from it by many times the height of the face.
const POOR_RATIO: f64 = 1e-6;

/// Largest number of changes of weights against nearly degenerate faces.
const MOST_ROUNDS: usize = 20;

/// Largest number of changes to reduce distortion, and the decrease below which they end.
const MOST_ROUNDS_FOR_DISTORTION: usize = 8;
const WORTH: f64 = 0.9;

/// Smallest and largest factor by which the weights of a vertex change at once.
const CHANGES: [f64; 2] = [1e-2, 1e2];

/// A map onto a convex boundary.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    pub(crate) uv: VertexData<Vec2>,
    /// The final weights.
    pub(crate) weights: Weights,
    /// Number of changes of weights.
    pub(crate) rounds: usize,
    pub(crate) factor: Duration,
    pub(crate) solve: Duration,
    pub(crate) check: Duration,
}

/// How a disk is mapped onto a convex boundary.
#[derive(Clone, Copy)]
pub(crate) struct StartOptions<'s> {
    pub(crate) boundary: &'s ConvexBoundary,
    pub(crate) weights: Weights,
    pub(crate) around: Option<&'s VirtualBoundary>,
    /// For each vertex its mirror image, where the map is to be symmetric.
    pub(crate) partners: Option<&'s [u32]>,
    /// Whether weights are changed to reduce distortion, too: for the start of a minimisation.
    pub(crate) lessens_distortion: bool,
}

impl StartOptions<'_> {
    /// To a circle, for the start of a minimisation.
    pub(crate) const CIRCLE: Self = Self {
        boundary: &ConvexBoundary::Circle,
        weights: Weights::MeanValue,
        around: None,
        partners: None,
        lessens_distortion: true,
    };
}

/// Measurements of a map.
struct Measured {
    flipped: Vec<FaceId>,
    ratio: f64,
    energy: f64,
    values: Vec<([f64; 2], f64)>,
}

impl Measured {
    fn of(surface: &Surface, faces: &[[u32; 3]], uv: &VertexData<Vec2>) -> Self {
        let areas = surface.face_areas();
        let singular = all_singular_values(surface, uv);
        let values: Vec<([f64; 2], f64)> = singular.into_iter().zip(areas).collect();
        let scale = best_scale(&values);
        let total: f64 = values.iter().map(|value| value.1).sum();
        let energy = values
            .iter()
            .map(|([s, t], area)| area * symmetric_dirichlet([scale * s, scale * t]))
            .sum::<f64>();
        let least = values.iter().map(|([_, t], _)| *t).fold(f64::INFINITY, f64::min);
        let greatest = values.iter().map(|([s, _], _)| *s).fold(0.0, f64::max);
        Self { flipped: flipped_faces(faces, uv), ratio: least / greatest, energy: energy / total, values }
    }

    fn is_sound(&self) -> bool {
        self.flipped.is_empty() && self.ratio >= LEAST_RATIO
    }
}

/// Links with weights whose sum around each vertex is 1: residuals count alike where weights of thin faces are many times greater.
fn means(links: &[Link], vertices: usize) -> Vec<Link> {
    let mut sums = vec![0.0; vertices];
    for Link { ends, weights } in links {
        for (v, weight) in ends.iter().zip(weights) {
            sums[*v as usize] += weight;
        }
    }
    let share = |link: &Link| {
        [0, 1].map(|i| {
            let sum = sums[link.ends[i] as usize];
            if sum > 0.0 { link.weights[i] / sum } else { link.weights[i] }
        })
    };
    links.iter().map(|link| Link { ends: link.ends, weights: share(link) }).collect()
}

/// Maps a disk onto a convex boundary without flips.
///
/// # Definition
/// First with the requested weights; cotangent weights that flip a face are replaced by mean value weights. If faces are nearly
/// degenerate, and to reduce distortion on request, each weight is divided by the factors of both its ends. The factor of a vertex
/// is the geometric mean, over its faces, of the square root of the ratio of their area to that in the map. All weights stay
/// positive. Where the result is poor, mean value weights that are not made symmetric are tried as well.
///
/// # Errors
/// [`FlattenError::Crowded`] if faces are still flipped, or nearly so, after 20 rounds.
pub(crate) fn start_map(
    disk: &EmbeddedSurface,
    faces: &[[u32; 3]],
    options: StartOptions<'_>,
    watch: &Watch<'_>,
) -> Result<Start, FlattenError> {
    let StartOptions { boundary, weights, around, partners, lessens_distortion } = options;
    let surrounded = around.map(|ring| surrounded(disk, ring)).transpose()?;
    let (surface, faces) = match &surrounded {
        Some((surface, faces)) => (surface, &faces[..]),
        None => (disk.surface(), faces),
    };
    let mesh = surface.mesh();
    let Some(&first) = mesh.boundary_loops().first() else {
        return Err(FlattenError::Cut(crate::CutError::NoDisk {
            face: FaceId(0),
            euler_characteristic: mesh.euler_characteristic(),
            boundary_loops: 0,
        }));
    };
    let along: Vec<_> = mesh.boundary_loop(first).collect();
    let loop_vertices: Vec<VertexId> = along.iter().map(|&h| mesh.tail(h)).collect();
    let mirror = partners.filter(|_| around.is_none()).and_then(|p| LoopMirror::new(&loop_vertices, p));
    let places = boundary.places(disk, surface, &along, mirror)?;
    let mut uv = VertexData::filled(mesh.vertices(), [0.0; 2]);
    for (&h, &place) in along.iter().zip(&places) {
        uv[mesh.tail(h)] = place;
    }
    let (mut used, mut these) = (weights, links(surface, weights)?);
    let mut system = ConvexSystem::new(mesh, &these)?;
    let mut check = Duration::ZERO;
    let mut measure = |uv: &VertexData<Vec2>| {
        let start = Instant::now();
        let measured = Measured::of(surface, faces, uv);
        check += start.elapsed();
        measured
    };
    if weights == Weights::Cotangent {
        let symmetric: Vec<f64> = these.iter().map(Link::symmetric).collect();
        let solved = system.balance(&symmetric, &mut uv);
        let measured = measure(&uv);
        if solved.is_ok() && measured.flipped.is_empty() && !lessens_distortion {
            let (factor, solve) = (system.factor, system.solve);
            let uv = uv_of_disk(disk, &uv);
            return Ok(Start { uv, weights: used, rounds: 0, factor, solve, check });
        }
        (used, these) = (Weights::MeanValue, links(surface, Weights::MeanValue)?);
        system = ConvexSystem::new(mesh, &these)?;
    }
    let mut symmetric: Vec<f64> = these.iter().map(Link::symmetric).collect();
    if used == Weights::MeanValue && !lessens_distortion {
        system.balance_unsymmetric(&these, &mut uv)?;
    } else {
        system.balance(&symmetric, &mut uv)?;
    }
    let mut best = (measure(&uv), uv.clone());
    let mut rounds = 0;
    while rounds < MOST_ROUNDS {
        // A map that is stopped must be one-to-one all the same, but may have more distortion.
        let for_distortion = lessens_distortion && rounds < MOST_ROUNDS_FOR_DISTORTION && !watch.is_stopped();
        if best.0.is_sound() && !for_distortion {
            break;
        }
        let factors = factors(surface, &best.0.values);
        for (weight, link) in symmetric.iter_mut().zip(&these) {
            *weight /= factors[link.ends[0] as usize] * factors[link.ends[1] as usize];
        }
        rescale(&mut symmetric);
        rounds += 1;
        system.balance(&symmetric, &mut uv)?;
        let measured = measure(&uv);
        let is_better = !best.0.is_sound() || (measured.is_sound() && measured.energy < best.0.energy);
        let is_worth = !best.0.is_sound() || measured.energy < WORTH * best.0.energy;
        if is_better {
            best = (measured, uv.clone());
        }
        if !is_worth {
            break;
        }
    }
    if best.0.ratio < POOR_RATIO && used == Weights::MeanValue && lessens_distortion {
        system.balance_unsymmetric(&means(&these, surface.mesh().vertices()), &mut uv)?;
        let measured = measure(&uv);
        if measured.is_sound() && (!best.0.is_sound() || measured.energy < best.0.energy) {
            best = (measured, uv);
        }
    }
    let (measured, uv) = best;
    if !measured.is_sound() {
        let is_thin = |f: &usize| measured.values[*f].0[1] <= 0.0;
        let mut crowded = measured.flipped;
        if crowded.is_empty() {
            crowded = (0..faces.len()).filter(is_thin).map(|f| FaceId(f as u32)).collect();
        }
        // Faces of a virtual boundary have no id.
        crowded.retain(|face| face.index() < disk.mesh().faces());
        return Err(FlattenError::Crowded { faces: crowded, ratio: measured.ratio });
    }
    let uv = uv_of_disk(disk, &uv);
    Ok(Start { uv, weights: used, rounds, factor: system.factor, solve: system.solve, check })
}

/// The positions of the vertices of the disk itself, which come first.
fn uv_of_disk(disk: &EmbeddedSurface, uv: &VertexData<Vec2>) -> VertexData<Vec2> {
    VertexData::from_fn(disk.mesh().vertices(), |v: VertexId| uv[v])
}

/// The factor by which the weights of each vertex are divided.
fn factors(surface: &Surface, values: &[([f64; 2], f64)]) -> Vec<f64> {
    let mesh = surface.mesh();
    let mut sums = vec![(0.0, 0.0); mesh.vertices()];
    for (face, ([s, t], _)) in mesh.face_ids().zip(values) {
        let shrinking = 1.0 / (s * t.abs()).sqrt();
        let logarithm = if shrinking.is_finite() { libm::log(shrinking) } else { f64::INFINITY };
        let clipped = logarithm.clamp(-700.0, 700.0);
        for v in mesh.face(face) {
            sums[v.index()].0 += clipped;
            sums[v.index()].1 += 1.0;
        }
    }
    let [least, most] = CHANGES;
    sums.into_iter().map(|(sum, count)| libm::exp(sum / count).clamp(least, most)).collect()
}

/// Keeps weights in the range of doubles; a common factor does not change the map.
fn rescale(weights: &mut [f64]) {
    let greatest = weights.iter().copied().fold(0.0, f64::max);
    if greatest > 0.0 {
        for weight in weights {
            *weight = (*weight / greatest).max(1e-280);
        }
    }
}
