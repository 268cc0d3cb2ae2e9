//! A tree over the faces of a surface that changes.

use super::connectivity::{DynamicMesh, NONE};
use pompeiu_core::geom::Aabb;

/// Faces in a leaf, at most.
const LEAF: usize = 4;

/// Boxes around the faces of a surface, to find those near a box. Boxes grow when faces change; faces that were removed stay in their leaf.
pub(super) struct FaceTree {
    nodes: Vec<Node>,
    /// Faces, those of a leaf side by side.
    order: Vec<u32>,
    /// The leaf of each face.
    leaf: Vec<u32>,
    /// Number of faces of the surface when it was built.
    built_with: usize,
}

struct Node {
    aabb: Aabb,
    parent: u32,
    /// The first of two children, or the place of the first face in a leaf.
    first: u32,
    /// Number of faces; 0 for a node with children.
    faces: u32,
}

/// A face with its box, while the tree is built.
struct Item {
    face: u32,
    aabb: Aabb,
    middle: [f64; 3],
}

impl FaceTree {
    /// # Cost
    /// O(m log m) for m faces.
    pub(super) fn build(mesh: &DynamicMesh) -> Self {
        let slots = mesh.halfedge_slots() / 3;
        let alive = (0..slots).filter(|&f| mesh.exists(3 * f));
        let mut items: Vec<Item> = alive.map(|face| Item::of(mesh, face)).collect();
        let root = Node { aabb: Aabb::EMPTY, parent: NONE, first: 0, faces: items.len() as u32 };
        let mut nodes = vec![root];
        let mut at = 0;
        // Children come after their parents.
        while at < nodes.len() {
            let (first, faces) = (nodes[at].first as usize, nodes[at].faces as usize);
            let own = &mut items[first..first + faces];
            nodes[at].aabb = own.iter().fold(Aabb::EMPTY, |all, item| all.union(item.aabb));
            if faces > LEAF {
                let half = halve(own);
                nodes[at].first = nodes.len() as u32;
                nodes[at].faces = 0;
                for (first, faces) in [(first, half), (first + half, faces - half)] {
                    let child = Node {
                        aabb: Aabb::EMPTY,
                        parent: at as u32,
                        first: first as u32,
                        faces: faces as u32,
                    };
                    nodes.push(child);
                }
            }
            at += 1;
        }
        let order: Vec<u32> = items.iter().map(|item| item.face).collect();
        let mut leaf = vec![NONE; slots as usize];
        for (i, node) in (0..).zip(&nodes) {
            for &f in &order[node.first as usize..][..node.faces as usize] {
                leaf[f as usize] = i;
            }
        }
        Self { nodes, order, leaf, built_with: mesh.face_count() }
    }

    /// Number of faces of the surface when it was built.
    pub(super) fn built_with(&self) -> usize {
        self.built_with
    }

    /// A face now also takes up a box.
    pub(super) fn grow(&mut self, face: u32, aabb: Aabb) {
        let mut at = self.leaf[face as usize];
        while at != NONE {
            let node = &mut self.nodes[at as usize];
            let grown = node.aabb.union(aabb);
            if grown == node.aabb {
                return;
            }
            node.aabb = grown;
            at = node.parent;
        }
    }

    /// Adds the faces of all leaves that meet a box to a list, those that were removed included.
    pub(super) fn near(&self, aabb: &Aabb, stack: &mut Vec<u32>, faces: &mut Vec<u32>) {
        stack.clear();
        stack.push(0);
        while let Some(at) = stack.pop() {
            let node = &self.nodes[at as usize];
            if !node.aabb.meets(aabb) {
                continue;
            }
            if node.faces == 0 {
                stack.extend([node.first, node.first + 1]);
            } else {
                faces.extend(&self.order[node.first as usize..][..node.faces as usize]);
            }
        }
    }
}

impl Item {
    fn of(mesh: &DynamicMesh, face: u32) -> Self {
        let corners = mesh.corners(face).map(|v| mesh.positions[v as usize].to_array());
        let aabb = Aabb::of_points(&corners);
        let middle = [0, 1, 2].map(|k| 0.5 * (aabb.lower[k] + aabb.upper[k]));
        Self { face, aabb, middle }
    }
}

/// Puts the faces on the lesser side of their longest extent first; returns how many these are.
fn halve(items: &mut [Item]) -> usize {
    let mut middles = Aabb::EMPTY;
    for item in items.iter() {
        middles = middles.union(Aabb::of_points(&[item.middle]));
    }
    let extent = |k: usize| middles.upper[k] - middles.lower[k];
    let longest = (1..3).fold(0, |best, k| if extent(k) > extent(best) { k } else { best });
    let half = items.len() / 2;
    items.select_nth_unstable_by(half, |x, y| {
        x.middle[longest].total_cmp(&y.middle[longest]).then(x.face.cmp(&y.face))
    });
    half
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::Random;
    use pompeiu_core::mesh::shapes::icosphere;

    #[test]
    fn all_faces_near_a_box_are_found_while_they_move() {
        let sphere = icosphere(1.0, 3).expect("a sphere");
        let mut mesh = DynamicMesh::new(sphere.positions(), sphere.faces()).expect("a manifold");
        let mut tree = FaceTree::build(&mesh);
        let mut random = Random::new(7);
        let mut number = || f64::from(random.below(1 << 16)) / 65536.0;
        let (mut stack, mut found, mut all) = (Vec::new(), Vec::new(), 0);
        for step in 0..300 {
            let v = step * 2 % mesh.positions.len();
            mesh.positions[v] *= 0.5 + number();
            for h in mesh.halfedges_from(v as u32).collect::<Vec<_>>() {
                tree.grow(h / 3, Item::of(&mesh, h / 3).aabb);
            }
            let (p, size) = ([(); 3].map(|()| 2.0 * number() - 1.0), 0.3 * number());
            let aabb = Aabb { lower: p, upper: p.map(|x| x + size) };
            found.clear();
            tree.near(&aabb, &mut stack, &mut found);
            for f in (0..mesh.face_count() as u32).filter(|&f| Item::of(&mesh, f).aabb.meets(&aabb)) {
                assert!(found.contains(&f), "face {f}");
                all += 1;
            }
            assert!(found.len() < mesh.face_count());
        }
        assert!(all > 1000, "{all}");
    }
}
