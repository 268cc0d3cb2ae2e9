//! A surface under remeshing: connectivity with the curves and vertices that must be kept.

use super::connectivity::{DynamicMesh, NONE, next, previous};
use glam::DVec3;
use pompeiu_core::VertexId;
use pompeiu_core::spatial::Slot;

/// What holds a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hold {
    /// Nothing: it may move within the surface.
    Free,
    /// It may move along this curve.
    Curve(u32),
    /// It stays.
    Corner,
}

/// A [`DynamicMesh`] whose edges may belong to curves, and whose vertices have a target length for their edges.
#[derive(Clone, Debug)]
pub(super) struct Marked {
    pub(super) mesh: DynamicMesh,
    /// The curve of each halfedge's edge; [`NONE`] for most.
    pub(super) curve: Vec<u32>,
    pub(super) hold: Vec<Hold>,
    /// The target length at each vertex.
    pub(super) length: Vec<f64>,
    /// A face of the input near each vertex.
    pub(super) near: Vec<Slot>,
}

/// What a collapse does: the halfedge whose start is removed, and where its end goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Collapse {
    pub(super) halfedge: u32,
    pub(super) position: DVec3,
    pub(super) freedom: Freedom,
}

/// Where the end of a collapse may go instead.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Freedom {
    /// Nowhere else.
    None,
    /// Along the curve that the edge is part of.
    Curve,
    /// Anywhere.
    Surface,
}

impl Marked {
    /// The positions of the corners of a face.
    pub(super) fn triangle(&self, f: u32) -> [DVec3; 3] {
        self.mesh.corners(f).map(|v| self.mesh.positions[v as usize])
    }

    /// The edges of curves, by the numbers of their ends in [`DynamicMesh::to_mesh`].
    pub(super) fn kept(&self) -> Vec<[VertexId; 2]> {
        let number = self.mesh.numbers();
        let on_curve = self.mesh.edges().filter(|&h| self.curve[h as usize] != NONE);
        let ends = |h| [self.mesh.from(h), self.mesh.to(h)].map(|v| VertexId(number[v as usize]));
        on_curve.map(ends).collect()
    }

    /// The edges of curves, by their ends.
    pub(super) fn on_curves(&self) -> Vec<[VertexId; 2]> {
        let on_curve = self.mesh.edges().filter(|&h| self.curve[h as usize] != NONE);
        on_curve.map(|h| [self.mesh.from(h), self.mesh.to(h)].map(VertexId)).collect()
    }

    /// Whether the edge between two vertices belongs to a curve.
    pub(super) fn is_on_curve(&self, [from, to]: [u32; 2]) -> bool {
        self.mesh.halfedges_from(from).any(|h| self.mesh.to(h) == to && self.curve[h as usize] != NONE)
    }

    /// The vector along a halfedge.
    pub(super) fn along(&self, h: u32) -> DVec3 {
        self.mesh.positions[self.mesh.to(h) as usize] - self.mesh.positions[self.mesh.from(h) as usize]
    }

    /// The square of the length of an edge as a share of its target, which is the lesser one of both ends.
    pub(super) fn share_sq(&self, h: u32) -> f64 {
        let [p, q] = [self.mesh.from(h), self.mesh.to(h)].map(|v| self.length[v as usize]);
        let target = if p < q { p } else { q };
        self.along(h).length_squared() / (target * target)
    }

    /// Flips an edge that is on no curve.
    pub(super) fn flip(&mut self, h: u32) -> bool {
        if self.curve[h as usize] != NONE || self.mesh.check_flip(h).is_err() {
            return false;
        }
        let t = self.mesh.twin[h as usize];
        let sides = [next(h), previous(h), next(t), previous(t)];
        let curves = sides.map(|x| self.curve[x as usize]);
        let [h1, h2, t1, t2] = sides;
        for (side, curve) in [h2, t1, t2, h1].into_iter().zip(curves) {
            self.curve[side as usize] = curve;
        }
        self.mesh.flip(h).is_ok()
    }

