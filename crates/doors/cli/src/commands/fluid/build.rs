//! From a scene to a simulation.

use super::scene::{Ball, DensityScene, Overlay, Region, Scene};
use crate::field;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::core::TriMesh;
use pompeiu::core::geom::Aabb;
use pompeiu::core::mesh::VertexData;
use pompeiu::fluid::{Density, FluidOptions, Simulation, TimeStep, coriolis, tangential};
use pompeiu::operators::{FaceField, FieldSource, vertex_values};
use pompeiu::planar::picture::Picture;
use pompeiu::surface::{EdgeData, EdgeId, EmbeddedSurface};

/// The simulation of a scene, with its velocity at first.
pub(super) fn simulation<'s>(
    scene: &Scene,
    mesh: &TriMesh,
    surface: &'s EmbeddedSurface,
    printer: &Printer,
) -> anyhow::Result<Simulation<'s>> {
    let mut fluid = Simulation::new(surface.surface(), options(scene, mesh, surface)?)?;
    for (what, given) in [
        ("grid", scene.grid.is_some()),
        ("edges", scene.edges.is_some()),
        ("lid", scene.lid.is_some()),
        ("obstacles", scene.obstacles.is_some()),
    ] {
        if given {
            bail!("`{what}` is for the square; name it with --square, or leave `{what}` out");
        }
    }
    if let Some(text) = &scene.velocity {
        let source: FieldSource = text.parse().map_err(anyhow::Error::msg).context("velocity")?;
        let read = field::vectors(&source, None)?;
        let found = source.field(surface, fluid.harmonic_fields(), read.as_deref());
        let place = || source.file().map_or_else(|| "velocity".to_owned(), |path| path.display().to_string());
        let found = found.with_context(place)?;
        field::warn_of_normal_part(&source, &found, printer);
        let start = found.field;
        fluid.set_velocity(&start)?;
        let (kept, given) = [&fluid.state().velocity, &start]
            .map(|u| pompeiu::operators::field_norm(surface.surface(), u))
            .into();
        if kept < (1.0 - NOTABLE) * given {
            let part = 100.0 * (1.0 - (kept / given).powi(2));
            printer.note(format_args!("velocity: {part:.1} % of its energy was divergence and is taken off"));
        }
    } else if scene.vorticity.is_some() || scene.harmonic.is_some() || !scene.vortices.is_empty() {
        let vorticity = vorticity(scene, mesh, surface)?;
        let dimension = fluid.harmonic_fields().len();
        let harmonic = scene.harmonic.clone().unwrap_or_else(|| vec![0.0; dimension]);
        fluid.set_vorticity(&vorticity, &harmonic)?;
    }
    Ok(fluid)
}

/// A change of the norm of a velocity by this part is told.
const NOTABLE: f64 = 1e-3;

fn options(scene: &Scene, mesh: &TriMesh, surface: &EmbeddedSurface) -> anyhow::Result<FluidOptions> {
    let Some(dt) = scene.dt else { bail!("no length of a step is given; name one with --dt") };
    let around = Aabb::of_points(mesh.positions());
    let densities = scene.densities.iter().map(|density| {
        let Amounts { initial, source } = amounts(density, mesh, &around)?;
        let count = mesh.positions().len();
        Ok(Density {
            name: density.name.clone(),
            initial: VertexData::new(count, initial)?,
            diffusivity: density.diffusivity,
            weight: density.weight,
            source: source.map(|source| VertexData::new(count, source)).transpose()?,
        })
    });
    Ok(FluidOptions {
        scheme: scene.scheme.unwrap_or_default(),
        integrator: scene.integrator.unwrap_or_default(),
        correction: scene.correction.unwrap_or_default(),
        diffusion: scene.diffusion.unwrap_or_default(),
        time_step: scene.cfl.map_or(TimeStep::Fixed(dt), |number| TimeStep::Cfl { number, longest: dt }),
        viscosity: scene.viscosity.unwrap_or(0.0),
        viscosity_model: scene.viscosity_model.unwrap_or_default(),
        wall: scene.wall.unwrap_or_default(),
        wall_velocity: wall_velocity(scene, surface)?,
        inflow: inflow(scene, surface)?,
        gravity: scene.gravity.map(|gravity| tangential(surface, gravity)),
        coriolis: scene.rotation.map(|rotation| coriolis(surface, rotation)),
        force: force(scene, surface)?,
        confinement: scene.confinement.unwrap_or(0.0),
        densities: densities.collect::<anyhow::Result<_>>()?,
        transport: scene.transport.unwrap_or_default(),
    })
}

/// The vorticity of an expression and of vortices.
fn vorticity(scene: &Scene, mesh: &TriMesh, surface: &EmbeddedSurface) -> anyhow::Result<VertexData<f64>> {
    let count = surface.mesh().vertices();
    let mut sum = match &scene.vorticity {
        Some(expression) => {
            VertexData::new(count, vertex_values(expression, mesh.positions()).context("vorticity")?)?
        }
        None => VertexData::filled(count, 0.0),
    };
    for vortex in &scene.vortices {
        let Ball { at, radius } = vortex.ball;
        let peak = vortex.circulation / (std::f64::consts::TAU * radius * radius);
        for (w, p) in sum.iter_mut().zip(surface.positions()) {
            *w += peak * (-0.5 * distance_sq(*p, at) / (radius * radius)).exp();
        }
    }
    Ok(sum)
}

