//! Dividing a part of a surface in two along a short seam.

use crate::FlattenError;
use crate::components::{Component, split};
use crate::cut::{largest, open};
use crate::opened::opened_surface;
use pompeiu_core::mesh::UnionFind;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_surface::{EdgeData, EdgeDistances, SurfaceMesh};

/// A part with fewer faces is not divided.
const LEAST_FACES: usize = 8;

/// Least share of the area on each side of a seam.
const LEAST_SHARE: f64 = 0.2;

/// Places among whose pairs the best one is looked for.
const PLACES: usize = 5;

/// Rounds in which faces change sides.
const ROUNDS: usize = 50;

/// Divides a part along a short seam between two places that are far from each other; none if it cannot be divided.
///
/// # Definition
/// Among the sets of faces that are nearer to one place than to the other by more than some amount, the one whose seam is shortest for
/// the area of the lesser side, as Cheeger's constant weighs them. Faces then change sides while this makes the seam shorter.
pub(crate) fn divide(part: &Component) -> Result<Option<Vec<Component>>, FlattenError> {
    let mesh = part.surface.mesh();
    if mesh.faces() < LEAST_FACES {
        return Ok(None);
    }
    let Some(beyond) = best_division(part) else { return Ok(None) };
    let sides = |edge| {
        let h = mesh.edge_halfedge(edge);
        mesh.twin(h).is_some_and(|t| beyond[h.face().index()] != beyond[t.face().index()])
    };
    let mut seam = EdgeData::filled(mesh.edges(), false);
    for edge in mesh.edge_ids().filter(|&edge| sides(edge)) {
        seam[edge] = true;
    }
    let opened = open(mesh, &seam)?;
    let mut parts = split(&opened_surface(&opened, &part.surface)?, None)?;
    for piece in &mut parts {
        piece.vertices.iter_mut().for_each(|v| *v = part.vertices[opened.vertex_map()[*v].index()]);
        piece.faces.iter_mut().for_each(|f| *f = part.faces[f.index()]);
    }
    Ok(Some(parts))
}

/// The faces on the far side of the best seam between some pairs of places, each far from the others.
fn best_division(part: &Component) -> Option<Vec<bool>> {
    let surface = part.surface.surface();
    let from = |v: usize| EdgeDistances::from(surface, &[VertexId(v as u32)]).distances.into_vec();
    let mut all: Vec<Vec<f64>> = Vec::new();
    // Each place is the farthest from those before, the first from any vertex.
    let mut nearest = from(0);
    for _ in 0..PLACES {
        let distances = from(largest(&nearest));
        if all.is_empty() {
            nearest.clone_from(&distances);
        }
        for (least, d) in nearest.iter_mut().zip(&distances) {
            *least = if d < least { *d } else { *least };
        }
        all.push(distances);
    }
    let pairs = (0..PLACES).flat_map(|i| (i + 1..PLACES).map(move |j| (i, j)));
    let mut best: Option<(f64, Vec<bool>)> = None;
    for (i, j) in pairs {
        let rough = sweep(part, &all[i], &all[j]);
        let mut short = rough.clone();
        shorten(part, &mut short);
        for mut beyond in [rough, short] {
            connect(part.surface.mesh(), &mut beyond);
            let ratio = ratio(part, &beyond);
            if ratio < best.as_ref().map_or(f64::INFINITY, |(least, _)| *least) {
                best = Some((ratio, beyond));
            }
        }
    }
    best.map(|(_, beyond)| beyond)
}

/// The length of the seam over the area of the lesser side; infinite or not a number where there is one side only.
fn ratio(part: &Component, beyond: &[bool]) -> f64 {
    let mesh = part.surface.mesh();
    let mut areas = [0.0; 2];
    let mut seam = 0.0;
    for face in mesh.face_ids() {
        areas[usize::from(beyond[face.index()])] += part.surface.surface().face_area(face);
        for (other, length) in across(part, face) {
            // Each side is seen from both faces.
            seam += if beyond[face.index()] == beyond[other.index()] { 0.0 } else { 0.5 * length };
        }
    }
    seam / if areas[0] < areas[1] { areas[0] } else { areas[1] }
}

/// The faces across a face's sides, with the lengths of these.
fn across(part: &Component, face: FaceId) -> impl Iterator<Item = (FaceId, f64)> + '_ {
    let mesh = part.surface.mesh();
    SurfaceMesh::face_halfedges(face).into_iter().filter_map(move |h| {
        let other = mesh.twin(h)?.face();
        Some((other, part.surface.surface().edge_length(mesh.edge(h))))
    })
}

/// The faces on the far side of the best seam between two places, given the distances from both.
fn sweep(part: &Component, from_one: &[f64], from_other: &[f64]) -> Vec<bool> {
    let (surface, mesh) = (part.surface.surface(), part.surface.mesh());
    let value = |face: &FaceId| -> f64 {
        mesh.face(*face).iter().map(|v| from_one[v.index()] - from_other[v.index()]).sum()
    };
    let mut order: Vec<(f64, FaceId)> = mesh.face_ids().map(|face| (value(&face), face)).collect();
    order.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
    let total = surface.area();
    let mut beyond = vec![true; mesh.faces()];
    let (mut area, mut seam, mut best) = (0.0, 0.0, (f64::INFINITY, 0));
    for (i, &(_, face)) in order.iter().enumerate() {
        beyond[face.index()] = false;
        area += surface.face_area(face);
        for (other, length) in across(part, face) {
            seam += if beyond[other.index()] { length } else { -length };
        }
        let lesser = if area < total - area { area } else { total - area };
        if lesser >= LEAST_SHARE * total && seam / lesser < best.0 {
            best = (seam / lesser, i + 1);
        }
    }
    let mut beyond = vec![false; mesh.faces()];
    for &(_, face) in &order[best.1..] {
        beyond[face.index()] = true;
    }
    beyond
}

/// Gives faces to the other side so that both sides are connected: the largest piece of the first stays, then that of the other.
fn connect(mesh: &SurfaceMesh, beyond: &mut [bool]) {
    for side in [false, true] {
        let mut pieces = UnionFind::new(beyond.len());
        for edge in mesh.edge_ids() {
            let h = mesh.edge_halfedge(edge);
            if let Some(t) = mesh.twin(h) {
                let [f, g] = [h, t].map(|h| h.face().index());
                if beyond[f] == beyond[g] {
                    pieces.union(f, g);
                }
            }
        }
        let mut sizes = vec![0.0; beyond.len()];
        for f in 0..beyond.len() {
            sizes[pieces.find(f)] += if beyond[f] == side { 1.0 } else { 0.0 };
        }
        let kept = largest(&sizes);
        for f in 0..beyond.len() {
            if beyond[f] == side && pieces.find(f) != kept {
                beyond[f] = !side;
            }
        }
    }
}

/// Lets faces change sides while the seam becomes shorter.
fn shorten(part: &Component, beyond: &mut [bool]) {
    let mesh = part.surface.mesh();
    for _ in 0..ROUNDS {
        let mut changed = false;
        for face in mesh.face_ids() {
            let here = beyond[face.index()];
            let (mut same, mut other) = (0.0, 0.0);
            for (beside, length) in across(part, face) {
                *(if beyond[beside.index()] == here { &mut same } else { &mut other }) += length;
            }
            if other > same {
                beyond[face.index()] = !here;
                changed = true;
            }
        }
        if !changed {
            break;
        }
    }
}
