//! The distance of faces on the wall of a node from the cones, between their vertices as well.

use super::wall::{NearWalls, Wall};
use glam::DVec3;

/// Parts of a face along each edge, at whose corners its distance is measured.
const PARTS: usize = 3;

/// Largest distance from the surface over the value of the smooth distance.
const DEEPEST: f64 = 3.0;

/// Distance at which the cost of a face is its weight, in radii.
const SCALE: f64 = 0.1;

/// How far vertices may move before cones that are not near a face become the nearest ones, in radii.
const MOVE: f64 = 0.5;

/// Faces on the wall, each with the cones near it.
pub(super) struct Skin {
    faces: Vec<Face>,
    /// The weights of the vertices of a face at each of its points.
    places: Vec<[f64; 4]>,
    /// The mean cost over a face is this times the fourth power of the distance in units of [`SCALE`].
    weight: f64,
}

struct Face {
    vertices: [u32; 4],
    near: Wall,
    /// For each point the least radius of the cones near it, and the distance from the surface over the value of the smooth distance, which is
    /// less in a crease.
    points: Vec<(f64, f64)>,
}

impl Skin {
    /// Bilinear faces with the given vertices, which may move by half a radius.
    pub(super) fn new(wall: &Wall, faces: &[[u32; 4]], positions: &[DVec3], weight: f64) -> Self {
        let places = bilinear();
        let face = |vertices: &[u32; 4]| {
            let corners = vertices.map(|v| positions[v as usize]);
            let centre = corners.iter().sum::<DVec3>() / 4.0;
            let reach = corners.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
            let near = wall.near(centre, reach + MOVE * wall.radius(centre));
            let point = |weights: &[f64; 4]| {
                let p = at(&corners, weights);
                let (distance, slope) = near.distance(p);
                (near.least_radius(p), depth_of(&near, p, distance, slope))
            };
            let points = places.iter().map(point).collect();
            Face { vertices: *vertices, near, points }
        };
        let faces = faces.iter().map(face).collect();
        Self { faces, places, weight }
    }

    /// Number of points.
    pub(super) fn points(&self) -> usize {
        self.places.len() * self.faces.len()
    }

    /// The greatest distance of the points, in radii.
    pub(super) fn off(&self, positions: &[DVec3]) -> f64 {
        let of_face = |face: &Face| {
            let corners = face.vertices.map(|v| positions[v as usize]);
            let distance = |(weights, (radius, _)): (&[f64; 4], &(f64, f64))| {
                let p = at(&corners, weights);
                let (distance, slope) = face.near.distance(p);
                distance.abs() * depth_of(&face.near, p, distance, slope) / radius
            };
            self.places.iter().zip(&face.points).map(distance).fold(0.0, f64::max)
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
        let count = self.places.len();
        let share = self.weight / count as f64;
        for (index, face) in self.faces.iter().enumerate() {
            let corners = face.vertices.map(|v| positions[v as usize]);
            for (k, (weights, (radius, depth))) in self.places.iter().zip(&face.points).enumerate() {
                let unit = SCALE * radius / depth;
                let (distance, slope) = near.distance(count * index + k, &face.near, at(&corners, weights));
                let relative = distance / unit;
                let cube = share * relative * relative * relative;
                *energy += cube * relative;
                let slope = slope * (4.0 * cube / unit);
                for (v, weight) in face.vertices.iter().zip(weights) {
                    gradient[*v as usize] += slope * *weight;
                }
            }
        }
    }
}

/// The distance from the surface over the value of the smooth distance: outside of a crease, that from its bottom to first order; inside, that to where
/// all cones are left, not only the one that is nearest.
fn depth_of(wall: &Wall, p: DVec3, distance: f64, slope: DVec3) -> f64 {
    if distance > 0.0 {
        (1.0 / slope.length()).min(DEEPEST)
    } else if distance < 0.0 {
        (wall.way_out(p) / -distance).clamp(1.0, DEEPEST)
    } else {
        1.0
    }
}

fn at(corners: &[DVec3; 4], weights: &[f64; 4]) -> DVec3 {
    corners.iter().zip(weights).map(|(p, w)| *p * *w).sum()
}

/// The weights of the vertices of a bilinear face at the points.
fn bilinear() -> Vec<[f64; 4]> {
    let at = |k: usize| {
        let [u, v] = [k % (PARTS + 1), k / (PARTS + 1)].map(|i| i as f64 / PARTS as f64);
        [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v]
    };
    (0..(PARTS + 1) * (PARTS + 1)).map(at).collect()
}
