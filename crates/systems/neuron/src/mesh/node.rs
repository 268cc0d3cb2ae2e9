//! The mesh around a node: a core, the adjacent parts of the tubes up to where they are clear of each other, and the wall around
//! them.

use super::assign::{Assignment, assignments};
use super::bar::bars;
use super::cluster::{Cluster, THIN};
use super::core::{Core, library, library_of_balls};
use super::energy::Energy;
use super::exit::exit;
use super::follow::Draft;
use super::node_mesh::{NodeMesh, PLACES, Section, quality, quality_at_points};
use super::shape::Shape;
use super::skin::Skin;
use super::tube::{End, Tube};
use super::wall::{Middle, Wall};
use super::warp::{Ray, side_of, turned};
use glam::DVec3;
use pompeiu_core::run::Control;
use pompeiu_volume::{Refinement, key_weights as weights};
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;

/// Half the diagonal of the core square of a section, in radii.
pub(super) const CORE: f64 = 0.55;

/// Weight of the squared distance of middles of faces and edges from the wall, in radii, beside the energy of one cell.
pub(super) const MIDDLES: f64 = 50.0;

/// No further assignment is tried once this quality is reached.
const GOOD: f64 = 0.35;

/// More parameters than [`PLACES`] along each axis of a cell.
const MANY_PLACES: [f64; 6] = [0.0, 0.1, 0.35, 0.65, 0.9, 1.0];

/// Difference of the least scaled Jacobian and that at points from which on it is measured at more points.
const BETWEEN: f64 = 0.01;

/// Above this quality, the mesh that follows the wall more closely is kept.
const ENOUGH: f64 = 0.3;

/// Largest number of assignments tried for a node.
const MOST_TRIES: usize = 6;

/// Rows of cubes that are tried.
const MOST_ROWS: usize = 3;

/// The same where the mesh only decides.
const MOST_SKETCHES: usize = 2;

/// Meshes a node with arms of the given lengths. With a factor by which radii were multiplied, the wall is drawn to the cones where it is far from
/// them.
pub(super) fn mesh_node(
    cluster: &Cluster,
    tubes: &[Tube],
    reach: &[f64],
    (parts, factor): (usize, Option<f64>),
    control: &Control,
) -> Option<NodeMesh> {
    let wall = cluster.wall(tubes, reach);
    // With the radii of the file, which were multiplied by the factor except for those of balls.
    let cones = factor.map(|factor| wall.divided(factor, cluster.balls.len()));
    let plan = Plan::new((cluster, tubes, reach), (&wall, cones.as_ref()), parts, control);
    let mut draft = plan.without_cones()?;
    if let Some(cones) = &cones
        && draft.node.quality > 0.0
        && !draft.is_near()
    {
        draft.follow(cones, control);
        if draft.is_far() || draft.node.quality < ENOUGH {
            // Other complexes may have vertices where the wall has its creases.
            let other = plan.best(MIDDLES, &|draft| draft.follow(cones, control), &Draft::fitness);
            if let Some(other) = other.filter(|other| other.fitness() > draft.fitness()) {
                draft = other;
            }
        }
    }
    Some(draft.node)
}

/// The mesh of a node that is only good enough to decide that there is one: its cells are valid and its wall is near; `None` if none is found at once.
pub(super) fn sketch_node(
    cluster: &Cluster,
    tubes: &[Tube],
    reach: &[f64],
    (parts, factor): (usize, Option<f64>),
    within: f64,
    control: &Control,
) -> Option<NodeMesh> {
    let wall = cluster.wall(tubes, reach);
    let cones = factor.map(|factor| wall.divided(factor, cluster.balls.len()));
    let plan = Plan::new((cluster, tubes, reach), (&wall, cones.as_ref()), parts, control);
    let (centre, _) = plan.places.first()?;
    plan.candidates((0, *centre)).iter().take(MOST_SKETCHES).find_map(|(core, assignment)| {
        plan.sketch(*centre, &plan.cores[*core], assignment).enough(&wall, (cones.as_ref(), within), control)
    })
}

/// The index of a core, and the assignment of tubes to its quads.
type Candidate = (usize, Assignment);

