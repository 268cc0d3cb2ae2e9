//! Faces cut where points stop being wanted.
//!
//! Whoever chooses points says of a triangle that all of them are wanted, that none is, or that it cannot tell. Triangles of the last kind are
//! divided along a line, if one is given, or halved at the middle of their longest edge, which the neighbours of a face do at the same point,
//! until their edges are shorter than the finest that is looked at; then the answer for the middle counts.

use super::clip::on_edge;
use super::{Measured, Part};
use crate::PreparedPair;
use glam::DVec3;
use pompeiu_core::geom::Frame;
use pompeiu_core::{FaceId, TriMesh};
use std::collections::HashMap;
use std::ops::Range;

/// What is to become of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fate {
    /// All of its points are wanted.
    Kept,
    /// None of its points is wanted.
    LeftOut,
    /// It is cut; if it is too small for that, it is wanted or not.
    Open(bool),
    /// It is divided where the linear function with these values at its corners is zero; if it is too small for that, it is not wanted.
    Divided([f64; 3]),
}

/// Parts of the root of the area of the smaller surface that edges of pieces are not cut below.
const FINEST: f64 = 2048.0;
/// Edges of pieces at most, in units of the finest length: a large piece is compared with many faces at once, which takes far longer than its
/// parts with few each.
const LARGEST: f64 = 32.0;
/// Pieces that are looked at together at most.
const MOST: usize = 1 << 20;
/// How often an edge may be halved, and a face be divided along lines: see [`Part::ROUNDING`].
const DEEPEST: u32 = 60;
const MOST_LINES: u8 = 16;

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
    /// Lines that it was divided along.
    lines: u8,
    /// The places of the first of its parts and of what follows the last; the same of a piece that is not cut.
    parts: [u32; 2],
    is_kept: bool,
}

impl Piece {
    fn new(of: u32, corners: [u32; 3]) -> Self {
        Self { of, corners, lines: 0, parts: [0; 2], is_kept: false }
    }

    fn parts(&self) -> Range<usize> {
        self.parts[0] as usize..self.parts[1] as usize
    }
}

/// The triangles of a part, halved.
struct Cutting {
    positions: Vec<[f64; 3]>,
    middles: HashMap<[u32; 2], u32>,
}

impl Cutting {
    /// What a piece is cut into; nothing where it is not cut.
    fn parts(&mut self, piece: Piece, fate: Fate, finest: f64) -> Vec<Piece> {
        let divided = match fate {
            Fate::Kept | Fate::LeftOut => return Vec::new(),
            Fate::Open(_) => None,
            Fate::Divided(values) => self.divided(piece, values, finest),
        };
        divided.or_else(|| self.halves(piece, finest).map(Vec::from)).unwrap_or_default()
    }

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
        let half = |corners| Piece { lines: piece.lines, ..Piece::new(piece.of, corners) };
        let is_new = !is_at(from) && !is_at(to);
        is_new.then(|| [half([from, middle, opposite]), half([middle, to, opposite])])
    }

    /// The parts of a piece on both sides of the line on which a linear function is zero, given by its values at the corners, if its longest edge is
    /// longer than a length and the line leaves something on both sides.
    fn divided(&mut self, piece: Piece, values: [f64; 3], finest: f64) -> Option<Vec<Piece>> {
        if piece.lines == MOST_LINES || !(finest > 0.0 && self.longest(&piece, finest).1 > 1.0) {
            return None;
        }
        let mut sides: [Vec<u32>; 2] = [Vec::with_capacity(4), Vec::with_capacity(4)];
        for i in 0..3 {
            let [from, to] = [i, (i + 1) % 3].map(|k| piece.corners[k]);
            let [value, next] = [i, (i + 1) % 3].map(|k| values[k]);
            if value >= 0.0 {
                sides[0].push(from);
            }
            if value <= 0.0 {
                sides[1].push(from);
            }
            if (value > 0.0 && next < 0.0) || (value < 0.0 && next > 0.0) {
                let at = self.between(from, to, value / (value - next))?;
                for side in &mut sides {
                    side.push(at);
                }
            }
        }
        let triangles =
            |side: &[u32]| (2..side.len()).map(|i| [side[0], side[i - 1], side[i]]).collect::<Vec<_>>();
        let [one, other] = sides.map(|side| triangles(&side));
        let part = |corners| Piece { lines: piece.lines + 1, ..Piece::new(piece.of, corners) };
        (!one.is_empty() && !other.is_empty()).then(|| one.into_iter().chain(other).map(part).collect())
    }

    /// A point of an edge, neither of whose ends it is.
    fn between(&mut self, from: u32, to: u32, t: f64) -> Option<u32> {
        let [p, q] = [from, to].map(|v| self.positions[v as usize]);
        let at = on_edge(p, q, t);
        (at != p && at != q).then(|| {
            self.positions.push(at);
            (self.positions.len() - 1) as u32
        })
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
        let mut pieces: Vec<Piece> = faces.map(|(of, corners)| Piece::new(of, *corners)).collect();
        let mut open = 0..pieces.len();
        let mut fates = judge(&self.mesh);
        for depth in 0.. {
            let may_cut = depth < DEEPEST && open.len() <= MOST;
            for (place, fate) in open.clone().zip(fates) {
                let parts = if may_cut { cutting.parts(pieces[place], fate, finest) } else { Vec::new() };
                if parts.is_empty() {
                    pieces[place].is_kept = matches!(fate, Fate::Kept | Fate::Open(true));
                } else {
                    pieces[place].parts = [pieces.len() as u32, (pieces.len() + parts.len()) as u32];
                    pieces.extend(parts);
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
            let parts = &pieces[pieces[place].parts()];
            if !parts.is_empty() {
                let kept = parts.iter().filter(|part| part.is_kept).count();
                let all = parts.len();
                any_cut |= kept > 0 && kept < all;
                pieces[place].is_kept = kept == all;
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
            if !piece.is_kept {
                next.extend(pieces[piece.parts()].iter().rev());
                continue;
            }
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
