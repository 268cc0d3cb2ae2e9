//! Densities: sources, diffusion, transport.

use super::diffusion::Heat;
use super::velocity::mean;
use super::{MOST_SUBSTEPS, Simulation};
use crate::faces::FaceDiffusion;
use crate::space::Space;
use crate::transport::{Backtrace, Departures, Passage, restore_mass};
use crate::{FluidError, Transport};
use pompeiu_core::mesh::{FaceData, VertexData};
use pompeiu_operators::FaceField;
use pompeiu_solve::{Cholesky, LinearSolver, SparseMatrix};

impl Simulation<'_> {
    /// Sets a density from values at vertices.
    pub(super) fn take_density(&mut self, index: usize, values: VertexData<f64>) {
        if self.options.transport == Transport::Faces {
            self.state.face_densities[index] = corner_means(&self.space, &values);
        }
        self.state.densities[index] = values;
    }

    /// Prepares factors for a step of this length.
    pub(super) fn factor_densities(&mut self, step: f64) -> Result<(), FluidError> {
        let options = &self.options;
        for (density, heat) in options.densities.iter().zip(&mut self.heat) {
            let product = density.diffusivity * step;
            if product == 0.0 || heat.as_ref().is_some_and(|ready| ready.product() == product) {
                continue;
            }
            *heat = Some(if options.transport == Transport::Faces {
                Heat::Faces(FaceDiffusion::of_values(self.space.surface, options.diffusion, product)?)
            } else {
                let mass = SparseMatrix::diagonal(&self.space.areas)?;
                let matrix = mass.combined(1.0, self.space.poisson.matrix(), product)?;
                Heat::Vertices { product, factor: Cholesky::new(&matrix)? }
            });
        }
        Ok(())
    }

    /// Sources, diffusion and transport: where the vorticity was traced back, densities at vertices come from the same points;
    /// otherwise with the mean of two velocities.
    pub(super) fn move_densities(
        &mut self,
        before: &FaceField,
        traced: Option<Passage<Departures>>,
        step: f64,
    ) -> Result<(), FluidError> {
        if self.state.densities.is_empty() {
            return Ok(());
        }
        let velocity = mean(before, &self.state.velocity);
        if self.options.transport == Transport::Faces {
            return self.move_on_faces(&velocity, step);
        }
        let by_flux = self.options.transport == Transport::FluxCorrected;
        let cells = by_flux.then(|| self.space.cells(&velocity));
        let cfl = cells.as_ref().map_or(0.0, |cells| cells.cfl(step));
        if cfl > MOST_SUBSTEPS as f64 {
            let (number, most) = (self.state.step + 1, MOST_SUBSTEPS);
            return Err(FluidError::StepTooLong { step: number, length: step, cfl, substeps: cfl, most });
        }
        for (values, (density, heat)) in
            self.state.densities.iter_mut().zip(self.options.densities.iter().zip(&self.heat))
        {
            if let Some(source) = &density.source {
                add_source(values, source, step);
            }
            if let Some(Heat::Vertices { factor, .. }) = heat {
                values.iter_mut().zip(&self.space.areas).for_each(|(x, area)| *x *= area);
                factor.solve_in_place(values)?;
            }
        }
        if let Some(cells) = cells {
            self.state.densities.iter_mut().for_each(|values| self.space.carry(&cells, values, step));
        } else if let Some(backtrace) = &self.backtrace {
            let passage = traced.unwrap_or_else(|| {
                backtrace.passage(&backtrace.at_vertices(&velocity), step, self.options.correction)
            });
            self.state.densities = self.trace_back(backtrace, &passage);
        }
        Ok(())
    }

    /// The densities at vertices after semi-Lagrangian transport.
    fn trace_back(&self, backtrace: &Backtrace<'_>, passage: &Passage<Departures>) -> Vec<VertexData<f64>> {
        let areas = &self.space.areas;
        let carry = |values: &VertexData<f64>| {
            let mut carried = backtrace.carry(passage, values);
            if self.options.transport == Transport::SemiLagrangianCorrected {
                let mass = values.iter().zip(areas).map(|(x, a)| x * a).sum();
                restore_mass(areas, &mut carried, mass, |v| backtrace.range(&passage.from, values, v));
            }
            carried
        };
        self.state.densities.iter().map(carry).collect()
    }

    /// Sources, diffusion and transport of densities on faces; values at vertices are means of these.
    fn move_on_faces(&mut self, velocity: &FaceField, step: f64) -> Result<(), FluidError> {
        let Some(backtrace) = &self.backtrace else { return Ok(()) };
        let passage = backtrace.passage_of_centroids(velocity, step, self.options.correction);
        let options = self.options.densities.iter().zip(&self.heat);
        let densities = self.state.face_densities.iter_mut().zip(&mut self.state.densities);
        for ((values, at_vertices), (density, heat)) in densities.zip(options) {
            if let Some(source) = &density.source {
                add_source(values, &corner_means(&self.space, source), step);
            }
            if let Some(Heat::Faces(diffusion)) = heat {
                diffusion.values(self.space.surface, values)?;
            }
            *values = backtrace.carry_on_faces(&passage, values);
            *at_vertices = backtrace.vertex_means(values);
        }
        Ok(())
    }
}

/// Adds a source to values for a step.
pub(crate) fn add_source(values: &mut [f64], source: &[f64], step: f64) {
    for (x, rate) in values.iter_mut().zip(source) {
        let added = *x + step * rate;
        // A sink removes at most what is there.
        *x = if *rate < 0.0 && added < 0.0 { if *x < 0.0 { *x } else { 0.0 } } else { added };
    }
}

/// Values at vertices as means of the corners of faces.
fn corner_means(space: &Space<'_>, values: &VertexData<f64>) -> FaceData<f64> {
    let mesh = space.mesh();
    FaceData::from_fn(mesh.faces(), |face| mesh.face(face).into_iter().map(|v| values[v] / 3.0).sum())
}