/// A node and how to mesh it.
struct Plan<'p> {
    cluster: &'p Cluster,
    tubes: &'p [Tube],
    reach: &'p [f64],
    wall: &'p Wall,
    /// The wall with radii of the file.
    cones: Option<&'p Wall>,
    parts: usize,
    control: &'p Control,
    cores: Vec<Core>,
    /// Rows of cubes, with their assignments.
    rows: Vec<Candidate>,
    /// Positions of the core to try, each with the cores and assignments to try there once they are known.
    places: Vec<(DVec3, OnceCell<Vec<Candidate>>)>,
    /// Drafts whose middles follow the wall, by the indices of their position and of their core and assignment.
    drafts: RefCell<BTreeMap<[usize; 2], Draft>>,
}

impl<'p> Plan<'p> {
    fn new(
        (cluster, tubes, reach): (&'p Cluster, &'p [Tube], &'p [f64]),
        (wall, cones): (&'p Wall, Option<&'p Wall>),
        parts: usize,
        control: &'p Control,
    ) -> Self {
        let arms = cluster.ends.len();
        let mut cores = if cluster.balls.is_empty() { library(arms) } else { library_of_balls(arms) };
        let mut rows = Vec::new();
        for (core, assignment) in bars((cluster, tubes, reach), MOST_ROWS) {
            rows.push((cores.len(), assignment));
            cores.push(core);
        }
        let places = centres(cluster, tubes, reach, wall);
        let places = places.into_iter().map(|centre| (centre, OnceCell::new())).collect();
        let drafts = RefCell::default();
        Self { cluster, tubes, reach, wall, cones, parts, control, cores, rows, places, drafts }
    }

    /// The mesh of best quality.
    fn without_cones(&self) -> Option<Draft> {
        let quality = |draft: &Draft| draft.node.quality;
        let best = self.best(MIDDLES, &|_| (), &quality);
        if self.control.is_stopped() || best.as_ref().is_some_and(|best| best.node.quality >= GOOD) {
            return best;
        }
        // Cells in narrow corners need the freedom to cut them.
        let other = self.best(0.0, &|_| (), &quality);
        let of = |draft: &Option<Draft>| draft.as_ref().map_or(f64::NEG_INFINITY, quality);
        if of(&best) > ENOUGH || of(&best) >= of(&other) { best } else { other }
    }

    /// The best mesh of several complexes and positions, with a weight of the middles of faces and edges; the first one that is good.
    fn best(
        &self,
        following: f64,
        finish: &dyn Fn(&mut Draft),
        goodness: &dyn Fn(&Draft) -> f64,
    ) -> Option<Draft> {
        let mut best: Option<(f64, Draft)> = None;
        for (nth, (centre, candidates)) in self.places.iter().enumerate() {
            let candidates = candidates.get_or_init(|| self.candidates((nth, *centre)));
            for number in 0..candidates.len() {
                if self.control.is_stopped() {
                    return best.map(|(_, draft)| draft);
                }
                let mut draft = self.draft([nth, number], *centre, &candidates[number], following);
                finish(&mut draft);
                let good = goodness(&draft);
                if best.as_ref().is_none_or(|(best, _)| good > *best) {
                    best = Some((good, draft));
                }
                if best.as_ref().is_some_and(|(best, _)| *best >= GOOD) {
                    return best.map(|(_, draft)| draft);
                }
            }
            if nth > 0 && best.as_ref().is_some_and(|(best, _)| *best > 0.2) {
                break;
            }
        }
        best.map(|(_, draft)| draft)
    }

    /// The draft of a core and an assignment at a position, made once if its middles follow the wall: it is asked for again where the wall is far.
    fn draft(
        &self,
        place: [usize; 2],
        centre: DVec3,
        (core, assignment): &Candidate,
        following: f64,
    ) -> Draft {
        let make = || self.build(centre, &self.cores[*core], assignment, following);
        if following == MIDDLES {
            self.drafts.borrow_mut().entry(place).or_insert_with(make).clone()
        } else {
            make()
        }
    }

    /// Cores and assignments to try at one of the positions, the best first.
    fn candidates(&self, (nth, centre): (usize, DVec3)) -> Vec<Candidate> {
        let cluster = self.cluster;
        let direction = |(end, &s): (&End, &f64)| (end.at(self.tubes, s).0 - centre).normalize_or_zero();
        let directions: Vec<DVec3> = cluster.ends.iter().zip(self.reach).map(direction).collect();
        let mut found: Vec<Candidate> = Vec::new();
        for (index, core) in self.cores.iter().enumerate() {
            if core.axis.is_none() && core.quads.len() > cluster.ends.len() {
                // A larger core must fit better to justify its cells.
                found.extend(assignments(core, &directions, 4).into_iter().map(|mut assignment| {
                    assignment.score += 0.002 * core.blocks.len() as f64;
                    (index, assignment)
                }));
            }
        }
        found.sort_by(|a, b| a.1.score.total_cmp(&b.1.score));
        found.truncate(MOST_TRIES);
        // Where several nodes lie on one tube, a row of cubes is near them all. It does not depend on the position.
        if nth == 0 {
            found.splice(..0, self.rows.iter().cloned());
        }
        found
    }
}

/// Candidate positions of the core: the node, and the farthest point towards the middle of the tightest pair of arms that is still
/// deep inside.
fn centres(cluster: &Cluster, tubes: &[Tube], reach: &[f64], wall: &Wall) -> Vec<DVec3> {
    let mut centres = vec![cluster.centre];
    let ends: Vec<DVec3> = cluster.ends.iter().zip(reach).map(|(end, &s)| end.at(tubes, s).0).collect();
    let mut tightest = (f64::NEG_INFINITY, DVec3::ZERO);
    for (i, a) in ends.iter().enumerate() {
        for b in &ends[..i] {
            let cosine =
                (*a - cluster.centre).normalize_or_zero().dot((*b - cluster.centre).normalize_or_zero());
            if cosine > tightest.0 {
                tightest = (cosine, 0.5 * (*a + *b));
            }
        }
    }
    if tightest.0 > 0.3 && cluster.balls.is_empty() {
        for depth in [0.9, 0.75] {
            let deep = |t: f64| {
                let p = cluster.centre.lerp(tightest.1, t);
                -wall.distance(p).0 > depth * cluster.radius
            };
            if let Some(t) = (1..=20).rev().map(|k| 0.05 * f64::from(k)).find(|&t| deep(t)) {
                centres.push(cluster.centre.lerp(tightest.1, t));
            }
        }
        // The more acute the angle, the more it helps.
        if tightest.0 > 0.7 {
            centres.rotate_left(1);
        }
    }
    if let Some(exit) = exit(cluster, tubes, reach) {
        centres.insert(0, exit.centre);
    }
    centres
}

/// The mesh around a node before its vertices are optimised.
pub(super) struct Sketch {
    blocks: Vec<[u32; 8]>,
    /// Number of corners of blocks.
    corners: usize,
    refinement: Refinement,
    pub(super) positions: Vec<DVec3>,
    sections: Vec<Section>,
    pub(super) cells: Vec<[u32; 8]>,
    /// Faces of a single cell.
    pub(super) outer: Vec<[u32; 4]>,
    pub(super) kinds: Vec<Kind>,
    /// The size of the node, and that of each cell.
    pub(super) scale: f64,
    pub(super) sizes: Vec<f64>,
}

impl Sketch {
    /// Faces on the wall that have a vertex that may move.
    pub(super) fn free_faces(&self) -> Vec<[u32; 4]> {
        let is_free = |face: &[u32; 4]| face.iter().any(|v| self.kinds[*v as usize] != Kind::Fixed);
        self.outer.iter().filter(|face| is_free(face)).copied().collect()
    }