    /// Splits an edge in its middle; returns the new vertex.
    pub(super) fn split(&mut self, h: u32) -> u32 {
        let t = self.mesh.twin[h as usize];
        let [u, v] = [self.mesh.from(h), self.mesh.to(h)];
        let curve = self.curve[h as usize];
        let (beyond, before) =
            (self.curve[next(h) as usize], (t != NONE).then(|| self.curve[previous(t) as usize]));
        let middle = 0.5 * (self.mesh.positions[u as usize] + self.mesh.positions[v as usize]);
        let w = self.mesh.split(h, middle);
        self.curve.resize(self.mesh.origin.len(), NONE);
        let upper = self.mesh.outgoing[w as usize];
        self.mark([upper, next(upper), previous(upper)], [curve, beyond, NONE]);
        self.curve[next(h) as usize] = NONE;
        if let Some(before) = before {
            let lower = self.mesh.twin[upper as usize];
            self.mark([lower, next(lower), previous(lower)], [curve, NONE, before]);
            self.curve[previous(t) as usize] = NONE;
        }
        self.add_vertex(w, u, v, curve);
        w
    }

    fn mark(&mut self, halfedges: [u32; 3], curves: [u32; 3]) {
        for (h, curve) in halfedges.into_iter().zip(curves) {
            self.curve[h as usize] = curve;
        }
    }

    /// Sets what a new vertex between two others has.
    fn add_vertex(&mut self, w: u32, u: u32, v: u32, curve: u32) {
        let hold = if curve == NONE { Hold::Free } else { Hold::Curve(curve) };
        let length = 0.5 * (self.length[u as usize] + self.length[v as usize]);
        let near = self.near[u as usize];
        if w as usize == self.hold.len() {
            self.hold.push(hold);
            self.length.push(length);
            self.near.push(near);
        } else {
            (self.hold[w as usize], self.length[w as usize], self.near[w as usize]) = (hold, length, near);
        }
    }

    /// How an edge may be collapsed so that curves and corners stay; none if it may not.
    pub(super) fn collapse_of(&self, h: u32) -> Option<Collapse> {
        let [u, v] = [self.mesh.from(h), self.mesh.to(h)];
        let [p, q] = [u, v].map(|x| self.mesh.positions[x as usize]);
        let curve = self.curve[h as usize];
        let middle = 0.5 * (p + q);
        let towards = |halfedge: Option<u32>, position, freedom| {
            halfedge.map(|halfedge| Collapse { halfedge, position, freedom })
        };
        let onto = |halfedge, position| towards(halfedge, position, Freedom::None);
        let (same, other) = (Some(h), self.mesh.twin_of(h));
        let found = match (self.hold[u as usize], self.hold[v as usize]) {
            (Hold::Free, Hold::Free) => towards(same, middle, Freedom::Surface),
            (Hold::Free, _) => onto(same, q),
            (_, Hold::Free) => onto(other, p),
            (Hold::Curve(c), Hold::Curve(d)) if c == d && curve == c => towards(same, middle, Freedom::Curve),
            (Hold::Curve(c), Hold::Corner) if curve == c => onto(same, q),
            // At the boundary there is no halfedge the other way.
            (Hold::Corner, Hold::Curve(c)) if curve == c => match other {
                Some(t) => onto(Some(t), p),
                None => onto(same, p),
            },
            _ => None,
        }?;
        // Two curves must not become one.
        let sides = [Some(h), other].into_iter().flatten();
        let both = |x: u32| self.curve[next(x) as usize] != NONE && self.curve[previous(x) as usize] != NONE;
        if sides.into_iter().any(both) || self.mesh.check_collapse(found.halfedge).is_err() {
            return None;
        }
        Some(found)
    }

    /// Does what [`Marked::collapse_of`] found; returns the vertex that stays.
    pub(super) fn collapse(&mut self, collapse: &Collapse) -> Option<u32> {
        self.mesh.check_collapse(collapse.halfedge).ok()?;
        Some(self.collapse_checked(collapse))
    }

    /// Does what [`Marked::collapse_of`] found on the surface as it is; returns the vertex that stays.
    pub(super) fn collapse_checked(&mut self, collapse: &Collapse) -> u32 {
        let h = collapse.halfedge;
        let [u, v] = [self.mesh.from(h), self.mesh.to(h)];
        // Of the two edges that become one, the curve, and the halfedges that stay.
        let merged = [Some(h), self.mesh.twin_of(h)].map(|side| {
            side.map(|x| {
                let [a, b] = [next(x), previous(x)];
                let curve = [a, b].map(|y| self.curve[y as usize]).into_iter().find(|c| *c != NONE);
                (curve.unwrap_or(NONE), [a, b].map(|y| self.mesh.twin[y as usize]))
            })
        });
        self.mesh.collapse_checked(h, collapse.position);
        for (curve, stay) in merged.into_iter().flatten() {
            for y in stay.into_iter().filter(|y| *y != NONE) {
                self.curve[y as usize] = curve;
            }
        }
        // What is held more stays held: a corner at the boundary may have been the start.
        let (hold, other) = (self.hold[v as usize], self.hold[u as usize]);
        if other == Hold::Corner || hold == Hold::Free {
            self.hold[v as usize] = other;
        }
        self.length[v as usize] = 0.5 * (self.length[u as usize] + self.length[v as usize]);
        v
    }

