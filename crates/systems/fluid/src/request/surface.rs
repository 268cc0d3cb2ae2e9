//! From a request to a simulation on a surface.

use super::scene::{Axis, Ball, DensityScene};
use super::{FluidRequest, FluidRequestError, StartReport};
use crate::{Density, FluidError, FluidOptions, Simulation, TimeStep, coriolis, tangential};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::VertexData;
use pompeiu_operators::{FaceField, field_norm, vertex_values};
use pompeiu_planar::picture::Picture;
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface};
use std::path::Path;

impl FluidRequest {
    /// The simulation with its initial velocity. `read` are the vectors of the file that the velocity names, if it names one.
    pub(super) fn on_surface<'s>(
        &self,
        mesh: &TriMesh,
        surface: &'s EmbeddedSurface,
        read: Option<&[[f64; 3]]>,
    ) -> Result<(Simulation<'s>, Option<StartReport>), FluidRequestError> {
        let mut fluid = Simulation::new(surface.surface(), self.options(mesh, surface)?)?;
        self.refuse_square()?;
        if let Some(source) = &self.velocity {
            let found = source.field(surface, fluid.harmonic_fields(), read)?;
            fluid.set_velocity(&found.field)?;
            let [kept, given] =
                [&fluid.state().velocity, &found.field].map(|u| field_norm(surface.surface(), u));
            let kept = if given > 0.0 { kept / given } else { 1.0 };
            let (is_tangent, normal_part) = (found.is_tangent, found.normal_part);
            let divergence = (1.0 - kept * kept).max(0.0);
            return Ok((fluid, Some(StartReport { is_tangent, normal_part, divergence })));
        }
        if self.vorticity.is_some() || !self.harmonic.is_empty() || !self.vortex.is_empty() {
            let vorticity = self.vorticity(mesh, surface)?;
            let mut harmonic = self.harmonic.clone();
            if harmonic.is_empty() {
                harmonic = vec![0.0; fluid.harmonic_fields().len()];
            }
            fluid.set_vorticity(&vorticity, &harmonic)?;
        }
        Ok((fluid, None))
    }

    fn refuse_square(&self) -> Result<(), FluidRequestError> {
        let default = Self::default();
        let given = [
            ("grid", self.grid != default.grid),
            ("edges", self.edges != default.edges),
            ("lid", self.lid != default.lid),
            ("obstacles", self.obstacles.is_some()),
        ];
        match given.into_iter().find(|(_, is_given)| *is_given) {
            Some((name, _)) => Err(FluidRequestError::ForSquare(name)),
            None => Ok(()),
        }
    }

    /// The options of a simulation on a surface.
    ///
    /// # Errors
    /// [`FluidRequestError`].
    pub fn options(
        &self,
        mesh: &TriMesh,
        surface: &EmbeddedSurface,
    ) -> Result<FluidOptions, FluidRequestError> {
        let dt = self.length_of_step()?;
        let around = Aabb::of_points(mesh.positions());
        let densities = self.density.iter().map(|density| {
            let Amounts { initial, source } = amounts(density, mesh, &around)?;
            let count = mesh.positions().len();
            let of_vertices = |values| {
                VertexData::new(count, values).map_err(|error| FluidError::Length {
                    what: "density",
                    element: "vertex",
                    found: error.found,
                    expected: error.expected,
                })
            };
            Ok(Density {
                name: density.name.clone(),
                initial: of_vertices(initial)?,
                diffusivity: density.diffusivity,
                weight: density.weight,
                source: source.map(of_vertices).transpose()?,
            })
        });
        Ok(FluidOptions {
            scheme: self.scheme,
            integrator: self.integrator,
            correction: self.correction,
            diffusion: self.diffusion,
            time_step: self.cfl.map_or(TimeStep::Fixed(dt), |number| TimeStep::Cfl { number, longest: dt }),
            viscosity: self.viscosity,
            viscosity_model: self.viscosity_model,
            wall: self.wall,
            wall_velocity: self.wall_velocity(surface)?,
            inflow: self.inflow(surface)?,
            gravity: self.gravity.map(|gravity| tangential(surface, gravity)),
            coriolis: self.rotation.map(|rotation| coriolis(surface, rotation)),
            force: self.force(surface)?,
            confinement: self.confinement,
            densities: densities.collect::<Result<_, FluidRequestError>>()?,
            transport: self.transport,
        })
    }

    /// The vorticity of an expression and of vortices.
    fn vorticity(
        &self,
        mesh: &TriMesh,
        surface: &EmbeddedSurface,
    ) -> Result<VertexData<f64>, FluidRequestError> {
        let mut sum = VertexData::filled(surface.mesh().vertices(), 0.0);
        if let Some(expression) = &self.vorticity {
            let values = expressed("vorticity", expression, mesh)?;
            sum.iter_mut().zip(values).for_each(|(w, value)| *w = value);
        }
        for vortex in &self.vortex {
            let Ball { at, radius } = vortex.ball()?;
            let peak = vortex.circulation / (std::f64::consts::TAU * radius * radius);
            for (w, p) in sum.iter_mut().zip(surface.positions()) {
                *w += peak * (-0.5 * distance_sq(*p, at) / (radius * radius)).exp();
            }
        }
        Ok(sum)
    }

    /// The constant acceleration.
    fn force(&self, surface: &EmbeddedSurface) -> Result<Option<FaceField>, FluidRequestError> {
        if self.acceleration.is_none() && self.force.is_empty() {
            return Ok(None);
        }
        let mut sum = tangential(surface, self.acceleration.unwrap_or([0.0; 3]));
        for local in &self.force {
            let ball = local.ball()?;
            let everywhere = tangential(surface, local.acceleration);
            let mut touched = false;
            for face in surface.mesh().face_ids() {
                if distance_sq(surface.centroid(face), ball.at) <= ball.radius.powi(2) {
                    touched = true;
                    for i in 0..2 {
                        sum[face][i] += everywhere[face][i];
                    }
                }
            }
            if !touched {
                return Err(nothing_in("force", "face", ball));
            }
        }
        Ok(Some(sum))
    }

    /// How fast each boundary edge moves along itself.
    fn wall_velocity(&self, surface: &EmbeddedSurface) -> Result<Option<EdgeData<f64>>, FluidRequestError> {
        if self.moving_wall.is_empty() {
            return Ok(None);
        }
        let mut speeds = EdgeData::filled(surface.mesh().edges(), 0.0);
        for wall in &self.moving_wall {
            for edge in boundary_edges(surface, "moving wall", wall.ball()?)? {
                speeds[edge] = wall.speed;
            }
        }
        Ok(Some(speeds))
    }

    /// How fast the fluid flows in through each boundary edge; out of each component it flows at one speed.
    fn inflow(&self, surface: &EmbeddedSurface) -> Result<Option<EdgeData<f64>>, FluidRequestError> {
        if self.inflow.is_empty() && self.outflow.is_empty() {
            return Ok(None);
        }
        let mesh = surface.mesh();
        let mut speeds = EdgeData::filled(mesh.edges(), 0.0);
        let mut out = vec![false; mesh.edges()];
        for inflow in &self.inflow {
            for edge in boundary_edges(surface, "inflow", inflow.ball()?)? {
                speeds[edge] = inflow.speed;
            }
        }
        for ball in &self.outflow {
            for edge in boundary_edges(surface, "outflow", ball.checked()?)? {
                out[edge.index()] = true;
                speeds[edge] = 0.0;
            }
        }
        let component = |edge| mesh.component(mesh.ends(edge)[0]);
        // What flows in, and the length through which it flows out.
        let mut sums = vec![[0.0; 2]; mesh.components()];
        for edge in mesh.edge_ids() {
            let length = surface.surface().edge_length(edge);
            let [into, outlet] = &mut sums[component(edge)];
            *into += length * speeds[edge];
            *outlet += if out[edge.index()] { length } else { 0.0 };
        }
        for edge in mesh.edge_ids().filter(|edge| out[edge.index()]) {
            let [into, outlet] = sums[component(edge)];
            speeds[edge] = -into / outlet;
        }
        Ok(Some(speeds))
    }
}

