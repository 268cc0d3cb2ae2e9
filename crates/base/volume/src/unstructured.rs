//! Cubic splines over any hexahedral mesh, with one function per vertex.

use crate::{BezierMesh, CORNER_PLACES, Faces, HexMesh, Refinement, VolumeError};
use glam::DVec3;
use rayon::prelude::*;

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

impl CellSplines {
    /// The Bézier points of the cell, for these positions of functions.
    ///
    /// # Panics
    /// If a function has no position.
    pub fn bezier_points(&self, places: &[DVec3]) -> [DVec3; 64] {
        let mut points = [DVec3::ZERO; 64];
        for (&function, coefficients) in self.functions.iter().zip(&self.coefficients) {
            let position = places[function as usize];
            for k in nonzero(coefficients) {
                points[k] += position * coefficients[k];
            }
        }
        points
    }
}

/// The indices of the coefficients that are not zero: most are.
pub(crate) fn nonzero(coefficients: &[f64; 64]) -> impl Iterator<Item = usize> + use<> {
    let bits = coefficients.iter().rev().fold(0, |bits, x| bits << 1 | u64::from(x.to_bits() != 0));
    std::iter::successors(Some(bits), |bits| Some(bits & bits.wrapping_sub(1)))
        .take_while(|bits| *bits != 0)
        .map(|bits| bits.trailing_zeros() as usize)
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

/// Cells and boundary faces around vertices, and extraordinary edges: what the splines of one cell are computed from.
pub(crate) struct Around<'m> {
    cells: &'m [[u32; 8]],
    /// The cells of each vertex.
    of_vertex: Vec<Vec<u32>>,
    /// The faces of the boundary at each vertex.
    boundary: Vec<Vec<[u32; 4]>>,
    /// Whether a vertex lies on an inner edge that does not have four cells.
    is_extraordinary: Vec<bool>,
    /// For each corner of a cell the control points next to it.
    places: [[(usize, u8); 8]; 8],
}

