//! What a search has left of a mesh at coarser tolerances.

use crate::{Direction, HausdorffOptions, Observer, PreparedPair, Progress, Stage, Tolerance};
use pompeiu_core::run::Limits;
use std::ops::ControlFlow;
use std::sync::{Mutex, PoisonError};

/// The tolerances, fractions of the joint diagonal: half a power of ten apart.
const TOLERANCES: [f64; 9] = [1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6];

/// Pieces that a stage may have to be kept, and that all stages of a direction may have together: more are no help to the eye, and make
/// pages long.
const MOST_PIECES: usize = 4_000;
const MOST_OF_ALL: usize = 8_000;

/// Faces of both meshes at most: of more there are more pieces than anyone can see until the last stages, and the search costs more than
/// the page is worth.
const MOST_FACES: usize = 20_000;

/// A search ends short of the finest stage.
const FINEST: f64 = 0.9 * TOLERANCES[TOLERANCES.len() - 1];

/// Pieces that are looked at in a direction, for each face and beside that: a search that takes more shows stages that many pieces are left
/// at, and costs more than the page is worth.
const LOOKS_PER_FACE: u64 = 2;
const LOOKS: u64 = 50_000;

struct Stages {
    found: Mutex<Vec<Stage>>,
    /// Pieces to look at, from A and from B.
    looks: [u64; 2],
}

impl Stages {
    fn has_room(stages: &[Stage], stage: &Stage) -> bool {
        let same = stages.iter().filter(|other| other.direction == stage.direction);
        same.map(|other| other.remaining.len()).sum::<usize>() + stage.remaining.len() <= MOST_OF_ALL
    }
}

impl Observer for Stages {
    fn progress(&self, progress: &Progress) -> ControlFlow<()> {
        let most = self.looks[usize::from(progress.direction == Direction::BToA)];
        if progress.examined > most { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }

    fn stage(&self, stage: &Stage) {
        if stage.remaining.len() <= MOST_PIECES && stage.fraction >= TOLERANCES[TOLERANCES.len() - 1] {
            let mut stages = self.found.lock().unwrap_or_else(PoisonError::into_inner);
            if Self::has_room(&stages, stage) {
                stages.push(stage.clone());
            }
        }
    }
}

/// Searches both directed distances of a pair, with the trees that it has, and gives what could not yet be discarded at each of some
/// tolerances, from a tenth to a millionth of the joint diagonal; stages with more pieces than anyone can see are left out, and so are
/// all of meshes of more than 20,000 faces together and of pairs with parts, for the search is that of whole meshes. Limits, and many pieces to look at, end the search with the stages that were reached.
pub fn search_stages(pair: &PreparedPair<'_>, limits: &Limits) -> Vec<Stage> {
    if pair.parts().is_some() || pair.a().faces().len() + pair.b().faces().len() > MOST_FACES {
        return Vec::new();
    }
    let looks = [pair.a(), pair.b()].map(|mesh| LOOKS_PER_FACE * mesh.faces().len() as u64 + LOOKS);
    let stages = Stages { found: Mutex::default(), looks };
    let options = HausdorffOptions {
        tolerance: Tolerance::RelativeToDiagonal(FINEST),
        stages: TOLERANCES.to_vec(),
        observer: Some(&stages),
        limits: limits.clone(),
        ..HausdorffOptions::default()
    };
    // The tolerances descend: nothing is refused.
    let _ = options.symmetric_of(pair);
    stages.found.into_inner().unwrap_or_else(PoisonError::into_inner)
}
