//! What a search has left of a mesh at coarser tolerances.

use crate::{Observer, Query, Stage};
use pompeiu_core::TriMesh;

/// The tolerances, fractions of the joint diagonal: half a power of ten apart.
const TOLERANCES: [f64; 9] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6];

/// Pieces that a stage may have to be kept: more are no help to the eye, and make pages long.
const MOST_PIECES: usize = 150_000;

struct Stages(Vec<Stage>);

impl Observer for Stages {
    fn stage(&mut self, stage: &Stage) {
        if stage.remaining.len() <= MOST_PIECES && stage.fraction >= TOLERANCES[TOLERANCES.len() - 1] {
            self.0.push(stage.clone());
        }
    }
}

/// Searches both directed distances and gives what could not yet be discarded at each of some tolerances, from a tenth to
/// a millionth of the joint diagonal; stages with more pieces than anyone can see are left out.
#[allow(clippy::missing_panics_doc, reason = "the tolerances are constants that descend")]
pub fn search_stages(a: &TriMesh, b: &TriMesh) -> Vec<Stage> {
    let mut stages = Stages(Vec::new());
    let query = Query::new().stages(&TOLERANCES).expect("the tolerances descend");
    query.symmetric_observed(a, b, &mut stages);
    stages.0
}