    pub(super) fn into_node(self, quality: f64, is_sketch: bool) -> NodeMesh {
        let Self { blocks, corners, refinement, positions, sections, .. } = self;
        NodeMesh { blocks, corners, refinement, positions, sections, quality, is_sketch }
    }
}

impl Plan<'_> {
    fn build(&self, centre: DVec3, core: &Core, assignment: &Assignment, following: f64) -> Draft {
        let mut sketch = self.sketch(centre, core, assignment);
        let mut positions = std::mem::take(&mut sketch.positions);
        let Sketch { cells, kinds, outer, scale, sizes, .. } = &sketch;
        let quality = optimise(
            (cells, kinds, outer),
            self.wall,
            (*scale, sizes, following),
            &mut positions,
            self.control,
        );
        let free = (0..kinds.len() as u32).filter(|&v| kinds[v as usize] != Kind::Fixed).collect();
        let faces = sketch.free_faces();
        let off = self.cones.map_or(0.0, |cones| Skin::new(cones, &faces, &positions, 0.0).off(&positions));
        sketch.positions = positions;
        let (cells, sizes, scale) = (sketch.cells.clone(), sketch.sizes.clone(), sketch.scale);
        Draft { node: sketch.into_node(quality, false), cells, sizes, scale, free, faces, off }
    }

