//! Meshes of tricubic Bézier cells.

use crate::bernstein::{GAUSS_5, derivatives, part, value};
use crate::{HexMesh, Refinement, VolumeError, key_weights};
use glam::DVec3;
use rayon::prelude::*;

/// Cells that are images of the unit cube under polynomials of degree three along each axis. Cells that share a face share its 16
/// control points, at the same places.
///
/// # Shapes and units
/// The control points of a cell are in lexicographic order, the first axis fastest; corners are where all indices are 0 or 3.
#[derive(Clone, Debug, PartialEq)]
pub struct BezierMesh {
    points: Vec<DVec3>,
    cells: Vec<[u32; 64]>,
}

/// The eight corners among the 64 control points, in the order of VTK.
pub const CORNERS_OF_64: [usize; 8] = [0, 3, 15, 12, 48, 51, 63, 60];

/// For each face of a cell, in the order of [`FACES`](crate::FACES), the fixed axis, its side, and the two axes along the face whose
/// cross product points outwards.
pub const FACE_AXES: [(usize, usize, [usize; 2]); 6] =
    [(2, 0, [1, 0]), (2, 1, [0, 1]), (1, 0, [0, 2]), (0, 1, [1, 2]), (1, 1, [2, 0]), (0, 0, [2, 1])];

impl BezierMesh {
    /// The mesh of these control points and cells.
    ///
    /// # Errors
    /// [`VolumeError::Index`], [`VolumeError::Repeated`] for corners, [`VolumeError::NotFinite`].
    pub fn new(points: Vec<DVec3>, cells: Vec<[u32; 64]>) -> Result<Self, VolumeError> {
        for (cell, list) in cells.iter().enumerate() {
            if let Some(&index) = list.iter().find(|&&index| index as usize >= points.len()) {
                return Err(VolumeError::Index { cell, index, vertices: points.len() });
            }
        }
        let mesh = Self { points, cells };
        mesh.corner_mesh()?;
        Ok(mesh)
    }

    /// The same cells as a trilinear mesh.
    pub fn from_trilinear(mesh: &HexMesh) -> Self {
        let mut refinement = Refinement::new(3);
        let cells = mesh
            .cells()
            .iter()
            .map(|&cell| {
                let lattice = refinement.lattice(cell);
                std::array::from_fn(|k| lattice[k])
            })
            .collect();
        let place = |key| key_weights(key).map(|(v, weight)| mesh.positions()[v] * weight).sum();
        Self { points: refinement.keys().iter().map(place).collect(), cells }
    }

    /// The control points.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// The control points of each cell.
    pub fn cells(&self) -> &[[u32; 64]] {
        &self.cells
    }

    /// The control points of a cell.
    ///
    /// # Panics
    /// If the cell is not one of this mesh.
    pub fn control(&self, cell: usize) -> [DVec3; 64] {
        self.cells[cell].map(|k| self.points[k as usize])
    }

    /// The trilinear mesh with the same corners. Its vertices are all control points, used or not.
    ///
    /// # Errors
    /// [`VolumeError::Repeated`], [`VolumeError::NotFinite`].
    pub fn corner_mesh(&self) -> Result<HexMesh, VolumeError> {
        HexMesh::new(
            self.points.clone(),
            self.cells.iter().map(|cell| CORNERS_OF_64.map(|k| cell[k])).collect(),
        )
    }

