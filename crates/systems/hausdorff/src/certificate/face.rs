//! The cut trees of faces of A: cells that a face of B is near.

use super::chord::{Place, dot, length, place, reach};
use super::encode::Block;
use pompeiu_core::geom::Frame;
use pompeiu_core::spatial::{Bvh, Neighbours, Slot, Workspace};
use pompeiu_verify::Pair;
use pompeiu_verify::kernel::{Corner, End, Facet, MOST_CORNERS, Point, whole};
use std::ops::Range;

/// What trees are made of.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scene<'s> {
    pub(super) pair: &'s Pair<'s>,
    pub(super) frame: &'s Frame,
    pub(super) bvh: &'s Bvh,
    pub(super) neighbours: Option<&'s Neighbours>,
    /// The vertices of each face of A, and a face of B near each vertex.
    pub(super) faces: &'s [[u32; 3]],
    pub(super) near: &'s [Slot],
    /// In the unit of the pair.
    pub(super) upper: f64,
    pub(super) most_cells: u64,
}

/// A corner of a polygon, and a face of B that is near it.
#[derive(Clone, Copy, Debug)]
struct Tagged {
    corner: Corner,
    slot: Slot,
}

/// A polygon that waits: where its corners start, and the face that covers it if one is known.
type Waiting = (usize, Option<Slot>);

/// Why a tree was not made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unfinished {
    /// A point of this face is farther from B, or rounding hides that it is not.
    Far(usize),
    /// More cells than allowed.
    Cells(usize),
}

/// Places in the table of faces of B that were used for the same face of A.
const REMEMBERED: usize = 64;
/// A polygon this many times as large as `upper` is cut along the sides of faces of B rather than where they are that far.
const FINE: f64 = 30.0;
/// A cut that takes away this part of a polygon is as good as any.
const ENOUGH: f64 = 0.2;
/// A cut that takes away less than this is none.
const LEAST: f64 = 0.02;
/// A polygon whose area is less than this part of the square of its extent is taken for a segment.
const FLAT: f64 = 1e-15;
/// Polygons that wait: fewer than a verifier allows.
const MOST_WAITING: usize = 900;

/// Makes trees, one face after the other.
pub(super) struct Trees<'s> {
    scene: Scene<'s>,
    block: Block,
    workspace: Workspace,
    facets: Vec<Option<(Slot, usize, Facet)>>,
    face: usize,
    /// Whether no cut was made in this face yet.
    is_untouched: bool,
    origin: Point,
    waiting: Vec<Waiting>,
    corners: Vec<Tagged>,
    last: Slot,
    candidates: Vec<(Slot, u64)>,
    scratch: Vec<Tagged>,
}

impl<'s> Trees<'s> {
    pub(super) fn new(scene: Scene<'s>) -> Self {
        Self {
            scene,
            block: Block::default(),
            workspace: Workspace::default(),
            facets: vec![None; REMEMBERED],
            face: usize::MAX,
            is_untouched: true,
            origin: [0.0; 3],
            waiting: Vec::new(),
            corners: Vec::new(),
            last: scene.bvh.any_slot(),
            candidates: Vec::new(),
            scratch: Vec::new(),
        }
    }

    /// The bytes of the block of these faces, and its cells.
    pub(super) fn block(mut self, faces: Range<usize>) -> Result<(Vec<u8>, u64), Unfinished> {
        for face in faces {
            self.tree(face)?;
        }
        Ok(self.block.finish())
    }

    fn tree(&mut self, face: usize) -> Result<(), Unfinished> {
        let corners = self.scene.pair.a.triangle(face);
        (self.face, self.origin) = (face, corners[0]);
        let tags = self.scene.faces[face].map(|v| self.scene.near[v as usize]);
        let corners = whole(corners);
        let mut polygon: Vec<Tagged> =
            corners.into_iter().zip(tags).map(|(corner, slot)| Tagged { corner, slot }).collect();
        let facet = self.facet(self.last);
        if corners.iter().all(|corner| facet.at_most(corner) <= self.scene.upper) {
            self.is_untouched = true;
            self.leaf(self.last);
            return Ok(());
        }
        let before = self.block.cells;
        let mut covered = None;
        self.is_untouched = true;
        loop {
            if let Some(slot) = covered {
                self.leaf(slot);
            } else {
                self.polygon(&mut polygon)?;
            }
            if self.block.cells - before > self.scene.most_cells || self.waiting.len() > MOST_WAITING {
                return Err(Unfinished::Cells(face));
            }
            self.is_untouched = false;
            let Some((start, known)) = self.waiting.pop() else { return Ok(()) };
            polygon.clear();
            polygon.extend(self.corners.drain(start..));
            covered = known;
        }
    }

