//! Straightest geodesics.

use crate::plane::{Rotation, Vec2, add, cross, dot, inverse, norm, rotate, scale, sub};
use crate::{HalfedgeId, Surface};
use pompeiu_core::{FaceId, VertexId};
use rayon::prelude::*;

/// A starting point, direction and length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The face to start in.
    pub face: FaceId,
    /// The point to start at, in the frame of the face and inside it; see [`Surface::point`].
    pub point: Vec2,
    /// The direction in the frame of the face; its length does not count.
    pub direction: Vec2,
    /// How far to walk along the surface.
    pub length: f64,
}

/// The end of a traced geodesic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trace {
    /// The face it ended in.
    pub face: FaceId,
    /// The end point, in the frame of that face.
    pub point: Vec2,
    /// The unit direction at the end: the starting direction, transported along the geodesic. [`Trace::transport`] applies the same
    /// rotation to any other vector.
    pub direction: Vec2,
    /// The length traced.
    pub length: f64,
    /// Number of edges crossed and vertices passed.
    pub crossings: usize,
    /// Why tracing ended.
    pub end: TraceEnd,
}

/// Why tracing ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TraceEnd {
    /// The full length was traced.
    Length,
    /// The boundary was reached, at this half-edge.
    Boundary(HalfedgeId),
    /// This boundary vertex was reached.
    BoundaryVertex(VertexId),
    /// The limit on crossings was reached.
    Crossings,
    /// The ray is invalid: its point, direction or length is not finite, its direction is zero, or its length is negative.
    Unusable,
}

impl Trace {
    /// The rotation that carries vectors from the start of a ray, in the frame of its face, to its end.
    pub fn transport(&self, ray: &Ray) -> Rotation {
        let length = norm(ray.direction);
        if length > 0.0 {
            rotate(inverse(scale(1.0 / length, ray.direction)), self.direction)
        } else {
            [1.0, 0.0]
        }
    }

    /// The ray from the end back to the start.
    #[must_use]
    pub fn reversed(&self) -> Ray {
        Ray {
            face: self.face,
            point: self.point,
            direction: scale(-1.0, self.direction),
            length: self.length,
        }
    }
}

/// Options of tracing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceOptions {
    /// Tracing ends after this many crossings; 10 million by default, far more than any of sensible length.
    pub max_crossings: usize,
    /// If a geodesic crosses an edge closer than this to one of its ends, relative to the length of the edge, it passes through the
    /// vertex there. The default 1e-12 is the rounding that some thousand crossings accumulate, so that a ray aimed at a vertex
    /// meets it.
    pub vertex_tolerance: f64,
}

impl Default for TraceOptions {
    fn default() -> Self {
        Self { max_crossings: 10_000_000, vertex_tolerance: 1e-12 }
    }
}

/// A surface prepared for tracing: for each half-edge the adjacent face, and the rotation into its frame.
///
/// # Definition
/// Inside a face the path is a straight line; across an edge it continues straight in the unfolding of both faces. At an inner
/// vertex it continues with equal angles on both sides: a straightest geodesic. It ends at the boundary.
///
/// # Accuracy
/// Each crossing adds a few rounding errors to position and direction. Geodesics that pass a vertex on different sides diverge by
/// its angle defect; one that comes within [`TraceOptions::vertex_tolerance`] passes through the vertex. Outside that tolerance,
/// rounding may still decide on which side a path passes.
///
/// # Cost
/// O(1) for each crossing. 120 bytes per face to prepare.
///
/// # Source
/// `polthier_straightest_1998`.
#[derive(Clone, Debug)]
pub struct Tracer<'s> {
    surface: &'s Surface,
    across: Vec<Across>,
    options: TraceOptions,
}

/// The face across a half-edge.
#[derive(Clone, Copy, Debug)]
struct Across {
    /// Where the twin begins and its vector, in the frame of its face; not finite at the boundary.
    head: Vec2,
    back: Vec2,
    turn: Rotation,
    twin: u32,
}

const BOUNDARY: u32 = u32::MAX;

