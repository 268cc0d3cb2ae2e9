//! Thin faces of B in one plane, in another triangulation of the same region that a line crosses few faces of.
//!
//! The end of a tessellated cylinder is a fan: n faces that meet in one vertex, of which a face of another fan crosses up to n. The same
//! polygon in a triangulation whose ears are cut off in rounds, every other vertex in each, has about 2 log n along any line. B is only measured to, and as
//! a set of points it is the same.
//!
//! # Why it is the same set
//! Faces are looked at along an axis, and all turn the same way there, exactly (`shewchuk_predicates_1997`). So the number of faces over a point is how often
//! the boundary of the faces winds around it: a point is covered where that is not zero. Both triangulations have the same boundary and turn the same way, so they
//! cover the same points. Heights over the plane of the axes are interpolated from those of the same vertices, and differ by at most the width
//! of a layer that contains these: [`Retriangulated::moved`]. It is zero for vertices with one coordinate in common.

use glam::DVec3;
use pompeiu_core::geom::point_triangle::distance_sq;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::{FaceId, TriMesh};
use robust::{Coord, orient2d};
use std::collections::{BTreeMap, HashMap};

/// A face is thin if its longest edge has more than this many times its height.
const THIN: f64 = 8.0;
/// Faces that are looked at before all are, and how many of them must be thin.
const SAMPLE: usize = 1024;
const LEAST_IN_SAMPLE: usize = 8;
/// A patch of fewer faces is left alone.
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
        let thin: Vec<u32> = (0..count).filter(|face| is_thin(corners(*face))).collect();
        let unit = 0.5 * f64::EPSILON * f64::max(0.25, frame.max_coordinate(&Aabb::of_faces(mesh)));
        let mut moved = 0.0;
        let mut patches = Vec::new();
        let mut faces = Vec::new();
        let mut patch_of = Vec::new();
        for patch in patches_of(mesh, &thin, &corners) {
            let Some((other, by)) = retriangulate(mesh, frame, &patch, MOST_MOVED * unit) else { continue };
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
        let mesh = TriMesh::new(mesh.positions().to_vec(), faces).ok()?;
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

/// Thin faces that are connected across edges and nearly in one plane.
fn patches_of(mesh: &TriMesh, thin: &[u32], corners: &impl Fn(u32) -> [DVec3; 3]) -> Vec<Vec<u32>> {
    let mut edges: Vec<([u32; 2], bool, u32)> = Vec::with_capacity(3 * thin.len());
    for (i, face) in (0..).zip(thin) {
        let [a, b, c] = mesh.faces()[*face as usize];
        edges.extend([[a, b], [b, c], [c, a]].map(|[p, q]| ([p.min(q), p.max(q)], p < q, i)));
    }
    edges.sort_unstable();
    let normals: Vec<DVec3> = thin
        .iter()
        .map(|face| {
            let [a, b, c] = corners(*face);
            (b - a).cross(c - a).normalize_or_zero()
        })
        .collect();
    let mut first: Vec<u32> = (0..thin.len() as u32).collect();
    for two in edges.chunk_by(|e, f| e.0 == f.0) {
        let &[(_, d, i), (_, e, j)] = two else { continue };
        let (m, n) = (normals[i as usize], normals[j as usize]);
        if d != e && m.dot(n) > 0.0 && m.cross(n).length() < MOST_ANGLE {
            let (i, j) = (first_of(&mut first, i), first_of(&mut first, j));
            first[i.max(j) as usize] = i.min(j);
        }
    }
    let mut patches: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (i, face) in (0..).zip(thin) {
        patches.entry(first_of(&mut first, i)).or_default().push(*face);
    }
    patches.into_values().filter(|patch| patch.len() >= LEAST_FACES).collect()
}

/// The first of the set of an element; what leads there is made shorter.
fn first_of(first: &mut [u32], mut i: u32) -> u32 {
    while first[i as usize] != i {
        first[i as usize] = first[first[i as usize] as usize];
        i = first[i as usize];
    }
    i
}

/// Other faces for those of a patch, and how far they are from these, no more than `most`; none where that is not known or the boundary is not one polygon
/// whose ears can be cut off.
fn retriangulate(mesh: &TriMesh, frame: &Frame, patch: &[u32], most: f64) -> Option<(Vec<[u32; 3]>, f64)> {
    let place = |vertex: u32| frame.map(mesh.positions()[vertex as usize]);
    let normal: DVec3 = patch
        .iter()
        .map(|face| {
            let [a, b, c] = mesh.faces()[*face as usize].map(|v| DVec3::from_array(place(v)));
            (b - a).cross(c - a)
        })
        .sum();
    let size = normal.abs();
    let axis = if size.x >= size.y && size.x >= size.z {
        0
    } else if size.y >= size.z {
        1
    } else {
        2
    };
    let (x, y) =
        if normal[axis] > 0.0 { ((axis + 1) % 3, (axis + 2) % 3) } else { ((axis + 2) % 3, (axis + 1) % 3) };
    let seen = |vertex: u32| {
        let p = place(vertex);
        Coord { x: p[x], y: p[y] }
    };
    let turns_left = |[a, b, c]: [u32; 3]| orient2d(seen(a), seen(b), seen(c)) > 0.0;
    if !patch.iter().all(|face| turns_left(mesh.faces()[*face as usize])) {
        return None;
    }
    let points: Vec<[f64; 3]> =
        vertices(mesh, patch).into_iter().map(place).map(|p| [p[x], p[y], p[axis]]).collect();
    let slopes = fitted(&points, [-normal[x] / normal[axis], -normal[y] / normal[axis]]);
    let (least, greatest) = ends(&heights(&points, slopes));
    let width = greatest - least;
    if width > most {
        return None;
    }
    Some((cut_ears(boundary(mesh, patch)?, turns_left)?, width))
}

fn vertices(mesh: &TriMesh, patch: &[u32]) -> Vec<u32> {
    let mut vertices: Vec<u32> = patch.iter().flat_map(|face| mesh.faces()[*face as usize]).collect();
    vertices.sort_unstable();
    vertices.dedup();
    vertices
}

/// The height of a point over the plane through zero with given slopes, as a sum of two.
fn height([a, b]: [f64; 2], [x, y, z]: [f64; 3]) -> [f64; 2] {
    let difference = |p: f64, q: f64| {
        let d = p - q;
        let r = p - d;
        [d, (p - (d + r)) + (r - q)]
    };
    let (p, q) = (a * x, b * y);
    let [d, e] = difference(z, p);
    let [f, g] = difference(d, q);
    [f, e + g - a.mul_add(x, -p) - b.mul_add(y, -q)]
}

/// How much higher points are than the first, which is little, so that the differences are known to a small part of the last place of coordinates.
fn heights(points: &[[f64; 3]], slopes: [f64; 2]) -> Vec<f64> {
    let [high, low] = height(slopes, points[0]);
    let above_first = |point: &[f64; 3]| {
        let height = height(slopes, *point);
        (height[0] - high) + (height[1] - low)
    };
    points.iter().map(above_first).collect()
}

/// The least and the greatest of some numbers, both infinite where one is none.
fn ends(numbers: &[f64]) -> (f64, f64) {
    if numbers.iter().any(|x| x.is_nan()) {
        return (f64::NEG_INFINITY, f64::INFINITY);
    }
    numbers.iter().fold((0.0, 0.0), |(least, greatest), x| (f64::min(least, *x), f64::max(greatest, *x)))
}

/// Slopes over which the heights of points have the least squares. Those of a sum of normals are off by several units of the last place.
fn fitted(points: &[[f64; 3]], slopes: [f64; 2]) -> [f64; 2] {
    let heights = heights(points, slopes);
    let mean = |of: &dyn Fn(usize) -> f64| (0..points.len()).map(of).sum::<f64>() / points.len() as f64;
    let [x, y, h] = [mean(&|i| points[i][0]), mean(&|i| points[i][1]), mean(&|i| heights[i])];
    let around = |i: usize| [points[i][0] - x, points[i][1] - y, heights[i] - h];
    let moment = |j: usize, k: usize| mean(&|i| around(i)[j] * around(i)[k]);
    let (xx, xy, yy, xh, yh) = (moment(0, 0), moment(0, 1), moment(1, 1), moment(0, 2), moment(1, 2));
    let determinant = xx * yy - xy * xy;
    let better =
        [slopes[0] + (xh * yy - yh * xy) / determinant, slopes[1] + (yh * xx - xh * xy) / determinant];
    if better.iter().all(|slope| slope.is_finite()) { better } else { slopes }
}

/// The vertices around the faces of a patch, if these are one polygon that passes each once.
fn boundary(mesh: &TriMesh, patch: &[u32]) -> Option<Vec<u32>> {
    let mut next: HashMap<u32, u32> = HashMap::new();
    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(3 * patch.len());
    for face in patch {
        let [a, b, c] = mesh.faces()[*face as usize];
        edges.extend([[a, b], [b, c], [c, a]]);
    }
    edges.sort_unstable();
    if edges.windows(2).any(|two| two[0] == two[1]) {
        return None;
    }
    for [p, q] in &edges {
        if edges.binary_search(&[*q, *p]).is_err() && next.insert(*p, *q).is_some() {
            return None;
        }
    }
    let start = *next.keys().min()?;
    let mut polygon = vec![start];
    let mut at = *next.get(&start)?;
    while at != start {
        polygon.push(at);
        at = *next.get(&at)?;
    }
    (polygon.len() == next.len()).then_some(polygon)
}

/// A triangulation of a convex polygon by rounds in which every other ear is cut off. None where that comes to no end, as it may
/// where the polygon is not convex.
fn cut_ears(mut polygon: Vec<u32>, turns_left: impl Fn([u32; 3]) -> bool) -> Option<Vec<[u32; 3]>> {
    let convex = |i: usize| {
        let n = polygon.len();
        !turns_left([polygon[(i + 2) % n], polygon[(i + 1) % n], polygon[i]])
    };
    if !(0..polygon.len()).all(convex) {
        return None;
    }
    let mut faces = Vec::with_capacity(polygon.len() - 2);
    while polygon.len() > 3 {
        let mut left = Vec::with_capacity(polygon.len() / 2 + 1);
        let (mut i, mut remain) = (0, polygon.len());
        while i < polygon.len() {
            left.push(polygon[i]);
            if let Some(&tip) = polygon.get(i + 1)
                && let ear = [polygon[i], tip, polygon[(i + 2) % polygon.len()]]
                && remain > 3
                && turns_left(ear)
            {
                faces.push(ear);
                remain -= 1;
                i += 1;
            }
            i += 1;
        }
        if left.len() == polygon.len() {
            return None;
        }
        polygon = left;
    }
    let last = [polygon[0], polygon[1], polygon[2]];
    turns_left(last).then(|| {
        faces.push(last);
        faces
    })
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

    /// A line through a polygon of n corners crosses few of the faces.
    #[test]
    fn lines_cross_few_faces() {
        let n = 1024_u32;
        let at = |i: u32| {
            let angle = TAU * f64::from(i) / f64::from(n);
            Coord { x: angle.cos(), y: angle.sin() }
        };
        let faces = cut_ears((0..n).collect(), |[a, b, c]| orient2d(at(a), at(b), at(c)) > 0.0).unwrap();
        assert_eq!(faces.len(), n as usize - 2);
        for angle in [0.1, 1.0, 2.0, 3.0] {
            let across = |p: Coord<f64>| p.x * f64::cos(angle) + p.y * f64::sin(angle) > 0.3;
            let crossed = faces.iter().filter(|face| {
                let sides = face.map(|i| across(at(i)));
                sides.contains(&true) && sides.contains(&false)
            });
            assert!(crossed.count() <= 20, "{angle}");
        }
    }
}
