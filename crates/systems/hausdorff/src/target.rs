//! The mesh that distances are measured to, prepared for many questions.

use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Leaves, Neighbours};
use std::sync::OnceLock;

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
        let bvh = Bvh::build_unless_stopped(mesh, &aabb, &frame, leaves, control)?;
        Some(Self::of_tree(bvh, frame, aabb))
    }

    /// The same in a given frame, for one question.
    pub(crate) fn in_frame(mesh: &TriMesh, frame: Frame, leaves: Leaves) -> Self {
        Self::unless_stopped(mesh, frame, leaves, &Control::default()).expect("nothing stops it")
    }

    fn of_tree(bvh: Bvh, frame: Frame, aabb: Aabb) -> Self {
        #[cfg(test)]
        tests::TREES.with(|trees| trees.set(trees.get() + 1));
        Self { bvh, neighbours: OnceLock::new(), frame, aabb }
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
        self.bvh.bytes() + self.neighbours().map_or(0, Neighbours::bytes)
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
        self.neighbours.get_or_init(|| Neighbours::new(mesh, &self.bvh))
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

    /// The same target in the frame of a joint box, for the rare mesh that does not suit. Exact: see [`Frame`].
    pub(crate) fn reframed(&self, joint: &Aabb) -> Self {
        let frame = Frame::of(joint);
        let bvh = self.bvh.mapped(|p| frame.map(self.frame.unmap(p)));
        Self { bvh, neighbours: self.neighbours.clone(), frame, aabb: self.aabb }
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
