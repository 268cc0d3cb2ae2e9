//! The frame in which two meshes are compared.
//!
//! Long thin faces of a turned solid have boxes along the axes that overlap by the hundreds: of a cylinder with 4,000 sides, each point of a
//! side lies in a third of the boxes of all sides. Along the principal axes of their edges the boxes are as thin as the faces.

use crate::engine::joint_frame;
use crate::rounding::Rounding;
use glam::{DMat3, DVec3};
use pompeiu_core::geom::{Aabb, Frame, eigenvectors};
use pompeiu_core::{FaceId, TriMesh};

/// Faces of each mesh that are looked at, at most.
const SAMPLES: usize = 2048;
/// Boxes of faces along the axes may overlap so much: the sum of their surface areas, in units of that of the box about all.
const MOST_OVERLAP: f64 = 64.0;
/// The part of that sum that a rotation must leave or less.
const WORTH: f64 = 0.75;

/// The frame of the joint bounding box of two meshes, turned where that makes boxes of faces much smaller, that box, and the rounding model
/// there.
pub(crate) fn frame_of(a: &TriMesh, b: &TriMesh) -> (Frame, Aabb, Rounding) {
    let (plain, joint, rounding) = joint_frame(a, b);
    let Some(rotation) = rotation(a, b, &joint) else { return (plain, joint, rounding) };
    let frame = plain.turned(rotation, &joint);
    (frame, joint, Rounding::in_frame(&frame, &joint))
}

/// The rotation to principal axes, if it is worth it.
fn rotation(a: &TriMesh, b: &TriMesh, joint: &Aabb) -> Option<DMat3> {
    // Lengths in units of the box: squares neither overflow nor underflow.
    let scale = Frame::of(joint);
    let corners = |mesh: &TriMesh, face: usize| {
        mesh.corners(FaceId(face as u32)).map(|p| DVec3::from_array(scale.map(p)))
    };
    let step = |mesh: &TriMesh| mesh.faces().len().div_ceil(SAMPLES).max(1);
    let sampled = |mesh| {
        let step = step(mesh);
        (0..mesh.faces().len()).step_by(step).map(move |face| (corners(mesh, face), step as f64))
    };
    let samples: Vec<([DVec3; 3], f64)> = [a, b].into_iter().flat_map(sampled).collect();
    let plain = surface_of_boxes(&samples, DMat3::IDENTITY);
    let whole = DVec3::from_array(scale.map(joint.upper)) - DVec3::from_array(scale.map(joint.lower));
    if plain <= MOST_OVERLAP * half_surface(whole) {
        return None;
    }
    let mut edges = DMat3::ZERO;
    for ([p, q, r], weight) in &samples {
        for edge in [*q - *p, *r - *q, *p - *r] {
            let length = edge.length();
            if length > 0.0 {
                let along = edge * (weight / length);
                edges += DMat3::from_cols(along * edge.x, along * edge.y, along * edge.z);
            }
        }
    }
    let rotation = eigenvectors(edges).transpose();
    (surface_of_boxes(&samples, rotation) <= WORTH * plain).then_some(rotation)
}

/// Half of the surface areas of boxes about turned faces, summed.
fn surface_of_boxes(samples: &[([DVec3; 3], f64)], rotation: DMat3) -> f64 {
    let of_face = |(corners, weight): &([DVec3; 3], f64)| {
        let [p, q, r] = corners.map(|p| rotation * p);
        weight * half_surface(p.max(q).max(r) - p.min(q).min(r))
    };
    samples.iter().map(of_face).sum()
}

fn half_surface(size: DVec3) -> f64 {
    size.x * size.y + size.y * size.z + size.z * size.x
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::icosphere;
    use pompeiu_core::mesh::{Affine, transform};

    /// Long strips around an axis.
    fn tube(sides: u32, angle: f64) -> TriMesh {
        let corner = |i: u32, height: f64| {
            let angle = angle + std::f64::consts::TAU * f64::from(i) / f64::from(sides);
            [angle.cos(), angle.sin(), height]
        };
        let positions = (0..sides).flat_map(|i| [corner(i, 0.0), corner(i, 3.0)]).collect();
        let strips = (0..sides).flat_map(|i| {
            let [a, b] = [i, (i + 1) % sides].map(|i| 2 * i);
            [[a, b, b + 1], [a, b + 1, a + 1]]
        });
        TriMesh::new(positions, strips.collect()).unwrap()
    }

    #[test]
    fn strips_that_are_turned_lie_along_an_axis() {
        let by = Affine::rotate([0.3, -0.5, 0.8], 71.0).unwrap();
        let upright = [tube(400, 0.0), tube(500, 0.1)];
        let [a, b] = upright.each_ref().map(|mesh| transform(mesh, &by).unwrap());
        let (frame, _, rounding) = frame_of(&a, &b);
        assert!(frame.is_turned() && rounding.unit() > 0.0);
        // The first coordinate is along the strips.
        let across = |mesh: &TriMesh, face: u32| {
            let [p, q, r] = mesh.corners(FaceId(face)).map(|p| DVec3::from_array(frame.map(p)));
            let size = p.max(q).max(r) - p.min(q).min(r);
            f64::max(size.y, size.z) / size.x
        };
        assert!((0..800).all(|face| across(&a, face) < 0.01));
        assert!(!frame_of(&upright[0], &upright[1]).0.is_turned());
        let sphere = icosphere(1.0, 4).unwrap();
        assert!(!frame_of(&sphere, &transform(&sphere, &by).unwrap()).0.is_turned());
    }
}
