//! Medial balls as text and as triangles.

use crate::balls::Medial;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::{MeshError, TriMesh};
use std::fmt::Write as _;

/// Subdivisions of the icosahedron that represents a ball.
const SUBDIVISIONS: u32 = 3;

impl Medial {
    /// The balls and their edges in the text format of Q-MAT (`.ma`): the numbers of balls, edges and triangles; `v x y z r` for
    /// each ball; `e i j` for each edge, with indices from 0.
    pub fn to_ma(&self) -> String {
        let mut text = format!("{} {} 0\n", self.balls.len(), self.edges.len());
        for ball in &self.balls {
            let [x, y, z] = ball.centre;
            let _ = writeln!(text, "v {x} {y} {z} {}", ball.radius);
        }
        for [a, b] in &self.edges {
            let _ = writeln!(text, "e {a} {b}");
        }
        text
    }

    /// A sphere of 1,280 triangles for each ball, in order, with corners on the ball.
    ///
    /// # Errors
    /// [`MeshError`] if coordinates overflow.
    pub fn spheres(&self) -> Result<TriMesh, MeshError> {
        let (unit, triangles) =
            icosphere(1.0, SUBDIVISIONS).map_or_else(|_| Default::default(), TriMesh::into_parts);
        let mut positions = Vec::with_capacity(unit.len() * self.balls.len());
        let mut faces = Vec::with_capacity(triangles.len() * self.balls.len());
        for ball in &self.balls {
            let first = positions.len() as u32;
            positions.extend(unit.iter().map(|p| [0, 1, 2].map(|k| ball.centre[k] + ball.radius * p[k])));
            faces.extend(triangles.iter().map(|t| t.map(|v| v + first)));
        }
        TriMesh::new(positions, faces)
    }
}
