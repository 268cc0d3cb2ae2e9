//! Parts of a face T of A cut into cells, each over one face of B, by walking over B from face to face.
//!
//! At an edge that two faces of B share, T is cut by the plane through the edge that bisects the angle between them: where both are
//! equally far. Where the distance changes its side of a face, the cell is cut along the plane of that face.
//!
//! # What is proven
//! Cells partition T, wherever the cuts are. On a cell over F:
//! * **above:** the distance from F is convex, so the interpolation of the exact distances of the corners from F lies above it;
//! * **below:** faces behind the plane of F, raised by their greatest rise over it, are no nearer than that plane; each other face
//!   is no nearer than a plane of its own (`candidates`); and faces that do not meet the box around the cell, widened by the greatest
//!   value above, are no nearer than that value, while the function below is nowhere greater, because F lies behind its plane.
//!
//! Where the two are too far from each other, the part is left to `envelope`.

use super::behind::{Plane, rising};
use super::candidates::{Candidate, Scale};
use super::envelope::{distances, unit};
use super::goal::Goal;
use super::polygon::{MOST_CORNERS, Outline, Piece, Polygon, Row};
use glam::DVec3;
use pompeiu_core::geom::Aabb;
use pompeiu_core::geom::point_triangle::closest_barycentric;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::bvh::Leaf;
use pompeiu_core::spatial::{Bvh, Neighbours, Slot, Workspace};

/// A part of a face of A and a face of B that may be near it.
#[derive(Clone, Copy)]
pub(super) struct Rest {
    pub(super) outline: Outline,
    pub(super) near: Slot,
}

/// A part that is yet to be cut, after so many steps from face to face.
#[derive(Clone, Copy)]
struct Part {
    outline: Outline,
    slot: Slot,
    steps: u32,
}

/// A part over one face of B.
#[derive(Clone, Copy)]
struct Cell {
    outline: Outline,
    /// Its place among the faces that were met.
    face: usize,
    steps: u32,
    /// Distances of the corners from the face, with their margin, and the greatest.
    upper: Row,
    most: f64,
    /// The width that may be left.
    width: f64,
}

/// A face of B, and what is beyond its edges.
struct Face {
    plane: Candidate,
    area: f64,
    edges: [Edge; 3],
}

#[derive(Clone, Copy)]
struct Edge {
    /// How far beyond the edge, about: positive where the face across is nearer.
    beyond: super::candidates::Linear,
    across: Option<Slot>,
}

/// When to leave what is left as it is.
#[derive(Clone, Copy)]
pub(super) struct Limits<'l> {
    /// Pieces.
    pub(super) most: usize,
    pub(super) control: &'l Control,
}

/// Cuts parts of faces of A into cells, and memory for that.
pub(super) struct Cells<'b> {
    bvh: &'b Bvh,
    neighbours: &'b Neighbours,
    faces: Vec<Face>,
    others: Vec<Candidate>,
    parts: Vec<Part>,
    made: Vec<Cell>,
    again: Vec<Part>,
    leaves: Vec<(Leaf, Aabb)>,
    walk: Vec<u32>,
    rising: Vec<Slot>,
    /// What is left.
    pub(super) rest: Vec<Rest>,
}

/// Cells that are made before they are compared with the faces around them.
const MOST_CELLS: usize = 64;
/// A part whose area is more than this many times that of the face of B it is over is halved before it is cut.
const MOST_AREA: f64 = 64.0;
/// Where planes are farther than this many times the area of their faces, squared, what is nearest are edges and vertices as a rule.
const FARTHEST: f64 = 16.0;
/// Steps from face to face on the way to a cell.
const MOST_STEPS: u32 = 40;
/// Steps that a cut by a face which is not across an edge counts.
const STEPS_OF_BISECTOR: u32 = 10;
/// Steps that halving counts.
const STEPS_OF_HALVES: u32 = 3;
/// Leaves around a part, at most.
const MOST_LEAVES: usize = 512;
/// Small parts may be wider than the whole face, by this factor.
const MOST_WIDTH: f64 = 8.0;
/// What hangs over an edge or a plane so little that this part of the allowed width comes of it is no reason for a cut.
const OVERHANG: f64 = 0.125;
/// Part of the allowed width by which planes are lowered for faces that rise over them.
const RISE: f64 = 0.15;
/// The squared length of the sum of the unit normals of two faces at an edge, at least: beyond, they are folded onto each other.
const LEAST_OPENING: f64 = 0.5;

