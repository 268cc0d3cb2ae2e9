//! On which side of a surface a part of another one lies as a whole.

use super::super::across::neighbours;
use super::super::boundary::Boundary;
use super::super::inside::{Inside, Scratch};
use super::super::patches::Patches;
use crate::rounding::Rounding;
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Slot, Winding};

/// What rounding may do to a winding number, generously.
const ROUNDING: f64 = 1e-6;

/// Where numbers vary more, none decides, and no accuracy is needed.
const MOST: f64 = 0.25;

/// Where numbers vary more, none is computed: hardly any is farther from those that decide.
const MOST_MARGIN: f64 = 0.5;

/// Tells inside from outside of a mesh: by the faces that are nearest, where these decide, else by winding numbers.
pub(super) struct SideOf<'s> {
    frame: &'s Frame,
    by_faces: ByFaces<'s>,
    winding: Winding,
    boundary: Boundary,
}

enum ByFaces<'s> {
    Closed(Box<Inside<'s>>),
    Open(Patches<'s>),
    /// Faces tell nothing.
    Not,
}

impl<'s> SideOf<'s> {
    /// Of a mesh with its tree.
    pub(super) fn new(
        mesh: &TriMesh,
        (bvh, frame): (&'s Bvh, &'s Frame),
        rounding: Rounding,
        control: &Control,
    ) -> Self {
        let (winding, boundary) = (Winding::new(mesh), Boundary::new(mesh, frame));
        let by_faces = if boundary.is_empty() {
            let inside = || Inside::new(mesh, &neighbours(mesh)?, (bvh, frame), rounding, control);
            let inside = if winding.is_sheet() { None } else { inside().filter(Inside::is_by_faces) };
            inside.map_or(ByFaces::Not, |inside| ByFaces::Closed(Box::new(inside)))
        } else {
            Patches::new(mesh, (&winding, &boundary), (bvh, frame), rounding, control)
                .map_or(ByFaces::Not, ByFaces::Open)
        };
        Self { frame, by_faces, winding, boundary }
    }

    pub(super) fn is_closed(&self) -> bool {
        self.boundary.is_empty()
    }

    /// The side of all points up to a radius around a point, in the frame, that are reached on ways which do not meet the surface. `near` is a face
    /// believed to be near.
    pub(super) fn side(&self, centre: [f64; 3], radius: f64, near: Slot, scratch: &mut Scratch) -> Side {
        if let ByFaces::Closed(inside) = &self.by_faces
            && let Some(number) = inside.by_nearest(centre, near, scratch)
        {
            return Side::OfAll(Inside::is_inside(number));
        }
        let variation = ROUNDING + self.boundary.variation(DVec3::from_array(centre), radius);
        if variation > MOST_MARGIN {
            return Side::OfCentre;
        }
        let by_faces = match &self.by_faces {
            ByFaces::Open(open) => open.about(&self.boundary, centre, near, scratch),
            _ => None,
        };
        let number = by_faces
            .filter(|number| number.margin() - number.error > variation)
            .unwrap_or_else(|| self.winding.around(self.frame.unmap(centre), variation.min(MOST)));
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
    /// At most that of the centre: of fewer points around it might be known.
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
