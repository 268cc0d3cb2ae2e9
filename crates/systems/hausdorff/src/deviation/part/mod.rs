//! Parts of a mesh that are measured while the rest is left out, with a statement of what that is.
//!
//! A part ends where points stop being wanted, not where faces end: faces of which some points are wanted are cut (`pieces`). What is measured
//! then are the pieces as they are stored, with corners rounded to double precision. Every statement about a part is proven for these
//! pieces; each lies within [`Part::rounding`] of the face that it was cut from, which is some 1e-13 of the largest coordinate.

mod clip;
mod level;
mod overlap;
mod pieces;
mod within;

use super::area;
use super::connected::Entering;
use super::entry::Sum;
use super::measure::face_in;
use super::report::DirectedDeviation;
use super::statistics::share_of;
use crate::report::{Enclosure, SurfacePoint};
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::first_at_position;
use pompeiu_core::{FaceId, TriMesh};

/// Some faces of a mesh, or pieces of them.
#[derive(Clone, Debug)]
pub struct Part {
    /// The mesh of these faces, on all vertices of the whole mesh and those that cuts made after them.
    pub mesh: TriMesh,
    /// For each of its faces, which one of the whole mesh it is or was cut from; ascending, and several times where a face is in pieces.
    pub faces: Vec<FaceId>,
    /// What is not in it.
    pub left_out: LeftOut,
    /// How much of each face of the whole mesh is in it.
    measured: Vec<Measured>,
    /// No point of it is known to be farther than this from the other mesh, if it was chosen so ([`DeviationOptions::within`](super::DeviationOptions::within)).
    pub farthest: Option<f64>,
}

/// The part of a mesh that is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LeftOut {
    /// Number of faces of which nothing is measured.
    pub faces: usize,
    /// Number of faces of which some points are measured and others are not.
    pub cut: usize,
    /// Number of connected parts that both kinds make; faces are neighbours when they have a vertex position in common, welded or not.
    pub components: usize,
    /// Encloses the share of the area of the mesh that is not measured.
    pub share: Enclosure,
}

/// How much of a face is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Measured {
    Nothing,
    Pieces,
    Whole,
}

impl Part {
    /// What the corners of pieces are rounded by at most, relative to the largest coordinate: 60 halvings of an edge, each off by half a unit in
    /// the last place, and six cuts by the sides of a box and 16 along lines, each off by less than 8 units, along each of three axes.
    const ROUNDING: f64 = 256.0 * f64::EPSILON;

    /// The faces that are wanted; none if there is no such face.
    pub fn of(mesh: &TriMesh, wanted: impl Fn(FaceId) -> bool) -> Option<Self> {
        let mut measured = vec![Measured::Nothing; mesh.faces().len()];
        let faces: Vec<FaceId> = mesh.face_ids().filter(|face| wanted(*face)).collect();
        for face in &faces {
            measured[face.index()] = Measured::Whole;
        }
        let corners = faces.iter().map(|face| mesh.faces()[face.index()]).collect();
        Self::with(mesh, mesh.positions().to_vec(), (corners, faces), measured)
    }

    /// Triangles that are faces of a mesh, or cut from them, on its vertices and new ones, and how much of each face they are; none if there is no
    /// triangle. The faces ascend.
    fn with(
        of: &TriMesh,
        positions: Vec<[f64; 3]>,
        (corners, faces): (Vec<[u32; 3]>, Vec<FaceId>),
        measured: Vec<Measured>,
    ) -> Option<Self> {
        let mesh = TriMesh::new(positions, corners).ok()?;
        let count = |kind| measured.iter().filter(|measured| **measured == kind).count();
        let left_out = LeftOut {
            faces: count(Measured::Nothing),
            cut: count(Measured::Pieces),
            components: count_components(of, |face| measured[face as usize] != Measured::Whole),
            share: left_share(of, &measured, (&mesh, &faces)),
        };
        Some(Self { mesh, faces, left_out, measured, farthest: None })
    }

