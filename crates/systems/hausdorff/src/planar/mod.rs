//! Thin faces of B in one plane, in another triangulation of the same region that a line crosses few faces of.
//!
//! The end of a tessellated cylinder is a fan: n faces that meet in one vertex, of which a face of another fan crosses up to n. The same
//! polygon in a triangulation whose ears are cut off in rounds, every other vertex in each, has about 2 log n along any line. Polygons that are not convex or have holes, as
//! plates do, get a constrained Delaunay triangulation with points inside whose spacing grows with the way to the boundary. B is only measured to, and as a set of points it is the same.
//!
//! # Why it is the same set
//! Faces are looked at along an axis, and all turn the same way there, exactly (`shewchuk_predicates_1997`). So the number of faces over a point is how often
//! the boundary of the faces winds around it: a point is covered where that is not zero. Both triangulations have the same boundary and turn the same way, so they
//! cover the same points. Heights over the plane of the axes are interpolated from those of vertices, and differ by at most the width
//! of a layer that contains all of them: [`Retriangulated::moved`]. It is zero for vertices with one coordinate in common.
//!
//! # Source
//! Points inside, as centres of the squares of a quadtree: `bern_provably_1994`; triangulations by the crate `spade`.

mod layer;
mod triangulate;

use glam::DVec3;
use pompeiu_core::geom::point_triangle::distance_sq;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::UnionFind;
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;
use std::collections::BTreeMap;
use triangulate::Seen;

/// A face is thin if its longest edge has more than this many times its height.
const THIN: f64 = 8.0;
/// Faces that are looked at before all are, and how many of them must be thin.
const SAMPLE: usize = 1024;
const LEAST_IN_SAMPLE: usize = 8;
/// A patch in which fewer thin faces meet in any vertex is left alone: lines along them cross few.
const LEAST_FACES: usize = 16;
/// The sine of the angle between faces that may be in one plane; the layer of all vertices decides.
const MOST_ANGLE: f64 = 1e-6;
/// The width of the layer of a patch, in units of the last place of the coordinates. The model of rounding has room for it (see `rounding`).
pub(crate) const MOST_MOVED: f64 = 10.0;

/// A mesh with patches of thin faces in another triangulation.
#[derive(Clone, Debug)]
pub(crate) struct Retriangulated {
    pub(crate) mesh: TriMesh,
    /// The distance between both surfaces at most, in the frame.
    pub(crate) moved: f64,
    /// What the first faces were before.
    kept: Vec<u32>,
    /// The patch of each further face, and the faces of each patch before, with their corners.
    patch_of: Vec<u32>,
    patches: Vec<Vec<(u32, [u32; 3])>>,
}

impl Retriangulated {
    /// None where there is no patch.
    pub(crate) fn new(mesh: &TriMesh, frame: &Frame) -> Option<Self> {
        let corners = |face: u32| mesh.corners(FaceId(face)).map(|p| DVec3::from_array(frame.map(p)));
        let count = mesh.faces().len() as u32;
        let step = mesh.faces().len().div_ceil(SAMPLE);
        let in_sample = (0..count).step_by(step).filter(|face| is_thin(corners(*face))).count();
        if in_sample < LEAST_IN_SAMPLE {
            return None;
        }
        let thin: Vec<u32> = (0..count).into_par_iter().filter(|face| is_thin(corners(*face))).collect();
        // Most meshes have none, which is known before the edges of all faces are.
        if patches_of(mesh, &thin, &corners).is_empty() {
            return None;
        }
        let all: Vec<u32> = (0..count).collect();
        let mut found = patches_of(mesh, &all, &corners);
        found.retain(|patch| {
            let thin = patch.iter().filter(|face| is_thin(corners(**face)));
            let mut met: Vec<u32> = thin.flat_map(|face| mesh.faces()[*face as usize]).collect();
            met.sort_unstable();
            met.chunk_by(|v, w| v == w).any(|faces| faces.len() >= LEAST_FACES)
        });
        let unit = 0.5 * f64::EPSILON * f64::max(0.25, frame.max_coordinate(&Aabb::of_faces(mesh)));
        let mut moved = 0.0;
        let mut patches = Vec::new();
        let mut faces = Vec::new();
        let mut patch_of = Vec::new();
        let mut positions = mesh.positions().to_vec();
        for patch in found {
            let Some(seen) = Seen::new(mesh, frame, &patch) else { continue };
            let Some((other, by)) = seen.other_faces(&mut positions, &patch, MOST_MOVED * unit) else {
                continue;
            };
            moved = if by > moved { by } else { moved };
            patch_of.extend(other.iter().map(|_| patches.len() as u32));
            faces.extend(other);
            patches.push(patch);
        }
        if patches.is_empty() {
            return None;
        }
        let mut is_gone = vec![false; mesh.faces().len()];
        for face in patches.iter().flatten() {
            is_gone[*face as usize] = true;
        }
        let kept: Vec<u32> = (0..count).filter(|face| !is_gone[*face as usize]).collect();
        let faces = kept.iter().map(|face| mesh.faces()[*face as usize]).chain(faces).collect();
        let with_corners = |face: u32| (face, mesh.faces()[face as usize]);
        let patches =
            patches.into_iter().map(|patch| patch.into_iter().map(with_corners).collect()).collect();
        let mesh = TriMesh::new(positions, faces).ok()?;
        Some(Self { mesh, moved, kept, patch_of, patches })
    }

