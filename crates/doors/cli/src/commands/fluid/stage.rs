//! Where a fluid flows: on a surface, or in the square.

use anyhow::Context;
use pompeiu::core::TriMesh;
use pompeiu::fluid::show::{FluidFrame, Streaks};
use pompeiu::fluid::square::Square;
use pompeiu::fluid::{FluidError, FluidStep, FluidTiming, SchemeReport, Simulation};
use pompeiu::io::{Attributes, write_with};
use pompeiu::surface::EmbeddedSurface;
use std::path::Path;

/// A simulation with what shows it.
pub(super) enum Stage<'s> {
    Surface { fluid: Box<Simulation<'s>>, surface: &'s EmbeddedSurface, streaks: Box<Streaks<'s>> },
    Square(Box<Square>),
}

impl Stage<'_> {
    pub(super) fn step(&mut self) -> Result<FluidStep, FluidError> {
        match self {
            Self::Surface { fluid, .. } => fluid.step(),
            Self::Square(square) => square.step(),
        }
    }

    pub(super) fn measure(&self) -> Result<FluidStep, FluidError> {
        match self {
            Self::Surface { fluid, .. } => fluid.measure(),
            Self::Square(square) => square.measure(),
        }
    }

    pub(super) fn time(&self) -> f64 {
        match self {
            Self::Surface { fluid, .. } => fluid.state().time,
            Self::Square(square) => square.time(),
        }
    }

    pub(super) fn timing(&self) -> FluidTiming {
        match self {
            Self::Surface { fluid, .. } => fluid.timing(),
            Self::Square(square) => square.timing(),
        }
    }

    pub(super) fn scheme(&self) -> SchemeReport {
        match self {
            Self::Surface { fluid, .. } => fluid.scheme(),
            Self::Square(square) => square.scheme(),
        }
    }

    pub(super) fn frame(&self) -> FluidFrame {
        match self {
            Self::Surface { fluid, streaks, .. } => FluidFrame::new(fluid.state(), streaks),
            Self::Square(square) => FluidFrame::of_square(square),
        }
    }

    /// Writes the flow as it is.
    pub(super) fn write(&self, path: &Path, mesh: &TriMesh) -> anyhow::Result<()> {
        let (attributes, densities): (_, Vec<Vec<f64>>) = match self {
            Self::Surface { fluid, surface, .. } => {
                let state = fluid.state();
                let velocity = state.velocity.entries().map(|(face, &u)| surface.to_space(face, u)).collect();
                let attributes = Attributes::for_mesh(mesh)
                    .with_vertex_scalar("vorticity", state.vorticity.to_vec())?
                    .with_vertex_scalar("stream_function", state.stream.to_vec())?
                    .with_face_vector("velocity", velocity)?;
                (attributes, state.densities.iter().map(|values| values.to_vec()).collect())
            }
            Self::Square(square) => {
                let [u, v] = [0, 1].map(|k| square.velocity().iter().map(|u| u[k]).collect());
                let attributes = Attributes::for_mesh(mesh)
                    .with_vertex_scalar("vorticity", square.vorticity())?
                    .with_vertex_scalar("velocity_along_x", u)?
                    .with_vertex_scalar("velocity_along_y", v)?;
                (attributes, square.densities().to_vec())
            }
        };
        let mut attributes = attributes;
        for (name, values) in self.scheme().densities.iter().zip(densities) {
            let named = attributes.with_vertex_scalar(name, values);
            attributes = named.with_context(|| format!("density \"{name}\""))?;
        }
        Ok(write_with(path, mesh, &attributes)?)
    }
}
