//! The cells of an overlay: their corners, and how far these are from the face of the cell.

use super::polygon::{Cell, Strip};
use super::segment::{Clip, Seen, Side};
use super::view::clamped;
use super::{Below, Face, Overlaid, Overlay, View};
use glam::DVec3;
use pompeiu_core::spatial::{Slot, Workspace};

impl Overlay {
    /// The cell of a face whose edges are clipped.
    pub(super) fn face_cell(
        &mut self,
        index: usize,
        seen: &Seen,
        view: &View,
        below: &Below<'_>,
        workspace: &mut Workspace,
    ) -> Result<(), Overlaid> {
        let Face { clips, reversed } = self.faces[index];
        let bound = |corner| distance_sq_along_view(view, corner, seen);
        self.polygon.count = 0;
        let mut first = None;
        let mut last = None;
        for i in 0..3 {
            let clip = if reversed { clips[2 - i].turned() } else { clips[i] };
            let Clip::Segment { from, to } = clip else { continue };
            if let Some(last) = last {
                self.passes += self
                    .polygon
                    .go_along(view, last, self.points[from as usize].side, bound)
                    .ok_or(Overlaid::None)?;
            } else {
                first = Some(self.points[from as usize].side);
            }
            for end in [from, to] {
                let point = &self.points[end as usize];
                let known = &self.polygon;
                // Segments that meet at a vertex share it.
                if known.count == 0 || known.corners[known.count - 1] != point.position {
                    self.polygon.push(point.position, point.distance_sq).ok_or(Overlaid::None)?;
                }
            }
            last = Some(self.points[to as usize].side);
        }
        if let (Some(first), Some(last)) = (first, last) {
            self.passes += self.polygon.go_along(view, last, first, bound).ok_or(Overlaid::None)?;
        } else if index == 0 {
            // No edge crosses T: all of it is one cell.
            for corner in 0..3 {
                self.polygon.push(view.t[corner], bound(corner)).ok_or(Overlaid::None)?;
            }
            self.passes += 1;
        } else {
            return Ok(());
        }
        self.measure(self.slots[index], below, workspace);
        Ok(())
    }

    /// The cell between a segment and the boundary of T.
    pub(super) fn strip_cell(
        &mut self,
        strip: Strip,
        view: &View,
        below: &Below<'_>,
        workspace: &mut Workspace,
    ) {
        let [p, q] = [strip.from, strip.to].map(|end| self.points[end as usize]);
        let [(p_end, p_side), (q_end, q_side)] = [p, q].map(|point| match point.side {
            Side::Opposite(side) => (point.position, side),
            Side::Inside => view.to_boundary(point.position),
        });
        let polygon = &mut self.polygon;
        polygon.count = 0;
        let mut push = |corner: DVec3, bound: f64| {
            (polygon.corners[polygon.count], polygon.bounds[polygon.count]) = (corner, bound);
            polygon.count += 1;
        };
        push(q.position, q.distance_sq);
        push(p.position, p.distance_sq);
        push(p_end, f64::INFINITY);
        // From one side to another by the corner between them, or the other way round by the two others: what is shorter.
        if p_side != q_side {
            let onwards = (p_side + 1) % 3 == q_side;
            let [between, first, second] = if onwards { [2, 1, 0] } else { [1, 2, 0] };
            let [between, first, second] = [between, first, second].map(|i| (p_side as usize + i) % 3);
            let t = &view.t;
            let short = p_end.distance(t[between]) + t[between].distance(q_end);
            let long = p_end.distance(t[first]) + t[first].distance(t[second]) + t[second].distance(q_end);
            let around: &[usize] = if short <= long { &[between] } else { &[first, second] };
            for &corner in around {
                push(t[corner], f64::INFINITY);
                if corner == 0 {
                    self.passes += if onwards == (short <= long) { 1 } else { -1 };
                }
            }
        }
        push(q_end, f64::INFINITY);
        self.measure(strip.slot, below, workspace);
    }

    /// Bounds the cell at hand by its face and files it.
    fn measure(&mut self, slot: Slot, below: &Below<'_>, workspace: &mut Workspace) {
        let polygon = &mut self.polygon;
        let count = polygon.count;
        // Corners that the point of B over them does not cover are compared with the whole face.
        let mut next = 0;
        while next < count {
            let mut points = [[0.0; 4]; 3];
            let mut asked = [0; 4];
            let mut lanes = 0;
            while next < count && lanes < 4 {
                if polygon.bounds[next] > below.limit_sq {
                    for k in 0..3 {
                        points[k][lanes] = polygon.corners[next][k];
                    }
                    asked[lanes] = next;
                    lanes += 1;
                }
                next += 1;
            }
            if lanes > 0 {
                let distances = below.bvh.four_distances_sq(&points, slot, workspace);
                for lane in 0..lanes {
                    let bound = &mut polygon.bounds[asked[lane]];
                    *bound = if distances[lane] < *bound { distances[lane] } else { *bound };
                }
            }
        }
        let mut farthest = 0.0;
        for (corner, &bound) in polygon.corners.iter().zip(&polygon.bounds[..count]) {
            if bound > farthest {
                farthest = bound;
                if bound > below.limit_sq && self.worst.is_none_or(|(_, _, d)| bound > d) {
                    self.worst = Some((corner.to_array(), slot, bound));
                }
            }
        }
        let beyond = farthest > below.limit_sq;
        self.beyond += usize::from(beyond);
        if !beyond && farthest > self.greatest {
            self.greatest = farthest;
        }
        if beyond || self.keep_all {
            self.cells.push(Cell { slot, polygon: *polygon, distance_sq: farthest });
        }
    }
}

/// Squared distance of a corner of T from the point of a face that is seen over it, or from one near that where it is seen
/// beside the face.
fn distance_sq_along_view(view: &View, corner: usize, seen: &Seen) -> f64 {
    let at = [if corner == 1 { 1.0 } else { 0.0 }, if corner == 2 { 1.0 } else { 0.0 }];
    let [p, q, r] = seen.over.map(|l| [l[1] - at[0], l[2] - at[1]]);
    let turn = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
    let [u, v, w] = [turn(q, r), turn(r, p), turn(p, q)];
    let inverse = 1.0 / (u + v + w);
    let v = clamped(v * inverse);
    let w = clamped(w * inverse);
    let w = if v + w > 1.0 { 1.0 - v } else { w };
    let [a, b, c] = seen.corners;
    let y = a + v * (b - a) + w * (c - a);
    view.t[corner].distance_squared(y)
}
