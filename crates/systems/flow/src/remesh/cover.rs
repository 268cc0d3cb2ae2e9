//! Which faces of the result lie near which faces of the input.

use super::connectivity::DynamicMesh;
use super::within::{Triangle, is_covered};
use pompeiu_core::spatial::bvh::{Bvh, Slot};
use rayon::prelude::*;

/// Faces of the input at which tests are done in parallel.
const PARALLEL_FROM: usize = 256;

/// For each face of the input, faces of the result that together come within the distance of all of its points.
pub(crate) struct Cover {
    input: Vec<Triangle>,
    /// The faces of the result that cover each face of the input.
    witnesses: Vec<Vec<u32>>,
    /// The faces of the input that each face of the result covers, alone or with others.
    covers: Vec<Vec<u32>>,
    /// Where each face of the input is in the tree.
    slots: Vec<Slot>,
}

/// The faces of the input that a collapse affects, each with the faces that would cover it.
pub(crate) struct Covering(Vec<(u32, Vec<u32>)>);

impl Cover {
    /// Each face covers itself.
    pub(crate) fn new(mesh: &DynamicMesh, bvh: &Bvh) -> Self {
        let faces = mesh.face_count() as u32;
        let triangle = |f| mesh.corners(f).map(|v| mesh.positions[v as usize]);
        let itself: Vec<Vec<u32>> = (0..faces).map(|f| vec![f]).collect();
        let mut slots = vec![bvh.any_slot(); faces as usize];
        for slot in bvh.slots() {
            slots[bvh.face(slot).index()] = slot;
        }
        Self { input: (0..faces).map(triangle).collect(), witnesses: itself.clone(), covers: itself, slots }
    }

    /// Where a search for what is near a face of the result may start.
    pub(crate) fn start_near(&self, face: u32) -> Slot {
        self.slots[self.covers[face as usize].first().map_or(0, |&f| f as usize)]
    }

    /// How many faces of the input a face of the result covers, alone or with others.
    pub(crate) fn covered_by(&self, face: u32) -> usize {
        self.covers[face as usize].len()
    }

    /// Covers anew what the faces `gone` covered: by the faces `kept`, which would become `faces`, and by others as they are.
    /// None if something is left uncovered.
    pub(crate) fn cover_anew(
        &self,
        mesh: &DynamicMesh,
        gone: &[u32],
        kept: &[u32],
        faces: &[Triangle],
        limit_sq: f64,
    ) -> Option<Covering> {
        let mut affected: Vec<u32> = gone.iter().flat_map(|&f| &self.covers[f as usize]).copied().collect();
        affected.sort_unstable();
        affected.dedup();
        let anew = |&f: &u32| -> Option<(u32, Vec<u32>)> {
            let others = self.witnesses[f as usize].iter().copied().filter(|g| !gone.contains(g));
            let names: Vec<u32> = others.chain(kept.iter().copied()).collect();
            let beyond = names.len() - kept.len();
            let triangles: Vec<Triangle> = names[..beyond]
                .iter()
                .map(|&g| mesh.corners(g).map(|v| mesh.positions[v as usize]))
                .chain(faces.iter().copied())
                .collect();
            let mut used = vec![false; names.len()];
            is_covered(&self.input[f as usize], &triangles, limit_sq, &mut used)
                .then(|| (f, names.into_iter().zip(used).filter(|(_, used)| *used).map(|(g, _)| g).collect()))
        };
        let covering: Option<Vec<_>> = if affected.len() < PARALLEL_FROM {
            affected.iter().map(anew).collect()
        } else {
            affected.par_iter().map(anew).collect()
        };
        covering.map(Covering)
    }

    /// Takes over what [`Cover::cover_anew`] found.
    pub(crate) fn replace(&mut self, gone: &[u32], covering: Covering) {
        for &f in gone {
            self.covers[f as usize].clear();
        }
        for (f, by) in covering.0 {
            for &old in &self.witnesses[f as usize] {
                if !gone.contains(&old) && !by.contains(&old) {
                    self.covers[old as usize].retain(|g| *g != f);
                }
            }
            for &new in &by {
                if gone.contains(&new) || !self.witnesses[f as usize].contains(&new) {
                    self.covers[new as usize].push(f);
                }
            }
            self.witnesses[f as usize] = by;
        }
    }
}
