//! Triangles to draw: faces where linear interpolation shows the deviation well enough, their pieces elsewhere.

use super::envelope::Piece;
use super::linear::{greater, lesser};
use super::report::{DirectedDeviation, Field};
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;

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

impl DirectedDeviation {
    /// Triangles that show the deviation within a tolerance, in the order of the faces: a face is itself where linear interpolation
    /// of the distances at its corners does, else its pieces. `mesh` must be the one that was measured.
    ///
    /// At most `most` triangles, or as many as the mesh has faces if that is more: the faces that need their pieces most come
    /// first, and the others stay whole, with a greater error. Pieces of neighbouring faces do not share corners.
    pub fn tessellation(&self, mesh: &TriMesh, tolerance: f64, most: usize) -> Vec<DisplayTriangle> {
        let field = &self.field;
        let tolerance = field.frame.length_in(tolerance);
        let faces = mesh.faces().len().min(field.areas.len());
        let whole: Vec<DisplayTriangle> = (0..faces).into_par_iter().map(|f| whole(field, mesh, f)).collect();
        let mut needy: Vec<usize> = (0..faces)
            .filter(|f| field.frame.length_in(whole[*f].error) > tolerance && field.of_face(*f).len() > 1)
            .collect();
        needy.sort_by(|a, b| whole[*b].error.total_cmp(&whole[*a].error).then(a.cmp(b)));
        let mut cut = vec![false; faces];
        let mut room = most.saturating_sub(faces);
        for f in needy {
            let more = field.of_face(f).len() - 1;
            if more <= room {
                room -= more;
                cut[f] = true;
            }
        }
        let mut triangles = Vec::with_capacity(faces);
        for f in 0..faces {
            if cut[f] {
                triangles.extend(field.of_face(f).iter().map(|piece| part(field, piece)));
            } else {
                triangles.push(whole[f]);
            }
        }
        triangles
    }
}

/// How far a linear function with this value at a corner of a piece may be off there: from the functions as they are, for those
/// cut off at zero or at the largest distance are not linear.
fn error_at(piece: &Piece, corner: usize, shown: f64) -> f64 {
    greater(piece.upper[corner] - shown, shown - piece.lower[corner])
}

/// The ends between which the distance at a corner of a piece lies.
fn ends(field: &Field, piece: &Piece, corner: usize) -> (f64, f64) {
    let high = lesser(piece.upper[corner], field.largest);
    (lesser(greater(piece.lower[corner], 0.0), high), high)
}

fn middle((low, high): (f64, f64)) -> f64 {
    0.5 * (low + high)
}

fn part(field: &Field, piece: &Piece) -> DisplayTriangle {
    let shown = [0, 1, 2].map(|j| middle(ends(field, piece, j)));
    let error = (0..3).fold(0.0, |error, j| greater(error, error_at(piece, j, shown[j])));
    DisplayTriangle {
        face: FaceId(piece.face),
        corners: piece.corners.map(|p| field.frame.unmap(p)),
        distances: shown.map(|d| field.frame.length_out(d)),
        error: field.frame.length_out(error),
    }
}

fn whole(field: &Field, mesh: &TriMesh, f: usize) -> DisplayTriangle {
    let face = FaceId(f as u32);
    let corners = mesh.corners(face);
    let mapped = corners.map(|p| field.frame.map(p));
    let pieces = field.of_face(f);
    // Corners of the face are corners of pieces, bit for bit.
    let at_corner = mapped.map(|p| {
        let mut ends_here = (0.0, f64::INFINITY);
        for piece in pieces {
            for j in 0..3 {
                if piece.corners[j] == p {
                    let (low, high) = ends(field, piece, j);
                    ends_here = (greater(ends_here.0, low), lesser(ends_here.1, high));
                }
            }
        }
        middle((ends_here.0, lesser(ends_here.1, field.largest)))
    });
    let mut error = 0.0;
    for piece in pieces {
        for j in 0..3 {
            let beta = closest_barycentric(piece.corners[j], mapped);
            let shown = beta[0] * at_corner[0] + beta[1] * at_corner[1] + beta[2] * at_corner[2];
            error = greater(error, error_at(piece, j, shown));
        }
    }
    DisplayTriangle {
        face,
        corners,
        distances: at_corner.map(|d| field.frame.length_out(d)),
        error: field.frame.length_out(error),
    }
}
