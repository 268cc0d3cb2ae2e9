//! Parts of a face T of A cut into cells, each over one face of B, by walking over B from face to face.
//!
//! At an edge that two faces of B share, T is cut by the plane through the edge that bisects the angle between them: where both are
//! equally far. Where the distance changes its side of a face, the cell is cut along the plane of that face.
//!
//! # What is proven
//! Cells partition T, wherever the cuts are. On a cell over F:
//! * **above:** the distance from F is convex, so the interpolation of the exact distances of the corners from F lies above it;
//! * **below:** the distance from B is nowhere less than the least of a few linear functions, one for each plane behind which faces
//!   around F lie (`facets`), so the interpolation of that least lies below it.
//!
//! Where the two are too far from each other, the cell is compared with the faces around it one by one (`compare`).

use super::candidates::{Linear, Scale};
use super::compare::{Cell, Compare, Compared, range};
use super::criterion::Criterion;
use super::envelope::distances;
use super::facets::Facets;
use super::polygon::{MOST_CORNERS, Outline, Piece, Polygon, Row};
use super::walk::Walk;
use crate::rounding::Rounding;
use glam::DVec3;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::{Bvh, Neighbours, Slot, Workspace};

/// A part of a face of A and a face of B that may be near it.
#[derive(Clone, Copy)]
pub(super) struct Rest {
    pub(super) outline: Outline,
    pub(super) near: Slot,
}

/// A part that is yet to be cut, over a face of B.
#[derive(Clone, Copy)]
struct Part {
    outline: Outline,
    slot: Slot,
    walk: Walk,
}

/// When to leave what is left as it is.
#[derive(Clone, Copy)]
pub(super) struct Limits<'l> {
    /// Pieces.
    pub(super) most: usize,
    pub(super) control: &'l Control,
}

/// How often the planes around a face of B have made a cell of a task narrow enough: where distances are several times the size of faces,
/// what is nearest are edges and corners, and they hardly ever do.
#[derive(Default)]
struct Success {
    cells: u32,
    tried: u32,
    narrow: u32,
}

impl Success {
    /// Cells that are tried before that is judged.
    const FIRST: u32 = 16;
    /// The part of them, as its inverse, that must come out narrow enough for others to be tried; of these one in so many is tried anyway.
    const OF_TRIED: u32 = 2;
    const ANYWAY: u32 = 16;

    /// Whether another cell should be tried, which is counted.
    fn is_likely(&mut self) -> bool {
        self.cells += 1;
        let is_likely = self.tried < Self::FIRST
            || Self::OF_TRIED * self.narrow >= self.tried
            || self.cells.is_multiple_of(Self::ANYWAY);
        self.tried += u32::from(is_likely);
        is_likely
    }
}

/// A face of A, and what is wanted of its pieces.
#[derive(Clone, Copy)]
pub(super) struct Task<'t> {
    pub(super) scale: &'t Scale,
    pub(super) criterion: &'t Criterion,
    pub(super) area: f64,
}

/// Cuts parts of faces of A into cells, and memory for that.
pub(super) struct Cells<'b> {
    bvh: &'b Bvh,
    facets: Facets<'b>,
    compare: Compare<'b>,
    parts: Vec<Part>,
    wide: Vec<Cell>,
    again: Vec<Part>,
    success: Success,
    /// What is left.
    pub(super) rest: Vec<Rest>,
}

/// Cells that are made before those that came out wide are compared with the faces around them.
const MOST_CELLS: usize = 64;
/// A part whose area is more than this many times that of the face of B it is over is halved before it is cut. So is one whose longest way, squared,
/// is as many times the longest edge of that face: a thin part over many faces has more of them along its way than steps may lead.
const MOST_AREA: f64 = 64.0;
/// Where planes are farther than this many times the area of their faces, squared, what is nearest are edges and vertices as a rule.
const FARTHEST: f64 = 16.0;
/// Where cells are farther than this many times the area of their faces, squared, many faces are around each: to make planes in front of them
/// takes longer than to compare its few cells with them.
const FARTHEST_OF_FACETS: f64 = 1.5;
/// Small parts may be wider than the whole face, by this factor.
const MOST_WIDTH: f64 = 8.0;
/// What hangs over an edge or a plane so little that this part of the allowed width comes of it is no reason for a cut.
const OVERHANG: f64 = 0.125;
/// A part of which no more than this lies on this side of an edge, by its extents across, lies beyond.
const LEAST_STRIP: f64 = 1e-9;

impl<'b> Cells<'b> {
    /// `mean` is about the mean distance.
    pub(super) fn new(bvh: &'b Bvh, neighbours: &'b Neighbours, rounding: Rounding, mean: f64) -> Self {
        Self {
            bvh,
            facets: Facets::new(bvh, neighbours, rounding, mean),
            compare: Compare::new(bvh),
            parts: Vec::new(),
            wide: Vec::new(),
            again: Vec::new(),
            success: Success::default(),
            rest: Vec::new(),
        }
    }

