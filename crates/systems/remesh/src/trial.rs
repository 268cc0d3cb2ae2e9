//! Whether an edge can be collapsed, and where to: the tests of a simplification, which change nothing.

use super::cover::{Affected, Cover, Covering};
use super::crossing::{CrossingScratch, Crossings};
use super::marked::{Collapse, Freedom, Marked};
use super::places::Places;
use super::quadric::Quadric;
use super::star::Star;
use super::triangle::Triangle;
use super::within::Input;
use glam::DVec3;
use pompeiu_core::spatial::bvh::{Slot, Workspace};

/// Pieces of a new face that are looked at before it is rejected: so many, and more for each face of the input near its star.
const LEAST_PIECES: usize = 256;
const PIECES_PER_FACE: usize = 4;

/// Positions nearer to each other than the root of this share of the edge's length are tried once.
const SAME_POSITION: f64 = 1e-6;

/// A position that costs more than this many times what its edge was queued for waits until it is its turn.
pub(super) const MOST_ABOVE: f64 = 1.01;

/// Weight of the squared length of an edge in its place in the queue, relative to the squared distances from planes: short edges first
/// where all errors vanish.
const LENGTH_WEIGHT: f64 = 1e-9;

/// Where an edge with some ends comes in the queue if it is collapsed to a position.
pub(super) fn place_in_queue(quadric: &Quadric, position: DVec3, [p, q]: [DVec3; 2]) -> f64 {
    quadric.at(position) + LENGTH_WEIGHT * quadric.weight() * p.distance_squared(q)
}

/// How far to move from the best position along the normal, as shares of the distance.
const OFFSETS: [f64; 4] = [0.25, -0.25, 0.5, -0.5];

/// Memory for the tests of one thread.
#[derive(Default)]
pub(super) struct Scratch {
    workspace: Workspace,
    affected: Affected,
    crossing: CrossingScratch,
}

/// Why an edge is not collapsed.
#[derive(Clone, Copy, Debug)]
pub(super) enum Refused {
    /// The surface would be no manifold, or of another topology.
    Topology,
    /// A curve that is kept would end, or two become one.
    Features,
    /// No position keeps the normals of all faces.
    Normals,
    /// No position that keeps the normals keeps faces from intersecting.
    Intersections,
    /// A distance below this one does not suffice, as far as is known.
    Below(f64),
    /// The best position costs this much, more than the edge was queued for.
    Costs(f64),
}

/// A collapse that passed all tests.
pub(super) struct Accepted {
    pub(super) collapse: Collapse,
    /// The faces that it changes or removes.
    pub(super) gone: Vec<u32>,
    /// What covers the input then, where a distance was asked for.
    pub(super) covering: Option<Covering>,
    /// A face of the input near the position.
    pub(super) near: Slot,
}

/// What the tests of a collapse look at.
pub(super) struct Trial<'t> {
    pub(super) surface: &'t Marked,
    pub(super) quadrics: &'t [Quadric],
    pub(super) places: &'t Places,
    pub(super) limit: f64,
    /// Which faces of the input each face covers, and the input; none where no distance was asked for.
    pub(super) cover: Option<(&'t Cover, &'t Input<'t>)>,
    /// Where faces are, if those must not intersect that do not now.
    pub(super) crossings: Option<&'t Crossings>,
}

