//! Cubic splines over any hexahedral mesh, with one function per vertex.

use crate::{BezierMesh, Faces, HexMesh, Refinement, VolumeError, place_of_64};
use glam::DVec3;
use rayon::prelude::*;
use std::collections::HashMap;

/// The splines of `NeuronTransportIGA`: one function per vertex of a hexahedral mesh, a tricubic Bézier polynomial in each cell.
///
/// # Definition
/// A Bézier point inside a cell is the mean of the cell's corners with the weights ⅔ and ⅓ along each axis. One on a face, an edge
/// or a corner is the mean of the adjacent points inside all cells around it; on the boundary, of the adjacent points on the
/// boundary's faces alone.
/// # Accuracy
/// Nonnegative, partition of unity. Twice continuously differentiable where the mesh is a regular grid. The order of approximation
/// is only 2.5 in L² and 1.5 in H¹, because the second normal derivative is forced to zero at the boundary, and because of
/// extraordinary edges. [`SplineSpace`](crate::SplineSpace) has the orders 4 and 3.
/// # Source
/// `wei_blended_2018`; the variant without sharp features.
#[derive(Clone, Debug, PartialEq)]
pub struct UnstructuredSplines {
    cells: Vec<CellSplines>,
}

/// The functions that do not vanish in a cell.
#[derive(Clone, Debug, PartialEq)]
pub struct CellSplines {
    /// The vertices of the functions: the corners of the cell, then those of the cells around it in order.
    pub functions: Vec<u32>,
    /// Where the cell lies in the mesh.
    pub kind: CellKind,
    /// For each function its 64 Bézier coefficients, the first axis fastest.
    pub coefficients: Vec<[f64; 64]>,
}

/// Where a cell lies in a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CellKind {
    /// In a regular grid, inside.
    Regular,
    /// With a vertex on the boundary.
    Boundary,
    /// With a vertex on an inner edge that does not have four cells.
    Irregular,
}

impl CellKind {
    /// The number that files use: 0, 1 or 2.
    pub fn number(self) -> u8 {
        match self {
            Self::Regular => 0,
            Self::Boundary => 1,
            Self::Irregular => 2,
        }
    }

    /// The kind with this number.
    pub fn from_number(number: u8) -> Option<Self> {
        [Self::Regular, Self::Boundary, Self::Irregular].into_iter().find(|kind| kind.number() == number)
    }
}

/// Cells and boundary faces around vertices, and extraordinary edges.
struct Around<'m> {
    cells: &'m [[u32; 8]],
    /// The cells of each vertex.
    of_vertex: Vec<Vec<u32>>,
    /// The faces of the boundary at each vertex.
    boundary: Vec<Vec<[u32; 4]>>,
    /// Whether a vertex lies on an inner edge that does not have four cells.
    is_extraordinary: Vec<bool>,
}

/// The end corners of the edges of a cell.
const EDGES: [[usize; 2]; 12] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 5], [2, 6], [3, 7], [4, 5], [5, 6], [6, 7], [7, 4]];

impl<'m> Around<'m> {
    fn new(mesh: &'m HexMesh, faces: &Faces) -> Self {
        let cells = mesh.cells();
        let count = mesh.positions().len();
        let (mut of_vertex, mut boundary) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        let mut edges: HashMap<[u32; 2], u32> = HashMap::new();
        let sorted = |a: u32, b: u32| [a.min(b), a.max(b)];
        for (index, cell) in cells.iter().enumerate() {
            for &v in cell {
                of_vertex[v as usize].push(index as u32);
            }
            for [a, b] in EDGES {
                *edges.entry(sorted(cell[a], cell[b])).or_default() += 1;
            }
        }
        for face in faces.boundary() {
            for k in 0..4 {
                boundary[face.vertices[k] as usize].push(face.vertices);
                edges.remove(&sorted(face.vertices[k], face.vertices[(k + 1) % 4]));
            }
        }
        let mut is_extraordinary = vec![false; count];
        let mut list: Vec<_> = edges.into_iter().filter(|(_, cells)| *cells != 4).collect();
        list.sort_unstable();
        for (edge, _) in list {
            for &v in &edge {
                is_extraordinary[v as usize] = true;
            }
        }
        Self { cells, of_vertex, boundary, is_extraordinary }
    }

    fn kind(&self, cell: &[u32; 8]) -> CellKind {
        if cell.iter().any(|&v| !self.boundary[v as usize].is_empty()) {
            CellKind::Boundary
        } else if cell.iter().any(|&v| self.is_extraordinary[v as usize]) {
            CellKind::Irregular
        } else {
            CellKind::Regular
        }
    }

    /// The functions of a cell: its corners, then the vertices of the cells around it, corner by corner.
    fn functions(&self, cell: &[u32; 8]) -> Vec<u32> {
        let mut functions = cell.to_vec();
        for &v in cell {
            for &other in &self.of_vertex[v as usize] {
                for &vertex in &self.cells[other as usize] {
                    if !functions.contains(&vertex) {
                        functions.push(vertex);
                    }
                }
            }
        }
        functions
    }

