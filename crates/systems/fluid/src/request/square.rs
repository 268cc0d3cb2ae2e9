//! From a request to a simulation in the square.

use super::scene::{Axis, Ball};
use super::surface::{Amounts, amounts, darkness, distance_sq, expressed, within};
use super::{FluidRequest, FluidRequestError};
use crate::square::{Square, SquareDensity, SquareOptions};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::shapes::{Diagonal, grid};
use std::path::Path;

/// Cells on a side at most: what a page and the systems of larger squares need no machine has.
const MOST_CELLS: usize = 4096;

/// The unit square.
const UNIT: Aabb = Aabb { lower: [0.0; 3], upper: [1.0; 3] };

impl FluidRequest {
    /// The square as a mesh, with a vertex at the centre of each cell; none where the flow is on a surface.
    ///
    /// # Errors
    /// [`FluidRequestError::Cells`].
    pub fn cells(&self) -> Result<Option<TriMesh>, FluidRequestError> {
        let Some(cells) = self.square else { return Ok(None) };
        if !(2..=MOST_CELLS).contains(&cells) {
            return Err(FluidRequestError::Cells { cells, most: MOST_CELLS });
        }
        let (sides, width) = (cells as u32 - 1, 1.0 - 1.0 / cells as f64);
        let (mut positions, faces) = grid([width; 2], [sides; 2], Diagonal::Alternating)?.into_parts();
        for position in &mut positions {
            position[0] += 0.5;
            position[1] += 0.5;
        }
        Ok(Some(TriMesh::new(positions, faces)?))
    }

    /// The simulation in the square of so many cells, with its initial velocity.
    pub(super) fn in_square(&self, cells: usize, mesh: &TriMesh) -> Result<Square, FluidRequestError> {
        self.refuse_surface()?;
        let mut square = Square::new(self.square_options(cells, mesh)?)?;
        if let Some(source) = &self.velocity {
            let text = source.to_string();
            let Some((u, v)) = text.split_once(';') else {
                return Err(FluidRequestError::TwoExpressions(text));
            };
            let (u, v) = (expressed("velocity", u, mesh)?, expressed("velocity", v, mesh)?);
            square.set_velocity(&u.into_iter().zip(v).map(|(u, v)| [u, v]).collect::<Vec<_>>())?;
        } else if !self.vortex.is_empty() {
            square.set_velocity(&self.around_vortices(mesh)?)?;
        }
        Ok(square)
    }

    fn refuse_surface(&self) -> Result<(), FluidRequestError> {
        let default = Self::default();
        let given = [
            ("scheme", self.scheme != default.scheme),
            ("integrator", self.integrator != default.integrator),
            ("correction", self.correction != default.correction),
            ("diffusion", self.diffusion != default.diffusion),
            ("cfl", self.cfl.is_some()),
            ("viscosity_model", self.viscosity_model != default.viscosity_model),
            ("transport", self.transport != default.transport),
            ("rotation", self.rotation.is_some()),
            ("confinement", self.confinement != default.confinement),
            ("vorticity", self.vorticity.is_some()),
            ("harmonic", !self.harmonic.is_empty()),
            ("moving_wall", !self.moving_wall.is_empty()),
            ("inflow", !self.inflow.is_empty()),
            ("outflow", !self.outflow.is_empty()),
        ];
        match given.into_iter().find(|(_, is_given)| *is_given) {
            Some((name, _)) => Err(FluidRequestError::ForSurface(name)),
            None => Ok(()),
        }
    }

    fn square_options(&self, cells: usize, mesh: &TriMesh) -> Result<SquareOptions, FluidRequestError> {
        let dt = self.length_of_step()?;
        let count = cells * cells;
        let densities = self.density.iter().map(|density| {
            let Amounts { initial, source } = amounts(density, mesh, &UNIT)?;
            let (name, diffusivity, weight) = (density.name.clone(), density.diffusivity, density.weight);
            Ok(SquareDensity { name, initial, diffusivity, weight, source })
        });
        let mut force = self.acceleration.map(|[x, y, _]| vec![[x, y]; count]);
        for local in &self.force {
            let force = force.get_or_insert_with(|| vec![[0.0; 2]; count]);
            for (f, inside) in force.iter_mut().zip(within(mesh, local.ball()?)) {
                if inside {
                    f[0] += local.acceleration[0];
                    f[1] += local.acceleration[1];
                }
            }
        }
        Ok(SquareOptions {
            scheme: self.grid,
            edges: self.edges,
            viscosity: self.viscosity,
            wall: self.wall,
            lid: self.lid,
            gravity: self.gravity.map_or([0.0; 2], |[x, y, _]| [x, y]),
            force,
            solid: self.obstacles.as_deref().map(|path| obstacles(path, mesh)).transpose()?,
            densities: densities.collect::<Result<_, FluidRequestError>>()?,
            ..SquareOptions::new(cells, dt)
        })
    }

    /// The velocity around Gaussians of vorticity in the plane.
    fn around_vortices(&self, mesh: &TriMesh) -> Result<Vec<[f64; 2]>, FluidRequestError> {
        let vortices: Vec<(Ball, f64)> = self
            .vortex
            .iter()
            .map(|one| Ok((one.ball()?, one.circulation)))
            .collect::<Result<_, FluidRequestError>>()?;
        let velocity = |p: &[f64; 3]| {
            let mut sum = [0.0; 2];
            for (Ball { at, radius }, circulation) in &vortices {
                let away = distance_sq(*p, *at);
                if away > 0.0 {
                    let factor = -(-0.5 * away / (radius * radius)).exp_m1() / (std::f64::consts::TAU * away);
                    sum[0] -= circulation * factor * (p[1] - at[1]);
                    sum[1] += circulation * factor * (p[0] - at[0]);
                }
            }
            sum
        };
        Ok(mesh.positions().iter().map(velocity).collect())
    }
}

/// Which cells are dark in a picture that is laid over the square.
fn obstacles(path: &Path, mesh: &TriMesh) -> Result<Vec<bool>, FluidRequestError> {
    /// What is darker than this is dark.
    const DARK: f64 = 0.5;
    let shares = darkness(path, Axis::Z, mesh, &UNIT)?;
    Ok(shares.into_iter().map(|share| share > DARK).collect())
}
