//! Between which ends the mean distance lies while faces are being cut: of those that are not cut yet from the distances of their corners.
//!
//! # What is proven
//! Below, the distance on a face is that of [`corners`], or zero where the face is too near for its size. Above, the distance from the face of B
//! that is nearest to one corner is convex, so its mean is no greater than that of the corners, and no distance is greater than the largest.
//! Sums are rounded outwards as those of pieces are.

use super::corners;
use super::entry::{LESS, MORE, Moments, Sum};
use super::linear::{greater, lesser};
use super::task::Faces;
use rayon::prelude::*;

/// What is known of the faces that are left after each round: area and area times distance.
pub(super) struct Rough {
    left: Vec<[Sum; 2]>,
}

impl Rough {
    /// Of rounds of so many faces.
    pub(super) fn new(faces: &Faces<'_>, order: &[u32], round: usize) -> Self {
        let of_round = |round: &[u32]| {
            let mut sums = [Sum::default(); 2];
            for face in round {
                include(faces, *face, &mut sums);
            }
            sums
        };
        let mut left: Vec<[Sum; 2]> = order.par_chunks(round.max(1)).map(of_round).collect();
        left.push([Sum::default(); 2]);
        for i in (1..left.len()).rev() {
            let after = left[i];
            left[i - 1] = [left[i - 1][0].plus(after[0]), left[i - 1][1].plus(after[1])];
        }
        Self { left }
    }

    /// Encloses the mean, given what was summed up in so many rounds; none where the area may be zero.
    pub(super) fn mean(&self, rounds: usize, done: Moments, largest: f64) -> Option<(f64, f64)> {
        let [area, first] = self.left.get(rounds)?;
        let area = done.area.plus(*area).enclosure();
        if area.lower() <= 0.0 {
            return None;
        }
        let mean = done.first.plus(*first).enclosure().divide_by_positive(area);
        let high = lesser(mean.upper(), largest);
        Some((lesser(greater(mean.lower(), 0.0), high), high))
    }
}

fn include(faces: &Faces<'_>, face: u32, [area, first]: &mut [Sum; 2]) {
    let (start, (low, high)) = faces.start(face);
    // What computed distances, and the function below, may be off by.
    let margin = 2.0 * faces.rounding.bound(0);
    let below = corners::below(start.corners, start.distances, margin);
    let below = below.map_or(0.0, |[x, y, z]| greater((x + y + z) * (1.0 / 3.0) * LESS, 0.0));
    let near = start.near[0];
    let [x, y, z] = start.corners.map(|p| faces.bvh.distance_sq(p, near).sqrt() + margin);
    let above = lesser((x + y + z) * (1.0 / 3.0) * MORE, faces.largest);
    area.add(low, high);
    first.add(low * below * LESS, high * above * MORE);
}