    /// Adds up the Bézier coefficients at one control point for the functions of a cell.
    fn add(&self, cell: &[u32; 8], place: usize, mut add: impl FnMut(u32, f64)) {
        let at = place_of_64(place);
        // The nearest corner, and the vertices of the face, edge or corner that holds the control point.
        let corner = crate::CORNER_PLACES.iter().position(|p| (0..3).all(|k| (at[k] >= 2) == (p[k] == 1)));
        let near = cell[corner.unwrap_or(0)];
        let lies = |vertex: usize| {
            let p = crate::CORNER_PLACES[vertex];
            (0..3).all(|k| !at[k].is_multiple_of(3) || (at[k] == 3) == (p[k] == 1))
        };
        let on: Vec<u32> = (0..8).filter(|&k| lies(k)).map(|k| cell[k]).collect();
        let of_boundary: Vec<&[u32; 4]> =
            self.boundary[near as usize].iter().filter(|face| on.iter().all(|v| face.contains(v))).collect();
        if on.len() < 8 && !of_boundary.is_empty() {
            let share = 1.0 / of_boundary.len() as f64;
            for face in of_boundary {
                let at = face.iter().position(|v| *v == near).unwrap_or(0);
                for (k, weight) in [4.0 / 9.0, 2.0 / 9.0, 1.0 / 9.0, 2.0 / 9.0].into_iter().enumerate() {
                    add(face[(at + k) % 4], weight * share);
                }
            }
            return;
        }
        let around: Vec<&[u32; 8]> = self.of_vertex[near as usize]
            .iter()
            .map(|&other| &self.cells[other as usize])
            .filter(|other| on.iter().all(|v| other.contains(v)))
            .collect();
        let share = 1.0 / around.len() as f64;
        for other in around {
            let at = other.iter().position(|v| *v == near).unwrap_or(0);
            for (k, &vertex) in other.iter().enumerate() {
                let steps =
                    (0..3).filter(|&a| crate::CORNER_PLACES[k][a] != crate::CORNER_PLACES[at][a]).count();
                add(vertex, share * [8.0, 4.0, 2.0, 1.0][steps] / 27.0);
            }
        }
    }
}

impl UnstructuredSplines {
    /// The splines over a conforming mesh.
    pub fn new(mesh: &HexMesh, faces: &Faces) -> Self {
        let around = Around::new(mesh, faces);
        let of = |cell: &[u32; 8]| {
            let functions = around.functions(cell);
            let number: HashMap<u32, usize> = functions.iter().enumerate().map(|(k, &v)| (v, k)).collect();
            let mut coefficients = vec![[0.0; 64]; functions.len()];
            for place in 0..64 {
                around.add(cell, place, |vertex, weight| coefficients[number[&vertex]][place] += weight);
            }
            CellSplines { functions, kind: around.kind(cell), coefficients }
        };
        Self { cells: mesh.cells().par_iter().map(of).collect() }
    }

    /// Splines read from files.
    pub(crate) fn from_cells(cells: Vec<CellSplines>) -> Self {
        Self { cells }
    }

    /// The functions of each cell.
    pub fn cells(&self) -> &[CellSplines] {
        &self.cells
    }

    /// The Bézier points of each cell, for these positions of vertices.
    ///
    /// # Panics
    /// If a function has no position.
    pub fn bezier_points(&self, places: &[DVec3]) -> Vec<[DVec3; 64]> {
        let of = |cell: &CellSplines| {
            let mut points = [DVec3::ZERO; 64];
            for (&function, coefficients) in cell.functions.iter().zip(&cell.coefficients) {
                for (point, weight) in points.iter_mut().zip(coefficients) {
                    *point += places[function as usize] * *weight;
                }
            }
            points
        };
        self.cells.par_iter().map(of).collect()
    }

    /// The mesh of tricubic cells whose control points are the Bézier points of a mesh.
    ///
    /// # Errors
    /// Those of [`BezierMesh::new`].
    pub fn bezier_mesh(&self, mesh: &HexMesh) -> Result<BezierMesh, VolumeError> {
        let mut refinement = Refinement::new(3);
        let mut points: Vec<DVec3> = Vec::new();
        let mut cells = Vec::with_capacity(self.cells.len());
        for (cell, control) in mesh.cells().iter().zip(self.bezier_points(mesh.positions())) {
            let lattice = refinement.lattice(*cell);
            points.resize(refinement.keys().len(), DVec3::ZERO);
            for (&number, point) in lattice.iter().zip(control) {
                points[number as usize] = point;
            }
            cells.push(std::array::from_fn(|k| lattice[k]));
        }
        BezierMesh::new(points, cells)
    }

    /// The greatest deviation from one of the sum of all functions' coefficients, over all cells and control points.
    pub fn partition_of_unity_error(&self) -> f64 {
        let of = |cell: &CellSplines| {
            let off = |place: usize| (cell.coefficients.iter().map(|c| c[place]).sum::<f64>() - 1.0).abs();
            (0..64).map(off).fold(0.0, f64::max)
        };
        self.cells.iter().map(of).fold(0.0, f64::max)
    }

    /// The greatest difference of a coefficient from that of other splines over the same mesh; `None` if a cell has other
    /// functions.
    pub fn difference(&self, other: &Self) -> Option<f64> {
        if self.cells.len() != other.cells.len() {
            return None;
        }
        let mut most = 0.0_f64;
        for (a, b) in self.cells.iter().zip(&other.cells) {
            if a.functions != b.functions || a.kind != b.kind {
                return None;
            }
            for (x, y) in a.coefficients.iter().flatten().zip(b.coefficients.iter().flatten()) {
                most = most.max((x - y).abs());
            }
        }
        Some(most)
    }
}