    fn leaf(&mut self, slot: Slot) {
        self.last = slot;
        let face = self.scene.bvh.face(slot).0;
        if self.is_untouched {
            self.block.whole(face);
        } else {
            self.block.leaf(face);
        }
    }

    /// One node: a leaf if a face covers the polygon, else a cut whose parts wait.
    fn polygon(&mut self, polygon: &mut [Tagged]) -> Result<(), Unfinished> {
        let mut candidates = std::mem::take(&mut self.candidates);
        let done = self.node(polygon, &mut candidates);
        self.candidates = candidates;
        if done? { Ok(()) } else { self.halve(polygon) }
    }

    /// [`Self::polygon`] by faces near it; false if none helps.
    fn node(
        &mut self,
        polygon: &mut [Tagged],
        candidates: &mut Vec<(Slot, u64)>,
    ) -> Result<bool, Unfinished> {
        candidates.clear();
        for i in 0..polygon.len() {
            if self.covers(polygon[i].slot, polygon, candidates) {
                return Ok(true);
            }
        }
        let slot = self.nearest_to_centre(polygon, polygon[0].slot)?;
        if self.covers(slot, polygon, candidates) {
            return Ok(true);
        }
        Ok(polygon.len() + 6 < MOST_CORNERS && self.cut(polygon, candidates))
    }

    /// Makes a leaf if a face covers a polygon; else the face is a candidate, those that are near more corners first.
    fn covers(&mut self, slot: Slot, polygon: &[Tagged], candidates: &mut Vec<(Slot, u64)>) -> bool {
        if candidates.iter().any(|(other, _)| *other == slot) {
            return false;
        }
        let mask = self.covered(slot, polygon);
        if mask == (1_u64 << polygon.len()) - 1 {
            self.leaf(slot);
            return true;
        }
        let place = candidates.partition_point(|(_, other)| other.count_ones() >= mask.count_ones());
        candidates.insert(place, (slot, mask));
        false
    }

    /// The face of B nearest to the centre of a polygon, unless that shows that no certificate can be made.
    fn nearest_to_centre(&mut self, polygon: &[Tagged], start: Slot) -> Result<Slot, Unfinished> {
        let centre = centre(polygon);
        let (slot, distance) = self.nearest(centre, start);
        let x = Corner { offset: centre, radius: polygon[0].corner.radius };
        let doubt = self.facet(slot).at_most(&x) - distance;
        let is_tiny = extent(polygon) < doubt;
        if distance > self.scene.upper + doubt || (is_tiny && distance + doubt > self.scene.upper) {
            return Err(Unfinished::Far(self.face));
        }
        Ok(slot)
    }

    /// Cuts a polygon with the faces that are near some of its corners, if that helps.
    fn cut(&mut self, polygon: &[Tagged], candidates: &[(Slot, u64)]) -> bool {
        let is_fine = extent(polygon) > FINE * self.scene.upper;
        if is_fine && self.along_sides(polygon) {
            return true;
        }
        let measure = Measure::of(polygon);
        let whole = measure.size(polygon);
        let mut best: Option<(f64, [Cut; 2], Slot)> = None;
        for (slot, mask) in candidates.iter().copied().filter(|(_, mask)| *mask != 0) {
            let Some(ends) = self.carve(polygon, slot, mask) else { continue };
            self.scratch.clear();
            part(polygon, &ends[1], &ends[0], &mut self.scratch);
            let taken = measure.size(&self.scratch) / whole;
            self.scratch.clear();
            part(polygon, &ends[0], &ends[1], &mut self.scratch);
            let gain = match measure {
                Measure::Area => taken,
                // What is taken from the middle of a segment leaves it as long as it was.
                Measure::Extent => 1.0 - measure.size(&self.scratch) / whole,
            };
            if best.is_none_or(|best| gain > best.0) {
                best = Some((gain, ends, slot));
            }
            if gain > ENOUGH {
                break;
            }
            // However small: where two faces tie, what is left beside the line between them is cut off here or nowhere.
            let rest = std::mem::take(&mut self.scratch);
            let full = (1_u64 << rest.len()) - 1;
            let closes = [ends[0].at.slot, ends[1].at.slot]
                .into_iter()
                .find(|other| self.covered(*other, &rest) == full);
            self.scratch = rest;
            if closes.is_some() {
                self.chord(polygon, ends, [closes, Some(slot)]);
                return true;
            }
        }
        let much = best.filter(|best| best.0 > ENOUGH);
        if much.is_none() && !is_fine && self.along_sides(polygon) {
            return true;
        }
        let some = best.filter(|best| best.0 > LEAST);
        if let Some((_, ends, slot)) = some {
            self.chord(polygon, ends, [None, Some(slot)]);
        }
        some.is_some()
    }

