//! Edge weights of convex combination maps.

use pompeiu_surface::plane::{cross, dot, norm, scale};
use pompeiu_surface::{GeometryError, HalfedgeId, Surface, intrinsic_delaunay};
use std::borrow::Cow;

/// The weights of a convex combination map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Weights {
    /// Equal weights: Tutte's embedding. Ignores the shapes of faces.
    Uniform,
    /// Half the sum of the opposite cotangents, on the intrinsic Delaunay triangulation: the discrete harmonic map. Faces of the
    /// original surface may flip; mean value weights are then used instead.
    Cotangent,
    /// Floater's mean value weights, which are always positive.
    #[default]
    MeanValue,
}

impl Weights {
    /// The name of the weights in the command and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Uniform => "uniform",
            Self::Cotangent => "cotangent",
            Self::MeanValue => "mean-value",
        }
    }
}

/// An edge with the weight of its second end at the first, and of the first at the second.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Link {
    pub(crate) ends: [u32; 2],
    pub(crate) weights: [f64; 2],
}

impl Link {
    /// A symmetric weight: the geometric mean of both.
    pub(crate) fn symmetric(&self) -> f64 {
        self.weights[0].sqrt() * self.weights[1].sqrt()
    }
}

/// The edges of a surface with their weights.
///
/// # Source
/// `tutte_how_1963`, `pinkall_computing_1993`, `floater_mean_2003`.
pub(crate) fn links(surface: &Surface, weights: Weights) -> Result<Vec<Link>, GeometryError> {
    let surface = match weights {
        Weights::Cotangent => Cow::Owned(intrinsic_delaunay(surface)?.surface),
        _ => Cow::Borrowed(surface),
    };
    let mesh = surface.mesh();
    let link = |edge| {
        let h = mesh.edge_halfedge(edge);
        let weights = match weights {
            Weights::Uniform => [1.0; 2],
            Weights::Cotangent => {
                let opposite = |h: HalfedgeId| surface.cotangent(h.previous());
                // For edges that are Delaunay only up to rounding, the weight may be slightly negative.
                let weight = 0.5 * (opposite(h) + mesh.twin(h).map_or(0.0, opposite));
                [if weight > 0.0 { weight } else { 0.0 }; 2]
            }
            Weights::MeanValue => {
                let twin = mesh.twin(h);
                // At each end, the two angles adjacent to the edge.
                let at_tail =
                    half_tangent(&surface, h) + twin.map_or(0.0, |t| half_tangent(&surface, t.next()));
                let at_head =
                    half_tangent(&surface, h.next()) + twin.map_or(0.0, |t| half_tangent(&surface, t));
                let length = surface.edge_length(edge);
                [at_tail / length, at_head / length]
            }
        };
        Link { ends: mesh.ends(edge).map(|v| v.0), weights }
    };
    Ok(mesh.edge_ids().map(link).filter(|link| link.ends[0] != link.ends[1]).collect())
}

/// The tangent of half the angle at a corner.
fn half_tangent(surface: &Surface, corner: HalfedgeId) -> f64 {
    let out = surface.vector(corner);
    let back = scale(-1.0, surface.vector(corner.previous()));
    // sin / (1 + cos) loses digits near π, (1 − cos) / sin near 0; both are scaled by the lengths.
    let (product, along, across) = (norm(out) * norm(back), dot(out, back), cross(out, back));
    if along > 0.0 { across / (product + along) } else { (product - along) / across }
}