impl<'s> Tracer<'s> {
    /// Prepares a surface.
    pub fn new(surface: &'s Surface, options: &TraceOptions) -> Self {
        let across = (0..surface.mesh().halfedges() as u32)
            .into_par_iter()
            .map(|h| {
                let halfedge = HalfedgeId(h);
                match surface.mesh().twin(halfedge).zip(surface.transport(halfedge)) {
                    Some((twin, turn)) => {
                        let flat = surface.flat(twin.face());
                        let (head, back) = (flat.corner(twin.corner()), flat.side(twin.corner()));
                        Across { head, back, turn, twin: twin.0 }
                    }
                    None => Across { head: [0.0; 2], back: [0.0; 2], turn: [1.0, 0.0], twin: BOUNDARY },
                }
            })
            .collect();
        Self { surface, across, options: *options }
    }

    /// Traces one ray.
    ///
    /// # Panics
    /// If the face does not exist.
    pub fn trace(&self, ray: &Ray) -> Trace {
        self.follow(ray, |_, _| ())
    }

    /// Traces one ray and returns the points of its path, each in the frame of the face that the path enters there: the start, the
    /// points on edges and vertices, and the end.
    ///
    /// # Panics
    /// If the face does not exist.
    pub fn path(&self, ray: &Ray) -> (Trace, Vec<(FaceId, Vec2)>) {
        let mut path = vec![(ray.face, ray.point)];
        let trace = self.follow(ray, |face, point| path.push((face, point)));
        path.push((trace.face, trace.point));
        (trace, path)
    }

    /// Traces many rays, in parallel; each as [`trace`](Self::trace) would.
    ///
    /// # Panics
    /// If a face does not exist.
    pub fn trace_many(&self, rays: &[Ray]) -> Vec<Trace> {
        rays.par_iter().with_min_len(256).map(|ray| self.trace(ray)).collect()
    }

    fn follow(&self, ray: &Ray, mut visit: impl FnMut(FaceId, Vec2)) -> Trace {
        let size = norm(ray.direction);
        let usable = ray.point.iter().all(|x| x.is_finite())
            && size > 0.0
            && size.is_finite()
            && ray.length >= 0.0
            && ray.length.is_finite();
        let mut at = Walk {
            face: ray.face,
            point: ray.point,
            direction: scale(1.0 / size, ray.direction),
            entered: None,
        };
        let mut left = ray.length;
        let mut crossings = 0;
        let end = loop {
            if !usable {
                at.direction = ray.direction;
                break TraceEnd::Unusable;
            }
            let exit = self.exit(&at);
            if exit.distance >= left {
                at.point = add(at.point, scale(left, at.direction));
                left = 0.0;
                break TraceEnd::Length;
            }
            if crossings >= self.options.max_crossings {
                break TraceEnd::Crossings;
            }
            crossings += 1;
            left -= exit.distance;
            let halfedge = HalfedgeId::of(at.face, exit.side);
            // A ray that starts at a vertex leaves it in the given direction.
            let there = || {
                let side = norm(self.surface.flat(at.face).side(exit.side));
                exit.distance > self.options.vertex_tolerance * side
            };
            if let Some(corner) = exit.corner.filter(|_| there()) {
                let vertex = self.surface.mesh().face(at.face)[corner];
                if self.surface.mesh().is_boundary_vertex(vertex) {
                    at.point = self.surface.flat(at.face).corner(corner);
                    break TraceEnd::BoundaryVertex(vertex);
                }
                at = self.past_vertex(&at, corner);
            } else {
                let across = &self.across[halfedge.index()];
                if across.twin == BOUNDARY {
                    let flat = self.surface.flat(at.face);
                    at.point = add(flat.corner(exit.side), scale(exit.fraction, flat.side(exit.side)));
                    break TraceEnd::Boundary(halfedge);
                }
                let twin = HalfedgeId(across.twin);
                at = Walk {
                    face: twin.face(),
                    point: add(across.head, scale(1.0 - exit.fraction, across.back)),
                    direction: rotate(across.turn, at.direction),
                    entered: Some(twin.corner()),
                };
            }
            visit(at.face, at.point);
        };
        // Normalised again: many rotations have changed the length of the direction by rounding.
        let size = norm(at.direction);
        let direction = if usable { scale(1.0 / size, at.direction) } else { at.direction };
        let length = if usable { ray.length - left } else { 0.0 };
        Trace { face: at.face, point: at.point, direction, length, crossings, end }
    }

