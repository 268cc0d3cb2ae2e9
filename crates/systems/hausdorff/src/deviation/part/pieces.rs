//! Faces cut where points stop being wanted.
//!
//! Whoever chooses points says of a triangle that all of them are wanted, that none is, or that it cannot tell. Triangles of the last kind are
//! halved at the middle of their longest edge, which the neighbours of a face do at the same point, until their edges are shorter than the finest
//! that is looked at; then the answer for the middle counts.

use super::{Measured, Part};
use crate::PreparedPair;
use glam::DVec3;
use pompeiu_core::geom::Frame;
use pompeiu_core::{FaceId, TriMesh};
use std::collections::HashMap;

/// What is to become of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fate {
    /// All of its points are wanted.
    Kept,
    /// None of its points is wanted.
    LeftOut,
    /// It is cut; if it is too small for that, it is wanted or not.
    Open(bool),
}

/// Parts of the root of the area of the smaller surface that edges of pieces are not cut below.
const FINEST: f64 = 2048.0;
/// Edges of pieces at most, in units of the finest length: a large piece is compared with many faces at once, which takes far longer than its
/// parts with few each.
const LARGEST: f64 = 32.0;
/// Pieces that are looked at together at most.
const MOST: usize = 1 << 20;
/// How often an edge may be halved: see [`Part::ROUNDING`].
const DEEPEST: u32 = 60;

/// The length below which edges are not cut, for parts of a pair: the diagonal would be that of far junk.
pub(super) fn finest(pair: &PreparedPair<'_>, frame: &Frame) -> f64 {
    let area = |mesh: &TriMesh| {
        let of_face = |face| {
            let [a, b, c] = mesh.corners(face).map(|p| DVec3::from_array(frame.map(p)));
            0.5 * (b - a).cross(c - a).length()
        };
        mesh.face_ids().map(of_face).sum::<f64>()
    };
    let [a, b] = [pair.a(), pair.b()].map(|mesh| area(mesh).sqrt());
    frame.length_out((if a < b { a } else { b }) / FINEST)
}

/// A triangle cut from a face of a part.
#[derive(Clone, Copy)]
struct Piece {
    /// Which face of the part.
    of: u32,
    corners: [u32; 3],
    /// The first of its halves, which come one after the other; none of a piece that is not cut.
    halves: Option<u32>,
    is_kept: bool,
}

/// The triangles of a part, halved.
struct Cutting {
    positions: Vec<[f64; 3]>,
    middles: HashMap<[u32; 2], u32>,
}

impl Cutting {
    /// Both halves of a piece, if its longest edge is longer than a length.
    fn halves(&mut self, piece: Piece, finest: f64) -> Option<[Piece; 2]> {
        let (longest, length) = self.longest(&piece, finest);
        // Where there is no finest length, nothing is cut.
        if !(finest > 0.0 && length > 1.0) {
            return None;
        }
        let [from, to, opposite] = [0, 1, 2].map(|i| piece.corners[(longest + i) % 3]);
        let middle = self.middle(from, to);
        let is_at = |v: u32| self.positions[middle as usize] == self.positions[v as usize];
        let half = |corners| Piece { of: piece.of, corners, halves: None, is_kept: false };
        let is_new = !is_at(from) && !is_at(to);
        is_new.then(|| [half([from, middle, opposite]), half([middle, to, opposite])])
    }

    /// The longest edge of a piece, by its first corner, and its length in units of the finest one, whose squares do not underflow.
    fn longest(&self, piece: &Piece, finest: f64) -> (usize, f64) {
        let corners = piece.corners.map(|v| self.positions[v as usize]);
        let length_sq = |i: usize| {
            let (p, q) = (corners[i], corners[(i + 1) % 3]);
            let along = |k: usize| (p[k] - q[k]) / finest;
            (0..3).map(|k| along(k) * along(k)).sum::<f64>()
        };
        let longest = (1..3).fold(0, |most, i| if length_sq(i) > length_sq(most) { i } else { most });
        (longest, length_sq(longest).sqrt())
    }

    /// The middle of an edge: the same bits whichever way it is seen.
    fn middle(&mut self, from: u32, to: u32) -> u32 {
        let key = if from < to { [from, to] } else { [to, from] };
        if let Some(known) = self.middles.get(&key) {
            return *known;
        }
        let [p, q] = [from, to].map(|v| self.positions[v as usize]);
        self.positions.push([0, 1, 2].map(|k| 0.5 * p[k] + 0.5 * q[k]));
        let middle = (self.positions.len() - 1) as u32;
        self.middles.insert(key, middle);
        middle
    }