    /// The mesh of a core and an assignment at a position, with its corners where they begin.
    fn sketch(&self, centre: DVec3, core: &Core, assignment: &Assignment) -> Sketch {
        let Self { cluster, tubes, reach, wall, parts, .. } = *self;
        let depth = (-wall.distance(centre).0).max(0.3 * cluster.radius);
        let half = if cluster.balls.is_empty() { 0.42 } else { 0.5 } * depth;
        let size = core.vertices.iter().map(|p| p.abs().max_element()).fold(0.0, f64::max);
        let placed = |p: &DVec3| assignment.rotation * (*p * (half / size));
        let mut corners: Vec<DVec3> = match &core.axis {
            Some(_) => core.vertices.iter().map(|p| *p - centre).collect(),
            None => core.vertices.iter().map(placed).collect(),
        };
        let ball = (cluster.balls.len() == 1).then(|| cluster.balls[0]);
        if let Some((_, around)) = ball {
            let ray = |((end, &s), &quad): ((&End, &f64), &usize)| {
                let (at, radius) = end.at(tubes, s);
                let rim = libm::asin((radius / around).clamp(0.0, 1.0));
                Ray { direction: (at - centre).normalize_or(DVec3::X), rim, quad }
            };
            let rays: Vec<Ray> = cluster.ends.iter().zip(reach).zip(&assignment.quads).map(ray).collect();
            corners = turned(core, &corners, &rays);
        }
        for corner in &mut corners {
            *corner += centre;
        }
        let mut blocks: Vec<[u32; 8]> = core.blocks.iter().map(|b| b.map(|v| v as u32)).collect();
        // Every vertex on the core's boundary has a counterpart on the wall.
        let mut on_wall = vec![None; corners.len()];
        for &v in core.quads.iter().flatten() {
            if on_wall[v].is_none() {
                on_wall[v] = Some(corners.len() as u32);
                let from = core.axis.as_ref().map_or(centre, |axis| axis[v]);
                let direction = (corners[v] - from).normalize_or(DVec3::X);
                corners.push(wall.leave(corners[v], direction, depth));
            }
        }
        let outer_of = |v: usize, on_wall: &[Option<u32>]| on_wall[v].unwrap_or(v as u32);
        let mut sections = Vec::new();
        for ((end, &s), &quad) in cluster.ends.iter().zip(reach).zip(&assignment.quads) {
            let (at, radius) = end.section(tubes, s);
            let axis = end.tangent(tubes, s);
            let quad = core.quads[quad];
            let start: [DVec3; 4] = quad.map(|v| corners[v]);
            let side = side_of(&start, axis);
            let (e1, e2) = (side, axis.cross(side));
            let direction = |k: usize| {
                let angle = std::f64::consts::FRAC_PI_4 * (2 * k + 1) as f64;
                e1 * libm::cos(angle) + e2 * libm::sin(angle)
            };
            let distance = start.iter().copied().sum::<DVec3>().distance(4.0 * at) / 4.0;
            let layers = ((distance / (1.5 * radius)).round() as usize).clamp(1, 12);
            // Across a thin tube, a ray would leave in another one.
            let is_thin = ball.is_none() && radius <= THIN * depth;
            let shares = if ball.is_some() || is_thin {
                // On the ball or the thick tube, the last layers follow the wall into the concave corner where the tube begins.
                let way = quad.map(|v| corners[outer_of(v, &on_wall) as usize].distance(at) - radius);
                graded(way.iter().sum::<f64>() / 4.0, layers, ON_BALL * radius)
            } else {
                (1..=layers).map(|k| k as f64 / layers as f64).collect()
            };
            let first_outer = quad.map(|v| corners[outer_of(v, &on_wall) as usize]);
            let mut inner = quad.map(|v| v as u32);
            let mut outer = quad.map(|v| outer_of(v, &on_wall));
            for (layer, &t) in shares.iter().enumerate() {
                let mut next_inner = [0; 4];
                let mut next_outer = [0; 4];
                let target: [DVec3; 4] = [0, 1, 2, 3].map(|k| at + direction(k) * (CORE * radius));
                // Where the tube turns within the node, the rings follow its axis.
                let bow = end.at(tubes, t * s).0 - end.at(tubes, 0.0).0.lerp(at, t);
                let ring: [DVec3; 4] = [0, 1, 2, 3].map(|k| start[k].lerp(target[k], t) + bow);
                let middle = ring.iter().copied().sum::<DVec3>() / 4.0;
                for k in 0..4 {
                    next_inner[k] = corners.len() as u32;
                    corners.push(ring[k]);
                    next_outer[k] = corners.len() as u32;
                    let out = (ring[k] - middle).normalize_or(direction(k));
                    let rim = at + direction(k) * radius;
                    corners.push(match ball {
                        _ if layer + 1 == shares.len() => rim,
                        // From the core's corner to the tube along the ball or the thick tube.
                        Some((ball, _)) => {
                            let [from, to] = [start[k], rim].map(|p| (p - ball).normalize_or(out));
                            let out = from.lerp(to, t).normalize_or(out);
                            wall.leave(ball, out, depth)
                        }
                        None if is_thin => wall.project(first_outer[k].lerp(rim, t)),
                        None => wall.leave(ring[k], out, radius),
                    });
                }
                layer_of(&mut blocks, [inner, outer], [next_inner, next_outer]);
                (inner, outer) = (next_inner, next_outer);
            }
            sections.push(Section { at: s, side, inner, outer });
        }
        for (index, quad) in core.quads.iter().enumerate() {
            if !assignment.quads.contains(&index) {
                let [a, b, c, d] = quad.map(|v| v as u32);
                let [e, f, g, h] = quad.map(|v| outer_of(v, &on_wall));
                blocks.push([a, b, c, d, e, f, g, h]);
            }
        }
        let mut refinement = Refinement::new(parts);
        let cells: Vec<[u32; 8]> = blocks
            .iter()
            .flat_map(|&block| {
                let lattice = refinement.lattice(block);
                refinement.cells(&lattice).collect::<Vec<_>>()
            })
            .collect();
        let mut positions: Vec<DVec3> =
            refinement.keys().iter().map(|key| weights(key).map(|(v, w)| corners[v] * w).sum()).collect();
        let outer = outer_faces(&cells);
        let kinds = kinds(cluster, tubes, &sections, &refinement, &outer, &mut positions);
        let sizes: Vec<f64> = if cluster.has_small_cells(tubes, reach, depth) {
            cells.iter().map(|cell| size_of(&cell.map(|v| positions[v as usize]))).collect()
        } else {
            vec![depth; cells.len()]
        };
        Sketch {
            blocks,
            corners: corners.len(),
            refinement,
            positions,
            sections,
            cells,
            outer,
            kinds,
            scale: depth,
            sizes,
        }
    }
}