impl<'b> Cells<'b> {
    pub(super) fn new(bvh: &'b Bvh, neighbours: &'b Neighbours) -> Self {
        Self {
            bvh,
            neighbours,
            faces: Vec::new(),
            others: Vec::new(),
            parts: Vec::new(),
            made: Vec::new(),
            again: Vec::new(),
            leaves: Vec::new(),
            walk: Vec::new(),
            rising: Vec::new(),
            rest: Vec::new(),
        }
    }

    /// Cuts a whole face of A with this area into cells that are narrow enough, and what is left.
    #[allow(clippy::too_many_arguments, reason = "a face, what is wanted of it, and memory")]
    pub(super) fn cut(
        &mut self,
        scale: &Scale,
        near: Slot,
        goal: &Goal,
        area: f64,
        limits: Limits<'_>,
        workspace: &mut Workspace,
        pieces: &mut Vec<Piece>,
    ) {
        self.rest.clear();
        self.again.clear();
        self.again.push(Part { outline: Outline::WHOLE, slot: near, steps: 0 });
        while let Some(part) = self.again.pop() {
            if pieces.len() + self.again.len() + self.rest.len() >= limits.most || limits.control.is_stopped()
            {
                self.rest.push(Rest { outline: part.outline, near: part.slot });
                continue;
            }
            self.faces.clear();
            self.others.clear();
            self.made.clear();
            self.parts.clear();
            self.parts.push(part);
            while let Some(part) = self.parts.pop() {
                if self.made.len() >= MOST_CELLS {
                    self.again.push(part);
                } else {
                    self.clip(part, scale, goal, area, workspace);
                }
            }
            self.compare(scale, goal, area, pieces);
        }
    }

