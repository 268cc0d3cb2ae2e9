//! Changes of a remeshed surface after which fewer of its faces intersect, one place after the other.
//!
//! Faces intersect where sheets are nearer to each other than edges are long. There a vertex is moved, an edge flipped or collapsed, where
//! this leaves fewer pairs.

use super::face_tree::FaceTree;
use super::flips::hinge;
use super::local::{Collapsible, Fan, Local, flipped, least_sine};
use super::marked::{Collapse, Freedom, Hold};
use super::triangle::Triangle;
use glam::DVec3;
use pompeiu_core::geom::Aabb;
use pompeiu_core::spatial::bvh::Slot;
use pompeiu_core::spatial::{faces_intersect, self_intersections};
use pompeiu_core::{MeshError, TriMesh};
use std::collections::BTreeMap;

/// Rounds over the pairs that are left; in the first ones no angle becomes less than this one, in degrees, that was not before.
const ROUNDS: usize = 6;
const CAREFUL: usize = 3;
const LEAST_ANGLE: f64 = 28.0;

/// Pairs that are looked at in a round, at most: where there are more, edges are too long for the surface.
const MOST_PAIRS: usize = 64;

/// First step of a vertex, in target lengths.
const STEP: f64 = 0.3;

/// How far a collapse may move the surface, in target lengths.
const MOVED: f64 = 0.5;

/// Where the faces of a surface are, with memory for searches.
struct Faces {
    tree: FaceTree,
    stack: Vec<u32>,
    near: Vec<u32>,
    /// The sine of the least angle that a change may make, unless it was less before.
    least: f64,
    known: Known,
}

/// What was changed, and where nothing could be.
#[derive(Default)]
struct Known {
    /// Boxes of the faces around each change, before and after it.
    changes: Vec<Aabb>,
    /// Faces at which no change left fewer pairs, with the number of changes before.
    failed: BTreeMap<u32, usize>,
}

impl Known {
    /// Whether nothing was found at a face, and nothing has changed since within a box around all that was tried there.
    fn fails(&self, f: u32, around: &Aabb) -> bool {
        self.failed.get(&f).is_some_and(|&before| !self.changes[before..].iter().any(|x| x.meets(around)))
    }
}

impl Faces {
    fn allow(&self, old: &[Triangle], new: &[Triangle]) -> bool {
        let least = least_sine(new);
        least >= self.least || least >= least_sine(old)
    }
}

