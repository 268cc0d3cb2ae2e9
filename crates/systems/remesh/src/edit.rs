//! The three operations on edges: flip, split, collapse.

use super::connectivity::{DynamicMesh, NONE, next, previous};
use glam::DVec3;
use pompeiu_surface::HalfedgeId;

/// Why an operation would not leave a manifold surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Illegal {
    /// A boundary edge has one face only.
    Boundary,
    /// The new edge would join two vertices that are joined already, or a vertex with itself.
    EdgeExists,
    /// The two ends have a common neighbour beside the edge's own faces: collapsing would pinch the surface.
    Link,
    /// Both ends lie on the boundary, and the edge does not: collapsing would join two parts of the boundary.
    JoinsBoundary,
    /// A vertex would lose its last faces.
    TooFewFaces,
}

/// Vertices around one: few of them, in a place of their own.
#[derive(Default)]
struct Few {
    own: [u32; 16],
    count: usize,
    more: Vec<u32>,
}

impl Few {
    fn contains(&self, v: u32) -> bool {
        self.own[..self.count].contains(&v) || self.more.contains(&v)
    }
}

impl FromIterator<u32> for Few {
    fn from_iter<I: IntoIterator<Item = u32>>(vertices: I) -> Self {
        let mut few = Self::default();
        for v in vertices {
            match few.own.get_mut(few.count) {
                Some(place) => {
                    *place = v;
                    few.count += 1;
                }
                None => few.more.push(v),
            }
        }
        few
    }
}