    /// Pieces as a mesh of their own, on the vertices that they need.
    fn mesh(&self, pieces: &[Piece]) -> Option<TriMesh> {
        let mut used = HashMap::new();
        let mut positions = Vec::new();
        let mut place = |v: u32| {
            *used.entry(v).or_insert_with(|| {
                positions.push(self.positions[v as usize]);
                (positions.len() - 1) as u32
            })
        };
        let faces = pieces.iter().map(|piece| piece.corners.map(&mut place)).collect();
        TriMesh::new(positions, faces).ok()
    }
}

impl Part {
    /// The points of it that are wanted; none if there is none. `judge` tells the fate of all faces of a mesh.
    pub(super) fn cut(
        &self,
        whole: &TriMesh,
        finest: f64,
        judge: &mut dyn FnMut(&TriMesh) -> Vec<Fate>,
    ) -> Option<Self> {
        let mut cutting = Cutting { positions: self.mesh.positions().to_vec(), middles: HashMap::new() };
        let faces = (0..).zip(self.mesh.faces());
        let mut pieces: Vec<Piece> = faces
            .map(|(of, corners)| Piece { of, corners: *corners, halves: None, is_kept: false })
            .collect();
        let mut open = 0..pieces.len();
        let mut fates = judge(&self.mesh);
        for depth in 0.. {
            let may_cut = depth < DEEPEST && open.len() <= MOST;
            for (place, fate) in open.clone().zip(fates) {
                let piece = pieces[place];
                let is_open = matches!(fate, Fate::Open(_)) && may_cut;
                if let Some(halves) = is_open.then(|| cutting.halves(piece, finest)).flatten() {
                    pieces[place].halves = Some(pieces.len() as u32);
                    pieces.extend(halves);
                } else {
                    pieces[place].is_kept = matches!(fate, Fate::Kept | Fate::Open(true));
                }
            }
            open = open.end..pieces.len();
            let Some(mesh) = cutting.mesh(&pieces[open.clone()]) else { break };
            fates = judge(&mesh);
        }
        self.joined(whole, cutting, pieces, finest)
    }

    /// What is kept, as pieces that are not large; all of it as it is if everything is kept.
    fn joined(
        &self,
        whole: &TriMesh,
        mut cutting: Cutting,
        mut pieces: Vec<Piece>,
        finest: f64,
    ) -> Option<Self> {
        // Whether a face ends inside: then others of its size are cut, too.
        let mut any_cut = false;
        for place in (0..pieces.len()).rev() {
            if let Some(half) = pieces[place].halves {
                let kept = [half, half + 1].map(|half| pieces[half as usize].is_kept);
                any_cut |= kept[0] != kept[1];
                pieces[place].is_kept = kept == [true; 2];
            }
        }
        let roots = self.mesh.faces().len();
        if pieces[..roots].iter().all(|piece| piece.is_kept) {
            return Some(self.clone());
        }
        let mut measured = vec![Measured::Nothing; whole.faces().len()];
        let mut is_whole: Vec<bool> = self.measured.iter().map(|of| *of == Measured::Whole).collect();
        for (piece, face) in pieces.iter().zip(&self.faces) {
            is_whole[face.index()] &= piece.is_kept;
        }
        let (mut corners, mut faces) = (Vec::new(), Vec::new());
        let mut next: Vec<Piece> = pieces[..roots].iter().rev().copied().collect();
        while let Some(piece) = next.pop() {
            match piece.halves {
                Some(half) if !piece.is_kept => {
                    next.extend([half + 1, half].map(|half| pieces[half as usize]));
                }
                _ if !piece.is_kept => {}
                _ => {
                    if let Some(halves) = any_cut.then(|| cutting.halves(piece, LARGEST * finest)).flatten() {
                        next.extend(halves.map(|half| Piece { is_kept: true, ..half }).into_iter().rev());
                        continue;
                    }
                    let face = self.faces[piece.of as usize];
                    let part = if is_whole[face.index()] { Measured::Whole } else { Measured::Pieces };
                    measured[face.index()] = part;
                    corners.push(piece.corners);
                    faces.push(face);
                }
            }
        }
        Self::on_used(whole, &cutting.positions, (corners, faces), measured)
    }

    /// The same as [`Self::with`], without the new vertices that no triangle has.
    pub(super) fn on_used(
        whole: &TriMesh,
        positions: &[[f64; 3]],
        (mut corners, faces): (Vec<[u32; 3]>, Vec<FaceId>),
        measured: Vec<Measured>,
    ) -> Option<Self> {
        let old = whole.positions().len();
        let mut kept = positions[..old].to_vec();
        let mut places = vec![u32::MAX; positions.len() - old];
        for v in corners.iter_mut().flatten() {
            let Some(new) = (*v as usize).checked_sub(old) else { continue };
            if places[new] == u32::MAX {
                places[new] = kept.len() as u32;
                kept.push(positions[*v as usize]);
            }
            *v = places[new];
        }
        Self::with(whole, kept, (corners, faces), measured)
    }
}
