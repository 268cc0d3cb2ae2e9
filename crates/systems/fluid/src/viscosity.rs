//! Viscosity for a velocity given by its stream function and harmonic coefficients.

use crate::curvature::{CurvatureLimit, allowed_growth, bends, face_curvature};
use crate::space::{Parts, Space};
use crate::{FluidError, ViscosityModel, Wall};
use pompeiu_core::VertexId;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_operators::{FaceField, curl, field_inner_product};
use pompeiu_solve::{DenseCholesky, LinearSolver, SemidefiniteCholesky, SolveError, SparseMatrix};
use pompeiu_surface::SurfaceMesh;
use pompeiu_surface::plane::{dot, scale};

/// A backward Euler step for viscosity, factored for one product of viscosity and time.
///
/// # Definition
/// The viscous power of a velocity `u = J G_v ψ + Σ c_k h_k` is `∫ ω² − χ ∫ K |u|²`, with χ = 0, 1, 2 for the Hodge, Bochner and
/// physical viscosity, ω from lumped masses, and K on faces from angle defects. One step solves `(E + νΔt a) x' = E x + νΔt b`,
/// with E the matrix of twice the energy, a that of the viscous power and b the contribution of the boundary. The harmonic
/// coefficients border the system of the stream function.
///
/// The viscous power is made semidefinite by a [`CurvatureLimit`]. Where a step is so long that the growth which it allows cannot be
/// factored, shorter steps are taken, each followed by the limit on the energy.
///
/// At a no-slip boundary the vorticity is `(−L ψ + ∮ φ u_wall) / A`. At a free-slip boundary it is twice the curvature of the
/// boundary times the tangential velocity, with the curvature corrected by that of the adjacent surface.
#[derive(Debug)]
pub(crate) struct Viscosity {
    /// Viscosity times time.
    product: f64,
    /// How often the step is taken that is factored.
    repeats: usize,
    system: SemidefiniteCholesky,
    /// Columns of the border, νΔt X; empty without harmonic fields.
    border: Vec<Vec<f64>>,
    /// `S⁻¹` times these columns.
    solved: Vec<Vec<f64>>,
    /// The inverse of the Schur complement, row by row.
    complement: Vec<f64>,
    /// Contribution of the boundary to the stream function and to the harmonic coefficients.
    drive: (Vec<f64>, Vec<f64>),
}

/// The matrices of the viscous power, which do not depend on the step.
#[derive(Debug)]
pub(crate) struct ViscousPower {
    matrix: SparseMatrix,
    border: Vec<Vec<f64>>,
    corner: Vec<f64>,
    drive: (Vec<f64>, Vec<f64>),
    /// The curvature that it contains.
    limit: CurvatureLimit,
}

impl ViscousPower {
    pub(crate) fn new(
        space: &Space<'_>,
        model: ViscosityModel,
        wall: Wall,
        circulation: &VertexData<f64>,
    ) -> Result<Self, FluidError> {
        let limited = |limit| Self::limited(space, model, wall, circulation, limit);
        let is_closed = space.mesh().boundary_loops().is_empty();
        if model.curvatures() == 0.0 && (wall == Wall::NoSlip || is_closed) {
            return limited(CurvatureLimit::NONE);
        }
        let mesh = space.mesh();
        let component = |v: usize| mesh.component(VertexId(v as u32));
        let allowed = allowed_growth(space, space.poisson.matrix(), component)?;
        let is_semidefinite =
            |power: &Self| space.system(allowed.combined(1.0, &power.matrix, 1.0)?).map(|_| ());
        CurvatureLimit::find(limited, is_semidefinite).map(|(_, power)| power)
    }

    /// The curvature that it contains.
    pub(crate) fn limit(&self) -> CurvatureLimit {
        self.limit
    }

