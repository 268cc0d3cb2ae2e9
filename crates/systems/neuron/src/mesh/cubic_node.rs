//! The mesh around a node with tricubic cells.

use super::cluster::Cluster;
use super::cubic_energy::{CubicEnergy, MANY_PLACES, PLACES, lagrange_table};
use super::cubic_follow::{Bent, EVEN, EVEN_BELOW, follow, off};
use super::node::size_of;
use super::node_mesh::NodeMesh;
use super::section::Section;
use super::shape::Shape;
use super::tube::Tube;
use super::wall::Wall;
use glam::DVec3;
use pompeiu_core::run::Control;
use pompeiu_volume::bernstein::interpolate_lattice;
use pompeiu_volume::{
    CORNERS_OF_64, FACES, Jacobian, Refinement, certify_bezier, key_weights, place_of_64,
    scaled_jacobian_bezier, scaled_jacobian_bound_bezier,
};

/// The blocks of a node as tricubic cells.
pub(super) struct CubicNode {
    /// The key of each lattice position.
    pub(super) refinement: Refinement,
    /// Control points, in the order of the keys.
    pub(super) points: Vec<DVec3>,
    /// The least scaled Jacobian of its cells.
    pub(super) quality: f64,
    /// How good it is; see [`Bent::fitness`].
    pub(super) fitness: f64,
    /// Whether every cell is proven to have a positive Jacobian, and the wall is near enough to the cones at points.
    pub(super) is_good: bool,
}

/// Distance of the wall from the cones at points beyond which it is drawn to them, over what is tolerated: between the points, and from the creases of
/// the cones, it is up to a quarter more.
const CLOSE: f64 = 0.75;

/// How much is done to unfold cells that stay folded at first.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Unfolding {
    Little,
    Much,
}

/// Parts per block of the initial trilinear mesh.
pub(super) const START: usize = 2;

/// Makes the cells of a node tricubic; the node must have been meshed with [`START`] parts per block, and radii multiplied by the factor. The wall is
/// drawn to the cones where it is farther from them than is tolerated, in radii.
pub(super) fn bend(
    cluster: &Cluster,
    (tubes, factor): (&[Tube], f64),
    reach: &[f64],
    node: &NodeMesh,
    (section, within): (&Section, f64),
    (effort, control): (Unfolding, &Control),
) -> CubicNode {
    let wall = cluster.wall(tubes, reach);
    let scale = (-wall.distance(cluster.centre).0).max(0.3 * cluster.radius);
    let (refinement, cells, mut positions) = started(node);
    let (fixed, on_wall, faces) =
        boundary(cluster, tubes, node, &refinement, section, &cells, &mut positions);
    let sizes: Vec<f64> = if cluster.has_small_cells(tubes, reach, scale) {
        let corners = |cell: &[u32; 64]| CORNERS_OF_64.map(|k| positions[cell[k] as usize]);
        cells.iter().map(|cell| size_of(&corners(cell))).collect()
    } else {
        vec![scale; cells.len()]
    };
    let cones = wall.divided(factor, cluster.balls.len());
    let measured = |positions: Vec<DVec3>| {
        let (points, quality, certified) = controlled(&cells, &positions);
        Bent { off: off(&cones, &faces, &positions), positions, points, quality, certified }
    };
    let free: Vec<u32> = (0..fixed.len() as u32).filter(|&v| !fixed[v as usize]).collect();
    let mut is_inner: Vec<bool> = fixed.iter().map(|is| !is).collect();
    for &v in &on_wall {
        is_inner[v as usize] = false;
    }
    let inner: Vec<u32> = free.iter().copied().filter(|&v| is_inner[v as usize]).collect();
    let [few, many] = [lagrange_table(&PLACES), lagrange_table(&MANY_PLACES)];
    let energy = |table| CubicEnergy {
        cells: &cells,
        free: &free,
        shape: Shape::MeanRatio { epsilon: 0.02 },
        even: 0.0,
        wall: None,
        skin: None,
        scale,
        sizes: &sizes,
        table,
        control,
    };
    let draft =
        |table| Draft { energy: energy(table), wall: &wall, on_wall: &on_wall, free: &free, inner: &inner };
    let tables = if effort == Unfolding::Much { &[&few, &many][..] } else { &[&few] };
    let drafts: Vec<Draft<'_>> = tables.iter().map(|table| draft(table)).collect();
    let best = drafted(&drafts, &mut positions, &measured);
    // Between the points of cells it may be much less than at them.
    let proven = |bent: Bent| {
        let quality = if bent.certified { proven(&cells, &bent.points, bent.quality) } else { bent.quality };
        Bent { quality, ..bent }
    };
    let mut best = proven(best.unwrap_or_else(|| measured(positions)));
    let measured = |positions| proven(measured(positions));
    let is_given_up = !best.certified && effort == Unfolding::Little;
    if is_given_up || control.is_stopped() {
        // Another complex is tried first.
    } else if best.off > CLOSE * within || !best.certified {
        best = follow(best, [&energy(&few), &energy(&many)], (&cones, &faces), measured);
    } else if best.quality < EVEN_BELOW {
        let mut positions = best.positions.clone();
        draft(&few).improve(EVEN, &mut positions);
        let found = measured(positions);
        if found.is_better(&best) {
            best = found;
        }
    }
    let is_good = best.certified && best.off <= CLOSE * within;
    CubicNode { refinement, fitness: best.fitness(), points: best.points, quality: best.quality, is_good }
}