    /// How far a point of a piece may be from the face that it was cut from; zero if no face is cut.
    pub fn rounding(&self) -> f64 {
        if self.left_out.cut == 0 && self.faces.is_sorted_by(|a, b| a < b) {
            return 0.0;
        }
        let largest = self.mesh.positions().iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
        largest * Self::ROUNDING
    }
}

/// The share of the area of a mesh that is not measured: of its faces, and of what is left of those that are in pieces.
fn left_share(of: &TriMesh, measured: &[Measured], (pieces, faces): (&TriMesh, &[FaceId])) -> Enclosure {
    if measured.iter().all(|measured| *measured == Measured::Whole) {
        return share_of((0.0, 0.0));
    }
    let frame = Frame::of(&Aabb::of_faces(of));
    let (mut left, mut cut, mut kept, mut all) =
        (Sum::default(), Sum::default(), Sum::default(), Sum::default());
    for face in 0..of.faces().len() as u32 {
        let (low, high) = area::of_face(of, &frame, face);
        all.add(low, high);
        match measured[face as usize] {
            Measured::Nothing => left.add(low, high),
            Measured::Pieces => cut.add(low, high),
            Measured::Whole => {}
        }
    }
    for (piece, face) in faces.iter().enumerate() {
        if measured[face.index()] == Measured::Pieces {
            let (low, high) = area::of_face(pieces, &frame, piece as u32);
            kept.add(low, high);
        }
    }
    let (left, all) = (left.enclosure() + (cut.enclosure() - kept.enclosure()), all.enclosure());
    if all.lower() <= 0.0 || left.upper() <= 0.0 {
        return share_of((0.0, 0.0));
    }
    let share = left.divide_by_positive(all);
    let within = |x: f64| if x > 0.0 { if x < 1.0 { x } else { 1.0 } } else { 0.0 };
    share_of((within(share.lower()), within(share.upper())))
}

/// The connected parts of some faces: for each face the first face of its part, and itself for the others.
fn first_faces(mesh: &TriMesh, of: impl Fn(u32) -> bool) -> Vec<u32> {
    let place = first_at_position(mesh.positions());
    let count = mesh.faces().len() as u32;
    let mut entering = Entering::new(mesh, &place);
    for face in (0..count).filter(|face| of(*face)) {
        entering.enter(face, face);
    }
    (0..count).map(|face| if of(face) { entering.first(face) } else { face }).collect()
}

fn count_components(mesh: &TriMesh, of: impl Fn(u32) -> bool) -> usize {
    let first = first_faces(mesh, &of);
    first.iter().enumerate().filter(|(face, first)| of(*face as u32) && *face as u32 == **first).count()
}

/// For each face the share of the area, rounded, that its connected part has.
pub fn component_shares(mesh: &TriMesh) -> Vec<f64> {
    let frame = Frame::of(&Aabb::of_faces(mesh));
    let first = first_faces(mesh, |_| true);
    let mut areas = vec![0.0; first.len()];
    for (corners, first) in mesh.faces().iter().zip(&first) {
        let (_, area, _) = face_in(mesh, &frame, *corners);
        areas[*first as usize] += area;
    }
    let total: f64 = areas.iter().sum();
    first.iter().map(|first| if total > 0.0 { areas[*first as usize] / total } else { 0.0 }).collect()
}

impl DirectedDeviation {
    /// Faces of the measured mesh are those of a part of another one from now on: `whole` is that one.
    pub fn renumber(&mut self, part: &Part, whole: &TriMesh) {
        let renumber = |point: &mut SurfacePoint| {
            let piece = point.face.index();
            point.face = part.faces[piece];
            if part.mesh.faces()[piece] != whole.faces()[point.face.index()] {
                point.barycentric = closest_barycentric(point.position, whole.corners(point.face));
            }
        };
        renumber(&mut self.distance.witness.from);
        for region in self.regions.iter_mut().chain(&mut self.beyond_threshold) {
            renumber(&mut region.witness.from);
            for face in &mut region.faces {
                *face = part.faces[face.index()];
            }
            region.faces.dedup();
        }
    }