    /// The place of a face among those that were met.
    fn face(&mut self, slot: Slot, scale: &Scale) -> usize {
        if let Some(known) = self.faces.iter().position(|face| face.plane.slot == slot) {
            return known;
        }
        let plane = Candidate::new(slot, self.bvh.corners(slot), scale);
        let corners = plane.corners;
        let edges = [0, 1, 2].map(|k| {
            let (p, q) = (corners[k], corners[(k + 1) % 3]);
            let opened = self.neighbours.across(slot, k).and_then(|across| {
                let [a, b, c] = self.bvh.corners(across.slot).map(DVec3::from_array);
                let normal = (b - a).cross(c - a).normalize_or_zero();
                let both = plane.normal + if across.same_direction { -normal } else { normal };
                (both.length_squared() > LEAST_OPENING).then_some((across.slot, both))
            });
            let outward = |normal: DVec3| scale.along((q - p).cross(normal).normalize_or_zero(), p);
            match opened {
                Some((across, both)) => Edge { beyond: outward(both), across: Some(across) },
                None => Edge { beyond: outward(plane.normal), across: None },
            }
        });
        let area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).length();
        self.faces.push(Face { plane, area, edges });
        self.faces.len() - 1
    }

    /// Cuts off what lies beyond the edges of a face, and makes a cell of what is left.
    fn clip(&mut self, part: Part, scale: &Scale, goal: &Goal, area: f64, workspace: &mut Workspace) {
        let Part { mut outline, slot, steps } = part;
        let index = self.face(slot, scale);
        if !self.faces[index].plane.is_usable() {
            self.rest.push(Rest { outline, near: slot });
            return;
        }
        let face = &self.faces[index];
        let height = face.plane.height.at(outline.centre());
        if height * height > FARTHEST * face.area {
            self.rest.push(Rest { outline, near: slot });
            return;
        }
        let share = outline.share() * area;
        if steps <= MOST_STEPS
            && share > MOST_AREA * face.area
            && let Some(halves) = outline.halve(scale)
        {
            for outline in halves {
                let near = self.bvh.nearest(scale.point(outline.centre()).to_array(), slot, workspace);
                self.parts.push(Part { outline, slot: near.slot, steps: steps + STEPS_OF_HALVES });
            }
            return;
        }
        let (width, most) = (goal.width_of(share), MOST_WIDTH * goal.width_of(area));
        let width = if width < most { width } else { most };
        let mut tried = [steps > MOST_STEPS; 3];
        loop {
            let face = &self.faces[index];
            let (low, high) = range(&face.plane.height.row(&outline));
            let distance = if high > -low { high } else { -low };
            let beside = OVERHANG * width;
            let mut worst = (beside + (beside * beside + 2.0 * beside * distance).sqrt(), None);
            for k in 0..3 {
                if tried[k] {
                    continue;
                }
                let row = face.edges[k].beyond.row(&outline);
                let (least, most) = range(&row);
                if most > worst.0 {
                    worst = (most, Some((k, row, least)));
                }
            }
            let (most, Some((k, row, least))) = worst else { break };
            let across = face.edges[k].across;
            // All of it lies beyond, but for a strip.
            if least >= -LEAST_STRIP * most {
                self.step(outline, slot, across, steps);
                return;
            }
            if outline.count == MOST_CORNERS {
                for outline in outline.cut_along_diagonal().into_iter().flatten() {
                    self.parts.push(Part { outline, slot, steps: steps + 1 });
                }
                return;
            }
            match outline.cut(&row) {
                Some([out, inside]) => {
                    self.step(out, slot, across, steps);
                    outline = inside;
                }
                None => tried[k] = true,
            }
        }
        let height = self.faces[index].plane.height.row(&outline);
        let (low, high) = range(&height);
        if low < -OVERHANG * width
            && high > OVERHANG * width
            && let Some(sides) = outline.cut(&height)
        {
            for side in sides {
                self.cell(side, index, steps, scale, width, workspace);
            }
        } else {
            self.cell(outline, index, steps, scale, width, workspace);
        }
    }

    fn step(&mut self, outline: Outline, slot: Slot, across: Option<Slot>, steps: u32) {
        match across {
            Some(slot) => self.parts.push(Part { outline, slot, steps: steps + 1 }),
            None => self.rest.push(Rest { outline, near: slot }),
        }
    }

    fn cell(
        &mut self,
        outline: Outline,
        face: usize,
        steps: u32,
        scale: &Scale,
        width: f64,
        workspace: &mut Workspace,
    ) {
        let slot = self.faces[face].plane.slot;
        let points = scale.points(&outline);
        let margin = scale.margin + scale.displacement(&outline);
        let upper =
            distances(self.bvh, slot, &points, outline.count, workspace).map(|distance| distance + margin);
        let most = range(&upper).1;
        self.made.push(Cell { outline, face, steps, upper, most, width });
    }

    /// Compares the cells with the faces around them.
    fn compare(&mut self, scale: &Scale, goal: &Goal, area: f64, pieces: &mut Vec<Piece>) {
        let mut lower = [f64::INFINITY; 3];
        let mut upper = [f64::NEG_INFINITY; 3];
        for cell in &self.made {
            let (l, u) = around(scale, cell);
            for k in 0..3 {
                lower[k] = if l[k] < lower[k] { l[k] } else { lower[k] };
                upper[k] = if u[k] > upper[k] { u[k] } else { upper[k] };
            }
        }
        self.leaves.clear();
        self.bvh.leaves_meeting(lower, upper, &mut self.walk, &mut self.leaves);
        let many = self.leaves.len() > MOST_LEAVES;
        for index in 0..self.made.len() {
            let cell = self.made[index];
            let slot = self.faces[cell.face].plane.slot;
            let weights = cell.outline.weights();
            let mut polygon = Polygon::unknown(cell.outline, 0.0);
            polygon.upper = cell.upper;
            if many {
                self.rest.push(Rest { outline: cell.outline, near: slot });
                continue;
            }
            let blocking = self.below(&cell, &mut polygon, scale);
            if goal.wanted(&polygon, &weights, area).is_none() {
                pieces.push(Piece { polygon, near: slot });
                continue;
            }
            let parts = blocking.filter(|_| cell.steps <= MOST_STEPS).and_then(|(other, side)| {
                (cell.outline.count < MOST_CORNERS)
                    .then(|| cell.outline.cut(&side))
                    .flatten()
                    .map(|p| (other, p))
            });
            match parts {
                Some((other, [there, here])) => {
                    let steps = cell.steps + STEPS_OF_BISECTOR;
                    self.again.push(Part { outline: there, slot: other, steps });
                    self.again.push(Part { outline: here, slot, steps });
                }
                None => self.rest.push(Rest { outline: cell.outline, near: slot }),
            }
        }
    }

    /// Bounds a cell from below. Returns the face that keeps it from being as narrow as wanted, and where that is nearer.
    fn below(&mut self, cell: &Cell, polygon: &mut Polygon, scale: &Scale) -> Option<(Slot, Row)> {
        let outline = &cell.outline;
        let plane = self.faces[cell.face].plane;
        let at = outline.centre();
        let margin = scale.margin + scale.displacement(outline);
        let g = if plane.height.at(at) < 0.0 { -plane.normal } else { plane.normal };
        let (lower, upper) = around(scale, cell);
        let through = plane.corners[0];
        let rise = RISE * cell.width + 2.0 * margin;
        self.rising.clear();
        let highest = rising(
            self.bvh,
            &self.leaves,
            &Plane { normal: g, through, lower, upper, rise },
            &mut self.rising,
        );
        let own = plane.reach_along(g, through);
        let highest = if own > highest { own } else { highest };
        let here = scale.along(g, through).row(outline);
        let mut row = here.map(|x| x - highest);
        let mut worst = rise;
        let mut blocking = None;
        for i in 0..self.rising.len() {
            let slot = self.rising[i];
            let other = self.other(slot, scale);
            if slot == plane.slot {
                continue;
            }
            let (theirs, deficit) = other.best_below(&cell.upper, outline, scale, g, rise);
            for j in 0..MOST_CORNERS {
                row[j] = if theirs[j] < row[j] { theirs[j] } else { row[j] };
            }
            if deficit > worst {
                worst = deficit;
                let below = other.height.at(at) < 0.0;
                let height = other.height.row(outline).map(|h| if below { -h } else { h });
                blocking = other.is_usable().then(|| (slot, std::array::from_fn(|j| here[j] - height[j])));
            }
        }
        polygon.lower = row.map(|x| x - margin);
        blocking
    }

    fn other(&mut self, slot: Slot, scale: &Scale) -> Candidate {
        let of_faces = self.faces.iter().map(|face| &face.plane);
        if let Some(known) = of_faces.chain(&self.others).find(|candidate| candidate.slot == slot) {
            return *known;
        }
        let candidate = Candidate::new(slot, self.bvh.corners(slot), scale);
        self.others.push(candidate);
        candidate
    }
}

