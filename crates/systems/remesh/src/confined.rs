//! Remeshing whose every operation keeps the surface within a distance of the input.

use super::candidates::Triangle;
use super::connectivity::{DynamicMesh, NONE};
use super::cover::{Affected, Cover, Covering};
use super::flips::{hinge, lowers_cotangents};
use super::isotropic::{SHORTEST, is_harmless};
use super::marked::{Collapse, Freedom, Hold, Marked};
use super::places::Places;
use super::reference::Reference;
use super::smooth::{Move, Rings, keeps_normal, projected, relaxed};
use super::trial::Star;
use super::within::Input;
use glam::DVec3;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::bvh::{Slot, Workspace};

/// Pieces of a new face that are looked at before it counts as too far away.
const MOST_PIECES: usize = 128;

/// Ways of a vertex that are shorter than this share of its target length are not worth a test.
const SHORT_WAY: f64 = 0.1;

/// Operations between two looks at the limits.
const STOP_EVERY: u32 = 256;

/// A surface that lies within a distance of the input, and the input within that distance of it, at any time.
pub(super) struct Confined<'r> {
    pub(super) surface: Marked,
    reference: &'r Reference<'r>,
    input: Input<'r>,
    places: Places,
    cover: Cover,
    affected: Affected,
    workspace: Workspace,
}

impl<'r> Confined<'r> {
    /// Begins with the surface that the reference was made of.
    pub(super) fn new(surface: Marked, reference: &'r Reference<'r>, places: Places, limit: f64) -> Self {
        let cover = Cover::new(&surface.mesh, &reference.bvh);
        let input = Input { bvh: &reference.bvh, limit_sq: limit * limit };
        let (affected, workspace) = (Affected::default(), Workspace::default());
        Self { surface, reference, input, places, cover, affected, workspace }
    }

    /// Collapses short edges, flips edges towards Delaunay triangles and moves vertices towards the middle of their neighbours, where
    /// the surface stays within the distance.
    pub(super) fn iterate(&mut self, control: &Control) {
        self.collapse_short(control);
        self.flip(control);
        self.smooth(control);
    }

    fn collapse_short(&mut self, control: &Control) {
        for h in 0..self.surface.mesh.halfedge_slots() {
            if h % STOP_EVERY == 0 && control.is_stopped() {
                return;
            }
            if self.surface.mesh.names_edge(h) && self.surface.share_sq(h) < SHORTEST * SHORTEST {
                self.collapse(h);
            }
        }
    }

    /// Collapses an edge to one of some positions, if it can be.
    fn collapse(&mut self, h: u32) {
        let Some(way) = self.surface.collapse_of(h) else { return };
        let star = Star::new(&self.surface, way.halfedge);
        let end = self.surface.mesh.to(way.halfedge);
        let mut new = Vec::with_capacity(star.kept.len());
        for (position, near) in self.positions(&way, end) {
            let collapse = Collapse { position, ..way };
            if !is_harmless(&self.surface, &collapse) {
                continue;
            }
            star.moved(&self.surface, position, &mut new);
            let Some(covering) = self.try_change(&star.gone, &star.kept, &new, near) else { continue };
            if let Some(v) = self.surface.collapse(&collapse) {
                self.cover.replace(&star.gone, &covering);
                self.surface.near[v as usize] = near;
            }
            return;
        }
    }

    /// Positions to try, each with a face of the input near it.
    fn positions(&mut self, way: &Collapse, end: u32) -> Vec<(DVec3, Slot)> {
        let mesh = &self.surface.mesh;
        let near = self.surface.near[end as usize];
        if way.freedom == Freedom::None {
            return vec![(self.places.near(way.position), near)];
        }
        let ends = [mesh.to(way.halfedge), mesh.from(way.halfedge)].map(|v| mesh.positions[v as usize]);
        let mut all = Vec::with_capacity(3);
        if way.freedom == Freedom::Surface {
            let found = self.reference.project(way.position, near, &mut self.workspace);
            all.push((self.places.near(found.position), found.slot));
        } else {
            all.push((self.places.near(way.position), near));
        }
        all.extend(ends.map(|p| (p, near)));
        all
    }

