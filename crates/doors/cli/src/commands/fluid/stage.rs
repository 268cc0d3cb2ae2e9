//! Where a fluid flows: on a surface, or in the square.

use anyhow::{Context, anyhow};
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::{FaceData, VertexData};
use pompeiu::fluid::show::{FluidFrame, Streaks};
use pompeiu::fluid::square::{Square, SquareState};
use pompeiu::fluid::{FluidError, FluidStep, FluidTiming, SchemeReport, Simulation, State};
use pompeiu::io::{Attributes, write_with};
use pompeiu::surface::{EdgeData, EmbeddedSurface};
use std::collections::BTreeMap;
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

    /// Step, time and the arrays of the state by name.
    pub(super) fn save(&self) -> (usize, f64, BTreeMap<String, Vec<f64>>) {
        let mut arrays = BTreeMap::new();
        let mut put = |name: &str, values: Vec<f64>| {
            arrays.insert(name.to_owned(), values);
        };
        match self {
            Self::Surface { fluid, .. } => {
                let state = fluid.state();
                put("vorticity", state.vorticity.to_vec());
                put("harmonic", state.harmonic.clone());
                put("edge velocity", state.edge_velocity.iter().flatten().copied().collect());
                for (i, values) in state.densities.iter().enumerate() {
                    put(&format!("density {i}"), values.to_vec());
                }
                for (i, values) in state.face_densities.iter().enumerate() {
                    put(&format!("density {i} on faces"), values.to_vec());
                }
                (state.step, state.time, arrays)
            }
            Self::Square(square) => {
                let SquareState { step, time, velocity: [u, v], densities } = square.state();
                put("velocity along x", u);
                put("velocity along y", v);
                for (i, values) in densities.into_iter().enumerate() {
                    put(&format!("density {i}"), values);
                }
                (step, time, arrays)
            }
        }
    }

    /// Takes over what [`Stage::save`] gave.
    pub(super) fn restore(
        &mut self,
        step: usize,
        time: f64,
        arrays: &BTreeMap<String, Vec<f64>>,
    ) -> anyhow::Result<()> {
        let array = |name: &str| {
            arrays
                .get(name)
                .cloned()
                .ok_or_else(|| anyhow!("there is no array \"{name}\"; the file is damaged"))
        };
        match self {
            Self::Surface { fluid, .. } => {
                let mesh = fluid.surface().mesh();
                let (vertices, faces) = (mesh.vertices(), mesh.faces());
                let state = fluid.state();
                let edges = array("edge velocity")?;
                let densities = (0..state.densities.len())
                    .map(|i| Ok(VertexData::new(vertices, array(&format!("density {i}"))?)?));
                let face_densities = (0..state.face_densities.len())
                    .map(|i| Ok(FaceData::new(faces, array(&format!("density {i} on faces"))?)?));
                let state = State {
                    step,
                    time,
                    vorticity: VertexData::new(vertices, array("vorticity")?)?,
                    harmonic: array("harmonic")?,
                    densities: densities.collect::<anyhow::Result<_>>()?,
                    edge_velocity: EdgeData::new(
                        state.edge_velocity.len(),
                        edges.chunks_exact(2).map(|u| [u[0], u[1]]).collect(),
                    )?,
                    face_densities: face_densities.collect::<anyhow::Result<_>>()?,
                    ..state.clone()
                };
                Ok(fluid.set_state(&state)?)
            }
            Self::Square(square) => {
                let densities = (0..square.densities().len()).map(|i| array(&format!("density {i}")));
                let densities = densities.collect::<anyhow::Result<_>>()?;
                let velocity = [array("velocity along x")?, array("velocity along y")?];
                Ok(square.set_state(&SquareState { step, time, velocity, densities })?)
            }
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
