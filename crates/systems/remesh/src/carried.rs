//! Values at the corners of faces, such as texture coordinates and colours: where they jump, and what they are on another mesh.

use super::connectivity::{ConnectivityError, DynamicMesh, NONE, next};
use glam::DVec3;
use pompeiu_core::geom::point_triangle::{closest_barycentric, distance_sq};
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::UnionFind;
use pompeiu_core::spatial::bvh::{Bvh, Workspace};
use pompeiu_core::{TriMesh, VertexId};
use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashSet};

/// Faces that the walk to the nearest point looks at without coming nearer before it ends.
const PATIENCE: usize = 64;

/// Values at a vertex that differ by no more than this share of their range are one.
const EQUAL: f64 = 1e-9;

/// One value for each corner of each face; where the corners of a vertex have several there is a seam.
///
/// # Shapes and units
/// `corners` holds a triple of indices into `values` for each face. For values at vertices it is the list of faces itself.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CornerValues<const N: usize> {
    /// The values.
    pub values: Vec<[f64; N]>,
    /// Which of them each corner of each face has.
    pub corners: Vec<[u32; 3]>,
}

/// Why values cannot be carried over.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CarryError {
    /// The faces are no oriented manifold.
    #[error(transparent)]
    Connectivity(#[from] ConnectivityError),
    /// There are values for another number of faces.
    #[error("found values at the corners of {found} faces, expected {expected}")]
    Faces {
        /// Faces with values.
        found: usize,
        /// Faces of the mesh.
        expected: usize,
    },
    /// A corner names a value that does not exist.
    #[error("face {face} names value {index}, but there are {values} (the first is 0)")]
    Index {
        /// The face.
        face: usize,
        /// What it names.
        index: u32,
        /// Number of values.
        values: usize,
    },
}

/// A surface with values at its corners, ready to be asked for the value at points near it.
///
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::icosphere;
/// use pompeiu_remesh::{Carrier, CornerValues, SimplifyOptions, SimplifyTarget, simplify};
///
/// let sphere = icosphere(1.0, 4)?;
/// let heights = CornerValues { values: sphere.positions().to_vec(), corners: sphere.faces().to_vec() };
/// let carrier = Carrier::new(&sphere, heights, &[])?;
/// let light = simplify(&sphere, &SimplifyOptions::new(SimplifyTarget::Within(0.01)))?;
/// let carried = carrier.carry(&light.mesh, &light.kept)?;
/// for (face, corners) in light.mesh.faces().iter().zip(&carried.corners) {
///     for (v, value) in face.iter().zip(corners) {
///         let (p, q) = (light.mesh.positions()[*v as usize], carried.values[*value as usize]);
///         assert!((0..3).all(|i| (p[i] - q[i]).abs() <= 0.01));
///     }
/// }
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Carrier<const N: usize> {
    surface: DynamicMesh,
    values: CornerValues<N>,
    /// Whether the values jump across each halfedge's edge.
    jumps: Vec<bool>,
    bvh: Bvh,
    frame: Frame,
}

impl<const N: usize> Carrier<N> {
    /// Finds the seams: edges with other values on both sides, and between faces of different `groups`, one number for each face or
    /// none at all.
    ///
    /// # Errors
    /// [`CarryError`].
    /// # Cost
    /// O(m log m) for m faces.
    pub fn new(mesh: &TriMesh, values: CornerValues<N>, groups: &[u32]) -> Result<Self, CarryError> {
        let expected = mesh.faces().len();
        for found in [Some(values.corners.len()), (!groups.is_empty()).then_some(groups.len())] {
            if let Some(found) = found.filter(|found| *found != expected) {
                return Err(CarryError::Faces { found, expected });
            }
        }
        let count = values.values.len();
        for (face, corners) in values.corners.iter().enumerate() {
            if let Some(&index) = corners.iter().find(|index| **index as usize >= count) {
                return Err(CarryError::Index { face, index, values: count });
            }
        }
        let frame = Frame::of(&Aabb::of_faces(mesh));
        let surface = in_frame(mesh, &frame)?;
        let at = |h: u32| values.values[values.corners[h as usize / 3][h as usize % 3] as usize];
        let other_group = |h: u32, t: u32| groups.get(h as usize / 3) != groups.get(t as usize / 3);
        let jumps = (0..surface.halfedge_slots())
            .map(|h| {
                surface
                    .twin_of(h)
                    .is_some_and(|t| other_group(h, t) || at(h) != at(next(t)) || at(next(h)) != at(t))
            })
            .collect();
        let bvh = Bvh::build(mesh, &frame);
        Ok(Self { surface, values, jumps, bvh, frame })
    }