    /// Whether the largest distance is that of a connected part with less than such a share of the area, while everything else is
    /// within half of it: that share, and what everything else is within. `mesh` must be the one that was measured.
    pub fn outlying_component(&self, mesh: &TriMesh, less_than: f64) -> Option<(f64, f64)> {
        let shares = component_shares(mesh);
        let share = *shares.get(self.distance.witness.from.face.index())?;
        if share >= less_than {
            return None;
        }
        let rest = self.faces.iter().zip(&shares).filter(|(_, share)| **share >= less_than);
        let within = rest.map(|(face, _)| face.max.upper()).fold(0.0, |a, b| if b > a { b } else { a });
        (within > 0.0 && within < 0.5 * self.distance.distance.lower()).then_some((share, within))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PreparedPair;
    use crate::deviation::DeviationOptions;
    use pompeiu_core::mesh::shapes::cube;
    use pompeiu_core::mesh::{Affine, merge, transform};

    fn two_cubes() -> TriMesh {
        let small = transform(&cube(0.1, 1).unwrap(), &Affine::translate([9.0, 0.0, 0.0])).unwrap();
        merge(&[&cube(2.0, 2).unwrap(), &small]).unwrap()
    }

    #[test]
    fn what_is_left_out_is_stated() {
        let mesh = two_cubes();
        let part = Part::of(&mesh, |face| mesh.corners(face)[0][0] < 5.0).unwrap();
        assert_eq!((part.left_out.faces, part.left_out.components, part.faces.len()), (12, 1, 48));
        assert!(part.left_out.share.contains(0.06 / 24.06) && part.left_out.share.gap() < 1e-12);
        assert!(Part::of(&mesh, |_| false).is_none());
        let all = Part::of(&mesh, |_| true).unwrap();
        assert_eq!((all.left_out.faces, all.left_out.components, all.left_out.share.upper()), (0, 0, 0.0));
        let shares = component_shares(&mesh);
        assert!((shares[0] - 24.0 / 24.06).abs() < 1e-12 && (shares[50] - 0.06 / 24.06).abs() < 1e-12);
    }

    #[test]
    fn parts_are_measured_to_the_whole_and_outliers_are_told() {
        let (a, b) = (cube(2.0, 2).unwrap(), two_cubes());
        let options = DeviationOptions::default();
        let whole = options.symmetric(&a, &b).unwrap();
        let (share, within) = whole.b_to_a.outlying_component(&b, 0.01).unwrap();
        assert!((share - 0.06 / 24.06).abs() < 1e-12 && within < 1e-9 + whole.b_to_a.floor);
        assert!(whole.a_to_b.outlying_component(&a, 0.01).is_none());
        // Without the first faces: they are counted as in the whole.
        let part = Part::of(&b, |face| face.0 >= 5).unwrap();
        let of_a = Part::of(&a, |_| true).unwrap();
        let pair = PreparedPair::new(&a, &b).with_parts([of_a, part.clone()]);
        let mut found = options.symmetric_of(&pair).unwrap();
        assert_eq!(found.a_to_b.distance.distance, whole.a_to_b.distance.distance);
        found.b_to_a.renumber(&part, &b);
        // The small cube has the last faces, in the whole as in the part.
        let upper = [&found, &whole].map(|deviation| deviation.b_to_a.distance.distance.upper());
        assert!((upper[0] - upper[1]).abs() < 1e-9);
        assert!(found.b_to_a.distance.witness.from.face.0 >= 48);
        assert_eq!(found.b_to_a.regions[0].faces, (48..60).map(FaceId).collect::<Vec<_>>());
    }
}
