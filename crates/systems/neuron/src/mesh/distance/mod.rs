//! The distance of the wall from the surface of the skeleton's cones, both ways, proven.

mod boxes;
mod patches;
mod pieces;
mod search;
mod solid;

pub(super) use patches::Net;
use pieces::{Facet, Facets, FlatEnd, Piece, Surface};
pub(super) use search::Wanted;
use search::{Enclosure, Goal, Patch, enclose};
use solid::Solid;

use super::options::{BeyondSample, DirectedDistance, WallDistance};
use crate::Skeleton;
use glam::DVec3;
use pompeiu_core::run::Control;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Greatest distance of the triangles that stand for a patch of the wall from it, in radii.
const FACETED: f64 = 0.01;

/// The same where that leaves open whether the distance of a cone is tolerated.
const FINELY_FACETED: f64 = FACETED / 16.0;

/// Most parts of a patch along each direction in triangles.
const MOST_PARTS: f64 = 32.0;

/// The distance of a wall of patches from the surface of the union of the skeleton's cones, both ways. `ends` are the flat ends of the
/// mesh: the number of the sample, and the normal outwards.
///
/// # Definition
/// At a ball, neurites begin in its centre with their own radius. Of the surface of the cones, the round ends beyond flat ends of the
/// mesh are left out. Distances in radii are divided by the radius of the skeleton's ball next to the point.
/// # Accuracy
/// Proven, rounding included. `None` if there is no wall.
/// # Cost
/// Linear in the length of the tree in radii, but for logarithmic factors.
pub(super) fn wall_distance<const S: usize>(
    skeleton: &Skeleton,
    ends: &[(i64, DVec3)],
    wall: &[Net<S>],
    (within, wanted): (f64, Wanted),
    control: &Control,
) -> Option<WallDistance> {
    if wall.is_empty() {
        return None;
    }
    let solid = Solid::new(skeleton);
    let facets = Facets::new(wall.par_iter().flat_map_iter(|net| facets_of(&solid, net, FACETED)).collect());
    let ends = flat_ends(skeleton, ends);
    let surface = Surface::new(&solid, &facets, skeleton, &ends);
    let goal = Goal { within, is_decided: false, wanted };
    let from_wall = enclose(
        wall,
        goal,
        control,
        (|net| Some(patches::bounds(&solid, net)), |net| patches::witness(&solid, net)),
    );
    let goal = Goal { is_decided: from_wall.lower[1] > within, ..goal };
    let mut from_cones = enclose(&surface.pieces(), goal, control, (|piece| surface.bounds(piece), |_| None));
    if from_cones.is_settled() {
        let near = |nets: &[Net<S>]| nets_next_to(&solid, nets, skeleton, &ends, &from_cones.settled);
        // Of parts of patches there are fewer triangles next to the pieces.
        let parts: Vec<Net<S>> =
            near(wall).iter().flat_map(Patch::divided).flat_map(|part| part.divided()).collect();
        let fine =
            near(&parts).par_iter().flat_map_iter(|net| facets_of(&solid, net, FINELY_FACETED)).collect();
        let fine = Facets::new(fine);
        let surface = Surface::new(&solid, &fine, skeleton, &ends);
        let better = enclose(&from_cones.settled, goal, control, (|piece| surface.bounds(piece), |_| None));
        from_cones.resolve(better);
    }
    let (wall_to_cones, cones_to_wall) = (directed(skeleton, &from_wall), directed(skeleton, &from_cones));
    let samples = skeleton.samples();
    let mut beyond: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
    for (sample, distance) in from_wall.beyond.into_iter().chain(from_cones.beyond) {
        let most = beyond.entry(sample).or_insert(distance);
        if distance[1] > most[1] {
            *most = distance;
        }
    }
    let mut beyond: Vec<BeyondSample> = beyond
        .into_iter()
        .map(|(sample, [distance, radii])| {
            let sample = samples[sample];
            BeyondSample { sample: sample.id, line: sample.line, distance, radii }
        })
        .collect();
    beyond.sort_by(|a, b| b.radii.total_cmp(&a.radii).then(a.line.cmp(&b.line)));
    Some(WallDistance { within, wall_to_cones, cones_to_wall, beyond })
}

/// The patches with parts of the wall that may be next to points of pieces of the cones.
fn nets_next_to<const S: usize>(
    solid: &Solid,
    nets: &[Net<S>],
    skeleton: &Skeleton,
    ends: &[FlatEnd],
    pieces: &[Piece],
) -> Vec<Net<S>> {
    let faceted: Vec<Vec<Facet>> = nets.par_iter().map(|net| facets_of(solid, net, FACETED)).collect();
    let counts: Vec<usize> = faceted.iter().map(Vec::len).collect();
    let facets = Facets::new(faceted.into_iter().flatten().collect());
    let is_near = Surface::new(solid, &facets, skeleton, ends).next_to(pieces);
    let mut first = 0;
    let of_nets = nets.iter().zip(counts).filter(|(_, count)| {
        first += count;
        is_near[first - count..first].contains(&true)
    });
    of_nets.map(|(net, _)| *net).collect()
}

fn directed<P>(skeleton: &Skeleton, found: &Enclosure<P>) -> DirectedDistance {
    let upper = found.uppers();
    DirectedDistance {
        lower: found.lower[0],
        upper: upper[0],
        lower_radii: found.lower[1],
        upper_radii: upper[1],
        sample: skeleton.samples()[found.sample].id,
    }
}

/// Triangles that stand for a patch, no farther from it than a share of the radius.
fn facets_of<const S: usize>(solid: &Solid, net: &Net<S>, most: f64) -> Vec<Facet> {
    let centre = net.at(0.5, 0.5);
    let reach = net.points.as_flattened().iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
    // Where a thin branch leaves a thick one, the radius is that of the thin one.
    let radius = solid.least_radius(centre, solid.nearest(centre).upper, reach);
    let bend = net.bend() / 8.0;
    let n = (bend / (most * radius)).sqrt().ceil().clamp(1.0, MOST_PARTS);
    let off = bend / (n * n);
    let at = |i: usize, j: usize| net.at(i as f64 / n, j as f64 / n);
    let n = n as usize;
    let mut found = Vec::with_capacity(2 * n * n);
    for i in 0..n {
        for j in 0..n {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            found.extend([([a, b, c], off), ([a, c, d], off)]);
        }
    }
    found
}

/// The flat ends at samples of the skeleton, which face away from their neighbours.
fn flat_ends(skeleton: &Skeleton, ends: &[(i64, DVec3)]) -> Vec<FlatEnd> {
    let samples = skeleton.samples();
    let ids: BTreeMap<i64, usize> = samples.iter().enumerate().map(|(i, sample)| (sample.id, i)).collect();
    let end = |(id, normal): &(i64, DVec3)| {
        let sample = *ids.get(id)?;
        let neighbour = skeleton.parent(sample).or_else(|| skeleton.children(sample).first().copied())?;
        let away: DVec3 = samples[sample].position - samples[neighbour].position;
        Some(FlatEnd { sample, outwards: away.normalize_or(*normal) })
    };
    ends.iter().filter_map(end).collect()
}