    /// The edges where values jump, by their ends: what [`Features::edges`](super::Features::edges) takes.
    pub fn seams(&self) -> Vec<[VertexId; 2]> {
        let named = self.surface.edges().filter(|&h| self.jumps[h as usize]);
        named.map(|h| [self.surface.from(h), self.surface.to(h)].map(VertexId)).collect()
    }

    /// The values on a mesh near this surface: at each corner those of the nearest point of the surface, on the side of the seams
    /// where its face lies.
    ///
    /// `kept` are the edges of the mesh that seams may run along, [`Simplified::kept`](super::Simplified::kept); the corners of a vertex
    /// between two of them have one value.
    ///
    /// # Errors
    /// None for a mesh that is an oriented manifold.
    /// # Limits
    /// The side is told by the nearest point to the middle of the largest face. Where the mesh is coarser than the charts of a texture, that
    /// may be another chart.
    pub fn carry(&self, mesh: &TriMesh, kept: &[[VertexId; 2]]) -> Result<CornerValues<N>, CarryError> {
        let target = in_frame(mesh, &self.frame)?;
        let mut sectors = sectors(&target, kept);
        let corners = 3 * mesh.faces().len();
        let widest = widest_faces(&target, &mut sectors);
        let mut number = vec![NONE; corners];
        let mut found = CornerValues { values: Vec::new(), corners: vec![[0; 3]; mesh.faces().len()] };
        // The values at each vertex so far, to find those that are equal.
        let mut at_vertex: Vec<Vec<u32>> = vec![Vec::new(); mesh.positions().len()];
        let equal = EQUAL * self.range();
        let mut workspace = Workspace::default();
        for corner in 0..corners {
            let sector = sectors.find(corner);
            let v = target.from(corner as u32) as usize;
            if number[sector] == NONE {
                let value = self.at(target.positions[v], &target, widest[sector], &mut workspace);
                let near = |i: &u32| {
                    let other = found.values[*i as usize];
                    (0..N).all(|j| (other[j] - value[j]).abs() <= equal)
                };
                number[sector] = at_vertex[v].iter().copied().find(near).unwrap_or_else(|| {
                    found.values.push(value);
                    at_vertex[v].push(found.values.len() as u32 - 1);
                    found.values.len() as u32 - 1
                });
            }
            found.corners[corner / 3][corner % 3] = number[sector];
        }
        Ok(found)
    }

    /// One value for each vertex of a mesh near this surface: that of the nearest point; for values without seams.
    ///
    /// # Errors
    /// As [`Carrier::carry`].
    pub fn at_vertices(&self, mesh: &TriMesh) -> Result<Vec<[f64; N]>, CarryError> {
        let carried = self.carry(mesh, &[])?;
        let mut values = vec![[0.0; N]; mesh.positions().len()];
        for (v, value) in mesh.faces().as_flattened().iter().zip(carried.corners.as_flattened()) {
            values[*v as usize] = carried.values[*value as usize];
        }
        Ok(values)
    }

    /// The face of this surface nearest to the middle of each face of a mesh.
    pub fn faces_below(&self, mesh: &TriMesh) -> Vec<u32> {
        let mut workspace = Workspace::default();
        let middle = |face: &[u32; 3]| {
            let [a, b, c] = face.map(|v| DVec3::from_array(self.frame.map(mesh.positions()[v as usize])));
            (a + b + c) / 3.0
        };
        mesh.faces().iter().map(|face| self.nearest_face(middle(face), &mut workspace)).collect()
    }

    fn nearest_face(&self, p: DVec3, workspace: &mut Workspace) -> u32 {
        let nearest = self.bvh.nearest(p.to_array(), self.bvh.any_slot(), workspace);
        self.bvh.face(nearest.slot).0
    }

