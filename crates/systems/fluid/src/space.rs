//! Divergence-free velocities: stream functions at vertices and harmonic fields.

use crate::FluidError;
use crate::inflow::Inflow;
use crate::transport::Cells;
use pompeiu_core::FaceId;
use pompeiu_core::mesh::VertexData;
use pompeiu_operators::hodge::{DirichletPotential, conforming_system};
use pompeiu_operators::{
    FaceField, HarmonicBasis, add_scaled, crouzeix_raviart_divergence, curl, field_norm, mass_matrix,
};
use pompeiu_solve::{Cholesky, LinearSolver, SemidefiniteCholesky, SparseMatrix};
use pompeiu_surface::plane::{Vec2, add, dot, quarter_turn, scale};
use pompeiu_surface::{Surface, SurfaceMesh};
use rayon::prelude::*;

/// A surface with its factored systems.
///
/// # Definition
/// A velocity is `u = u_0 + J G_v ψ + Σ c_k h_k`: `u_0` is the flow through the boundary without vorticity; ψ is linear on faces
/// and zero at boundary vertices; `h_k` are the harmonic fields of the dual splitting, orthonormal and tangential at the boundary.
/// The flow across an edge is equal on both sides of it. The vorticity ω, linear on faces, satisfies `M ω = −L ψ` at inner
/// vertices, with M the consistent mass matrix and L the cotangent Laplacian.
#[derive(Debug)]
pub(crate) struct Space<'s> {
    pub(crate) surface: &'s Surface,
    pub(crate) poisson: SemidefiniteCholesky,
    mass: Cholesky,
    pub(crate) areas: VertexData<f64>,
    pub(crate) basis: HarmonicBasis,
    pub(crate) edge_length: f64,
    /// The flow through the boundary.
    pub(crate) inflow: Option<Inflow>,
    /// The two dual cells at each edge; then those at the boundary with flow through it, with the outside as last cell.
    ends: Vec<[u32; 2]>,
    cell_areas: Vec<f64>,
}

/// The parts of a velocity.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Parts {
    pub(crate) stream: VertexData<f64>,
    pub(crate) harmonic: Vec<f64>,
}

impl<'s> Space<'s> {
    pub(crate) fn new(
        surface: &'s Surface,
        inflow: Option<&pompeiu_surface::EdgeData<f64>>,
    ) -> Result<Self, FluidError> {
        let (poisson, mass) = rayon::join(
            || conforming_system(surface, true),
            || Ok::<_, FluidError>(Cholesky::new(&mass_matrix(surface)?)?),
        );
        let (poisson, mass) = (poisson?, mass?);
        let basis = HarmonicBasis::primal(surface, DirichletPotential::Conforming, &poisson)?.turned();
        let lengths = surface.edge_lengths();
        let edge_length = lengths.iter().sum::<f64>() / lengths.len() as f64;
        let mut ends: Vec<[u32; 2]> =
            surface.mesh().edge_ids().map(|edge| surface.mesh().ends(edge).map(|v| v.0)).collect();
        let areas = surface.vertex_areas();
        let mut cell_areas = areas.to_vec();
        let inflow = inflow.map(|inflow| Inflow::new(surface, inflow)).transpose()?;
        if let Some(inflow) = &inflow {
            ends.extend(inflow.at_vertices().iter().map(|&(v, _)| [v.0, areas.len() as u32]));
            // So large that the outside value never changes.
            cell_areas.push(f64::MAX);
        }
        Ok(Self { surface, poisson, mass, areas, basis, edge_length, inflow, ends, cell_areas })
    }

