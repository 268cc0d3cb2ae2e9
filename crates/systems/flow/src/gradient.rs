//! How far a surface is from stationary.

use super::moving::MovingSurface;
use super::triangle::Triangle;
use glam::DVec3;

/// The greatest component at a vertex of the gradient of the area, along the normal and across it. Lengths.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct GradientNorm {
    /// Along the normal of the vertex: zero on a discrete minimal surface.
    pub normal: f64,
    /// Across it: how far triangles could be improved for the area alone. It is not expected to vanish.
    pub tangential: f64,
}

/// What the derivatives of the area say at one moment.
pub(crate) struct Derivatives {
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) area: f64,
    /// By vertex, in the directions that it may move in; without the part that the volume takes, where that is kept.
    pub(crate) gradient: Vec<DVec3>,
    pub(crate) directions: Vec<DVec3>,
    pub(crate) masses: Vec<f64>,
    pub(crate) norm: GradientNorm,
    /// By how much the area changes with the volume, where that is kept: twice the mean curvature.
    pub(crate) pressure: Option<f64>,
}

impl Derivatives {
    pub(crate) fn of(surface: &MovingSurface, keep_volume: bool) -> Self {
        let triangles = surface.triangles();
        let area = triangles.iter().map(|t| t.area).sum();
        let mut gradient = surface.gradient(&triangles);
        let directions = surface.directions(&surface.normals(&triangles));
        let masses = surface.masses(&triangles);
        let pressure = keep_volume.then(|| {
            let volume = surface.volume_gradient_at(surface.positions());
            let along = |v: &[DVec3]| v.iter().zip(&volume).map(|(a, b)| a.dot(*b)).sum::<f64>();
            let pressure = along(&gradient) / along(&volume);
            for (g, v) in gradient.iter_mut().zip(&volume) {
                *g -= pressure * *v;
            }
            pressure
        });
        let mut norm = GradientNorm::default();
        for (g, d) in gradient.iter().zip(&directions) {
            let along = g.dot(*d);
            norm.normal = norm.normal.max(along.abs());
            norm.tangential = norm.tangential.max((*g - along * *d).length());
        }
        Self { triangles, area, gradient, directions, masses, norm, pressure }
    }
}
