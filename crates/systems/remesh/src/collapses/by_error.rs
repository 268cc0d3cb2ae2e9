//! Collapsing edges in order of their quadric error alone, one after the other.
//!
//! Quadrics are added up, so an error only grows: what is known of an edge stays a lower bound when its ends change. Edges around a
//! collapse are not looked at before it is their turn, which saves most of the work.

use super::{Collapses, PUSHED_TASK};
use crate::marked::{Collapse, Freedom, Hold};
use crate::queue::Entry;
use crate::star::keeps_normal;
use crate::trial::{MOST_ABOVE, Refused, place_in_queue};
use glam::DVec3;
use pompeiu_core::run::{Control, ProgressObserver};
use rayon::prelude::*;

/// Edges that are looked at between two looks at the limits.
const STOP_EVERY: usize = 256;

/// What became of an edge.
enum Outcome {
    /// It can be collapsed like this.
    Found(Collapse),
    /// It costs more than it was queued for.
    Costs(f64),
    /// It cannot be collapsed while all around it is as it is.
    Refused,
}

impl Collapses<'_> {
    /// Collapses edges until none can be, or there are few enough, or the computation is told to stop.
    pub(super) fn run_by_error(&mut self, control: &Control, progress: Option<&dyn ProgressObserver>) {
        let all = self.surface.mesh.face_count() as f64;
        // By the halfedge that names an edge. Where two edges become one, the one that stays may keep what was known of either.
        let mut is_queued = vec![false; self.surface.mesh.origin.len()];
        for _ in 0..self.most_passes {
            let before = self.count;
            self.queue_all(&mut is_queued);
            for step in 0.. {
                let is_over = self.surface.mesh.face_count() <= self.least_faces;
                if is_over || step % STOP_EVERY == 0 && control.is_stopped() {
                    self.queue.clear();
                    return;
                }
                if step % STOP_EVERY == 0 {
                    self.report(all, control, progress);
                }
                let Some(entry) = self.queue.pop() else { break };
                is_queued[entry.halfedge as usize] = false;
                if !self.surface.mesh.names_edge(entry.halfedge) {
                    continue;
                }
                match self.outcome_by_error(entry) {
                    Outcome::Found(collapse) => self.collapse_by_error(&collapse, &mut is_queued),
                    Outcome::Costs(error) => self.queue_for(entry.halfedge, error, &mut is_queued),
                    Outcome::Refused => {}
                }
            }
            if self.count == before {
                return;
            }
        }
    }

    fn queue_all(&mut self, is_queued: &mut [bool]) {
        let edges: Vec<u32> = self.surface.mesh.edges().collect();
        let error = |h: &u32| self.goal(*h).1;
        let errors: Vec<f64> = edges.par_iter().with_min_len(PUSHED_TASK).map(error).collect();
        for (h, error) in edges.into_iter().zip(errors) {
            self.queue_for(h, error, is_queued);
        }
    }

    fn queue_for(&mut self, h: u32, error: f64, is_queued: &mut [bool]) {
        is_queued[h as usize] = true;
        let versions = self.versions_of(h);
        self.queue.push(Entry { halfedge: h, error, versions });
    }

    /// Where an edge is collapsed to if nothing is in the way, and what that costs.
    fn goal(&self, h: u32) -> (DVec3, f64) {
        let mesh = &self.surface.mesh;
        let [u, v] = [mesh.from(h), mesh.to(h)];
        let [p, q] = [u, v].map(|x| mesh.positions[x as usize]);
        let quadric = self.quadrics[u as usize].plus(&self.quadrics[v as usize]);
        let position = match [u, v].map(|x| mesh.is_boundary(x)) {
            [true, false] => p,
            [false, true] => q,
            _ => self.places.near(quadric.optimum(0.5 * (p + q))),
        };
        (position, place_in_queue(&quadric, position, [p, q]))
    }

    fn outcome_by_error(&self, entry: Entry) -> Outcome {
        let h = entry.halfedge;
        let (position, error) = self.goal(h);
        if error > MOST_ABOVE * entry.error {
            return Outcome::Costs(error);
        }
        let mesh = &self.surface.mesh;
        let is_free =
            [mesh.from(h), mesh.to(h)].into_iter().all(|v| self.surface.hold[v as usize] == Hold::Free);
        if is_free {
            // Of an edge between the boundary and the inside, the end on the boundary stays.
            let halfedge = match mesh.twin_of(h) {
                Some(t) if mesh.is_boundary(mesh.from(h)) && !mesh.is_boundary(mesh.to(h)) => t,
                _ => h,
            };
            if mesh.check_collapse(halfedge).is_err() {
                return Outcome::Refused;
            }
            if self.keeps_normals(halfedge, position) {
                return Outcome::Found(Collapse { halfedge, position, freedom: Freedom::Surface });
            }
        }
        // Where it was queued again, for a position that is not the best, it may cost that much.
        let may_cost = if error > entry.error { error } else { entry.error };
        match self.tried(h, may_cost) {
            Ok(accepted) => Outcome::Found(accepted.collapse),
            Err(Refused::Costs(error)) => Outcome::Costs(error),
            Err(_) => Outcome::Refused,
        }
    }

    /// Whether no face turns over when an edge is collapsed to a position.
    fn keeps_normals(&self, h: u32, position: DVec3) -> bool {
        let mesh = &self.surface.mesh;
        let gone = [Some(h), mesh.twin_of(h)].map(|x| x.map(|x| x / 3));
        let mut around = mesh.halfedges_from(mesh.from(h)).chain(mesh.halfedges_from(mesh.to(h)));
        around.all(|x| {
            if gone.contains(&Some(x / 3)) {
                return true;
            }
            let old = self.surface.triangle(x / 3);
            let mut new = old;
            new[(x % 3) as usize] = position;
            keeps_normal(old, new)
        })
    }

    /// Collapses an edge, and queues those around that are not.
    fn collapse_by_error(&mut self, collapse: &Collapse, is_queued: &mut [bool]) {
        let u = self.surface.mesh.from(collapse.halfedge) as usize;
        let v = self.surface.collapse_checked(collapse);
        self.merge(u, v as usize);
        let mesh = &self.surface.mesh;
        let names = mesh.edges_at(v).map(|h| mesh.name_of(h));
        let missing: Vec<u32> = names.filter(|name| !is_queued[*name as usize]).collect();
        for h in missing {
            let error = self.goal(h).1;
            self.queue_for(h, error, is_queued);
        }
    }
}
