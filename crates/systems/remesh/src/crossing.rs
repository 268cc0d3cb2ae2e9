//! Collapses that would make faces intersect that did not.

use super::connectivity::DynamicMesh;
use super::face_tree::FaceTree;
use super::marked::Marked;
use super::star::Star;
use super::triangle::Triangle;
use pompeiu_core::geom::Aabb;
use pompeiu_core::spatial::faces_intersect;

/// The tree is built anew when there are so many times fewer faces than when it was built.
const REBUILT_AT: usize = 2;

/// Knows where the faces of a surface are, to refuse collapses after which more of them intersect.
pub(super) struct Crossings {
    tree: FaceTree,
}

/// Memory for the tests of one thread.
#[derive(Default)]
pub(super) struct CrossingScratch {
    stack: Vec<u32>,
    near: Vec<u32>,
}

impl Crossings {
    pub(super) fn new(mesh: &DynamicMesh) -> Self {
        Self { tree: FaceTree::build(mesh) }
    }

    /// Takes note of faces that changed.
    pub(super) fn changed(&mut self, surface: &Marked, faces: impl Iterator<Item = u32>) {
        for f in faces {
            self.tree.grow(f, around(&surface.triangle(f)));
        }
        if surface.mesh.face_count() * REBUILT_AT <= self.tree.built_with() {
            self.tree = FaceTree::build(&surface.mesh);
        }
    }

    /// Whether a collapse that makes these faces of a star leaves no pair of faces that intersects and did not before.
    pub(super) fn allow(
        &self,
        surface: &Marked,
        star: &Star,
        new: &[Triangle],
        scratch: &mut CrossingScratch,
    ) -> bool {
        let all = new.iter().map(around).fold(Aabb::EMPTY, Aabb::union);
        scratch.near.clear();
        self.tree.near(&all, &mut scratch.stack, &mut scratch.near);
        let is_other = |f: &u32| surface.mesh.exists(3 * f) && !star.gone.contains(f);
        let others = scratch.near.iter().copied().filter(is_other);
        are_apart(surface, star, new, others) && are_apart_in_star(surface, star, new)
    }
}

/// Whether faces of a star that change intersect none of some other faces that they did not intersect before.
pub(super) fn are_apart(
    surface: &Marked,
    star: &Star,
    new: &[Triangle],
    others: impl Iterator<Item = u32>,
) -> bool {
    let boxes: Vec<Aabb> = new.iter().map(around).collect();
    let all = boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union);
    for f in others {
        let other = surface.triangle(f);
        let aabb = around(&other);
        if !aabb.meets(&all) {
            continue;
        }
        for ((face, own), &old) in new.iter().zip(&boxes).zip(&star.kept) {
            if own.meets(&aabb) && intersect(face, &other) && !intersect(&surface.triangle(old), &other) {
                return false;
            }
        }
    }
    true
}

/// Whether none of the faces of a star would intersect another that it does not intersect now.
fn are_apart_in_star(surface: &Marked, star: &Star, new: &[Triangle]) -> bool {
    let old = |i: usize| surface.triangle(star.kept[i]);
    (0..new.len()).all(|i| (0..i).all(|j| !intersect(&new[i], &new[j]) || intersect(&old(i), &old(j))))
}

fn intersect(one: &Triangle, other: &Triangle) -> bool {
    faces_intersect(&one.map(|p| p.to_array()), &other.map(|p| p.to_array()))
}

fn around(triangle: &Triangle) -> Aabb {
    Aabb::of_points(&triangle.map(|p| p.to_array()))
}