/// Length of a layer of an arm on a ball, in radii of the arm.
const ON_BALL: f64 = 0.5;

/// Largest ratio of two consecutive layers.
const GRADING: f64 = 1.8;

/// Shares of a length at which layers end. They are equal, unless that makes the last one longer than wanted: then they shrink in a constant
/// ratio, and there are more of them where the ratio would be too large.
fn graded(length: f64, layers: usize, last: f64) -> Vec<f64> {
    let total = |ratio: f64, count: usize| (0..count).map(|k| libm::pow(ratio, k as f64)).sum::<f64>() * last;
    let mut count = layers;
    while total(GRADING, count) < length {
        count += 1;
    }
    let (mut low, mut high) = (1.0, GRADING);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if total(middle, count) < length { low = middle } else { high = middle }
    }
    let steps: Vec<f64> = (0..count).rev().map(|k| libm::pow(high, k as f64)).collect();
    let sum: f64 = steps.iter().sum();
    let mut at = 0.0;
    let mut found: Vec<f64> = steps
        .iter()
        .map(|step| {
            at += step / sum;
            at
        })
        .collect();
    if let Some(end) = found.last_mut() {
        *end = 1.0;
    }
    found
}

/// The size of a cell: the geometric mean of its mean edges along the three axes, folded or not.
pub(super) fn size_of(corners: &[DVec3; 8]) -> f64 {
    let edges = [
        [[0, 1], [3, 2], [4, 5], [7, 6]],
        [[0, 3], [1, 2], [4, 7], [5, 6]],
        [[0, 4], [1, 5], [2, 6], [3, 7]],
    ];
    let mean =
        |of: [[usize; 2]; 4]| of.map(|[a, b]| 0.25 * corners[a].distance(corners[b])).iter().sum::<f64>();
    libm::cbrt(edges.map(mean).iter().product::<f64>()).max(f64::MIN_POSITIVE)
}

