//! Smoothing and resampling of branches, with the deviation from the input.

use crate::curve::Curve;
use crate::{RoundCone, Skeleton};
use glam::DVec3;

/// Options of smoothing and resampling. Nodes and tips stay fixed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SmoothOptions {
    /// Steps of Laplacian smoothing, each halfway to the mean of the neighbours, including the radius.
    pub steps: usize,
    /// Distance of new samples along the clamped cubic B-spline whose control points are the smoothed samples, in micrometres.
    /// Without it, the result consists of the smoothed samples.
    pub spacing: Option<f64>,
}

/// The deviation of a skeleton due to smoothing and resampling.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct SkeletonDeviation {
    /// The greatest distance of a sample from the new axis of its branch, in micrometres.
    pub position: f64,
    /// The sample at this distance, by its number in the file.
    pub sample: i64,
    /// Its branch.
    pub branch: usize,
    /// The greatest difference of a radius from that at the nearest point of the new axis, in micrometres.
    pub radius: f64,
}

/// Largest number of samples after resampling a branch.
const MOST_SAMPLES: f64 = 1e6;

/// Smooths and resamples every branch.
///
/// A spacing that would give a branch more than a million samples is increased.
pub fn smooth(skeleton: &Skeleton, options: &SmoothOptions) -> (Skeleton, SkeletonDeviation) {
    let samples = skeleton.samples();
    let mut deviation = SkeletonDeviation::default();
    let mut parts = Vec::new();
    for (index, branch) in skeleton.branches().into_iter().enumerate() {
        let mut points: Vec<(DVec3, f64)> =
            branch.iter().map(|&i| (samples[i].position, samples[i].radius)).collect();
        for _ in 0..options.steps {
            let before = points.clone();
            for k in 1..points.len() - 1 {
                let mean = |a: (DVec3, f64), b: (DVec3, f64)| ((a.0 + b.0) * 0.5, (a.1 + b.1) * 0.5);
                points[k] = mean(before[k], mean(before[k - 1], before[k + 1]));
            }
        }
        if let Some(spacing) = options.spacing {
            points = resampled(&points, spacing);
        }
        for &i in &branch {
            let (distance, radius) = nearest(&points, samples[i].position);
            if distance > deviation.position {
                deviation = SkeletonDeviation {
                    position: distance,
                    sample: samples[i].id,
                    branch: index,
                    ..deviation
                };
            }
            deviation.radius = deviation.radius.max((radius - samples[i].radius).abs());
        }
        parts.push((branch, points));
    }
    (skeleton.with_branches(&parts), deviation)
}

/// Chords per span for the length of a curve.
const PER_SPAN: usize = 16;

fn resampled(points: &[(DVec3, f64)], spacing: f64) -> Vec<(DVec3, f64)> {
    let curve = Curve::new(points.iter().copied());
    let lengths = curve.arc_length(PER_SPAN);
    let count = (lengths.total() / spacing).round().clamp(1.0, MOST_SAMPLES) as usize;
    (0..=count).map(|k| curve.at(lengths.parameter(lengths.total() * k as f64 / count as f64))).collect()
}

/// Distance from a polygonal axis, and the radius there.
fn nearest(points: &[(DVec3, f64)], p: DVec3) -> (f64, f64) {
    let mut best = (f64::INFINITY, 0.0);
    for ends in points.windows(2) {
        let axis = RoundCone { ends: [ends[0].0, ends[1].0], radii: [0.0, 0.0] };
        let (distance, t) = axis.distance(p);
        if distance < best.0 {
            best = (distance, ends[0].1 + (ends[1].1 - ends[0].1) * t);
        }
    }
    best
}
