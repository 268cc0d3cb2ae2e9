//! What one task does: discards faces and pieces, or hands them on, and finds points that are far away.

use super::game::{self, MAX_ROWS};
use super::piece::{INHERITED, Parts, Piece};
use super::rows::Rows;
use super::{Limits, Scene};
use crate::report::WorkCount;
use pompeiu_core::spatial::{Cover, Nearest, Slot, Workspace};

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
#[derive(Debug)]
pub(crate) struct Outcome {
    /// The farthest point found, if farther than the search knew.
    pub(crate) found: Option<Found>,
    /// The largest bound of a discarded piece, rounding included.
    pub(crate) upper: f64,
    /// Pieces that are left.
    pub(crate) open: Vec<Piece>,
    pub(crate) kept: Vec<Piece>,
    pub(crate) discarded: Vec<Discarded>,
    pub(crate) work: WorkCount,
}

/// One task's view of the search.
pub(crate) struct Worker<'s> {
    scene: &'s Scene<'s>,
    limits: Limits,
    keep: Keep,
    /// The largest distance known: what the search knew when the task began, and what the task found.
    lower: f64,
    workspace: Workspace,
    out: Outcome,
}

impl<'s> Worker<'s> {
    pub(crate) fn new(scene: &'s Scene<'s>, limits: Limits, keep: Keep, lower: f64) -> Self {
        let out = Outcome {
            found: None,
            upper: 0.0,
            open: Vec::new(),
            kept: Vec::new(),
            discarded: Vec::new(),
            work: WorkCount::default(),
        };
        Self { scene, limits, keep, lower, workspace: Workspace::default(), out }
    }

    pub(crate) fn scene(&self) -> &'s Scene<'s> {
        self.scene
    }

    pub(crate) fn finish(mut self) -> Outcome {
        self.out.work.distances = self.workspace.distances;
        self.out
    }

    /// Exact distances of some points of A, given with their faces; `hint` is a triangle near the first.
    pub(crate) fn sample(&mut self, points: impl Iterator<Item = (u32, [f64; 3])>, mut hint: Slot) {
        for (face, point) in points {
            let start = Nearest { slot: hint, distance_sq: self.scene.bvh.distance_sq(point, hint) };
            hint = self.query(face, point, start).slot;
        }
    }

    /// Exact distance of a point of A; raises the lower bound.
    fn query(&mut self, face: u32, point: [f64; 3], start: Nearest) -> Nearest {
        self.out.work.queries += 1;
        let nearest = self.scene.bvh.nearest_below(point, start, &mut self.workspace);
        self.raise(face, point, nearest);
        nearest
    }

    fn raise(&mut self, face: u32, point: [f64; 3], nearest: Nearest) {
        let distance = nearest.distance_sq.sqrt();
        if distance > self.lower {
            self.lower = distance;
            self.out.found = Some(Found { distance, point, face, nearest: nearest.slot });
        }
    }

    /// Looks at whole faces, in an order in which neighbours are near each other: most are covered by the triangle that
    /// covered the one before.
    pub(crate) fn sweep(&mut self, faces: &[u32]) {
        let mut hint = self.scene.bvh.any_slot();
        for (i, &face) in faces.iter().enumerate() {
            if i % STOP_CHECK == 0 && self.scene.stopped() {
                for &face in &faces[i..] {
                    self.bound_without_search(face, hint);
                }
                return;
            }
            self.out.work.pieces += 1;
            let corners = self.scene.corners(face);
            let points = with_centre(&corners);
            let d = self.scene.bvh.four_distances_sq(&points, hint, &mut self.workspace);
            let mut piece = Piece {
                corners,
                bound: f64::INFINITY,
                near: [hint; INHERITED],
                near_count: 1,
                nearest_known: false,
                depth: 0,
                face,
            };
            let farthest = max3(d);
            if farthest <= self.limit_sq(0) {
                self.discard(piece, farthest.sqrt(), || SlotProof::Face(hint));
                continue;
            }
            self.out.work.queries += 1;
            let start = Nearest { slot: hint, distance_sq: d[3] };
            let nearest = match self.scene.bvh.cover(&points, self.limit_sq(0), start, &mut self.workspace) {
                Cover::By { slot, distance_sq } => {
                    hint = slot;
                    self.discard(piece, distance_sq.sqrt(), || SlotProof::Face(slot));
                    continue;
                }
                Cover::Nearest(nearest) => {
                    self.raise(face, centre(&points), nearest);
                    nearest
                }
                Cover::Neighbour(near) => self.query(face, centre(&points), near),
            };
            hint = nearest.slot;
            let d = max3(self.scene.bvh.four_distances_sq(&points, hint, &mut self.workspace));
            if d <= self.limit_sq(0) {
                self.discard(piece, d.sqrt(), || SlotProof::Face(hint));
            } else {
                piece.near[0] = hint;
                piece.nearest_known = true;
                piece.bound = d.sqrt() + self.limits.rounding.bound(0);
                self.out.open.push(piece);
            }
        }
    }

