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

/// Faces on the wall, each with the cones near it; with `N` vertices.
pub(super) struct Skin<const N: usize> {
    faces: Vec<Face<N>>,
    /// The weights of the vertices of a face at each of its points.
    places: Vec<[f64; N]>,
    /// The mean cost over a face is this times the fourth power of the distance in units of [`SCALE`].
    weight: f64,
}

struct Face<const N: usize> {
    vertices: [u32; N],
    near: Wall,
    /// For each point the least radius of the cones near it, and the distance from the surface outside of a crease over the value of the smooth
    /// distance, which is less.
    points: Vec<(f64, f64)>,
}

impl Skin<4> {
    /// Bilinear faces with the given vertices, which may move by half a radius.
    pub(super) fn new(wall: &Wall, faces: &[[u32; 4]], positions: &[DVec3], weight: f64) -> Self {
        Self::of_faces(wall, faces, bilinear(), positions, weight)
    }
}

impl<const N: usize> Skin<N> {
    /// Faces that are given by the weights of their vertices at points.
    pub(super) fn of_faces(
        wall: &Wall,
        faces: &[[u32; N]],
        places: Vec<[f64; N]>,
        positions: &[DVec3],
        weight: f64,
    ) -> Self {
        let face = |vertices: &[u32; N]| {
            let corners = vertices.map(|v| positions[v as usize]);
            let centre = corners.iter().sum::<DVec3>() / N as f64;
            let reach = corners.iter().map(|p| p.distance(centre)).fold(0.0, f64::max);
            let near = wall.near(centre, reach + MOVE * wall.radius(centre));
            let point = |weights: &[f64; N]| {
                let p = at(&corners, weights);
                (near.least_radius(p), stretch(near.distance(p)))
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
        let of_face = |face: &Face<N>| {
            let corners = face.vertices.map(|v| positions[v as usize]);
            let distance = |(weights, (radius, _)): (&[f64; N], &(f64, f64))| {
                let p = at(&corners, weights);
                let (distance, slope) = face.near.distance(p);
                // Inside, to where all cones are left, not only the one that is nearest.
                let distance =
                    if distance > 0.0 { distance * stretch((distance, slope)) } else { face.near.way_out(p) };
                distance / radius
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
            for (k, (weights, (radius, stretch))) in self.places.iter().zip(&face.points).enumerate() {
                let (distance, slope) = near.way(count * index + k, &face.near, at(&corners, weights));
                let unit = if distance > 0.0 { SCALE * radius / stretch } else { SCALE * radius };
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

/// The distance from the surface over the value of the smooth distance: outside of a crease, that from its bottom to first order.
fn stretch((distance, slope): (f64, DVec3)) -> f64 {
    if distance > 0.0 { (1.0 / slope.length()).min(DEEPEST) } else { 1.0 }
}

fn at<const N: usize>(corners: &[DVec3; N], weights: &[f64; N]) -> DVec3 {
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
