//! As-rigid-as-possible maps: each face is rotated rigidly, and all are fitted together.

use super::energy::gradients;
use crate::FlattenError;
use crate::watch::Watch;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_solve::{Analysis, Cholesky, ElementPattern, FIXED, LinearSolver, Ordering};
use pompeiu_surface::Surface;
use pompeiu_surface::plane::Vec2;

/// Converged if the energy changes by less than this share.
const SETTLED: f64 = 1e-6;

/// Moves a map towards one whose derivatives are rotations, by alternating between the best rotation of each face and the best
/// positions for these rotations. Faces may flip.
///
/// # Definition
/// The integral of the squared distance of the derivative from a rotation of each face.
///
/// # Source
/// `liu_local_2008`.
pub(crate) fn as_rigid_as_possible(
    surface: &Surface,
    start: &[Vec2],
    steps: usize,
    watch: &Watch<'_>,
) -> Result<(Vec<Vec2>, usize), FlattenError> {
    let mesh = surface.mesh();
    let faces: Vec<FaceId> = mesh.face_ids().collect();
    let gradient: Vec<[Vec2; 3]> = faces.iter().map(|&face| gradients(surface.corners(face))).collect();
    let corners: Vec<[usize; 3]> = faces.iter().map(|&face| mesh.face(face).map(VertexId::index)).collect();
    // The first vertex is fixed, because translations do not change the energy.
    let unknown = |v: usize| if v == 0 { FIXED } else { v as u32 - 1 };
    let n = mesh.vertices() - 1;
    let elements: Vec<[u32; 3]> = corners.iter().map(|face| face.map(unknown)).collect();
    let matrix = ElementPattern::new(n, &elements)?.assemble(&vec![0.0; n], |m| {
        let (g, area) = (&gradient[m], surface.face_area(faces[m]));
        [0, 1, 2].map(|i| [0, 1, 2].map(|j| area * (g[i][0] * g[j][0] + g[i][1] * g[j][1])))
    })?;
    let factor = Cholesky::with(&Analysis::new(&matrix, &Ordering::MinimumDegree)?, &matrix)?;
    let origin = start[0];
    let mut x: Vec<Vec2> = start.iter().map(|p| [p[0] - origin[0], p[1] - origin[1]]).collect();
    let mut last = f64::INFINITY;
    let mut taken = 0;
    while taken < steps && !watch.is_stopped() {
        let mut right = vec![0.0; 2 * n];
        let mut energy = 0.0;
        for (m, face) in corners.iter().enumerate() {
            let mut j = [[0.0; 2]; 2];
            for (&v, g) in face.iter().zip(&gradient[m]) {
                for r in 0..2 {
                    for c in 0..2 {
                        j[r][c] += x[v][r] * g[c];
                    }
                }
            }
            // The rotation nearest to the derivative is that of its similarity part.
            let (cosine, sine) = (j[0][0] + j[1][1], j[1][0] - j[0][1]);
            let size = cosine.hypot(sine);
            let [c, s] = if size > 0.0 { [cosine / size, sine / size] } else { [1.0, 0.0] };
            let area = surface.face_area(faces[m]);
            let off = [j[0][0] - c, j[0][1] + s, j[1][0] - s, j[1][1] - c];
            energy += area * off.iter().map(|x| x * x).sum::<f64>();
            for (&v, g) in face.iter().zip(&gradient[m]) {
                if v > 0 {
                    right[v - 1] += area * (c * g[0] - s * g[1]);
                    right[n + v - 1] += area * (s * g[0] + c * g[1]);
                }
            }
        }
        if last - energy <= SETTLED * energy {
            break;
        }
        last = energy;
        factor.solve_in_place(&mut right)?;
        for v in 0..n {
            x[v + 1] = [right[v], right[n + v]];
        }
        taken += 1;
    }
    Ok((x, taken))
}
