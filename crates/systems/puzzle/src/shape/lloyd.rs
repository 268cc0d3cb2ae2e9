//! Lloyd's method with the shape-matching metric.

use super::cover::{candidates, least};
use super::map::Map;
use super::place::Placed;
use super::pose::{Pose, Turned};
use super::register::{Registered, register, steps};
use pompeiu_core::mesh::edit::Random;
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, Point, fill, resample};
use rayon::prelude::*;

/// Pixels per unit of length.
const PIXELS: f64 = 24.0;

/// Pixels along the side of a block with a common list of candidate copies.
const SIDE: usize = 8;

/// Largest number of rounds.
const ROUNDS: usize = 120;

/// Converged if no site moves farther than this.
const SETTLED: f64 = 1e-3;

/// Number of points of the shape for registration.
const POINTS: usize = 120;

/// Rounds between registrations from all rotations; the others continue from the previous one.
const AGAIN: usize = 10;

/// Sites inside an outline; each is repeatedly moved to the centroid of the region that is nearest to it in the metric of a map.
///
/// With feedback, each copy is also rotated by registering the shape on its region. The energies are the means of the least values,
/// which can increase: the centroid does not minimise them.
pub(super) fn lloyd(
    map: &Map,
    shape: &Outline,
    outline: &Outline,
    count: usize,
    feedback: Option<bool>,
    seed: u64,
    control: &Control,
) -> Placed {
    let [low, high] = outline.bounds();
    let mut random = Random::new(seed);
    let mut poses = Vec::with_capacity(count);
    while poses.len() < count {
        let place = [0, 1].map(|k| low[k] + (high[k] - low[k]) * (0.5 + 0.5 * random.signed_unit()));
        if outline.contains(place) {
            poses.push(Pose { place, angle: 0.0, is_mirrored: false });
        }
    }
    let size = [0, 1].map(|k| ((high[k] - low[k]) * PIXELS).ceil().max(1.0) as usize);
    let pixel = |i: usize| [0, 1].map(|k| low[k] + ([i % size[0], i / size[0]][k] as f64 + 0.5) / PIXELS);
    let in_pixels = outline.map(|p| [0, 1].map(|k| (p[k] - low[k]) * PIXELS - 0.5));
    let Ok(in_pixels) = in_pixels else { return Placed { poses, energy: Vec::new() } };
    let inside: Vec<bool> = fill([&in_pixels], size[0], size[1]).iter().map(|share| *share >= 0.5).collect();
    let points = resample(shape, POINTS, 0);
    let mut energy = Vec::new();
    for round in 0..ROUNDS {
        let labels = assign(map, &poses, size, &inside, &pixel);
        let (mut sums, mut total) = (vec![[0.0; 3]; count], 0.0);
        for (i, (label, value)) in labels.iter().enumerate().filter(|(i, _)| inside[*i]) {
            let p = pixel(i);
            let sum = &mut sums[*label];
            *sum = [sum[0] + p[0], sum[1] + p[1], sum[2] + 1.0];
            total += value;
        }
        energy.push(total / inside.iter().filter(|is_inside| **is_inside).count().max(1) as f64);
        let mut moved: f64 = 0.0;
        for (pose, [x, y, n]) in poses.iter_mut().zip(&sums).filter(|(_, sum)| sum[2] > 0.0) {
            let to = [x / n, y / n];
            moved = moved.max(libm::hypot(to[0] - pose.place[0], to[1] - pose.place[1]));
            pose.place = to;
        }
        if let Some(mirrors) = feedback {
            turn(&mut poses, &labels, size, &inside, &pixel, &points, mirrors, round);
        }
        if moved < SETTLED || control.is_stopped() {
            break;
        }
    }
    Placed { poses, energy }
}

/// The copy of least value at each pixel inside, and that value.
fn assign(
    map: &Map,
    poses: &[Pose],
    [width, height]: [usize; 2],
    inside: &[bool],
    pixel: &(impl Fn(usize) -> Point + Sync),
) -> Vec<(usize, f64)> {
    let turned: Vec<Turned> = poses.iter().map(Pose::turn).collect();
    let bands: Vec<Vec<(usize, f64)>> = (0..height.div_ceil(SIDE))
        .into_par_iter()
        .map(|band| {
            let rows = SIDE.min(height - band * SIDE);
            let mut found = vec![(0, 0.0); rows * width];
            let mut near = Vec::new();
            for left in (0..width).step_by(SIDE) {
                let centre =
                    pixel((band * SIDE) * width + left).map(|x| x + 0.5 * (SIDE - 1) as f64 / PIXELS);
                let radius = SIDE as f64 / PIXELS * std::f64::consts::FRAC_1_SQRT_2;
                // Factors are not Lipschitz: every copy is a candidate.
                if map.is_distance() {
                    candidates(map, &turned, centre, radius, &mut near);
                } else {
                    near = (0..poses.len()).collect();
                }
                for row in 0..rows {
                    for column in left..(left + SIDE).min(width) {
                        let i = (band * SIDE + row) * width + column;
                        if inside[i] {
                            let (value, j) = least(map, &turned, &near, pixel(i));
                            found[row * width + column] = (j, value);
                        }
                    }
                }
            }
            found
        })
        .collect();
    bands.concat()
}

/// Rotates each copy by registering the shape on the border of its region.
#[allow(clippy::too_many_arguments, reason = "the parts of one round")]
fn turn(
    poses: &mut [Pose],
    labels: &[(usize, f64)],
    [width, height]: [usize; 2],
    inside: &[bool],
    pixel: &(impl Fn(usize) -> Point + Sync),
    points: &[Point],
    mirrors: bool,
    round: usize,
) {
    let mut borders: Vec<Vec<Point>> = vec![Vec::new(); poses.len()];
    for i in (0..labels.len()).filter(|i| inside[*i]) {
        let (x, y) = (i % width, i / width);
        let same = |j: usize| inside[j] && labels[j].0 == labels[i].0;
        let is_within = x > 0
            && y > 0
            && x + 1 < width
            && y + 1 < height
            && [i - 1, i + 1, i - width, i + width].into_iter().all(same);
        if !is_within {
            borders[labels[i].0].push(pixel(i));
        }
    }
    poses.par_iter_mut().zip(&borders).filter(|(_, border)| border.len() > 8).for_each(|(pose, border)| {
        let found = if round.is_multiple_of(AGAIN) {
            register(points, border, mirrors)
        } else {
            Some(steps(points, border, Registered { pose: *pose, scale: 1.0, rms: f64::INFINITY }, 4))
        };
        if let Some(found) = found.filter(|found| found.rms.is_finite()) {
            pose.angle = found.pose.angle;
            pose.is_mirrored = found.pose.is_mirrored;
        }
    });
}
