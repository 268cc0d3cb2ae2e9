//! Splits of long edges: those of long thin faces first, with flips between them, then all others.

use super::connectivity::{NONE, next, previous};
use super::flips::{hinge, lowers_cotangents};
use super::marked::{Hold, Marked};
use super::reference::Reference;
use super::triangle::shape;
use glam::DVec3;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::bvh::Workspace;
use std::collections::BinaryHeap;

/// Halfedges between two looks at the limits.
pub(super) const STOP_EVERY: u32 = 4096;

/// Height over length below which a face with a long edge is a needle.
const NEEDLE: f64 = 0.1;

/// Edges along which the surface is flat are split only when those along which it bends are no longer than this share of them: often a
/// flip makes them short before.
const FLAT_LATER: f64 = 0.5;

/// How far a flip may move the surface at most, as a share of the target length: less than chords of that length cut off.
const MOST_HEIGHT: f64 = 0.05;

/// How far flips may move a surface that is to stay where it is, as a share of the distance that is asked for: as little as rounding.
const STILL: f64 = 1e-6;

/// More faces than were allowed.
pub(super) struct TooMany;

/// What flips between splits may do.
#[derive(Clone, Copy)]
pub(super) struct Flips<'r> {
    /// The input that the surface stays near.
    reference: Option<&'r Reference<'r>>,
    /// How far a flip may move the surface at most, whatever the target length.
    most: f64,
}

impl<'r> Flips<'r> {
    /// Those that cut off less than edges of the target length do.
    pub(super) fn near(reference: Option<&'r Reference<'r>>) -> Self {
        Self { reference, most: f64::INFINITY }
    }

    /// Those that leave the surface where it is, as far as a distance can tell.
    pub(super) fn in_place(distance: f64) -> Self {
        Self { reference: None, most: STILL * distance }
    }
}

/// Splits edges longer than this many target lengths, the longest first, until there is none; those of needles before, with flips.
pub(super) fn split_longer_than(
    surface: &mut Marked,
    longest: f64,
    flips: Flips<'_>,
    most_faces: usize,
    control: &Control,
) -> Result<(), TooMany> {
    split_needles(surface, longest, flips, most_faces, control)?;
    let longest_sq = longest * longest;
    loop {
        let mut long: Vec<(f64, u32)> = surface
            .mesh
            .edges()
            .map(|h| (surface.share_sq(h), h))
            .filter(|(share, _)| *share > longest_sq)
            .collect();
        if long.is_empty() || control.is_stopped() {
            return Ok(());
        }
        long.sort_unstable_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)));
        for (i, (_, h)) in (0..).zip(long) {
            if i % STOP_EVERY == 0 && control.is_stopped() {
                return Ok(());
            }
            if surface.mesh.face_count() + 2 > most_faces {
                return Err(TooMany);
            }
            surface.split(h);
        }
    }
}

/// Splits edges of needles that are longer than `longest` times their target, the longest first, and flips edges of needles after each
/// split towards Delaunay triangles where the surface is so flat that this moves it by little.
///
/// # Why not splits alone
/// Two needles that make a strip have three long edges: both sides and the diagonal. Halving all of them halves the width with the length, so
/// that the needles remain needles: a strip of n lengths becomes n² faces. Once the sides are split, the diagonal can be flipped.
fn split_needles(
    surface: &mut Marked,
    longest: f64,
    flips: Flips<'_>,
    most_faces: usize,
    control: &Control,
) -> Result<(), TooMany> {
    let queue = BinaryHeap::new();
    let mut needles =
        Needles { surface, longest_sq: longest * longest, flips, queue, workspace: Workspace::default() };
    for h in 0..needles.surface.mesh.halfedge_slots() {
        if needles.surface.mesh.names_edge(h) {
            needles.push(h);
        }
    }
    for step in 1.. {
        let Some((bits, h)) = needles.queue.pop() else { break };
        if needles.key(h).is_none_or(|key| key.to_bits() != bits) {
            continue;
        }
        if step % STOP_EVERY == 0 && control.is_stopped() {
            break;
        }
        if needles.surface.mesh.face_count() + 2 > most_faces {
            return Err(TooMany);
        }
        needles.split(h);
    }
    Ok(())
}

struct Needles<'s, 'r> {
    surface: &'s mut Marked,
    longest_sq: f64,
    flips: Flips<'r>,
    /// Bits of the key of an edge, ordered as the keys are, with its halfedge.
    queue: BinaryHeap<(u64, u32)>,
    workspace: Workspace,
}

impl Needles<'_, '_> {
    /// What the order of an edge in the queue depends on; none if it need not be split.
    fn key(&self, h: u32) -> Option<f64> {
        let surface = &*self.surface;
        if !surface.mesh.names_edge(h) {
            return None;
        }
        let share = surface.share_sq(h);
        (share > self.longest_sq && self.is_at_needle(h))
            .then(|| if self.may_flip(h) { FLAT_LATER * FLAT_LATER * share } else { share })
    }

    fn push(&mut self, h: u32) {
        let other = self.surface.mesh.twin[h as usize];
        let h = if other < h { other } else { h };
        if let Some(key) = self.key(h) {
            self.queue.push((key.to_bits(), h));
        }
    }

    fn is_at_needle(&self, h: u32) -> bool {
        let faces = [Some(h), self.surface.mesh.twin_of(h)].into_iter().flatten();
        faces.into_iter().any(|h| shape(self.surface.triangle(h / 3)) < NEEDLE)
    }

