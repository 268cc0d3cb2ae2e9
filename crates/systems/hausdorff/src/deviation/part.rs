//! Parts of a mesh that are measured while the rest is left out, with a statement of what that is.

use super::analysis::Ends;
use super::connected::{Sets, Touching, places};
use super::entry::Sum;
use super::measure;
use super::options::DeviationOptions;
use super::report::{Deviation, DirectedDeviation};
use super::statistics::share_of;
use crate::engine::joint_frame;
use crate::report::Enclosure;
use crate::target::Target;
use crate::tolerance::OptionError;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::run::on_threads;
use pompeiu_core::spatial::{Bvh, Workspace, morton_order};
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;

/// Some faces of a mesh, on all its vertices.
#[derive(Clone, Debug)]
pub struct Part {
    /// The mesh of these faces.
    pub mesh: TriMesh,
    /// For each of its faces, which one of the whole mesh it is; ascending.
    pub faces: Vec<FaceId>,
    /// What is not in it.
    pub left_out: LeftOut,
}

/// What of a mesh is left out.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LeftOut {
    /// Number of faces.
    pub faces: usize,
    /// Number of connected parts that they make; faces are neighbours when they have a vertex position in common, welded or not.
    pub components: usize,
    /// Encloses their share of the area of the mesh.
    pub share: Enclosure,
}

impl Part {
    /// The faces that are wanted; none if there is no such face.
    pub fn of(mesh: &TriMesh, wanted: impl Fn(FaceId) -> bool) -> Option<Self> {
        let kept: Vec<bool> = mesh.face_ids().map(wanted).collect();
        let faces: Vec<FaceId> = mesh.face_ids().filter(|face| kept[face.index()]).collect();
        let corners = faces.iter().map(|face| mesh.faces()[face.index()]).collect();
        let part = TriMesh::new(mesh.positions().to_vec(), corners).ok()?;
        let left_out = LeftOut {
            faces: mesh.faces().len() - faces.len(),
            components: count_components(mesh, |face| !kept[face as usize]),
            share: share(mesh, |face| !kept[face as usize]),
        };
        Some(Self { mesh: part, faces, left_out })
    }

    /// Only the faces of it that are wanted, by their places in the whole mesh `of`.
    #[must_use]
    pub fn and(&self, of: &TriMesh, wanted: impl Fn(FaceId) -> bool) -> Option<Self> {
        let mut kept = vec![false; of.faces().len()];
        for face in &self.faces {
            kept[face.index()] = wanted(*face);
        }
        Self::of(of, |face| kept[face.index()])
    }
}

/// The share of the area of a mesh that some faces have.
fn share(mesh: &TriMesh, of: impl Fn(u32) -> bool) -> Enclosure {
    let frame = Frame::of(&Aabb::of_faces(mesh));
    let (mut part, mut all) = (Sum::default(), Sum::default());
    for face in 0..mesh.faces().len() as u32 {
        let (low, high) = measure::area(mesh, &frame, face);
        all.add(low, high);
        if of(face) {
            part.add(low, high);
        }
    }
    let (part, all) = (part.enclosure(), all.enclosure());
    if all.lower() <= 0.0 || part.upper() == 0.0 {
        return share_of((0.0, 0.0));
    }
    let share = part.divide_by_positive(all);
    share_of((if share.lower() < 1.0 { share.lower() } else { 1.0 }, share.upper()))
}

/// The connected parts of some faces: for each face the first face of its part, and itself for the others.
fn first_faces(mesh: &TriMesh, of: impl Fn(u32) -> bool) -> Vec<u32> {
    let touching = Touching::new(mesh);
    let count = mesh.faces().len() as u32;
    let mut sets = Sets::new(count as usize);
    for face in (0..count).filter(|face| of(*face)) {
        sets.enter(face);
        touching.for_neighbours(face, |other| sets.join(face, other));
    }
    (0..count).map(|face| if of(face) { sets.first(face) } else { face }).collect()
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
    for (face, first) in first.iter().enumerate() {
        let (low, high) = measure::area(mesh, &frame, face as u32);
        areas[*first as usize] += 0.5 * (low + high);
    }
    let total: f64 = areas.iter().sum();
    first.iter().map(|first| if total > 0.0 { areas[*first as usize] / total } else { 0.0 }).collect()
}

/// For each face of A whether it lies over B rather than beside it: whether the nearest point of B to its centroid is not on the
/// boundary of B, where an edge belongs to one face. Over a closed surface every face does.
pub fn overlapping(a: &TriMesh, b: &TriMesh) -> Vec<bool> {
    /// Distances that differ by no more than this part of them, or of the frame, are the same.
    const SAME: f64 = 1e-12;
    let Some(boundary) = boundary(b) else { return vec![true; a.faces().len()] };
    let frame = joint_frame(a, b).0;
    let [surface, rim] = [b, &boundary].map(|mesh| Target::in_frame(mesh, frame));
    let order = morton_order(a, &Aabb::of_faces(a));
    let lies_over = |task: &[u32]| -> Vec<bool> {
        let mut workspace = Workspace::default();
        let mut distance =
            |bvh: &Bvh, point| bvh.nearest(point, bvh.any_slot(), &mut workspace).distance_sq.sqrt();
        let of_face = |face: &u32| {
            let corners = a.corners(FaceId(*face)).map(|p| frame.map(p));
            let centre = [0, 1, 2].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) * (1.0 / 3.0));
            distance(rim.bvh(), centre) > distance(surface.bvh(), centre) * (1.0 + SAME) + SAME
        };
        task.iter().map(of_face).collect()
    };
    let found: Vec<bool> = order.par_chunks(256).flat_map_iter(lies_over).collect();
    let mut over = vec![true; found.len()];
    for (face, found) in order.iter().zip(found) {
        over[*face as usize] = found;
    }
    over
}

