//! Components opened along a cut, with their geometry.

use crate::FlattenError;
use crate::components::Component;
use crate::cut::{CutError, Opened, open};
use crate::symmetry::{SymmetryError, partners, symmetrized};
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_surface::plane::Vec2;
use pompeiu_surface::{EdgeData, EmbeddedSurface, SurfaceError};

/// An opened component with its geometry.
pub(crate) struct Disk {
    pub(crate) opened: Opened,
    pub(crate) surface: EmbeddedSurface,
    /// For each vertex its mirror image, if a plane of symmetry is given.
    pub(crate) partners: Option<Vec<u32>>,
}

impl Disk {
    pub(crate) fn new(component: &Component, cut: &EdgeData<bool>) -> Result<Self, FlattenError> {
        let opened = open(component.surface.mesh(), cut)?;
        opened.check_disks()?;
        let surface = opened_surface(&opened, &component.surface)?;
        let partners = component.images.as_ref().map(|images| partners(&opened, images));
        let partners =
            partners.map(|found| found.ok_or(SymmetryError::NoCut { face: FaceId(0) })).transpose();
        Ok(Self { opened, surface, partners: partners.map_err(CutError::from)? })
    }

    /// The mean of a map of this disk and its mirror image, if a plane of symmetry is given.
    pub(crate) fn symmetrized(&self, uv: Vec<Vec2>) -> Vec<Vec2> {
        match &self.partners {
            Some(partners) => symmetrized(&uv, partners),
            None => uv,
        }
    }

    /// Transfers a map of the same disk with a smaller cut to this disk: both sides of the new cut coincide.
    pub(crate) fn carried(&self, from: &Self, uv: &[Vec2]) -> Vec<Vec2> {
        let mut places = vec![[0.0; 2]; self.surface.mesh().vertices()];
        for (here, there) in self.opened.faces().iter().zip(from.opened.faces()) {
            for (v, w) in here.iter().zip(there) {
                places[*v as usize] = uv[*w as usize];
            }
        }
        places
    }
}

/// A surface after a cut, with its geometry.
pub(crate) fn opened_surface(
    opened: &Opened,
    surface: &EmbeddedSurface,
) -> Result<EmbeddedSurface, FlattenError> {
    let positions = opened.spread(surface.positions());
    let mesh = TriMesh::new(positions, opened.faces().to_vec()).map_err(|_| SurfaceError::NoFaces);
    Ok(EmbeddedSurface::new(&mesh.map_err(CutError::from)?)?)
}