    /// The corners of both faces at an edge that is on no curve.
    fn corners(&self, h: u32) -> Option<[DVec3; 4]> {
        let surface = &*self.surface;
        let t = surface.mesh.twin_of(h).filter(|_| surface.curve[h as usize] == NONE)?;
        Some(hinge(&surface.mesh, h, t).map(|v| surface.mesh.positions[v as usize]))
    }

    /// Whether both faces at an edge are so nearly in one plane that a flip moves the surface by little.
    fn may_flip(&self, h: u32) -> bool {
        self.corners(h).is_some_and(|corners| {
            let [p, q] = [h, next(h)].map(|x| self.surface.length[self.surface.mesh.from(x) as usize]);
            let most = MOST_HEIGHT * if p < q { p } else { q };
            height(corners) <= if most < self.flips.most { most } else { self.flips.most }
        })
    }

    /// Whether the middle of the edge that a flip makes is near the input.
    fn stays_near(&mut self, h: u32, [_, _, a, b]: [DVec3; 4]) -> bool {
        let Some(reference) = self.flips.reference else { return true };
        let middle = 0.5 * (a + b);
        let v = self.surface.mesh.from(h) as usize;
        let found = reference.project(middle, self.surface.near[v], &mut self.workspace);
        let most = MOST_HEIGHT * self.surface.length[v];
        found.position.distance_squared(middle) <= most * most
    }

    /// Splits an edge, then flips around the new vertex.
    fn split(&mut self, h: u32) {
        let w = self.surface.split(h);
        self.settle(w);
        let around: Vec<u32> = self.surface.mesh.halfedges_from(w).collect();
        let mut open: Vec<u32> = around.iter().flat_map(|&x| [x, next(x), previous(x)]).collect();
        let mut changed = open.clone();
        while let Some(x) = open.pop() {
            if !self.is_at_needle(x) || !self.may_flip(x) {
                continue;
            }
            let Some(corners) = self.corners(x) else { continue };
            if !lowers_cotangents(corners) || !self.stays_near(x, corners) || !self.surface.flip(x) {
                continue;
            }
            let t = self.surface.mesh.twin[x as usize];
            open.extend([next(x), previous(x), next(t), previous(t)]);
            changed.extend([x, next(x), previous(x), next(t), previous(t)]);
        }
        changed.sort_unstable();
        changed.dedup();
        for x in changed {
            self.push(x);
        }
    }

    /// Puts a new vertex onto the input, if that is near.
    fn settle(&mut self, w: u32) {
        let Some(reference) = self.flips.reference else { return };
        let i = w as usize;
        let p = self.surface.mesh.positions[i];
        let found = reference.project(p, self.surface.near[i], &mut self.workspace);
        self.surface.near[i] = found.slot;
        if found.length > 0.0 && found.length < f64::INFINITY {
            self.surface.length[i] = found.length;
        }
        let most = MOST_HEIGHT * self.surface.length[i];
        if self.surface.hold[i] == Hold::Free && found.position.distance_squared(p) <= most * most {
            self.surface.mesh.positions[i] = found.position;
        }
    }
}

/// The distance between the lines along both diagonals of two faces at an edge: how far a flip moves the surface.
fn height([u, v, a, b]: [DVec3; 4]) -> f64 {
    let normal = (v - u).cross(b - a);
    match normal.try_normalize() {
        Some(normal) => normal.dot(a - u).abs(),
        None => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::super::connectivity::DynamicMesh;
    use super::super::features::{Curves, Features};
    use super::super::reference::identity;
    use super::*;
    use pompeiu_core::mesh::{MeshSummary, shapes};
    use pompeiu_core::run::Limits;
    use pompeiu_core::spatial::bvh::Bvh;

    #[test]
    fn a_strip_is_cut_across_and_stays_where_it_is() {
        let shape = shapes::cuboid([1000.0, 1.0, 2.0], 1).expect("a box");
        let mesh = DynamicMesh::new(shape.positions(), shape.faces()).expect("a manifold");
        let curves = Curves::find(&mesh, &Features::default());
        let near = vec![Bvh::build(&shape, &identity()).any_slot(); mesh.positions.len()];
        let mut surface = Marked {
            curve: curves.of_halfedge,
            hold: curves.hold,
            length: vec![1.0; near.len()],
            near,
            mesh,
        };
        let control = Control::start(&Limits::default());
        let done = split_needles(&mut surface, 2.0, Flips::in_place(1e-3), 100_000, &control);
        assert!(done.is_ok());
        surface.assert_valid();
        // Halved seven times, each of the four long sides has 128 pairs of faces; halving all edges would make half a million.
        assert!((1000..1500).contains(&surface.mesh.face_count()), "{}", surface.mesh.face_count());
        let is_short = |h: u32| surface.share_sq(h) < (2.0 / NEEDLE).powi(2);
        assert!(surface.mesh.edges().all(is_short), "what is left is no needle");
        let found = surface.mesh.to_mesh().expect("a mesh");
        assert!((MeshSummary::of(&found).area / MeshSummary::of(&shape).area - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_distance_between_diagonals() {
        let at = DVec3::new;
        let hinge = |z| [at(0.0, 0.0, 0.0), at(2.0, 2.0, 0.0), at(0.0, 2.0, z), at(2.0, 0.0, z)];
        assert_eq!(height(hinge(0.0)), 0.0);
        assert!((height(hinge(0.5)) - 0.5).abs() < 1e-15);
    }
}
