//! A surface that moves: positions, faces, and which vertices may move where.

use super::options::BoundaryCondition;
use super::triangle::Triangle;
use glam::DVec3;
use pompeiu_remesh::{DynamicMesh, angles};
use rayon::prelude::*;

/// How a vertex may move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Motion {
    /// In any direction.
    Free,
    /// Not at all.
    Fixed,
    /// In the plane through it orthogonal to z; the frame of the flow is turned so that this is the plane it may slide in.
    InPlane,
}

impl Motion {
    /// The part of a vector along which the vertex may move.
    #[inline]
    pub(crate) fn project(self, vector: DVec3) -> DVec3 {
        match self {
            Self::Free => vector,
            Self::Fixed => DVec3::ZERO,
            Self::InPlane => DVec3::new(vector.x, vector.y, 0.0),
        }
    }

    /// Whether a coordinate may change.
    pub(crate) fn allows(self, coordinate: usize) -> bool {
        self == Self::Free || self == Self::InPlane && coordinate < 2
    }
}

/// A surface that moves.
#[derive(Clone, Debug)]
pub(crate) struct MovingSurface {
    pub(crate) mesh: DynamicMesh,
    /// By vertex.
    pub(crate) motion: Vec<Motion>,
}

/// Faces of a parallel task.
const TASK: usize = 2048;

impl MovingSurface {
    /// A surface whose boundary vertices may do what a condition says.
    pub(crate) fn new(mesh: DynamicMesh, boundary: BoundaryCondition) -> Self {
        let at_boundary = match boundary {
            BoundaryCondition::Fixed => Motion::Fixed,
            BoundaryCondition::Planes(_) => Motion::InPlane,
        };
        let of = |v: u32| if mesh.is_boundary(v) { at_boundary } else { Motion::Free };
        let motion = (0..mesh.positions().len() as u32).map(of).collect();
        Self { mesh, motion }
    }

    /// The boundary loops, as polygons.
    pub(crate) fn boundary_loops(&self) -> Vec<Vec<DVec3>> {
        let mesh = &self.mesh;
        let mut left: Vec<bool> =
            (0..mesh.positions().len() as u32).map(|v| mesh.has_faces(v) && mesh.is_boundary(v)).collect();
        let mut loops = Vec::new();
        for v in 0..left.len() as u32 {
            let mut at = v;
            let mut polygon = Vec::new();
            while std::mem::replace(&mut left[at as usize], false) {
                polygon.push(mesh.positions()[at as usize]);
                at = mesh.next_on_boundary(at);
            }
            if !polygon.is_empty() {
                loops.push(polygon);
            }
        }
        loops
    }

    /// The least angle of all triangles, in degrees.
    pub(crate) fn least_angle(&self) -> f64 {
        let corners = self.faces().iter().map(|face| face.map(|v| self.positions()[v as usize]));
        corners.flat_map(angles).fold(f64::INFINITY, f64::min)
    }

    /// The middle of the triangle with the least angle.
    pub(crate) fn thinnest(&self) -> Option<DVec3> {
        let corners = self.faces().iter().map(|face| face.map(|v| self.positions()[v as usize]));
        let least = |t: &[DVec3; 3]| angles(*t).into_iter().fold(f64::INFINITY, f64::min);
        let thinnest = corners.min_by(|s, t| least(s).total_cmp(&least(t)))?;
        Some((thinnest[0] + thinnest[1] + thinnest[2]) / 3.0)
    }

    pub(crate) fn positions(&self) -> &[DVec3] {
        self.mesh.positions()
    }

    pub(crate) fn faces(&self) -> &[[u32; 3]] {
        self.mesh.face_slots()
    }

    pub(crate) fn triangle(&self, face: usize, positions: &[DVec3]) -> Triangle {
        Triangle::new(self.faces()[face].map(|v| positions[v as usize]))
    }

    pub(crate) fn triangles(&self) -> Vec<Triangle> {
        let corners = |face: &[u32; 3]| Triangle::new(face.map(|v| self.positions()[v as usize]));
        self.faces().par_iter().with_min_len(TASK).map(corners).collect()
    }

