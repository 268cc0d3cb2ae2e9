//! Overlapping faces.

use super::orientation;
use pompeiu_core::geom::point_triangle::LANES;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::spatial::Bvh;
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_surface::plane::Vec2;
use rayon::prelude::*;

/// The faces whose interior intersects that of another face, in order. Degenerate faces have no interior.
///
/// # Accuracy
/// Exact: the interiors of two triangles are disjoint if and only if a side of one separates them.
/// # Cost
/// O(n log n) and the pairs of faces whose boxes meet.
pub(crate) fn overlapping_faces(faces: &[[u32; 3]], uv: &[Vec2]) -> Vec<FaceId> {
    let flat = uv.iter().map(|&[x, y]| [x, y, 0.0]).collect();
    let Ok(mesh) = TriMesh::new(flat, faces.to_vec()) else { return Vec::new() };
    let frame = Frame::of(&Aabb::of_faces(&mesh));
    let bvh = Bvh::build(&mesh, &frame);
    let slots: Vec<_> = bvh.slots().collect();
    let corners = |face: FaceId| turned(faces[face.index()].map(|v| uv[v as usize]));
    let mut found: Vec<FaceId> = slots
        .par_iter()
        .filter_map(|&slot| {
            let face = bvh.face(slot);
            let own = corners(face)?;
            let around = Aabb::of_points(&bvh.corners(slot));
            let mut leaves = Vec::new();
            bvh.leaves_meeting(around.lower, around.upper, &mut Vec::new(), &mut leaves);
            let others =
                leaves.iter().flat_map(|(leaf, _)| (0..LANES).map(|lane| bvh.face(bvh.slot_in(*leaf, lane))));
            let mut others = others.filter(|&other| other != face).filter_map(corners);
            others.any(|other| overlap(&own, &other)).then_some(face)
        })
        .collect();
    found.sort_unstable();
    found
}

/// The corners in counter-clockwise order; `None` for a degenerate triangle.
fn turned([a, b, c]: [Vec2; 3]) -> Option<[Vec2; 3]> {
    let turn = orientation(a, b, c);
    if turn > 0.0 {
        Some([a, b, c])
    } else if turn < 0.0 {
        Some([a, c, b])
    } else {
        None
    }
}

fn overlap(s: &[Vec2; 3], t: &[Vec2; 3]) -> bool {
    let separates = |s: &[Vec2; 3], t: &[Vec2; 3]| {
        (0..3).any(|i| t.iter().all(|&p| orientation(s[i], s[(i + 1) % 3], p) <= 0.0))
    };
    !separates(s, t) && !separates(t, s)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_do_not_overlap_and_folded_ones_do() {
        let uv = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.25, 0.25]];
        assert!(overlapping_faces(&[[0, 1, 2], [1, 3, 2]], &uv).is_empty());
        assert_eq!(overlapping_faces(&[[0, 1, 2], [1, 4, 2], [1, 3, 2]], &uv).len(), 2);
        // One inside another, and a degenerate one.
        assert_eq!(overlapping_faces(&[[0, 1, 3], [0, 3, 3]], &uv).len(), 0);
        assert_eq!(overlapping_faces(&[[0, 1, 3], [1, 3, 4]], &uv), [FaceId(0), FaceId(1)]);
    }
}
