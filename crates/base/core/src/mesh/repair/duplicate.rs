//! Faces with the same vertices.

use super::Change;
use super::parts::Parts;

/// Drops faces with the three vertices of an earlier face, in whatever order.
pub(super) fn drop_faces(parts: &mut Parts) -> Change {
    let sorted = |mut face: [u32; 3]| {
        face.sort_unstable();
        face
    };
    let mut order: Vec<([u32; 3], u32)> = parts.faces.iter().map(|&f| sorted(f)).zip(0..).collect();
    order.sort_unstable();
    let mut keep = vec![true; order.len()];
    for pair in order.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        keep[pair[1].1 as usize] = false;
    }
    parts.keep_faces(|f| keep[f])
}
