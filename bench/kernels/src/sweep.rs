//! The sweep of the engine without the engine.

use crate::points;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::spatial::{Bvh, Cover, Nearest, Workspace, morton_order};
use pompeiu_core::{FaceId, TriMesh};

/// A mesh whose faces are covered by those of a tree.
pub struct Sweep {
    bvh: Bvh,
    /// Corners and centres of the faces, in Morton order.
    faces: Vec<[[f64; 4]; 3]>,
    limit_sq: f64,
    workspace: Workspace,
}

impl Sweep {
    /// Faces of a copy whose vertices are displaced by a fraction of the diagonal, which is also how far they may be.
    ///
    /// # Panics
    /// When the fraction is not finite.
    pub fn new(mesh: &TriMesh, fraction: f64) -> Self {
        let aabb = Aabb::of_faces(mesh);
        let frame = Frame::of(&aabb);
        let distance = fraction * aabb.diagonal();
        let moved = displace_at_random(mesh, distance, 4).expect("a finite fraction");
        let corners = |face: u32| moved.corners(FaceId(face)).map(|p| frame.map(p));
        let order = morton_order(&moved, &Aabb::of_faces(&moved));
        let limit = frame.length_in(distance);
        Self {
            bvh: Bvh::build(mesh, &frame),
            faces: order.into_iter().map(|face| points::with_centre(corners(face))).collect(),
            limit_sq: limit * limit,
            workspace: Workspace::default(),
        }
    }

    /// Number of faces to cover.
    pub fn len(&self) -> usize {
        self.faces.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.faces.is_empty()
    }

    /// Tries on each face the triangle that covered the last one, then asks the tree. Returns how many were covered.
    pub fn run(&mut self) -> usize {
        let mut hint = self.bvh.any_slot();
        let mut covered = 0;
        for points in &self.faces {
            let d = self.bvh.four_distances_sq(points, hint, &mut self.workspace);
            if d[..3].iter().all(|d| *d <= self.limit_sq) {
                covered += 1;
                continue;
            }
            let start = Nearest { slot: hint, distance_sq: d[3] };
            hint = match self.bvh.cover(points, self.limit_sq, start, &mut self.workspace) {
                Cover::By { slot, .. } => {
                    covered += 1;
                    slot
                }
                Cover::Nearest(nearest) | Cover::Neighbour(nearest) => nearest.slot,
            };
        }
        covered
    }
}