    /// Begins with other faces of A: what becomes of them does not depend on the ones before.
    pub(super) fn begin_task(&mut self) {
        self.success = Success::default();
    }

    /// Cuts parts of a face of A, each with a face of B near it, into cells that are narrow enough, and what is left.
    pub(super) fn cut(
        &mut self,
        task: Task<'_>,
        parts: &[Rest],
        limits: Limits<'_>,
        workspace: &mut Workspace,
        pieces: &mut Vec<Piece>,
    ) {
        self.rest.clear();
        self.again.clear();
        self.again.extend(parts.iter().map(|&Rest { outline, near }| Part {
            outline,
            slot: near,
            walk: Walk::new(near),
        }));
        while let Some(part) = self.again.pop() {
            if pieces.len() + self.again.len() + self.rest.len() >= limits.most || limits.control.is_stopped()
            {
                self.rest.push(Rest { outline: part.outline, near: part.slot });
                continue;
            }
            self.wide.clear();
            self.parts.clear();
            self.parts.push(part);
            let before = pieces.len();
            while let Some(part) = self.parts.pop() {
                if self.wide.len() + pieces.len() - before >= MOST_CELLS {
                    self.again.push(part);
                } else {
                    self.clip(part, task, workspace, pieces);
                }
            }
            self.look_closer(task, pieces);
        }
    }

    /// Cuts off what lies beyond the edges of a face, and makes a cell of what is left.
    fn clip(&mut self, part: Part, task: Task<'_>, workspace: &mut Workspace, pieces: &mut Vec<Piece>) {
        let Task { scale, criterion, area } = task;
        let Part { mut outline, slot, walk } = part;
        let facet = self.facets.facet(slot);
        if facet.normal == DVec3::ZERO {
            self.rest.push(Rest { outline, near: slot });
            return;
        }
        let height = scale.along(facet.normal, facet.corners[0]);
        let edges = facet.edges.map(|edge| (scale.along(edge.outward, edge.from), edge.across));
        let at_centre = height.at(outline.centre());
        if at_centre * at_centre > FARTHEST * facet.area {
            // Far beside a face its plane says nothing about how far B is.
            self.go_to_nearest(part, scale, workspace);
            return;
        }
        let share = outline.share() * area;
        let (width, most) = (criterion.width_of(share), MOST_WIDTH * criterion.width_of(area));
        let width = if width < most { width } else { most };
        if walk.may_halve()
            && (share > MOST_AREA * facet.area
                || outline.longest_way(scale).0.length_squared() > MOST_AREA * facet.longest_edge_sq()
                || walk.is_too_long() && self.is_elsewhere(&outline, slot, width, scale, workspace))
            && let Some(halves) = outline.halve(scale)
        {
            for outline in halves {
                let slot = self.nearest(&outline, slot, scale, workspace);
                self.parts.push(Part { outline, slot, walk: walk.half(slot) });
            }
            return;
        }
        let mut tried = [walk.is_over(); 3];
        loop {
            let (low, high) = range(&height.row(&outline));
            let distance = if high > -low { high } else { -low };
            let beside = OVERHANG * width;
            let mut worst = (beside + (beside * beside + 2.0 * beside * distance).sqrt(), None);
            for k in 0..3 {
                if tried[k] {
                    continue;
                }
                let row = edges[k].0.row(&outline);
                let (least, most) = range(&row);
                if most > worst.0 {
                    worst = (most, Some((k, row, least)));
                }
            }
            let (most, Some((k, row, least))) = worst else { break };
            let across = edges[k].1;
            // All of it lies beyond, but for a strip.
            if least >= -LEAST_STRIP * most {
                self.step(outline, across, part, scale, workspace);
                return;
            }
            if outline.count == MOST_CORNERS {
                match outline.cut_apart() {
                    Some(parts) => {
                        self.parts.extend(parts.map(|outline| Part { outline, walk: walk.cut(), ..part }));
                    }
                    None => self.rest.push(Rest { outline, near: slot }),
                }
                return;
            }
            match outline.cut(&row) {
                Some([out, inside]) => {
                    self.step(out, across, part, scale, workspace);
                    outline = inside;
                }
                None => tried[k] = true,
            }
        }
        let row = height.row(&outline);
        let (low, high) = range(&row);
        let sides = if low < -OVERHANG * width && high > OVERHANG * width { outline.cut(&row) } else { None };
        let part = Part { outline, ..part };
        match sides {
            Some([above, below]) => {
                for outline in [above, below] {
                    self.cell(Part { outline, ..part }, &height, width, task, workspace, pieces);
                }
            }
            None => self.cell(part, &height, width, task, workspace, pieces),
        }
    }

    /// What of a part lies beyond an edge goes to the face across it, or to the nearest where there is none, as in meshes whose faces share no
    /// vertices.
    fn step(
        &mut self,
        outline: Outline,
        across: Option<Slot>,
        part: Part,
        scale: &Scale,
        workspace: &mut Workspace,
    ) {
        match across {
            Some(slot) => self.parts.push(Part { outline, slot, walk: part.walk.to(slot) }),
            None => self.go_to_nearest(Part { outline, ..part }, scale, workspace),
        }
    }

