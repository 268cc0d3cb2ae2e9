//! Components opened along a cut, with their geometry.

use crate::components::{Component, split};
use crate::cut::{CutError, Opened, open};
use crate::map::{Axis, LoopMirror};
use crate::symmetry::{SymmetryError, partners, symmetrized, symmetrized_about};
use crate::{ConvexBoundary, FlattenError};
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_surface::plane::Vec2;
use pompeiu_surface::{EdgeData, EmbeddedSurface, HalfedgeId, SurfaceError};

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

    /// The same for a map onto a convex curve, whose corners stay where they are.
    pub(crate) fn symmetrized_on(
        &self,
        boundary: &ConvexBoundary,
        uv: Vec<Vec2>,
    ) -> Result<Vec<Vec2>, FlattenError> {
        let Some((partners, axis)) = self.partners.as_deref().zip(self.axis(boundary)?) else {
            return Ok(self.symmetrized(uv));
        };
        Ok(symmetrized_about(&uv, partners, axis))
    }

    /// The mirror image of the outline, if a plane of symmetry is given.
    pub(crate) fn mirror(&self) -> Option<LoopMirror> {
        let (along, partners) = (self.along()?, self.partners.as_ref()?);
        LoopMirror::new(&along.iter().map(|&h| self.surface.mesh().tail(h)).collect::<Vec<_>>(), partners)
    }

    /// The half-edges of the outline.
    pub(crate) fn along(&self) -> Option<Vec<HalfedgeId>> {
        let mesh = self.surface.mesh();
        mesh.boundary_loops().first().map(|&first| mesh.boundary_loop(first).collect())
    }

    /// The axis of a symmetric map onto a curve with corners.
    fn axis(&self, boundary: &ConvexBoundary) -> Result<Option<Axis>, FlattenError> {
        let Some((along, mirror)) = self.along().zip(self.mirror()) else { return Ok(None) };
        let surface = self.surface.surface();
        let lengths: Vec<f64> = along.iter().map(|&h| surface.edge_length(surface.mesh().edge(h))).collect();
        boundary.axis(&lengths, mirror)
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

/// The disks after a cut, as components of their own.
pub(crate) fn disks(surface: &EmbeddedSurface, cut: &EdgeData<bool>) -> Result<Vec<Component>, FlattenError> {
    let opened = open(surface.mesh(), cut)?;
    opened.check_disks()?;
    let mut disks = split(&opened_surface(&opened, surface)?, None)?;
    for v in disks.iter_mut().flat_map(|disk| &mut disk.vertices) {
        *v = opened.vertex_map()[*v];
    }
    Ok(disks)
}