/// The acceleration that is always there.
fn force(scene: &Scene, surface: &EmbeddedSurface) -> anyhow::Result<Option<FaceField>> {
    if scene.acceleration.is_none() && scene.forces.is_empty() {
        return Ok(None);
    }
    let mut sum = tangential(surface, scene.acceleration.unwrap_or([0.0; 3]));
    for local in &scene.forces {
        let everywhere = tangential(surface, local.acceleration);
        let mut touched = false;
        for face in surface.mesh().face_ids() {
            if distance_sq(surface.centroid(face), local.ball.at) <= local.ball.radius.powi(2) {
                touched = true;
                for i in 0..2 {
                    sum[face][i] += everywhere[face][i];
                }
            }
        }
        if !touched {
            bail!("{}", nothing_in("force", "face", local.ball));
        }
    }
    Ok(Some(sum))
}

/// How fast each boundary edge moves along itself.
fn wall_velocity(scene: &Scene, surface: &EmbeddedSurface) -> anyhow::Result<Option<EdgeData<f64>>> {
    if scene.walls.is_empty() {
        return Ok(None);
    }
    let mut speeds = EdgeData::filled(surface.mesh().edges(), 0.0);
    for wall in &scene.walls {
        for edge in boundary_edges(surface, "moving wall", wall.ball)? {
            speeds[edge] = wall.speed;
        }
    }
    Ok(Some(speeds))
}

/// How fast the fluid flows in through each boundary edge; out of each component it flows at one speed.
fn inflow(scene: &Scene, surface: &EmbeddedSurface) -> anyhow::Result<Option<EdgeData<f64>>> {
    if scene.inflows.is_empty() && scene.outflows.is_empty() {
        return Ok(None);
    }
    let mesh = surface.mesh();
    let mut speeds = EdgeData::filled(mesh.edges(), 0.0);
    let mut out = vec![false; mesh.edges()];
    for inflow in &scene.inflows {
        for edge in boundary_edges(surface, "inflow", inflow.ball)? {
            speeds[edge] = inflow.speed;
        }
    }
    for ball in &scene.outflows {
        for edge in boundary_edges(surface, "outflow", *ball)? {
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

/// The boundary edges whose midpoints lie in a ball; at least one.
fn boundary_edges(surface: &EmbeddedSurface, what: &str, ball: Ball) -> anyhow::Result<Vec<EdgeId>> {
    let mesh = surface.mesh();
    let inside = |&edge: &EdgeId| {
        let [a, b] = mesh.ends(edge).map(|v| surface.positions()[v]);
        let middle = [0, 1, 2].map(|i| 0.5 * (a[i] + b[i]));
        mesh.is_boundary_edge(edge) && distance_sq(middle, ball.at) <= ball.radius.powi(2)
    };
    let found: Vec<EdgeId> = mesh.edge_ids().filter(inside).collect();
    if found.is_empty() {
        bail!("{}", nothing_in(what, "boundary edge", ball));
    }
    Ok(found)
}

fn nothing_in(what: &str, element: &str, ball: Ball) -> String {
    let Ball { at: [x, y, z], radius } = ball;
    format!("{what}: there is no {element} within {radius} of ({x}, {y}, {z})")
}

/// Of a density what there is at first, and what is added per time, at each vertex.
pub(super) struct Amounts {
    pub(super) initial: Vec<f64>,
    pub(super) source: Option<Vec<f64>>,
}

pub(super) fn amounts(density: &DensityScene, mesh: &TriMesh, around: &Aabb) -> anyhow::Result<Amounts> {
    let count = mesh.positions().len();
    let mut initial = match &density.initial {
        Some(expression) => vertex_values(expression, mesh.positions())
            .with_context(|| format!("density \"{}\"", density.name))?,
        None => vec![0.0; count],
    };
    if let Some(picture) = &density.picture {
        initial.iter_mut().zip(darkness(picture, mesh, around)?).for_each(|(x, dark)| *x += dark);
    }
    let mut source = (!density.sources.is_empty()).then(|| vec![0.0; count]);
    for (region, rate) in &density.sources {
        let shares = match region {
            Region::Ball(ball) => {
                within(mesh, *ball).into_iter().map(|inside| f64::from(u8::from(inside))).collect()
            }
            Region::Picture(picture) => darkness(picture, mesh, around)?,
        };
        source.iter_mut().flatten().zip(shares).for_each(|(x, share)| *x += rate * share);
    }
    Ok(Amounts { initial, source })
}

/// How dark a picture is over each vertex, from 0 to 1, laid over a box as seen along an axis.
pub(super) fn darkness(picture: &Overlay, mesh: &TriMesh, around: &Aabb) -> anyhow::Result<Vec<f64>> {
    crate::files::check_readable(&picture.path)?;
    let shown = || picture.path.display().to_string();
    let pixels = Picture::read(&std::fs::read(&picture.path).with_context(shown)?).with_context(shown)?;
    // Right and up, as one looks against the axis.
    let [right, up] = [[1, 2], [2, 0], [0, 1]][picture.axis];
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