/// The boundary edges whose midpoints lie in a ball; at least one.
fn boundary_edges(
    surface: &EmbeddedSurface,
    what: &'static str,
    ball: Ball,
) -> Result<Vec<EdgeId>, FluidRequestError> {
    let mesh = surface.mesh();
    let inside = |&edge: &EdgeId| {
        let [a, b] = mesh.ends(edge).map(|v| surface.positions()[v]);
        let middle = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
        mesh.is_boundary_edge(edge) && distance_sq(middle, ball.at) <= ball.radius.powi(2)
    };
    let found: Vec<EdgeId> = mesh.edge_ids().filter(inside).collect();
    if found.is_empty() { Err(nothing_in(what, "boundary edge", ball)) } else { Ok(found) }
}

fn nothing_in(what: &'static str, element: &'static str, ball: Ball) -> FluidRequestError {
    let Ball { at, radius } = ball;
    FluidRequestError::Nothing { what, element, at, radius }
}

/// The values of an expression at vertices.
pub(super) fn expressed(what: &str, expression: &str, mesh: &TriMesh) -> Result<Vec<f64>, FluidRequestError> {
    vertex_values(expression, mesh.positions())
        .map_err(|error| FluidRequestError::Expression { what: what.to_owned(), error })
}

/// Of a density the initial values, and what is added per time, at each vertex.
pub(super) struct Amounts {
    pub(super) initial: Vec<f64>,
    pub(super) source: Option<Vec<f64>>,
}

