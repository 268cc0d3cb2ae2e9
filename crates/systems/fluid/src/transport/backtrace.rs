//! Semi-Lagrangian transport at vertices.

use crate::Correction;
use crate::report::range;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_core::{FaceId, VertexId};
use pompeiu_operators::FaceField;
use pompeiu_surface::plane::{Rotation, Vec2, add, inverse, norm, rotate, scale};
use pompeiu_surface::{CornerData, HalfedgeId, Ray, Surface, TraceOptions, Tracer};
use rayon::prelude::*;
use std::f64::consts::TAU;

/// A surface prepared for tracing paths from its vertices.
///
/// A tangent vector at a vertex is given in geodesic polar coordinates: the angles of the faces around it, scaled to add up to a
/// full turn.
#[derive(Debug)]
pub(crate) struct Backtrace<'s> {
    surface: &'s Surface,
    tracer: Tracer<'s>,
    /// From the frame of a face to that of the vertex at its corner.
    to_vertex: CornerData<Rotation>,
    /// The sectors of all vertices, one vertex after the other, and where each vertex begins.
    sectors: Vec<Sector>,
    starts: Vec<usize>,
    /// What the angles around each vertex are multiplied by.
    stretch: VertexData<f64>,
}

/// A corner of a face as part of the tangent plane of its vertex.
#[derive(Clone, Copy, Debug)]
struct Sector {
    /// The half-edge that leaves the vertex along the side where the sector begins.
    halfedge: HalfedgeId,
    /// The angle at which it begins, in the frame of the vertex.
    from: f64,
    /// The share of the face in the area of all faces around the vertex.
    share: f64,
}

/// Departure points: a face and barycentric coordinates for each vertex.
pub(crate) type Departures = VertexData<(FaceId, [f64; 3])>;

/// Departure points and, if the transport is corrected, also arrival points.
#[derive(Debug)]
pub(crate) struct Passage<P> {
    pub(crate) from: P,
    pub(super) to: Option<P>,
    pub(super) correction: Correction,
}

impl<P> Passage<P> {
    /// From a function that traces a flow for some time.
    pub(super) fn new(correction: Correction, step: f64, follow: impl Fn(f64) -> P) -> Self {
        let to = (correction != Correction::Linear).then(|| follow(step));
        Self { from: follow(-step), to, correction }
    }
}

impl<'s> Backtrace<'s> {
    pub(crate) fn new(surface: &'s Surface) -> Self {
        let mesh = surface.mesh();
        let mut to_vertex = CornerData::filled(mesh.halfedges(), [1.0, 0.0]);
        let mut sectors: Vec<Sector> = Vec::with_capacity(mesh.halfedges());
        let mut starts = Vec::with_capacity(mesh.vertices() + 1);
        let stretch = VertexData::from_fn(mesh.vertices(), |v| {
            if mesh.is_boundary_vertex(v) { 1.0 } else { TAU / surface.total_angle(v) }
        });
        for v in mesh.vertex_ids() {
            starts.push(sectors.len());
            let area: f64 = mesh.outgoing(v).map(|h| surface.face_area(h.face())).sum();
            let mut from = 0.0;
            for halfedge in mesh.outgoing(v) {
                let angle = stretch[v] * surface.angle(halfedge);
                sectors.push(Sector { halfedge, from, share: surface.face_area(halfedge.face()) / area });
                // The bisector of the corner is the same direction in both frames.
                let along = surface.vector(halfedge);
                let in_face = libm::atan2(along[1], along[0]) + 0.5 * surface.angle(halfedge);
                let turn = from + 0.5 * angle - in_face;
                to_vertex[halfedge] = [libm::cos(turn), libm::sin(turn)];
                from += angle;
            }
        }
        starts.push(sectors.len());
        let tracer = Tracer::new(surface, &TraceOptions::default());
        Self { surface, tracer, to_vertex, sectors, starts, stretch }
    }

