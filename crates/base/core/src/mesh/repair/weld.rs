//! Merging vertices at one position, or within a length.

use super::parts::Parts;
use super::{Change, RepairError};
use crate::mesh::first_at_position;
use std::collections::HashMap;

/// Beyond this many welding lengths from the origin, neighbouring doubles are farther apart than the welding length.
const MOST_CELLS: f64 = (1_u64 << 52) as f64;

/// Merges all vertices at one position into the first of them.
pub(super) fn equal(parts: &mut Parts) -> Change {
    let kept = first_at_position(&parts.positions);
    join(parts, &kept)
}

/// Merges each vertex into the nearest earlier vertex that was kept, if that is at most `length` away.
pub(super) fn within(parts: &mut Parts, length: f64) -> Result<Change, RepairError> {
    let largest =
        parts.positions.as_flattened().iter().fold(0.0, |m: f64, x| if x.abs() > m { x.abs() } else { m });
    if largest / length > MOST_CELLS {
        return Err(RepairError::WeldBelowRounding { length, largest });
    }
    // Kept vertices are farther apart than the side of a cell, so a cell holds only a few of them.
    let cell_of = |p: [f64; 3]| p.map(|x| (x / length).floor() as i64);
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::new();
    let mut kept: Vec<u32> = Vec::with_capacity(parts.positions.len());
    for (v, &position) in (0..).zip(&parts.positions) {
        let cell = cell_of(position);
        let around = (0..27).map(|i| [cell[0] + i % 3 - 1, cell[1] + i / 3 % 3 - 1, cell[2] + i / 9 - 1]);
        let near = around.filter_map(|cell| cells.get(&cell)).flatten();
        let nearest = near
            .map(|&other| (distance(position, parts.positions[other as usize]), other))
            .filter(|(distance, _)| *distance <= length)
            .min_by(|a, b| f64::total_cmp(&a.0, &b.0).then(a.1.cmp(&b.1)));
        kept.push(nearest.map_or(v, |(_, other)| other));
        if nearest.is_none() {
            cells.entry(cell).or_default().push(v);
        }
    }
    Ok(join(parts, &kept))
}

/// Distance of two points, scaled by the largest difference so that squares neither overflow nor underflow.
fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let scale = d.iter().fold(0.0, |m: f64, x| if x.abs() > m { x.abs() } else { m });
    if scale == 0.0 {
        return 0.0;
    }
    let [x, y, z] = d.map(|x| x / scale);
    scale * (x * x + y * y + z * z).sqrt()
}

fn join(parts: &mut Parts, kept: &[u32]) -> Change {
    for v in parts.faces.iter_mut().flatten() {
        *v = kept[*v as usize];
    }
    let joined = (0..).zip(kept).filter(|&(v, kept)| v != *kept);
    Change::of(joined.map(|(v, _): (u32, _)| parts.positions[v as usize]))
}
