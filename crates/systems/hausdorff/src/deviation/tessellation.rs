//! Triangles to draw: faces where linear interpolation shows the deviation well enough, their pieces elsewhere.

use super::criterion::Criterion;
use super::face::Cutter;
use super::frame::frame_of;
use super::linear::{greater, lesser};
use super::polygon::Piece;
use super::report::{DirectedDeviation, FaceDeviation};
use super::task::Faces;
use crate::engine::bytes_to_start;
use crate::prepared::PreparedPair;
use crate::report::Direction;
use pompeiu_core::geom::Aabb;
use pompeiu_core::run::{Control, Limits};
use pompeiu_core::spatial::morton_order;
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;
use std::sync::Mutex;

/// A triangle of a surface with the distance at its corners, for drawing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DisplayTriangle {
    /// The face that it is, or is a part of.
    pub face: FaceId,
    /// Its corners, rounded, in the unit of the mesh.
    pub corners: [[f64; 3]; 3],
    /// The distance from the other mesh at the corners.
    pub distances: [f64; 3],
    /// How far the distance at a point of the triangle may be from the interpolated one.
    pub error: f64,
}

/// Pieces of one face at most.
const MOST_PIECES: usize = 1024;
/// Faces of a task.
const TASK: usize = 64;

impl DirectedDeviation {
    /// Triangles that show the deviation within a tolerance, in the order of the faces: a face is itself where linear interpolation
    /// of the distances at its corners does, else it is cut. `mesh` must be the one that was measured, `other` the one it was
    /// measured to.
    ///
    /// At most `most` triangles, or as many as the mesh has faces if that is more: the faces that need to be cut most come
    /// first, and the others stay whole, with a greater error. Parts of neighbouring faces do not share corners.
    ///
    /// # Cost
    /// Faces are cut again, as for a report: no pieces are kept with it.
    pub fn tessellation(
        &self,
        mesh: &TriMesh,
        other: &TriMesh,
        tolerance: f64,
        most: usize,
    ) -> Vec<DisplayTriangle> {
        let pair = match self.direction {
            Direction::AToB => PreparedPair::for_one_question(mesh, other),
            Direction::BToA => PreparedPair::for_one_question(other, mesh),
        };
        self.tessellation_of(&pair, tolerance, most, &Limits::default())
    }

    /// The same of the prepared pair that was measured, whose trees are used again. Time and memory of the limits are kept, and
    /// cancelling ends it: faces that are not looked at then stay whole, with the error that follows from the enclosures of their
    /// distances.
    pub fn tessellation_of(
        &self,
        pair: &PreparedPair<'_>,
        tolerance: f64,
        most: usize,
        limits: &Limits,
    ) -> Vec<DisplayTriangle> {
        let control = Control::start(limits);
        let (mesh, other) = (pair.measured(self.direction), pair.other(self.direction));
        let (frame, _, rounding) = frame_of(mesh, other);
        control.check_memory(bytes_to_start(mesh, other));
        let Some(target) = pair.target_unless_stopped(self.direction, frame, &control) else {
            return self.whole_faces(mesh);
        };
        let order = morton_order(mesh, &Aabb::of_faces(mesh));
        let Some(vertices) = pair.vertices(self.direction, &order, &target, &control) else {
            return self.whole_faces(mesh);
        };
        let largest = frame.length_in(self.distance.distance.upper()).next_up();
        let neighbours = target.neighbours_in(other);
        let tolerance = frame.length_in(tolerance);
        let faces = Faces {
            mesh,
            frame: &frame,
            vertices: &vertices,
            bvh: target.bvh(),
            neighbours: Some(neighbours),
            rounding,
            control: &control,
            largest,
            scale: tolerance,
            packed: false,
            signs: None,
            idle: Mutex::default(),
        };
        let criterion = Criterion::of_width(WIDTH * tolerance + 4.0 * rounding.bound(0));
        // First all faces whole, and into how many triangles they would be cut; then those that are.
        let mut whole: Vec<(DisplayTriangle, u32)> = Vec::with_capacity(order.len());
        let tasks: Vec<Vec<(DisplayTriangle, u32)>> = order
            .par_chunks(TASK)
            .map(|task| {
                let mut cutter = faces.cutter(true);
                let of_face = |face: &u32| {
                    if control.is_stopped() {
                        return (self.whole_face(mesh, FaceId(*face)), 1);
                    }
                    cutter.cut(&faces.start(*face).0, &criterion, MOST_PIECES);
                    let triangles =
                        cutter.pieces.iter().map(|piece| piece.polygon.outline.fan().count() as u32).sum();
                    (display_whole(&faces, &cutter, *face), triangles)
                };
                task.iter().map(of_face).collect()
            })
            .collect();
        whole.extend(tasks.into_iter().flatten());
        let mut to_cut: Vec<usize> = (0..whole.len())
            .filter(|place| frame.length_in(whole[*place].0.error) > tolerance && whole[*place].1 > 1)
            .collect();
        let by_error = |a: &usize, b: &usize| {
            whole[*b].0.error.total_cmp(&whole[*a].0.error).then(whole[*a].0.face.cmp(&whole[*b].0.face))
        };
        to_cut.sort_by(by_error);
        let mut room = most.saturating_sub(whole.len());
        to_cut.retain(|place| {
            let more = whole[*place].1 as usize - 1;
            let fits = more <= room;
            room -= if fits { more } else { 0 };
            fits
        });
        to_cut.sort_unstable();
        let mut is_cut = vec![false; whole.len()];
        for place in &to_cut {
            is_cut[*place] = true;
        }
        let parts: Vec<Vec<DisplayTriangle>> = to_cut
            .par_chunks(TASK)
            .map(|task| {
                let mut cutter = faces.cutter(true);
                let of_face = |place: &usize| {
                    let face = order[*place];
                    if control.is_stopped() {
                        return vec![self.whole_face(mesh, FaceId(face))];
                    }
                    cutter.cut(&faces.start(face).0, &criterion, MOST_PIECES);
                    display_parts(&faces, &cutter, face)
                };
                task.iter().flat_map(of_face).collect()
            })
            .collect();
        let stay = whole.into_iter().zip(is_cut).filter(|(_, cut)| !cut).map(|((triangle, _), _)| triangle);
        let mut triangles: Vec<DisplayTriangle> = stay.chain(parts.into_iter().flatten()).collect();
        triangles.sort_by_key(|triangle| triangle.face);
        triangles
    }