    /// Which corners a face is near, as bits.
    fn covered(&mut self, slot: Slot, polygon: &[Tagged]) -> u64 {
        let (facet, upper) = (self.facet(slot), self.scene.upper);
        polygon
            .iter()
            .enumerate()
            .fold(0, |mask, (i, x)| mask | u64::from(facet.at_most(&x.corner) <= upper) << i)
    }

    /// The chord between the sides that lead away from what a face is near: where it is left, and where it is entered.
    fn carve(&mut self, polygon: &[Tagged], slot: Slot, mask: u64) -> Option<[Cut; 2]> {
        let n = polygon.len();
        let (first, count) = longest_run(mask, n);
        let last = (first + count - 1) % n;
        let leaving = self.end(polygon, slot, last, (last + 1) % n, true);
        let entering = self.end(polygon, slot, first, (first + n - 1) % n, false);
        if count + usize::from(leaving.0.t > 0.0) + usize::from(entering.0.t > 0.0) < 3 {
            return None;
        }
        let end = |place: &Place, corner: usize, is_forward: bool| match place.bytes {
            0 => End { side: corner, t: 0.0 },
            _ if is_forward => End { side: corner, t: place.t },
            _ => End { side: (corner + n - 1) % n, t: 1.0 - place.t },
        };
        let out = Cut { end: end(&leaving.0, last, true), bytes: leaving.0.bytes, at: tagged(leaving) };
        let back = Cut { end: end(&entering.0, first, false), bytes: entering.0.bytes, at: tagged(entering) };
        (out.end.side != back.end.side).then_some([out, back])
    }

    /// Where to leave a face on the way from a corner that it is near to one that it is not, and a face that is near there and goes on:
    /// at the first position, by its bytes, where there is one.
    fn end(
        &mut self,
        polygon: &[Tagged],
        slot: Slot,
        near: usize,
        far: usize,
        forward: bool,
    ) -> (Place, Slot) {
        let (facet, upper) = (self.facet(slot), self.scene.upper);
        let (p, q) = (&polygon[near], &polygon[far]);
        let t = reach(&facet, &p.corner, &q.corner, upper);
        let mut fallback = None;
        // Beyond three bytes a cell is won by luck only; where two faces tie, all seven are needed.
        for bytes in [1, 2, 3, 7] {
            let Some(place) = place(&p.corner, &q.corner, forward, t, bytes) else { continue };
            if facet.at_most(&place.corner) > upper {
                continue;
            }
            // A face known to be near the polygon saves looking for the nearest one.
            let mut tried = slot;
            for i in 0..polygon.len() {
                let other = polygon[(far + i) % polygon.len()].slot;
                if other != slot && other != tried && self.facet(other).at_most(&place.corner) <= upper {
                    return (place, other);
                }
                tried = other;
            }
            let (nearest, _) = self.nearest(place.corner.offset, q.slot);
            if nearest != slot && self.facet(nearest).at_most(&place.corner) <= upper {
                return (place, nearest);
            }
            fallback = Some((place, nearest));
        }
        let corner = Place { t: 0.0, bytes: 0, corner: p.corner };
        fallback.unwrap_or((corner, p.slot))
    }