/// The lattices of the blocks of a node, its cells, and positions between those of its trilinear mesh.
fn started(node: &NodeMesh) -> (Refinement, Vec<[u32; 64]>, Vec<DVec3>) {
    let mut refinement = Refinement::new(3);
    let mut start = node.refinement.clone();
    let mut cells: Vec<[u32; 64]> = Vec::with_capacity(node.blocks.len());
    let mut positions: Vec<DVec3> = Vec::new();
    for block in &node.blocks {
        let lattice = refinement.lattice(*block);
        let coarse: Vec<DVec3> = start.lattice(*block).iter().map(|&v| node.positions[v as usize]).collect();
        for (k, &number) in lattice.iter().enumerate() {
            if number as usize >= positions.len() {
                positions.resize(number as usize + 1, DVec3::ZERO);
                positions[number as usize] = between(&coarse, place_of_64(k));
            }
        }
        cells.push(std::array::from_fn(|k| lattice[k]));
    }
    (refinement, cells, positions)
}

/// The first of these drafts that is proven, without and with mean ratios, or else the first one.
fn drafted(
    drafts: &[Draft<'_>],
    positions: &mut Vec<DVec3>,
    measured: &dyn Fn(Vec<DVec3>) -> Bent,
) -> Option<Bent> {
    let mut first: Option<Bent> = None;
    for draft in drafts {
        draft.untangle(positions);
        let untangled = positions.clone();
        // Mean ratios keep derivatives from vanishing between the points, where nothing else would see it.
        for even in [0.0, EVEN] {
            positions.clone_from(&untangled);
            draft.improve(even, positions);
            let found = measured(positions.clone());
            if found.certified {
                return Some(found);
            }
            first.get_or_insert(found);
        }
    }
    first
}

/// A lower bound on the scaled Jacobian over all cells.
fn proven(cells: &[[u32; 64]], points: &[DVec3], attained: f64) -> f64 {
    let bound = |cell: &[u32; 64]| scaled_jacobian_bound_bezier(&cell.map(|v| points[v as usize]), attained);
    cells.iter().map(bound).fold(attained, f64::min)
}

/// The control points, the least scaled Jacobian, and whether every cell is proven to have a positive Jacobian.
fn controlled(cells: &[[u32; 64]], positions: &[DVec3]) -> (Vec<DVec3>, f64, bool) {
    let (mut points, mut quality, mut certified) = (positions.to_vec(), f64::INFINITY, true);
    for cell in cells {
        let control = interpolate_lattice(&cell.map(|v| positions[v as usize]));
        quality = quality.min(scaled_jacobian_bezier(&control));
        certified &= certify_bezier(&control) == Jacobian::Positive;
        for (&v, point) in cell.iter().zip(control) {
            points[v as usize] = point;
        }
    }
    (points, quality, certified)
}

/// Trilinear interpolation, at a position in thirds, between 27 positions: interpolation of higher degree would fold more cells.
fn between(coarse: &[DVec3], place: [usize; 3]) -> DVec3 {
    const WEIGHTS: [[f64; 3]; 4] =
        [[1.0, 0.0, 0.0], [1.0 / 3.0, 2.0 / 3.0, 0.0], [0.0, 2.0 / 3.0, 1.0 / 3.0], [0.0, 0.0, 1.0]];
    let [a, b, c] = place.map(|i| WEIGHTS[i]);
    coarse.iter().enumerate().map(|(n, p)| *p * (a[n % 3] * b[n / 3 % 3] * c[n / 9])).sum()
}

/// Positions the sections at the ends of arms; returns the fixed positions, those on the wall, and the faces on it that have one that may move.
fn boundary(
    cluster: &Cluster,
    tubes: &[Tube],
    node: &NodeMesh,
    refinement: &Refinement,
    section: &Section,
    cells: &[[u32; 64]],
    positions: &mut [DVec3],
) -> (Vec<bool>, Vec<u32>, Vec<[u32; 16]>) {
    let mut is_wall = vec![false; positions.len()];
    let mut on_faces = Vec::new();
    let mut faces: Vec<([u32; 4], usize, usize)> = Vec::new();
    for (index, block) in node.blocks.iter().enumerate() {
        for (face, corners) in FACES.iter().enumerate() {
            let mut key = corners.map(|k| block[k]);
            key.sort_unstable();
            faces.push((key, index, face));
        }
    }
    faces.sort_unstable();
    for run in faces.chunk_by(|a, b| a.0 == b.0).filter(|run| run.len() == 1) {
        let (_, cell, face) = run[0];
        let (axis, side, along) = pompeiu_volume::FACE_AXES[face];
        let strides = [1, 4, 16];
        let at =
            |i: usize, j: usize| 3 * side * strides[axis] + i * strides[along[0]] + j * strides[along[1]];
        on_faces.push(std::array::from_fn(|k| cells[cell][at(k / 4, k % 4)]));
        for (k, &v) in cells[cell].iter().enumerate() {
            if place_of_64(k)[axis] == 3 * side {
                is_wall[v as usize] = true;
            }
        }
    }
    let mut fixed = vec![false; positions.len()];
    for (end_section, end) in node.sections.iter().zip(&cluster.ends) {
        let (at, radius) = end.section(tubes, end_section.at);
        let axis = end.tangent(tubes, end_section.at);
        let (e1, e2) = (end_section.side, axis.cross(end_section.side));
        for (v, key) in refinement.keys().iter().enumerate() {
            let (mut inner, mut outer, mut rest) = ([0.0; 4], [0.0; 4], 0.0);
            for (corner, weight) in key_weights(key) {
                let corner = corner as u32;
                if let Some(k) = end_section.inner.iter().position(|&c| c == corner) {
                    inner[k] = weight;
                } else if let Some(k) = end_section.outer.iter().position(|&c| c == corner) {
                    outer[k] = weight;
                } else {
                    rest += weight;
                }
            }
            if rest == 0.0 {
                let [x, y] = section.value(inner, outer);
                positions[v] = at + (e1 * x + e2 * y) * radius;
                fixed[v] = true;
            }
        }
    }
    let on_wall = (0..positions.len()).filter(|&v| is_wall[v] && !fixed[v]).map(|v| v as u32).collect();
    on_faces.retain(|face: &[u32; 16]| face.iter().any(|v| !fixed[*v as usize]));
    (fixed, on_wall, on_faces)
}

/// The mesh around a node while it is optimised.
struct Draft<'d> {
    energy: CubicEnergy<'d>,
    wall: &'d Wall,
    on_wall: &'d [u32],
    /// Positions that may move, and those of them inside.
    free: &'d [u32],
    inner: &'d [u32],
}

