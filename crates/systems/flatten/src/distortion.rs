//! Distortion of a map.

use pompeiu_core::FaceId;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_surface::Surface;
use pompeiu_surface::plane::{Vec2, cross, scale, sub};

/// The mean over the area of the surface, and the greatest value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MeanMax {
    /// Mean over the area of the surface; null where a face has no area in the map.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub mean: f64,
    /// Greatest value; null where a face has no area in the map.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub max: f64,
}

/// The mean over the area, percentiles by area, and the greatest value.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Spread {
    /// Mean over the area of the surface; null where a face has no area in the map.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub mean: f64,
    /// Median by area.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub median: f64,
    /// Value that a tenth of the area exceeds.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub p90: f64,
    /// Value that a hundredth of the area exceeds.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub p99: f64,
    /// Greatest value; null where a face has no area in the map.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub max: f64,
}

/// Distortion of a map, with σ1 ≥ σ2 the singular values of its derivative on each face, at the scale of least symmetric Dirichlet
/// energy.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Distortion {
    /// σ1 / σ2: 1 where the map is conformal.
    pub angle: MeanMax,
    /// σ1 σ2 or its inverse, whichever is greater, relative to the ratio of total areas: 1 where areas are preserved.
    pub area: MeanMax,
    /// L2 stretch of Sander and others: the root mean square of 1/σ1 and 1/σ2, at equal total areas; at least 1.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub stretch_l2: f64,
    /// L∞ stretch: the greatest 1/σ2, at equal total areas.
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub stretch_linf: f64,
    /// σ1² + σ2² + σ1⁻² + σ2⁻²: 4 where the map is isometric.
    pub symmetric_dirichlet: Spread,
    /// The greater of σ1 and 1/σ2: 1 where the map is isometric.
    pub isometric: MeanMax,
    /// The least σ2 of all faces over the greatest σ1; not positive if a face is flipped.
    pub least_singular_ratio: f64,
    /// The factor by which the map must be scaled to minimise the symmetric Dirichlet energy.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub scale: f64,
}

/// The singular values of a map on a face, the second with the sign of the orientation.
pub(crate) fn singular_values(surface: &Surface, face: FaceId, uv: [Vec2; 3]) -> [f64; 2] {
    let [_, [length, _], apex] = surface.corners(face);
    let (p, q) = (sub(uv[1], uv[0]), sub(uv[2], uv[0]));
    let first = scale(1.0 / length, p);
    let second = scale(1.0 / apex[1], sub(q, scale(apex[0], first)));
    // The derivative is the sum of a similarity and a reflected similarity.
    let turning = 0.5 * (first[0] + second[1]).hypot(first[1] - second[0]);
    let reflecting = 0.5 * (first[0] - second[1]).hypot(first[1] + second[0]);
    let greatest = turning + reflecting;
    let determinant = cross(p, q) / (length * apex[1]);
    [greatest, if greatest > 0.0 { determinant / greatest } else { 0.0 }]
}

/// The singular values of all faces.
pub(crate) fn all_singular_values(surface: &Surface, uv: &VertexData<Vec2>) -> FaceData<[f64; 2]> {
    let mesh = surface.mesh();
    FaceData::from_fn(mesh.faces(), |face| singular_values(surface, face, mesh.face(face).map(|v| uv[v])))
}

/// The symmetric Dirichlet energy of a face; infinite unless the face keeps its orientation.
pub(crate) fn symmetric_dirichlet([s, t]: [f64; 2]) -> f64 {
    if t > 0.0 { s * s + t * t + 1.0 / (s * s) + 1.0 / (t * t) } else { f64::INFINITY }
}

/// The scale of least symmetric Dirichlet energy; 1 if a face is flipped.
pub(crate) fn best_scale(values: &[([f64; 2], f64)]) -> f64 {
    let (mut direct, mut inverse) = (0.0, 0.0);
    for &([s, t], area) in values {
        direct += area * (s * s + t * t);
        inverse += area * if t > 0.0 { 1.0 / (s * s) + 1.0 / (t * t) } else { f64::INFINITY };
    }
    let factor = (inverse / direct).sqrt().sqrt();
    if factor.is_finite() && factor > 0.0 { factor } else { 1.0 }
}

impl Distortion {
    /// The distortion of several charts, each given by the singular values and areas of its faces.
    pub(crate) fn of(values: &[([f64; 2], f64)]) -> Self {
        let scale = best_scale(values);
        let total: f64 = values.iter().map(|(_, area)| area).sum();
        let flat: f64 = values.iter().map(|([s, t], area)| area * s * t).sum();
        let inverse = |x: f64| if x > 0.0 { 1.0 / x } else { f64::INFINITY };
        let ratio = flat / total;
        let mean_max = |of: &dyn Fn([f64; 2]) -> f64| {
            let sum: f64 = values.iter().map(|&(s, area)| area * of(s)).sum();
            let max = values.iter().map(|&(s, _)| of(s)).fold(0.0, |m: f64, x| if x > m { x } else { m });
            MeanMax { mean: sum / total, max }
        };
        let stretch: f64 = values
            .iter()
            .map(|([s, t], area)| {
                area * 0.5 * (inverse(s * s) + if *t > 0.0 { inverse(t * t) } else { f64::INFINITY })
            })
            .sum();
        let linf =
            values.iter().map(|([_, t], _)| inverse(*t)).fold(0.0, |m: f64, x| if x > m { x } else { m });
        let greatest = values.iter().map(|([s, _], _)| *s).fold(0.0, f64::max);
        let least = values.iter().map(|([_, t], _)| *t).fold(f64::INFINITY, f64::min);
        let energy = |[s, t]: [f64; 2]| symmetric_dirichlet([scale * s, scale * t]);
        let MeanMax { mean, max } = mean_max(&energy);
        let mut sorted: Vec<(f64, f64)> = values.iter().map(|&(s, area)| (energy(s), area)).collect();
        sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
        let beyond = |share: f64| {
            let mut passed = 0.0;
            let found = sorted.iter().find(|(_, area)| {
                passed += area;
                passed >= (1.0 - share) * total
            });
            found.map_or(max, |(value, _)| *value)
        };
        Self {
            angle: mean_max(&|[s, t]| if t > 0.0 { s / t } else { f64::INFINITY }),
            area: mean_max(&|[s, t]| {
                let relative = s * t / ratio;
                if relative > 1.0 { relative } else { inverse(relative) }
            }),
            stretch_l2: (stretch / total * ratio).sqrt(),
            stretch_linf: linf * ratio.sqrt(),
            symmetric_dirichlet: Spread {
                mean,
                median: beyond(0.5),
                p90: beyond(0.1),
                p99: beyond(0.01),
                max,
            },
            isometric: mean_max(&|[s, t]| {
                let (s, t) = (scale * s, inverse(scale * t));
                if s > t { s } else { t }
            }),
            least_singular_ratio: least / greatest,
            scale,
        }
    }
}
