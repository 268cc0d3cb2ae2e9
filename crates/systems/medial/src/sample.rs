//! Sample points distributed evenly over a surface.

use glam::DVec3;
use pompeiu_core::geom::Frame;
use pompeiu_surface::EmbeddedSurface;

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) place: DVec3,
    /// The outward unit normal, interpolated from the vertices.
    pub(super) normal: DVec3,
    /// The area that the sample represents.
    pub(super) area: f64,
}

/// Steps of a low-discrepancy sequence in the unit square.
const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// Sample points of the surface in a frame, each representing the same area, in the order of their faces.
///
/// # Source
/// `roberts_unreasonable_2018` for the positions within faces.
pub(super) fn spread(surface: &EmbeddedSurface, frame: &Frame, count: usize) -> Vec<Sample> {
    let mesh = surface.mesh();
    let normals = surface.vertex_normals();
    let total = surface.surface().area();
    // If the surface is oriented inwards, all normals are reversed.
    let volume: f64 = mesh
        .face_ids()
        .map(|face| {
            let [a, b, c] = surface.corner_positions(face).map(|p| DVec3::from_array(frame.map(p)));
            a.dot(b.cross(c))
        })
        .sum();
    let outwards = if volume < 0.0 { -1.0 } else { 1.0 };
    let unit = frame.length_in(total.sqrt());
    let area = unit * unit / count as f64;
    let mut samples = Vec::with_capacity(count);
    let mut passed = 0.0;
    for face in mesh.face_ids() {
        passed += surface.surface().face_area(face);
        while samples.len() < count && passed >= (samples.len() as f64 + 0.5) / count as f64 * total {
            let [mut s, mut t] = STEPS.map(|step| (0.5 + step * samples.len() as f64).fract());
            if s + t > 1.0 {
                (s, t) = (1.0 - s, 1.0 - t);
            }
            let weights = [1.0 - s - t, s, t];
            let mean = |points: [[f64; 3]; 3]| -> DVec3 {
                weights.iter().zip(points).map(|(&w, p)| w * DVec3::from_array(p)).sum()
            };
            let place = mean(surface.corner_positions(face).map(|p| frame.map(p)));
            let flat = DVec3::from_array(surface.frame(face)[2]);
            let normal = mean(mesh.face(face).map(|v| normals[v])).normalize_or(flat);
            samples.push(Sample { place, normal: outwards * normal, area });
        }
    }
    samples
}