    /// The mesh as it was.
    pub(crate) fn before(&self) -> TriMesh {
        let kept = self.kept.iter().copied().zip(self.mesh.faces().iter().copied());
        let mut faces: Vec<(u32, [u32; 3])> = kept.chain(self.patches.iter().flatten().copied()).collect();
        faces.sort_unstable();
        let faces = faces.into_iter().map(|(_, corners)| corners).collect();
        TriMesh::new(self.mesh.positions().to_vec(), faces).expect("faces and positions are those of a mesh")
    }

    /// The face of the mesh as it was that is nearest to a point, with its corners in the frame, given one of the other faces that is.
    pub(crate) fn nearest_before(
        &self,
        face: FaceId,
        point: [f64; 3],
        frame: &Frame,
    ) -> (FaceId, [[f64; 3]; 3]) {
        let place = |corners: [u32; 3]| corners.map(|v| frame.map(self.mesh.positions()[v as usize]));
        let Some(new) = face.index().checked_sub(self.kept.len()) else {
            return (FaceId(self.kept[face.index()]), place(self.mesh.faces()[face.index()]));
        };
        let faces = self.patches[self.patch_of[new] as usize].iter();
        let placed = faces.map(|(face, corners)| (FaceId(*face), place(*corners)));
        let distance_sq = |(_, [a, b, c]): &(FaceId, [[f64; 3]; 3])| distance_sq(point, *a, *b, *c);
        placed.min_by(|p, q| distance_sq(p).total_cmp(&distance_sq(q))).expect("patches have faces")
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.mesh.positions())
            + size_of_val(self.mesh.faces())
            + size_of_val(self.kept.as_slice())
            + size_of_val(self.patch_of.as_slice())
            + self.patches.iter().map(|patch| size_of_val(patch.as_slice())).sum::<usize>()
    }
}

fn is_thin([a, b, c]: [DVec3; 3]) -> bool {
    let longest_sq = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    longest_sq > THIN * (b - a).cross(c - a).length()
}

