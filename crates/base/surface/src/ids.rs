//! Typed indices of edges and half-edges.

use pompeiu_core::FaceId;
use pompeiu_core::mesh::ElementData;
use std::fmt;

/// One side of an edge, that of one face: half-edge `3 f + i` runs along face `f` from its corner `i` to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct HalfedgeId(pub u32);

/// An undirected edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct EdgeId(pub u32);

impl HalfedgeId {
    /// The half-edge of a face that starts at its corner 0, 1 or 2.
    pub const fn of(face: FaceId, corner: usize) -> Self {
        Self(3 * face.0 + corner as u32)
    }

    /// The index as an array subscript.
    pub const fn index(self) -> usize {
        self.0 as usize
    }

    /// Its face.
    pub const fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// The corner of the face where it starts: 0, 1 or 2.
    pub const fn corner(self) -> usize {
        (self.0 % 3) as usize
    }

    /// The half-edge of the same face that starts where this one ends.
    #[must_use]
    pub const fn next(self) -> Self {
        Self(if self.0 % 3 == 2 { self.0 - 2 } else { self.0 + 1 })
    }

    /// The half-edge of the same face that ends where this one starts.
    #[must_use]
    pub const fn previous(self) -> Self {
        Self(if self.0.is_multiple_of(3) { self.0 + 2 } else { self.0 - 1 })
    }
}

impl EdgeId {
    /// The index as an array subscript.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

impl fmt::Display for HalfedgeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

impl fmt::Display for EdgeId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

pompeiu_core::element_ids! { HalfedgeId: "corner", EdgeId: "edge" }

/// One value for each edge.
pub type EdgeData<T> = ElementData<EdgeId, T>;

/// One value for each corner of each face, three per face: that of a corner is the value of the half-edge that starts there.
pub type CornerData<T> = ElementData<HalfedgeId, T>;