    /// Keeps discarded pieces with the bound of the face nearest to their centroid, if that is better than their own.
    pub(crate) fn tighten(&mut self, pieces: &[Piece]) {
        let bvh = self.scene.bvh;
        for piece in pieces {
            let mut piece = *piece;
            if piece.bound > self.lower {
                let points = with_centre(&piece.corners);
                let x = centre(&points);
                let start = Nearest { slot: piece.near[0], distance_sq: bvh.distance_sq(x, piece.near[0]) };
                let nearest = self.query(piece.face, x, start);
                let farthest = max3(bvh.four_distances_sq(&points, nearest.slot, &mut self.workspace)).sqrt();
                let bound = farthest + self.limits.rounding.bound(piece.depth);
                if bound < piece.bound {
                    piece.bound = bound;
                    piece.near[0] = nearest.slot;
                }
            }
            if piece.bound > self.lower {
                self.out.kept.push(piece);
            } else {
                self.raise_upper(piece.bound);
            }
        }
    }

    /// A valid bound on a face at the price of one triangle: what is left to do when time runs out.
    fn bound_without_search(&mut self, face: u32, hint: Slot) {
        let points = with_centre(&self.scene.corners(face));
        let d = max3(self.scene.bvh.four_distances_sq(&points, hint, &mut self.workspace)).sqrt();
        self.raise_upper(d + self.limits.rounding.bound(0));
    }

    /// Searches pieces depth first until they are gone or `budget` of them were examined; what is left stays open.
    pub(crate) fn refine(&mut self, pieces: &[Piece], budget: usize) {
        let mut stack: Vec<Piece> = pieces.iter().rev().copied().collect();
        for i in 0..budget {
            if i % STOP_CHECK == 0 && self.scene.stopped() {
                break;
            }
            let Some(piece) = stack.pop() else { break };
            self.examine(piece, &mut stack);
        }
        stack.reverse();
        self.out.open.append(&mut stack);
    }

    /// Cover, generate, cut: discards one piece or pushes its parts.
    ///
    /// # Source
    /// Adding the face that is nearest where the bound is attained is the cutting-plane method, `kelley_cutting_1960`, on
    /// the lower envelope of the distances from faces.
    fn examine(&mut self, piece: Piece, stack: &mut Vec<Piece>) {
        self.out.work.pieces += 1;
        self.out.work.depth = self.out.work.depth.max(piece.depth);
        let points = with_centre(&piece.corners);
        let bvh = self.scene.bvh;

        // Cover: one face of B near all corners.
        let mut rows = Rows::default();
        let mut start = Nearest { slot: piece.near[0], distance_sq: f64::INFINITY };
        for &slot in piece.near() {
            let d = bvh.four_distances_sq(&points, slot, &mut self.workspace);
            let farthest = max3(d);
            if farthest <= self.limit_sq(piece.depth) {
                return self.discard(piece, farthest.sqrt(), || SlotProof::Face(slot));
            }
            if d[3] < start.distance_sq {
                start = Nearest { slot, distance_sq: d[3] };
            }
            rows.push(slot, [d[0].sqrt(), d[1].sqrt(), d[2].sqrt()]);
        }
        let nearest = if piece.nearest_known {
            start
        } else {
            self.out.work.queries += 1;
            // A point within the limit will not raise the lower bound by much: any face near it will do to cut by.
            match bvh.cover_or_neighbour(&points, self.limit_sq(piece.depth), start, &mut self.workspace) {
                Cover::By { slot, distance_sq } => {
                    return self.discard(piece, distance_sq.sqrt(), || SlotProof::Face(slot));
                }
                Cover::Nearest(nearest) => {
                    self.raise(piece.face, centre(&points), nearest);
                    nearest
                }
                Cover::Neighbour(nearest) => nearest,
            }
        };
        self.add_row(&mut rows, nearest.slot, &points);

        // Some corner is far from all known faces, and the nearest face ends well inside: cut there at once.
        let reach = self.limits.reach(self.lower);
        if rows.uncovered_corner(self.limit(piece.depth)).is_some()
            && let Some(parts) = piece.prism_cut(bvh.corners(nearest.slot), reach, LARGE_PART)
        {
            let bound = rows.least_bound() + self.limits.rounding.bound(piece.depth);
            return self.push_parts(
                &piece,
                &parts,
                bound,
                rows.inherited(nearest.slot, &[0.0; MAX_ROWS]),
                stack,
            );
        }

        // Generate: mixtures of the faces nearest where the bound is attained.
        let mut game = None;
        let mut before = f64::INFINITY;
        for _ in 0..=GENERATED_ROWS {
            // A corner that no row is near to has the last word on any mixture: ask there first.
            let (x, start) = if let Some((corner, start)) = rows.uncovered_corner(self.limit(piece.depth)) {
                game = None;
                (piece.corners[corner], start)
            } else {
                let solved = self.solve(&rows);
                if solved.value <= self.limit(piece.depth) {
                    return self.discard(piece, solved.value, || rows.mixture(&solved.weights));
                }
                game = Some(solved);
                if solved.value > before - LEAST_GAIN * (before - self.lower) {
                    break;
                }
                before = solved.value;
                let x = at(&piece.corners, solved.corners);
                let slot = rows.likely_nearest(solved.corners);
                self.workspace.distances += 1;
                (x, Nearest { slot, distance_sq: bvh.distance_sq(x, slot) })
            };
            if start.distance_sq <= self.limit_sq(piece.depth) {
                break;
            }
            let nearest = self.query(piece.face, x, start);
            if !self.add_row(&mut rows, nearest.slot, &points) {
                break;
            }
        }
        let game = game.unwrap_or_else(|| self.solve(&rows));
        // What is too small to cut is discarded with a bound above the limit, and the enclosure comes out wider.
        let too_small = piece.depth >= MAX_DEPTH || piece.size() <= self.limits.least_size;
        if game.value <= self.limit(piece.depth) || too_small {
            return self.discard(piece, game.value, || rows.mixture(&game.weights));
        }

        // Cut.
        let bound = game.value + self.limits.rounding.bound(piece.depth);
        let parts = piece.cut(bvh.corners(nearest.slot), reach);
        self.push_parts(&piece, &parts, bound, rows.inherited(nearest.slot, &game.weights), stack);
    }

