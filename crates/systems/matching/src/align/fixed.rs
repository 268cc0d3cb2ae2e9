//! The mesh that others are aligned to.

use super::AlignError;
use super::moments::Moments;
use super::pose::Pose;
use super::registration::{Surface, gain, registered};
use super::samples::samples;
use glam::{DMat3, DVec3};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::Affine;
use serde::Serialize;
use std::sync::OnceLock;

/// The gain of aligning a mesh to another one: estimates from sample points, in the unit of the meshes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Gain {
    /// The median distance of its points from the other one.
    pub as_it_lies: f64,
    /// The same in about the best pose.
    pub aligned: f64,
}

/// A mesh that others are aligned to, prepared for many alignments.
///
/// # Cost
/// O(m) to prepare. A rigid alignment needs a tree; the first one builds it, in O(m log m).
#[derive(Debug)]
pub struct Fixed {
    mesh: TriMesh,
    pub(super) moments: Moments,
    surface: OnceLock<Surface>,
}

impl Fixed {
    /// Prepares a mesh; keeps a copy.
    ///
    /// # Errors
    /// [`AlignError::NoArea`].
    pub fn new(mesh: &TriMesh) -> Result<Self, AlignError> {
        Ok(Self { mesh: mesh.clone(), moments: Moments::of(mesh)?, surface: OnceLock::new() })
    }

    pub(super) fn centroid_map(&self, moving: &TriMesh) -> Result<Affine, AlignError> {
        let (to, from) = (self.moments.world_centroid(), Moments::of(moving)?.world_centroid());
        finite(Affine::translate([0, 1, 2].map(|k| to[k] - from[k])))
    }

    pub(super) fn scale_map(&self, moving: &TriMesh) -> Result<Affine, AlignError> {
        let moving = Moments::of(moving)?;
        let (to, from) = (self.moments.world_centroid(), moving.world_centroid());
        let scale = self.moments.radius() / moving.radius();
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(AlignError::Sizes);
        }
        let translation = [0, 1, 2].map(|k| to[k] - scale * from[k]);
        finite(Affine { translation, ..Affine::scale([scale; 3]) })
    }

    pub(super) fn rigid_map(&self, moving: &TriMesh) -> Result<Affine, AlignError> {
        let moments = Moments::of(moving)?;
        let unit = self.unit_of(&moments)?;
        let pose = registered(
            self.surface(),
            [&self.moments, &moments].map(Moments::axes),
            [self.moments.centroid, moments.centroid * unit],
            self.in_place(&moments, unit),
            |count| points(moving, &moments, unit, count),
        );
        self.map_of(&pose, 1.0, &moments, unit)
    }

    /// How near a mesh lies to this one, and how near it would lie in about the best pose: medians of distances of sample points. A quick look at whether
    /// it should be aligned, from the starts of [`Alignment::Rigid`](super::Alignment::Rigid).
    ///
    /// # Errors
    /// [`AlignError`] if the mesh has no area or the sizes of the two differ too much.
    pub fn gain(&self, moving: &TriMesh) -> Result<Gain, AlignError> {
        let moments = Moments::of(moving)?;
        let unit = self.unit_of(&moments)?;
        let [as_it_lies, aligned] = gain(
            self.surface(),
            [&self.moments, &moments].map(Moments::axes),
            [self.moments.centroid, moments.centroid * unit],
            self.in_place(&moments, unit),
            |count| points(moving, &moments, unit, count),
        )
        .map(|distance| self.moments.frame.length_out(distance));
        Ok(Gain { as_it_lies, aligned })
    }

    /// The translation of the pose that leaves a mesh where it is.
    fn in_place(&self, moving: &Moments, unit: f64) -> DVec3 {
        let origins = self.origins(moving);
        origins[1] * unit - origins[0]
    }

    pub(super) fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    pub(super) fn surface(&self) -> &Surface {
        self.surface.get_or_init(|| Surface::new(&self.mesh, &self.moments.frame))
    }

    /// The length of a unit of the moving mesh's frame in that of this one: a power of two, so exact.
    pub(super) fn unit_of(&self, moving: &Moments) -> Result<f64, AlignError> {
        let unit = self.moments.frame.length_in(moving.frame.length_out(1.0));
        if unit > 0.0 && unit.is_finite() { Ok(unit) } else { Err(AlignError::Sizes) }
    }

    /// The displacement of the origin in each frame, in its own unit: for this mesh, and for the moving one.
    pub(super) fn origins(&self, moving: &Moments) -> [DVec3; 2] {
        [&self.moments.frame, &moving.frame].map(|frame| -DVec3::from_array(frame.map([0.0; 3])))
    }

    /// The map of a pose in the frames, after a scale.
    pub(super) fn map_of(
        &self,
        pose: &Pose,
        scale: f64,
        moving: &Moments,
        unit: f64,
    ) -> Result<Affine, AlignError> {
        let [_, origin] = self.origins(moving);
        let translation = pose.translation - pose.rotation * (scale * (origin * unit));
        let map = Affine {
            linear: rows(pose.rotation).map(|row| row.map(|x| scale * x)),
            translation: self.moments.frame.unmap(translation.to_array()),
        };
        finite(map)
    }
}

/// Sample points of a mesh, in the unit of the one it is aligned to.
fn points(moving: &TriMesh, moments: &Moments, unit: f64, count: usize) -> Vec<DVec3> {
    samples(moving, &moments.frame, count).into_iter().map(|sample| sample.point * unit).collect()
}

/// The map, if all its numbers are finite.
fn finite(map: Affine) -> Result<Affine, AlignError> {
    let is_finite = map.linear.iter().flatten().chain(&map.translation).all(|x| x.is_finite());
    if is_finite { Ok(map) } else { Err(AlignError::Sizes) }
}

fn rows(m: DMat3) -> [[f64; 3]; 3] {
    m.transpose().to_cols_array_2d()
}
