//! Triangulating faces with more than three corners.
//!
//! A face with n corners always becomes n − 2 triangles between its own corners. Readers therefore store the fan about the first
//! corner and note its place; once all positions are known, [`triangulate`] replaces the fans that do not cover their polygon, in
//! place and in parallel. No polygon is stored twice.

mod monotone;

use earcut::Earcut;
use std::collections::BTreeSet;

/// The place in a list of triangles of a face with more than three corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Polygon {
    /// Its first triangle; `corners - 2` triangles belong to it.
    pub(crate) first: u32,
    /// Its number of corners, at least 4.
    pub(crate) corners: u32,
}

impl Polygon {
    const fn triangles(self) -> usize {
        self.corners as usize - 2
    }
}

/// Polygons with more corners than this are first divided into monotone parts, in O(n log n), instead of by ear clipping.
const MOST_CORNERS_TO_CLIP_FIRST: usize = 1 << 10;

/// Beyond this many corners a polygon that touches or crosses itself is rejected: ear clipping is quadratic and could take minutes.
pub(crate) const MOST_CORNERS_TO_CLIP: usize = 1 << 14;

/// Polygons per task: few compared with a mesh, many compared with the overhead of a task.
const POLYGONS_PER_TASK: usize = 4096;

/// Replaces fans that do not cover their polygon by triangles that do.
///
/// Polygons are projected along their Newell normal. A fan stays if all its triangles have the orientation of the polygon; a
/// concave quadrilateral gets the other diagonal; other polygons are triangulated by ear clipping, or divided into monotone parts
/// if they have many corners. Polygons that cross themselves, are degenerate or have non-finite corners stay fans.
///
/// # Errors
/// The first polygon that touches or crosses itself and has more than [`MOST_CORNERS_TO_CLIP`] corners.
///
/// # Cost
/// O(n) for convex polygons and quadrilaterals, O(n log n) for simple ones with many corners, parallel over polygons; ear
/// clipping of the others is quadratic at worst.
pub(crate) fn triangulate(
    positions: &[[f64; 3]],
    faces: &mut [[u32; 3]],
    polygons: &[Polygon],
) -> Result<(), Polygon> {
    let Some((first, last)) = polygons.first().zip(polygons.last()) else { return Ok(()) };
    let span = first.first as usize..last.first as usize + last.triangles();
    triangulate_part(positions, &mut faces[span], polygons)
}

/// `faces` is the range from the first triangle of the first polygon to the last triangle of the last.
fn triangulate_part(
    positions: &[[f64; 3]],
    faces: &mut [[u32; 3]],
    polygons: &[Polygon],
) -> Result<(), Polygon> {
    let base = polygons[0].first as usize;
    if polygons.len() > POLYGONS_PER_TASK {
        let (left, right) = polygons.split_at(polygons.len() / 2);
        let (left_faces, right_faces) = faces.split_at_mut(right[0].first as usize - base);
        let (left, right) = rayon::join(
            || triangulate_part(positions, left_faces, left),
            || triangulate_part(positions, right_faces, right),
        );
        return left.and(right);
    }
    let mut work = Workspace::default();
    for polygon in polygons {
        let start = polygon.first as usize - base;
        let fan = &mut faces[start..start + polygon.triangles()];
        if let &mut [[a, b, c], [_, _, d]] = fan {
            if diagonal_leaves_quadrilateral([a, b, c, d], positions) {
                fan.copy_from_slice(&[[b, c, d], [b, d, a]]);
            }
        } else if work.refine(fan, positions).is_none() {
            return Err(*polygon);
        }
    }
    Ok(())
}

