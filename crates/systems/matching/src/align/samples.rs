//! Sample points distributed evenly over a surface.

use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;

/// A point of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sample {
    pub(super) point: DVec3,
    /// The unit normal of the face.
    pub(super) normal: DVec3,
}

/// `count` points in a frame; each face, in order, gets a number proportional to its area.
///
/// Inside faces the points follow the sequence of multiples of `1/p, 1/p²`, where p is the real root of `p³ = p + 1`: neighbours
/// stay apart without random numbers. There are fewer points only if rounding drops the last.
///
/// # Source
/// `roberts_unreasonable_2018`.
pub(super) fn samples(mesh: &TriMesh, frame: &Frame, count: usize) -> Vec<Sample> {
    const STEP: [f64; 2] = [0.754_877_666_246_692_7, 0.569_840_290_998_053_2];
    let corners = || mesh.face_ids().map(|face| mesh.corners(face).map(|p| DVec3::from_array(frame.map(p))));
    let doubled_area = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a).length();
    let total: f64 = corners().map(doubled_area).sum();
    let spacing = total / count as f64;
    let mut points = Vec::with_capacity(count);
    let mut passed = 0.0;
    for [a, b, c] in corners() {
        passed += doubled_area([a, b, c]);
        while points.len() < count && (points.len() as f64 + 0.5) * spacing < passed {
            let [v, w] = STEP.map(|step| (points.len() as f64 * step + 0.5).fract());
            let [v, w] = if v + w > 1.0 { [1.0 - v, 1.0 - w] } else { [v, w] };
            let normal = (b - a).cross(c - a).normalize_or_zero();
            points.push(Sample { point: a + v * (b - a) + w * (c - a), normal });
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::geom::Aabb;
    use pompeiu_core::mesh::shapes::cube;

    #[test]
    fn every_side_of_a_cube_gets_its_share() {
        let cube = cube(1.0, 5).unwrap();
        let frame = Frame::of(&Aabb::of_faces(&cube));
        let points = samples(&cube, &frame, 600);
        assert_eq!(points.len(), 600);
        let aabb = Aabb::of_faces(&cube);
        for k in 0..3 {
            for side in [aabb.lower, aabb.upper] {
                let on = |s: &&Sample| (frame.unmap(s.point.to_array())[k] - side[k]).abs() < 1e-12;
                let count = points.iter().filter(on).count();
                assert!((98..=102).contains(&count), "{count}");
            }
        }
    }
}
