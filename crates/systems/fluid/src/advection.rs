//! Advection of the vorticity and of the harmonic coefficients, in Galerkin's weak form.

use crate::space::Space;
use crate::transport::{Departures, Passage};
use crate::{FluidError, Integrator};
use pompeiu_core::FaceId;
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_operators::FaceField;
use pompeiu_surface::plane::{cross, dot};

/// The advected unknowns.
///
/// The vorticity is stored as its integrals against hat functions, `M ω`: their rates need no solve.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Unknowns {
    pub(crate) integrals: VertexData<f64>,
    pub(crate) harmonic: Vec<f64>,
}

impl Unknowns {
    /// `self + s · other`.
    fn plus(&self, s: f64, other: &Self) -> Self {
        let mut sum = self.clone();
        sum.add(s, other);
        sum
    }

    fn add(&mut self, s: f64, other: &Self) {
        for (a, b) in self.integrals.iter_mut().zip(&other.integrals) {
            *a += s * b;
        }
        for (a, b) in self.harmonic.iter_mut().zip(&other.harmonic) {
            *a += s * b;
        }
    }
}

/// The fields of unknowns.
#[derive(Clone, Debug)]
pub(crate) struct Fields {
    pub(crate) vorticity: VertexData<f64>,
    pub(crate) stream: VertexData<f64>,
    pub(crate) velocity: FaceField,
}

impl Fields {
    /// The stream function and the velocity of a vorticity. A stored vorticity gives the same bits again.
    pub(crate) fn of_vorticity(
        space: &Space<'_>,
        vorticity: VertexData<f64>,
        harmonic: &[f64],
    ) -> Result<Self, FluidError> {
        let stream = space.stream(&vorticity)?;
        let velocity = space.velocity(&stream, harmonic);
        Ok(Self { vorticity, stream, velocity })
    }

    /// The two solves do not depend on each other.
    fn of(space: &Space<'_>, unknowns: &Unknowns) -> Result<Self, FluidError> {
        let (vorticity, stream) = rayon::join(
            || {
                let mut vorticity = unknowns.integrals.clone();
                space.solve_mass(&mut vorticity).map(|()| vorticity)
            },
            || space.stream_of_integrals(unknowns.integrals.clone()),
        );
        let (vorticity, stream) = (vorticity?, stream?);
        let velocity = space.velocity(&stream, &unknowns.harmonic);
        Ok(Self { vorticity, stream, velocity })
    }
}

/// The rates of change of the unknowns by advection.
///
/// # Definition
/// `M ω' = G_vᵀ (A u ω̄)` and `c_k' = −Σ A ω̄ (J u)·h_k`, sums over faces of area A, with ω̄ the mean of the corners plus the
/// rotation of the surface; the outflow through the boundary is subtracted. Without such a flow and with exact solves, the energy,
/// the enstrophy and the sum of M ω do not change.
pub(crate) fn rates(
    space: &Space<'_>,
    Fields { vorticity, velocity, .. }: &Fields,
    coriolis: Option<&FaceData<f64>>,
) -> Unknowns {
    let mesh = space.mesh();
    let mut integrals = VertexData::filled(mesh.vertices(), 0.0);
    for (face, &u) in velocity.entries() {
        let corners = mesh.face(face);
        let mean = mean_on(space, vorticity, coriolis, face);
        let sides = space.surface.sides(face);
        // A u · ∇φ = ½ s × u, with s the side opposite to the vertex of the hat function φ.
        for (i, v) in corners.into_iter().enumerate() {
            integrals[v] += 0.5 * mean * cross(sides[(i + 1) % 3], u);
        }
    }
    leave(space, vorticity, coriolis, &mut integrals);
    Unknowns { integrals, harmonic: harmonic_rates(space, vorticity, velocity, coriolis) }
}

/// The rates of change of the harmonic coefficients.
pub(crate) fn harmonic_rates(
    space: &Space<'_>,
    vorticity: &VertexData<f64>,
    velocity: &FaceField,
    coriolis: Option<&FaceData<f64>>,
) -> Vec<f64> {
    let fields = space.basis.fields();
    let mut harmonic = vec![0.0; fields.len()];
    if fields.is_empty() {
        return harmonic;
    }
    for (face, &u) in velocity.entries() {
        let weighted = mean_on(space, vorticity, coriolis, face) * space.surface.face_area(face);
        for (rate, field) in harmonic.iter_mut().zip(fields) {
            *rate += dot(crate::space::to_the_right(weighted, u), field[face]);
        }
    }
    harmonic
}

/// The mean of the vorticity at the corners of a face, plus the rotation of the surface.
fn mean_on(
    space: &Space<'_>,
    vorticity: &VertexData<f64>,
    coriolis: Option<&FaceData<f64>>,
    face: FaceId,
) -> f64 {
    let [a, b, c] = space.mesh().face(face).map(|v| vorticity[v]);
    (a + b + c) / 3.0 + coriolis.map_or(0.0, |f| f[face])
}

/// Subtracts the vorticity that leaves through the boundary, `∮ φ ω u·n`. Inflow carries no vorticity except that of the rotation
/// of the surface.
fn leave(
    space: &Space<'_>,
    vorticity: &VertexData<f64>,
    coriolis: Option<&FaceData<f64>>,
    rate: &mut VertexData<f64>,
) {
    let Some(inflow) = &space.inflow else { return };
    let mesh = space.mesh();
    for (edge, &into) in inflow.through_edges().entries().filter(|(_, into)| **into != 0.0) {
        let [v, w] = mesh.ends(edge);
        let own = if into < 0.0 { 1.0 } else { 0.0 };
        let rotation = coriolis.map_or(0.0, |f| f[mesh.edge_halfedge(edge).face()]);
        rate[v] += into * (own * (vorticity[v] / 3.0 + vorticity[w] / 6.0) + 0.5 * rotation);
        rate[w] += into * (own * (vorticity[w] / 3.0 + vorticity[v] / 6.0) + 0.5 * rotation);
    }
}