/// The edges that belong to one face, as triangles without area; none of a closed surface.
fn boundary(mesh: &TriMesh) -> Option<TriMesh> {
    let place = places(mesh);
    let mut edges: Vec<[u32; 2]> = mesh
        .faces()
        .iter()
        .flat_map(|face| {
            let [a, b, c] = face.map(|v| place[v as usize]);
            [[a, b], [b, c], [c, a]]
        })
        .filter(|[from, to]| from != to)
        .map(|[from, to]| if from < to { [from, to] } else { [to, from] })
        .collect();
    edges.par_sort_unstable();
    let single = edges.chunk_by(|x, y| x == y).filter(|same| same.len() == 1).map(|same| same[0]);
    let faces: Vec<[u32; 3]> = single.map(|[from, to]| [from, to, to]).collect();
    if faces.is_empty() { None } else { TriMesh::new(mesh.positions().to_vec(), faces).ok() }
}

impl DeviationOptions<'_> {
    /// How far parts of A and B are from the other mesh as a whole. Faces in the report are those of the parts.
    ///
    /// # Errors
    /// [`DeviationOptions::check`].
    pub fn symmetric_of_parts(
        &self,
        [a_part, a]: [&TriMesh; 2],
        [b_part, b]: [&TriMesh; 2],
    ) -> Result<Deviation, OptionError> {
        self.check()?;
        let ends = Ends { a_part, a, b_part, b };
        Ok(on_threads(self.limits.threads, || self.of_ends(ends)))
    }

    /// For each face of A an enclosure of the distance of its farthest point from B, to about one part in 256, whatever else the
    /// options ask for.
    ///
    /// # Errors
    /// [`DeviationOptions::check`].
    pub fn farthest_of_faces(&self, a: &TriMesh, b: &TriMesh) -> Result<Vec<Enclosure>, OptionError> {
        let options = Self {
            accuracy: 1.0,
            threshold: None,
            percentiles: Vec::new(),
            bins: 0,
            regions: 0,
            signed: false,
            ..self.clone()
        };
        Ok(options.directed(a, b)?.faces.into_iter().map(|face| face.max).collect())
    }
}

impl DirectedDeviation {
    /// Faces of the measured mesh are those of a part of another one from now on: `faces` says which they are.
    pub fn renumber(&mut self, faces: &[FaceId]) {
        self.distance.witness.from.face = faces[self.distance.witness.from.face.index()];
        for region in self.regions.iter_mut().chain(&mut self.beyond_threshold) {
            region.witness.from.face = faces[region.witness.from.face.index()];
            for face in &mut region.faces {
                *face = faces[face.index()];
            }
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
    use pompeiu_core::mesh::shapes::{Diagonal, cube, grid};
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
        let less = part.and(&mesh, |face| face.0 >= 10).unwrap();
        assert_eq!((less.faces[0], less.faces.len()), (FaceId(10), 38));
        let shares = component_shares(&mesh);
        assert!((shares[0] - 24.0 / 24.06).abs() < 1e-12 && (shares[50] - 0.06 / 24.06).abs() < 1e-12);
    }

    #[test]
    fn faces_beside_an_open_surface_do_not_lie_over_it() {
        let plate = |size: f64, cells: u32| grid([size, size], [cells, cells], Diagonal::Rising).unwrap();
        let middle = |mesh: &TriMesh| {
            let aabb = Aabb::of_faces(mesh);
            [0, 1, 2].map(|k| -0.5 * (aabb.lower[k] + aabb.upper[k]))
        };
        let centred = |mesh: TriMesh| transform(&mesh, &Affine::translate(middle(&mesh))).unwrap();
        let (large, small) = (centred(plate(4.0, 8)), centred(plate(2.0, 3)));
        let over = overlapping(&large, &small);
        for (face, over) in large.face_ids().zip(over) {
            let corners = large.corners(face);
            let [x, y] = [0, 1].map(|k| (corners[0][k] + corners[1][k] + corners[2][k]) / 3.0);
            assert_eq!(over, x.abs() < 1.0 && y.abs() < 1.0, "{face:?}");
        }
        assert!(overlapping(&small, &large).iter().all(|over| *over));
        assert!(overlapping(&large, &cube(1.0, 1).unwrap()).iter().all(|over| *over));
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
        let mut found = options.symmetric_of_parts([&a, &a], [&part.mesh, &b]).unwrap();
        assert_eq!(found.a_to_b.distance.distance, whole.a_to_b.distance.distance);
        found.b_to_a.renumber(&part.faces);
        // The small cube has the last faces, in the whole as in the part.
        let upper = [&found, &whole].map(|deviation| deviation.b_to_a.distance.distance.upper());
        assert!((upper[0] - upper[1]).abs() < 1e-9);
        assert!(found.b_to_a.distance.witness.from.face.0 >= 48);
        assert_eq!(found.b_to_a.regions[0].faces, (48..60).map(FaceId).collect::<Vec<_>>());
        let farthest = options.farthest_of_faces(&b, &a).unwrap();
        assert!(farthest[59].lower() > 7.0 && farthest[0].upper() < 1e-9);
    }
}