impl DynamicMesh {
    /// The halfedges of all faces, in order.
    pub fn halfedges(&self) -> impl Iterator<Item = HalfedgeId> + '_ {
        (0..self.halfedge_slots()).filter(|&h| self.exists(h)).map(HalfedgeId)
    }

    /// Whether a halfedge belongs to a face that was not removed.
    pub fn has_halfedge(&self, h: HalfedgeId) -> bool {
        (h.0 as usize) < self.origin.len() && self.exists(h.0)
    }

    /// Replaces an edge by the other diagonal of its two faces. Four flips of one halfedge give the faces back as they were.
    ///
    /// # Errors
    /// [`Illegal::Boundary`], [`Illegal::EdgeExists`].
    /// # Panics
    /// If the halfedge belongs to no face.
    pub fn flip_edge(&mut self, h: HalfedgeId) -> Result<(), Illegal> {
        assert!(self.exists(h.0), "halfedge {} belongs to no face", h.0);
        self.flip(h.0)
    }

    /// Puts a vertex on an edge, and joins it with the opposite corners. Returns the halfedge from it to the end of `h`: collapsing
    /// that one onto the position of its end gives the faces back as they were.
    ///
    /// # Panics
    /// If the halfedge belongs to no face.
    pub fn split_edge(&mut self, h: HalfedgeId, position: [f64; 3]) -> HalfedgeId {
        assert!(self.exists(h.0), "halfedge {} belongs to no face", h.0);
        let w = self.split(h.0, DVec3::from_array(position));
        HalfedgeId(self.outgoing[w as usize])
    }

    /// Removes the start of a halfedge with the faces at its edge, and moves its end to a position.
    ///
    /// # Errors
    /// [`Illegal`] says what would be wrong with the surface.
    /// # Panics
    /// If the halfedge belongs to no face.
    pub fn collapse_edge(&mut self, h: HalfedgeId, position: [f64; 3]) -> Result<(), Illegal> {
        assert!(self.exists(h.0), "halfedge {} belongs to no face", h.0);
        self.collapse(h.0, DVec3::from_array(position))
    }

    /// Positions of the start and the end of a halfedge.
    ///
    /// # Panics
    /// If the halfedge belongs to no face.
    pub fn ends(&self, h: HalfedgeId) -> [[f64; 3]; 2] {
        [self.from(h.0), self.to(h.0)].map(|v| self.positions[v as usize].to_array())
    }

    /// Whether the edge of a halfedge can be flipped.
    pub(crate) fn check_flip(&self, h: u32) -> Result<(), Illegal> {
        let t = self.twin_of(h).ok_or(Illegal::Boundary)?;
        let (a, b) = (self.from(previous(h)), self.from(previous(t)));
        if a == b || self.are_joined(a, b) { Err(Illegal::EdgeExists) } else { Ok(()) }
    }

    /// See [`DynamicMesh::flip_edge`].
    pub(crate) fn flip(&mut self, h: u32) -> Result<(), Illegal> {
        self.check_flip(h)?;
        let t = self.twin[h as usize];
        let ([h1, h2], [t1, t2]) = ([next(h), previous(h)], [next(t), previous(t)]);
        let [u, v, a, b] = [h, h1, h2, t2].map(|x| self.from(x));
        let outer = [h1, h2, t1, t2].map(|x| self.twin[x as usize]);
        for (x, start) in [(h, a), (h1, b), (h2, v), (t, b), (t1, a), (t2, u)] {
            self.origin[x as usize] = start;
        }
        for (x, across) in [(h2, outer[0]), (t1, outer[1]), (t2, outer[2]), (h1, outer[3])] {
            self.glue(x, across);
        }
        // What starts at each of the four vertices and runs along the outline of both faces.
        for (vertex, gone, own) in [(u, [h, t1], t2), (v, [t, h1], h2), (a, [h2, h2], t1), (b, [t2, t2], h1)]
        {
            if gone.contains(&self.outgoing[vertex as usize]) {
                self.outgoing[vertex as usize] = own;
            }
        }
        Ok(())
    }

    /// See [`DynamicMesh::split_edge`]; returns the new vertex, whose own halfedge leads to the end of `h`.
    pub(crate) fn split(&mut self, h: u32, position: DVec3) -> u32 {
        let t = self.twin[h as usize];
        let w = self.new_vertex(position);
        let upper = self.halve_beyond(h, w);
        self.outgoing[w as usize] = upper;
        if t != NONE {
            let lower = self.halve_before(t, w);
            self.glue(upper, lower);
        }
        w
    }

    /// Cuts the face of a halfedge from `w` on that halfedge to the opposite corner: the face keeps the part at the start, a new
    /// face gets the other. Returns the halfedge from `w` to the end, whose twin is not set.
    fn halve_beyond(&mut self, h: u32, w: u32) -> u32 {
        let (h1, h2) = (next(h), previous(h));
        let (v, a) = (self.from(h1), self.from(h2));
        let across = self.twin[h1 as usize];
        let n = self.new_face([w, v, a]);
        self.origin[h1 as usize] = w;
        self.glue(next(n), across);
        self.glue(previous(n), h1);
        if self.outgoing[v as usize] == h1 {
            self.outgoing[v as usize] = next(n);
        }
        n
    }

    /// The same, with the part at the end kept. Returns the halfedge from the start to `w`, whose twin is not set.
    fn halve_before(&mut self, t: u32, w: u32) -> u32 {
        let t2 = previous(t);
        let (v, b) = (self.from(t), self.from(t2));
        let across = self.twin[t2 as usize];
        let n = self.new_face([v, w, b]);
        self.origin[t as usize] = w;
        self.glue(previous(n), across);
        self.glue(next(n), t2);
        for (vertex, gone, own) in [(v, t, n), (b, t2, previous(n))] {
            if self.outgoing[vertex as usize] == gone {
                self.outgoing[vertex as usize] = own;
            }
        }
        n
    }

    fn new_vertex(&mut self, position: DVec3) -> u32 {
        if let Some(w) = self.free_vertices.pop() {
            self.positions[w as usize] = position;
            return w;
        }
        self.positions.push(position);
        self.outgoing.push(NONE);
        self.positions.len() as u32 - 1
    }

    /// A face with these corners and no twins; the halfedge that starts at the first.
    fn new_face(&mut self, corners: [u32; 3]) -> u32 {
        self.faces += 1;
        let f = self.free_faces.pop().unwrap_or_else(|| {
            self.origin.extend([NONE; 3]);
            self.twin.extend([NONE; 3]);
            self.origin.len() as u32 / 3 - 1
        });
        for (i, corner) in corners.into_iter().enumerate() {
            self.origin[3 * f as usize + i] = corner;
            self.twin[3 * f as usize + i] = NONE;
        }
        3 * f
    }

    /// Whether a halfedge can be collapsed: the link condition of `dey_topology_1999`.
    pub(crate) fn check_collapse(&self, h: u32) -> Result<(), Illegal> {
        let (u, v) = (self.from(h), self.to(h));
        let t = self.twin_of(h);
        if t.is_some() && self.is_boundary(u) && self.is_boundary(v) {
            return Err(Illegal::JoinsBoundary);
        }
        let apexes = [Some(h), t].map(|x| x.map(|x| self.from(previous(x))));
        let around: Few = self.neighbours(v).collect();
        if self.neighbours(u).any(|x| !apexes.contains(&Some(x)) && x != v && around.contains(x)) {
            return Err(Illegal::Link);
        }
        for apex in apexes.into_iter().flatten() {
            let least = if self.is_boundary(apex) { 2 } else { 3 };
            if self.neighbours(apex).take(least + 1).count() <= least {
                return Err(Illegal::TooFewFaces);
            }
        }
        Ok(())
    }

    /// See [`DynamicMesh::collapse_edge`].
    pub(crate) fn collapse(&mut self, h: u32, position: DVec3) -> Result<(), Illegal> {
        self.check_collapse(h)?;
        self.collapse_checked(h, position);
        Ok(())
    }

    /// Collapses a halfedge that passed [`DynamicMesh::check_collapse`].
    pub(crate) fn collapse_checked(&mut self, h: u32, position: DVec3) {
        let (u, v, t) = (self.from(h), self.to(h), self.twin[h as usize]);
        let first = self.outgoing[u as usize];
        let mut x = first;
        loop {
            self.origin[x as usize] = v;
            x = self.twin[previous(x) as usize];
            if x == NONE || x == first {
                break;
            }
        }
        self.positions[v as usize] = position;
        self.outgoing[u as usize] = NONE;
        self.free_vertices.push(u);
        let mut at_v = NONE;
        // The face beyond t first, so that a later split takes the faces in the order in which it made them.
        for side in [t, h] {
            if side == NONE {
                continue;
            }
            let [across_next, across_previous] = [next(side), previous(side)].map(|x| self.twin[x as usize]);
            for x in [side, next(side), previous(side)] {
                self.origin[x as usize] = NONE;
                self.twin[x as usize] = NONE;
            }
            self.free_faces.push(side / 3);
            self.faces -= 1;
            self.glue(across_next, across_previous);
            // What starts at the apex and at v on whichever side still has a face.
            let (at_apex, from_v) = if across_next == NONE {
                (next(across_previous), across_previous)
            } else {
                (across_next, next(across_next))
            };
            self.choose_outgoing(at_apex);
            at_v = from_v;
        }
        self.choose_outgoing(at_v);
    }
}
