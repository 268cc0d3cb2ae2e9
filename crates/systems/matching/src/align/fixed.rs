//! The mesh that others are moved onto.

use super::AlignError;
use super::moments::Moments;
use super::registration::{Surface, registered};
use super::samples::samples;
use glam::{DMat3, DVec3};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::Affine;
use std::sync::OnceLock;

/// A mesh that others are moved onto, prepared for many.
///
/// # Cost
/// O(m) to prepare; the tree that a rigid alignment needs is built when the first one asks for it, in O(m log m).
#[derive(Debug)]
pub struct Fixed {
    mesh: TriMesh,
    moments: Moments,
    surface: OnceLock<Surface>,
}

impl Fixed {
    /// Prepares a mesh, of which a copy is kept.
    ///
    /// # Errors
    /// [`AlignError::NoArea`].
    pub fn new(mesh: &TriMesh) -> Result<Self, AlignError> {
        Ok(Self { mesh: mesh.clone(), moments: Moments::of(mesh)?, surface: OnceLock::new() })
    }

    pub(super) fn centroid_map(&self, moving: &TriMesh) -> Result<Affine, AlignError> {
        let (to, from) = (self.moments.world_centroid(), Moments::of(moving)?.world_centroid());
        Ok(Affine::translate([0, 1, 2].map(|k| to[k] - from[k])))
    }

    pub(super) fn scale_map(&self, moving: &TriMesh) -> Result<Affine, AlignError> {
        let moving = Moments::of(moving)?;
        let (to, from) = (self.moments.world_centroid(), moving.world_centroid());
        let scale = self.moments.radius() / moving.radius();
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(AlignError::Sizes);
        }
        let translation = [0, 1, 2].map(|k| to[k] - scale * from[k]);
        Ok(Affine { translation, ..Affine::scale([scale; 3]) })
    }

    pub(super) fn rigid_map(&self, moving: &TriMesh) -> Result<Affine, AlignError> {
        let moments = Moments::of(moving)?;
        let frame = &self.moments.frame;
        // How long a unit of the one frame is in the other: a power of two, so exact.
        let unit = frame.length_in(moments.frame.length_out(1.0));
        if !(unit > 0.0 && unit.is_finite()) {
            return Err(AlignError::Sizes);
        }
        let surface = self.surface.get_or_init(|| Surface::new(&self.mesh, frame));
        let points = |count| {
            let points = samples(moving, &moments.frame, count);
            points.into_iter().map(|p| p * unit).collect::<Vec<_>>()
        };
        let origins = [frame, &moments.frame].map(|frame| -DVec3::from_array(frame.map([0.0; 3])));
        // The pose that leaves everything where it is.
        let in_place = origins[1] * unit - origins[0];
        let pose = registered(
            surface,
            [&self.moments, &moments].map(Moments::axes),
            [self.moments.centroid, moments.centroid * unit],
            in_place,
            points,
        );
        let translation = pose.translation - pose.rotation * (origins[1] * unit);
        Ok(Affine { linear: rows(pose.rotation), translation: frame.unmap(translation.to_array()) })
    }
}

fn rows(m: DMat3) -> [[f64; 3]; 3] {
    m.transpose().to_cols_array_2d()
}
