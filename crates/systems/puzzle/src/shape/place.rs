//! Placing copies of a shape within an outline: from lattices, by descent, with hops.

use super::cover::Samples;
use super::map::Map;
use super::pose::Pose;
use super::torus::{Lattice, lattices};
use crate::PuzzleError;
use pompeiu_core::mesh::edit::Random;
use pompeiu_core::run::Control;
use pompeiu_planar::{Outline, Point, SideTree};
use rayon::prelude::*;

/// Lattices to try on the outline, and positions for each.
const LATTICES: usize = 6;
const PLACES: usize = 300;

/// How far beyond the bounding box of the outline copies are generated, relative to the radius of the shape.
const BEYOND: f64 = 3.0;

/// Number of starts for descent.
const STARTS: usize = 8;

/// Sample points per unit of length: for choosing starts, for descent, for the last descent.
const COARSE: f64 = 8.0;
const MIDDLE: f64 = 16.0;
const FINE: f64 = 24.0;

/// Widths of the hinge in successive descents.
const WIDTHS: [f64; 5] = [0.3, 0.2, 0.13, 0.09, 0.06];

/// Widths after a hop, and for the last descent.
const HOP_WIDTHS: [f64; 2] = [0.12, 0.06];
const LAST_WIDTH: f64 = 0.03;

/// Hops per round; the best of a round is kept.
const ROUND: usize = 6;

/// Rounds of hops for few pieces; for many pieces, the number that takes equally long.
const ROUNDS: usize = 8;
const PIECES_OF_ROUNDS: usize = 40;

/// The poses of copies, and the energies.
pub(super) struct Placed {
    pub(super) poses: Vec<Pose>,
    pub(super) energy: Vec<f64>,
}

/// Places `count` copies of the shape of a map, of area 1, on an outline of the same total area.
///
/// # Errors
/// [`PuzzleError::Outline`] if no lattice has that many copies within reach.
pub(super) fn place(
    map: &Map,
    outline: &Outline,
    count: usize,
    mirrors: bool,
    seed: u64,
    control: &Control,
    tell: &(dyn Fn(f64) + Sync),
) -> Result<Placed, PuzzleError> {
    let found = lattices(map, LATTICES, mirrors, seed, control);
    tell(0.3);
    let sides = SideTree::new(outline);
    let coarse = Samples::new(outline, COARSE);
    let samples = Samples::new(outline, MIDDLE);
    let places = (PLACES * PIECES_OF_ROUNDS / count.max(PIECES_OF_ROUNDS)).max(20);
    let tries: Vec<(usize, usize)> =
        (0..found.len()).flat_map(|l| (0..places).map(move |i| (l, i))).collect();
    let start = |(l, i): (usize, usize)| {
        let mut random = Random::new(seed ^ ((l * PLACES + i + 1) as u64).wrapping_mul(0x517c_c1b7));
        let poses = on_outline(&found[l], (outline, &sides), count, map.radius(), &mut random)?;
        let (mut total, width) = (0.0, 0.06);
        coarse.each(map, &poses, |_, _, v| total += super::descend::hinge(v, width).0);
        Some((total, poses))
    };
    let mut starts: Vec<(f64, Vec<Pose>)> =
        tries.par_iter().filter(|_| !control.is_stopped()).filter_map(|&one| start(one)).collect();
    if starts.is_empty() {
        // Stopped before there was one.
        starts.extend(tries.into_iter().find_map(start));
    }
    starts.sort_by(|a, b| a.0.total_cmp(&b.0));
    starts.truncate(STARTS);
    let mut descended: Vec<Placed> = starts
        .into_par_iter()
        .map(|(_, mut poses)| {
            let mut energy = Vec::new();
            for width in WIDTHS {
                if control.is_stopped() && !energy.is_empty() {
                    break;
                }
                samples.settle(map, &mut poses, width, 40, |value| {
                    energy.push(value);
                    !control.is_stopped()
                });
            }
            Placed { poses, energy }
        })
        .collect();
    descended.sort_by(|a, b| last(a).total_cmp(&last(b)));
    tell(0.5);
    if descended.is_empty() {
        return Err(PuzzleError::Outline);
    }
    let mut best = descended.swap_remove(0);
    let rounds = (ROUNDS * PIECES_OF_ROUNDS / count.max(PIECES_OF_ROUNDS)).max(1);
    for round in 0..rounds {
        if control.is_stopped() {
            break;
        }
        hop(map, &samples, &mut best, mirrors, seed ^ (round as u64 + 1).wrapping_mul(0x2545_f491), control);
        tell(0.5 + 0.4 * (round + 1) as f64 / rounds as f64);
    }
    let fine = Samples::new(outline, FINE);
    let mut end = best.poses.clone();
    let mut energy = Vec::new();
    fine.settle(map, &mut end, LAST_WIDTH, 120, |value| {
        energy.push(value);
        !control.is_stopped()
    });
    // A narrower hinge lowers the energy; other sample points may raise it by noise.
    let before = last(&best);
    energy.retain(|value| *value < before);
    if !energy.is_empty() {
        best.energy.extend(energy);
        best.poses = end;
    }
    Ok(best)
}