/// Of some faces those that are connected across edges and nearly in one plane, where they are many.
fn patches_of(mesh: &TriMesh, faces: &[u32], corners: &impl Fn(u32) -> [DVec3; 3]) -> Vec<Vec<u32>> {
    let mut edges: Vec<([u32; 2], bool, usize)> = Vec::with_capacity(3 * faces.len());
    for (i, face) in faces.iter().enumerate() {
        let [a, b, c] = mesh.faces()[*face as usize];
        edges.extend([[a, b], [b, c], [c, a]].map(|[p, q]| ([p.min(q), p.max(q)], p < q, i)));
    }
    edges.sort_unstable();
    let normals: Vec<DVec3> = faces
        .iter()
        .map(|face| {
            let [a, b, c] = corners(*face);
            (b - a).cross(c - a).normalize_or_zero()
        })
        .collect();
    let mut joined = UnionFind::new(faces.len());
    for two in edges.chunk_by(|e, f| e.0 == f.0) {
        let &[(_, d, i), (_, e, j)] = two else { continue };
        let (m, n) = (normals[i], normals[j]);
        if d != e && m.dot(n) > 0.0 && m.cross(n).length() < MOST_ANGLE {
            joined.union(i, j);
        }
    }
    let mut patches: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
    for (i, face) in faces.iter().enumerate() {
        patches.entry(joined.find(i)).or_default().push(*face);
    }
    patches.into_values().filter(|patch| patch.len() >= LEAST_FACES).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::{Affine, transform};
    use pompeiu_testkit::plain::point_triangles;
    use proptest::prelude::*;
    use std::f64::consts::TAU;

    /// A fan over corners of a circle at some angles, whose heights are raised by what is given, and one face that folds away from its last edge.
    fn fan(angles: &[f64], raised: f64, by: &Affine) -> TriMesh {
        let mut positions: Vec<[f64; 3]> = angles.iter().map(|t| [t.cos(), t.sin(), 0.0]).collect();
        positions[3][2] = raised;
        let n = positions.len() as u32;
        positions.push([0.0, 2.0, 1.0]);
        let faces = (1..n - 1).map(|i| [0, i, i + 1]).chain([[0, n - 1, n]]).collect();
        transform(&TriMesh::new(positions, faces).unwrap(), by).unwrap()
    }

    fn angles() -> impl Strategy<Value = Vec<f64>> {
        let uneven = prop::collection::vec(0.05..1.0_f64, 40..120);
        uneven.prop_map(|steps| {
            let sum: f64 = steps.iter().sum();
            steps
                .iter()
                .scan(0.0, |at, step| {
                    *at += TAU * step / sum;
                    Some(*at)
                })
                .collect()
        })
    }

    fn triangles(mesh: &TriMesh, frame: &Frame) -> Vec<[[f64; 3]; 3]> {
        mesh.face_ids().map(|face| mesh.corners(face).map(|p| frame.map(p))).collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// As far from any point, with as many faces, and the face before is that of the point.
        #[test]
        fn the_surface_stays(
            angles in angles(), axis in [-1.0..1.0_f64, -1.0..1.0, 0.1..1.0], degrees in prop_oneof![Just(0.0), 0.0..180.0_f64],
            points in prop::collection::vec([-1.0..1.0_f64, -1.0..1.0, -0.5..0.5], 40),
        ) {
            let by = Affine::rotate(axis, degrees).unwrap();
            let mesh = fan(&angles, 0.0, &by);
            let frame = Frame::of(&Aabb::of_faces(&mesh));
            let other = Retriangulated::new(&mesh, &frame).unwrap();
            prop_assert_eq!(other.mesh.faces().len(), mesh.faces().len());
            prop_assert!(other.mesh.faces() != mesh.faces() && other.before().faces() == mesh.faces());
            prop_assert!(degrees > 0.0 || other.moved == 0.0);
            let (before, after) = (triangles(&mesh, &frame), triangles(&other.mesh, &frame));
            for p in points {
                let p = frame.map(by.apply(p));
                let distance = point_triangles(p, &before);
                prop_assert!((distance - point_triangles(p, &after)).abs() < other.moved + 1e-15);
                let of = |i: &usize| point_triangles(p, &after[*i..=*i]);
                let nearest = (0..after.len()).min_by(|i, j| of(i).total_cmp(&of(j))).unwrap();
                let (face, corners) = other.nearest_before(FaceId(nearest as u32), p, &frame);
                prop_assert_eq!(corners, before[face.index()]);
                prop_assert!((distance - point_triangles(p, &[corners])).abs() < other.moved + 1e-15);
            }
        }
    }

    /// A square with a round hole in it of so many corners, each edge of which is joined to a corner of the square.
    fn plate(n: u32, by: &Affine) -> TriMesh {
        let rim =
            (0..n).map(|i| TAU * f64::from(i) / f64::from(n)).map(|t| [0.5 * t.cos(), 0.5 * t.sin(), 0.0]);
        let square = [[1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [-1.0, -1.0, 0.0], [1.0, -1.0, 0.0]];
        let fans = (0..n).map(|i| [(i + 1) % n, i, n + 4 * i / n]);
        let between = (0..4).map(|q| [(q + 1) * n / 4 % n, n + q, n + (q + 1) % 4]);
        let mesh = TriMesh::new(rim.chain(square).collect(), fans.chain(between).collect()).unwrap();
        transform(&mesh, by).unwrap()
    }

    /// Around a hole points inside make the faces thicker; the boundary stays.
    #[test]
    fn a_plate_with_a_hole() {
        for by in [Affine::translate([0.0; 3]), Affine::rotate([0.3, -0.5, 0.8], 71.0).unwrap()] {
            let mesh = plate(96, &by);
            let frame = Frame::of(&Aabb::of_faces(&mesh));
            let other = Retriangulated::new(&mesh, &frame).unwrap();
            assert!(other.mesh.positions().len() > mesh.positions().len());
            assert_eq!(other.before().faces(), mesh.faces());
            assert_eq!(other.moved > 0.0, by.linear[0][0] != 1.0);
            let thin = |mesh: &TriMesh| {
                let corners = |f| mesh.corners(f).map(DVec3::from_array);
                mesh.face_ids().filter(|f| is_thin(corners(*f))).count()
            };
            assert!(thin(&mesh) >= 80 && thin(&other.mesh) <= 20, "{} {}", thin(&mesh), thin(&other.mesh));
            let (before, after) = (triangles(&mesh, &frame), triangles(&other.mesh, &frame));
            for i in 0..400 {
                let [x, y] = [i % 20, i / 20].map(|k| 2.2 * (f64::from(k) + 0.5) / 20.0 - 1.1);
                let p = frame.map(by.apply([x, y, 0.1 * x * y]));
                let distance = point_triangles(p, &before);
                assert!((distance - point_triangles(p, &after)).abs() < other.moved + 1e-15);
            }
        }
    }

    /// A corner that is out of the plane by more than rounding keeps a patch as it is.
    #[test]
    fn what_is_not_flat_stays() {
        let angles: Vec<f64> = (0..100).map(|i| TAU * f64::from(i) / 100.0).collect();
        let found = |raised: f64| {
            let mesh = fan(&angles, raised, &Affine::translate([0.0; 3]));
            Retriangulated::new(&mesh, &Frame::of(&Aabb::of_faces(&mesh))).map(|other| other.moved)
        };
        assert_eq!(found(0.0), Some(0.0));
        assert!(found(1e-16).is_some_and(|moved| moved > 0.0 && moved < 1e-16));
        assert_eq!(found(1e-12), None);
    }
}
