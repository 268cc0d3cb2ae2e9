//! Moving vertices within the surface towards the middle of their neighbours, and back onto the input.

use super::connectivity::{DynamicMesh, NONE, previous};
use super::folds::Fold;
use super::marked::{Hold, Marked};
use super::reference::Reference;
use super::triangle::{area_vector, keeps_normal};
use glam::DVec3;
use pompeiu_core::spatial::bvh::{Slot, Workspace};
use rayon::prelude::*;

/// Vertices of a task.
const TASK: usize = 1 << 10;

/// Where a vertex goes, with a face of the input near it and the target length there.
#[derive(Clone, Copy)]
pub(super) struct Move {
    pub(super) position: DVec3,
    pub(super) near: Slot,
    pub(super) length: f64,
}

/// Moves all vertices at once, `steps` times within the surface, then onto the input if there is one. Faces that would turn over
/// keep their vertices where they were.
pub(super) fn smooth(surface: &mut Marked, reference: Option<&Reference<'_>>, steps: usize) {
    let rings = Rings::of(surface);
    for _ in 0..steps {
        let moved = each_vertex(surface, |v, workspace| {
            let to = relaxed(surface, &rings, v);
            match (reference, surface.hold[v as usize]) {
                // A move that cannot be made leaves the vertex on its curve.
                (Some(reference), Hold::Curve(curve)) => {
                    let on_curve = reference.project_to_curve(to.position, curve, workspace);
                    Move { position: on_curve.unwrap_or(to.position), ..to }
                }
                _ => to,
            }
        });
        apply(surface, moved);
    }
    if let Some(reference) = reference {
        let moved = each_vertex(surface, |v, workspace| projected(surface, reference, &rings, v, workspace));
        apply(surface, moved);
    }
}

/// The neighbours of each free vertex, counter-clockwise: what relaxation reads again and again.
pub(super) struct Rings {
    /// Where the ring of each vertex starts, and where the last one ends.
    starts: Vec<u32>,
    vertices: Vec<u32>,
    /// Whether the surface folds back at each free vertex.
    folds: Vec<Fold>,
}

impl Rings {
    pub(super) fn of(surface: &Marked) -> Self {
        let mesh = &surface.mesh;
        let count = mesh.positions.len();
        let (mut starts, mut vertices) =
            (Vec::with_capacity(count + 1), Vec::with_capacity(mesh.origin.len()));
        for v in 0..count as u32 {
            starts.push(vertices.len() as u32);
            if surface.hold[v as usize] == Hold::Free {
                vertices.extend(mesh.halfedges_from(v).map(|h| mesh.to(h)));
            }
        }
        starts.push(vertices.len() as u32);
        let fold = |v: u32| {
            let is_free = surface.hold[v as usize] == Hold::Free && mesh.has_faces(v);
            if is_free { Fold::at(surface, v) } else { Fold::None }
        };
        let folds = (0..count as u32).into_par_iter().map(fold).collect();
        Self { starts, vertices, folds }
    }

    fn around(&self, v: u32) -> &[u32] {
        let [from, to] = [v, v + 1].map(|v| self.starts[v as usize] as usize);
        &self.vertices[from..to]
    }
}

fn each_vertex(surface: &Marked, to: impl Fn(u32, &mut Workspace) -> Move + Sync) -> Vec<Move> {
    let vertices: Vec<u32> = (0..surface.mesh.positions.len() as u32).collect();
    let of_task = |task: &[u32]| {
        let mut workspace = Workspace::default();
        task.iter().map(|&v| to(v, &mut workspace)).collect::<Vec<_>>()
    };
    vertices.par_chunks(TASK).flat_map_iter(of_task).collect()
}

fn stay(surface: &Marked, v: u32) -> Move {
    let v = v as usize;
    Move { position: surface.mesh.positions[v], near: surface.near[v], length: surface.length[v] }
}