/// The end corners of the edges of a cell.
const EDGES: [[usize; 2]; 12] =
    [[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [1, 5], [2, 6], [3, 7], [4, 5], [5, 6], [6, 7], [7, 4]];

/// The number of each vertex among the functions of one cell.
pub(crate) struct Numbers(Vec<u32>);

/// A vertex that is no function of the cell.
const NONE: u32 = u32::MAX;

/// A cell or a face of the boundary next to a corner of a cell.
struct Adjacent {
    /// The corners of the cell that it has, as bits.
    corners: u8,
    /// The functions of its vertices, and their weights at the point next to the corner.
    weights: [(u32, f64); 8],
    count: usize,
}

impl Adjacent {
    /// Of vertices with the weights of those so many edges away from the corner.
    fn new(vertices: &[u32], weight: impl Fn(usize) -> f64, numbers: &Numbers) -> Self {
        let mut found = Self { corners: 0, weights: [(0, 0.0); 8], count: vertices.len() };
        for (k, &vertex) in vertices.iter().enumerate() {
            let number = numbers.0[vertex as usize];
            // The functions of a cell begin with its corners.
            if number < 8 {
                found.corners |= 1 << number;
            }
            found.weights[k] = (number, weight(k));
        }
        found
    }

    fn cell(vertices: &[u32; 8], near: u32, numbers: &Numbers) -> Self {
        let at = CORNER_PLACES[vertices.iter().position(|v| *v == near).unwrap_or(0)];
        let steps = |k: usize| (0..3).filter(|&axis| CORNER_PLACES[k][axis] != at[axis]).count();
        Self::new(vertices, |k| [8.0, 4.0, 2.0, 1.0][steps(k)] / 27.0, numbers)
    }

    fn face(vertices: &[u32; 4], near: u32, numbers: &Numbers) -> Self {
        let at = vertices.iter().position(|v| *v == near).unwrap_or(0);
        Self::new(vertices, |k| [4.0, 2.0, 1.0, 2.0][(k + 4 - at) % 4] / 9.0, numbers)
    }
}

/// The control points next to a corner, each with the corners of the face, edge or corner that it lies on as bits; all eight inside.
fn places_near(corner: usize) -> [(usize, u8); 8] {
    let near = CORNER_PLACES[corner];
    std::array::from_fn(|bits| {
        // Along each axis on the side of the corner, or next to it.
        let at = [0, 1, 2].map(|axis| (if near[axis] == 1 { 3 } else { 0_usize }).abs_diff(bits >> axis & 1));
        let lies = |k: &usize| {
            (0..3)
                .all(|axis| !at[axis].is_multiple_of(3) || (at[axis] == 3) == (CORNER_PLACES[*k][axis] == 1))
        };
        let on = (0..8).filter(lies).fold(0, |on, k| on | 1 << k);
        (at[0] + 4 * (at[1] + 4 * at[2]), on)
    })
}

impl<'m> Around<'m> {
    pub(crate) fn new(mesh: &'m HexMesh, faces: &Faces) -> Self {
        let cells = mesh.cells();
        let count = mesh.positions().len();
        let (mut of_vertex, mut boundary) = (vec![Vec::new(); count], vec![Vec::new(); count]);
        let sorted = |a: u32, b: u32| [a.min(b), a.max(b)];
        let mut edges: Vec<[u32; 2]> = Vec::with_capacity(EDGES.len() * cells.len());
        for (index, cell) in cells.iter().enumerate() {
            for &v in cell {
                of_vertex[v as usize].push(index as u32);
            }
            edges.extend(EDGES.map(|[a, b]| sorted(cell[a], cell[b])));
        }
        let mut outer: Vec<[u32; 2]> = Vec::with_capacity(4 * faces.boundary().len());
        for face in faces.boundary() {
            for k in 0..4 {
                boundary[face.vertices[k] as usize].push(face.vertices);
                outer.push(sorted(face.vertices[k], face.vertices[(k + 1) % 4]));
            }
        }
        edges.par_sort_unstable();
        outer.par_sort_unstable();
        let mut is_extraordinary = vec![false; count];
        for run in edges.chunk_by(|a, b| a == b).filter(|run| run.len() != 4) {
            if outer.binary_search(&run[0]).is_err() {
                run[0].iter().for_each(|v| is_extraordinary[*v as usize] = true);
            }
        }
        let places = std::array::from_fn(places_near);
        Self { cells, of_vertex, boundary, is_extraordinary, places }
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

    /// What [`Around::splines_of`] needs, for one cell after another.
    pub(crate) fn numbers(&self) -> Numbers {
        Numbers(vec![NONE; self.of_vertex.len()])
    }

    /// The functions of a cell: its corners, then the vertices of the cells around it, corner by corner. They are numbered in this order.
    fn functions(&self, cell: &[u32; 8], numbers: &mut Numbers) -> Vec<u32> {
        let mut functions = Vec::with_capacity(64);
        let around = cell.iter().flat_map(|&v| &self.of_vertex[v as usize]);
        for &vertex in cell.iter().chain(around.flat_map(|&other| &self.cells[other as usize])) {
            let number = &mut numbers.0[vertex as usize];
            if *number == NONE {
                *number = functions.len() as u32;
                functions.push(vertex);
            }
        }
        functions
    }

    /// The functions of a cell and their coefficients. No vertex has a number before and after it.
    pub(crate) fn splines_of(&self, cell: usize, numbers: &mut Numbers) -> CellSplines {
        let cell = &self.cells[cell];
        let functions = self.functions(cell, numbers);
        let mut coefficients = vec![[0.0; 64]; functions.len()];
        for (&near, places) in cell.iter().zip(&self.places) {
            self.add(near, places, numbers, &mut coefficients);
        }
        for &v in &functions {
            numbers.0[v as usize] = NONE;
        }
        CellSplines { functions, kind: self.kind(cell), coefficients }
    }

    /// Adds up the coefficients at the control points next to a corner of a cell.
    fn add(&self, near: u32, places: &[(usize, u8); 8], numbers: &Numbers, coefficients: &mut [[f64; 64]]) {
        let cells = self.of_vertex[near as usize].iter();
        let cells: Vec<Adjacent> =
            cells.map(|&other| Adjacent::cell(&self.cells[other as usize], near, numbers)).collect();
        let faces = self.boundary[near as usize].iter();
        let faces: Vec<Adjacent> = faces.map(|face| Adjacent::face(face, near, numbers)).collect();
        for &(place, on) in places {
            let has = |adjacent: &&Adjacent| adjacent.corners & on == on;
            // A cell has all of its own corners, its faces do not.
            let around = if faces.iter().any(|face| has(&face)) { &faces } else { &cells };
            let share = 1.0 / around.iter().filter(has).count() as f64;
            for adjacent in around.iter().filter(has) {
                for (function, weight) in &adjacent.weights[..adjacent.count] {
                    coefficients[*function as usize][place] += share * weight;
                }
            }
        }
    }
}

impl UnstructuredSplines {
    /// The splines over a conforming mesh.
    pub fn new(mesh: &HexMesh, faces: &Faces) -> Self {
        let around = Around::new(mesh, faces);
        let cells = 0..mesh.cells().len();
        let of = |numbers: &mut Numbers, cell| around.splines_of(cell, numbers);
        Self { cells: cells.into_par_iter().map_init(|| around.numbers(), of).collect() }
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
        let of = |cell: &CellSplines| cell.bezier_points(places);
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
