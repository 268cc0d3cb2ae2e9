//! Flipped faces.

use super::orientation;
use pompeiu_core::FaceId;
use pompeiu_surface::plane::Vec2;
use rayon::prelude::*;

/// The faces whose corners are not counter-clockwise, including degenerate ones, in order.
pub(crate) fn flipped_faces(faces: &[[u32; 3]], uv: &[Vec2]) -> Vec<FaceId> {
    let is_flipped = |face: &[u32; 3]| {
        let [a, b, c] = face.map(|v| uv[v as usize]);
        // Not positive; this includes NaN.
        !matches!(orientation(a, b, c).partial_cmp(&0.0), Some(std::cmp::Ordering::Greater))
    };
    faces.par_iter().enumerate().filter(|(_, face)| is_flipped(face)).map(|(f, _)| FaceId(f as u32)).collect()
}
