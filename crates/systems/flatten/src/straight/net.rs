//! Intrinsic triangulations of a surface with edge flips.

use pompeiu_core::VertexId;
use pompeiu_core::mesh::VertexData;
use pompeiu_surface::{Surface, SurfaceMesh};
use std::f64::consts::PI;

pub(super) const NONE: u32 = u32::MAX;

/// Half-edges, each in a slot of its face: slot 3 f + i starts at corner i of face f. Flips move half-edges to other slots.
pub(super) struct Net {
    tails: Vec<u32>,
    twins: Vec<u32>,
    lengths: Vec<f64>,
    /// The direction of each half-edge at its tail: the angle counter-clockwise from the first half-edge there.
    directions: Vec<f64>,
    /// The half-edge in each slot, and the slot of each.
    names: Vec<u32>,
    slots: Vec<u32>,
    /// The sum of the angles at each vertex.
    totals: VertexData<f64>,
}

pub(super) fn next(slot: u32) -> u32 {
    if slot % 3 == 2 { slot - 2 } else { slot + 1 }
}

pub(super) fn previous(slot: u32) -> u32 {
    next(next(slot))
}

impl Net {
    pub(super) fn new(surface: &Surface) -> Self {
        let mesh = surface.mesh();
        let halfedges = || mesh.face_ids().flat_map(SurfaceMesh::face_halfedges);
        let mut directions = vec![0.0; mesh.halfedges()];
        let mut totals = VertexData::filled(mesh.vertices(), 0.0);
        for v in mesh.vertex_ids() {
            for h in mesh.outgoing(v) {
                directions[h.index()] = totals[v];
                totals[v] += surface.angle(h);
            }
        }
        Self {
            tails: halfedges().map(|h| mesh.tail(h).0).collect(),
            twins: halfedges().map(|h| mesh.twin(h).map_or(NONE, |twin| twin.0)).collect(),
            lengths: halfedges().map(|h| surface.edge_length(mesh.edge(h))).collect(),
            directions,
            names: (0..mesh.halfedges() as u32).collect(),
            slots: (0..mesh.halfedges() as u32).collect(),
            totals,
        }
    }

    pub(super) fn slot(&self, name: u32) -> u32 {
        self.slots[name as usize]
    }

    pub(super) fn name(&self, slot: u32) -> u32 {
        self.names[slot as usize]
    }

    pub(super) fn tail(&self, slot: u32) -> VertexId {
        VertexId(self.tails[slot as usize])
    }

    pub(super) fn head(&self, slot: u32) -> VertexId {
        self.tail(next(slot))
    }

    pub(super) fn twin(&self, slot: u32) -> Option<u32> {
        Some(self.twins[slot as usize]).filter(|twin| *twin != NONE)
    }

    pub(super) fn length(&self, slot: u32) -> f64 {
        self.lengths[slot as usize]
    }

    pub(super) fn direction(&self, slot: u32) -> f64 {
        self.directions[slot as usize]
    }

    /// The next half-edge counter-clockwise around the tail; `None` beyond the boundary.
    pub(super) fn turned(&self, slot: u32) -> Option<u32> {
        self.twin(previous(slot))
    }

    /// The angle of a face at the tail of a half-edge.
    pub(super) fn angle(&self, slot: u32) -> f64 {
        let [b, a, c] = [slot, next(slot), previous(slot)].map(|side| self.length(side));
        // Half the angle opposite a, by Kahan's formula: no cancellation beyond that of the lengths.
        let (long, short) = if b > c { (b, c) } else { (c, b) };
        let rest = if short >= a { a - (long - short) } else { short - (long - a) };
        let tangent = ((long - short) + a) * rest / ((long + (short + a)) * ((long - a) + short));
        if tangent > 0.0 {
            2.0 * libm::atan(tangent.sqrt())
        } else if rest > 0.0 {
            PI
        } else {
            0.0
        }
    }

    /// The sum of the two angles at the head of an edge, on both sides of it; `None` at the boundary.
    pub(super) fn angle_at_head(&self, slot: u32) -> Option<f64> {
        let twin = self.twin(slot)?;
        Some(self.angle(next(slot)) + self.angle(twin))
    }

    /// Replaces an edge by the other diagonal of its two faces; returns false if both faces are the same, or the diagonal leaves
    /// them.
    pub(super) fn flip(&mut self, slot: u32) -> bool {
        let Some(twin) = self.twin(slot).filter(|twin| twin / 3 != slot / 3) else { return false };
        let (h, t) = (slot, twin);
        let is_convex = |angle: Option<f64>| angle.is_some_and(|angle| angle < PI);
        if !is_convex(self.angle_at_head(h)) || !is_convex(self.angle_at_head(t)) {
            return false;
        }
        let length = self.length(h);
        let apex = |slot: u32, net: &Self| {
            let (angle, side) = (net.angle(slot), net.length(previous(slot)));
            [side * libm::cos(angle), side * libm::sin(angle)]
        };
        let (here, there) = (apex(h, self), apex(t, self));
        let across = [here[0] - (length - there[0]), here[1] + there[1]];
        let diagonal = across[0].hypot(across[1]);
        let (f, g) = (3 * (h / 3), 3 * (t / 3));
        let (bc, ca, ad, db) = (next(h), previous(h), next(t), previous(t));
        let [a, b, c, d] = [h, t, ca, db].map(|side| self.tails[side as usize]);
        let (name, other) = (self.name(h), self.name(t));
        let moved = [(ca, f + 1), (ad, f + 2), (db, g + 1), (bc, g + 2)];
        let old = moved.map(|(from, _)| {
            let i = from as usize;
            (self.twins[i], self.lengths[i], self.directions[i], self.names[i])
        });
        for ((_, to), (twin, length, direction, name)) in moved.into_iter().zip(old) {
            let twin = moved.iter().find(|(from, _)| *from == twin).map_or(twin, |&(_, to)| to);
            let i = to as usize;
            (self.twins[i], self.lengths[i], self.directions[i], self.names[i]) =
                (twin, length, direction, name);
            self.slots[name as usize] = to;
            if twin != NONE {
                self.twins[twin as usize] = to;
            }
        }
        for (side, twin, name) in [(f, g, name), (g, f, other)] {
            self.twins[side as usize] = twin;
            self.lengths[side as usize] = diagonal;
            self.names[side as usize] = name;
            self.slots[name as usize] = side;
        }
        for (side, tail) in [(f, d), (f + 1, c), (f + 2, a), (g, c), (g + 1, d), (g + 2, b)] {
            self.tails[side as usize] = tail;
        }
        // From d: behind the side to b. From c: behind the side to a.
        for (side, before) in [(f, g + 1), (g, f + 1)] {
            let total = self.totals[self.tail(side)];
            let direction = self.direction(before) + self.angle(before);
            self.directions[side as usize] = if direction < total { direction } else { direction - total };
        }
        true
    }
}
