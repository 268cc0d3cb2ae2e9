//! Vertices at which the surface folds back, as at the rim of a plate that is thinner than edges are long, or at a narrow tip.
//!
//! Normals around such a vertex cancel: it has no tangent plane to move in, and its neighbours lie on one side. Moves towards their middle and
//! collapses onto the middle of edges that lead away shorten the surface each time, and no projection undoes that, for the nearest point of
//! the input is then beside the rim.

use super::marked::{Collapse, Freedom, Marked};
use super::triangle::area_vector;
use glam::DVec3;

/// Length of the mean of the unit normals around a vertex, weighted by angles, below which the surface folds back along two edges. Two
/// sheets that enclose 90° have .71, two that enclose 74° have .6.
const FOLDED: f64 = 0.6;

/// The same, where the surface does not fold along two edges.
const POINTED: f64 = 0.25;

/// What the surface is like at a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fold {
    /// It has a tangent plane.
    None,
    /// It folds along two edges, which lead to these vertices.
    Along([u32; 2]),
    /// It has a point there, or ends of folds.
    Tip,
}

impl Fold {
    pub(super) fn at(surface: &Marked, v: u32) -> Self {
        let mesh = &surface.mesh;
        let (mut sum, mut total) = (DVec3::ZERO, 0.0);
        for h in mesh.halfedges_from(v) {
            let triangle = surface.triangle(h / 3);
            let [p, q, r] = [0, 1, 2].map(|i| triangle[((h + i) % 3) as usize]);
            let area = area_vector(triangle);
            let angle = libm::atan2(area.length(), (q - p).dot(r - p));
            sum += angle * area.normalize_or_zero();
            total += angle;
        }
        let share = sum.length() / total;
        if share >= FOLDED {
            return Self::None;
        }
        let mut folded = mesh.halfedges_from(v).filter(|&h| folds_back(surface, h)).map(|h| mesh.to(h));
        match [folded.next(), folded.next(), folded.next()] {
            [Some(one), Some(other), None] => Self::Along([one, other]),
            _ if share < POINTED => Self::Tip,
            _ => Self::None,
        }
    }

    /// Where a vertex goes that stays in the fold.
    pub(super) fn relaxed(self, surface: &Marked, v: u32) -> DVec3 {
        let at = |v: u32| surface.mesh.positions[v as usize];
        let p = at(v);
        let Self::Along(ends) = self else { return p };
        let [a, b] = ends.map(at);
        let along = (b - a).normalize_or_zero();
        p + along * along.dot(0.5 * (a + b) - p)
    }
}

/// Whether the faces on both sides of an edge look away from each other.
fn folds_back(surface: &Marked, h: u32) -> bool {
    let normal = |f: u32| area_vector(surface.triangle(f));
    surface.mesh.twin_of(h).is_some_and(|t| normal(h / 3).dot(normal(t / 3)) < 0.0)
}

/// Leaves the end of an edge where it is that lies in a fold, if the other one does not.
pub(super) fn keep_fold(surface: &Marked, collapse: Collapse) -> Collapse {
    if collapse.freedom != Freedom::Surface {
        return collapse;
    }
    let h = collapse.halfedge;
    let ends = [surface.mesh.from(h), surface.mesh.to(h)];
    let stay = |v: u32| {
        let position = surface.mesh.positions[v as usize];
        Collapse { position, freedom: Freedom::None, ..collapse }
    };
    match ends.map(|v| Fold::at(surface, v) != Fold::None) {
        [true, false] => stay(ends[0]),
        [false, true] => stay(ends[1]),
        _ => collapse,
    }
}
