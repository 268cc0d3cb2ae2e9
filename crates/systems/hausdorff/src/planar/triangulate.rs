//! A patch of faces in one plane in another triangulation: by ears cut off in rounds where it is convex, else with points inside.

use super::layer;
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;
use robust::{Coord, orient2d};
use spade::{
    ConstrainedDelaunayTriangulation, DelaunayTriangulation, Point2, PositionInTriangulation,
    RefinementParameters, Triangulation,
};
use std::collections::{BTreeSet, HashSet};

/// How many points are added at most for each on the boundary.
const MOST_POINTS: usize = 32;

/// A patch as it is seen along an axis, so that its faces turn left.
pub(super) struct Seen<'m> {
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
    pub(super) fn new(mesh: &'m TriMesh, frame: &'m Frame, patch: &[u32]) -> Option<Self> {
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
        let slopes = layer::fitted(&points, [-normal[x] / normal[z], -normal[y] / normal[z]]);
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
    pub(super) fn other_faces(
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
        let width = layer::width(&points, self.slopes);
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
    use std::f64::consts::TAU;

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