/// Five blocks between two sections.
pub(super) fn layer_of(blocks: &mut Vec<[u32; 8]>, below: [[u32; 4]; 2], above: [[u32; 4]; 2]) {
    let [[a, b], [c, d]] = [below, above];
    blocks.push([a[0], a[1], a[2], a[3], c[0], c[1], c[2], c[3]]);
    for k in 0..4 {
        let l = (k + 1) % 4;
        blocks.push([a[k], b[k], b[l], a[l], c[k], d[k], d[l], c[l]]);
    }
}

/// The position of a vertex of a section in the unit disc, from the weights of the corners in the core and on the wall, and whether
/// it lies on the wall. The same for every section, and symmetric under quarter turns and reflections.
pub(super) fn place_in_disc(inner: [f64; 4], outer: [f64; 4]) -> ([f64; 2], bool) {
    let corner = |k: usize| {
        let angle = std::f64::consts::FRAC_PI_4 * (2 * k + 1) as f64;
        [libm::cos(angle), libm::sin(angle)]
    };
    let radial: f64 = outer.iter().sum();
    let mut in_core = [0.0; 2];
    let mut total = [0.0; 4];
    for k in 0..4 {
        total[k] = inner[k] + outer[k];
        let [x, y] = corner(k);
        in_core[0] += CORE * total[k] * x;
        in_core[1] += CORE * total[k] * y;
    }
    if radial == 0.0 {
        return (in_core, false);
    }
    // Along the arc between the two corners with nonzero weight.
    let k = (0..4).find(|&k| total[k] > 0.0 && total[(k + 3) % 4] == 0.0).unwrap_or(0);
    let along = total[(k + 1) % 4];
    let angle = std::f64::consts::FRAC_PI_4 * ((2 * k + 1) as f64 + 2.0 * along);
    let arc = [libm::cos(angle), libm::sin(angle)];
    ([0, 1].map(|axis| in_core[axis] * (1.0 - radial) + arc[axis] * radial), radial > 1.0 - 1e-9)
}

/// How a vertex may move.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Fixed,
    Wall,
    Inner,
}

/// The faces of a single cell.
fn outer_faces(cells: &[[u32; 8]]) -> Vec<[u32; 4]> {
    let mut faces: Vec<([u32; 4], [u32; 4])> = cells
        .iter()
        .flat_map(|cell| {
            pompeiu_volume::FACES.map(|face| {
                let face = face.map(|k| cell[k]);
                let mut key = face;
                key.sort_unstable();
                (key, face)
            })
        })
        .collect();
    faces.sort_unstable();
    faces.chunk_by(|a, b| a.0 == b.0).filter(|run| run.len() == 1).map(|run| run[0].1).collect()
}

/// The middles of wall faces and of their edges, of those that have a vertex that may move.
pub(super) fn middles(wall: &Wall, outer: &[[u32; 4]], kinds: &[Kind], positions: &[DVec3]) -> Vec<Middle> {
    let edges = |face: &[u32; 4]| {
        let [a, b, c, d] = *face;
        [[a, b], [b, c], [c, d], [d, a]].map(|[a, b]| if a < b { [a, a, b, b] } else { [b, b, a, a] })
    };
    let mut all: Vec<[u32; 4]> = outer.iter().flat_map(edges).collect();
    all.sort_unstable();
    all.dedup();
    all.extend(outer);
    all.retain(|vertices| vertices.iter().any(|v| kinds[*v as usize] != Kind::Fixed));
    let middle = |vertices: [u32; 4]| {
        let radius = wall.radius(vertices.iter().map(|v| positions[*v as usize]).sum::<DVec3>() / 4.0);
        Middle { vertices, radius }
    };
    all.into_iter().map(middle).collect()
}