fn subtract(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// Moves the first corner to the origin and scales the largest coordinate to 1, so that products neither overflow nor underflow;
/// `None` if that is impossible.
fn scale(corners: impl Iterator<Item = [f64; 3]> + Clone, into: &mut [[f64; 3]]) -> Option<()> {
    let origin = corners.clone().next()?;
    let mut extent: f64 = 0.0;
    for (slot, corner) in into.iter_mut().zip(corners) {
        *slot = subtract(corner, origin);
        for x in *slot {
            if !x.is_finite() {
                return None;
            }
            extent = extent.max(x.abs());
        }
    }
    if extent == 0.0 {
        return None;
    }
    for slot in into.iter_mut() {
        *slot = slot.map(|x| x / extent);
    }
    Some(())
}

/// Whether the diagonal from the first to the third corner is worse than the other one: it leaves the quadrilateral or makes one of
/// the two triangles degenerate.
fn diagonal_leaves_quadrilateral(corners: [u32; 4], positions: &[[f64; 3]]) -> bool {
    let mut points = [[0.0; 3]; 4];
    for (point, &index) in points.iter_mut().zip(&corners) {
        let Some(&position) = positions.get(index as usize) else { return false };
        *point = position;
    }
    let mut shifted = [[0.0; 3]; 4];
    if scale(points.into_iter(), &mut shifted).is_none() {
        return false;
    }
    let [a, b, c, d] = shifted;
    // Twice the vector area of the quadrilateral is the cross product of its diagonals.
    let normal = cross(subtract(c, a), subtract(d, b));
    let area = |p, q, r| dot(cross(subtract(q, p), subtract(r, p)), normal);
    let first = area(a, b, c).min(area(a, c, d));
    first <= 0.0 && area(b, c, d).min(area(b, d, a)) > first
}

/// Scratch memory reused between polygons.
#[derive(Default)]
struct Workspace {
    ids: Vec<u32>,
    points: Vec<[f64; 3]>,
    plane: Vec<[f64; 2]>,
    clipper: Option<Earcut<f64>>,
    clipped: Vec<u32>,
    edges: BTreeSet<(u32, u32)>,
}

impl Workspace {
    /// Replaces the fan of a polygon with five or more corners if the fan does not cover the polygon; `None` if the polygon has too
    /// many corners for that.
    fn refine(&mut self, fan: &mut [[u32; 3]], positions: &[[f64; 3]]) -> Option<()> {
        self.ids.clear();
        self.ids.extend([fan[0][0], fan[0][1]]);
        self.ids.extend(fan.iter().map(|triangle| triangle[2]));
        let known = self.ids.iter().all(|&id| (id as usize) < positions.len());
        if !known || self.project(positions).is_none() || self.fan_fits() {
            return Some(());
        }
        if self.ids.len() > MOST_CORNERS_TO_CLIP_FIRST {
            self.clipped.clear();
            monotone::triangulate(&self.plane, &mut self.clipped);
            if self.clipped.len() == 3 * fan.len() && self.clipping_covers() {
                self.take_clipped(fan);
                return Some(());
            }
        }
        if self.ids.len() > MOST_CORNERS_TO_CLIP {
            return None;
        }
        let clipper = self.clipper.get_or_insert_with(Earcut::new);
        clipper.earcut(self.plane.iter().copied(), &[], &mut self.clipped);
        if self.clipping_covers() && self.close_gaps(fan.len()) {
            self.take_clipped(fan);
        }
        Some(())
    }

    fn take_clipped(&self, fan: &mut [[u32; 3]]) {
        for (triangle, corners) in fan.iter_mut().zip(self.clipped.chunks_exact(3)) {
            *triangle = [corners[0], corners[1], corners[2]].map(|corner| self.ids[corner as usize]);
        }
    }

    /// Projects the polygon along the largest coordinate of its Newell normal, counterclockwise.
    fn project(&mut self, positions: &[[f64; 3]]) -> Option<()> {
        self.points.resize(self.ids.len(), [0.0; 3]);
        scale(self.ids.iter().map(|&id| positions[id as usize]), &mut self.points)?;
        let mut normal = [0.0; 3];
        for pair in self.points.windows(2) {
            let product = cross(pair[0], pair[1]);
            normal = [normal[0] + product[0], normal[1] + product[1], normal[2] + product[2]];
        }
        let axis = (0..3).max_by(|&i, &j| f64::total_cmp(&normal[i].abs(), &normal[j].abs()))?;
        if normal[axis] == 0.0 {
            return None;
        }
        let (mut u, mut v) = ((axis + 1) % 3, (axis + 2) % 3);
        if normal[axis] < 0.0 {
            (u, v) = (v, u);
        }
        self.plane.clear();
        self.plane.extend(self.points.iter().map(|p| [p[u], p[v]]));
        Some(())
    }

    fn doubled_area(&self, corners: [u32; 3]) -> f64 {
        let [a, b, c] = corners.map(|corner| self.plane[corner as usize]);
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    }

    /// Whether every triangle of the fan is counterclockwise: the whole polygon is then visible from the first corner.
    fn fan_fits(&self) -> bool {
        (2..self.plane.len() as u32).all(|corner| self.doubled_area([0, corner - 1, corner]) > 0.0)
    }

    /// Whether the clipped triangles, all of one orientation, are counterclockwise and have the area of the polygon in total. They
    /// do not if the polygon crosses itself.
    fn clipping_covers(&mut self) -> bool {
        // Rounding of areas of at most 4 each, in units of the scaled extent of the polygon.
        let tolerance = 1e-12 * self.plane.len() as f64;
        let polygon: f64 =
            (2..self.plane.len() as u32).map(|corner| self.doubled_area([0, corner - 1, corner])).sum();
        let areas = self
            .clipped
            .chunks_exact(3)
            .map(|corners| self.doubled_area([corners[0], corners[1], corners[2]]));
        let (smallest, covered) =
            areas.fold((f64::INFINITY, 0.0), |(smallest, sum), area| (area.min(smallest), sum + area));
        smallest >= -tolerance && (covered - polygon).abs() <= tolerance
    }

    /// Ear clipping skips collinear corners. Fills the slits that this leaves between the clipped triangles and the edges of the
    /// polygon with degenerate triangles, so that every corner stays connected and there are `count` triangles; returns whether
    /// that succeeded.
    fn close_gaps(&mut self, count: usize) -> bool {
        if self.clipped.len() == 3 * count {
            return true;
        }
        // The edges of the polygon minus the edges of the triangles: loops around the slits.
        let n = self.plane.len() as u32;
        self.edges.clear();
        self.edges.extend((0..n).map(|corner| (corner, (corner + 1) % n)));
        for corners in self.clipped.chunks_exact(3) {
            let [a, b, c] = [corners[0], corners[1], corners[2]];
            for (from, to) in [(b, a), (c, b), (a, c)] {
                if !self.edges.remove(&(to, from)) {
                    self.edges.insert((from, to));
                }
            }
        }
        while let Some((start, mut previous)) = self.edges.pop_first() {
            while let Some(&edge) = self.edges.range((previous, 0)..=(previous, u32::MAX)).next() {
                self.edges.remove(&edge);
                if edge.1 == start {
                    break;
                }
                self.clipped.extend([start, previous, edge.1]);
                previous = edge.1;
            }
        }
        self.clipped.len() == 3 * count
    }
}

#[cfg(test)]
mod tests;
