//! The sweep: whole faces, most of which are discarded at once.

use super::overlay::{Below, MOST_FACES, MOST_LARGE_FACES, OVERLAY_CUTS, Overlaid, View};
use super::parts::MOST_CUTS;
use super::piece::{INHERITED, Piece, longest_edge};
use super::worker::{STOP_CHECK, SlotProof, Worker, centre, max3, with_centre};
use pompeiu_core::spatial::{Cover, Nearest, Neighbours, Slot};

/// Faces whose corners are fetched together, so that the waits for memory overlap.
const FETCHED: usize = 16;
/// An overlay is of the wrong part of B if B is nearer than it believes by this factor, squared, where it is worst.
const WRONG_PART: f64 = 0.25;
/// Feet moved into a triangle bound squared distances up to about this factor beside it.
const LOOSE: f64 = 2.0;
/// Steps to the face of B over the centre.
const MOST_STEPS: usize = 24;

/// What came of the faces of B that are seen over a piece.
pub(super) enum Settled {
    /// The piece is discarded, or what is left of it is open; the face over its centre.
    Yes(Slot),
    /// It lies over too many faces: parts of it may fare better.
    TooMany(Slot),
    /// Nothing; the face over its centre, if that was found.
    No(Option<Slot>),
}

/// Where a walk over B ended.
enum Walk {
    /// At a face that is within the limit, with the greatest squared distance or a bound on it.
    Covered(Slot, f64),
    /// At the face over the centre.
    Over(Slot),
    /// Nowhere: B ended on the way, or the way was long.
    Lost,
}

