//! Halfedge connectivity that can be edited.

use glam::DVec3;
use pompeiu_core::{MeshError, TriMesh};

/// No halfedge, vertex or face.
pub(crate) const NONE: u32 = u32::MAX;

/// Why faces are no manifold surface that can be edited.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ConnectivityError {
    /// A face names one vertex twice.
    #[error("face {face} has vertex {vertex} at two of its corners; `pompeiu repair` removes such faces")]
    RepeatedVertex {
        /// The face.
        face: u32,
        /// The vertex.
        vertex: u32,
    },
    /// Two faces run along an edge in the same direction: more than two faces meet there, or two are turned against each other.
    #[error(
        "faces {faces:?} both run from vertex {from} to vertex {to}: the edge is not manifold, or the faces are not oriented \
         alike; `pompeiu repair` splits and orients such faces, and cuts surfaces with one side only open"
    )]
    SharedHalfedge {
        /// Both faces.
        faces: [u32; 2],
        /// Where the edge starts.
        from: u32,
        /// Where it ends.
        to: u32,
    },
    /// The faces around a vertex form more than one fan.
    #[error("the faces around vertex {vertex} form several fans; `pompeiu repair` splits such vertices")]
    SeveralFans {
        /// The vertex.
        vertex: u32,
    },
}

/// A triangle surface whose edges can be flipped, split and collapsed.
///
/// Halfedge `3 f + i` starts at corner `i` of face `f` and runs to the next corner. Removed faces and vertices leave gaps, which
/// [`DynamicMesh::to_mesh`] closes.
///
/// # Invariant
/// The surface is an oriented manifold, with or without boundary: every halfedge has at most one twin, and the faces around a
/// vertex form one fan. Every operation checks whether it keeps this before it changes anything.
#[derive(Clone, Debug, PartialEq)]
pub struct DynamicMesh {
    pub(crate) positions: Vec<DVec3>,
    /// The vertex where each halfedge starts; [`NONE`] in removed faces.
    pub(crate) origin: Vec<u32>,
    /// The halfedge that runs the other way; [`NONE`] at the boundary.
    pub(crate) twin: Vec<u32>,
    /// A halfedge that starts at each vertex, at a boundary vertex the one without a twin; [`NONE`] for removed vertices and
    /// those without faces.
    pub(crate) outgoing: Vec<u32>,
    pub(crate) faces: usize,
    pub(crate) free_faces: Vec<u32>,
    pub(crate) free_vertices: Vec<u32>,
}

/// The next halfedge in the same face.
#[inline]
pub(crate) fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

/// The halfedge before in the same face.
#[inline]
pub(crate) fn previous(h: u32) -> u32 {
    if h.is_multiple_of(3) { h + 2 } else { h - 1 }
}

impl DynamicMesh {
    /// Finds out which face meets which.
    ///
    /// # Errors
    /// [`ConnectivityError`] names the first element that is not manifold or not oriented like its neighbours.
    /// # Cost
    /// O(m log m) for m faces; some 40 bytes per face and 28 per vertex.
    pub fn new(positions: &[[f64; 3]], faces: &[[u32; 3]]) -> Result<Self, ConnectivityError> {
        let origin: Vec<u32> = faces.iter().flatten().copied().collect();
        for (f, face) in faces.iter().enumerate() {
            if let Some(i) = (0..3).find(|&i| face[i] == face[(i + 1) % 3]) {
                return Err(ConnectivityError::RepeatedVertex { face: f as u32, vertex: face[i] });
            }
        }
        let mut mesh = Self {
            positions: positions.iter().copied().map(DVec3::from_array).collect(),
            twin: twins(&origin, positions.len())?,
            outgoing: vec![NONE; positions.len()],
            faces: faces.len(),
            origin,
            free_faces: Vec::new(),
            free_vertices: Vec::new(),
        };
        mesh.find_outgoing()?;
        Ok(mesh)
    }