    /// Goes on over the face nearest to the centre of a part, if that is another one and the way not over.
    fn go_to_nearest(
        &mut self,
        Part { outline, slot, walk }: Part,
        scale: &Scale,
        workspace: &mut Workspace,
    ) {
        let near = self.nearest(&outline, slot, scale, workspace);
        if near == slot || walk.is_over() {
            self.rest.push(Rest { outline, near });
        } else {
            self.parts.push(Part { outline, slot: near, walk: walk.to(near) });
        }
    }

    /// The face nearest to the centre of a part, sought from this one.
    fn nearest(&self, outline: &Outline, from: Slot, scale: &Scale, workspace: &mut Workspace) -> Slot {
        self.bvh.nearest(scale.point(outline.centre()).to_array(), from, workspace).slot
    }

    /// Whether the centre of a part is nearer to another face than to this one by more than a width.
    #[cold]
    fn is_elsewhere(
        &self,
        outline: &Outline,
        slot: Slot,
        width: f64,
        scale: &Scale,
        workspace: &mut Workspace,
    ) -> bool {
        let centre = scale.point(outline.centre()).to_array();
        let nearest = self.bvh.nearest(centre, slot, workspace).distance_sq.sqrt();
        self.bvh.distance_sq(centre, slot).sqrt() > nearest + width
    }

    /// Bounds the distance on a cell. `height` is that over the plane of its face.
    fn cell(
        &mut self,
        Part { outline, slot, walk }: Part,
        height: &Linear,
        width: f64,
        Task { scale, criterion, area }: Task<'_>,
        workspace: &mut Workspace,
        pieces: &mut Vec<Piece>,
    ) {
        let points = scale.points(&outline);
        let margin = scale.margin + scale.displacement(&outline);
        let upper: Row =
            distances(self.bvh, slot, &points, outline.count, workspace).map(|distance| distance + margin);
        let most = range(&upper).1;
        let below = height.at(outline.centre()) < 0.0;
        let is_near = most * most <= FARTHEST_OF_FACETS * self.facets.facet(slot).area;
        if is_near
            && self.success.is_likely()
            && let Some(row) = self.facets.below(slot, below, most + margin, &points)
        {
            let mut polygon = Polygon::unknown(outline, 0.0);
            polygon.upper = upper;
            polygon.lower = row.map(|x| x - margin);
            if criterion.width_unless_met(&polygon, &outline.weights(), area).is_none() {
                self.success.narrow += 1;
                pieces.push(Piece { polygon, near: slot });
                return;
            }
        }
        self.wide.push(Cell { outline, slot, walk, points, upper, most, width });
    }

    /// Compares the cells that came out too wide with the faces around them.
    fn look_closer(&mut self, Task { scale, criterion, area }: Task<'_>, pieces: &mut Vec<Piece>) {
        if self.wide.is_empty() {
            return;
        }
        self.compare.begin(&self.wide, scale);
        for i in 0..self.wide.len() {
            let Cell { outline, slot, walk, .. } = self.wide[i];
            let parts = match self.compare.bound(&self.wide[i], scale) {
                Some(Compared { polygon, blocking }) => {
                    if criterion.width_unless_met(&polygon, &outline.weights(), area).is_none() {
                        pieces.push(Piece { polygon, near: slot });
                        continue;
                    }
                    blocking.filter(|_| !walk.is_over() && outline.count < MOST_CORNERS).and_then(
                        |blocking| {
                            let (there, own) = blocking.divide(&outline)?;
                            Some((there, blocking.slot, own))
                        },
                    )
                }
                None => None,
            };
            match parts {
                Some((there, other, own)) => {
                    self.again.push(Part { outline: there, slot: other, walk: walk.aside() });
                    let walk = if own[1].is_some() { walk.cut() } else { walk.aside() };
                    self.again.extend(own.into_iter().flatten().map(|outline| Part { outline, slot, walk }));
                }
                None => self.rest.push(Rest { outline, near: slot }),
            }
        }
    }
}

impl Outline {
    /// The longest way between two corners, and which.
    pub(super) fn longest_way(&self, scale: &Scale) -> (DVec3, usize, usize) {
        let mut longest = (DVec3::ZERO, 0, 0);
        for i in 0..self.count {
            for j in i + 1..self.count {
                let way = self.way(i, j, scale);
                if way.length_squared() > longest.0.length_squared() {
                    longest = (way, i, j);
                }
            }
        }
        longest
    }

    fn way(&self, i: usize, j: usize, scale: &Scale) -> DVec3 {
        scale.way([self.v[j] - self.v[i], self.w[j] - self.w[i]])
    }

    /// Cuts across the longest way between two corners, in the middle.
    fn halve(&self, scale: &Scale) -> Option<[Self; 2]> {
        let (along, i, j) = self.longest_way(scale);
        let side = |k| along.dot(self.way(i, k, scale)) + along.dot(self.way(j, k, scale));
        self.cut(&std::array::from_fn(side))
    }
}
