//! What a search has left of a mesh at coarser tolerances.

use crate::{HausdorffOptions, Observer, Stage};
use pompeiu_core::TriMesh;
use std::sync::{Mutex, PoisonError};

/// The tolerances, fractions of the joint diagonal: half a power of ten apart.
const TOLERANCES: [f64; 9] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6];

/// Pieces that a stage may have to be kept: more are no help to the eye, and make pages long.
const MOST_PIECES: usize = 150_000;

struct Stages(Mutex<Vec<Stage>>);

impl Observer for Stages {
    fn stage(&self, stage: &Stage) {
        if stage.remaining.len() <= MOST_PIECES && stage.fraction >= TOLERANCES[TOLERANCES.len() - 1] {
            self.0.lock().unwrap_or_else(PoisonError::into_inner).push(stage.clone());
        }
    }
}

/// Searches both directed distances and gives what could not yet be discarded at each of some tolerances, from a tenth to
/// a millionth of the joint diagonal; stages with more pieces than anyone can see are left out.
#[allow(clippy::missing_panics_doc, reason = "the tolerances are constants that descend")]
pub fn search_stages(a: &TriMesh, b: &TriMesh) -> Vec<Stage> {
    let stages = Stages(Mutex::new(Vec::new()));
    let options = HausdorffOptions {
        stages: TOLERANCES.to_vec(),
        observer: Some(&stages),
        ..HausdorffOptions::default()
    };
    options.symmetric(a, b).expect("the tolerances descend");
    stages.0.into_inner().unwrap_or_else(PoisonError::into_inner)
}