    /// Subdivides every cell into `parts` along each axis. The parts of a cell are consecutive, the first axis fastest.
    ///
    /// Other fields on the cells, with a coefficient for each control point, are subdivided in the same way.
    ///
    /// # Errors
    /// Those of [`BezierMesh::new`], where parts have no extent.
    pub fn subdivided(
        &self,
        parts: usize,
        fields: &[&[DVec3]],
    ) -> Result<(Self, Vec<Vec<DVec3>>), VolumeError> {
        let mut refinement = Refinement::new(3 * parts);
        let mut cells = Vec::with_capacity(self.cells.len() * parts.pow(3));
        let sources: Vec<&[DVec3]> =
            std::iter::once(self.points.as_slice()).chain(fields.iter().copied()).collect();
        let mut results: Vec<Vec<DVec3>> = vec![Vec::new(); sources.len()];
        let matrices: Vec<[[f64; 4]; 4]> =
            (0..parts).map(|k| part(k as f64 / parts as f64, (k + 1) as f64 / parts as f64)).collect();
        let side = 3 * parts + 1;
        for cell in &self.cells {
            let before = refinement.keys().len();
            let lattice = refinement.lattice(CORNERS_OF_64.map(|k| cell[k]));
            for result in &mut results {
                result.resize(refinement.keys().len(), DVec3::ZERO);
            }
            for c in 0..parts.pow(3) {
                let at = [c % parts, c / parts % parts, c / parts / parts];
                let index = |p: usize| {
                    let [i, j, k] = [p % 4, p / 4 % 4, p / 16];
                    lattice[3 * at[0] + i + side * (3 * at[1] + j + side * (3 * at[2] + k))]
                };
                let numbers: [u32; 64] = std::array::from_fn(index);
                for (source, result) in sources.iter().zip(&mut results) {
                    let control = cell.map(|k| source[k as usize]);
                    let cut = cut(&control, at.map(|k| &matrices[k]));
                    for (&number, point) in numbers.iter().zip(cut) {
                        // The value from the first cell stays, so that neighbours agree bit for bit.
                        if number as usize >= before {
                            result[number as usize] = point;
                        }
                    }
                }
                cells.push(numbers);
            }
        }
        let mut results = results.into_iter();
        let points = results.next().unwrap_or_default();
        Ok((Self::new(points, cells)?, results.collect()))
    }

    /// The volume of all cells: exact but for rounding.
    pub fn volume(&self) -> f64 {
        let volumes: Vec<f64> =
            (0..self.cells.len()).into_par_iter().map(|c| bezier_volume(&self.control(c))).collect();
        volumes.iter().sum()
    }
}

/// The coefficients over a part of the cell.
pub(crate) fn cut(points: &[DVec3; 64], matrices: [&[[f64; 4]; 4]; 3]) -> [DVec3; 64] {
    along_lines(points, |axis, line| {
        matrices[axis].map(|row| line[0] * row[0] + line[1] * row[1] + line[2] * row[2] + line[3] * row[3])
    })
}

/// Applies a function to the four coefficients on each line along an axis, axis by axis.
pub(crate) fn along_lines<T: Copy>(
    coefficients: &[T; 64],
    others: impl Fn(usize, [T; 4]) -> [T; 4],
) -> [T; 64] {
    let mut result = *coefficients;
    for (axis, [stride, p, q]) in [[1, 4, 16], [4, 1, 16], [16, 1, 4]].into_iter().enumerate() {
        for a in 0..4 {
            for b in 0..4 {
                let start = a * p + b * q;
                let line = others(axis, [0, 1, 2, 3].map(|k| result[start + k * stride]));
                for (k, value) in line.into_iter().enumerate() {
                    result[start + k * stride] = value;
                }
            }
        }
    }
    result
}

/// The signed volume of a cell. The determinant has degree eight along each axis; the rule is exact for degree nine.
pub fn bezier_volume(points: &[DVec3; 64]) -> f64 {
    let mut sum = 0.0;
    for (u, a) in GAUSS_5 {
        for (v, b) in GAUSS_5 {
            for (w, c) in GAUSS_5 {
                let [x, y, z] = derivatives(points, [u, v, w]);
                sum += a * b * c * x.dot(y.cross(z));
            }
        }
    }
    sum
}

/// The points of a face for the rule with five points along each axis: the parameters in the cell, and the outward area vector
/// times the weight.
pub fn face_points(points: &[DVec3; 64], face: usize) -> [([f64; 3], DVec3); 25] {
    let (_, side, along) = FACE_AXES[face];
    std::array::from_fn(|k| {
        let ((s, a), (t, b)) = (GAUSS_5[k % 5], GAUSS_5[k / 5]);
        let mut place = [side as f64; 3];
        (place[along[0]], place[along[1]]) = (s, t);
        let slopes = derivatives(points, place);
        (place, slopes[along[0]].cross(slopes[along[1]]) * (a * b))
    })
}

/// The flux of a field with these coefficients out of a cell through a face: exact but for rounding.
pub fn face_flux(points: &[DVec3; 64], field: &[DVec3; 64], face: usize) -> f64 {
    face_points(points, face).iter().map(|(place, area)| value(field, *place).dot(*area)).sum()
}

/// The indices of a control point along the three axes, that is its parameters in thirds.
pub fn place_of_64(k: usize) -> [usize; 3] {
    [k % 4, k / 4 % 4, k / 16]
}
