//! Distances face by face.

use super::linear::{greater, lesser};
use super::maxima::Maximum;
use super::refine::FaceBounds;
use super::report::FaceDeviation;
use super::statistics::length_out;
use pompeiu_core::geom::Frame;
use rayon::prelude::*;

/// The enclosures of each face, in the order of the faces.
pub(super) fn faces(
    frame: &Frame,
    bounds: &[FaceBounds],
    order: &[u32],
    maxima: &[Maximum],
) -> Vec<FaceDeviation> {
    let mut places = vec![0_u32; order.len()];
    for (place, face) in order.iter().enumerate() {
        places[*face as usize] = place as u32;
    }
    let out = |(low, high): (f64, f64)| length_out(frame, greater(lesser(low, high), 0.0), high);
    let of_face = |(maximum, place): (&Maximum, &u32)| {
        let bounds = &bounds[*place as usize];
        // The search for the largest distance on a face knows better than its pieces what no distance exceeds.
        let at_most = |(low, high): (f64, f64)| (low, lesser(high, maximum.upper));
        FaceDeviation {
            max: out((maximum.lower, maximum.upper)),
            min: out(at_most(bounds.min)),
            mean: out(at_most(bounds.mean)),
        }
    };
    maxima.par_iter().zip(&places).map(of_face).collect()
}