impl Local<'_> {
    /// Lowers the number of pairs of faces that intersect.
    pub(super) fn untangle(&mut self) -> Result<(), MeshError> {
        let careful = libm::sin(LEAST_ANGLE.to_radians());
        let mut known = Known::default();
        let mut round = 0;
        while round < ROUNDS && !self.is_stopped() {
            let mesh = &self.surface.mesh;
            let alive: Vec<u32> = (0..mesh.halfedge_slots() / 3).filter(|&f| mesh.exists(3 * f)).collect();
            let positions = mesh.positions.iter().map(DVec3::to_array).collect();
            let whole = TriMesh::new(positions, alive.iter().map(|&f| mesh.corners(f)).collect())?;
            let found = self_intersections(&whole, MOST_PAIRS);
            if found.pairs.is_empty() || !found.complete {
                break;
            }
            if round == CAREFUL {
                // More is allowed now.
                known.failed.clear();
            }
            let least = if round < CAREFUL { careful } else { 0.0 };
            let tree = FaceTree::build(mesh);
            let mut faces = Faces { tree, stack: Vec::new(), near: Vec::new(), least, known };
            let mut done = false;
            for pair in found.pairs {
                if self.is_stopped() {
                    return Ok(());
                }
                done |= pair.faces.into_iter().any(|f| self.untangle_at(alive[f.index()], &mut faces));
            }
            known = faces.known;
            round = match round {
                // The other careful rounds would find the same.
                ..CAREFUL if !done => CAREFUL,
                _ if !done => break,
                _ => round + 1,
            };
        }
        Ok(())
    }

    fn untangle_at(&mut self, f: u32, faces: &mut Faces) -> bool {
        if !self.surface.mesh.exists(3 * f) {
            return false;
        }
        let around = self.reach(f);
        if faces.known.fails(f, &around) {
            return false;
        }
        let sides = [3 * f, 3 * f + 1, 3 * f + 2];
        let is_done = sides.into_iter().any(|h| self.move_apart(self.surface.mesh.from(h), faces))
            || sides.into_iter().any(|h| self.flip_apart(h, faces))
            || sides.into_iter().any(|h| self.collapse_apart(h, faces));
        if !is_done {
            faces.known.failed.insert(f, faces.known.changes.len());
        }
        is_done
    }

    /// A box around all that the changes at a face depend on: a vertex is tried within a step of where it is, or of the point of the
    /// input that is nearest to there, at most a target length away.
    fn reach(&self, f: u32) -> Aabb {
        let mesh = &self.surface.mesh;
        let mut all = Aabb::EMPTY;
        for v in mesh.corners(f) {
            let fan = mesh.halfedges_from(v).flat_map(|h| self.surface.triangle(h / 3));
            let Aabb { lower, upper } = fan.fold(Aabb::EMPTY, |mut aabb, p| {
                aabb.add(p.to_array());
                aabb
            });
            let by = (1.0 + STEP) * self.surface.length[v as usize];
            all = all.union(Aabb { lower: lower.map(|x| x - by), upper: upper.map(|x| x + by) });
        }
        all
    }

    fn move_apart(&mut self, v: u32, faces: &mut Faces) -> bool {
        if self.surface.hold[v as usize] != Hold::Free {
            return false;
        }
        let own: Vec<u32> = self.surface.mesh.halfedges_from(v).map(|h| h / 3).collect();
        let fan = Fan::new(self.surface, v);
        let before = self.crossings(&own, &fan.faces, faces);
        if before == 0 {
            return false;
        }
        // Fewer pairs first, then greater angles.
        let measure = |s: &mut Self, moved: &Fan, _: Slot, least: f64| {
            let sine = least_sine(&moved.faces);
            if -sine >= least || !faces.allow(&fan.faces, &moved.faces) || !moved.keeps_normals(&fan) {
                return f64::INFINITY;
            }
            s.crossings(&own, &moved.faces, faces) as f64 - sine
        };
        let Some((position, near)) = self.search(v, &fan, STEP, before as f64 - 1.0, measure) else {
            return false;
        };
        self.surface.mesh.positions[v as usize] = position;
        self.surface.near[v as usize] = near;
        self.grow(&own, &fan.faces, faces);
        true
    }

    fn flip_apart(&mut self, h: u32, faces: &mut Faces) -> bool {
        let Some(t) = self.surface.mesh.twin_of(h) else { return false };
        let corners = hinge(&self.surface.mesh, h, t).map(|v| self.surface.mesh.positions[v as usize]);
        let Some([old, new]) = flipped(corners) else { return false };
        let own = [h / 3, t / 3];
        if !faces.allow(&old, &new) {
            return false;
        }
        if self.crossings(&own, &new, faces) >= self.crossings(&own, &old, faces) || !self.surface.flip(h) {
            return false;
        }
        self.grow(&own, &old, faces);
        true
    }

    fn collapse_apart(&mut self, h: u32, faces: &mut Faces) -> bool {
        let Some(edge) = Collapsible::new(self.surface, h) else { return false };
        let before = self.crossings(&edge.star.gone, &edge.old, faces);
        let positions = match edge.way.freedom {
            Freedom::None => vec![edge.way.position],
            Freedom::Curve | Freedom::Surface => edge.ends.to_vec(),
        };
        let mut new = Vec::with_capacity(edge.star.kept.len());
        for position in positions {
            if edge.place(self.surface, position, &mut new)
                && faces.allow(&edge.old, &new)
                && self.keeps_near(edge.vertex, &edge.ends, &edge.old, &new, MOVED)
                && self.crossings(&edge.star.gone, &new, faces) < before
            {
                let is_done = self.surface.collapse(&Collapse { position, ..edge.way }).is_some();
                self.grow(&edge.star.kept, &edge.old, faces);
                return is_done;
            }
        }
        false
    }

    /// The number of pairs of which one is among some triangles, and the other is, too, or is a face beside some own ones.
    fn crossings(&self, own: &[u32], triangles: &[Triangle], faces: &mut Faces) -> usize {
        let arrays: Vec<[[f64; 3]; 3]> = triangles.iter().map(|t| t.map(|p| p.to_array())).collect();
        let boxes: Vec<Aabb> = arrays.iter().map(Aabb::of_points).collect();
        let all = boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union);
        faces.near.clear();
        faces.tree.near(&all, &mut faces.stack, &mut faces.near);
        let mut count = 0;
        for &f in faces.near.iter().filter(|f| self.surface.mesh.exists(3 * **f) && !own.contains(f)) {
            let other = self.surface.triangle(f).map(|p| p.to_array());
            let around = Aabb::of_points(&other);
            let beside = arrays.iter().zip(&boxes).filter(|(_, aabb)| aabb.meets(&around));
            count += beside.filter(|(one, _)| faces_intersect(one, &other)).count();
        }
        for (i, one) in arrays.iter().enumerate() {
            count += arrays[..i].iter().filter(|other| faces_intersect(one, other)).count();
        }
        count
    }

    /// Takes note of a change: the faces that it made, and where those before were.
    fn grow(&self, own: &[u32], old: &[Triangle], faces: &mut Faces) {
        let mut all = Aabb::of_points(&old.iter().flatten().map(DVec3::to_array).collect::<Vec<_>>());
        for &f in own {
            let aabb = Aabb::of_points(&self.surface.triangle(f).map(|p| p.to_array()));
            faces.tree.grow(f, aabb);
            all = all.union(aabb);
        }
        faces.known.changes.push(all);
    }
}