/// A part of which no more than this lies on this side of an edge, by its extents across, lies beyond.
const LEAST_STRIP: f64 = 1e-9;

/// The box around a cell, widened by its greatest value above.
fn around(scale: &Scale, cell: &Cell) -> ([f64; 3], [f64; 3]) {
    let points = scale.points(&cell.outline);
    let beside = cell.most + 2.0 * scale.margin;
    let ranges = points.each_ref().map(range);
    (ranges.map(|(low, _)| low - beside), ranges.map(|(_, high)| high + beside))
}

/// The least and the greatest of the values at the corners.
fn range(row: &Row) -> (f64, f64) {
    // What lies beyond the corners repeats the last one.
    let (mut low, mut high) = (row[0], row[0]);
    for x in &row[1..] {
        low = if *x < low { *x } else { low };
        high = if *x > high { *x } else { high };
    }
    (low, high)
}

impl Outline {
    /// Cuts across the longest way between two corners, in the middle.
    fn halve(&self, scale: &Scale) -> Option<[Self; 2]> {
        let way = |i: usize, j: usize| scale.way([self.v[j] - self.v[i], self.w[j] - self.w[i]]);
        let mut longest = (DVec3::ZERO, 0, 0);
        for i in 0..self.count {
            for j in i + 1..self.count {
                if way(i, j).length_squared() > longest.0.length_squared() {
                    longest = (way(i, j), i, j);
                }
            }
        }
        let (along, i, j) = longest;
        self.cut(&std::array::from_fn(|k| along.dot(way(i, k)) + along.dot(way(j, k))))
    }
}