    /// Where a straight line leaves its face.
    #[inline]
    fn exit(&self, at: &Walk) -> Exit {
        let flat = self.surface.flat(at.face);
        let offset = |corner: usize| sub(flat.corner(corner), at.point);
        let leave = |side: usize, tail: Vec2, head: Vec2| {
            let (from, to) = (cross(at.direction, tail), cross(at.direction, head));
            // The tail lies to the right, the head to the left; rounding may put either on the line or beyond it.
            let fraction = if from >= 0.0 {
                0.0
            } else if to <= 0.0 {
                1.0
            } else {
                from / (from - to)
            };
            let tolerance = self.options.vertex_tolerance;
            let corner = if fraction <= tolerance {
                Some(side)
            } else if fraction >= 1.0 - tolerance {
                Some((side + 1) % 3)
            } else {
                None
            };
            let ahead = dot(at.direction, add(tail, scale(fraction, sub(head, tail))));
            Exit { side, fraction, corner, distance: if ahead > 0.0 { ahead } else { 0.0 } }
        };
        if let Some(entered) = at.entered {
            // The corner opposite the edge just crossed decides which of the two other edges is crossed next.
            let (second, third) = ((entered + 1) % 3, (entered + 2) % 3);
            let opposite = offset(third);
            if cross(at.direction, opposite) >= 0.0 {
                leave(second, offset(second), opposite)
            } else {
                leave(third, opposite, offset(entered))
            }
        } else {
            // From the interior, a corner or an edge: the exit is the side that the line crosses from right to left. A ray that
            // starts on a side and points outwards leaves at once.
            let corners = [0, 1, 2].map(offset);
            let sides = [0, 1, 2].map(|i| cross(at.direction, corners[i]));
            let crossed = (0..3).find(|&i| sides[i] < 0.0 && sides[(i + 1) % 3] >= 0.0);
            // With no corner to the right, the line runs along a side or touches a corner: it leaves at the corner on the line that
            // is farthest ahead.
            let side = crossed.unwrap_or_else(|| {
                let nearer = |i: usize, j: usize| {
                    let ahead = dot(at.direction, corners[j]) > dot(at.direction, corners[i]);
                    sides[j] < sides[i] || sides[j] == sides[i] && ahead
                };
                let first = usize::from(nearer(0, 1));
                if nearer(first, 2) { 2 } else { first }
            });
            leave(side, corners[side], corners[(side + 1) % 3])
        }
    }

    /// Continues beyond an inner vertex with half of its total angle on either side.
    fn past_vertex(&self, at: &Walk, corner: usize) -> Walk {
        let mesh = self.surface.mesh();
        let arrived = HalfedgeId::of(at.face, corner);
        let total = self.surface.total_angle(mesh.tail(arrived));
        // Counter-clockwise, from the outgoing half-edge at the corner to the direction back.
        let out = self.surface.vector(arrived);
        let back = scale(-1.0, at.direction);
        let behind = libm::atan2(cross(out, back), dot(out, back));
        let mut ahead = behind + 0.5 * total;
        let mut halfedge = arrived;
        // At most one turn around the vertex, plus one face for rounding.
        for _ in 0..=mesh.outgoing(mesh.tail(arrived)).count() {
            let angle = self.surface.angle(halfedge);
            if ahead <= angle {
                break;
            }
            match mesh.twin(halfedge.previous()) {
                Some(next) => {
                    ahead -= angle;
                    halfedge = next;
                }
                None => break,
            }
        }
        let along = self.surface.vector(halfedge);
        let along = scale(1.0 / norm(along), along);
        let turn = [libm::cos(ahead), libm::sin(ahead)];
        let point = self.surface.flat(halfedge.face()).corner(halfedge.corner());
        Walk { face: halfedge.face(), point, direction: rotate(turn, along), entered: None }
    }
}

struct Walk {
    face: FaceId,
    point: Vec2,
    direction: Vec2,
    /// The side through which the face was entered.
    entered: Option<usize>,
}

struct Exit {
    side: usize,
    /// Position along the side, from 0 to 1.
    fraction: f64,
    /// The corner, if it is one of the ends of the side.
    corner: Option<usize>,
    distance: f64,
}