    fn flip(&mut self, control: &Control) {
        for h in 0..self.surface.mesh.halfedge_slots() {
            if h % STOP_EVERY == 0 && control.is_stopped() {
                return;
            }
            let mesh = &self.surface.mesh;
            let Some(t) = mesh.exists(h).then(|| mesh.twin_of(h)).flatten().filter(|&t| h < t) else {
                continue;
            };
            let corners = hinge(mesh, h, t);
            let [u, v, a, b] = corners.map(|x| mesh.positions[x as usize]);
            let may_flip = self.surface.curve[h as usize] == NONE && mesh.check_flip(h).is_ok();
            if !may_flip || !lowers_cotangents([u, v, a, b]) {
                continue;
            }
            // As [`DynamicMesh::flip`] leaves them.
            let (faces, new) = ([h / 3, t / 3], [[a, b, v], [b, a, u]]);
            let near = self.surface.near[corners[2] as usize];
            if let Some(covering) = self.try_change(&faces, &faces, &new, near)
                && self.surface.flip(h)
            {
                self.cover.replace(&faces, &covering);
            }
        }
    }

    fn smooth(&mut self, control: &Control) {
        let rings = Rings::of(&self.surface);
        for v in 0..self.surface.mesh.positions.len() as u32 {
            if v % STOP_EVERY == 0 && control.is_stopped() {
                return;
            }
            if self.surface.mesh.outgoing[v as usize] != NONE && self.surface.hold[v as usize] != Hold::Corner
            {
                let to = relaxed(&self.surface, &rings, v).position;
                self.move_to(v, to);
            }
        }
    }

    /// Moves a vertex towards a point and onto the input, as far as it may.
    fn move_to(&mut self, v: u32, to: DVec3) {
        let from = self.surface.mesh.positions[v as usize];
        let least = SHORT_WAY * self.surface.length[v as usize];
        if from.distance_squared(to) < least * least {
            return;
        }
        self.surface.mesh.positions[v as usize] = to;
        let Move { position, near, length } =
            projected(&self.surface, self.reference, v, &mut self.workspace);
        self.surface.mesh.positions[v as usize] = from;
        let position = self.places.near(position);
        let (faces, corners) = faces_at(&self.surface.mesh, v);
        let old = faces.iter().map(|&f| self.surface.triangle(f));
        let new: Vec<Triangle> = old
            .zip(&corners)
            .map(|(mut triangle, &corner)| {
                triangle[corner] = position;
                triangle
            })
            .collect();
        let keeps = |(f, new): (&u32, &Triangle)| keeps_normal(self.surface.triangle(*f), *new);
        if !faces.iter().zip(&new).all(keeps) {
            return;
        }
        if let Some(covering) = self.try_change(&faces, &faces, &new, near) {
            self.cover.replace(&faces, &covering);
            self.surface.mesh.positions[v as usize] = position;
            (self.surface.near[v as usize], self.surface.length[v as usize]) = (near, length);
        }
    }

    /// What covers the input if the faces `gone` go and those of them that are `kept` become `new`; none if something would be
    /// too far away, as far as is found.
    fn try_change(&mut self, gone: &[u32], kept: &[u32], new: &[Triangle], near: Slot) -> Option<Covering> {
        let Self { surface, input, cover, affected, workspace, .. } = self;
        let mut start = near;
        for [a, b, c] in new {
            // Most changes that are too far away are so in the middle of a face or of an edge.
            for p in [(*a + *b + *c) / 3.0, 0.5 * (*a + *b), 0.5 * (*b + *c), 0.5 * (*c + *a)] {
                input.find_near(p, &mut start, workspace).ok()?;
            }
        }
        cover.may_cover(affected, gone, new, input.limit_sq).ok()?;
        cover.find_affected(gone, affected);
        let covering = cover.cover_anew(&surface.mesh, affected, gone, kept, new, input.limit_sq).ok()?;
        let is_near = |triangle: &Triangle| input.is_near(*triangle, MOST_PIECES, &mut start, workspace);
        new.iter().all(is_near).then_some(covering)
    }
}

/// The faces at a vertex, and which corner of each it is.
fn faces_at(mesh: &DynamicMesh, v: u32) -> (Vec<u32>, Vec<usize>) {
    mesh.halfedges_from(v).map(|h| (h / 3, (h % 3) as usize)).unzip()
}