pub(super) fn amounts(
    density: &DensityScene,
    mesh: &TriMesh,
    around: &Aabb,
) -> Result<Amounts, FluidRequestError> {
    let count = mesh.positions().len();
    let mut initial = match &density.initial {
        Some(expression) => expressed(&format!("density \"{}\"", density.name), expression, mesh)?,
        None => vec![0.0; count],
    };
    if let Some(picture) = &density.picture {
        let dark = darkness(picture, density.axis, mesh, around)?;
        initial.iter_mut().zip(dark).for_each(|(x, dark)| *x += dark);
    }
    let mut added = (!density.source.is_empty()).then(|| vec![0.0; count]);
    for source in &density.source {
        let shares = match (&source.picture, source.at, source.radius) {
            (Some(picture), ..) => darkness(picture, source.axis, mesh, around)?,
            (None, Some(at), Some(radius)) => within(mesh, Ball { at, radius }.checked()?)
                .into_iter()
                .map(|inside| f64::from(u8::from(inside)))
                .collect(),
            _ => return Err(FluidRequestError::Source(density.name.clone())),
        };
        added.iter_mut().flatten().zip(shares).for_each(|(x, share)| *x += source.rate * share);
    }
    Ok(Amounts { initial, source: added })
}

/// How dark a picture is over each vertex, from 0 to 1, laid over a box as seen along an axis.
pub(super) fn darkness(
    path: &Path,
    axis: Axis,
    mesh: &TriMesh,
    around: &Aabb,
) -> Result<Vec<f64>, FluidRequestError> {
    let failed = |error| FluidRequestError::Picture { path: path.to_owned(), error };
    let bytes = std::fs::read(path).map_err(|error| failed(error.into()))?;
    let pixels = Picture::read(&bytes).map_err(|error| failed(error.into()))?;
    // Right and up, as one looks against the axis.
    let [right, up] = match axis {
        Axis::X => [1, 2],
        Axis::Y => [2, 0],
        Axis::Z => [0, 1],
    };
    let [across, along] = [right, up].map(|k| [around.lower[k], around.upper[k]]);
    let pixel = |x: f64, [low, high]: [f64; 2], count: usize| {
        let share = if high > low { (x - low) / (high - low) } else { 0.5 };
        ((share * count as f64) as usize).min(count - 1)
    };
    let dark = |p: &[f64; 3]| {
        let column = pixel(p[right], across, pixels.width());
        let row = pixels.height() - 1 - pixel(p[up], along, pixels.height());
        1.0 - f64::from(pixels.levels()[row * pixels.width() + column])
    };
    Ok(mesh.positions().iter().map(dark).collect())
}

/// Which vertices lie in a ball; the nearest one in any case.
pub(super) fn within(mesh: &TriMesh, ball: Ball) -> Vec<bool> {
    let distances: Vec<f64> = mesh.positions().iter().map(|p| distance_sq(*p, ball.at)).collect();
    let nearest = distances.iter().copied().fold(f64::INFINITY, |m, d| if d < m { d } else { m });
    let reach = ball.radius * ball.radius;
    distances.into_iter().map(|d| d <= reach || d == nearest).collect()
}

pub(super) fn distance_sq(p: [f64; 3], q: [f64; 3]) -> f64 {
    (0..3).map(|i| (p[i] - q[i]) * (p[i] - q[i])).sum()
}