    fn limited(
        space: &Space<'_>,
        model: ViscosityModel,
        wall: Wall,
        circulation: &VertexData<f64>,
        limit: CurvatureLimit,
    ) -> Result<Self, FluidError> {
        let mut weights = weights(space, wall);
        weights.iter_mut().for_each(|w| *w = limit.of_wall(*w));
        let curvature = face_curvature(space.surface, &space.areas, limit);
        let laplacian = space.poisson.matrix();
        let matrix = power_matrix(space, laplacian, &weights, &curvature, model.curvatures())?;
        let fields = space.basis.fields();
        let (mut border, mut corner) = (Vec::new(), vec![0.0; fields.len() * fields.len()]);
        // Columns of P = (J G_v)ᵀ A h: zero at inner vertices.
        let at_boundary = |field: &FaceField| -> Result<VertexData<f64>, FluidError> {
            let mut column = curl(space.surface, field)?;
            for v in space.mesh().vertex_ids().filter(|&v| !space.mesh().is_boundary_vertex(v)) {
                column[v] = 0.0;
            }
            Ok(column)
        };
        let columns = fields.iter().map(at_boundary).collect::<Result<Vec<_>, _>>()?;
        let mut circulation = circulation.clone();
        let mut curved_inflow = None;
        if let Some(inflow) = &space.inflow {
            // A no-slip wall also applies to the flow through the boundary.
            let slipping = at_boundary(inflow.field())?;
            circulation.iter_mut().zip(&slipping).for_each(|(x, y)| *x -= y);
            let chi = model.curvatures();
            curved_inflow =
                Some(FaceField::from_fn(curvature.len(), |f| scale(chi * curvature[f], inflow.field()[f])));
        }
        let circulation = &circulation;
        let mut drive = (apply(laplacian, &weights, circulation), Vec::with_capacity(fields.len()));
        if let Some(curved) = &curved_inflow {
            let turned = curl(space.surface, curved)?;
            drive.0.iter_mut().zip(&turned).for_each(|(x, y)| *x += y);
        }
        for (k, field) in fields.iter().enumerate() {
            let curved = FaceField::from_fn(field.len(), |f| scale(curvature[f], field[f]));
            let turned = curl(space.surface, &curved)?;
            let mut column = apply(laplacian, &weights, &columns[k]);
            for (x, y) in column.iter_mut().zip(&turned) {
                *x -= model.curvatures() * y;
            }
            border.push(column);
            for (j, other) in fields.iter().enumerate() {
                let curved: f64 =
                    curved.entries().map(|(f, &u)| space.surface.face_area(f) * dot(u, other[f])).sum();
                let walls = product(&columns[k], &weights, &columns[j]);
                corner[k * fields.len() + j] = walls - model.curvatures() * curved;
            }
            let curved = curved_inflow
                .as_ref()
                .map_or(0.0, |curved| field_inner_product(space.surface, curved, field));
            drive.1.push(product(&columns[k], &weights, circulation) + curved);
        }
        Ok(Self { matrix, border, corner, drive, limit })
    }
}

impl Viscosity {
    /// Factors the system for a step.
    pub(crate) fn new(space: &Space<'_>, power: &ViscousPower, product: f64) -> Result<Self, FluidError> {
        let (step, repeats) = shortened(product, |product| Self::factored(space, power, product))?;
        Ok(Self { product, repeats, ..step })
    }

    fn factored(space: &Space<'_>, power: &ViscousPower, product: f64) -> Result<Self, FluidError> {
        let failed = |error: FluidError| match error {
            FluidError::Solve(SolveError::NotPositiveDefinite { .. }) => FluidError::Viscous { product },
            other => other,
        };
        let matrix = space.poisson.matrix().combined(1.0, &power.matrix, product)?;
        let system = space.system(matrix).map_err(failed)?;
        let scaled = |values: &[f64]| values.iter().map(|x| product * x).collect::<Vec<f64>>();
        let border: Vec<Vec<f64>> = power.border.iter().map(|column| scaled(column)).collect();
        let mut solved = border.clone();
        for column in &mut solved {
            system.solve_in_place(column)?;
        }
        let k = border.len();
        let mut complement = scaled(&power.corner);
        for i in 0..k {
            complement[i * k + i] += 1.0;
            for j in 0..k {
                complement[i * k + j] -= inner(&border[i], &solved[j]);
            }
        }
        let complement = inverse(k, complement).map_err(|error| failed(error.into()))?;
        let drive = (scaled(&power.drive.0), scaled(&power.drive.1));
        Ok(Self { product, repeats: 1, system, border, solved, complement, drive })
    }

    /// Viscosity times time.
    pub(crate) fn product(&self) -> f64 {
        self.product
    }

    /// The velocity after the step.
    pub(crate) fn step(&self, space: &Space<'_>, parts: &Parts) -> Result<Parts, FluidError> {
        let mut after = self.once(space, parts)?;
        for _ in 1..self.repeats {
            after = self.once(space, &after)?;
        }
        Ok(after)
    }

    fn once(&self, space: &Space<'_>, parts: &Parts) -> Result<Parts, FluidError> {
        let mut stream = space.poisson.matrix().multiply(&parts.stream);
        for (x, drive) in stream.iter_mut().zip(&self.drive.0) {
            *x += drive;
        }
        self.system.solve_in_place(&mut stream)?;
        let k = self.border.len();
        let rest: Vec<f64> =
            (0..k).map(|i| parts.harmonic[i] + self.drive.1[i] - inner(&self.border[i], &stream)).collect();
        let harmonic: Vec<f64> =
            (0..k).map(|i| (0..k).map(|j| self.complement[i * k + j] * rest[j]).sum()).collect();
        for (column, c) in self.solved.iter().zip(&harmonic) {
            for (x, y) in stream.iter_mut().zip(column) {
                *x -= c * y;
            }
        }
        let stream = VertexData::from_fn(stream.len(), |v: VertexId| stream[v.index()]);
        Ok(Parts { stream, harmonic })
    }
}

