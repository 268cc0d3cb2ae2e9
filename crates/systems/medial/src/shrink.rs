//! Shrinking balls until they touch a surface at two points.

use crate::ball::Ball;
use crate::sample::Sample;
use glam::DVec3;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::spatial::{Bvh, Workspace};
use rayon::prelude::*;

/// Smallest angle, seen from the centre, between the two points where a ball touches the surface; below it the second point is
/// attributed to the noise around the first. At the first step, and later: cosines of 20 and 40 degrees.
const NEAR: [f64; 2] = [0.939_692_620_785_908_4, 0.766_044_443_118_978];

/// Smallest distance of a ball's centre from the surface, relative to its radius.
const INSIDE: f64 = 0.95;

/// Converged if the relative change of the radius is below this.
const SETTLED: f64 = 1e-9;

/// Largest number of steps.
const STEPS: usize = 60;

/// A ball inside a surface that touches it at a sample, and its second contact point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shrunk {
    pub(super) ball: Ball,
    pub(super) opposite: DVec3,
}

/// The ball of each sample; `None` if the surface leaves no room for it.
///
/// # Source
/// `ma_medial_2012`; distances are to the surface itself, not to samples of it.
pub(super) fn balls(bvh: &Bvh, samples: &[Sample], largest: f64) -> Vec<Option<Shrunk>> {
    let one = |workspace: &mut Workspace, sample: &Sample| shrink(bvh, sample, largest, workspace);
    samples.par_iter().with_min_len(64).map_init(Workspace::default, one).collect()
}

fn shrink(bvh: &Bvh, sample: &Sample, largest: f64, workspace: &mut Workspace) -> Option<Shrunk> {
    let Sample { place, normal, .. } = *sample;
    let mut radius = largest;
    let mut slot = bvh.any_slot();
    let mut opposite = place;
    for step in 0..STEPS {
        let centre = place - radius * normal;
        let nearest = bvh.nearest(centre.to_array(), slot, workspace);
        slot = nearest.slot;
        let touched = closest(centre, bvh.corners(slot));
        let across = place - touched;
        let depth = normal.dot(across);
        // A point behind the tangent plane, or as far away as the sample itself, does not shrink the ball.
        if (centre - touched).length() >= radius * (1.0 - SETTLED) || depth <= 0.0 {
            break;
        }
        let smaller = 0.5 * across.length_squared() / depth;
        let middle = place - smaller * normal;
        let cosine = (place - middle).dot(touched - middle) / (smaller * (touched - middle).length());
        if cosine.is_nan() || cosine > NEAR[usize::from(step > 0)] {
            break;
        }
        opposite = touched;
        if smaller >= radius * (1.0 - SETTLED) {
            radius = smaller;
            break;
        }
        radius = smaller;
    }
    let centre = place - radius * normal;
    let clear = bvh.nearest(centre.to_array(), slot, workspace).distance_sq.sqrt();
    let fits = clear >= INSIDE * radius && radius < largest && radius > 0.0;
    fits.then(|| Shrunk { ball: Ball { centre: centre.to_array(), radius }, opposite })
}

/// The point of a triangle nearest to a given point.
fn closest(p: DVec3, corners: [[f64; 3]; 3]) -> DVec3 {
    let weights = closest_barycentric(p.to_array(), corners);
    weights.iter().zip(corners).map(|(&w, q)| w * DVec3::from_array(q)).sum()
}
