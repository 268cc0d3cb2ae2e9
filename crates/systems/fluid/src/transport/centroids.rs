//! Semi-Lagrangian transport of quantities on faces.

use super::backtrace::{Backtrace, Passage, inside, within};
use crate::Correction;
use crate::report::range;
use pompeiu_core::FaceId;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_operators::FaceField;
use pompeiu_surface::Ray;
use pompeiu_surface::plane::{Rotation, Vec2, add, inverse, norm, rotate, scale, sub};
use rayon::prelude::*;

/// The departure point of a centroid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FaceDeparture {
    face: FaceId,
    barycentric: [f64; 3],
    /// The rotation from the frame of the departure face to that of the arrival face.
    back: Rotation,
}

impl Backtrace<'_> {
    /// The departure and arrival points of centroids for a step: in a straight line, or by the midpoint rule if the transport is
    /// corrected.
    pub(crate) fn passage_of_centroids(
        &self,
        field: &FaceField,
        step: f64,
        correction: Correction,
    ) -> Passage<FaceData<FaceDeparture>> {
        let at_vertices = (correction != Correction::Linear).then(|| self.at_vertices(field));
        Passage::new(correction, step, |time| self.follow_centroids(field, at_vertices.as_ref(), time))
    }

    /// Where a flow carries the centroid of each face in some time; for a negative time, where it comes from.
    ///
    /// In a straight line with the velocity of the face, or by the midpoint rule if the velocity at vertices is given.
    fn follow_centroids(
        &self,
        field: &FaceField,
        at_vertices: Option<&VertexData<Vec2>>,
        time: f64,
    ) -> FaceData<FaceDeparture> {
        const CENTRE: [f64; 3] = [1.0 / 3.0; 3];
        let stay = FaceDeparture { face: FaceId(0), barycentric: CENTRE, back: [1.0, 0.0] };
        let mut places = FaceData::filled(field.len(), stay);
        places.as_mut_slice().par_iter_mut().with_min_len(256).enumerate().for_each(|(f, place)| {
            let face = FaceId(f as u32);
            place.face = face;
            let ray = |vector: Vec2| Ray {
                face,
                point: self.surface().point(face, CENTRE),
                direction: vector,
                length: norm(vector),
            };
            let mut velocity = field[face];
            if let Some(at_vertices) = at_vertices.filter(|_| norm(velocity) > 0.0) {
                let half = ray(scale(0.5 * time, velocity));
                let end = self.tracer().trace(&half);
                let there =
                    self.at_point(at_vertices, end.face, self.surface().barycentric(end.face, end.point));
                velocity = rotate(inverse(end.transport(&half)), there);
            }
            if norm(velocity) > 0.0 {
                let ray = ray(scale(time, velocity));
                let end = self.tracer().trace(&ray);
                place.face = end.face;
                place.barycentric = inside(self.surface().barycentric(end.face, end.point));
                place.back = inverse(end.transport(&ray));
            }
        });
        places
    }

    /// Vectors on faces after a transport step, with parallel transport.
    pub(crate) fn carry_vectors(
        &self,
        passage: &Passage<FaceData<FaceDeparture>>,
        field: &FaceField,
    ) -> FaceField {
        let sample = |places: &FaceData<FaceDeparture>, at_vertices: &VertexData<Vec2>| {
            FaceField::from_fn(places.len(), |face| {
                let place = &places[face];
                rotate(place.back, self.at_point(at_vertices, place.face, place.barycentric))
            })
        };
        let from = &passage.from;
        let at_vertices = self.at_vertices(field);
        let carried = sample(from, &at_vertices);
        let Some(to) = &passage.to else { return carried };
        let returned = sample(to, &self.at_vertices(&carried));
        let missed = FaceField::from_fn(field.len(), |face| scale(0.5, sub(field[face], returned[face])));
        let sum = |a: &FaceField| FaceField::from_fn(a.len(), |face| add(a[face], missed[face]));
        let corrected = match passage.correction {
            Correction::Bfecc => sample(from, &self.at_vertices(&sum(field))),
            _ => sum(&carried),
        };
        FaceField::from_fn(field.len(), |face| {
            let u = corrected[face];
            let bound = self.greatest_speed(field, &at_vertices, from[face].face);
            let speed = norm(u);
            if speed > bound { scale(bound / speed, u) } else { u }
        })
    }

    /// The greatest speed of a face and of its corners.
    fn greatest_speed(&self, field: &FaceField, at_vertices: &VertexData<Vec2>, face: FaceId) -> f64 {
        let corners = self.surface().mesh().face(face).map(|v| norm(at_vertices[v]));
        corners.into_iter().fold(norm(field[face]), |m, x| if x > m { x } else { m })
    }

    /// Values on faces after a transport step.
    pub(crate) fn carry_on_faces(
        &self,
        passage: &Passage<FaceData<FaceDeparture>>,
        values: &FaceData<f64>,
    ) -> FaceData<f64> {
        let mesh = self.surface().mesh();
        let sample = |places: &FaceData<FaceDeparture>, at_vertices: &VertexData<f64>| {
            FaceData::from_fn(places.len(), |face| {
                let place = &places[face];
                mesh.face(place.face)
                    .into_iter()
                    .zip(place.barycentric)
                    .map(|(v, b)| b * at_vertices[v])
                    .sum()
            })
        };
        let from = &passage.from;
        let at_vertices = self.vertex_means(values);
        let carried: FaceData<f64> = sample(from, &at_vertices);
        let Some(to) = &passage.to else { return carried };
        let returned: FaceData<f64> = sample(to, &self.vertex_means(&carried));
        let missed = FaceData::from_fn(values.len(), |face| 0.5 * (values[face] - returned[face]));
        let sum = |a: &FaceData<f64>| FaceData::from_fn(a.len(), |face| a[face] + missed[face]);
        let corrected = match passage.correction {
            Correction::Bfecc => sample(from, &self.vertex_means(&sum(values))),
            _ => sum(&carried),
        };
        FaceData::from_fn(values.len(), |face| {
            let place = from[face].face;
            let corners = mesh.face(place).map(|v| at_vertices[v]);
            within(corrected[face], range(corners.into_iter().chain([values[place]])))
        })
    }
}
