//! The mesh under repair.

use super::Change;
use crate::mesh::edges::EdgeTable;

/// Vertices and faces; indices are below the number of vertices.
pub(super) struct Parts {
    pub(super) positions: Vec<[f64; 3]>,
    pub(super) faces: Vec<[u32; 3]>,
}

impl Parts {
    pub(super) fn edges(&self) -> EdgeTable {
        EdgeTable::of_faces(self.positions.len(), &self.faces)
    }

    /// The position of the first corner of a face.
    pub(super) fn place(&self, face: usize) -> [f64; 3] {
        self.positions[self.faces[face][0] as usize]
    }

    /// Whether a face runs along one of its edges from the first of these ends to the second.
    pub(super) fn runs(&self, face: usize, ends: [u32; 2]) -> bool {
        let [a, b, c] = self.faces[face];
        [[a, b], [b, c], [c, a]].contains(&ends)
    }

    /// Whether two faces run along their common edge in the same direction, so that one of them is turned over.
    pub(super) fn run_alike(&self, ends: [u32; 2], f: usize, g: usize) -> bool {
        self.runs(f, ends) == self.runs(g, ends)
    }

    /// Keeps the faces for which `keep` holds, by their number.
    pub(super) fn keep_faces(&mut self, keep: impl Fn(usize) -> bool) -> Change {
        let dropped = Change::of((0..self.faces.len()).filter(|&f| !keep(f)).map(|f| self.place(f)));
        let mut number = 0..;
        self.faces.retain(|_| number.next().is_some_and(&keep));
        dropped
    }

    /// Drops vertices that no face names; the others keep their order.
    pub(super) fn drop_unreferenced(&mut self) -> Change {
        let mut numbers = vec![u32::MAX; self.positions.len()];
        for &v in self.faces.iter().flatten() {
            numbers[v as usize] = 0;
        }
        let unused = numbers.iter().zip(&self.positions).filter(|(number, _)| **number == u32::MAX);
        let dropped = Change::of(unused.map(|(_, &position)| position));
        for (next, number) in (0..).zip(numbers.iter_mut().filter(|number| **number == 0)) {
            *number = next;
        }
        let mut v = numbers.iter();
        self.positions.retain(|_| v.next().is_some_and(|&number| number != u32::MAX));
        for v in self.faces.iter_mut().flatten() {
            *v = numbers[*v as usize];
        }
        dropped
    }
}