    /// Puts the parts of a piece with this bound on the stack.
    fn push_parts(
        &mut self,
        piece: &Piece,
        parts: &Parts,
        bound: f64,
        (near, near_count): ([Slot; INHERITED], u8),
        stack: &mut Vec<Piece>,
    ) {
        self.out.work.cuts += 1;
        let bound = if bound < piece.bound { bound } else { piece.bound };
        for &corners in parts.as_slice() {
            // The parts cover the piece up to the rounding of the cut.
            stack.push(Piece {
                corners,
                bound: bound + self.limits.rounding.cut(),
                near,
                near_count,
                nearest_known: false,
                depth: piece.depth + 1,
                face: piece.face,
            });
        }
    }

    fn solve(&mut self, rows: &Rows) -> game::Game {
        self.out.work.games += 1;
        game::solve(rows.distances())
    }

    /// Adds the distances of the corners from a face; false if it is there already or there is no room.
    fn add_row(&mut self, rows: &mut Rows, slot: Slot, points: &[[f64; 4]; 3]) -> bool {
        if !rows.has_room_for(slot) {
            return false;
        }
        let d = self.scene.bvh.four_distances_sq(points, slot, &mut self.workspace);
        rows.push(slot, [d[0].sqrt(), d[1].sqrt(), d[2].sqrt()]);
        true
    }

    /// A piece of this depth may be discarded when its computed bound is no greater.
    fn limit(&self, depth: u32) -> f64 {
        self.limits.at(self.lower, depth)
    }

    fn limit_sq(&self, depth: u32) -> f64 {
        let limit = self.limit(depth);
        if limit > 0.0 { limit * limit } else { -1.0 }
    }

    fn discard(&mut self, mut piece: Piece, computed: f64, proof: impl FnOnce() -> SlotProof) {
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

    fn raise_upper(&mut self, bound: f64) {
        self.out.upper = if bound > self.out.upper { bound } else { self.out.upper };
    }
}

/// Faces or pieces between two looks at the clock.
const STOP_CHECK: usize = 64;
/// A cut that leaves this fraction of a piece on both sides needs no second thought.
const LARGE_PART: f64 = 0.05;
/// Rows added to a game after its first solution.
const GENERATED_ROWS: usize = 4;
/// A new row must lower the bound by this part of its excess over the lower bound to be worth another.
const LEAST_GAIN: f64 = 0.02;
/// Pieces this deep are not cut further; halving edges 200 times reaches any size that doubles can hold here.
const MAX_DEPTH: u32 = 240;

/// The corners of a triangle and its centroid, coordinate by coordinate.
fn with_centre([a, b, c]: &[[f64; 3]; 3]) -> [[f64; 4]; 3] {
    let mut points = [[0.0; 4]; 3];
    for k in 0..3 {
        points[k] = [a[k], b[k], c[k], (a[k] + b[k] + c[k]) * (1.0 / 3.0)];
    }
    points
}

fn centre(points: &[[f64; 4]; 3]) -> [f64; 3] {
    [points[0][3], points[1][3], points[2][3]]
}

fn at([a, b, c]: &[[f64; 3]; 3], [u, v, w]: [f64; 3]) -> [f64; 3] {
    [u * a[0] + v * b[0] + w * c[0], u * a[1] + v * b[1] + w * c[1], u * a[2] + v * b[2] + w * c[2]]
}

fn max3(d: [f64; 4]) -> f64 {
    let m = if d[0] > d[1] { d[0] } else { d[1] };
    if d[2] > m { d[2] } else { m }
}
