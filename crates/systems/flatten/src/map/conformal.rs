//! Free-boundary maps that minimise angle distortion, without a guarantee against flips.

use super::energy::gradients;
use crate::FlattenError;
use pompeiu_core::VertexId;
use pompeiu_solve::{
    Analysis, Cholesky, ElementPattern, FIXED, LinearSolver, Ordering, SolveError, SparseMatrix,
};
use pompeiu_surface::plane::Vec2;
use pompeiu_surface::{EmbeddedSurface, Surface};

/// Which minimiser of the conformal energy is chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Conformal {
    /// Two boundary vertices, the farthest from each other in space, are fixed.
    LeastSquares,
    /// No vertex is fixed: the eigenvector of the least eigenvalue, with the mass of the boundary.
    #[default]
    Spectral,
}

/// Regularisation of the diagonal for the spectral map, relative to its mean, because translations do not change the energy.
const SHIFT: f64 = 1e-9;

/// Largest number of inverse iterations, and the change of the eigenvector at which they converge.
const ITERATIONS: usize = 200;
const SETTLED: f64 = 1e-10;

/// The map of least conformal energy, scaled to the area of the surface.
///
/// # Definition
/// The energy is half the integral of the squared distance of the derivative from the similarities.
///
/// # Source
/// `levy_least_2002`, `mullen_spectral_2008`.
pub(crate) fn conformal(surface: &EmbeddedSurface, kind: Conformal) -> Result<Vec<Vec2>, FlattenError> {
    let mesh = surface.mesh();
    let boundary: Vec<VertexId> =
        mesh.boundary_loops().iter().flat_map(|&h| mesh.boundary_loop(h)).map(|h| mesh.tail(h)).collect();
    let points: Vec<[f64; 3]> = boundary.iter().map(|&v| surface.positions()[v]).collect();
    let pair = crate::cut::farthest_pair(&points).unwrap_or([0, 0]);
    let held = pair.map(|i| boundary[i]);
    let mut uv = least_squares(surface.surface(), held)?;
    if kind == Conformal::Spectral {
        uv = spectral(surface.surface(), &boundary, uv)?;
    }
    scale_to_area(surface.surface(), &mut uv);
    Ok(uv)
}

/// The energy matrix of one face, for the six coordinates of its corners.
fn element(surface: &Surface, face: pompeiu_core::FaceId) -> [[f64; 6]; 6] {
    let area = surface.face_area(face);
    let g = gradients(surface.corners(face));
    let mut rows = [[0.0; 6]; 2];
    for i in 0..3 {
        (rows[0][2 * i], rows[0][2 * i + 1]) = (g[i][0], -g[i][1]);
        (rows[1][2 * i], rows[1][2 * i + 1]) = (g[i][1], g[i][0]);
    }
    let mut matrix = [[0.0; 6]; 6];
    for i in 0..6 {
        for j in 0..6 {
            matrix[i][j] = area * (rows[0][i] * rows[0][j] + rows[1][i] * rows[1][j]);
        }
    }
    matrix
}

/// The matrix of the energy, for the given numbering of unknowns.
fn energy(
    surface: &Surface,
    unknowns: &[u32],
    count: usize,
    diagonal: &[f64],
) -> Result<SparseMatrix, SolveError> {
    let mesh = surface.mesh();
    let elements: Vec<[u32; 6]> = mesh
        .face_ids()
        .map(|face| {
            let [a, b, c] = mesh.face(face).map(VertexId::index);
            [2 * a, 2 * a + 1, 2 * b, 2 * b + 1, 2 * c, 2 * c + 1].map(|k| unknowns[k])
        })
        .collect();
    let faces: Vec<_> = mesh.face_ids().collect();
    ElementPattern::new(count, &elements)?.assemble(diagonal, |m| element(surface, faces[m]))
}

fn factor(matrix: &SparseMatrix) -> Result<Cholesky, SolveError> {
    Cholesky::with(&Analysis::new(matrix, &Ordering::MinimumDegree)?, matrix)
}

