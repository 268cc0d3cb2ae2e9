//! On which side of a surface a part of another one lies as a whole.

use super::boundary::Boundary;
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use pompeiu_core::spatial::Winding;

/// What rounding may do to a winding number, generously.
const ROUNDING: f64 = 1e-6;

/// Where numbers vary more, none decides, and no accuracy is needed.
const MOST: f64 = 0.25;

/// Tells inside from outside of a mesh.
pub(super) struct SideOf<'s> {
    frame: &'s Frame,
    winding: Winding,
    boundary: Boundary,
}

impl<'s> SideOf<'s> {
    pub(super) fn new(mesh: &TriMesh, frame: &'s Frame) -> Self {
        Self { frame, winding: Winding::new(mesh), boundary: Boundary::new(mesh, frame) }
    }

    pub(super) fn is_closed(&self) -> bool {
        self.boundary.is_empty()
    }

    /// Whether all points up to a radius around a point, in the frame, that are reached on ways which do not meet the surface are
    /// inside; none if that is not known.
    pub(super) fn is_inside(&self, centre: [f64; 3], radius: f64) -> Option<bool> {
        self.side(centre, radius).known()
    }

    /// The side of those points.
    pub(super) fn side(&self, centre: [f64; 3], radius: f64) -> Side {
        let variation = ROUNDING + self.boundary.variation(DVec3::from_array(centre), radius);
        let number = self.winding.around(self.frame.unmap(centre), variation.min(MOST));
        let margin = number.margin() - number.error;
        if margin > variation {
            Side::OfAll(number.is_inside())
        } else if margin > ROUNDING {
            Side::OfCentre
        } else {
            Side::Unknown
        }
    }
}

/// Which side is known.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// Whether all points are inside.
    OfAll(bool),
    /// Only that of the centre: of fewer points around it might be known.
    OfCentre,
    Unknown,
}

impl Side {
    pub(super) fn known(self) -> Option<bool> {
        match self {
            Self::OfAll(inside) => Some(inside),
            Self::OfCentre | Self::Unknown => None,
        }
    }
}
