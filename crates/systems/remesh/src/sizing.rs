//! How long edges should be: one length, a field, or what a chord height allows where the surface bends.

use super::connectivity::{DynamicMesh, NONE};
use super::curvature::{curvatures_of_curves, largest_curvatures};
use super::isotropic::LONGEST;
use super::marked::Marked;
use glam::DVec3;
use pompeiu_core::geom::Frame;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A length at every point of space, in the unit of the mesh.
pub type LengthField<'f> = &'f (dyn Fn([f64; 3]) -> f64 + Sync);

/// How long edges should be.
#[derive(Clone, Copy)]
pub enum Sizing<'f> {
    /// As long everywhere.
    Length(f64),
    /// As long as chords of this height allow: the distance between an edge and the surface that it spans, estimated from the
    /// curvature of the input.
    ChordHeight {
        /// The height.
        tolerance: f64,
        /// Least and greatest length, whatever the curvature.
        between: [f64; 2],
    },
    /// As a field says at each point of the surface.
    Field(LengthField<'f>),
}

/// Target lengths in the frame of the input.
#[derive(Clone)]
pub(super) enum Lengths<'f> {
    Uniform(f64),
    AtVertices(Vec<f64>),
    Field(LengthField<'f>),
}

/// How fast the target length may grow with the distance along edges.
const GRADATION: f64 = 0.5;

impl<'f> Lengths<'f> {
    /// The lengths that a sizing asks for.
    pub(super) fn new(sizing: &Sizing<'f>, surface: &Marked, frame: &Frame) -> Self {
        match *sizing {
            Sizing::Length(length) => Self::Uniform(frame.length_in(length)),
            Sizing::Field(field) => Self::Field(field),
            Sizing::ChordHeight { tolerance, between } => {
                let [shortest, longest] = between.map(|x| frame.length_in(x));
                let height = frame.length_in(tolerance);
                let of = |curvature: f64| {
                    let length = chord_of(height, curvature);
                    if length < shortest {
                        shortest
                    } else if length < longest {
                        length
                    } else {
                        longest
                    }
                };
                let mut lengths: Vec<f64> = bends(surface, |_| false).into_iter().map(of).collect();
                limit_growth(&surface.mesh, &mut lengths);
                Self::AtVertices(lengths)
            }
        }
    }

    /// The length at a point of a face.
    pub(super) fn at(&self, p: DVec3, frame: &Frame, face: [u32; 3], weights: [f64; 3]) -> f64 {
        match self {
            Self::Uniform(length) => *length,
            Self::AtVertices(lengths) => (0..3).map(|i| weights[i] * lengths[face[i] as usize]).sum(),
            Self::Field(field) => frame.length_in(field(frame.unmap(p.to_array()))),
        }
    }

    /// The length at each vertex, which may make no sense where a field gives it.
    pub(super) fn at_vertices(&self, positions: &[DVec3], frame: &Frame) -> Vec<f64> {
        match self {
            Self::Uniform(length) => vec![*length; positions.len()],
            Self::AtVertices(lengths) => lengths.clone(),
            Self::Field(field) => {
                positions.iter().map(|p| frame.length_in(field(frame.unmap(p.to_array())))).collect()
            }
        }
    }
}

/// The longest chord such that edges up to [`LONGEST`] times as long have this height on faces over a sphere.
///
/// An equilateral triangle with edges l inscribed in a sphere of radius r has height h where `l^2 = 6 h r - 3 h^2`.
fn chord_of(height: f64, curvature: f64) -> f64 {
    let square = 6.0 * height / curvature - 3.0 * height * height;
    if square > 0.0 { square.sqrt() / LONGEST } else { 0.0 }
}

/// The largest curvature at each vertex, of the surface or of the curve through it. Some halfedges may be left out of that of the surface.
fn bends(surface: &Marked, is_left_out: impl Fn(u32) -> bool + Sync) -> Vec<f64> {
    let of_curves = curvatures_of_curves(surface);
    largest_curvatures(&surface.mesh, is_left_out)
        .into_iter()
        .zip(of_curves)
        .map(|(x, y)| if x > y { x } else { y })
        .collect()
}

/// Lowers lengths to those of chords of a height, for vertices on a smooth surface; not below the height itself.
///
/// Across curves, which are kept, the surface may bend as it likes.
pub(super) fn no_longer_than_chords(mut lengths: Vec<f64>, height: f64, surface: &Marked) -> Vec<f64> {
    let on_curve = |h: u32| surface.curve[h as usize] != NONE;
    for (length, curvature) in lengths.iter_mut().zip(bends(surface, on_curve)) {
        let chord = chord_of(height, curvature);
        let most = if chord > height { chord } else { height };
        *length = if *length < most { *length } else { most };
    }
    limit_growth(&surface.mesh, &mut lengths);
    lengths
}

/// Lowers lengths so that between neighbours they differ by at most [`GRADATION`] times their distance.
pub(super) fn limit_growth(mesh: &DynamicMesh, lengths: &mut [f64]) {
    // The bits of positive numbers are ordered as the numbers are.
    let mut queue: BinaryHeap<Reverse<(u64, u32)>> =
        lengths.iter().enumerate().map(|(v, l)| Reverse((l.to_bits(), v as u32))).collect();
    while let Some(Reverse((bits, v))) = queue.pop() {
        let length = lengths[v as usize];
        if length.to_bits() != bits {
            continue;
        }
        for w in mesh.neighbours(v) {
            let distance = mesh.positions[v as usize].distance(mesh.positions[w as usize]);
            let most = length + GRADATION * distance;
            if most < lengths[w as usize] {
                lengths[w as usize] = most;
                queue.push(Reverse((most.to_bits(), w)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::shapes::{Diagonal, grid};

    #[test]
    fn the_chord_of_a_sphere() {
        // A regular octahedron: edges sqrt 2, faces 1 / sqrt 3 from the centre.
        let height = 1.0 - 1.0 / 3.0_f64.sqrt();
        assert!((chord_of(height, 1.0) * LONGEST - 2.0_f64.sqrt()).abs() < 1e-15);
        assert_eq!(chord_of(0.1, 0.0), f64::INFINITY);
        assert_eq!(chord_of(3.0, 1.0), 0.0);
    }

    #[test]
    fn lengths_grow_no_faster_than_allowed() {
        let plane = grid([10.0, 10.0], [20, 20], Diagonal::Rising).expect("a grid");
        let mesh = DynamicMesh::new(plane.positions(), plane.faces()).expect("a manifold");
        let mut lengths = vec![3.0; plane.positions().len()];
        lengths[7] = 0.1;
        limit_growth(&mesh, &mut lengths);
        assert_eq!(lengths[7], 0.1);
        for h in mesh.halfedges() {
            let [v, w] = [mesh.from(h.0), mesh.to(h.0)].map(|v| v as usize);
            let apart = mesh.positions[v].distance(mesh.positions[w]);
            assert!(lengths[v] <= lengths[w] + GRADATION * apart);
        }
        assert_eq!(lengths.iter().copied().fold(0.0, f64::max), 3.0);
    }
}
