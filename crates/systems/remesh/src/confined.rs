//! Remeshing whose every operation keeps the surface within a distance of the input.

use super::batch::{MOST_PIECES, move_all};
use super::connectivity::NONE;
use super::cover::{Affected, Cover, Covering};
use super::flips::{hinge, lowers_cotangents};
use super::isotropic::{SHORTEST, STEPS, is_harmless};
use super::marked::{Collapse, Freedom, Marked};
use super::places::Places;
use super::reference::Reference;
use super::smooth::{Move, smooth};
use super::star::Star;
use super::triangle::Triangle;
use super::within::Input;
use glam::DVec3;
use pompeiu_core::MeshError;
use pompeiu_core::geom::point_triangle::distance_sq;
use pompeiu_core::run::Control;
use pompeiu_core::spatial::bvh::{Slot, Workspace};
use rayon::prelude::*;

/// Ways of a vertex that are shorter than this share of its target length are not worth a test.
const SHORT_WAY: f64 = 0.1;

/// Operations between two looks at the limits.
const STOP_EVERY: u32 = 256;

/// A surface that lies within a distance of the input, and the input within that distance of it, at any time.
pub(super) struct Confined<'r> {
    pub(super) surface: Marked,
    /// The vertices that may be changed.
    open: Vec<bool>,
    /// The vertices whose faces have changed.
    changed: Vec<bool>,
    reference: &'r Reference<'r>,
    input: Input<'r>,
    places: Places,
    cover: Cover,
    affected: Affected,
    workspace: Workspace,
}

impl<'r> Confined<'r> {
    /// Begins with a surface within a limit of the input that the reference was made of, and with what covers the input; changes what is at
    /// vertices that are open.
    pub(super) fn new(
        surface: Marked,
        open: Vec<bool>,
        cover: Cover,
        reference: &'r Reference<'r>,
        places: Places,
        limit: f64,
    ) -> Self {
        let input = Input { bvh: &reference.bvh, limit_sq: limit * limit };
        let (affected, workspace) = (Affected::default(), Workspace::default());
        let changed = vec![false; open.len()];
        Self { surface, open, changed, reference, input, places, cover, affected, workspace }
    }

    /// Collapses short edges, flips edges towards Delaunay triangles and moves vertices towards the middle of their neighbours, where
    /// the surface stays within the distance.
    /// What was tried in vain is tried again only where something has changed since. Whether anything has.
    pub(super) fn iterate(&mut self, control: &Control) -> Result<bool, MeshError> {
        self.collapse_short(control);
        self.flip(control);
        if !control.is_stopped() {
            self.smooth()?;
        }
        let none = vec![false; self.changed.len()];
        self.open = std::mem::replace(&mut self.changed, none);
        Ok(self.open.contains(&true))
    }

    fn collapse_short(&mut self, control: &Control) {
        for h in 0..self.surface.mesh.halfedge_slots() {
            if h % STOP_EVERY == 0 && control.is_stopped() {
                return;
            }
            let mesh = &self.surface.mesh;
            if mesh.names_edge(h)
                && [mesh.from(h), mesh.to(h)].into_iter().any(|v| self.open[v as usize])
                && self.surface.share_sq(h) < SHORTEST * SHORTEST
            {
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
                self.note(v);
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
            let may_flip = corners.into_iter().any(|v| self.open[v as usize])
                && self.surface.curve[h as usize] == NONE
                && mesh.check_flip(h).is_ok();
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
                for v in corners {
                    self.changed[v as usize] = true;
                }
            }
        }
    }

    /// Moves vertices towards the middle of their neighbours, all at once.
    fn smooth(&mut self) -> Result<(), MeshError> {
        let moves = self.moves();
        let moved = move_all(&mut self.surface, &self.input, &mut self.cover, &moves)?;
        for v in (0..moved.len() as u32).filter(|&v| moved[v as usize]) {
            self.note(v);
        }
        Ok(())
    }

    /// Where vertices go that are to be moved far enough.
    fn moves(&self) -> Vec<Option<Move>> {
        let mut there = self.surface.clone();
        smooth(&mut there, Some(self.reference), STEPS);
        there.mesh.positions.iter_mut().for_each(|p| *p = self.places.near(*p));
        let of_vertex = |workspace: &mut Workspace, v: u32| {
            let i = v as usize;
            let (from, position) = (self.surface.mesh.positions[i], there.mesh.positions[i]);
            let least = SHORT_WAY * self.surface.length[i];
            let is_far = || from.distance_squared(position) > least * least;
            (self.open[i]
                && self.surface.mesh.has_faces(v)
                && is_far()
                && self.may_leave(&there, v, workspace))
            .then(|| Move { position, near: there.near[i], length: there.length[i] })
        };
        let vertices: Vec<u32> = (0..there.hold.len() as u32).collect();
        vertices.par_iter().map_init(Workspace::default, |workspace, &v| of_vertex(workspace, v)).collect()
    }

    /// Whether the faces at a vertex come near the point of the input where it is now, wherever all vertices go: most vertices that may not
    /// move are found out here.
    fn may_leave(&self, there: &Marked, v: u32, workspace: &mut Workspace) -> bool {
        let from = self.surface.mesh.positions[v as usize];
        let left = self.reference.project(from, self.surface.near[v as usize], workspace).position.to_array();
        there.mesh.halfedges_from(v).any(|h| {
            let [a, b, c] = there.triangle(h / 3).map(|p| p.to_array());
            distance_sq(left, a, b, c) <= self.input.limit_sq
        })
    }

    /// Notes that the faces around a vertex have changed.
    fn note(&mut self, v: u32) {
        self.changed[v as usize] = true;
        for w in self.surface.mesh.neighbours(v) {
            self.changed[w as usize] = true;
        }
    }

    /// What covers the input if the faces `gone` go and those of them that are `kept` become `new`; none if something would be
    /// too far away, as far as is found.
    fn try_change(&mut self, gone: &[u32], kept: &[u32], new: &[Triangle], near: Slot) -> Option<Covering> {
        let Self { surface, input, cover, affected, workspace, .. } = self;
        cover.may_cover(affected, gone, new, input.limit_sq).ok()?;
        let mut start = near;
        for [a, b, c] in new {
            // Most changes that are too far away are so in the middle of a face or of an edge.
            for p in [(*a + *b + *c) / 3.0, 0.5 * (*a + *b), 0.5 * (*b + *c), 0.5 * (*c + *a)] {
                input.find_near(p, &mut start, workspace).ok()?;
            }
        }
        cover.find_affected(gone, affected);
        let covering = cover.cover_anew(&surface.mesh, affected, gone, kept, new, input.limit_sq).ok()?;
        let is_near = |triangle: &Triangle| input.is_near(*triangle, MOST_PIECES, &mut start, workspace);
        new.iter().all(is_near).then_some(covering)
    }
}