    /// The area with other positions.
    pub(crate) fn area_at(&self, positions: &[DVec3]) -> f64 {
        let of = |faces: &[[u32; 3]]| {
            faces.iter().map(|f| Triangle::new(f.map(|v| positions[v as usize])).area).sum::<f64>()
        };
        let parts: Vec<f64> = self.faces().par_chunks(TASK).map(of).collect();
        parts.iter().sum()
    }

    pub(crate) fn area(&self) -> f64 {
        self.area_at(self.positions())
    }

    /// The volume of the cone from the origin over the surface: that enclosed by a closed one.
    pub(crate) fn volume_at(&self, positions: &[DVec3]) -> f64 {
        let of = |f: &[u32; 3]| {
            let [a, b, c] = f.map(|v| positions[v as usize]);
            a.dot(b.cross(c))
        };
        let parts: Vec<f64> =
            self.faces().par_chunks(TASK).map(|faces| faces.iter().map(of).sum::<f64>()).collect();
        parts.iter().sum::<f64>() / 6.0
    }

    pub(crate) fn volume(&self) -> f64 {
        self.volume_at(self.positions())
    }

    /// The gradient of the area at each vertex, in the directions that it may move in.
    pub(crate) fn gradient(&self, triangles: &[Triangle]) -> Vec<DVec3> {
        let mut gradient = self.sum_at_vertices(triangles, Triangle::gradient);
        for (g, motion) in gradient.iter_mut().zip(&self.motion) {
            *g = motion.project(*g);
        }
        gradient
    }

    /// The gradient of the volume at each vertex, in the directions that it may move in.
    pub(crate) fn volume_gradient_at(&self, positions: &[DVec3]) -> Vec<DVec3> {
        let mut gradient = vec![DVec3::ZERO; positions.len()];
        for face in self.faces() {
            let [a, b, c] = face.map(|v| positions[v as usize]);
            for (v, part) in face.iter().zip([b.cross(c), c.cross(a), a.cross(b)]) {
                gradient[*v as usize] += part / 6.0;
            }
        }
        for (g, motion) in gradient.iter_mut().zip(&self.motion) {
            *g = motion.project(*g);
        }
        gradient
    }

    /// A third of the area of the faces around each vertex.
    pub(crate) fn masses(&self, triangles: &[Triangle]) -> Vec<f64> {
        let mut masses = vec![0.0; self.positions().len()];
        for (face, triangle) in self.faces().iter().zip(triangles) {
            for v in face {
                masses[*v as usize] += triangle.area / 3.0;
            }
        }
        masses
    }

    /// Unit normals of vertices, weighted by area; zero where they cancel.
    pub(crate) fn normals(&self, triangles: &[Triangle]) -> Vec<DVec3> {
        let sums = self.sum_at_vertices(triangles, |t| [t.area * t.normal; 3]);
        sums.into_iter().map(DVec3::normalize_or_zero).collect()
    }

    /// The unit direction in which each vertex moves along its normal, as far as it may; zero where it may not.
    pub(crate) fn directions(&self, normals: &[DVec3]) -> Vec<DVec3> {
        let along = |(n, motion): (&DVec3, &Motion)| motion.project(*n).normalize_or_zero();
        normals.iter().zip(&self.motion).map(along).collect()
    }

    fn sum_at_vertices(&self, triangles: &[Triangle], of: impl Fn(&Triangle) -> [DVec3; 3]) -> Vec<DVec3> {
        let mut sums = vec![DVec3::ZERO; self.positions().len()];
        for (face, triangle) in self.faces().iter().zip(triangles) {
            for (v, part) in face.iter().zip(of(triangle)) {
                sums[*v as usize] += part;
            }
        }
        sums
    }
}

/// Mean length of the edges of triangles.
pub(crate) fn mean_edge(triangles: &[Triangle]) -> f64 {
    let lengths = triangles.iter().flat_map(|t| t.edges).map(DVec3::length).sum::<f64>();
    lengths / (3 * triangles.len()) as f64
}
