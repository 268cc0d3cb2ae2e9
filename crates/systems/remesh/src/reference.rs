//! The input as remeshing sees it: where its nearest points are, and how long edges should be there.

use super::connectivity::NONE;
use super::marked::Marked;
use super::sizing::Lengths;
use glam::DVec3;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::spatial::bvh::{Bvh, Slot, Workspace};
use pompeiu_core::{MeshError, TriMesh};

/// The input, in its frame.
pub(super) struct Reference<'f> {
    pub(super) bvh: Bvh,
    pub(super) frame: Frame,
    faces: Vec<[u32; 3]>,
    /// The segments of each curve, as triangles without area.
    curves: Vec<Option<Bvh>>,
    pub(super) lengths: Lengths<'f>,
}

/// The point of the input nearest to another one.
pub(super) struct Projected {
    pub(super) position: DVec3,
    pub(super) slot: Slot,
    /// Normal of its face, not of unit length.
    pub(super) normal: DVec3,
    /// The target length there.
    pub(super) length: f64,
}

impl<'f> Reference<'f> {
    /// Prepares a surface whose faces and vertices have no gaps.
    pub(super) fn new(surface: &Marked, frame: Frame, lengths: Lengths<'f>) -> Result<Self, MeshError> {
        let faces = surface.mesh.origin.as_chunks::<3>().0.to_vec();
        let positions: Vec<[f64; 3]> = surface.mesh.positions.iter().map(DVec3::to_array).collect();
        let mesh = TriMesh::new(positions, faces)?;
        let bvh = Bvh::build(&mesh, &identity());
        let (positions, faces) = mesh.into_parts();
        Ok(Self { bvh, frame, faces, curves: trees_of_curves(surface, &positions), lengths })
    }

    /// Changes which curves there are, to those of a surface with the vertices and faces that it was made of.
    pub(super) fn keep(&mut self, surface: &Marked) {
        let positions: Vec<[f64; 3]> = surface.mesh.positions.iter().map(DVec3::to_array).collect();
        self.curves = trees_of_curves(surface, &positions);
    }

    /// A slot with a face at each vertex.
    pub(super) fn slots_at_vertices(&self, vertices: usize) -> Vec<Slot> {
        let mut slots = vec![self.bvh.any_slot(); vertices];
        for slot in self.bvh.slots() {
            for v in self.faces[self.bvh.face(slot).index()] {
                slots[v as usize] = slot;
            }
        }
        slots
    }

    /// The nearest point of the surface, searched from a face believed near.
    pub(super) fn project(&self, p: DVec3, start: Slot, workspace: &mut Workspace) -> Projected {
        let slot = self.bvh.nearest(p.to_array(), start, workspace).slot;
        let corners = self.bvh.corners(slot);
        let weights = closest_barycentric(p.to_array(), corners);
        let [a, b, c] = corners.map(DVec3::from_array);
        let position = weights[0] * a + weights[1] * b + weights[2] * c;
        let face = self.faces[self.bvh.face(slot).index()];
        let length = self.lengths.at(position, &self.frame, face, weights);
        Projected { position, slot, normal: (b - a).cross(c - a), length }
    }

    /// The nearest point of a curve.
    pub(super) fn project_to_curve(&self, p: DVec3, curve: u32, workspace: &mut Workspace) -> Option<DVec3> {
        let tree = self.curves.get(curve as usize)?.as_ref()?;
        let slot = tree.nearest(p.to_array(), tree.any_slot(), workspace).slot;
        let [a, b, _] = tree.corners(slot).map(DVec3::from_array);
        let t = (p - a).dot(b - a) / (b - a).length_squared();
        let t = if t > 0.0 { t } else { 0.0 };
        Some(a + (b - a) * if t < 1.0 { t } else { 1.0 })
    }
}

/// A tree over the segments of each curve, by its number.
fn trees_of_curves(surface: &Marked, positions: &[[f64; 3]]) -> Vec<Option<Bvh>> {
    let mesh = &surface.mesh;
    let mut segments: Vec<(u32, u32)> =
        mesh.edges().map(|h| (surface.curve[h as usize], h)).filter(|(curve, _)| *curve != NONE).collect();
    segments.sort_unstable();
    let mut trees = Vec::new();
    let at = |v: u32| positions[v as usize];
    for own in segments.chunk_by(|x, y| x.0 == y.0) {
        let corners = own.iter().flat_map(|&(_, h)| [at(mesh.from(h)), at(mesh.to(h))]).collect();
        let faces = (0..own.len() as u32).map(|i| [2 * i, 2 * i + 1, 2 * i + 1]).collect();
        let curve = own.first().map_or(0, |(curve, _)| *curve as usize);
        trees.resize_with(curve, || None);
        trees.push(TriMesh::new(corners, faces).ok().map(|tree| Bvh::build(&tree, &identity())));
    }
    trees
}

/// The frame of what is in a frame already.
pub(super) fn identity() -> Frame {
    Frame::of(&Aabb::EMPTY)
}