/// Quarters of a step that are tried where it cannot be factored.
const MOST_QUARTERS: i32 = 24;

/// The largest number of parts of a step that are taken. What decays is gone after these; what would grow is limited by the energy.
const MOST_REPEATS: usize = 16;

/// Factors a step of this product of viscosity and time, or, if it cannot be factored, one of its parts, with their number.
///
/// A velocity that grows at the rate δ is multiplied by `1 / (1 − product δ)`. A quarter of a part that can be factored
/// multiplies it by at most 4/3.
pub(crate) fn shortened<T>(
    product: f64,
    factored: impl Fn(f64) -> Result<T, FluidError>,
) -> Result<(T, usize), FluidError> {
    let part = |quarters| factored(product * 0.25_f64.powi(quarters));
    match part(0) {
        Err(FluidError::Viscous { .. }) => {}
        other => return other.map(|step| (step, 1)),
    }
    for quarters in 1..=MOST_QUARTERS {
        match part(quarters) {
            Err(FluidError::Viscous { .. }) => {}
            Err(error) => return Err(error),
            Ok(_) => return part(quarters + 1).map(|step| (step, MOST_REPEATS)),
        }
    }
    Err(FluidError::Viscous { product })
}

/// The factors from integrals to vorticity at each vertex: see [`Viscosity`].
fn weights(space: &Space<'_>, wall: Wall) -> VertexData<f64> {
    let mesh = space.mesh();
    let lumped = VertexData::from_fn(mesh.vertices(), |v| 1.0 / space.areas[v]);
    if wall == Wall::NoSlip || mesh.boundary_loops().is_empty() {
        return lumped;
    }
    let (bend, lengths) = bends(space);
    VertexData::from_fn(mesh.vertices(), |v| {
        if !mesh.is_boundary_vertex(v) {
            return lumped[v];
        }
        -2.0 * bend[v] / (lengths[v] * lengths[v] - 2.0 * bend[v] * space.areas[v])
    })
}

/// `L diag(w) L − χ G_vᵀ A K G_v`.
fn power_matrix(
    space: &Space<'_>,
    laplacian: &SparseMatrix,
    weights: &VertexData<f64>,
    curvature: &FaceData<f64>,
    curvatures: f64,
) -> Result<SparseMatrix, FluidError> {
    let n = laplacian.rows();
    let mut sums = vec![0.0; n];
    let mut touched: Vec<usize> = Vec::new();
    let mut seen = vec![false; n];
    let mut entries = Vec::with_capacity(20 * n);
    for j in 0..n {
        for (k, right) in laplacian.column(j) {
            let right = right * weights.as_slice()[k];
            for (i, left) in laplacian.column(k) {
                if !seen[i] {
                    seen[i] = true;
                    touched.push(i);
                }
                sums[i] += left * right;
            }
        }
        for i in touched.drain(..) {
            entries.push((i, j, sums[i]));
            sums[i] = 0.0;
            seen[i] = false;
        }
    }
    let square = SparseMatrix::from_triplets(n, n, &entries)?;
    drop(entries);
    if curvatures == 0.0 {
        return Ok(square);
    }
    let links: Vec<(u32, u32, f64)> = space
        .mesh()
        .face_ids()
        .flat_map(SurfaceMesh::face_halfedges)
        .map(|h| {
            let weight = 0.5 * curvature[h.face()] * space.surface.cotangent(h.previous());
            (space.mesh().tail(h).0, space.mesh().head(h).0, weight)
        })
        .collect();
    Ok(square.combined(1.0, &SparseMatrix::from_links(n, &links)?, -curvatures)?)
}

/// `L diag(w) x`.
fn apply(laplacian: &SparseMatrix, weights: &VertexData<f64>, x: &VertexData<f64>) -> Vec<f64> {
    let weighted: Vec<f64> = weights.iter().zip(x).map(|(w, x)| w * x).collect();
    laplacian.multiply(&weighted)
}

/// `xᵀ diag(w) y`.
fn product(x: &VertexData<f64>, weights: &VertexData<f64>, y: &VertexData<f64>) -> f64 {
    x.iter().zip(weights).zip(y).map(|((x, w), y)| x * w * y).sum()
}

fn inner(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

/// The inverse of a small symmetric positive definite matrix.
fn inverse(size: usize, matrix: Vec<f64>) -> Result<Vec<f64>, SolveError> {
    if size == 0 {
        return Ok(matrix);
    }
    let factor = DenseCholesky::new(size, matrix)?;
    let mut lower = vec![0.0; size * size];
    for i in 0..size {
        lower[i * size + i] = 1.0;
    }
    // Columns of the inverse of the lower factor; (L Lᵀ)⁻¹ is the matrix of their inner products.
    factor.solve_lower_in_place(&mut lower)?;
    let column = |i: usize| &lower[i * size..(i + 1) * size];
    Ok((0..size * size).map(|at| inner(column(at / size), column(at % size))).collect())
}