    /// Chooses a halfedge of each vertex, and checks that its faces form one fan.
    fn find_outgoing(&mut self) -> Result<(), ConnectivityError> {
        let mut valence = vec![0_u32; self.positions.len()];
        for h in 0..self.origin.len() as u32 {
            let v = self.origin[h as usize];
            valence[v as usize] += 1;
            if self.outgoing[v as usize] == NONE || self.twin[h as usize] == NONE {
                self.outgoing[v as usize] = h;
            }
        }
        for v in 0..self.positions.len() as u32 {
            let in_fan = self.halfedges_from(v).count() as u32;
            if in_fan != valence[v as usize] {
                return Err(ConnectivityError::SeveralFans { vertex: v });
            }
        }
        Ok(())
    }

    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.faces
    }

    /// The positions of the vertices, those of removed ones included.
    #[inline]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The positions to be changed: connectivity does not depend on them.
    #[inline]
    pub fn positions_mut(&mut self) -> &mut [DVec3] {
        &mut self.positions
    }

    /// The vertices of each face by its number; `u32::MAX` in removed faces.
    #[inline]
    pub fn face_slots(&self) -> &[[u32; 3]] {
        self.origin.as_chunks::<3>().0
    }

    /// Whether faces meet at a vertex.
    #[inline]
    pub fn has_faces(&self, v: u32) -> bool {
        self.outgoing[v as usize] != NONE
    }

    /// Number of halfedges, those of removed faces included.
    pub(crate) fn halfedge_slots(&self) -> u32 {
        self.origin.len() as u32
    }

    /// Whether a halfedge belongs to a face that was not removed.
    #[inline]
    pub(crate) fn exists(&self, h: u32) -> bool {
        self.origin[h as usize] != NONE
    }

    /// The vertex where a halfedge starts.
    #[inline]
    pub(crate) fn from(&self, h: u32) -> u32 {
        self.origin[h as usize]
    }

    /// The vertex where it ends.
    #[inline]
    pub(crate) fn to(&self, h: u32) -> u32 {
        self.origin[next(h) as usize]
    }

    /// The halfedge that runs the other way, if there is one.
    #[inline]
    pub fn twin_of(&self, h: u32) -> Option<u32> {
        let t = self.twin[h as usize];
        (t != NONE).then_some(t)
    }

    /// The three vertices of a face.
    #[inline]
    pub fn corners(&self, f: u32) -> [u32; 3] {
        [0, 1, 2].map(|i| self.origin[(3 * f + i) as usize])
    }

    /// The halfedges that start at a vertex, counter-clockwise; at a boundary vertex the first has no twin.
    #[inline]
    pub fn halfedges_from(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        let first = self.outgoing[v as usize];
        let mut at = first;
        std::iter::from_fn(move || {
            if at == NONE {
                return None;
            }
            let h = at;
            at = self.twin[previous(h) as usize];
            if at == first {
                at = NONE;
            }
            Some(h)
        })
    }

    /// The neighbours of a vertex.
    #[inline]
    pub fn neighbours(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        // Only at the boundary is there a neighbour to which no halfedge leads.
        let last = if self.is_boundary(v) { self.halfedges_from(v).last() } else { None };
        let beyond = last.map(|h| self.from(previous(h)));
        self.halfedges_from(v).map(|h| self.to(h)).chain(beyond)
    }

    /// Whether a vertex lies on the boundary.
    #[inline]
    pub fn is_boundary(&self, v: u32) -> bool {
        let h = self.outgoing[v as usize];
        h == NONE || self.twin[h as usize] == NONE
    }

    /// Whether two vertices are joined by an edge.
    pub(crate) fn are_joined(&self, v: u32, w: u32) -> bool {
        self.neighbours(v).any(|x| x == w)
    }

    /// Whether a halfedge exists and is the one by which its edge is named.
    #[inline]
    pub(crate) fn names_edge(&self, h: u32) -> bool {
        self.exists(h) && self.twin_of(h).is_none_or(|t| h < t)
    }

    /// The halfedge by which the edge of another one is named.
    #[inline]
    pub(crate) fn name_of(&self, h: u32) -> u32 {
        self.twin_of(h).map_or(h, |t| h.min(t))
    }

    /// A halfedge of each edge at a vertex.
    pub(crate) fn edges_at(&self, v: u32) -> impl Iterator<Item = u32> + '_ {
        // At the boundary the last edge has a halfedge towards the vertex only.
        let towards = |h| Some(previous(h)).filter(|&last| self.twin_of(last).is_none());
        self.halfedges_from(v).flat_map(move |h| [Some(h), towards(h)].into_iter().flatten())
    }

    /// One halfedge of each edge, in order.
    pub(crate) fn edges(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.halfedge_slots()).filter(|&h| self.names_edge(h))
    }

    /// The vertex after one of the boundary, along it.
    #[inline]
    pub fn next_on_boundary(&self, v: u32) -> u32 {
        self.to(self.outgoing[v as usize])
    }

    /// Number of neighbours that a vertex of a regular triangulation has: 6, or 4 at the boundary.
    pub(crate) fn regular_valence(&self, v: u32) -> usize {
        if self.is_boundary(v) { 4 } else { 6 }
    }

    /// The first vertex of the first component without boundary, if there is one.
    pub fn closed_component(&self) -> Option<u32> {
        let mut seen: Vec<bool> = self.outgoing.iter().map(|h| *h == NONE).collect();
        for first in 0..seen.len() as u32 {
            let mut open = vec![first];
            let mut closed = !seen[first as usize];
            while let Some(v) = open.pop() {
                if !std::mem::replace(&mut seen[v as usize], true) {
                    closed &= !self.is_boundary(v);
                    open.extend(self.neighbours(v));
                }
            }
            if closed {
                return Some(first);
            }
        }
        None
    }

    /// The signed volume that the faces enclose, rounded; none if there is a boundary.
    pub(super) fn volume(&self) -> Option<f64> {
        let mut sum = 0.0;
        for f in (0..self.halfedge_slots() / 3).filter(|&f| self.exists(3 * f)) {
            if (3 * f..3 * f + 3).any(|h| self.twin[h as usize] == NONE) {
                return None;
            }
            let [a, b, c] = self.corners(f).map(|v| self.positions[v as usize]);
            sum += a.dot(b.cross(c));
        }
        Some(sum / 6.0)
    }

    /// Puts every vertex elsewhere.
    pub fn map_positions(&mut self, to: impl Fn([f64; 3]) -> [f64; 3]) {
        for p in &mut self.positions {
            *p = DVec3::from_array(to(p.to_array()));
        }
    }

    /// Turns clockwise from a halfedge to the first one that starts at its vertex, and makes that the vertex's own.
    pub(crate) fn choose_outgoing(&mut self, from: u32) {
        let mut h = from;
        while let Some(t) = self.twin_of(h) {
            h = next(t);
            if h == from {
                break;
            }
        }
        let v = self.from(h);
        self.outgoing[v as usize] = h;
    }

    /// Makes two halfedges twins; either may be [`NONE`].
    pub(crate) fn glue(&mut self, h: u32, t: u32) {
        if h != NONE {
            self.twin[h as usize] = t;
        }
        if t != NONE {
            self.twin[t as usize] = h;
        }
    }

    /// The surface as a mesh without gaps: faces and vertices keep their order, vertices without faces are left out.
    ///
    /// # Errors
    /// [`MeshError`] if no face is left or a coordinate is not finite.
    pub fn to_mesh(&self) -> Result<TriMesh, MeshError> {
        let number = self.numbers();
        let in_use = self.positions.iter().zip(&number).filter(|(_, number)| **number != NONE);
        let positions = in_use.map(|(p, _)| p.to_array()).collect();
        let corners = self.origin.as_chunks::<3>().0.iter();
        let faces = corners.filter(|c| c[0] != NONE).map(|c| c.map(|v| number[v as usize])).collect();
        TriMesh::new(positions, faces)
    }

    /// The number that [`DynamicMesh::to_mesh`] gives each vertex; [`NONE`] for vertices without faces.
    pub(super) fn numbers(&self) -> Vec<u32> {
        let mut count = 0;
        let mut number = |own: &u32| {
            let exists = *own != NONE;
            count += u32::from(exists);
            if exists { count - 1 } else { NONE }
        };
        self.outgoing.iter().map(&mut number).collect()
    }

    /// Checks every invariant; for tests.
    ///
    /// # Panics
    /// If one does not hold.
    #[doc(hidden)]
    pub fn assert_valid(&self) {
        let alive = (0..self.halfedge_slots()).filter(|&h| self.exists(h));
        assert_eq!(alive.clone().count(), 3 * self.faces);
        let mut valence = vec![0; self.positions.len()];
        for h in alive {
            valence[self.from(h) as usize] += 1;
            assert_ne!(self.from(h), self.to(h), "halfedge {h} is a loop");
            if let Some(t) = self.twin_of(h) {
                assert!(self.exists(t) && self.twin[t as usize] == h, "twins of {h} and {t} disagree");
                assert_eq!((self.from(h), self.to(h)), (self.to(t), self.from(t)), "halfedge {h}");
            }
        }
        for (v, &valence) in valence.iter().enumerate() {
            let own = self.outgoing[v];
            assert_eq!(own == NONE, valence == 0, "vertex {v}");
            assert_eq!(self.halfedges_from(v as u32).count(), valence, "the fan of vertex {v}");
            if valence > 0 {
                assert_eq!(self.from(own) as usize, v);
                let open = self.halfedges_from(v as u32).any(|h| self.twin[h as usize] == NONE);
                assert!(!open || self.twin[own as usize] == NONE, "vertex {v} starts inside its fan");
            }
            let mut around: Vec<u32> = self.neighbours(v as u32).collect();
            let count = around.len();
            around.sort_unstable();
            around.dedup();
            assert_eq!(around.len(), count, "two edges between vertex {v} and a neighbour");
        }
    }
}

