//! The sweep: whole faces, most of which are discarded at once.

use super::overlay::{Below, OVERLAY_CUTS, Overlaid, View};
use super::piece::{INHERITED, Piece, longest_edge};
use super::rows::Rows;
use super::worker::{STOP_CHECK, SlotProof, Worker, centre, max3, with_centre};
use pompeiu_core::geom::Foot;
use pompeiu_core::spatial::{Cover, Nearest, Neighbours, Slot};

/// Faces whose corners are fetched together, so that the waits for memory overlap.
const FETCHED: usize = 16;
/// An overlay is of the wrong part of B if B is nearer than it believes by this factor, squared, where it is worst.
const WRONG_PART: f64 = 0.25;
/// Feet moved into a triangle bound squared distances up to about this factor beside it.
const LOOSE: f64 = 2.0;
/// A mixture is tried where the corners are at most this many times the limit from the face over the centre.
const FAR: f64 = 2.0;

/// What came of an overlay.
pub(super) enum Settled {
    /// The piece is discarded, or what is left of it is open; the face over its centre.
    Yes(Slot),
    /// It lies over too many faces: parts of it may fare better.
    TooMany(Slot),
    /// Nothing; the face over its centre, if that was found.
    No(Option<Slot>),
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
        let points = with_centre(corners);
        let mut piece = Piece::whole(face, *corners, hint);
        // Where overlays are tried, the face that is seen over the centre is compared next, and is the likelier one.
        let exactly = self.scene.neighbours.is_none();
        if let Some(farthest) = self.covered_by(&points, hint, self.limit_sq(0), exactly) {
            self.discard(piece, farthest.sqrt(), || SlotProof::Face(hint));
            return hint;
        }
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

    /// The greatest squared distance of three corners from a face, or a bound on it, if that is within a limit.
    fn covered_by(
        &mut self,
        points: &[[f64; 4]; 3],
        slot: Slot,
        limit_sq: f64,
        exactly: bool,
    ) -> Option<f64> {
        let foot = match &self.foot {
            Some((known, foot)) if *known == slot => foot,
            _ => &self.foot.insert((slot, Foot::new(self.scene.bvh.corners(slot)))).1,
        };
        self.workspace.distances += 3;
        let mut farthest = max3(foot.bounds_sq(points));
        if exactly && farthest > limit_sq && farthest <= LOOSE * limit_sq {
            farthest = max3(self.scene.bvh.four_distances_sq(points, slot, &mut self.workspace));
        }
        (farthest <= limit_sq).then_some(farthest)
    }

    /// Discards a piece by the face of B that is seen over its centre or by its overlay, or opens what the overlay leaves.
    pub(super) fn settle_by_overlay(&mut self, piece: &Piece, hint: Slot) -> Settled {
        let bvh = self.scene.bvh;
        let Some(neighbours) = self.scene.neighbours else { return Settled::No(None) };
        let Some(view) = View::new(&piece.corners) else { return Settled::No(None) };
        let Some(start) = view.face_over_centre(bvh, neighbours, hint) else { return Settled::No(None) };
        if start != hint {
            let points = with_centre(&piece.corners);
            if let Some(farthest) = self.covered_by(&points, start, self.limit_sq(piece.depth), true) {
                self.discard(*piece, farthest.sqrt(), || SlotProof::Face(start));
                return Settled::Yes(start);
            }
        }
        if self.settle_by_mixture(piece, &view, neighbours, start) {
            return Settled::Yes(start);
        }
        let depth = piece.depth + OVERLAY_CUTS;
        let below = Below { bvh, neighbours, limit_sq: self.limit_sq(depth) };
        let mut also_near = start;
        match self.overlay.run(&view, &below, start, &mut self.workspace) {
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
            // Where B's faces are no smaller, they are many because they meet in one vertex: parts would see as many.
            Overlaid::Many if piece.size() <= longest_edge(&bvh.corners(start)) => {
                return Settled::No(Some(start));
            }
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

    /// Discards a piece by a mixture of the face over its centre and those over the corners that are too far from it. Where the faces of
    /// both meshes are about as large, this settles most of what one face does not, with less work than an overlay.
    fn settle_by_mixture(
        &mut self,
        piece: &Piece,
        view: &View,
        neighbours: &Neighbours,
        start: Slot,
    ) -> bool {
        let limit = self.limit(piece.depth);
        let points = with_centre(&piece.corners);
        let mut rows = Rows::default();
        self.add_row(&mut rows, start, &points);
        let row = rows.distances()[0];
        // Far corners need so much weight on other faces that these would have to be near all corners.
        if row.iter().any(|distance| *distance > FAR * limit) {
            return false;
        }
        for (corner, _) in row.iter().enumerate().filter(|(_, distance)| **distance > limit) {
            let over = view.face_over_corner(corner, self.scene.bvh, neighbours, start);
            let Some(over) = over else { return false };
            self.add_row(&mut rows, over, &points);
        }
        if rows.uncovered_corner(limit).is_some() {
            return false;
        }
        let game = self.solve(&rows);
        if game.value > limit {
            return false;
        }
        self.discard(*piece, game.value, || rows.mixture(&game.weights));
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
