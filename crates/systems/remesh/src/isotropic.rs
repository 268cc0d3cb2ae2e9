//! Remeshing: edges of a wanted length, by splits, collapses, flips and moves within the surface.

use super::connectivity::NONE;
use super::flips::{flip_to_delaunay, flip_to_regular};
use super::folds::keep_fold;
use super::marked::{Collapse, Freedom, Marked};
use super::reference::Reference;
use super::smooth::smooth;
use super::splits::{Flips, STOP_EVERY, TooMany, split_longer_than};
use super::triangle::{SLIGHTLY_THINNER, keeps_normal_and_shape};
use pompeiu_core::run::Control;
use pompeiu_core::spatial::bvh::Workspace;

/// An edge longer than this many times its target is split.
pub(super) const LONGEST: f64 = 4.0 / 3.0;

/// An edge shorter than this many times its target is collapsed.
pub(super) const SHORTEST: f64 = 4.0 / 5.0;

/// The collapse of an edge shorter than this many times its target may make thin faces a little thinner. Of longer edges it may not: around a
/// narrow tip the surface would flatten.
const TINY: f64 = 0.25;

/// Steps within the surface between two projections.
pub(super) const STEPS: usize = 3;

/// Rounds of flips and moves after the last split and collapse.
const LAST_ROUNDS: usize = 3;

/// One iteration: split, collapse, flip, move.
pub(super) fn iterate(
    surface: &mut Marked,
    reference: Option<&Reference<'_>>,
    most_faces: usize,
    control: &Control,
) -> Result<(), TooMany> {
    split_longer_than(surface, LONGEST, Flips::near(reference), most_faces, control)?;
    collapse_short(surface, reference, control);
    if !control.is_stopped() {
        flip_to_regular(surface);
    }
    if !control.is_stopped() {
        smooth(surface, reference, STEPS);
    }
    Ok(())
}

/// Flips and moves without a change of the number of faces.
pub(super) fn finish(surface: &mut Marked, reference: Option<&Reference<'_>>) {
    for _ in 0..LAST_ROUNDS {
        flip_to_regular(surface);
        smooth(surface, reference, STEPS);
    }
    flip_to_delaunay(surface);
    smooth(surface, reference, 1);
}

/// Collapses short edges where this makes no long one and turns no face over. Vertices of curves stay on them.
fn collapse_short(surface: &mut Marked, reference: Option<&Reference<'_>>, control: &Control) {
    let shortest_sq = SHORTEST * SHORTEST;
    let mut workspace = Workspace::default();
    for h in 0..surface.mesh.halfedge_slots() {
        if h % STOP_EVERY == 0 && control.is_stopped() {
            return;
        }
        if !surface.mesh.names_edge(h) || surface.share_sq(h) >= shortest_sq {
            continue;
        }
        let Some(found) = surface.collapse_of(h) else { continue };
        let mut collapse = keep_fold(surface, found);
        if let (Freedom::Curve, Some(reference)) = (collapse.freedom, reference) {
            let curve = surface.curve[h as usize];
            if let Some(p) = reference.project_to_curve(collapse.position, curve, &mut workspace) {
                collapse.position = p;
            }
        }
        if is_harmless(surface, &collapse) {
            surface.collapse(&collapse);
        }
    }
}

pub(super) fn is_harmless(surface: &Marked, collapse: &Collapse) -> bool {
    let mesh = &surface.mesh;
    let (h, p) = (collapse.halfedge, collapse.position);
    let ends = [mesh.from(h), mesh.to(h)];
    let shape = if surface.share_sq(h) < TINY * TINY { SLIGHTLY_THINNER } else { 1.0 };
    let removed = [h / 3, mesh.twin_of(h).map_or(NONE, |t| t / 3)];
    ends.into_iter().all(|v| {
        mesh.halfedges_from(v).filter(|x| !removed.contains(&(x / 3))).all(|x| {
            let corner = (x % 3) as usize;
            let old = mesh.corners(x / 3).map(|v| mesh.positions[v as usize]);
            let mut new = old;
            new[corner] = p;
            keeps_normal_and_shape(old, new, shape)
        }) && mesh.neighbours(v).filter(|w| !ends.contains(w)).all(|w| {
            let [one, two] = [v, w].map(|x| surface.length[x as usize]);
            let most = LONGEST * if one < two { one } else { two };
            p.distance_squared(mesh.positions[w as usize]) <= most * most
        })
    })
}
