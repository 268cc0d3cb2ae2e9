//! Which faces to cut again.

use super::criterion::Criterion;
use super::distribution::Distribution;
use super::linear::{greatest, least, lesser};
use super::portion::Portion;
use rayon::prelude::*;

/// What cutting a face again removes of its areas times widths, at least as a rule; and how far below the allowed width a mean should
/// come to lie.
const LEAST_GAIN: f64 = 0.5;
const SPARE: f64 = 0.9;
/// The part of the areas times widths in focus that pieces to be cut have, at most.
const MOST_OF_FOCUS: f64 = 0.9;

/// Which faces have a piece that does not satisfy a criterion, in their order.
pub(super) fn flag(criterion: &Criterion, distribution: &Distribution) -> Vec<bool> {
    let of_face = |portion: &Portion, face: usize| {
        portion.of_face(face).any(|entry| {
            let mass = entry.mass();
            let wide = || {
                let is_met = || criterion.is_met(mass, least(entry.lower()), greatest(entry.upper()));
                entry.most_width() > criterion.floor && !is_met()
            };
            mass > 0.0 && wide()
        })
    };
    let of_portion = |portion: &Portion| -> Vec<bool> {
        (0..portion.starts.len() - 1).map(|face| of_face(portion, face)).collect()
    };
    let flags: Vec<Vec<bool>> = distribution.portions.par_iter().map(of_portion).collect();
    flags.into_iter().flatten().collect()
}

/// Of the flagged faces leaves those with the greatest areas times widths flagged, so many that cutting them should be enough:
/// `excess` is how many times too wide a mean is.
pub(super) fn keep_the_worst(flagged: &mut [bool], excess: f64, distribution: &Distribution) {
    let of_portion = |portion: &Portion| -> Vec<f64> {
        let mass = |face: usize| portion.of_face(face).map(|entry| entry.mass()).sum();
        (0..portion.starts.len() - 1).map(mass).collect()
    };
    let masses: Vec<Vec<f64>> = distribution.portions.par_iter().map(of_portion).collect();
    let masses: Vec<f64> = masses.into_iter().flatten().collect();
    let total: f64 = masses.iter().sum();
    let mut left = total * (1.0 - SPARE / excess) / LEAST_GAIN;
    let mut worst: Vec<usize> = (0..flagged.len()).filter(|face| flagged[*face]).collect();
    worst.sort_by(|a, b| masses[*b].total_cmp(&masses[*a]).then(a.cmp(b)));
    for face in worst {
        flagged[face] = left > 0.0;
        left -= masses[face];
    }
}

/// Whether cutting the pieces that do not satisfy a criterion should be enough for percentiles which are `excess` times too wide: whether
/// they have most of the areas times widths in its focus.
pub(super) fn suffices(criterion: &Criterion, excess: f64, distribution: &Distribution) -> bool {
    let of_portion = |portion: &Portion| {
        let (mut inside, mut unmet) = (0.0, 0.0);
        for entry in portion.entries.iter() {
            let (low, high) = (least(entry.lower()), greatest(entry.upper()));
            if criterion.is_in_focus(low, high) {
                let mass = entry.mass();
                inside += mass;
                unmet += if criterion.is_met(mass, low, high) { 0.0 } else { mass };
            }
        }
        (inside, unmet)
    };
    let sums: Vec<(f64, f64)> = distribution.portions.par_iter().map(of_portion).collect();
    let (inside, unmet) = sums.into_iter().fold((0.0, 0.0), |a, b| (a.0 + b.0, a.1 + b.1));
    unmet >= lesser((1.0 - SPARE / excess) / LEAST_GAIN, MOST_OF_FOCUS) * inside
}
