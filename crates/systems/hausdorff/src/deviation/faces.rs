//! Distances face by face.

use super::bounds::FaceBounds;
use super::linear::{greater, lesser};
use super::report::FaceDeviation;
use super::statistics::length_out;
use pompeiu_core::geom::Frame;
use rayon::prelude::*;

/// The enclosures of each face.
pub(super) fn faces(frame: &Frame, bounds: &[FaceBounds]) -> Vec<FaceDeviation> {
    let out = |(low, high): (f64, f64)| length_out(frame, greater(lesser(low, high), 0.0), high);
    let of_face = |FaceBounds { max, min, mean, .. }: &FaceBounds| {
        // The search for the largest distance on a face knows better than its pieces what no distance exceeds.
        let at_most = |(low, high): (f64, f64)| (low, lesser(high, max.upper));
        FaceDeviation { max: out((max.lower, max.upper)), min: out(at_most(*min)), mean: out(at_most(*mean)) }
    };
    bounds.par_iter().map(of_face).collect()
}