/// The copies of the best lattice nearest to an outline, for the best of some positions, followed by all copies around them.
///
/// # Errors
/// [`PuzzleError::Outline`] if no lattice has that many copies within reach.
pub(super) fn on_lattice(
    map: &Map,
    outline: &Outline,
    count: usize,
    mirrors: bool,
    seed: u64,
    control: &Control,
) -> Result<Vec<Pose>, PuzzleError> {
    let found = lattices(map, 1, mirrors, seed, control);
    let best = found.first().ok_or(PuzzleError::Outline)?;
    let sides = SideTree::new(outline);
    let coarse = Samples::new(outline, COARSE);
    let tries: Vec<(f64, Vec<Pose>)> = (0..PLACES)
        .into_par_iter()
        .filter_map(|i| {
            let mut random = Random::new(seed ^ (i as u64 + 1).wrapping_mul(0x517c_c1b7));
            let all = around(best, (outline, &sides), map.radius(), &mut random)?;
            let poses = all.get(..count)?;
            let mut total = 0.0;
            coarse.each(map, poses, |_, _, v| total += super::descend::hinge(v, 0.06).0);
            Some((total, all))
        })
        .collect();
    let nearest = tries.into_iter().min_by(|a, b| a.0.total_cmp(&b.0));
    nearest.map(|(_, poses)| poses).ok_or(PuzzleError::Outline)
}

fn last(placed: &Placed) -> f64 {
    placed.energy.last().copied().unwrap_or(f64::INFINITY)
}

