//! Lowering the greatest distances of a remeshed surface from the input, one place after the other.

use super::flips::hinge;
use super::local::{Fan, Local, distance_from, flipped, least_sine, middle};
use super::marked::Hold;
use super::samples::{Reached, Sample, reached};
use super::triangle::Triangle;
use glam::DVec3;
use pompeiu_core::MeshError;
use pompeiu_core::spatial::bvh::{Slot, Workspace};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// Rounds over the places that are farthest away.
const ROUNDS: usize = 4;

/// Share of the greatest distance from which places are changed, and from which they are looked at again.
const WORST: f64 = 0.7;
const WATCHED: f64 = 0.4;

/// Distances that chords of smooth places have, in target lengths: below they are left alone.
const LOW: f64 = 0.15;

/// Places that are changed in a round, as a share of the number of faces, and some more for small surfaces.
const PLACES: f64 = 0.005;
const MORE_PLACES: usize = 8;

/// Least angle that a change may make where it was greater, in degrees.
const LEAST_ANGLE: f64 = 38.0;

/// First step of a vertex, in target lengths.
const STEP: f64 = 0.15;

/// A change must lower the greatest distance around a place below these shares of what it was.
const WORTH_A_FLIP: f64 = 0.9;
const WORTH_A_MOVE: f64 = 0.95;

/// Faces of a task.
const TASK: usize = 1 << 10;

/// Points of the input, by the vertices of the face nearest to them.
type Points = BTreeMap<u32, Vec<DVec3>>;

/// A sample of the input far from the surface, with the face nearest to it.
struct Far {
    distance: f64,
    face: [u32; 3],
    sample: Sample,
}

/// A face far from the input.
struct Height {
    distance: f64,
    face: u32,
    /// The target length there.
    length: f64,
}

