//! Which faces of a mesh are connected.

use pompeiu_core::TriMesh;

/// Disjoint sets of faces, each of which knows the one of least rank.
pub(super) struct Sets {
    /// Itself for a root; `u32::MAX` before a face has entered.
    parents: Vec<u32>,
    /// The rank of each face; roots have the least of their sets.
    ranks: Vec<u32>,
}

impl Sets {
    pub(super) fn new(faces: usize) -> Self {
        Self { parents: vec![u32::MAX; faces], ranks: vec![0; faces] }
    }

    /// Lets a face enter. No two have the same rank.
    pub(super) fn enter(&mut self, face: u32, rank: u32) {
        self.parents[face as usize] = face;
        self.ranks[face as usize] = rank;
    }

    /// The face of least rank in the set of a face that has entered.
    pub(super) fn first(&mut self, mut face: u32) -> u32 {
        while self.parents[face as usize] != face {
            let up = self.parents[self.parents[face as usize] as usize];
            self.parents[face as usize] = up;
            face = up;
        }
        face
    }

    /// Makes one set of two, if both faces have entered.
    pub(super) fn join(&mut self, a: u32, b: u32) {
        if self.parents[b as usize] == u32::MAX {
            return;
        }
        let (a, b) = (self.first(a), self.first(b));
        let (first, later) = if self.ranks[a as usize] < self.ranks[b as usize] { (a, b) } else { (b, a) };
        self.parents[later as usize] = first;
    }

    /// Of the faces that have entered those in the set of which this one is the first, in ascending order.
    fn with_first(&mut self, first: u32) -> Vec<u32> {
        let faces = 0..self.parents.len() as u32;
        faces.filter(|face| self.parents[*face as usize] != u32::MAX && self.first(*face) == first).collect()
    }
}

/// Which of the faces that have entered are connected: those that have a vertex position in common, welded or not.
///
/// They may enter in any order. In that of the mesh, what is touched lies close together as a rule, which is many times as fast.
pub(super) struct Entering<'e> {
    mesh: &'e TriMesh,
    place: &'e [u32],
    /// The first face that entered at each place; `u32::MAX` before.
    first_at: Vec<u32>,
    sets: Sets,
}

impl<'e> Entering<'e> {
    /// `place` is that of each vertex ([`first_at_position`](pompeiu_core::mesh::first_at_position)).
    pub(super) fn new(mesh: &'e TriMesh, place: &'e [u32]) -> Self {
        Self { mesh, place, first_at: vec![u32::MAX; place.len()], sets: Sets::new(mesh.faces().len()) }
    }

    /// The number of faces of the mesh.
    pub(super) fn faces(&self) -> usize {
        self.mesh.faces().len()
    }

    /// Lets a face enter. No two have the same rank.
    pub(super) fn enter(&mut self, face: u32, rank: u32) {
        self.sets.enter(face, rank);
        for v in self.mesh.faces()[face as usize] {
            let first = &mut self.first_at[self.place[v as usize] as usize];
            if *first == u32::MAX {
                *first = face;
            } else {
                self.sets.join(face, *first);
            }
        }
    }

    /// Of the faces that entered and are connected with one of them, the one of least rank.
    pub(super) fn first(&mut self, face: u32) -> u32 {
        self.sets.first(face)
    }

    /// Of the faces that entered those of which this one is the first, in ascending order.
    pub(super) fn with_first(&mut self, first: u32) -> Vec<u32> {
        self.sets.with_first(first)
    }
}