impl Trial<'_> {
    /// How to collapse an edge whose place in the queue is that of an error.
    pub(super) fn of(&self, h: u32, queued: f64, scratch: &mut Scratch) -> Result<Accepted, Refused> {
        let mesh = &self.surface.mesh;
        // Of an edge between the boundary and the inside, the end on the boundary stays.
        let h = match mesh.twin_of(h) {
            Some(t) if mesh.is_boundary(mesh.from(h)) && !mesh.is_boundary(mesh.to(h)) => t,
            _ => h,
        };
        let way = self.surface.collapse_of(h).ok_or_else(|| match mesh.check_collapse(h) {
            Err(_) => Refused::Topology,
            Ok(()) => Refused::Features,
        })?;
        let mut else_refused = Refused::Normals;
        let mut least = f64::INFINITY;
        let mut fails = |needed_sq: f64| least = if needed_sq < least { needed_sq } else { least };
        let star = Star::new(self.surface, way.halfedge);
        let mut near = self.surface.near[mesh.to(way.halfedge) as usize];
        let mut faces = Vec::with_capacity(star.kept.len());
        let mut gathered = false;
        for position in self.positions(&way, &star) {
            star.moved(self.surface, position, &mut faces);
            if !star.keeps_normals(&faces) {
                continue;
            }
            let Some((cover, input)) = self.cover else {
                let error = self.error_at(way.halfedge, position);
                if error > MOST_ABOVE * queued {
                    return Err(Refused::Costs(error));
                }
                if !self.keeps_apart(&star, &faces, scratch) {
                    else_refused = Refused::Intersections;
                    continue;
                }
                let collapse = Collapse { position, ..way };
                return Ok(Accepted { collapse, gone: star.gone, covering: None, near });
            };
            if let Err(needed_sq) = may_be_near(input, position, &star, &faces, &mut near, scratch) {
                fails(needed_sq);
                continue;
            }
            // What faces cover takes longer to tell.
            if !self.keeps_apart(&star, &faces, scratch) {
                else_refused = Refused::Intersections;
                continue;
            }
            let at_position = near;
            let limit_sq = input.limit_sq;
            if !gathered
                && let Err(needed) = cover.may_cover(&mut scratch.affected, &star.gone, &faces, limit_sq)
            {
                fails(needed.0);
                continue;
            }
            if !std::mem::replace(&mut gathered, true) {
                cover.find_affected(&star.gone, &mut scratch.affected);
            }
            let anew =
                cover.cover_anew(mesh, &mut scratch.affected, &star.gone, &star.kept, &faces, limit_sq);
            let covering = match anew {
                Ok(covering) => covering,
                Err(needed) => {
                    fails(needed.0);
                    continue;
                }
            };
            // A face over many faces of the input takes as many pieces.
            let over: usize = star.kept.iter().map(|f| cover.covered_by(*f)).sum();
            let most_pieces = LEAST_PIECES + PIECES_PER_FACE * over;
            let workspace = &mut scratch.workspace;
            let mut start = near;
            let is_near = |t: &Triangle| input.is_near(*t, most_pieces, &mut start, workspace);
            if faces.iter().all(is_near) {
                let collapse = Collapse { position, ..way };
                let covering = Some(covering);
                return Ok(Accepted { collapse, gone: star.gone, covering, near: at_position });
            }
            fails(0.0);
        }
        let is_below = least < f64::INFINITY && !matches!(else_refused, Refused::Intersections);
        Err(if is_below { Refused::Below(least.sqrt()) } else { else_refused })
    }

    /// Whether no faces intersect after a collapse that do not now, if that is asked for.
    fn keeps_apart(&self, star: &Star, faces: &[Triangle], scratch: &mut Scratch) -> bool {
        self.crossings.is_none_or(|known| known.allow(self.surface, star, faces, &mut scratch.crossing))
    }

    /// What a position costs in the queue.
    fn error_at(&self, h: u32, position: DVec3) -> f64 {
        let mesh = &self.surface.mesh;
        let [u, v] = [mesh.from(h), mesh.to(h)].map(|x| x as usize);
        let quadric = self.quadrics[u].plus(&self.quadrics[v]);
        place_in_queue(&quadric, position, [mesh.positions[u], mesh.positions[v]])
    }

    /// Positions to try, the one of least error first.
    fn positions(&self, way: &Collapse, star: &Star) -> Vec<DVec3> {
        let mesh = &self.surface.mesh;
        let [u, v] = [mesh.from(way.halfedge), mesh.to(way.halfedge)].map(|x| x as usize);
        let boundary = [u, v].map(|x| mesh.is_boundary(x as u32));
        if way.freedom == Freedom::None {
            return vec![way.position];
        }
        if boundary == [false, true] {
            return vec![mesh.positions[v]];
        }
        let [p, q] = [u, v].map(|x| mesh.positions[x]);
        let middle = 0.5 * (p + q);
        let best = self.quadrics[u].plus(&self.quadrics[v]).optimum(middle);
        let mut all = vec![best, middle, q, p];
        if way.freedom == Freedom::Surface {
            all.extend([middle, p, q].map(|x| 0.5 * (best + x)));
            if self.limit.is_finite() {
                let normal = star.normals.iter().sum::<DVec3>().normalize_or_zero();
                all.extend(OFFSETS.map(|share| best + share * self.limit * normal));
            }
        }
        // In flat places several are one.
        let apart = SAME_POSITION * p.distance_squared(q);
        let mut different: Vec<DVec3> = Vec::with_capacity(all.len());
        for position in all.into_iter().map(|p| self.places.near(p)) {
            if different.iter().all(|x| x.distance_squared(position) > apart) {
                different.push(position);
            }
        }
        if self.cover.is_none() {
            let quadric = self.quadrics[u].plus(&self.quadrics[v]);
            different.sort_by(|x, y| quadric.at(*x).total_cmp(&quadric.at(*y)));
        }
        different
    }
}

/// Looks whether some points of new faces are near the input: most positions that must be rejected are rejected here.
fn may_be_near(
    input: &Input<'_>,
    position: DVec3,
    star: &Star,
    faces: &[Triangle],
    near: &mut Slot,
    scratch: &mut Scratch,
) -> Result<(), f64> {
    let workspace = &mut scratch.workspace;
    input.find_near(position, near, workspace)?;
    let mut start = *near;
    faces.iter().zip(&star.corners).try_for_each(|([a, b, c], corner)| {
        let beside = [a, b, c][(corner + 1) % 3];
        input.find_near((*a + *b + *c) / 3.0, &mut start, workspace)?;
        input.find_near(0.5 * (position + *beside), &mut start, workspace)
    })
}
