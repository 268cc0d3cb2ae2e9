//! Balls that touch a surface on two sides.

use super::Ball;
use super::sample::Sample;
use glam::DVec3;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::spatial::{Bvh, Workspace};
use rayon::prelude::*;

/// Angle between the two points where a ball touches the surface, seen from its centre, below which the second one is taken for a part of
/// the surface around the first: at the first step, and later. Cosines of 20 and 40 degrees.
const NEAR: [f64; 2] = [0.939_692_620_785_908_4, 0.766_044_443_118_978];

/// Share of its radius that a ball's centre must lie away from the surface at least.
const INSIDE: f64 = 0.95;

/// Change of the radius below which it counts as found, over the radius.
const SETTLED: f64 = 1e-9;

/// Most steps.
const STEPS: usize = 60;

/// A ball inside a surface that touches it at a sample, and where it touches it besides.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shrunk {
    pub(super) ball: Ball,
    pub(super) opposite: DVec3,
}

/// The ball of each sample; none where the surface leaves no room for it.
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
        // What lies behind the tangent plane, or as far off as the sample itself, does not shrink the ball.
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

/// The point of a triangle that is nearest to a point.
fn closest(p: DVec3, corners: [[f64; 3]; 3]) -> DVec3 {
    let weights = closest_barycentric(p.to_array(), corners);
    weights.iter().zip(corners).map(|(&w, q)| w * DVec3::from_array(q)).sum()
}