impl Worker<'_> {
    /// Looks at whole faces, in an order in which neighbours are near each other: most are covered by the triangle that
    /// covered the one before, or by those around it.
    pub(super) fn sweep(&mut self, faces: &[u32]) {
        let mut hint = self.scene.bvh.any_slot();
        let mut fetched = [[[0.0; 3]; 3]; FETCHED];
        for (i, faces_fetched) in faces.chunks(FETCHED).enumerate() {
            if (i * FETCHED).is_multiple_of(STOP_CHECK) && self.scene.stopped() {
                return self.bound_without_search(&faces[i * FETCHED..]);
            }
            for (corners, face) in fetched.iter_mut().zip(faces_fetched) {
                *corners = self.scene.corners(*face);
            }
            for (corners, &face) in fetched.iter().zip(faces_fetched) {
                hint = self.sweep_face(face, corners, hint);
            }
        }
    }

    /// Discards a face or opens it. `hint` is a face of B that may be near; returns one that is.
    pub(super) fn sweep_face(&mut self, face: u32, corners: &[[f64; 3]; 3], hint: Slot) -> Slot {
        self.out.work.pieces += 1;
        let mut piece = Piece::whole(face, *corners, hint);
        let mut over_centre = None;
        match self.settle_by_overlay(&piece, hint) {
            Settled::Yes(slot) => return slot,
            Settled::TooMany(slot) => {
                piece.near[0] = slot;
                piece.overlay = true;
            }
            Settled::No(slot) => over_centre = slot,
        }
        self.out.work.queries += 1;
        let points = with_centre(corners);
        let x = centre(&points);
        let start = Nearest { slot: hint, distance_sq: self.scene.bvh.distance_sq(x, hint) };
        let nearest = match self.scene.bvh.cover(&points, self.limit_sq(0), start, &mut self.workspace) {
            Cover::By { slot, distance_sq } => {
                self.discard(piece, distance_sq.sqrt(), || SlotProof::Face(slot));
                return slot;
            }
            Cover::Nearest(nearest) => {
                self.raise(face, x, nearest);
                nearest.slot
            }
            Cover::Neighbour(near) => self.query(face, x, near).slot,
        };
        let d = max3(self.scene.bvh.four_distances_sq(&points, nearest, &mut self.workspace));
        if d <= self.limit_sq(0) {
            self.discard(piece, d.sqrt(), || SlotProof::Face(nearest));
            return nearest;
        }
        // From the nearest face the overlay may look at another part of B.
        if !piece.overlay && over_centre != Some(nearest) {
            match self.settle_by_overlay(&piece, nearest) {
                Settled::Yes(slot) => return slot,
                Settled::TooMany(_) => piece.overlay = true,
                Settled::No(_) => {}
            }
        }
        piece.near[0] = nearest;
        piece.nearest_known = true;
        piece.bound = d.sqrt() + self.limits.rounding.bound(0);
        self.out.open.push(piece);
        nearest
    }

    /// Walks over B from a face to the one over the centre of three points, unless one on the way is within a limit of all three.
    fn walk(&mut self, points: &[[f64; 4]; 3], hint: Slot, limit_sq: f64) -> Walk {
        let bvh = self.scene.bvh;
        let (mut slot, mut entered_by) = (hint, 3);
        for _ in 0..MOST_STEPS {
            let foot = self.feet.of(bvh, slot);
            self.workspace.distances += 3;
            let farthest_sq = max3(foot.bounds_sq(points));
            if farthest_sq <= limit_sq {
                return Walk::Covered(slot, farthest_sq);
            }
            let mut exit = (3, 0.0);
            if self.scene.neighbours.is_some() {
                // The edge opposite to a corner leads from the next one.
                for (corner, [.., weight]) in foot.four_weights(points).into_iter().enumerate() {
                    let edge = (corner + 1) % 3;
                    if weight < exit.1 && edge != entered_by {
                        exit = (edge, weight);
                    }
                }
            }
            if exit.0 == 3 {
                if farthest_sq <= LOOSE * limit_sq {
                    let exact = max3(bvh.four_distances_sq(points, slot, &mut self.workspace));
                    if exact <= limit_sq {
                        return Walk::Covered(slot, exact);
                    }
                }
                return Walk::Over(slot);
            }
            match self.scene.neighbours.and_then(|neighbours| neighbours.across(slot, exit.0)) {
                Some(across) => (slot, entered_by) = (across.slot, across.edge),
                None => return Walk::Lost,
            }
        }
        Walk::Lost
    }

    /// Discards a piece by the face of B that is seen over its centre, in parts, or by its overlay; or opens what the overlay leaves.
    pub(super) fn settle_by_overlay(&mut self, piece: &Piece, hint: Slot) -> Settled {
        let bvh = self.scene.bvh;
        let points = with_centre(&piece.corners);
        let start = match self.walk(&points, hint, self.limit_sq(piece.depth)) {
            Walk::Covered(slot, farthest_sq) => {
                self.discard(*piece, farthest_sq.sqrt(), || SlotProof::Face(slot));
                return Settled::Yes(slot);
            }
            Walk::Over(slot) => slot,
            Walk::Lost => return Settled::No(None),
        };
        let Some(neighbours) = self.scene.neighbours else { return Settled::No(None) };
        if self.discard_in_parts(piece, neighbours, start) {
            return Settled::Yes(start);
        }
        let Some(view) = View::new(&piece.corners) else { return Settled::No(None) };
        let depth = piece.depth + OVERLAY_CUTS;
        let below = Below { bvh, neighbours, limit_sq: self.limit_sq(depth) };
        let is_among_large = piece.size() <= longest_edge(&bvh.corners(start));
        let most = if is_among_large { MOST_LARGE_FACES } else { MOST_FACES };
        let mut also_near = start;
        match self.overlay.run(&view, &below, start, most, &mut self.workspace) {
            Overlaid::Covered(distance_sq) => {
                if !self.overlay.keep_all {
                    self.raise_upper(distance_sq.sqrt() + self.limits.rounding.bound(depth));
                    return Settled::Yes(start);
                }
            }
            Overlaid::Beyond(covered_sq) => {
                if let Some((x, slot, distance_sq)) = self.overlay.worst {
                    let nearest = self.query(piece.face, x, Nearest { slot, distance_sq });
                    if nearest.distance_sq < WRONG_PART * distance_sq && self.overlay.is_mostly_beyond() {
                        return Settled::No(Some(start));
                    }
                    also_near = nearest.slot;
                }
                // Cells that are not listed are discarded with the rest of the overlay.
                if !self.overlay.keep_all {
                    self.raise_upper(covered_sq.sqrt() + self.limits.rounding.bound(depth));
                }
            }
            Overlaid::Many if is_among_large => return Settled::No(Some(start)),
            Overlaid::Many => return Settled::TooMany(start),
            Overlaid::None => return Settled::No(Some(start)),
        }
        // The query may have raised the lower bound.
        let limit_sq = self.limit_sq(depth);
        let cells = std::mem::take(&mut self.overlay.cells);
        for cell in &cells {
            let distance = cell.distance_sq.sqrt();
            let bound = distance + self.limits.rounding.bound(depth);
            let mut near = [cell.slot; INHERITED];
            let mut near_count = 1;
            if also_near != cell.slot {
                (near[1], near_count) = (also_near, 2);
            }
            for corners in cell.triangles() {
                let part = Piece {
                    corners,
                    bound,
                    near,
                    near_count,
                    nearest_known: false,
                    overlay: false,
                    depth,
                    ..*piece
                };
                if cell.distance_sq <= limit_sq {
                    self.discard(part, distance, || SlotProof::Face(cell.slot));
                } else {
                    self.out.open.push(part);
                }
            }
        }
        self.overlay.cells = cells;
        Settled::Yes(start)
    }

    /// Discards a piece in parts, each within the limit of one face, where that is simple.
    fn discard_in_parts(&mut self, piece: &Piece, neighbours: &Neighbours, start: Slot) -> bool {
        let depth = piece.depth + MOST_CUTS;
        let below = Below { bvh: self.scene.bvh, neighbours, limit_sq: self.limit_sq(depth) };
        let distances = &mut self.workspace.distances;
        let covered = self.parts.cover(&piece.corners, &below, start, &mut self.feet, distances);
        let Some(distance_sq) = covered else { return false };
        if !self.parts.keep_all {
            self.raise_upper(distance_sq.sqrt() + self.limits.rounding.bound(depth));
            return true;
        }
        let parts = std::mem::take(&mut self.parts.covered);
        for (part, distance_sq) in &parts {
            for corners in part.triangles() {
                self.discard(Piece { corners, depth, ..*piece }, distance_sq.sqrt(), || {
                    SlotProof::Face(part.slot)
                });
            }
        }
        self.parts.covered = parts;
        true
    }

    /// Keeps discarded pieces with the bound of the face nearest to their centroid, if that is better than their own.
    pub(super) fn tighten(&mut self, pieces: &[Piece]) {
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

    /// Valid bounds on faces by a triangle that is near one of them: what is left to do when time runs out.
    fn bound_without_search(&mut self, faces: &[u32]) {
        for faces in faces.chunks(FETCHED) {
            let near =
                self.scene.bvh.some_near(self.scene.corners(faces[faces.len() / 2])[0], &mut self.workspace);
            for &face in faces {
                let points = with_centre(&self.scene.corners(face));
                let d = max3(self.scene.bvh.four_distances_sq(&points, near, &mut self.workspace)).sqrt();
                self.raise_upper(d + self.limits.rounding.bound(0));
            }
        }
    }
}