    /// Checks that curves are marked on both sides of their edges and run through the vertices that they hold; for tests.
    #[cfg(test)]
    pub(super) fn assert_valid(&self) {
        self.mesh.assert_valid();
        let mut ends = vec![Vec::new(); self.mesh.positions.len()];
        for h in self.mesh.edges() {
            let curve = self.curve[h as usize];
            match self.mesh.twin_of(h) {
                Some(t) => assert_eq!(curve, self.curve[t as usize], "both sides of halfedge {h}"),
                None => assert_ne!(curve, NONE, "halfedge {h} of the boundary"),
            }
            if curve != NONE {
                ends[self.mesh.from(h) as usize].push(curve);
                ends[self.mesh.to(h) as usize].push(curve);
            }
        }
        for (v, ends) in ends.iter().enumerate().filter(|(v, _)| self.mesh.has_faces(*v as u32)) {
            match self.hold[v] {
                Hold::Free => assert!(ends.is_empty(), "vertex {v} is free on {ends:?}"),
                Hold::Curve(c) => assert_eq!(ends[..], [c, c], "vertex {v}"),
                Hold::Corner => {}
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::features::{Curves, Features};
    use super::*;
    use pompeiu_core::geom::{Aabb, Frame};
    use pompeiu_core::mesh::{Random, shapes};
    use pompeiu_core::spatial::Bvh;

    fn any_slot(mesh: &DynamicMesh) -> Slot {
        let mesh = mesh.to_mesh().expect("a mesh");
        Bvh::build(&mesh, &Frame::of(&Aabb::EMPTY)).any_slot()
    }

    #[test]
    fn random_operations_keep_curves_and_corners() {
        let shapes = [
            shapes::cube(2.0, 4).expect("a cube"),
            shapes::cylinder(1.0, 2.0, 16, 4, shapes::Ends::Open).expect("a cylinder"),
        ];
        for (seed, mesh) in shapes.iter().enumerate() {
            let mesh = DynamicMesh::new(mesh.positions(), mesh.faces()).expect("a manifold");
            let curves = Curves::find(&mesh, &Features { angle: Some(30.0), ..Features::default() });
            let corners = |s: &Marked| {
                let alive = (0..s.hold.len()).filter(|&v| s.mesh.has_faces(v as u32));
                let corners = alive.filter(|&v| s.hold[v] == Hold::Corner);
                let mut places: Vec<_> =
                    corners.map(|v| s.mesh.positions[v].to_array().map(f64::to_bits)).collect();
                places.sort_unstable();
                places
            };
            let (length, slot) = (vec![1.0; mesh.positions.len()], any_slot(&mesh));
            let near = vec![slot; length.len()];
            let mut surface = Marked { mesh, curve: curves.of_halfedge, hold: curves.hold, length, near };
            surface.assert_valid();
            let before = corners(&surface);
            assert_eq!(before.len(), [8, 0][seed]);
            let (mut random, mut done) = (Random::new(seed as u64), [0; 3]);
            for step in 0..30_000 {
                let h = random.below(surface.mesh.halfedge_slots());
                if !surface.mesh.exists(h) {
                    continue;
                }
                let kind = if surface.mesh.face_count() > 800 { 2 } else { random.below(3) as usize };
                done[kind] += u32::from(match kind {
                    0 => surface.flip(h),
                    1 => surface.split(h) < NONE,
                    _ => surface.collapse_of(h).is_some_and(|c| surface.collapse(&c).is_some()),
                });
                if step % 3000 == 0 {
                    surface.assert_valid();
                }
            }
            surface.assert_valid();
            assert!(done.iter().all(|n| *n > 500), "{done:?}");
            assert_eq!(corners(&surface), before);
        }
    }
}
