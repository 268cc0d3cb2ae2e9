//! The greatest distance of the points of patches, enclosed by dividing them.

use pompeiu_core::run::Control;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Width at which an enclosure is good enough, in radii.
const WIDTH: f64 = 0.02;

/// The same, as a share of a distance above what is tolerated.
const RELATIVE_WIDTH: f64 = 0.05;

/// Most divisions of a patch along each direction.
const MOST_LEVELS: usize = 14;

/// Patches that are divided together.
const BATCH: usize = 4096;

/// Most patches that are evaluated, for each one in the beginning.
const MOST_PER_PATCH: usize = 3000;

/// What is known of the distances of the points of a patch: in micrometres, and in radii.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    /// No point has a greater one.
    pub(super) upper: [f64; 2],
    /// A point has at least this one.
    pub(super) lower: [f64; 2],
    /// The sample next to that point.
    pub(super) sample: usize,
}

/// A part of a surface.
pub(super) trait Patch: Sized + Send + Sync {
    /// Parts that cover it.
    fn divided(&self) -> [Self; 4];
}

/// The greatest distance, enclosed.
#[derive(Default)]
pub(super) struct Enclosure {
    pub(super) lower: [f64; 2],
    pub(super) upper: [f64; 2],
    /// The sample next to the point with the greatest distance in radii.
    pub(super) sample: usize,
    /// Samples next to points that are farther away than is tolerated, with the greatest such distance.
    pub(super) beyond: BTreeMap<usize, [f64; 2]>,
}

impl Enclosure {
    fn add(&mut self, bounds: &Bounds, within: f64) {
        self.lower[0] = self.lower[0].max(bounds.lower[0]);
        if bounds.lower[1] > self.lower[1] {
            self.lower[1] = bounds.lower[1];
            self.sample = bounds.sample;
        }
        if bounds.lower[1] > within {
            let most = self.beyond.entry(bounds.sample).or_insert(bounds.lower);
            if bounds.lower[1] > most[1] {
                *most = bounds.lower;
            }
        }
    }

    /// Whether a patch has to be divided to narrow the enclosure, or to decide whether distances are tolerated.
    fn is_open(&self, bounds: &Bounds, within: f64) -> bool {
        let width = if self.lower[1] > within { (RELATIVE_WIDTH * self.lower[1]).max(WIDTH) } else { WIDTH };
        // The width in micrometres is that of the radius of this patch.
        let radius = bounds.upper[0] / bounds.upper[1];
        let decides = self.lower[1] <= within && bounds.upper[1] > within;
        decides
            || bounds.upper[1] > self.lower[1] + width
            || bounds.upper[0] > self.lower[0] + width * radius.max(0.0)
    }
}

/// Encloses the greatest distance of the points of patches. `evaluate` bounds those of one patch; `None` if it is not part of the
/// surface. When the computation is stopped, or after too many patches, the enclosure is as wide as it is then.
///
/// The result does not depend on the number of threads.
pub(super) fn enclose<P: Patch>(
    patches: Vec<P>,
    within: f64,
    control: &Control,
    evaluate: impl Fn(&P) -> Option<Bounds> + Sync,
) -> Enclosure {
    let mut found = Enclosure::default();
    let mut left = patches.len().saturating_mul(MOST_PER_PATCH);
    let mut patches = patches.into_iter().peekable();
    while patches.peek().is_some() {
        let mut active: Vec<P> = patches.by_ref().take(BATCH).collect();
        for level in 0..=MOST_LEVELS {
            let bounds: Vec<Option<Bounds>> = active.par_iter().map(&evaluate).collect();
            left = left.saturating_sub(active.len());
            bounds.iter().flatten().for_each(|bounds| found.add(bounds, within));
            let is_last = level == MOST_LEVELS || left == 0 || control.is_stopped();
            let mut divided = Vec::new();
            for (patch, bounds) in active.iter().zip(&bounds) {
                let Some(bounds) = bounds else { continue };
                if !is_last && found.is_open(bounds, within) {
                    divided.push(patch);
                } else {
                    found.upper = [0, 1].map(|k| found.upper[k].max(bounds.upper[k]));
                }
            }
            active = divided.par_iter().flat_map_iter(|patch| patch.divided()).collect();
            if active.is_empty() {
                break;
            }
        }
    }
    found
}