    pub(crate) fn mesh(&self) -> &'s SurfaceMesh {
        self.surface.mesh()
    }

    /// The dual cells of the vertices with the flows between them.
    pub(crate) fn cells(&self, velocity: &FaceField) -> Cells<'_> {
        let through = self.inflow.as_ref().map_or(&[][..], Inflow::at_vertices);
        Cells::dual(self.surface, &self.ends, &self.cell_areas, velocity, through)
    }

    /// Transports values at vertices with the flows between dual cells; inflow carries nothing.
    pub(crate) fn carry(&self, cells: &Cells<'_>, values: &mut VertexData<f64>, time: f64) {
        let mut held = values.to_vec();
        held.resize(self.cell_areas.len(), 0.0);
        cells.carry(&mut held, time);
        values.iter_mut().zip(held).for_each(|(x, held)| *x = held);
    }

    /// A system with the kernel and the boundary conditions of the Laplacian.
    pub(crate) fn system(&self, matrix: SparseMatrix) -> Result<SemidefiniteCholesky, FluidError> {
        let mesh = self.mesh();
        let open: Vec<bool> = mesh.boundary_loops_of_components().into_iter().map(|n| n > 0).collect();
        let fixed: Vec<bool> = mesh.vertex_ids().map(|v| mesh.is_boundary_vertex(v)).collect();
        let group: Vec<Option<u32>> = mesh
            .vertex_ids()
            .map(|v| mesh.component(v))
            .map(|component| (!open[component]).then_some(component as u32))
            .collect();
        Ok(SemidefiniteCholesky::new(matrix, &fixed, &group)?)
    }

    /// `M ω`: integrals of the vorticity against hat functions.
    pub(crate) fn integrated(&self, vorticity: &VertexData<f64>) -> VertexData<f64> {
        let mesh = self.mesh();
        let mut sums = VertexData::filled(mesh.vertices(), 0.0);
        for face in mesh.face_ids() {
            let twelfth = self.surface.face_area(face) / 12.0;
            let corners = mesh.face(face);
            let values = corners.map(|v| vorticity[v]);
            let sum = values[0] + values[1] + values[2];
            for (v, value) in corners.into_iter().zip(values) {
                sums[v] += twelfth * (sum + value);
            }
        }
        sums
    }

    /// Multiplies integrals against hat functions by `M⁻¹`.
    pub(crate) fn solve_mass(&self, integrals: &mut VertexData<f64>) -> Result<(), FluidError> {
        Ok(self.mass.solve_in_place(integrals)?)
    }

    /// The stream function of a vorticity.
    pub(crate) fn stream(&self, vorticity: &VertexData<f64>) -> Result<VertexData<f64>, FluidError> {
        self.stream_of_integrals(self.integrated(vorticity))
    }

    /// The stream function of the integrals of a vorticity against hat functions.
    pub(crate) fn stream_of_integrals(
        &self,
        mut stream: VertexData<f64>,
    ) -> Result<VertexData<f64>, FluidError> {
        stream.iter_mut().for_each(|value| *value = -*value);
        self.poisson.solve_in_place(&mut stream)?;
        Ok(stream)
    }

    /// `J G_v ψ` on a face, of values at its corners.
    pub(crate) fn rotated_gradient(&self, face: FaceId, [a, b, c]: [f64; 3]) -> Vec2 {
        let sides = self.surface.sides(face);
        // J J s = −s: the gradient of a hat function is J s / (2 A) with s the side opposite to its vertex.
        let factor = -0.5 / self.surface.face_area(face);
        let (p, q) = (b - a, c - a);
        [0, 1].map(|i| factor * (p * sides[2][i] + q * sides[0][i]))
    }

    /// The velocity of a stream function and harmonic coefficients.
    pub(crate) fn velocity(&self, stream: &VertexData<f64>, harmonic: &[f64]) -> FaceField {
        let fields = self.basis.fields();
        let mut velocity = FaceField::filled(self.mesh().faces(), [0.0; 2]);
        velocity.as_mut_slice().par_iter_mut().with_min_len(4096).enumerate().for_each(|(f, u)| {
            let face = FaceId(f as u32);
            *u = self.rotated_gradient(face, self.mesh().face(face).map(|v| stream[v]));
            if let Some(inflow) = &self.inflow {
                *u = add(*u, inflow.field()[face]);
            }
            for (field, c) in fields.iter().zip(harmonic) {
                let h = field[face];
                u[0] += c * h[0];
                u[1] += c * h[1];
            }
        });
        velocity
    }

    /// The parts of the nearest divergence-free velocity.
    pub(crate) fn project(&self, field: &FaceField) -> Result<Parts, FluidError> {
        let mut stream = curl(self.surface, field)?;
        self.poisson.solve_in_place(&mut stream)?;
        Ok(Parts { stream, harmonic: self.basis.coefficients(self.surface, field)? })
    }

    /// The vorticity of a velocity given by its parts. `circulation` holds the integrals of the boundary's tangential velocity
    /// against hat functions.
    pub(crate) fn vorticity(
        &self,
        parts: &Parts,
        circulation: &VertexData<f64>,
    ) -> Result<VertexData<f64>, FluidError> {
        let mut integrals = self.weak_vorticity(parts);
        for (sum, wall) in integrals.iter_mut().zip(circulation) {
            *sum += wall;
        }
        self.solve_mass(&mut integrals)?;
        Ok(integrals)
    }

    /// `−(J G_v)ᵀ M u`: the vorticity integrated against hat functions, without the contribution of the velocity along the
    /// boundary.
    pub(crate) fn weak_vorticity(&self, parts: &Parts) -> VertexData<f64> {
        let mut sums = VertexData::filled(self.mesh().vertices(), 0.0);
        for (j, &value) in parts.stream.iter().enumerate() {
            for (i, entry) in self.poisson.matrix().column(j) {
                sums.as_mut_slice()[i] -= entry * value;
            }
        }
        let still = parts.harmonic.is_empty() && self.inflow.is_none();
        if !self.mesh().boundary_loops().is_empty() && !still {
            let mut field = self.basis.combination(self.mesh().faces(), &parts.harmonic);
            if let Some(inflow) = &self.inflow {
                add_scaled(&mut field, 1.0, inflow.field());
            }
            // At inner vertices such a field has no vorticity, except for rounding.
            if let Ok(curl) = curl(self.surface, &field) {
                for (v, value) in curl.entries().filter(|(v, _)| self.mesh().is_boundary_vertex(*v)) {
                    sums[v] -= value;
                }
            }
        }
        sums
    }

    /// The circulation along the boundary, `∮ φ u · t`, of a field on faces.
    pub(crate) fn boundary_circulation(&self, field: &FaceField) -> VertexData<f64> {
        self.along_boundary(|h| dot(field[h.face()], self.surface.vector(h)))
    }

    /// Adds half of a term of each boundary half-edge to both of its ends.
    pub(crate) fn along_boundary(
        &self,
        term: impl Fn(pompeiu_surface::HalfedgeId) -> f64,
    ) -> VertexData<f64> {
        let mesh = self.mesh();
        let mut sums = VertexData::filled(mesh.vertices(), 0.0);
        for &start in mesh.boundary_loops() {
            for h in mesh.boundary_loop(start) {
                let half = 0.5 * term(h);
                sums[mesh.tail(h)] += half;
                sums[mesh.head(h)] += half;
            }
        }
        sums
    }

    /// `½ ‖u‖²`.
    pub(crate) fn energy(&self, velocity: &FaceField) -> f64 {
        let sum: f64 = velocity.entries().map(|(face, &u)| self.surface.face_area(face) * dot(u, u)).sum();
        0.5 * sum
    }

    /// `½ ∫ ω²`, exact for functions linear on faces.
    pub(crate) fn enstrophy(&self, vorticity: &VertexData<f64>) -> f64 {
        let sum: f64 = self.integrated(vorticity).iter().zip(vorticity).map(|(m, w)| m * w).sum();
        0.5 * sum
    }

    /// The imbalance of flow at edges relative to the velocity: `(Σ d_e²)^½ / ‖u‖`, dimensionless.
    pub(crate) fn divergence(&self, velocity: &FaceField) -> Result<f64, FluidError> {
        let norm = field_norm(self.surface, velocity);
        let mut flow = crouzeix_raviart_divergence(self.surface, velocity)?;
        if let Some(inflow) = &self.inflow {
            flow.iter_mut().zip(inflow.through_edges()).for_each(|(d, through)| *d -= through);
        }
        let sum: f64 = flow.iter().map(|d| d * d).sum();
        Ok(if norm > 0.0 { sum.sqrt() / norm } else { 0.0 })
    }

    /// The rates of change that a force causes: of the integrated vorticity and of the harmonic coefficients.
    pub(crate) fn curl_of_force(&self, force: &FaceField) -> Result<(VertexData<f64>, Vec<f64>), FluidError> {
        let mut rate = curl(self.surface, force)?;
        let along = self.boundary_circulation(force);
        for (rate, along) in rate.iter_mut().zip(&along) {
            *rate = along - *rate;
        }
        Ok((rate, self.basis.coefficients(self.surface, force)?))
    }
}

/// `−a J u`: an acceleration to the right of the velocity.
pub(crate) fn to_the_right(a: f64, u: Vec2) -> Vec2 {
    scale(-a, quarter_turn(u))
}