/// Largest stable Courant number of dual cells for a substep.
pub(crate) fn substep_cfl(integrator: Integrator) -> f64 {
    match integrator {
        Integrator::RungeKutta => 1.0,
        // Not for stability: fixed-point iterations converge well up to here.
        Integrator::ImplicitMidpoint => 0.5,
    }
}

/// What advection results in.
pub(crate) struct Advected {
    pub(crate) harmonic: Vec<f64>,
    pub(crate) fields: Fields,
    pub(crate) substeps: usize,
    /// Where the vorticity comes from, where it was traced back.
    pub(crate) passage: Option<Passage<Departures>>,
}

/// The harmonic coefficients and the fields after some time, computed in substeps, from those at the start.
pub(crate) fn advect(
    space: &Space<'_>,
    (harmonic, mut fields): (Vec<f64>, Fields),
    coriolis: Option<&FaceData<f64>>,
    integrator: Integrator,
    time: f64,
    substeps: usize,
) -> Result<(Vec<f64>, Fields), AdvectionError> {
    let step = time / substeps as f64;
    let mut unknowns = Unknowns { integrals: space.integrated(&fields.vorticity), harmonic };
    for _ in 0..substeps {
        unknowns = match integrator {
            Integrator::RungeKutta => runge_kutta(space, &unknowns, &fields, coriolis, step)?,
            Integrator::ImplicitMidpoint => midpoint(space, &unknowns, coriolis, step, MOST_HALVINGS)?,
        };
        let mut vorticity = unknowns.integrals.clone();
        space.solve_mass(&mut vorticity)?;
        fields = Fields::of_vorticity(space, vorticity, &unknowns.harmonic)?;
    }
    Ok((unknowns.harmonic, fields))
}

/// Why advection failed.
pub(crate) enum AdvectionError {
    /// The implicit midpoint rule did not converge; the residual.
    Midpoint(f64),
    Other(FluidError),
}

impl From<FluidError> for AdvectionError {
    fn from(error: FluidError) -> Self {
        Self::Other(error)
    }
}

fn runge_kutta(
    space: &Space<'_>,
    at: &Unknowns,
    fields: &Fields,
    coriolis: Option<&FaceData<f64>>,
    step: f64,
) -> Result<Unknowns, FluidError> {
    let rates_at = |at: &Unknowns| Ok::<_, FluidError>(rates(space, &Fields::of(space, at)?, coriolis));
    let k1 = rates(space, fields, coriolis);
    let k2 = rates_at(&at.plus(0.5 * step, &k1))?;
    let k3 = rates_at(&at.plus(0.5 * step, &k2))?;
    let k4 = rates_at(&at.plus(step, &k3))?;
    let mut after = at.plus(step / 6.0, &k1);
    after.add(step / 3.0, &k2);
    after.add(step / 3.0, &k3);
    after.add(step / 6.0, &k4);
    Ok(after)
}

/// Largest number of fixed-point iterations of a substep.
const MOST_ITERATIONS: usize = 80;

/// How often a substep is halved if its iterations do not converge.
const MOST_HALVINGS: usize = 4;

/// Converged to rounding: the change of an iteration relative to the change of the substep.
const CONVERGED: f64 = 1e-15;

/// Accepted change if rounding stops the convergence earlier.
const ACCEPTED: f64 = 1e-12;

/// `x' = x + Δt F((x + x') / 2)`, by fixed-point iterations for the midpoint.
fn midpoint(
    space: &Space<'_>,
    at: &Unknowns,
    coriolis: Option<&FaceData<f64>>,
    step: f64,
    halvings: usize,
) -> Result<Unknowns, AdvectionError> {
    let size = size(space, at);
    let mut middle = at.clone();
    let mut last = f64::INFINITY;
    for _ in 0..MOST_ITERATIONS {
        let next = at.plus(0.5 * step, &rates(space, &Fields::of(space, &middle)?, coriolis));
        let change = self::size(space, &next.plus(-1.0, &middle));
        let settled = change <= CONVERGED * size || (change <= ACCEPTED * size && change >= 0.5 * last);
        middle = next;
        if settled {
            // x' = 2 z − x, with z the midpoint.
            let mut after = middle.plus(1.0, &middle);
            after.add(-1.0, at);
            return Ok(after);
        }
        if !change.is_finite() {
            break;
        }
        last = change;
    }
    if halvings == 0 {
        return Err(AdvectionError::Midpoint(last / size));
    }
    let half = midpoint(space, at, coriolis, 0.5 * step, halvings - 1)?;
    midpoint(space, &half, coriolis, 0.5 * step, halvings - 1)
}

/// A norm of the unknowns: vorticity by area, harmonic coefficients by a length of one edge.
fn size(space: &Space<'_>, unknowns: &Unknowns) -> f64 {
    let vorticity: f64 = unknowns.integrals.iter().zip(&space.areas).map(|(w, area)| w * w / area).sum();
    let harmonic: f64 = unknowns.harmonic.iter().map(|c| c * c).sum();
    (vorticity + harmonic / (space.edge_length * space.edge_length)).sqrt()
}