    /// The sectors around a vertex.
    fn sectors(&self, v: VertexId) -> &[Sector] {
        &self.sectors[self.starts[v.index()]..self.starts[v.index() + 1]]
    }

    /// The velocity at vertices: the mean of the adjacent faces, weighted by area.
    pub(crate) fn at_vertices(&self, field: &FaceField) -> VertexData<Vec2> {
        self.means(|h| rotate(self.to_vertex[h], field[h.face()]), |sum, share, u| add(sum, scale(share, u)))
    }

    /// Values on faces as means around vertices, by area.
    pub(crate) fn vertex_means(&self, values: &FaceData<f64>) -> VertexData<f64> {
        self.means(|h| values[h.face()], |sum, share, x| sum + share * x)
    }

    /// The means around vertices of a value at corners.
    fn means<T: Copy + Default + Send>(
        &self,
        of: impl Fn(HalfedgeId) -> T + Sync,
        added: impl Fn(T, f64, T) -> T + Sync,
    ) -> VertexData<T> {
        let vertices = self.surface.mesh().vertices();
        let mut means = VertexData::filled(vertices, T::default());
        means.as_mut_slice().par_iter_mut().with_min_len(2048).enumerate().for_each(|(v, mean)| {
            let sectors = self.sectors(VertexId(v as u32));
            *mean = sectors.iter().fold(T::default(), |sum, s| added(sum, s.share, of(s.halfedge)));
        });
        means
    }

    /// The surface.
    pub(crate) fn surface(&self) -> &'s Surface {
        self.surface
    }

    /// The tracer of the surface.
    pub(crate) fn tracer(&self) -> &Tracer<'s> {
        &self.tracer
    }

    /// The velocity at a point of a face, in the frame of the face.
    pub(crate) fn at_point(&self, velocity: &VertexData<Vec2>, face: FaceId, barycentric: [f64; 3]) -> Vec2 {
        let mut sum = [0.0; 2];
        for (i, share) in barycentric.into_iter().enumerate() {
            let h = HalfedgeId::of(face, i);
            let u = rotate(inverse(self.to_vertex[h]), velocity[self.surface.mesh().tail(h)]);
            sum = add(sum, scale(share, u));
        }
        sum
    }

    /// The ray from a vertex along a vector in its tangent plane.
    fn ray(&self, v: VertexId, vector: Vec2) -> Ray {
        let mut angle = libm::atan2(vector[1], vector[0]);
        if angle < 0.0 {
            angle += TAU;
        }
        let sectors = self.sectors(v);
        // Angles that are not a number are in the first one.
        let sector = sectors[sectors[1..].iter().take_while(|sector| sector.from <= angle).count()];
        let h = sector.halfedge;
        let along = self.surface.vector(h);
        // A vector that points out of the surface is rotated to the boundary.
        let within = ((angle - sector.from) / self.stretch[v]).clamp(0.0, self.surface.angle(h));
        let direction = rotate([libm::cos(within), libm::sin(within)], along);
        let point = self.surface.corners(h.face())[h.corner()];
        Ray { face: h.face(), point, direction, length: norm(vector) }
    }

    /// Where a flow carries each vertex in some time; for a negative time, where it comes from.
    ///
    /// Midpoint rule: the velocity halfway is parallel-transported back along the path.
    pub(crate) fn follow(&self, velocity: &VertexData<Vec2>, time: f64) -> Departures {
        let mut places = VertexData::filled(velocity.len(), (FaceId(0), [0.0; 3]));
        places.as_mut_slice().par_iter_mut().with_min_len(256).enumerate().for_each(|(v, place)| {
            let v = VertexId(v as u32);
            let here = velocity[v];
            let ray = self.ray(v, scale(0.5 * time, here));
            let mut end = self.tracer.trace(&ray);
            if ray.length > 0.0 {
                let halfway =
                    self.at_point(velocity, end.face, self.surface.barycentric(end.face, end.point));
                let back = rotate(inverse(end.transport(&ray)), halfway);
                let start = self.surface.mesh().face(ray.face).iter().position(|&w| w == v).unwrap_or(0);
                let back = rotate(self.to_vertex[HalfedgeId::of(ray.face, start)], back);
                end = self.tracer.trace(&self.ray(v, scale(time, back)));
            }
            *place = (end.face, inside(self.surface.barycentric(end.face, end.point)));
        });
        places
    }

    /// The departure and arrival points of vertices for a step.
    pub(crate) fn passage(
        &self,
        velocity: &VertexData<Vec2>,
        step: f64,
        correction: Correction,
    ) -> Passage<Departures> {
        Passage::new(correction, step, |time| self.follow(velocity, time))
    }

    /// Values after a transport step: interpolated at the departure points, corrected by the error of a step forth and back, and
    /// limited to the values of the departure face.
    pub(crate) fn carry(&self, passage: &Passage<Departures>, values: &VertexData<f64>) -> VertexData<f64> {
        let from = &passage.from;
        let carried = self.sample(from, values);
        let Some(to) = &passage.to else { return carried };
        let returned = self.sample(to, &carried);
        let missed = VertexData::from_fn(values.len(), |v| 0.5 * (values[v] - returned[v]));
        let sum = |a: &VertexData<f64>| VertexData::from_fn(a.len(), |v| a[v] + missed[v]);
        let corrected = match passage.correction {
            Correction::Bfecc => self.sample(from, &sum(values)),
            _ => sum(&carried),
        };
        VertexData::from_fn(values.len(), |v| within(corrected[v], self.range(from, values, v)))
    }

    /// The least and the greatest value of the departure face.
    pub(crate) fn range(&self, from: &Departures, values: &VertexData<f64>, v: VertexId) -> [f64; 2] {
        let corners = self.surface.mesh().face(from[v].0).map(|w| values[w]);
        range(corners)
    }

    /// Values interpolated at points.
    fn sample(&self, places: &Departures, values: &VertexData<f64>) -> VertexData<f64> {
        VertexData::from_fn(places.len(), |v| {
            let (face, barycentric) = places[v];
            self.surface.mesh().face(face).into_iter().zip(barycentric).map(|(w, b)| b * values[w]).sum()
        })
    }
}

