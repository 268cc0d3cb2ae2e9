//! Where a remeshed surface is too far from the input.

use super::marked::Marked;
use super::reference::{Reference, identity};
use super::triangle::Triangle;
use super::within::Input;
use pompeiu_core::MeshError;
use pompeiu_core::spatial::bvh::{Bvh, Slot, Workspace};
use rayon::prelude::*;

/// Pieces that a face may be cut into before it counts as too far away.
const MOST_PIECES: usize = 256;

/// Faces of a task.
const TASK: usize = 256;

/// Marks the vertices of the input near which one surface is farther than `limit` from the other, as far as tests of single faces
/// can tell.
pub(super) fn far_places(
    input: &Marked,
    reference: &Reference<'_>,
    surface: &Marked,
    limit: f64,
) -> Result<Vec<bool>, MeshError> {
    let mut far = vec![false; input.mesh.positions.len()];
    let mut mark = |face: u32| input.mesh.corners(face).into_iter().for_each(|v| far[v as usize] = true);
    let limit_sq = limit * limit;
    // From the result to the input: what is nearest to the middle of a face that is too far away.
    let there = Input { bvh: &reference.bvh, limit_sq };
    let faces: Vec<(Triangle, Option<Slot>)> = (0..surface.mesh.origin.len() as u32 / 3)
        .filter(|&f| surface.mesh.exists(3 * f))
        .map(|f| surface.mesh.corners(f))
        .map(|c| (c.map(|v| surface.mesh.positions[v as usize]), Some(surface.near[c[0] as usize])))
        .collect();
    for i in far_from(&there, &faces) {
        let (triangle, start) = faces[i as usize];
        let middle = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        let start = start.unwrap_or_else(|| reference.bvh.any_slot());
        let slot = reference.bvh.nearest(middle.to_array(), start, &mut Workspace::default()).slot;
        mark(reference.bvh.face(slot).0);
    }
    // From the input to the result.
    let result = surface.mesh.to_mesh()?;
    let bvh = Bvh::build(&result, &identity());
    let back = Input { bvh: &bvh, limit_sq };
    let corners = |f: u32| input.mesh.corners(f).map(|v| input.mesh.positions[v as usize]);
    let faces: Vec<(Triangle, Option<Slot>)> =
        (0..input.mesh.face_count() as u32).map(|f| (corners(f), None)).collect();
    far_from(&back, &faces).into_iter().for_each(&mut mark);
    Ok(far)
}

/// The triangles that are not seen to be near, by index.
fn far_from(input: &Input<'_>, triangles: &[(Triangle, Option<Slot>)]) -> Vec<u32> {
    let of_task = |(task, triangles): (usize, &[(Triangle, Option<Slot>)])| {
        let mut workspace = Workspace::default();
        let mut last = input.bvh.any_slot();
        let mut far = Vec::new();
        for (i, (triangle, start)) in triangles.iter().enumerate() {
            let mut start = start.unwrap_or(last);
            if !input.is_near(*triangle, MOST_PIECES, &mut start, &mut workspace) {
                far.push((task * TASK + i) as u32);
            }
            last = start;
        }
        far
    };
    triangles.par_chunks(TASK).enumerate().flat_map_iter(of_task).collect()
}
