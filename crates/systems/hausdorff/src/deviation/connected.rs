//! Which faces of a mesh touch, and which are connected.

use pompeiu_core::TriMesh;
use rayon::prelude::*;

/// Faces that have a vertex position in common, welded or not.
pub(super) struct Touching<'t> {
    mesh: &'t TriMesh,
    /// For each vertex the first vertex at its position.
    place: Vec<u32>,
    /// Faces at each place, as ranges of the list.
    starts: Vec<u32>,
    faces_at: Vec<u32>,
}

impl<'t> Touching<'t> {
    pub(super) fn new(mesh: &'t TriMesh) -> Self {
        let place = places(mesh);
        let mut starts = vec![0_u32; mesh.positions().len() + 1];
        for v in mesh.faces().iter().flatten() {
            starts[place[*v as usize] as usize + 1] += 1;
        }
        for v in 0..mesh.positions().len() {
            starts[v + 1] += starts[v];
        }
        let mut next = starts.clone();
        let mut faces_at = vec![0; 3 * mesh.faces().len()];
        for (f, face) in mesh.faces().iter().enumerate() {
            for v in face {
                let at = &mut next[place[*v as usize] as usize];
                faces_at[*at as usize] = f as u32;
                *at += 1;
            }
        }
        Self { mesh, place, starts, faces_at }
    }

    /// Calls `each` for every face that touches this one, at least once.
    pub(super) fn for_neighbours(&self, face: u32, mut each: impl FnMut(u32)) {
        for v in self.mesh.faces()[face as usize] {
            let place = self.place[v as usize] as usize;
            for &other in &self.faces_at[self.starts[place] as usize..self.starts[place + 1] as usize] {
                if other != face {
                    each(other);
                }
            }
        }
    }
}

/// For each vertex the least vertex at the same position.
pub(super) fn places(mesh: &TriMesh) -> Vec<u32> {
    // Adding zero makes both zeros one.
    let key = |v: u32| mesh.positions()[v as usize].map(|x| (x + 0.0).to_bits());
    let mut sorted: Vec<u32> = (0..mesh.positions().len() as u32).collect();
    sorted.par_sort_unstable_by(|a, b| key(*a).cmp(&key(*b)).then(a.cmp(b)));
    let mut place = vec![0; sorted.len()];
    let mut first = 0;
    for (i, &v) in sorted.iter().enumerate() {
        if i == 0 || key(sorted[i - 1]) != key(v) {
            first = v;
        }
        place[v as usize] = first;
    }
    place
}

/// Disjoint sets of faces, each of which knows the one that entered first.
pub(super) struct Sets {
    /// Itself for a root; `u32::MAX` before a face has entered.
    parents: Vec<u32>,
    /// When each face entered; roots have the least of their sets.
    entered: Vec<u32>,
    count: u32,
}

impl Sets {
    pub(super) fn new(faces: usize) -> Self {
        Self { parents: vec![u32::MAX; faces], entered: vec![0; faces], count: 0 }
    }

    pub(super) fn enter(&mut self, face: u32) {
        self.parents[face as usize] = face;
        self.entered[face as usize] = self.count;
        self.count += 1;
    }

    /// The face of its set that entered first.
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
        let (first, later) =
            if self.entered[a as usize] < self.entered[b as usize] { (a, b) } else { (b, a) };
        self.parents[later as usize] = first;
    }
}

/// Faces that enter one after the other, and which of them are connected: those that have a vertex position in common, welded or not.
pub(super) struct Entering<'e> {
    mesh: &'e TriMesh,
    place: &'e [u32],
    /// The first face that entered at each place; `u32::MAX` before.
    first_at: Vec<u32>,
    sets: Sets,
}

impl<'e> Entering<'e> {
    /// `place` is that of each vertex ([`places`]).
    pub(super) fn new(mesh: &'e TriMesh, place: &'e [u32]) -> Self {
        Self { mesh, place, first_at: vec![u32::MAX; place.len()], sets: Sets::new(mesh.faces().len()) }
    }

    pub(super) fn enter(&mut self, face: u32) {
        self.sets.enter(face);
        for v in self.mesh.faces()[face as usize] {
            let first = &mut self.first_at[self.place[v as usize] as usize];
            if *first == u32::MAX {
                *first = face;
            } else {
                self.sets.join(face, *first);
            }
        }
    }

    /// Of the faces that entered and are connected with one of them, the one that entered first.
    pub(super) fn first(&mut self, face: u32) -> u32 {
        self.sets.first(face)
    }
}