/// Clamps a number to a range; NaN stays.
pub(super) fn within(x: f64, [least, most]: [f64; 2]) -> f64 {
    if x < least {
        least
    } else if x > most {
        most
    } else {
        x
    }
}

/// Barycentric coordinates, corrected for rounding that put the point outside.
pub(super) fn inside(barycentric: [f64; 3]) -> [f64; 3] {
    let clamped = barycentric.map(|b| if b > 0.0 { b } else { 0.0 });
    let sum: f64 = clamped.iter().sum();
    if sum > 0.0 { clamped.map(|b| b / sum) } else { [1.0 / 3.0; 3] }
}

/// Adds mass where values are below their upper limit, or removes it where they are above their lower limit, until the total mass
/// is restored; in one pass, as far as the limits allow.
pub(crate) fn restore_mass(
    areas: &VertexData<f64>,
    values: &mut VertexData<f64>,
    mass: f64,
    range: impl Fn(VertexId) -> [f64; 2],
) {
    let found: f64 = areas.iter().zip(values.iter()).map(|(a, x)| a * x).sum();
    let missing = mass - found;
    let room = VertexData::from_fn(values.len(), |v| {
        let [least, most] = range(v);
        if missing > 0.0 { most - values[v] } else { least - values[v] }
    });
    let all: f64 = areas.iter().zip(&room).map(|(a, r)| a * r).sum();
    if all == 0.0 {
        return;
    }
    let share = (missing / all).clamp(0.0, 1.0);
    for (x, r) in values.iter_mut().zip(&room) {
        *x += share * r;
    }
}
