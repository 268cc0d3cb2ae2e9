//! The mesh that distances are measured to, prepared for many questions.

use crate::planar::Retriangulated;
use crate::rounding::Rounding;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Leaves, Neighbours, Slot};
use pompeiu_core::{FaceId, TriMesh};
use std::sync::{Arc, OnceLock};

/// Bytes per face of the neighbours of a tree.
pub(crate) const NEIGHBOURS: usize = 12;

/// A mesh with its tree built: measure many meshes against it.
///
/// It holds a copy of the triangles and does not refer to the mesh.
///
/// # Cost
/// Building takes O(m log m) time on the threads of the current pool; see [`Target::bytes`] for its memory.
#[derive(Clone, Debug)]
pub struct Target {
    bvh: Bvh,
    /// Empty in a target for one question until its search tries overlays.
    neighbours: OnceLock<Neighbours>,
    frame: Frame,
    aabb: Aabb,
    /// The mesh of the tree where it has other faces than the one that is measured to.
    other_faces: Option<Arc<Retriangulated>>,
}

impl Target {
    /// Prepares a mesh.
    pub fn new(mesh: &TriMesh) -> Self {
        let frame = Frame::of(&Aabb::of_faces(mesh));
        let target = Self::in_frame(mesh, frame, Leaves::Consecutive);
        target.neighbours_in(mesh);
        target
    }

    /// The same in a given frame, without neighbours until they are wanted; none if it is told to stop before the tree is built.
    pub(crate) fn unless_stopped(
        mesh: &TriMesh,
        frame: Frame,
        leaves: Leaves,
        control: &Control,
    ) -> Option<Self> {
        let aabb = Aabb::of_faces(mesh);
        let other_faces = Retriangulated::new(mesh, &frame).map(Arc::new);
        let surface = other_faces.as_ref().map_or(mesh, |other| &other.mesh);
        let bvh = Bvh::build_unless_stopped(surface, &aabb, &frame, leaves, control)?;
        Some(Self { other_faces, ..Self::of_tree(bvh, frame, aabb) })
    }

    /// The same in a given frame, for one question.
    pub(crate) fn in_frame(mesh: &TriMesh, frame: Frame, leaves: Leaves) -> Self {
        Self::unless_stopped(mesh, frame, leaves, &Control::default()).expect("nothing stops it")
    }

    /// The same with the faces of the mesh, where the tree holds others.
    pub(crate) fn with_its_own_faces(&self) -> Option<Self> {
        let mesh = self.other_faces.as_ref()?.before();
        let target = Self::of_tree(Bvh::build(&mesh, &self.frame), self.frame, self.aabb);
        target.neighbours_in(&mesh);
        Some(target)
    }

    fn of_tree(bvh: Bvh, frame: Frame, aabb: Aabb) -> Self {
        #[cfg(test)]
        tests::TREES.with(|trees| trees.set(trees.get() + 1));
        Self { bvh, neighbours: OnceLock::new(), frame, aabb, other_faces: None }
    }

    /// The mesh whose faces the tree holds. `mesh` must be the one that the target was made of.
    pub(crate) fn surface<'m>(&'m self, mesh: &'m TriMesh) -> &'m TriMesh {
        self.other_faces.as_ref().map_or(mesh, |other| &other.mesh)
    }

    /// How far the surface of the tree may be from the mesh, in the frame.
    pub(crate) fn moved(&self) -> f64 {
        self.frame.error() + self.other_faces.as_ref().map_or(0.0, |other| other.moved)
    }

    /// The face of the mesh that is nearest to a point, with its corners, given one of the tree that is. In the frame.
    pub(crate) fn nearest_face(&self, slot: Slot, point: [f64; 3]) -> (FaceId, [[f64; 3]; 3]) {
        let face = self.bvh.face(slot);
        let nearest = self.other_faces.as_ref().map(|other| other.nearest_before(face, point, &self.frame));
        nearest.unwrap_or_else(|| (face, self.bvh.corners(slot)))
    }

    /// Number of faces.
    pub fn faces(&self) -> usize {
        self.bvh.len()
    }

    /// Bounding box of the faces, in the unit of the mesh.
    pub fn aabb(&self) -> Aabb {
        self.aabb
    }

    /// Bytes of memory held: about 97 per face.
    pub fn bytes(&self) -> usize {
        let of_faces = self.other_faces.as_ref().map_or(0, |other| other.bytes());
        self.bvh.bytes() + self.neighbours().map_or(0, Neighbours::bytes) + of_faces
    }

    /// Bytes of memory that preparing a mesh with so many faces takes at most, its own not included.
    pub fn bytes_to_prepare(faces: usize) -> usize {
        Bvh::bytes_to_build(faces) + NEIGHBOURS * faces
    }

    pub(crate) fn bvh(&self) -> &Bvh {
        &self.bvh
    }

    pub(crate) fn neighbours(&self) -> Option<&Neighbours> {
        self.neighbours.get()
    }

    /// The neighbours, found at the first call. `mesh` must be the one that the target was made of.
    pub(crate) fn neighbours_in(&self, mesh: &TriMesh) -> &Neighbours {
        self.neighbours.get_or_init(|| Neighbours::new(self.surface(mesh), &self.bvh))
    }

    pub(crate) fn frame(&self) -> &Frame {
        &self.frame
    }

    /// Whether a mesh with this box can be measured in the frame of this target: neither so large that squares of
    /// distances would lose B in rounding or overflow, nor so small, nor so far from the origin for the size of both
    /// together, as it may be when B is a single point and its frame knows of no size.
    pub(crate) fn suits(&self, a: &Aabb) -> bool {
        const SMALLEST: f64 = 0.25;
        const LARGEST: f64 = (1_u64 << 40) as f64;
        const FARTHEST: f64 = 4.0 * Frame::SHIFT_BEYOND;
        let largest = self.max_coordinate_with(a);
        let size = self.frame.length_in(self.aabb.union(*a).diagonal());
        (SMALLEST..=LARGEST).contains(&largest) && largest <= FARTHEST * size
    }

    /// The largest coordinate of this mesh and of one with the given box, in the frame of this target.
    pub(crate) fn max_coordinate_with(&self, a: &Aabb) -> f64 {
        self.frame.max_coordinate(&self.aabb.union(*a))
    }

    /// The rounding model for this mesh and one with the given box.
    pub(crate) fn rounding_with(&self, a: &Aabb) -> Rounding {
        Rounding::in_frame(&self.frame, &self.aabb.union(*a))
    }

    /// The same target in the frame of a joint box, for the rare mesh that does not suit. Exact: see [`Frame`]. A turned frame is that of a joint
    /// box already, in which any mesh of it suits.
    pub(crate) fn reframed(&self, joint: &Aabb) -> Self {
        debug_assert!(!self.frame.is_turned(), "a turned frame is made for both meshes");
        let frame = Frame::of(joint);
        let bvh = self.bvh.mapped(|p| frame.map(self.frame.unmap(p)));
        let other_faces = self.other_faces.as_ref().map(|other| {
            let mut other = Retriangulated::clone(other);
            other.moved = frame.length_in(self.frame.length_out(other.moved));
            Arc::new(other)
        });
        Self { bvh, neighbours: self.neighbours.clone(), frame, aabb: self.aabb, other_faces }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::cell::Cell;

    thread_local! {
        /// Trees that this thread has built.
        pub(crate) static TREES: Cell<usize> = const { Cell::new(0) };
    }
}
