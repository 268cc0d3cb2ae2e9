//! Which faces of B are listed for a piece.

use super::super::candidates::Candidate;
use super::super::fronts::Front;
use super::super::polygon::Polygon;
use super::view::View;
use super::{Envelope, Listed, Open, Wish, bvh_row};
use glam::DVec3;
use pompeiu_core::geom::Aabb;
use pompeiu_core::geom::point_triangle::LANES;
use std::ops::ControlFlow;

/// Faces on a list at most: beyond, a piece is bounded by the distance of its centre, and cut.
const LONGEST_LIST: usize = 256;
/// Faces are listed up to the first of these multiples of the distance of the centre, or up to the second where that is known to
/// suffice.
const NEAREST: f64 = 1.25;
const FARTHEST: f64 = 4.0;
/// Part of the allowed width that faces may take which are not listed.
const UNLISTED: f64 = 0.25;

impl Envelope<'_> {
    /// Lists the faces that the tree holds near a piece, or only the nearest if they are too many.
    pub(super) fn gather(&mut self, open: &mut Open, seen: &View, wish: &Wish) -> bool {
        let Self { bvh, workspace, walk, slots, scale, .. } = self;
        let polygon = &mut open.polygon;
        let centre = seen.centre.to_array();
        let nearest = bvh.nearest(centre, open.near, workspace);
        let distance = nearest.distance_sq.sqrt();
        let far = distance + 2.0 * (seen.radius + seen.margin);
        let far_sq = far * far;
        // Faces outside of a box around the piece, and outside of a slab around its plane, are farther than `reach`.
        let reach = reach_of(polygon, distance, wish.reach);
        let beside = reach + 2.0 * seen.margin;
        let around = |k: usize| {
            let row = &seen.corners[k][..polygon.outline.count];
            row.iter().fold((row[0], row[0]), |(l, u), x| {
                (if *x < l { *x } else { l }, if *x > u { *x } else { u })
            })
        };
        let lower = [0, 1, 2].map(|k| around(k).0 - beside);
        let upper = [0, 1, 2].map(|k| around(k).1 + beside);
        let normal = scale.normal();
        // By the plane that faces are compared with.
        let common = seen.direction_from(bvh.corners(nearest.slot).map(DVec3::from_array));
        let row = seen.along(common);
        let values = bvh_row(bvh, nearest.slot, seen, polygon.outline.count, workspace);
        let slack = UNLISTED * wish.width + 2.0 * seen.margin;
        let room = (0..polygon.outline.count).fold(f64::INFINITY, |room, j| {
            let here = row[j] - (values[j] - slack);
            if here < room { here } else { room }
        });
        let mut behind = f64::NEG_INFINITY;
        let enter = |aabb: &Aabb| {
            if (0..3).any(|k| aabb.lower[k] > upper[k] || aabb.upper[k] < lower[k]) {
                return false;
            }
            let mut away = 0.0;
            let (mut middle, mut half, mut support) = (0.0, 0.0, 0.0);
            for k in 0..3 {
                let (l, u) = (aabb.lower[k], aabb.upper[k]);
                let outside = if centre[k] < l {
                    l - centre[k]
                } else if centre[k] > u {
                    centre[k] - u
                } else {
                    0.0
                };
                away += outside * outside;
                middle += normal[k] * (0.5 * (l + u) - centre[k]);
                half += normal[k].abs() * (0.5 * (u - l));
                support += common[k] * (if common[k] > 0.0 { u } else { l } - centre[k]);
            }
            if away > far_sq || middle.abs() > half + beside {
                return false;
            }
            if support <= room {
                behind = if support > behind { support } else { behind };
                return false;
            }
            true
        };
        slots.clear();
        let listed = bvh.walk(walk, enter, |slot| {
            slots.push(slot);
            if slots.len() > LONGEST_LIST * 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let mut complete = listed.is_continue();
        let (from, first) = (self.candidates.len(), self.lists.len());
        if complete {
            let beyond = std::array::from_fn(|j| {
                let plane = row[j] - behind - seen.margin;
                if plane < reach { plane } else { reach }
            });
            bvh.remove_repeats(slots);
            slots.retain(|slot| {
                *slot != nearest.slot && !seen.is_beside(&bvh.corners(*slot), normal, &lower, &upper, beside)
            });
            let along = polygon.outline.longest_way(scale).0;
            // Faces in front of which a plane lies that is no nearer than what is left out anyway are left out too.
            let front = Front::new(seen.centre, &seen.corners, along, &beyond.map(|x| x + seen.margin), 0.0);
            for eight in slots.chunks(LANES) {
                let fronts = front.look(bvh, eight);
                for (lane, slot) in eight.iter().enumerate() {
                    if fronts.deficits[lane] > 0.0 {
                        self.candidates.push(Candidate::new(*slot, bvh.corners(*slot), scale));
                    }
                }
            }
            // One place is that of the nearest.
            complete = self.candidates.len() - from < LONGEST_LIST;
            polygon.beyond = beyond;
        }
        if !complete {
            self.candidates.truncate(from);
            polygon.beyond = seen.arms().map(|arm| distance - arm.sqrt() - seen.margin);
        }
        self.candidates.push(Candidate::new(nearest.slot, bvh.corners(nearest.slot), scale));
        self.lists.extend((from..self.candidates.len()).map(|candidate| Listed {
            candidate: candidate as u32,
            pinned: self.candidates[candidate].slot == nearest.slot,
        }));
        open.list = Some((first as u32, self.lists.len() as u32));
        complete
    }
}

/// How far faces of B are listed: all that may be nearest to a corner, as far as is known, but not many times the distance of the
/// centre.
fn reach_of(polygon: &Polygon, distance: f64, wish: f64) -> f64 {
    let upper =
        polygon.upper[..polygon.outline.count].iter().fold(0.0, |most, x| if *x > most { *x } else { most });
    let known = if upper < FARTHEST * distance { upper } else { NEAREST * distance };
    if wish > known { wish } else { known }
}
