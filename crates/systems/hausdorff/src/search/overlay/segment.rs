//! What lies in T of an edge of B, and the corners of cells.

use glam::DVec3;

/// What lies in T of an edge of B, in the order of the corners of its face.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Clip {
    Unknown,
    Outside,
    /// Places of the ends among the points of the overlay.
    Segment {
        from: u16,
        to: u16,
    },
}

impl Clip {
    /// The same in the other direction.
    pub(super) fn turned(self) -> Self {
        match self {
            Self::Segment { from, to } => Self::Segment { from: to, to: from },
            other => other,
        }
    }
}

/// A corner of cells.
#[derive(Clone, Copy)]
pub(super) struct Point {
    /// In T, up to rounding.
    pub(super) position: DVec3,
    /// Squared distance from the point of B over it, which is a vertex or a point of an edge.
    pub(super) distance_sq: f64,
    pub(super) side: Side,
}

/// Where in T a point lies.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Side {
    /// On the side opposite to a corner.
    Opposite(u8),
    Inside,
}

/// A face of B as seen over T.
pub(super) struct Seen {
    pub(super) corners: [DVec3; 3],
    /// Barycentric coordinates of the corners in T.
    pub(super) over: [[f64; 3]; 3],
}
