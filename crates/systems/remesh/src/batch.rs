//! Moving many vertices at once, and putting back those beside which the surface leaves a distance of the input.
//!
//! Each face of the surface is tested once instead of once for each of its corners, and each face of the input once. Where a face of
//! the surface is too far away its corners go back. Where one of the input is, those of the faces go back that covered it before: once all
//! have, they cover it again, so this ends, at the latest with the surface as it was.

use super::candidates::Candidates;
use super::connectivity::DynamicMesh;
use super::cover::{Cover, WitnessLists};
use super::marked::Marked;
use super::smooth::Move;
use super::triangle::keeps_normal;
use super::within::{Input, is_covered};
use glam::DVec3;
use pompeiu_core::MeshError;
use pompeiu_core::spatial::bvh::{Slot, Workspace};
use rayon::prelude::*;

/// Pieces of a new face that are looked at before it counts as too far away.
pub(super) const MOST_PIECES: usize = 128;

/// Faces of the surface that are looked at for one of the input, at most.
const MOST_CANDIDATES: usize = 64;

/// Faces of a task.
const TASK: usize = 256;

/// A surface while some of its vertices are at new positions, which may yet be taken back.
struct Batch<'b> {
    surface: &'b mut Marked,
    input: &'b Input<'b>,
    before: Vec<DVec3>,
    /// Whether each vertex is at a new position.
    moved: Vec<bool>,
}

impl Batch<'_> {
    fn is_changed(&self, f: u32) -> bool {
        self.surface.mesh.corners(f).into_iter().any(|v| self.moved[v as usize])
    }

    /// The faces that turned over or are too far away now.
    fn bad(&self, faces: &[u32]) -> Vec<u32> {
        let of_task = |faces: &[u32]| {
            let mut workspace = Workspace::default();
            let is_bad = |f: &u32| {
                let corners = self.surface.mesh.corners(*f);
                let old = corners.map(|v| self.before[v as usize]);
                let new = self.surface.triangle(*f);
                let mut start: Slot = self.surface.near[corners[0] as usize];
                !keeps_normal(old, new) || !self.input.is_near(new, MOST_PIECES, &mut start, &mut workspace)
            };
            faces.iter().copied().filter(is_bad).collect::<Vec<u32>>()
        };
        faces.par_chunks(TASK).flat_map_iter(of_task).collect()
    }

    /// Puts a vertex back; notes the faces around it if it had moved.
    fn put_back(&mut self, v: u32, touched: &mut [bool]) {
        if std::mem::replace(&mut self.moved[v as usize], false) {
            self.surface.mesh.positions[v as usize] = self.before[v as usize];
            self.surface.mesh.halfedges_from(v).for_each(|h| touched[(h / 3) as usize] = true);
        }
    }

    /// The faces that cover one of the input now, among those that did before and those found last; none if they do not.
    fn covered_again(&self, cover: &Cover, f: u32, found: &[u32]) -> Vec<u32> {
        let old = cover.witnesses(f);
        if !old.iter().any(|&g| self.is_changed(g)) {
            return old.to_vec();
        }
        let mut names: Vec<u32> = found.iter().chain(old).copied().collect();
        names.sort_unstable();
        names.dedup();
        names.truncate(MOST_CANDIDATES);
        let mut candidates = Candidates::default();
        candidates.set(names.iter().map(|&g| self.surface.triangle(g)));
        let mut used = 0;
        let limit_sq = self.input.limit_sq;
        if is_covered(&cover.triangle(f), &candidates, limit_sq, &mut used) {
            names.iter().enumerate().filter(|(i, _)| used >> i & 1 == 1).map(|(_, &g)| g).collect()
        } else {
            Vec::new()
        }
    }
}

