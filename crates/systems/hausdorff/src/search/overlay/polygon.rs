//! The corners of the cells of an overlay.

use super::segment::Side;
use super::view::View;
use glam::DVec3;
use pompeiu_core::spatial::Slot;

/// Two ends of each of three segments, and the corners of T.
const MOST_CORNERS: usize = 9;

/// A part of T over one face of B: the fan of triangles around its first corner.
#[derive(Clone, Copy)]
pub(crate) struct Cell {
    pub(crate) slot: Slot,
    pub(super) polygon: Polygon,
    /// Greatest squared distance of a corner from the face.
    pub(crate) distance_sq: f64,
}

impl Cell {
    /// The triangles of the fan, without those that repeat a corner.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [[f64; 3]; 3]> {
        let p = &self.polygon.corners[..self.polygon.count];
        let fan = (2..p.len()).map(|i| [p[0], p[i - 1], p[i]]);
        fan.filter(|[a, b, c]| a != b && b != c && c != a).map(|t| t.map(|c| c.to_array()))
    }
}

/// A segment across which the view is not followed, with the face before it.
#[derive(Clone, Copy)]
pub(super) struct Strip {
    pub(super) slot: Slot,
    pub(super) from: u16,
    pub(super) to: u16,
}

#[derive(Clone, Copy)]
pub(super) struct Polygon {
    pub(super) corners: [DVec3; MOST_CORNERS],
    /// Known upper bounds on their squared distances from the face of the cell.
    pub(super) bounds: [f64; MOST_CORNERS],
    pub(super) count: usize,
}

impl Default for Polygon {
    fn default() -> Self {
        Self { corners: [DVec3::ZERO; MOST_CORNERS], bounds: [f64::INFINITY; MOST_CORNERS], count: 0 }
    }
}

impl Polygon {
    /// None where there is no room, which no cell of a triangle needs.
    pub(super) fn push(&mut self, corner: DVec3, bound: f64) -> Option<()> {
        if self.count == MOST_CORNERS {
            return None;
        }
        (self.corners[self.count], self.bounds[self.count]) = (corner, bound);
        self.count += 1;
        Some(())
    }

    /// Goes along the boundary of T, in the order of its corners, from one side to another. Says how often it passes the
    /// first corner; none where a segment ends at a vertex and goes on in the next. `bound` says how far, squared, a corner of T may be from the face of the cell.
    pub(super) fn go_along(
        &mut self,
        view: &View,
        from: Side,
        to: Side,
        bound: impl Fn(usize) -> f64,
    ) -> Option<i32> {
        match (from, to) {
            (Side::Inside, Side::Inside) => Some(0),
            (Side::Opposite(mut side), Side::Opposite(to)) => {
                let mut passes = 0;
                while side != to {
                    let corner = (side as usize + 2) % 3;
                    passes += i32::from(corner == 0);
                    self.push(view.t[corner], bound(corner))?;
                    side = (side + 1) % 3;
                }
                Some(passes)
            }
            _ => None,
        }
    }
}