    /// Cuts off what is outside of the prism over a face that is near the centre, along its sides, if the face is near what is left.
    fn along_sides(&mut self, polygon: &[Tagged]) -> bool {
        let centre = centre(polygon);
        let mut best = (f64::INFINITY, polygon[0].slot);
        for i in 0..polygon.len() {
            let slot = polygon[i].slot;
            if i == 0 || polygon[i - 1].slot != slot {
                let distance = length(self.facet(slot).to(centre));
                best = if distance < best.0 { (distance, slot) } else { best };
            }
        }
        if best.0 > self.scene.upper {
            let (slot, distance) = self.nearest(centre, best.1);
            best = (distance, slot);
        }
        let slot = best.1;
        let facet = self.facet(slot);
        let mut inner = polygon.to_vec();
        let mut cuts = Vec::with_capacity(3);
        let mut sides = 0;
        for side in 0..3 {
            let inward = facet.inward(side);
            let height =
                |x: &Tagged| dot(inward, [0, 1, 2].map(|k| x.corner.offset[k] - facet.corners[side][k]));
            let least = inner.iter().map(height).fold(f64::INFINITY, f64::min);
            // What reaches out by less than this is near the side.
            if least >= -0.25 * self.scene.upper * length(inward) {
                continue;
            }
            let bare: Vec<Corner> = inner.iter().map(|x| x.corner).collect();
            let Some(ends) = facet.crossing(side, &bare) else { return false };
            let across = self.scene.neighbours.and_then(|all| all.across(slot, side));
            let beyond = across.map_or(slot, |neighbour| neighbour.slot);
            let [out, back] = ends.map(|end| Cut::at(&inner, end, beyond));
            let mut outer = Vec::with_capacity(inner.len() + 2);
            part(&inner, &out, &back, &mut outer);
            let mut rest = Vec::with_capacity(inner.len() + 2);
            part(&inner, &back, &out, &mut rest);
            inner = rest;
            sides |= 1 << side;
            cuts.push(outer);
        }
        let is_near = inner.iter().all(|x| facet.at_most(&x.corner) <= self.scene.upper);
        // A part of the face or of the polygon has to be left.
        let corners = facet.corners.map(|offset| Tagged { corner: Corner { offset, radius: 0.0 }, slot });
        if sides == 0 || !is_near || area(&inner) < LEAST * area(&corners).min(area(polygon)) {
            return false;
        }
        self.last = slot;
        self.block.carve(self.scene.bvh.face(slot).0, sides);
        for outer in cuts {
            self.waiting.push((self.corners.len(), None));
            self.corners.extend(outer);
        }
        true
    }

    /// Cuts from the middle of the longest side to the farthest corner, with what is nearest to the corners as it is now.
    fn halve(&mut self, polygon: &mut [Tagged]) -> Result<(), Unfinished> {
        let n = polygon.len();
        for x in polygon.iter_mut() {
            x.slot = self.nearest(x.corner.offset, x.slot).0;
        }
        let slot = self.nearest_to_centre(polygon, polygon[0].slot)?;
        let gap = |i: usize, j: usize| {
            length([0, 1, 2].map(|k| polygon[i].corner.offset[k] - polygon[j].corner.offset[k]))
        };
        let side =
            (0..n).fold(0, |best, i| if gap(i, (i + 1) % n) > gap(best, (best + 1) % n) { i } else { best });
        let middle = Cut { bytes: 1, ..Cut::at(polygon, End { side, t: 0.5 }, slot) };
        let (from, to) = (polygon[side].corner.offset, polygon[(side + 1) % n].corner.offset);
        // A corner on the line of the side would cut nothing off. Of a polygon without area all corners lie on it: then the farthest will do.
        let is_flat = matches!(Measure::of(polygon), Measure::Extent);
        let away = |i: usize| {
            let x = polygon[i].corner.offset;
            if is_flat { gap(i, side) + gap(i, (side + 1) % n) } else { length(double_area([from, to, x])) }
        };
        let others = (2..n).map(|i| (side + i) % n);
        let Some(corner) = others.reduce(|best, i| if away(i) > away(best) { i } else { best }) else {
            return Err(Unfinished::Far(self.face));
        };
        let opposite = Cut::at(polygon, End { side: corner, t: 0.0 }, polygon[corner].slot);
        self.chord(polygon, [middle, opposite], [None, None]);
        Ok(())
    }

    /// Writes a chord; both parts wait: the one from the first end to the second, and the other, with the faces that cover them.
    fn chord(&mut self, polygon: &[Tagged], [first, second]: [Cut; 2], covered: [Option<Slot>; 2]) {
        let (ends, covered) = if first.end.side < second.end.side {
            ([first, second], covered)
        } else {
            ([second, first], [covered[1], covered[0]])
        };
        self.block.chord(polygon.len(), ends.map(|cut| (cut.end, cut.bytes)));
        // What comes in last comes out first.
        for (from, to, covered) in [(ends[1], ends[0], covered[1]), (ends[0], ends[1], covered[0])] {
            self.waiting.push((self.corners.len(), covered));
            part(polygon, &from, &to, &mut self.corners);
        }
    }