impl Candidate {
    /// Values at the corners of the best of a few functions below the distance from this face, and how far it lies below the wanted
    /// one at most. `normal` is that of a plane over which this face rises; a function that lies `enough` below ends the search.
    fn best_below(
        &self,
        wanted: &Row,
        outline: &Outline,
        scale: &Scale,
        normal: DVec3,
        enough: f64,
    ) -> (Row, f64) {
        let at = outline.centre();
        let short = |row: &Row| range(&std::array::from_fn(|j| wanted[j] - row[j])).1;
        let mut best = ([f64::NEG_INFINITY; MOST_CORNERS], f64::INFINITY);
        if self.normal != DVec3::ZERO {
            let below = self.height.at(at) < 0.0;
            let bulge = self.bulge[usize::from(below)];
            let row = self.height.row(outline).map(|h| if below { -h - bulge } else { h - bulge });
            best = (row, short(&row));
        }
        if best.1 <= enough {
            return best;
        }
        let centre = scale.point(at);
        let [a, b, c] = self.corners;
        let beta = closest_barycentric(centre.to_array(), self.corners.map(|p| p.to_array()));
        let y = a + beta[1] * (b - a) + beta[2] * (c - a);
        let away = centre - y;
        let mut plane = |g: Option<DVec3>| {
            if let Some(g) = g {
                let support = self.reach_along(g, y);
                let row = scale.along(g, y).row(outline).map(|x| x - support);
                let here = short(&row);
                best = if here < best.1 { (row, here) } else { best };
            }
            best.1 <= enough
        };
        let ways = self.corners.map(|corner| corner - y);
        let across = ways.map(|way| {
            let across = normal.cross(way);
            if across.dot(away) < 0.0 { -across } else { across }
        });
        let aside = [-(ways[0] + ways[1] + ways[2]), away, across[0], across[1], across[2]];
        let _ = aside.into_iter().any(|aside| plane(tilted(&ways, normal, aside))) || plane(unit(away));
        best
    }
}

/// A normal turned aside so far that the plane lies over all ends of some ways.
fn tilted(ways: &[DVec3; 3], normal: DVec3, aside: DVec3) -> Option<DVec3> {
    let aside = unit(aside - normal.dot(aside) * normal)?;
    let mut slope = 0.0;
    for way in ways {
        let (rise, run) = (normal.dot(*way), -aside.dot(*way));
        if run > 0.0 && rise > slope * run {
            slope = rise / run;
        }
    }
    (slope < f64::INFINITY).then(|| unit(normal + slope * aside)).flatten()
}