/// Moves vertices as far as the surface stays within the distance; says which moved.
pub(super) fn move_all(
    surface: &mut Marked,
    input: &Input<'_>,
    cover: &mut Cover,
    moves: &[Option<Move>],
) -> Result<Vec<bool>, MeshError> {
    let before = surface.mesh.positions.clone();
    let moved: Vec<bool> = moves.iter().map(Option::is_some).collect();
    for (position, to) in surface.mesh.positions.iter_mut().zip(moves) {
        *position = to.map_or(*position, |to| to.position);
    }
    let mut batch = Batch { surface, input, before, moved };
    let slots = batch.surface.mesh.origin.len() as u32 / 3;
    let exists = |mesh: &DynamicMesh, f: u32| mesh.exists(3 * f);
    let changed: Vec<u32> =
        (0..slots).filter(|&f| exists(&batch.surface.mesh, f) && batch.is_changed(f)).collect();
    let affected = cover.affected_by(&changed);
    let mut found = WitnessLists {
        witnesses: cover.found_on(&batch.surface.mesh, &affected, input.limit_sq)?,
        faces: affected,
    };
    let mut bad = batch.bad(&changed);
    loop {
        let mut touched = vec![false; slots as usize];
        for f in bad {
            batch.surface.mesh.corners(f).into_iter().for_each(|v| batch.put_back(v, &mut touched));
        }
        let uncovered = found.each().filter(|(_, by)| by.is_empty()).map(|(f, _)| f);
        for g in uncovered.flat_map(|f| cover.witnesses(f)) {
            batch.surface.mesh.corners(*g).into_iter().for_each(|v| batch.put_back(v, &mut touched));
        }
        let of_task = |(f, by): (&u32, &mut Vec<u32>)| {
            if by.is_empty() || by.iter().any(|&g| touched[g as usize]) {
                *by = batch.covered_again(cover, *f, by);
            }
        };
        found.faces.par_iter().zip(&mut found.witnesses).for_each(of_task);
        let again: Vec<u32> = (0..slots).filter(|&f| touched[f as usize] && batch.is_changed(f)).collect();
        bad = batch.bad(&again);
        if bad.is_empty() && found.each().all(|(_, by)| !by.is_empty()) {
            break;
        }
    }
    let moved = batch.moved;
    cover.take_over(found);
    for (v, to) in moves.iter().enumerate() {
        if let Some(to) = to.filter(|_| moved[v]) {
            (surface.near[v], surface.length[v]) = (to.near, to.length);
        }
    }
    Ok(moved)
}

#[cfg(test)]
mod tests {
    use super::super::features::{Curves, Features};
    use super::super::reference::identity;
    use super::*;
    use pompeiu_core::mesh::shapes::{Diagonal, grid};
    use pompeiu_core::spatial::bvh::Bvh;

    #[test]
    fn moves_that_stay_near_are_made_and_others_taken_back() {
        let plane = grid([10.0, 10.0], [10, 10], Diagonal::Rising).expect("a grid");
        let mesh = DynamicMesh::new(plane.positions(), plane.faces()).expect("a manifold");
        let curves = Curves::find(&mesh, &Features::default());
        let tree = Bvh::build(&plane, &identity());
        let count = mesh.positions.len();
        let mut surface = Marked {
            curve: curves.of_halfedge,
            hold: curves.hold,
            length: vec![1.0; count],
            near: vec![tree.any_slot(); count],
            mesh,
        };
        let mut cover = Cover::new(&surface.mesh, &tree);
        let input = Input { bvh: &tree, limit_sq: 0.01 };
        let free: Vec<u32> = (0..count as u32)
            .filter(|&v| surface.hold[v as usize] == super::super::marked::Hold::Free)
            .collect();
        let mut moves = vec![None; count];
        for &v in &free {
            // Within the plane, and up to twice the distance above it.
            let up = if v % 7 == 0 { 0.2 } else { 0.05 };
            let position = surface.mesh.positions[v as usize] + DVec3::new(0.2, 0.1, up);
            moves[v as usize] = Some(Move { position, near: tree.any_slot(), length: 1.0 });
        }
        let before = surface.mesh.positions.clone();
        let moved = move_all(&mut surface, &input, &mut cover, &moves).expect("a mesh");
        let made = moved.iter().filter(|moved| **moved).count();
        assert!(made > 10 && made < free.len(), "{made} of {}", free.len());
        for (v, p) in surface.mesh.positions.iter().enumerate() {
            assert_eq!(*p, moves[v].filter(|_| moved[v]).map_or(before[v], |to| to.position));
            assert!(p.z <= 0.1);
        }
        // The input is still covered.
        assert!(
            Cover::of(
                &surface.mesh,
                &DynamicMesh::new(plane.positions(), plane.faces()).expect("a manifold"),
                &tree,
                0.1
            )
            .is_ok_and(|cover| cover.is_some())
        );
        for f in 0..plane.faces().len() as u32 {
            assert!(!cover.witnesses(f).is_empty());
        }
    }
}
