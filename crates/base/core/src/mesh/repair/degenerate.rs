//! Faces without area.

use super::Change;
use super::parts::Parts;
use crate::mesh::topology::is_degenerate;
use rayon::prelude::*;

/// Drops faces of area zero, decided exactly.
pub(super) fn drop_faces(parts: &mut Parts) -> Change {
    let corners = |face: &[u32; 3]| face.map(|v| parts.positions[v as usize]);
    let degenerate: Vec<bool> = parts.faces.par_iter().map(|face| is_degenerate(corners(face))).collect();
    parts.keep_faces(|f| !degenerate[f])
}