    /// Largest difference of a component.
    fn range(&self) -> f64 {
        let of = |i: usize| {
            let (low, high) =
                self.values.values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
                    (if x[i] < low { x[i] } else { low }, if x[i] > high { x[i] } else { high })
                });
            high - low
        };
        (0..N).map(of).fold(0.0, |a, b| if b > a { b } else { a })
    }

    /// The value at a vertex, on the side of a face of its mesh.
    fn at(&self, p: DVec3, target: &DynamicMesh, face: u32, workspace: &mut Workspace) -> [f64; N] {
        let [a, b, c] = target.corners(face).map(|v| target.positions[v as usize]);
        let start = self.nearest_face((a + b + c) / 3.0, workspace);
        let nearest = self.walk(p, start);
        let weights = closest_barycentric(p.to_array(), self.triangle(nearest));
        let corners = self.values.corners[nearest as usize].map(|i| self.values.values[i as usize]);
        std::array::from_fn(|i| (0..3).map(|k| weights[k] * corners[k][i]).sum())
    }

    fn triangle(&self, f: u32) -> [[f64; 3]; 3] {
        self.surface.corners(f).map(|v| self.surface.positions[v as usize].to_array())
    }

    /// The face nearest to a point among those that are reached from a face without crossing a seam, nearest ones first.
    fn walk(&self, p: DVec3, start: u32) -> u32 {
        let distance = |f: u32| {
            let [a, b, c] = self.triangle(f);
            distance_sq(p.to_array(), a, b, c)
        };
        let mut best = (distance(start), start);
        let mut open = BinaryHeap::from([Reverse((best.0.to_bits(), start))]);
        let mut seen = HashSet::from([start]);
        let mut in_vain = 0;
        while let Some(Reverse((bits, f))) = open.pop() {
            let here = f64::from_bits(bits);
            if here < best.0 {
                best = (here, f);
                in_vain = 0;
            } else {
                in_vain += 1;
            }
            if in_vain > PATIENCE || best.0 == 0.0 {
                break;
            }
            for h in 3 * f..3 * f + 3 {
                if let Some(t) = self.surface.twin_of(h).filter(|_| !self.jumps[h as usize])
                    && seen.insert(t / 3)
                {
                    open.push(Reverse((distance(t / 3).to_bits(), t / 3)));
                }
            }
        }
        best.1
    }
}

fn in_frame(mesh: &TriMesh, frame: &Frame) -> Result<DynamicMesh, ConnectivityError> {
    let mut surface = DynamicMesh::new(mesh.positions(), mesh.faces())?;
    surface.map_positions(|p| frame.map(p));
    Ok(surface)
}

/// The corners of each vertex, grouped where no edge that is kept lies between them.
fn sectors(mesh: &DynamicMesh, kept: &[[VertexId; 2]]) -> UnionFind {
    let kept: HashSet<[u32; 2]> = kept.iter().map(|[u, v]| [u.0.min(v.0), u.0.max(v.0)]).collect();
    let mut sectors = UnionFind::new(3 * mesh.face_count());
    for h in mesh.edges() {
        let [u, v] = [mesh.from(h), mesh.to(h)];
        if let Some(t) = mesh.twin_of(h)
            && !kept.contains(&[u.min(v), u.max(v)])
        {
            sectors.union(h as usize, next(t) as usize);
            sectors.union(next(h) as usize, t as usize);
        }
    }
    sectors
}

/// The largest face of each sector.
fn widest_faces(mesh: &DynamicMesh, sectors: &mut UnionFind) -> Vec<u32> {
    let corners = 3 * mesh.face_count();
    let mut widest = vec![(-1.0, 0); corners];
    for corner in 0..corners {
        let [a, b, c] = mesh.corners(corner as u32 / 3).map(|v| mesh.positions[v as usize]);
        let area = (b - a).cross(c - a).length_squared();
        let of_sector = &mut widest[sectors.find(corner)];
        if area > of_sector.0 {
            *of_sector = (area, corner as u32 / 3);
        }
    }
    widest.into_iter().map(|(_, f)| f).collect()
}