/// Towards the middle of the neighbours, in the tangent plane or along the curve.
pub(super) fn relaxed(surface: &Marked, rings: &Rings, v: u32) -> Move {
    let mesh = &surface.mesh;
    let still = stay(surface, v);
    if !mesh.has_faces(v) {
        return still;
    }
    let p = still.position;
    let position = match (surface.hold[v as usize], rings.folds[v as usize]) {
        (Hold::Corner, _) => p,
        (Hold::Curve(_), _) => along_curve(surface, v).unwrap_or(p),
        (Hold::Free, fold @ (Fold::Along(_) | Fold::Tip)) => fold.relaxed(surface, v),
        (Hold::Free, Fold::None) => {
            let ring = rings.around(v);
            let (mut sum, mut normal) = (DVec3::ZERO, DVec3::ZERO);
            let mut before = ring.last().map_or(p, |w| mesh.positions[*w as usize]) - p;
            for w in ring {
                let along = mesh.positions[*w as usize] - p;
                normal += before.cross(along);
                sum += along;
                before = along;
            }
            let step = sum / ring.len() as f64;
            match normal.try_normalize() {
                Some(normal) => p + step - normal * normal.dot(step),
                None => p,
            }
        }
    };
    Move { position, ..still }
}

/// The middle between both neighbours on a curve.
fn along_curve(surface: &Marked, v: u32) -> Option<DVec3> {
    let mesh = &surface.mesh;
    let mut ends = [DVec3::ZERO; 2];
    let mut count = 0;
    let mut found = |w: u32| {
        if let Some(end) = ends.get_mut(count) {
            *end = mesh.positions[w as usize];
        }
        count += 1;
    };
    for h in mesh.halfedges_from(v) {
        if surface.curve[h as usize] != NONE {
            found(mesh.to(h));
        }
        let last = previous(h);
        if mesh.twin[last as usize] == NONE {
            found(mesh.from(last));
        }
    }
    (count == 2).then(|| 0.5 * (ends[0] + ends[1]))
}

/// Onto the input, unless the nearest point lies on a sheet that faces the other way.
pub(super) fn projected(
    surface: &Marked,
    reference: &Reference<'_>,
    rings: &Rings,
    v: u32,
    workspace: &mut Workspace,
) -> Move {
    let mesh = &surface.mesh;
    let still = stay(surface, v);
    if !mesh.has_faces(v) {
        return still;
    }
    let p = match surface.hold[v as usize] {
        Hold::Curve(curve) => {
            reference.project_to_curve(still.position, curve, workspace).unwrap_or(still.position)
        }
        Hold::Free | Hold::Corner => still.position,
    };
    let found = reference.project(p, still.near, workspace);
    let position = if surface.hold[v as usize] != Hold::Free {
        p
    } else if rings.folds[v as usize] == Fold::None && normal_at(mesh, v).dot(found.normal) < 0.0 {
        return still;
    } else {
        found.position
    };
    let length = if found.length > 0.0 && found.length < f64::INFINITY { found.length } else { still.length };
    Move { position, near: found.slot, length }
}

fn normal_at(mesh: &DynamicMesh, v: u32) -> DVec3 {
    mesh.halfedges_from(v).map(|h| area_vector(mesh.corners(h / 3).map(|v| mesh.positions[v as usize]))).sum()
}

/// Moves the vertices; those of faces that would turn over stay, again and again until no face does.
fn apply(surface: &mut Marked, mut moved: Vec<Move>) {
    let mesh = &surface.mesh;
    let is_turned = |moved: &[Move], f: u32| {
        let corners = mesh.corners(f);
        let old = corners.map(|v| mesh.positions[v as usize]);
        !keeps_normal(old, corners.map(|v| moved[v as usize].position))
    };
    let faces = 0..mesh.origin.len() as u32 / 3;
    let mut turned: Vec<u32> =
        faces.into_par_iter().filter(|&f| mesh.exists(3 * f) && is_turned(&moved, f)).collect();
    while !turned.is_empty() {
        let mut beside = Vec::new();
        for v in turned.into_iter().flat_map(|f| mesh.corners(f)) {
            let still = stay(surface, v);
            if moved[v as usize].position != still.position {
                beside.extend(mesh.halfedges_from(v).map(|h| h / 3));
            }
            moved[v as usize] = still;
        }
        beside.sort_unstable();
        beside.dedup();
        turned = beside.into_iter().filter(|&f| is_turned(&moved, f)).collect();
    }
    for (v, to) in moved.into_iter().enumerate() {
        surface.mesh.positions[v] = to.position;
        (surface.near[v], surface.length[v]) = (to.near, to.length);
    }
}
