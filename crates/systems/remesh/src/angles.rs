//! Raising the least angles of a remeshed surface, one face after the other.

use super::flips::hinge;
use super::local::{Collapsible, Fan, Local, distance_from, flipped, least_sine, middle, sine};
use super::marked::{Collapse, Freedom, Hold};
use super::triangle::Triangle;
use glam::DVec3;
use pompeiu_core::spatial::bvh::Slot;

/// Rounds over the faces with small angles.
const ROUNDS: usize = 8;

/// First step of a vertex in the search for a better place, in target lengths.
const STEP: f64 = 0.25;

/// By how much the sine of an angle must grow for a vertex to move.
const WORTH: f64 = 1e-3;

impl Local<'_> {
    /// Flips edges, moves vertices and collapses edges at faces with angles below one, in degrees, where this makes the least angle there
    /// greater, and moves the surface by at most a share of the target length.
    pub(super) fn raise_angles(&mut self, degrees: f64, share: f64) {
        let goal = libm::sin(degrees.to_radians());
        for _ in 0..ROUNDS {
            let mesh = &self.surface.mesh;
            let faces = (0..mesh.halfedge_slots() / 3).filter(|&f| mesh.exists(3 * f));
            let mut small: Vec<(f64, u32)> = faces
                .map(|f| (sine(&self.surface.triangle(f)), f))
                .filter(|(sine, _)| *sine < goal)
                .collect();
            small.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
            let mut done = 0;
            for (_, f) in small {
                if self.is_stopped() {
                    return;
                }
                let is_small = |s: &Self| s.surface.mesh.exists(3 * f) && sine(&s.surface.triangle(f)) < goal;
                done += usize::from(is_small(self) && self.raise_angle(f, share));
            }
            if done == 0 {
                break;
            }
        }
    }

    fn raise_angle(&mut self, f: u32, share: f64) -> bool {
        let mut sides = [3 * f, 3 * f + 1, 3 * f + 2];
        if sides.into_iter().any(|h| self.flip_for_angle(h, share))
            || sides.into_iter().any(|h| self.move_for_angle(self.surface.mesh.from(h), share))
        {
            return true;
        }
        let length = |h: &u32| self.surface.along(*h).length_squared();
        sides.sort_by(|g, h| length(g).total_cmp(&length(h)));
        self.collapse_for_angle(sides[0], share) || self.collapse_for_angle(sides[1], share)
    }

    fn flip_for_angle(&mut self, h: u32, share: f64) -> bool {
        let Some(t) = self.surface.mesh.twin_of(h) else { return false };
        let corners = hinge(&self.surface.mesh, h, t).map(|v| self.surface.mesh.positions[v as usize]);
        let Some([old, new]) = flipped(corners) else { return false };
        let v = self.surface.mesh.from(h);
        least_sine(&new) > least_sine(&old) && self.is_as_near(v, &old, &new, share) && self.surface.flip(h)
    }

    fn move_for_angle(&mut self, v: u32, share: f64) -> bool {
        if self.surface.hold[v as usize] != Hold::Free {
            return false;
        }
        let fan = Fan::new(self.surface, v);
        let now = -least_sine(&fan.faces) - WORTH;
        let measure = |_: &mut Self, moved: &Fan, _: Slot, least: f64| {
            let value = -least_sine(&moved.faces);
            if value < least && moved.keeps_normals(&fan) { value } else { f64::INFINITY }
        };
        let Some((position, near)) = self.search(v, &fan, STEP, now, measure) else { return false };
        let before = self.surface.mesh.positions[v as usize];
        if !self.keeps_near(v, &[before], &fan.faces, &fan.with(position).faces, share) {
            return false;
        }
        self.surface.mesh.positions[v as usize] = position;
        self.surface.near[v as usize] = near;
        true
    }

    fn collapse_for_angle(&mut self, h: u32, share: f64) -> bool {
        let Some(edge) = Collapsible::new(self.surface, h) else { return false };
        let positions = match edge.way.freedom {
            Freedom::None => vec![edge.way.position],
            Freedom::Curve => edge.ends.to_vec(),
            Freedom::Surface => {
                let near = self.surface.near[edge.vertex as usize];
                let [p, q] = edge.ends;
                vec![self.project(0.5 * (p + q), near).0, p, q]
            }
        };
        let mut new = Vec::with_capacity(edge.star.kept.len());
        for position in positions {
            if edge.place(self.surface, position, &mut new)
                && least_sine(&new) > least_sine(&edge.old)
                && self.keeps_near(edge.vertex, &edge.ends, &edge.old, &new, share)
            {
                return self.surface.collapse(&Collapse { position, ..edge.way }).is_some();
            }
        }
        false
    }

    /// Whether points of old faces are near new ones, and these as near the input as the old ones or a share of the target length.
    pub(super) fn keeps_near(
        &mut self,
        v: u32,
        points: &[DVec3],
        old: &[Triangle],
        new: &[Triangle],
        share: f64,
    ) -> bool {
        let most = share * self.surface.length[v as usize];
        points.iter().all(|p| distance_from(*p, new) <= most) && self.is_as_near(v, old, new, share)
    }

    fn is_as_near(&mut self, v: u32, old: &[Triangle], new: &[Triangle], share: f64) -> bool {
        let near = self.surface.near[v as usize];
        let most = share * self.surface.length[v as usize];
        let before = self.farthest(old.iter().map(middle), near, f64::INFINITY);
        self.farthest(new.iter().map(middle), near, f64::INFINITY)
            <= if before > most { before } else { most }
    }
}
