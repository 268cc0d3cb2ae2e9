//! Tracing a straight line between two vertices across the faces of a surface.

use pompeiu_core::{FaceId, VertexId};
use pompeiu_surface::plane::{Vec2, add, cross, norm, scale, sub};
use pompeiu_surface::{HalfedgeId, Surface};

/// The end is reached within this distance, relative to the length of the line: far more than rounding.
const MET: f64 = 1e-6;

/// Smallest distance of a crossing from the ends of its edge, relative to the length of the edge.
const APART: f64 = 1e-9;

/// Largest number of crossings per face of the surface before a line counts as lost.
const MOST_CROSSINGS: usize = 4;

/// The crossings between both ends of a line.
pub(super) enum Way {
    /// It is an edge.
    Edge,
    /// It leaves each face through a half-edge, at this fraction from its tail, and ends in the last face.
    Crossings(Vec<(HalfedgeId, f64)>, FaceId),
}

/// Traces a line of this length from a vertex, in a direction counter-clockwise from its first half-edge, to another vertex.
pub(super) fn walk(
    surface: &Surface,
    from: VertexId,
    direction: f64,
    length: f64,
    to: VertexId,
) -> Option<Way> {
    let mesh = surface.mesh();
    let (mut first, mut angle) = (None, direction);
    for h in mesh.outgoing(from) {
        if let Some(last) = first {
            let passed = surface.angle(last);
            if angle < passed {
                break;
            }
            angle -= passed;
        }
        first = Some(h);
    }
    // The line lies along `along` from the origin; the edge ahead has p on its right and q on its left.
    let h = first?;
    let side = |h: HalfedgeId| surface.edge_length(mesh.edge(h));
    let turned = |length: f64, angle: f64| [length * libm::cos(angle), length * libm::sin(angle)];
    let (mut p, mut q) = ([side(h), 0.0], turned(side(h.previous()), surface.angle(h)));
    let along = turned(1.0, angle);
    let target = scale(length, along);
    let is_met = |v: VertexId, place: Vec2| v == to && norm(sub(place, target)) <= MET * length;
    if is_met(mesh.head(h), p) || is_met(mesh.tail(h.previous()), q) {
        return Some(Way::Edge);
    }
    let mut crossings = Vec::new();
    let mut exit = h.next();
    while crossings.len() < MOST_CROSSINGS * mesh.faces() {
        let (right, left) = (cross(along, p), cross(along, q));
        let share = right / (right - left);
        let share = if share > APART { share } else { APART };
        crossings.push((exit, if share < 1.0 - APART { share } else { 1.0 - APART }));
        let twin = mesh.twin(exit)?;
        let apex = mesh.tail(twin.previous());
        // The other face lies to the left of its side from q to p.
        let (x, y) =
            (scale(1.0 / norm(sub(p, q)), sub(p, q)), turned(side(twin.previous()), surface.angle(twin)));
        let place = add(q, [x[0] * y[0] - x[1] * y[1], x[1] * y[0] + x[0] * y[1]]);
        if is_met(apex, place) {
            return Some(Way::Crossings(crossings, twin.face()));
        }
        if cross(along, place) > 0.0 {
            (q, exit) = (place, twin.next());
        } else {
            (p, exit) = (place, twin.previous());
        }
    }
    None
}