impl Draft<'_> {
    fn project(&self, positions: &mut [DVec3]) {
        for &v in self.on_wall {
            positions[v as usize] = self.wall.project(positions[v as usize]);
        }
    }

    /// Removes folds, with an increasing weight of the wall.
    fn untangle(&self, positions: &mut [DVec3]) {
        self.project(positions);
        let mut energy = CubicEnergy { free: self.free, ..self.energy };
        for (epsilon, weight) in [(0.02, 300.0), (0.002, 3000.0), (1e-4, 30_000.0)] {
            energy.shape = Shape::MeanRatio { epsilon };
            energy.wall = Some((self.wall, self.on_wall, weight));
            energy.minimise(positions, 25);
        }
        self.project(positions);
        if energy.quality(positions) <= 0.0 {
            energy.wall = None;
            energy.free = self.inner;
            energy.minimise(positions, 60);
        }
    }

    /// Improves the least scaled Jacobian at points, with this weight of mean ratios.
    fn improve(&self, even: f64, positions: &mut [DVec3]) {
        let wall = Some((self.wall, self.on_wall, 1e5));
        let mut energy = CubicEnergy { even, wall, ..self.energy };
        for power in [2, 4, 8] {
            energy.shape = Shape::Scaled { power };
            for moving in [self.free, self.inner] {
                let before = positions.to_vec();
                let was = energy.quality(positions);
                energy.free = moving;
                energy.minimise(positions, 25);
                self.project(positions);
                // Mean ratios cost some of it.
                let least = if even > 0.0 { 0.0 } else { was };
                if energy.quality(positions) < least {
                    positions.copy_from_slice(&before);
                }
            }
        }
    }
}
