//! What one task knows and has found out: the discards of faces and pieces, what is left of them, and points that are far away.
//!
//! What tasks do is in `sweep` and `refine`.

use super::bisectors::Bisectors;
use super::feet::Feet;
use super::overlay::Overlay;
use super::parts::CutParts;
use super::piece::Piece;
use super::scene::{Limits, Scene};
use crate::report::WorkCount;
use pompeiu_core::spatial::{Nearest, Slot, Workspace};

/// A point of A and its distance from B as computed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    pub(crate) distance: f64,
    pub(crate) point: [f64; 3],
    /// Face of A.
    pub(crate) face: u32,
    pub(crate) nearest: Slot,
}

/// The proof of a discard, in slots.
#[derive(Clone, Debug)]
pub(crate) enum SlotProof {
    Face(Slot),
    Mixture(Vec<(Slot, f64)>),
}

/// A piece that was discarded, for those who want to see it.
#[derive(Clone, Debug)]
pub(crate) struct Discarded {
    pub(crate) piece: Piece,
    pub(crate) proof: SlotProof,
}

/// What to keep of discarded pieces.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Keep {
    /// All of them, with their proofs.
    pub(crate) discards: bool,
    /// Those that a finer tolerance may have to look at again.
    pub(crate) pieces: bool,
}

/// Results of tasks, merged in task order.
#[derive(Debug, Default)]
pub(crate) struct Outcome {
    /// The farthest point found, if farther than the search knew.
    pub(crate) found: Option<Found>,
    /// The largest bound of a discarded piece, rounding included.
    pub(crate) upper: f64,
    /// Pieces that are left.
    pub(crate) open: Vec<Piece>,
    pub(crate) kept: Vec<Piece>,
    pub(crate) discarded: Vec<Discarded>,
    /// Faces of B that are nearest to the points that were asked for.
    pub(crate) nearest: Vec<Slot>,
    pub(crate) work: WorkCount,
}

/// One task's view of the search.
pub(super) struct Worker<'s> {
    pub(super) scene: &'s Scene<'s>,
    pub(super) limits: Limits,
    pub(super) keep: Keep,
    /// The largest distance known: what the search knew when the task began, and what the task found.
    pub(super) lower: f64,
    pub(super) workspace: Workspace,
    pub(super) overlay: Overlay,
    pub(super) parts: CutParts,
    pub(super) bisectors: Bisectors,
    /// Faces of B that whole faces were compared with.
    pub(super) feet: Feet,
    pub(super) out: Outcome,
}

impl<'s> Worker<'s> {
    pub(super) fn new(scene: &'s Scene<'s>, limits: Limits, keep: Keep, lower: f64) -> Self {
        let keep_all = keep.discards || keep.pieces;
        let overlay = Overlay::new(keep_all);
        let out = Outcome::default();
        Self {
            scene,
            limits,
            keep,
            lower,
            workspace: Workspace::default(),
            overlay,
            parts: CutParts::new(keep_all),
            bisectors: Bisectors::default(),
            feet: Feet::default(),
            out,
        }
    }

    /// Forgets what was found, but for memory and counts of distances.
    pub(super) fn begin_again(&mut self) {
        self.lower = 0.0;
        self.out = Outcome::default();
    }

    pub(super) fn scene(&self) -> &'s Scene<'s> {
        self.scene
    }

    pub(super) fn finish(mut self) -> Outcome {
        self.out.work.distances = self.workspace.distances;
        self.out
    }

    /// Exact distances of some points of A, given with their faces, and which triangles are nearest; `hint` is a triangle near the first.
    pub(super) fn sample(&mut self, points: impl Iterator<Item = (u32, [f64; 3])>, mut hint: Slot) {
        for (face, point) in points {
            let start = Nearest { slot: hint, distance_sq: self.scene.bvh.distance_sq(point, hint) };
            hint = self.query(face, point, start).slot;
            self.out.nearest.push(hint);
        }
    }

    /// Exact distance of a point of A; raises the lower bound.
    pub(super) fn query(&mut self, face: u32, point: [f64; 3], start: Nearest) -> Nearest {
        self.out.work.queries += 1;
        let nearest = self.scene.bvh.nearest_below(point, start, &mut self.workspace);
        self.raise(face, point, nearest);
        nearest
    }

    pub(super) fn raise(&mut self, face: u32, point: [f64; 3], nearest: Nearest) {
        self.know(face, point, nearest.distance_sq.sqrt(), nearest.slot);
    }

    /// Raises the lower bound by a point of A whose distance is known.
    pub(super) fn know(&mut self, face: u32, point: [f64; 3], distance: f64, nearest: Slot) {
        if distance > self.lower {
            self.lower = distance;
            self.out.found = Some(Found { distance, point, face, nearest });
        }
    }

    /// A piece of this depth may be discarded when its computed bound is no greater.
    pub(super) fn limit(&self, depth: u32) -> f64 {
        self.limits.at(self.lower, depth)
    }

    pub(super) fn limit_sq(&self, depth: u32) -> f64 {
        let limit = self.limit(depth);
        if limit > 0.0 { limit * limit } else { -1.0 }
    }

    pub(super) fn discard(&mut self, mut piece: Piece, computed: f64, proof: impl FnOnce() -> SlotProof) {
        // Not the lesser of this and an inherited bound, which the proof at hand would not show.
        piece.bound = computed + self.limits.rounding.bound(piece.depth);
        if self.keep.discards {
            self.out.discarded.push(Discarded { piece, proof: proof() });
        }
        if self.keep.pieces && piece.bound > self.lower {
            self.out.kept.push(piece);
        } else {
            self.raise_upper(piece.bound);
        }
    }

    pub(super) fn raise_upper(&mut self, bound: f64) {
        self.out.upper = if bound > self.out.upper { bound } else { self.out.upper };
    }
}

/// Faces or pieces between two looks at the clock.
pub(super) const STOP_CHECK: usize = 64;

/// The corners of a triangle and its centroid, coordinate by coordinate.
pub(super) fn with_centre([a, b, c]: &[[f64; 3]; 3]) -> [[f64; 4]; 3] {
    let mut points = [[0.0; 4]; 3];
    for k in 0..3 {
        points[k] = [a[k], b[k], c[k], (a[k] + b[k] + c[k]) * (1.0 / 3.0)];
    }
    points
}

pub(super) fn centre(points: &[[f64; 4]; 3]) -> [f64; 3] {
    [points[0][3], points[1][3], points[2][3]]
}

pub(super) fn at([a, b, c]: &[[f64; 3]; 3], [u, v, w]: [f64; 3]) -> [f64; 3] {
    [u * a[0] + v * b[0] + w * c[0], u * a[1] + v * b[1] + w * c[1], u * a[2] + v * b[2] + w * c[2]]
}

pub(super) fn max3(d: [f64; 4]) -> f64 {
    let m = if d[0] > d[1] { d[0] } else { d[1] };
    if d[2] > m { d[2] } else { m }
}