    fn facet(&mut self, slot: Slot) -> Facet {
        let place = &mut self.facets[slot.index() % REMEMBERED];
        if let Some((known, face, facet)) = place
            && *known == slot
            && *face == self.face
        {
            return *facet;
        }
        let corners = self.scene.pair.b.triangle(self.scene.bvh.face(slot).index());
        let facet = Facet::new(corners, self.origin);
        *place = Some((slot, self.face, facet));
        facet
    }

    /// The face of B nearest to a point, and how far it is.
    fn nearest(&mut self, offset: Point, start: Slot) -> (Slot, f64) {
        let p = [0, 1, 2].map(|k| self.scene.pair.unscaled(self.origin[k] + offset[k]));
        let found = self.scene.bvh.nearest(self.scene.frame.map(p), start, &mut self.workspace);
        (found.slot, length(self.facet(found.slot).to(offset)))
    }
}

fn tagged((place, slot): (Place, Slot)) -> Tagged {
    Tagged { corner: place.corner, slot }
}

/// An end of a chord.
#[derive(Clone, Copy, Debug)]
struct Cut {
    end: End,
    bytes: u32,
    at: Tagged,
}

impl Cut {
    /// The end with the corner that a verifier finds there.
    fn at(polygon: &[Tagged], end: End, slot: Slot) -> Self {
        let (p, q) = (&polygon[end.side], &polygon[(end.side + 1) % polygon.len()]);
        let corner = if end.t == 0.0 {
            p.corner
        } else {
            pompeiu_verify::kernel::between(&p.corner, &q.corner, end.t)
        };
        Self { end, bytes: 0, at: Tagged { corner, slot } }
    }
}

/// [`pompeiu_verify::kernel::part`] of corners with their faces.
fn part(polygon: &[Tagged], from: &Cut, to: &Cut, into: &mut Vec<Tagged>) {
    into.push(from.at);
    let mut i = from.end.side;
    while i != to.end.side {
        i = (i + 1) % polygon.len();
        into.push(polygon[i]);
    }
    if to.end.t != 0.0 {
        into.push(to.at);
    }
}

/// The first of the longest run of bits that are set, round a circle of `n`, and its length; not all are set.
fn longest_run(mask: u64, n: usize) -> (usize, usize) {
    let is_set = |i: usize| mask >> (i % n) & 1 == 1;
    let mut best = (0, 0);
    for first in (0..n).filter(|i| is_set(*i) && !is_set(i + n - 1)) {
        let count = (0..n).take_while(|i| is_set(first + i)).count();
        best = if count > best.1 { (first, count) } else { best };
    }
    best
}

fn centre(polygon: &[Tagged]) -> Point {
    [0, 1, 2].map(|k| polygon.iter().map(|x| x.corner.offset[k]).sum::<f64>() / polygon.len() as f64)
}

/// The longest side of the box around a polygon.
fn extent(polygon: &[Tagged]) -> f64 {
    let of = |k: usize| polygon.iter().map(move |x| x.corner.offset[k]);
    let span = |k| of(k).fold(f64::NEG_INFINITY, f64::max) - of(k).fold(f64::INFINITY, f64::min);
    span(0).max(span(1)).max(span(2))
}

/// How much of a polygon a part is.
#[derive(Clone, Copy, Debug)]
enum Measure {
    Area,
    /// Of a polygon that is a segment but for rounding, no part has more area than another.
    Extent,
}

impl Measure {
    fn of(polygon: &[Tagged]) -> Self {
        let extent = extent(polygon);
        if area(polygon) > FLAT * extent * extent { Self::Area } else { Self::Extent }
    }

    fn size(self, polygon: &[Tagged]) -> f64 {
        match self {
            Self::Area => area(polygon),
            Self::Extent => extent(polygon),
        }
    }
}

/// Twice the area of a polygon.
fn area(polygon: &[Tagged]) -> f64 {
    let from = polygon[0].corner.offset;
    let double = polygon.windows(2).skip(1).fold([0.0; 3], |sum, pair| {
        let more = double_area([from, pair[0].corner.offset, pair[1].corner.offset]);
        [sum[0] + more[0], sum[1] + more[1], sum[2] + more[2]]
    });
    length(double)
}

/// The normal of a triangle, twice as long as its area.
fn double_area([from, p, q]: [Point; 3]) -> Point {
    let [p, q] = [p, q].map(|x| [x[0] - from[0], x[1] - from[1], x[2] - from[2]]);
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
}
