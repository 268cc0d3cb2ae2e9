//! The distance of faces on the wall of a node from the cones, between their vertices as well.

use super::wall::{NearWalls, Wall};
use glam::DVec3;

/// Parts of a face along each edge, at whose corners its distance is measured.
const PARTS: usize = 3;

/// Points of a face.
const POINTS: usize = (PARTS + 1) * (PARTS + 1);

/// Largest distance from the surface over the value of the smooth distance.
const DEEPEST: f64 = 3.0;

/// Distance at which the cost of a face is its weight, in radii.
const SCALE: f64 = 0.1;

/// How far vertices may move before cones that are not near a face become the nearest ones, in radii.
const MOVE: f64 = 0.5;

/// Faces on the wall, each with the cones near it.
pub(super) struct Skin {
    faces: Vec<Face>,
    /// The mean cost over a face is this times the fourth power of the distance in units of [`SCALE`].
    weight: f64,
}

struct Face {
    vertices: [u32; 4],
    near: Wall,
    /// The radius of the cone next to its centre.
    radius: f64,
    /// For each point the distance from the surface over the value of the smooth distance, which is less in a crease.
    depths: [f64; POINTS],
}

impl Skin {
    /// Faces with the given vertices, which may move by half a radius.
    pub(super) fn new(wall: &Wall, faces: &[[u32; 4]], positions: &[DVec3], weight: f64) -> Self {
        let face = |vertices: &[u32; 4]| {
            let corners = vertices.map(|v| positions[v as usize]);
            let centre = corners.iter().sum::<DVec3>() / 4.0;
            let radius = wall.radius(centre);
            let reach = corners.iter().map(|p| p.distance(centre)).fold(0.0, f64::max) + MOVE * radius;
            let near = wall.near(centre, reach);
            let mut depths = [1.0; POINTS];
            for (depth, weights) in depths.iter_mut().zip(weights()) {
                let (distance, slope) = near.distance(at(&corners, &weights));
                *depth = depth_of(distance, slope);
            }
            Face { vertices: *vertices, near, radius, depths }
        };
        Self { faces: faces.iter().map(face).collect(), weight }
    }

    /// Number of points.
    pub(super) fn points(&self) -> usize {
        POINTS * self.faces.len()
    }

    /// The greatest distance of the points, in radii.
    pub(super) fn off(&self, positions: &[DVec3]) -> f64 {
        let of_face = |face: &Face| {
            let corners = face.vertices.map(|v| positions[v as usize]);
            let distance = |weights| {
                let (distance, slope) = face.near.distance(at(&corners, &weights));
                distance.abs() * depth_of(distance, slope) / face.radius
            };
            weights().map(distance).fold(0.0, f64::max)
        };
        self.faces.iter().map(of_face).fold(0.0, f64::max)
    }

    /// Adds the cost to an energy, and its derivatives to the gradient with respect to all vertices.
    pub(super) fn add_cost(
        &self,
        (positions, near): (&[DVec3], &mut NearWalls),
        energy: &mut f64,
        gradient: &mut [DVec3],
    ) {
        let share = self.weight / POINTS as f64;
        for (index, face) in self.faces.iter().enumerate() {
            let corners = face.vertices.map(|v| positions[v as usize]);
            for (k, (weights, depth)) in weights().zip(face.depths).enumerate() {
                let unit = SCALE * face.radius / depth;
                let (distance, slope) = near.distance(POINTS * index + k, &face.near, at(&corners, &weights));
                let relative = distance / unit;
                let cube = share * relative * relative * relative;
                *energy += cube * relative;
                let slope = slope * (4.0 * cube / unit);
                for (v, weight) in face.vertices.iter().zip(weights) {
                    gradient[*v as usize] += slope * weight;
                }
            }
        }
    }
}

/// The distance from the surface over the value of the smooth distance, to first order: outside of a crease, the distance from its bottom.
fn depth_of(distance: f64, slope: DVec3) -> f64 {
    if distance > 0.0 { (1.0 / slope.length()).min(DEEPEST) } else { 1.0 }
}

fn at(corners: &[DVec3; 4], weights: &[f64; 4]) -> DVec3 {
    corners.iter().zip(weights).map(|(p, w)| *p * *w).sum()
}

/// The weights of the vertices of a face at the points.
fn weights() -> impl Iterator<Item = [f64; 4]> {
    (0..POINTS).map(|k| {
        let [u, v] = [k % (PARTS + 1), k / (PARTS + 1)].map(|i| i as f64 / PARTS as f64);
        [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v]
    })
}