/// The twin of each halfedge, of so many vertices.
fn twins(origin: &[u32], vertices: usize) -> Result<Vec<u32>, ConnectivityError> {
    let end = |h: u32| origin[next(h) as usize];
    let lesser = |h: u32| origin[h as usize].min(end(h)) as usize;
    let all = 0..origin.len() as u32;
    // Halfedges by the lesser end of their edge, each with the greater one.
    let mut starts = vec![0_u32; vertices + 1];
    all.clone().for_each(|h| starts[lesser(h) + 1] += 1);
    for v in 0..vertices {
        starts[v + 1] += starts[v];
    }
    let mut filled = starts.clone();
    let mut order = vec![(0_u32, 0_u32); origin.len()];
    for h in all {
        let place = &mut filled[lesser(h)];
        order[*place as usize] = (origin[h as usize].max(end(h)), h);
        *place += 1;
    }
    let mut twin = vec![NONE; origin.len()];
    for v in 0..vertices {
        let own = &mut order[starts[v] as usize..starts[v + 1] as usize];
        own.sort_unstable();
        for edge in own.chunk_by(|x, y| x.0 == y.0) {
            match_halfedges(edge, origin, &mut twin)?;
        }
    }
    Ok(twin)
}

/// Makes the halfedges of one edge twins, if there are two that run opposite ways.
fn match_halfedges(edge: &[(u32, u32)], origin: &[u32], twin: &mut [u32]) -> Result<(), ConnectivityError> {
    let from = |h: u32| origin[h as usize];
    for (i, &(_, h)) in edge.iter().enumerate() {
        if let Some(&(_, g)) = edge[..i].iter().find(|(_, g)| from(*g) == from(h)) {
            let to = from(next(h));
            return Err(ConnectivityError::SharedHalfedge { faces: [g / 3, h / 3], from: from(h), to });
        }
    }
    if let [(_, h), (_, t)] = *edge {
        twin[h as usize] = t;
        twin[t as usize] = h;
    }
    Ok(())
}
