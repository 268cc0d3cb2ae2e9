//! Groups of faces that are drawn as one triangle each, where a mesh has more faces than can be drawn.

use super::snap::{Snap, rounded};
use super::triangles::{Triangles, Vertices};
use crate::deviation::DirectedDeviation;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_figures::page::Bounds;
use std::collections::HashMap;

/// Faces by the cells of a grid that their vertices lie in: those with the same three cells are one group, drawn as a triangle between the
/// vertices of these cells that are farthest from the other mesh.
pub(super) struct Groups {
    /// The vertices between which each group is drawn.
    corners: Vec<[u32; 3]>,
    /// The group of each face.
    pub(super) of_faces: Vec<u32>,
}

/// By how much cells grow until groups are few enough.
const GROWTH: f64 = 1.15;
/// Triangles for the square of the side of a cell in a surface, about.
const TRIANGLES: f64 = 2.0;
/// How often cells grow at most; far fewer do.
const ATTEMPTS: usize = 64;

impl Groups {
    /// At most about so many groups. A part of the surface that lies in one cell is a group by itself, drawn as its worst face.
    pub(super) fn new(found: &DirectedDeviation, mesh: &TriMesh, most: usize) -> Self {
        let aabb = Aabb::of_faces(mesh);
        let area: f64 = mesh.face_ids().map(|face| area(mesh.corners(face))).sum();
        let least = aabb.diagonal() / f64::from(u16::MAX);
        let mut side = (TRIANGLES * area / most as f64).sqrt().max(least);
        let mut groups = Self::in_cells(found, mesh, &aabb, side);
        for _ in 0..ATTEMPTS {
            if groups.corners.len() <= most {
                break;
            }
            side *= GROWTH;
            groups = Self::in_cells(found, mesh, &aabb, side);
        }
        groups
    }

    fn in_cells(found: &DirectedDeviation, mesh: &TriMesh, aabb: &Aabb, side: f64) -> Self {
        let cells = Cells::new(found, mesh, aabb, side);
        let mut groups = Self { corners: Vec::new(), of_faces: vec![u32::MAX; mesh.faces().len()] };
        let mut known: HashMap<[u32; 3], u32> = HashMap::new();
        let mut of_cell: Vec<Option<u32>> = vec![None; cells.farthest.len()];
        for (face, corners) in mesh.faces().iter().enumerate() {
            let [a, b, c] = corners.map(|v| cells.of_vertices[v as usize]);
            if a == b || b == c || c == a {
                continue;
            }
            let mut key = [a, b, c];
            key.sort_unstable();
            let next = groups.corners.len() as u32;
            let group = *known.entry(key).or_insert(next);
            if group == next {
                groups.corners.push([a, b, c].map(|cell| cells.farthest[cell as usize]));
            }
            groups.of_faces[face] = group;
            for cell in [a, b, c] {
                of_cell[cell as usize].get_or_insert(group);
            }
        }
        groups.add_the_rest(found, mesh, &cells, &mut of_cell);
        groups
    }

    /// Faces that lie in one or two cells belong to a group that has one of these; where there is none, they are one with their worst face.
    fn add_the_rest(
        &mut self,
        found: &DirectedDeviation,
        mesh: &TriMesh,
        cells: &Cells,
        of_cell: &mut [Option<u32>],
    ) {
        let mut rest: Vec<u32> = (0..self.of_faces.len() as u32)
            .filter(|face| self.of_faces[*face as usize] == u32::MAX)
            .collect();
        let worst = |face: &u32| found.faces[*face as usize].max.upper();
        rest.sort_by(|x, y| worst(y).total_cmp(&worst(x)).then(x.cmp(y)));
        for face in rest {
            let corners = mesh.faces()[face as usize];
            let of_corners = corners.map(|v| cells.of_vertices[v as usize] as usize);
            let group = of_corners.iter().find_map(|cell| of_cell[*cell]).unwrap_or_else(|| {
                self.corners.push(corners);
                self.corners.len() as u32 - 1
            });
            for cell in of_corners {
                of_cell[cell].get_or_insert(group);
            }
            self.of_faces[face as usize] = group;
        }
    }

    /// The triangle of each group, and an enclosure of the largest distance of its faces.
    pub(super) fn drawn(
        &self,
        found: &DirectedDeviation,
        mesh: &TriMesh,
        snap: &Snap,
    ) -> (Triangles, Vec<Bounds>) {
        let signed = found.signed_vertices();
        let values = signed.as_ref().unwrap_or(&found.vertices);
        let (mut triangles, mut vertices) = (Triangles::default(), Vertices::of(mesh));
        for (group, at) in self.corners.iter().enumerate() {
            let corners = at.map(|v| vertices.place(v, &mut triangles, |p| snap.position(p)));
            triangles.push(group as u32, corners, at.map(|v| snap.distance(values[v as usize])));
        }
        let mut bounds: Vec<Bounds> = vec![[0.0; 2]; self.corners.len()];
        for (group, face) in self.of_faces.iter().zip(&found.faces) {
            let [lower, upper] = &mut bounds[*group as usize];
            *lower = if face.max.lower() > *lower { face.max.lower() } else { *lower };
            *upper = if face.max.upper() > *upper { face.max.upper() } else { *upper };
        }
        (triangles, bounds.into_iter().map(rounded).collect())
    }
}

/// The cells of a grid that vertices lie in.
struct Cells {
    of_vertices: Vec<u32>,
    /// The vertex of each cell that is farthest from the other mesh.
    farthest: Vec<u32>,
}

impl Cells {
    fn new(found: &DirectedDeviation, mesh: &TriMesh, aabb: &Aabb, side: f64) -> Self {
        let mut numbers: HashMap<[i64; 3], u32> = HashMap::new();
        let mut farthest: Vec<u32> = Vec::new();
        let distance = |v: u32| {
            let distance = found.vertices[v as usize];
            if distance.is_nan() { -1.0 } else { distance }
        };
        let cell = |(v, p): (usize, &[f64; 3])| {
            let key = [0, 1, 2].map(|k| ((p[k] - aabb.lower[k]) / side).floor() as i64);
            let next = farthest.len() as u32;
            let cell = *numbers.entry(key).or_insert(next);
            if cell == next {
                farthest.push(v as u32);
            } else if distance(v as u32) > distance(farthest[cell as usize]) {
                farthest[cell as usize] = v as u32;
            }
            cell
        };
        let of_vertices = mesh.positions().iter().enumerate().map(cell).collect();
        Self { of_vertices, farthest }
    }
}

fn area([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let [a, b, c] = [a, b, c].map(glam::DVec3::from_array);
    0.5 * (b - a).cross(c - a).length()
}