impl Local<'_> {
    /// Moves vertices and flips edges where the surface is farthest from samples of the input, or the input from it.
    pub(super) fn lower_distance(&mut self, samples: &[Sample]) -> Result<(), MeshError> {
        let mut samples = samples.to_vec();
        let mut faces: Vec<u32> = (0..self.surface.mesh.halfedge_slots() / 3).collect();
        let places = (PLACES * self.surface.mesh.face_count() as f64) as usize + MORE_PLACES;
        for _ in 0..ROUNDS {
            if self.is_stopped() {
                break;
            }
            let found = reached(self.surface, &samples)?;
            let mut heights = self.heights(&faces);
            let distances = found.iter().map(|found| found.distance);
            let all = distances.chain(heights.iter().map(|x| x.distance));
            let worst = all.fold(0.0, |most, x| if x > most { x } else { most });
            let mut far: Vec<Far> = found
                .iter()
                .zip(&samples)
                .filter(|(found, _)| found.distance > WATCHED * worst)
                .map(|(found, sample)| Far { distance: found.distance, face: found.face, sample: *sample })
                .collect();
            far.sort_by(|x, y| y.distance.total_cmp(&x.distance));
            heights.sort_by(|x, y| y.distance.total_cmp(&x.distance).then(x.face.cmp(&y.face)));
            heights.retain(|x| x.distance > WATCHED * worst);
            // Also those that are near must not become far when a vertex moves.
            let corners = heights.iter().map(|x| self.surface.mesh.corners(x.face));
            let mut points: Points =
                far.iter().map(|x| x.face).chain(corners).flatten().map(|v| (v, Vec::new())).collect();
            samples = handed_out(&samples, &found, &mut points);
            let touched = self.lower_each(&far, &heights, &points, worst, places);
            if touched.is_empty() {
                break;
            }
            faces = heights.into_iter().map(|x| x.face).chain(touched).collect();
            faces.sort_unstable();
            faces.dedup();
        }
        Ok(())
    }

    /// Changes the surface at the worst places; returns the faces that were changed.
    fn lower_each(
        &mut self,
        far: &[Far],
        heights: &[Height],
        points: &Points,
        worst: f64,
        places: usize,
    ) -> Vec<u32> {
        let is_high = |distance: f64, length: f64| distance > WORST * worst && distance > LOW * length;
        let mut touched = Vec::new();
        for far in far.iter().filter(|x| is_high(x.distance, x.sample.length)).take(places) {
            if self.is_stopped() {
                return touched;
            }
            let to = Some(far.sample.position);
            let _ = far.face.iter().any(|&v| self.move_for_distance(v, points, to, &mut touched));
        }
        for height in heights.iter().filter(|x| is_high(x.distance, x.length)).take(places) {
            if self.is_stopped() {
                return touched;
            }
            let sides = [0, 1, 2].map(|i| 3 * height.face + i);
            let _ = sides.into_iter().any(|h| self.flip_for_distance(h, points, &mut touched))
                || sides
                    .into_iter()
                    .any(|h| self.move_for_distance(self.surface.mesh.from(h), points, None, &mut touched));
        }
        touched
    }

    /// How far the middles of faces and of their edges are from the input.
    fn heights(&self, faces: &[u32]) -> Vec<Height> {
        let (surface, reference) = (&*self.surface, self.reference);
        let of_task = |task: &[u32]| {
            let mut workspace = Workspace::default();
            let height = |face: u32| {
                let triangle = surface.triangle(face);
                let [a, b, c] = triangle;
                let v = surface.mesh.from(3 * face) as usize;
                let middles = [middle(&triangle), 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)];
                let far = middles
                    .map(|p| reference.project(p, surface.near[v], &mut workspace).position.distance(p));
                let distance = far.into_iter().fold(0.0, |most, x| if x > most { x } else { most });
                Height { distance, face, length: surface.length[v] }
            };
            task.iter().copied().filter(|f| surface.mesh.exists(3 * f)).map(height).collect::<Vec<_>>()
        };
        faces.par_chunks(TASK).flat_map_iter(of_task).collect()
    }

    fn flip_for_distance(&mut self, h: u32, points: &Points, touched: &mut Vec<u32>) -> bool {
        let Some(t) = self.surface.mesh.twin_of(h) else { return false };
        let vertices = hinge(&self.surface.mesh, h, t);
        let Some([old, new]) = flipped(vertices.map(|v| self.surface.mesh.positions[v as usize])) else {
            return false;
        };
        if !keeps_angles(&old, &new) {
            return false;
        }
        let near = self.surface.near[vertices[0] as usize];
        // What is nearer to other faces is no matter of these.
        let beside = 0.5 * self.surface.length[vertices[0] as usize];
        let height = |s: &mut Self, faces: &[Triangle; 2]| {
            let [first, second] = faces;
            let middles = [middle(first), middle(second), 0.5 * (first[0] + first[1])];
            let most = s.farthest(middles.into_iter(), near, f64::INFINITY);
            let around = vertices.iter().filter_map(|v| points.get(v)).flatten();
            let distances = around.map(|p| distance_from(*p, faces)).filter(|x| *x < beside);
            distances.fold(most, |most, x| if x > most { x } else { most })
        };
        let before = height(self, &old);
        // The common edge after a flip runs between the first corners.
        let [[a, u, b], [_, v, _]] = new;
        let is_lower = height(self, &[[a, b, u], [b, a, v]]) < WORTH_A_FLIP * before;
        if !is_lower || !self.surface.flip(h) {
            return false;
        }
        touched.extend([h / 3, t / 3]);
        true
    }

    /// Moves a vertex to a point, or where it is better.
    fn move_for_distance(
        &mut self,
        v: u32,
        points: &Points,
        to: Option<DVec3>,
        touched: &mut Vec<u32>,
    ) -> bool {
        if self.surface.hold[v as usize] != Hold::Free {
            return false;
        }
        let fan = Fan::new(self.surface, v);
        let own = points.get(&v).map_or(&[][..], |own| own);
        let height = |s: &mut Self, fan: &Fan, near: Slot, enough: f64| {
            let distances = own.iter().map(|p| distance_from(*p, &fan.faces));
            let most = distances.fold(0.0, |most, x| if x > most { x } else { most });
            if most >= enough {
                return most;
            }
            let middles = s.farthest(fan.middles(), near, enough);
            if middles > most { middles } else { most }
        };
        let measure = |s: &mut Self, moved: &Fan, near: Slot, least: f64| {
            let is_allowed = keeps_angles(&fan.faces, &moved.faces) && moved.keeps_normals(&fan);
            if is_allowed { height(s, moved, near, least) } else { f64::INFINITY }
        };
        let near = self.surface.near[v as usize];
        let mut least = WORTH_A_MOVE * height(self, &fan, near, f64::INFINITY);
        let mut found = None;
        if let Some(p) = to {
            let value = measure(self, &fan.with(p), near, least);
            if value < least {
                (least, found) = (value, Some((p, near)));
            }
        }
        let Some((position, near)) = self.search(v, &fan, STEP, least, measure).or(found) else {
            return false;
        };
        self.surface.mesh.positions[v as usize] = position;
        self.surface.near[v as usize] = near;
        touched.extend(self.surface.mesh.halfedges_from(v).map(|h| h / 3));
        true
    }
}

/// Adds samples to the points of those vertices of the faces nearest to them that are among `points`; returns the samples that were added to some.
fn handed_out(samples: &[Sample], found: &[Reached], points: &mut Points) -> Vec<Sample> {
    let mut beside = Vec::new();
    for (sample, found) in samples.iter().zip(found) {
        let mut is_beside = false;
        for v in found.face {
            if let Some(own) = points.get_mut(&v) {
                own.push(sample.position);
                is_beside = true;
            }
        }
        beside.extend(is_beside.then_some(*sample));
    }
    beside
}

/// Whether the least angle of faces is not less than that of others, or no small one.
fn keeps_angles(old: &[Triangle], new: &[Triangle]) -> bool {
    let least = least_sine(new);
    least >= libm::sin(LEAST_ANGLE.to_radians()) || least >= least_sine(old)
}
