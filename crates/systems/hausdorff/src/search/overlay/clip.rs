//! What lies in T of an edge of B.

use super::segment::{Clip, Point, Seen, Side};
use super::view::clamped;
use super::{Overlay, View};

impl Overlay {
    /// Clips the edge of a face that leads from corner `k` to the next; its other edges may have been clipped already.
    pub(super) fn clip(&mut self, view: &View, seen: &Seen, clips: &[Clip; 3], k: usize) -> Clip {
        // From either of its faces an edge is clipped in the same direction, so that both see the same.
        let next = (k + 1) % 3;
        let [p, q] = [seen.over[k], seen.over[next]];
        if p[1] > q[1] || p[1] == q[1] && p[2] > q[2] {
            self.clip_between(view, seen, clips, [next, k]).turned()
        } else {
            self.clip_between(view, seen, clips, [k, next])
        }
    }

    fn clip_between(&mut self, view: &View, seen: &Seen, clips: &[Clip; 3], ends: [usize; 2]) -> Clip {
        let (mut enters, mut leaves) = (0.0, 1.0);
        let (mut enters_by, mut leaves_by) = (Side::Inside, Side::Inside);
        for j in 0..3 {
            let [p, q] = ends.map(|end| seen.over[end][j]);
            if p < 0.0 {
                if q < 0.0 {
                    return Clip::Outside;
                }
                let s = p / (p - q);
                if s >= enters {
                    (enters, enters_by) = (s, Side::Opposite(j as u8));
                }
            } else if q < 0.0 {
                let s = p / (p - q);
                if s <= leaves {
                    (leaves, leaves_by) = (s, Side::Opposite(j as u8));
                }
            }
        }
        // An end inside always leaves a segment, if only a point: every vertex inside has all of its edges.
        if enters > leaves {
            return Clip::Outside;
        }
        let from = self.end(view, seen, clips, ends, ends[0], enters, enters_by);
        let to = self.end(view, seen, clips, ends, ends[1], leaves, leaves_by);
        Clip::Segment { from, to }
    }

    /// The point where a clipped edge ends: at one of its own ends, or at the fraction `s` of it.
    #[allow(clippy::too_many_arguments, reason = "the parts of one formula")]
    fn end(
        &mut self,
        view: &View,
        seen: &Seen,
        clips: &[Clip; 3],
        ends: [usize; 2],
        end: usize,
        s: f64,
        side: Side,
    ) -> u16 {
        let t = &view.t;
        let (y, position) = match side {
            Side::Inside => {
                // Another edge at this corner may have the point already.
                if let Clip::Segment { from, .. } = clips[end] {
                    return from;
                }
                if let Clip::Segment { to, .. } = clips[(end + 2) % 3] {
                    return to;
                }
                let [_, v, w] = seen.over[end];
                (seen.corners[end], t[0] + v * (t[1] - t[0]) + w * (t[2] - t[0]))
            }
            Side::Opposite(j) => {
                let [p, q] = ends;
                let (from, to) = ((j as usize + 1) % 3, (j as usize + 2) % 3);
                let w = clamped(seen.over[p][to] + s * (seen.over[q][to] - seen.over[p][to]));
                let y = seen.corners[p] + s * (seen.corners[q] - seen.corners[p]);
                (y, t[from] + w * (t[to] - t[from]))
            }
        };
        self.points.push(Point { position, distance_sq: position.distance_squared(y), side });
        (self.points.len() - 1) as u16
    }
}
