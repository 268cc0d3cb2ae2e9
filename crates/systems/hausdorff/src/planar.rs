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

use glam::DVec3;
use pompeiu_core::geom::point_triangle::distance_sq;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;
use robust::{Coord, orient2d};
use spade::{
    ConstrainedDelaunayTriangulation, DelaunayTriangulation, Point2, PositionInTriangulation,
    RefinementParameters, Triangulation,
};
use std::collections::{BTreeMap, BTreeSet, HashSet};

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

/// How many points are added at most for each on the boundary.
const MOST_POINTS: usize = 32;

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
            let Some(other) = seen.other_faces(&mut positions, &patch, MOST_MOVED * unit) else { continue };
            moved = if other.1 > moved { other.1 } else { moved };
            patch_of.extend(other.0.iter().map(|_| patches.len() as u32));
            faces.extend(other.0);
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
    let mut edges: Vec<([u32; 2], bool, u32)> = Vec::with_capacity(3 * faces.len());
    for (i, face) in (0..).zip(faces) {
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
    let mut first: Vec<u32> = (0..faces.len() as u32).collect();
    for two in edges.chunk_by(|e, f| e.0 == f.0) {
        let &[(_, d, i), (_, e, j)] = two else { continue };
        let (m, n) = (normals[i as usize], normals[j as usize]);
        if d != e && m.dot(n) > 0.0 && m.cross(n).length() < MOST_ANGLE {
            let (i, j) = (first_of(&mut first, i), first_of(&mut first, j));
            first[i.max(j) as usize] = i.min(j);
        }
    }
    let mut patches: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for (i, face) in (0..).zip(faces) {
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

/// A patch as it is seen along an axis, so that its faces turn left.
struct Seen<'m> {
    mesh: &'m TriMesh,
    frame: &'m Frame,
    /// The axes of the picture, and that along which it is seen.
    axes: [usize; 3],
    /// Of the plane that is nearest to the vertices.
    slopes: [f64; 2],
    /// A vertex, in these axes.
    vertex: [f64; 3],
}

impl<'m> Seen<'m> {
    fn new(mesh: &'m TriMesh, frame: &'m Frame, patch: &[u32]) -> Option<Self> {
        let place = |vertex: u32| frame.map(mesh.positions()[vertex as usize]);
        let normal: DVec3 = patch
            .iter()
            .map(|face| {
                let [a, b, c] = mesh.faces()[*face as usize].map(|v| DVec3::from_array(place(v)));
                (b - a).cross(c - a)
            })
            .sum();
        let axis = (1..3).fold(0, |most, k| if normal[k].abs() > normal[most].abs() { k } else { most });
        let (next, after) = ((axis + 1) % 3, (axis + 2) % 3);
        let axes = if normal[axis] > 0.0 { [next, after, axis] } else { [after, next, axis] };
        let [x, y, z] = axes;
        let mut vertices: Vec<u32> = patch.iter().flat_map(|face| mesh.faces()[*face as usize]).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let points: Vec<[f64; 3]> = vertices.into_iter().map(place).map(|p| axes.map(|k| p[k])).collect();
        let slopes = fitted(&points, [-normal[x] / normal[z], -normal[y] / normal[z]]);
        let seen = Self { mesh, frame, axes, slopes, vertex: *points.first()? };
        let are_seen =
            patch.iter().all(|face| turns_left(mesh.faces()[*face as usize].map(|v| seen.at(place(v)))));
        are_seen.then_some(seen)
    }

    /// A point of the frame in the picture.
    fn at(&self, p: [f64; 3]) -> Coord<f64> {
        Coord { x: p[self.axes[0]], y: p[self.axes[1]] }
    }

    /// The position of the point of the plane that is seen at a place.
    fn position(&self, x: f64, y: f64) -> [f64; 3] {
        let z =
            self.vertex[2] + self.slopes[0] * (x - self.vertex[0]) + self.slopes[1] * (y - self.vertex[1]);
        let mut p = [0.0; 3];
        for (axis, value) in self.axes.into_iter().zip([x, y, z]) {
            p[axis] = value;
        }
        self.frame.unmap(p)
    }

    /// Other faces for those of a patch, whose further vertices are appended, and how far they are from these, no more than `most`; none where that
    /// is not known.
    fn other_faces(
        &self,
        positions: &mut Vec<[f64; 3]>,
        patch: &[u32],
        most: f64,
    ) -> Option<(Vec<[u32; 3]>, f64)> {
        let count = positions.len();
        let boundary = boundary(patch.iter().map(|face| self.mesh.faces()[*face as usize]))?;
        let faces = self.triangulate(positions, &boundary).filter(|faces| {
            let place = |v: u32| self.at(self.frame.map(positions[v as usize]));
            faces.iter().all(|face| turns_left(face.map(place)))
                && self::boundary(faces.iter().copied()).as_ref() == Some(&boundary)
        });
        let of_patch = patch.iter().map(|face| self.mesh.faces()[*face as usize]);
        let points: Vec<[f64; 3]> = (of_patch.chain(faces.iter().flatten().copied()).flatten())
            .map(|v| self.frame.map(positions[v as usize]))
            .map(|p| self.axes.map(|k| p[k]))
            .collect();
        let (least, greatest) = ends(&heights(&points, self.slopes));
        let width = greatest - least;
        if faces.is_none() || width > most {
            positions.truncate(count);
        }
        faces.filter(|_| width <= most).map(|faces| (faces, width))
    }

    fn triangulate(&self, positions: &mut Vec<[f64; 3]>, boundary: &[[u32; 2]]) -> Option<Vec<[u32; 3]>> {
        let place = |v: u32| self.at(self.frame.map(positions[v as usize]));
        let around = polygon(boundary);
        let by_ears = around.and_then(|polygon| cut_ears(polygon, |ear| turns_left(ear.map(place))));
        by_ears.or_else(|| self.refine(positions, boundary))
    }

    /// A constrained Delaunay triangulation of what is left of edges, with points inside.
    fn refine(&self, positions: &mut Vec<[f64; 3]>, boundary: &[[u32; 2]]) -> Option<Vec<[u32; 3]>> {
        let vertices: Vec<u32> =
            boundary.iter().map(|edge| edge[0]).collect::<BTreeSet<_>>().into_iter().collect();
        let place = |v: &u32| {
            let Coord { x, y } = self.at(self.frame.map(positions[*v as usize]));
            Point2::new(x, y)
        };
        let corners: Vec<Point2<f64>> = vertices.iter().map(place).collect();
        let local = |v: u32| vertices.binary_search(&v).unwrap_or(0);
        let edges: Vec<[usize; 2]> = boundary.iter().map(|edge| edge.map(local)).collect();
        let further = points_inside(&corners, &edges)?;
        let mut crossed = false;
        let mut made =
            ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(corners, edges, |_| {
                crossed = true;
            })
            .ok()?;
        if crossed || made.num_vertices() != vertices.len() {
            return None;
        }
        for point in further {
            let is_on_boundary = match made.locate(point) {
                PositionInTriangulation::OnEdge(edge) => made.directed_edge(edge).is_constraint_edge(),
                PositionInTriangulation::OnFace(_) => false,
                _ => true,
            };
            if !is_on_boundary {
                made.insert(point).ok()?;
            }
        }
        // What is outside is found before any point would be added.
        let outside = made
            .refine(RefinementParameters::new().exclude_outer_faces(true).with_max_additional_vertices(0));
        let outside: HashSet<_> = outside.excluded_faces.into_iter().collect();
        let first = positions.len() as u32;
        let further = made.vertices().skip(vertices.len()).map(|v| v.position());
        positions.extend(further.map(|point| self.position(point.x, point.y)));
        let number = |index: usize| {
            index
                .checked_sub(vertices.len())
                .map_or_else(|| vertices[index], |further| first + further as u32)
        };
        let inside = made.inner_faces().filter(|face| !outside.contains(&face.fix()));
        Some(inside.map(|face| face.vertices().map(|v| number(v.fix().index()))).collect())
    }
}

/// Centres of squares that are about as large as the nearest corner is far, and next to it as its shortest edge is long; none where they are too many.
fn points_inside(corners: &[Point2<f64>], edges: &[[usize; 2]]) -> Option<Vec<Point2<f64>>> {
    let mut spacing = vec![f64::INFINITY; corners.len()];
    for edge in edges {
        let length = corners[edge[0]].distance_2(corners[edge[1]]).sqrt();
        for corner in edge {
            spacing[*corner] = f64::min(spacing[*corner], length);
        }
    }
    let near = DelaunayTriangulation::<Point2<f64>>::bulk_load_stable(corners.to_vec()).ok()?;
    let range = |of: fn(&Point2<f64>) -> f64| {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        corners.iter().map(of).fold(ends, |(low, high), x| (f64::min(low, x), f64::max(high, x)))
    };
    let ((left, right), (below, above)) = (range(|p| p.x), range(|p| p.y));
    let half = 0.5 * f64::max(right - left, above - below);
    let mut squares = vec![(Point2::new(0.5 * (left + right), 0.5 * (below + above)), half)];
    let mut points = Vec::new();
    while let Some((centre, half)) = squares.pop() {
        let nearest = near.nearest_neighbor(centre)?;
        let reach = nearest.position().distance_2(centre).sqrt() + spacing.get(nearest.fix().index())?;
        if 2.0 * half <= reach {
            points.push(centre);
        } else if points.len() + squares.len() < MOST_POINTS * corners.len() {
            let half = 0.5 * half;
            let quarters = [(-half, -half), (-half, half), (half, -half), (half, half)];
            squares.extend(quarters.map(|(x, y)| (Point2::new(centre.x + x, centre.y + y), half)));
        } else {
            return None;
        }
    }
    Some(points)
}

fn turns_left([a, b, c]: [Coord<f64>; 3]) -> bool {
    orient2d(a, b, c) > 0.0
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

/// The edges of faces that no other runs through the other way, in order; none where two run through one the same way.
fn boundary(faces: impl Iterator<Item = [u32; 3]>) -> Option<Vec<[u32; 2]>> {
    let mut edges: Vec<[u32; 2]> = faces.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    edges.sort_unstable();
    if edges.windows(2).any(|two| two[0] == two[1]) {
        return None;
    }
    let is_free = |[p, q]: &[u32; 2]| edges.binary_search(&[*q, *p]).is_err();
    Some(edges.iter().copied().filter(is_free).collect())
}

/// The vertices along edges, if these are one polygon that passes each once.
fn polygon(edges: &[[u32; 2]]) -> Option<Vec<u32>> {
    if edges.windows(2).any(|two| two[0][0] == two[1][0]) {
        return None;
    }
    let next = |vertex: u32| {
        let place = edges.binary_search_by_key(&vertex, |edge| edge[0]).ok()?;
        Some(edges[place][1])
    };
    let start = edges.first()?[0];
    let mut polygon = vec![start];
    let mut at = next(start)?;
    while at != start && polygon.len() < edges.len() {
        polygon.push(at);
        at = next(at)?;
    }
    (at == start && polygon.len() == edges.len()).then_some(polygon)
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
