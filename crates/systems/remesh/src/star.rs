//! The faces around an edge, before and after it collapses.

use super::marked::Marked;
use super::triangle::{Triangle, area_vector};
use glam::DVec3;

/// Cosine between the normals of a face before and after a collapse: below it the face is counted as turned over.
const LEAST_COSINE: f64 = 0.2;

/// What a collapse would make of the faces around an edge.
pub(super) struct Star {
    /// Faces that stay.
    pub(super) kept: Vec<u32>,
    /// The corner of each that moves.
    pub(super) corners: Vec<usize>,
    /// All faces around the edge, those that go first.
    pub(super) gone: Vec<u32>,
    /// Twice the area of each face that stays, along its normal.
    pub(super) normals: Vec<DVec3>,
}

impl Star {
    pub(super) fn new(surface: &Marked, h: u32) -> Self {
        let mesh = &surface.mesh;
        let mut gone: Vec<u32> = [Some(h), mesh.twin_of(h)].into_iter().flatten().map(|x| x / 3).collect();
        let removed = gone.len();
        let mut corners = Vec::new();
        for x in mesh.halfedges_from(mesh.from(h)).chain(mesh.halfedges_from(mesh.to(h))) {
            if !gone[..removed].contains(&(x / 3)) {
                gone.push(x / 3);
                corners.push((x % 3) as usize);
            }
        }
        let kept = gone[removed..].to_vec();
        let normals = kept.iter().map(|&f| area_vector(surface.triangle(f))).collect();
        Self { kept, corners, gone, normals }
    }

    /// The faces that stay, with their corners at a position.
    pub(super) fn moved(&self, surface: &Marked, position: DVec3, faces: &mut Vec<Triangle>) {
        faces.clear();
        faces.extend(self.kept.iter().zip(&self.corners).map(|(&f, &corner)| {
            let mut triangle = surface.triangle(f);
            triangle[corner] = position;
            triangle
        }));
    }

    pub(super) fn keeps_normals(&self, faces: &[Triangle]) -> bool {
        self.normals.iter().zip(faces).all(|(old, new)| is_turned_little(*old, area_vector(*new)))
    }
}

/// Whether a face may become another one: without being turned over.
pub(super) fn keeps_normal(old: Triangle, new: Triangle) -> bool {
    is_turned_little(area_vector(old), area_vector(new))
}

fn is_turned_little(old: DVec3, new: DVec3) -> bool {
    // A face without area has no normal to keep, but must not become another one.
    if old == DVec3::ZERO {
        return new != DVec3::ZERO;
    }
    let cosine = old.dot(new);
    cosine > 0.0
        && cosine * cosine > LEAST_COSINE * LEAST_COSINE * old.length_squared() * new.length_squared()
}