fn least_squares(surface: &Surface, held: [VertexId; 2]) -> Result<Vec<Vec2>, FlattenError> {
    let mesh = surface.mesh();
    let mut uv = vec![[0.0; 2]; mesh.vertices()];
    uv[held[1].index()] = [1.0, 0.0];
    let mut unknowns = Vec::with_capacity(2 * mesh.vertices());
    let mut count = 0;
    for v in mesh.vertex_ids() {
        for _ in 0..2 {
            if held.contains(&v) {
                unknowns.push(FIXED);
            } else {
                unknowns.push(count);
                count += 1;
            }
        }
    }
    let matrix = energy(surface, &unknowns, count as usize, &vec![0.0; count as usize])?;
    let mut right = vec![0.0; count as usize];
    for face in mesh.face_ids() {
        let corners = mesh.face(face);
        if !corners.iter().any(|v| held.contains(v)) {
            continue;
        }
        let local = element(surface, face);
        for i in 0..6 {
            let row = unknowns[2 * corners[i / 2].index() + i % 2];
            if row == FIXED {
                continue;
            }
            for j in 0..6 {
                if unknowns[2 * corners[j / 2].index() + j % 2] == FIXED {
                    right[row as usize] -= local[i][j] * uv[corners[j / 2].index()][j % 2];
                }
            }
        }
    }
    factor(&matrix)?.solve_in_place(&mut right)?;
    for (k, &unknown) in unknowns.iter().enumerate() {
        if unknown != FIXED {
            uv[k / 2][k % 2] = right[unknown as usize];
        }
    }
    Ok(uv)
}

fn spectral(surface: &Surface, boundary: &[VertexId], start: Vec<Vec2>) -> Result<Vec<Vec2>, FlattenError> {
    let n = surface.mesh().vertices();
    let unknowns: Vec<u32> = (0..2 * n as u32).collect();
    let plain = energy(surface, &unknowns, 2 * n, &vec![0.0; 2 * n])?;
    let mean = plain.diagonal_entries().iter().sum::<f64>() / (2 * n) as f64;
    let shifted = energy(surface, &unknowns, 2 * n, &vec![SHIFT * mean; 2 * n])?;
    let factor = factor(&shifted)?;
    // The boundary part of a vector, without its mean; zero inside.
    let mass = |z: &[f64]| -> Vec<f64> {
        let mut out = vec![0.0; 2 * n];
        for k in 0..2 {
            let mean = boundary.iter().map(|v| z[2 * v.index() + k]).sum::<f64>() / boundary.len() as f64;
            for v in boundary {
                out[2 * v.index() + k] = z[2 * v.index() + k] - mean;
            }
        }
        out
    };
    let norm = |z: &[f64]| z.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut z: Vec<f64> = start.into_iter().flatten().collect();
    let mut b = mass(&z);
    let size = norm(&b);
    for x in &mut b {
        *x /= size;
    }
    for _ in 0..ITERATIONS {
        let mut next = b.clone();
        factor.solve_in_place(&mut next)?;
        let mut c = mass(&next);
        let size = norm(&c);
        if !(size.is_finite() && size > 0.0) {
            break;
        }
        for x in &mut c {
            *x /= size;
        }
        z = next;
        let change = c.iter().zip(&b).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt();
        b = c;
        if change < SETTLED {
            break;
        }
    }
    Ok(z.chunks_exact(2).map(|p| [p[0], p[1]]).collect())
}

/// Scales a map to the area of the surface, with signed areas of faces.
fn scale_to_area(surface: &Surface, uv: &mut [Vec2]) {
    let mesh = surface.mesh();
    let flat: f64 = mesh
        .face_ids()
        .map(|face| {
            let [a, b, c] = mesh.face(face).map(|v| uv[v.index()]);
            0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        })
        .sum();
    let factor = (surface.area() / flat).sqrt();
    if factor.is_finite() && factor > 0.0 {
        for p in uv {
            *p = [factor * p[0], factor * p[1]];
        }
    }
}
