//! Points of the input that a remeshed surface should reach, and how far they are from it.

use super::connectivity::NONE;
use super::marked::{Hold, Marked};
use super::reference::identity;
use super::triangle::area_vector;
use glam::DVec3;
use pompeiu_core::spatial::bvh::{Bvh, Slot, Workspace};
use pompeiu_core::{MeshError, TriMesh};
use rayon::prelude::*;

/// Samples of a task.
const TASK: usize = 1 << 10;

/// Greatest distance between samples on an edge, in target lengths.
const SPACING: f64 = 0.5;

/// Samples on edges, about as many at most.
const MOST_ON_EDGES: f64 = 1e6;

/// Length of the difference of the unit normals at an edge above which the edge is sampled: what a face of the target length cuts off
/// there is more than a tenth of that length high.
const SHARP: f64 = 0.4;

/// A point of the input.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) position: DVec3,
    /// A face of the input at it.
    pub(super) near: Slot,
    /// What holds a vertex there: nothing, or a curve.
    pub(super) hold: Hold,
    /// The target length there.
    pub(super) length: f64,
}

/// The vertices of the input that may move, and points of long edges at which it bends: where the surface is farthest from it is
/// near one of them.
pub(super) fn samples(input: &Marked) -> Vec<Sample> {
    let mesh = &input.mesh;
    let of_vertex = |v: u32| Sample {
        position: mesh.positions[v as usize],
        near: input.near[v as usize],
        hold: input.hold[v as usize],
        length: input.length[v as usize],
    };
    let vertices = (0..mesh.positions.len() as u32).filter(|&v| mesh.has_faces(v));
    let mut all: Vec<Sample> = vertices.map(of_vertex).filter(|sample| sample.hold != Hold::Corner).collect();
    let sharp: Vec<u32> = mesh.edges().filter(|&h| is_sharp(input, h)).collect();
    let gaps = |h: u32| input.share_sq(h).sqrt() / SPACING;
    let total: f64 = sharp.iter().map(|&h| gaps(h)).sum();
    let coarser = if total > MOST_ON_EDGES { total / MOST_ON_EDGES } else { 1.0 };
    for h in sharp {
        let [from, to] = [mesh.from(h), mesh.to(h)].map(of_vertex);
        let curve = input.curve[h as usize];
        let hold = if curve == NONE { Hold::Free } else { Hold::Curve(curve) };
        let count = (gaps(h) / coarser).ceil();
        for i in 1..count as u32 {
            let at = f64::from(i) / count;
            let length = from.length + at * (to.length - from.length);
            all.push(Sample { position: from.position.lerp(to.position, at), hold, length, ..from });
        }
    }
    all
}

/// Whether the surface bends at an edge so much that its points may be far from faces of the target length.
fn is_sharp(input: &Marked, h: u32) -> bool {
    let normal = |f: u32| area_vector(input.triangle(f)).normalize_or_zero();
    input.mesh.twin_of(h).is_some_and(|t| normal(h / 3).distance_squared(normal(t / 3)) > SHARP * SHARP)
}

/// Places where nothing is to be held.
#[derive(Default)]
pub(super) struct Avoided {
    pub(super) places: Vec<DVec3>,
    /// The distance from them, in target lengths.
    pub(super) beside: f64,
}

impl Avoided {
    /// Whether a sample is near one.
    pub(super) fn is_near(&self, sample: &Sample) -> bool {
        let most = self.beside * sample.length;
        self.places.iter().any(|p| sample.position.distance_squared(*p) <= most * most)
    }
}

/// What is nearest to a sample on a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reached {
    pub(super) distance: f64,
    /// The vertices of the nearest face.
    pub(super) face: [u32; 3],
}

/// How far samples are from a surface, in their order.
pub(super) fn reached(surface: &Marked, samples: &[Sample]) -> Result<Vec<Reached>, MeshError> {
    let exist = surface.mesh.face_slots().iter().filter(|face| face[0] != NONE);
    let positions = surface.mesh.positions.iter().map(DVec3::to_array).collect();
    let mesh = TriMesh::new(positions, exist.copied().collect())?;
    let bvh = Bvh::build(&mesh, &identity());
    let of_task = |task: &[Sample]| {
        let mut workspace = Workspace::default();
        let mut start = bvh.any_slot();
        let one = |sample: &Sample| {
            let found = bvh.nearest(sample.position.to_array(), start, &mut workspace);
            start = found.slot;
            let face = mesh.faces()[bvh.face(found.slot).index()];
            Reached { distance: found.distance_sq.sqrt(), face }
        };
        task.iter().map(one).collect::<Vec<_>>()
    };
    Ok(samples.par_chunks(TASK).flat_map_iter(of_task).collect())
}