    /// All faces as they are, without a look at the other mesh.
    fn whole_faces(&self, mesh: &TriMesh) -> Vec<DisplayTriangle> {
        mesh.face_ids().map(|face| self.whole_face(mesh, face)).collect()
    }

    fn whole_face(&self, mesh: &TriMesh, face: FaceId) -> DisplayTriangle {
        let distances = mesh.faces()[face.index()].map(|v| self.vertices[v as usize]);
        let FaceDeviation { max, min, .. } = self.faces[face.index()];
        let error =
            distances.iter().fold(0.0, |error, d| greater(error, greater(max.upper() - d, d - min.lower())));
        DisplayTriangle { face, corners: mesh.corners(face), distances, error }
    }
}

/// Width of pieces, as a part of the tolerance: what is shown is in the middle.
const WIDTH: f64 = 1.0;

/// How far a linear function with this value at a corner of a piece may be off there: from the functions as they are, for those
/// cut off at zero or at the largest distance are not linear.
fn error_at(piece: &Piece, corner: usize, shown: f64) -> f64 {
    greater(piece.polygon.upper[corner] - shown, shown - piece.polygon.lower[corner])
}

/// The ends between which the distance at a corner of a piece lies.
fn ends(largest: f64, piece: &Piece, corner: usize) -> (f64, f64) {
    let high = lesser(piece.polygon.upper[corner], largest);
    (lesser(greater(piece.polygon.lower[corner], 0.0), high), high)
}

fn middle((low, high): (f64, f64)) -> f64 {
    0.5 * (low + high)
}

fn display_parts(faces: &Faces<'_>, cutter: &Cutter<'_>, face: u32) -> Vec<DisplayTriangle> {
    let frame = faces.frame;
    let mut triangles = Vec::new();
    for piece in &cutter.pieces {
        let Piece { polygon, .. } = piece;
        let place = |j: usize| {
            if polygon.outline.depth == 0 {
                faces.mesh.corners(FaceId(face))[j]
            } else {
                frame.unmap(cutter.point([polygon.outline.v[j], polygon.outline.w[j]]))
            }
        };
        for triangle in polygon.outline.fan() {
            let shown = triangle.map(|j| middle(ends(faces.largest, piece, j)));
            let error = (0..3).fold(0.0, |error, k| greater(error, error_at(piece, triangle[k], shown[k])));
            triangles.push(DisplayTriangle {
                face: FaceId(face),
                corners: triangle.map(place),
                distances: shown.map(|d| frame.length_out(d)),
                error: frame.length_out(error),
            });
        }
    }
    triangles
}

fn display_whole(faces: &Faces<'_>, cutter: &Cutter<'_>, face: u32) -> DisplayTriangle {
    let mut at_corner = [(0.0, f64::INFINITY); 3];
    for piece in &cutter.pieces {
        for j in 0..piece.polygon.outline.count {
            // Corners of the face are corners of pieces, digit for digit.
            let corner = match [piece.polygon.outline.v[j], piece.polygon.outline.w[j]] {
                [0.0, 0.0] => 0,
                [1.0, 0.0] => 1,
                [0.0, 1.0] => 2,
                _ => continue,
            };
            let (low, high) = ends(faces.largest, piece, j);
            let known: &mut (f64, f64) = &mut at_corner[corner];
            *known = (greater(known.0, low), lesser(known.1, high));
        }
    }
    let shown = at_corner.map(|(low, high)| middle((low, lesser(high, faces.largest))));
    let mut error = 0.0;
    for piece in &cutter.pieces {
        for j in 0..piece.polygon.outline.count {
            let [v, w] = [piece.polygon.outline.v[j], piece.polygon.outline.w[j]];
            let here = shown[0] + v * (shown[1] - shown[0]) + w * (shown[2] - shown[0]);
            error = greater(error, error_at(piece, j, here));
        }
    }
    DisplayTriangle {
        face: FaceId(face),
        corners: faces.mesh.corners(FaceId(face)),
        distances: shown.map(|d| faces.frame.length_out(d)),
        error: faces.frame.length_out(error),
    }
}