/// Positions the vertices of the sections, and determines how each vertex may move.
fn kinds(
    cluster: &Cluster,
    tubes: &[Tube],
    sections: &[Section],
    refinement: &Refinement,
    outer: &[[u32; 4]],
    positions: &mut [DVec3],
) -> Vec<Kind> {
    let mut kinds = vec![Kind::Inner; positions.len()];
    outer.iter().flatten().for_each(|&v| kinds[v as usize] = Kind::Wall);
    for (section, end) in sections.iter().zip(&cluster.ends) {
        let (at, radius) = end.section(tubes, section.at);
        let axis = end.tangent(tubes, section.at);
        let (e1, e2) = (section.side, axis.cross(section.side));
        for (v, key) in refinement.keys().iter().enumerate() {
            let (mut inner, mut outer, mut rest) = ([0.0; 4], [0.0; 4], 0.0);
            for (corner, weight) in weights(key) {
                let corner = corner as u32;
                if let Some(k) = section.inner.iter().position(|&c| c == corner) {
                    inner[k] = weight;
                } else if let Some(k) = section.outer.iter().position(|&c| c == corner) {
                    outer[k] = weight;
                } else {
                    rest += weight;
                }
            }
            if rest == 0.0 {
                let ([x, y], _) = place_in_disc(inner, outer);
                positions[v] = at + (e1 * x + e2 * y) * radius;
                kinds[v] = Kind::Fixed;
            }
        }
    }
    kinds
}

/// Optimises the vertices; returns the least scaled Jacobian.
fn optimise(
    (cells, kinds, outer): (&[[u32; 8]], &[Kind], &[[u32; 4]]),
    wall: &Wall,
    (scale, sizes, following): (f64, &[f64], f64),
    positions: &mut [DVec3],
    control: &Control,
) -> f64 {
    let of = |wanted: &dyn Fn(Kind) -> bool| -> Vec<u32> {
        (0..kinds.len() as u32).filter(|&v| wanted(kinds[v as usize])).collect()
    };
    let free = of(&|kind| kind != Kind::Fixed);
    let inner = of(&|kind| kind == Kind::Inner);
    let on_wall = of(&|kind| kind == Kind::Wall);
    for &v in &on_wall {
        positions[v as usize] = wall.project(positions[v as usize]);
    }
    let mut energy = Energy {
        cells,
        free: &free,
        places: &[0.0, 1.0],
        shape: Shape::MeanRatio { epsilon: 0.1 },
        wall: None,
        middles: (&[], following),
        skin: None,
        scale,
        sizes,
        control,
    };
    for (round, weight) in [30.0, 300.0, 3000.0, 30_000.0].into_iter().enumerate() {
        let least = energy.least_determinant(positions);
        energy.shape = Shape::untangling(least);
        energy.wall = Some((wall, &on_wall, weight));
        let found = middles(wall, outer, kinds, positions);
        let energy = Energy { middles: (&found, following), ..energy };
        energy.minimise(positions, if round == 0 { 60 } else { 40 });
    }
    let best = |positions: &[DVec3]| quality(cells, positions);
    for &v in &on_wall {
        positions[v as usize] = wall.project(positions[v as usize]);
    }
    energy.places = &PLACES;
    let folded = best(positions) <= 0.0;
    if folded {
        energy.wall = None;
        energy.free = &inner;
        for epsilon in [0.02, 0.005, 0.001] {
            energy.shape = Shape::MeanRatio { epsilon };
            energy.minimise(positions, 40);
        }
    }
    let found = middles(wall, outer, kinds, positions);
    let mut energy = Energy { wall: Some((wall, &on_wall, 1e5)), middles: (&found, following), ..energy };
    for (power, places) in [(2, &PLACES[..]), (4, &PLACES), (4, &MANY_PLACES)] {
        // Only where the least value is between the points.
        if places.len() == MANY_PLACES.len()
            && best(positions) > quality_at_points(cells, positions) - BETWEEN
        {
            break;
        }
        energy.places = places;
        // Tangential steps along the wall, then exactly onto it, unless that reduces quality.
        energy.shape = Shape::Scaled { power };
        let before = positions.to_vec();
        let was = best(positions);
        energy.free = &free;
        energy.minimise(positions, 40);
        for &v in &on_wall {
            positions[v as usize] = wall.project(positions[v as usize]);
        }
        if best(positions) < was {
            positions.copy_from_slice(&before);
        }
        energy.free = &inner;
        let before = positions.to_vec();
        let was = best(positions);
        energy.minimise(positions, 30);
        if best(positions) < was {
            positions.copy_from_slice(&before);
        }
    }
    best(positions)
}