/// The copies of a lattice, rotated and translated at random, that lie deepest within an outline.
fn on_outline(
    lattice: &Lattice,
    within: (&Outline, &SideTree<'_>),
    count: usize,
    radius: f64,
    random: &mut Random,
) -> Option<Vec<Pose>> {
    let mut found = around(lattice, within, radius, random)?;
    if found.len() < count {
        return None;
    }
    found.truncate(count);
    Some(found)
}

/// The copies of a lattice, rotated and translated at random, within and around an outline, deepest first.
fn around(
    lattice: &Lattice,
    (outline, sides): (&Outline, &SideTree<'_>),
    radius: f64,
    random: &mut Random,
) -> Option<Vec<Pose>> {
    let [low, high] = outline.bounds();
    let middle = [0, 1].map(|k| 0.5 * (low[k] + high[k]));
    let reach = 0.5 * libm::hypot(high[0] - low[0], high[1] - low[1]) + BEYOND * radius;
    // Every other try is aligned with an axis.
    let angle = if random.below(2) == 0 {
        let along = lattice.basis[random.below(2) as usize];
        f64::from(random.below(4)) * std::f64::consts::FRAC_PI_2 - libm::atan2(along[1], along[0])
    } else {
        std::f64::consts::PI * random.signed_unit()
    };
    let (sine, cosine) = libm::sincos(angle);
    let turn = |[x, y]: Point| [cosine * x - sine * y, sine * x + cosine * y];
    let [u, v] = lattice.basis.map(turn);
    let shift = [random.signed_unit(), random.signed_unit()];
    let determinant = (u[0] * v[1] - u[1] * v[0]).abs();
    // Enough steps along each vector to reach across.
    let steps = [v, u].map(|w| (reach * libm::hypot(w[0], w[1]) / determinant).ceil() as i64 + 2);
    if steps.iter().any(|s| *s > 4_000) {
        return None;
    }
    let mut found: Vec<(f64, Pose)> = Vec::new();
    for i in -steps[0]..=steps[0] {
        for j in -steps[1]..=steps[1] {
            let (f, g) = (i as f64 + shift[0], j as f64 + shift[1]);
            for copy in &lattice.copies {
                let own = turn(copy.place);
                let place = [0, 1].map(|k| middle[k] + f * u[k] + g * v[k] + own[k]);
                if (0..2).any(|k| place[k] < low[k] - BEYOND * radius || place[k] > high[k] + BEYOND * radius)
                {
                    continue;
                }
                found.push((depth(sides, place), Pose { place, angle: copy.angle + angle, ..*copy }));
            }
        }
    }
    found.sort_by(|a, b| b.0.total_cmp(&a.0));
    Some(found.into_iter().map(|(_, pose)| pose).collect())
}

/// Depth of a point within an outline, negative outside.
fn depth(sides: &SideTree<'_>, p: Point) -> f64 {
    let distance = sides.distance(p);
    if sides.contains(p) { distance } else { -distance }
}

/// Moves one to three of the worst pieces to where little is covered, and keeps improvements.
fn hop(map: &Map, samples: &Samples, best: &mut Placed, mirrors: bool, seed: u64, control: &Control) {
    let n = best.poses.len();
    let mut bad = vec![0.0; n];
    let mut inside = vec![0.0; n];
    let mut open: Vec<(f64, Point)> = Vec::new();
    samples.each(map, &best.poses, |p, j, value| {
        if value > 0.0 {
            bad[j] += value.min(0.3);
            open.push((value, p));
        } else {
            inside[j] += 1.0;
        }
    });
    let of_piece = samples.len() as f64 / n as f64;
    let badness = |j: usize| 4.0 * bad[j] / of_piece + (1.0 - inside[j] / of_piece).max(0.0);
    let mut worst: Vec<usize> = (0..n).collect();
    worst.sort_by(|a, b| badness(*b).total_cmp(&badness(*a)));
    let pool = (n / 2).max(1);
    open.sort_by(|a, b| b.0.total_cmp(&a.0));
    open.truncate((open.len() / 3).max(1));
    let tries: Vec<Placed> = (0..ROUND)
        .into_par_iter()
        .map(|i| {
            let mut random = Random::new(seed.wrapping_add((i as u64) << 32));
            let mut poses = best.poses.clone();
            for _ in 0..=random.below(3) {
                let piece = worst[random.below(pool as u32) as usize];
                let pose = &mut poses[piece];
                let away = random.below(2) == 0 && !open.is_empty();
                if away {
                    pose.place = open[random.below(open.len() as u32) as usize].1;
                } else {
                    pose.place = pose.place.map(|x| x + 0.3 * random.signed_unit());
                }
                pose.angle += std::f64::consts::PI * random.signed_unit();
                if mirrors && random.below(4) == 0 {
                    pose.is_mirrored = !pose.is_mirrored;
                }
            }
            let mut end = f64::INFINITY;
            for width in HOP_WIDTHS {
                end = samples.settle(map, &mut poses, width, 45, |_| !control.is_stopped());
            }
            Placed { poses, energy: vec![end] }
        })
        .collect();
    let better = tries.into_iter().min_by(|a, b| last(a).total_cmp(&last(b)));
    if let Some(found) = better.filter(|found| last(found) < last(best) && !control.is_stopped()) {
        best.poses = found.poses;
        best.energy.extend(found.energy);
    }
}
