//! What a scene file and the command line say of a flow.

use super::args::Fluid;
use super::reader::{Reader, SceneFile};
use anyhow::{Context, anyhow, bail};
use pompeiu::fluid::square::{Edges, SquareScheme};
use pompeiu::fluid::{Correction, Diffusion, Integrator, Scheme, Transport, ViscosityModel, Wall};
use std::path::{Path, PathBuf};

/// A flow as it is described.
#[derive(Default)]
pub(super) struct Scene {
    pub(super) steps: Option<usize>,
    pub(super) dt: Option<f64>,
    pub(super) cfl: Option<f64>,
    pub(super) scheme: Option<Scheme>,
    pub(super) integrator: Option<Integrator>,
    pub(super) correction: Option<Correction>,
    pub(super) diffusion: Option<Diffusion>,
    pub(super) viscosity: Option<f64>,
    pub(super) viscosity_model: Option<ViscosityModel>,
    pub(super) wall: Option<Wall>,
    pub(super) transport: Option<Transport>,
    pub(super) gravity: Option<[f64; 3]>,
    pub(super) rotation: Option<[f64; 3]>,
    pub(super) acceleration: Option<[f64; 3]>,
    pub(super) confinement: Option<f64>,
    pub(super) velocity: Option<String>,
    pub(super) vorticity: Option<String>,
    pub(super) harmonic: Option<Vec<f64>>,
    pub(super) grid: Option<SquareScheme>,
    pub(super) edges: Option<Edges>,
    pub(super) lid: Option<f64>,
    pub(super) obstacles: Option<PathBuf>,
    pub(super) vortices: Vec<Vortex>,
    pub(super) densities: Vec<DensityScene>,
    pub(super) forces: Vec<LocalForce>,
    pub(super) walls: Vec<MovingWall>,
    pub(super) inflows: Vec<InflowScene>,
    /// Where what flows in flows out.
    pub(super) outflows: Vec<Ball>,
}

/// A ball in space.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ball {
    pub(super) at: [f64; 3],
    pub(super) radius: f64,
}

pub(super) struct Vortex {
    pub(super) ball: Ball,
    pub(super) circulation: f64,
}

pub(super) struct DensityScene {
    pub(super) name: String,
    pub(super) initial: Option<String>,
    pub(super) picture: Option<Overlay>,
    pub(super) diffusivity: f64,
    pub(super) weight: f64,
    /// Where something is added, and how much per time.
    pub(super) sources: Vec<(Region, f64)>,
}

/// Where a source is.
pub(super) enum Region {
    Ball(Ball),
    Picture(Overlay),
}

/// A picture that lies over the mesh, seen along an axis.
pub(super) struct Overlay {
    pub(super) path: PathBuf,
    pub(super) axis: usize,
}

pub(super) struct LocalForce {
    pub(super) ball: Ball,
    pub(super) acceleration: [f64; 3],
}

pub(super) struct MovingWall {
    pub(super) ball: Ball,
    pub(super) speed: f64,
}

pub(super) struct InflowScene {
    pub(super) ball: Ball,
    pub(super) speed: f64,
}

impl Scene {
    /// What the command line says, and for all else what the scene file says.
    pub(super) fn of(args: &Fluid) -> anyhow::Result<Self> {
        let mut scene = match scene_path(args)? {
            Some(path) => Self::read(path)?,
            None => Self::default(),
        };
        macro_rules! prefer {
            ($($field:ident),*) => {
                $(if args.$field.is_some() { scene.$field.clone_from(&args.$field); })*
            };
        }
        prefer!(
            steps,
            dt,
            cfl,
            scheme,
            integrator,
            correction,
            diffusion,
            viscosity,
            viscosity_model,
            wall,
            transport
        );
        prefer!(grid, edges, lid, obstacles);
        prefer!(gravity, rotation, acceleration, confinement, velocity, vorticity, harmonic);
        if let Some(initial) = &args.density {
            scene.densities.push(DensityScene {
                name: "density".to_owned(),
                initial: Some(initial.clone()),
                picture: None,
                diffusivity: 0.0,
                weight: 0.0,
                sources: Vec::new(),
            });
        }
        if scene.velocity.is_some()
            && (scene.vorticity.is_some() || scene.harmonic.is_some() || !scene.vortices.is_empty())
        {
            bail!("both a velocity and a vorticity are given; choose one of them");
        }
        Ok(scene)
    }

    fn read(path: &Path) -> anyhow::Result<Self> {
        crate::files::check_readable(path)?;
        let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
        let file = SceneFile::parse(path, text)?;
        let mut top = file.top();
        let scene = Self {
            steps: top.count("steps")?,
            dt: top.number("dt")?,
            cfl: top.number("cfl")?,
            scheme: top.name("scheme", &Scheme::ALL.map(Scheme::name), Scheme::named)?,
            integrator: top.name("integrator", &Integrator::ALL.map(Integrator::name), Integrator::named)?,
            correction: top.name("correction", &Correction::ALL.map(Correction::name), Correction::named)?,
            diffusion: top.name("diffusion", &Diffusion::ALL.map(Diffusion::name), Diffusion::named)?,
            viscosity: top.number("viscosity")?,
            viscosity_model: top.name(
                "viscosity_model",
                &ViscosityModel::ALL.map(ViscosityModel::name),
                ViscosityModel::named,
            )?,
            wall: top.name("wall", &Wall::ALL.map(Wall::name), Wall::named)?,
            transport: top.name("transport", &Transport::ALL.map(Transport::name), Transport::named)?,
            gravity: top.vector("gravity")?,
            rotation: top.vector("rotation")?,
            acceleration: top.vector("acceleration")?,
            confinement: top.number("confinement")?,
            velocity: top.text("velocity")?,
            vorticity: top.text("vorticity")?,
            harmonic: top.numbers("harmonic")?,
            grid: parsed(&mut top, "grid", super::args::grid)?,
            edges: parsed(&mut top, "edges", super::args::edges)?,
            lid: top.number("lid")?,
            obstacles: top.text("obstacles")?.map(PathBuf::from),
            vortices: each(&mut top, "vortex", vortex)?,
            densities: each(&mut top, "density", density)?,
            forces: each(&mut top, "force", force)?,
            walls: each(&mut top, "moving_wall", moving_wall)?,
            inflows: each(&mut top, "inflow", inflow)?,
            outflows: each(&mut top, "outflow", ball)?,
        };
        top.finish()?;
        Ok(scene)
    }
}

/// The scene file; in the square there is no mesh before it.
pub(super) fn scene_path(args: &Fluid) -> anyhow::Result<Option<&PathBuf>> {
    match (args.square, &args.mesh, &args.scene) {
        (Some(_), _, Some(second)) => {
            bail!("{}: the square has no mesh; name a scene or none", second.display())
        }
        (Some(_), first, None) => Ok(first.as_ref()),
        (None, _, scene) => Ok(scene.as_ref()),
    }
}

/// A text that another function reads.
fn parsed<T>(
    reader: &mut Reader<'_>,
    key: &'static str,
    parse: impl Fn(&str) -> Result<T, String>,
) -> anyhow::Result<Option<T>> {
    let Some(text) = reader.text(key)? else { return Ok(None) };
    parse(&text).map(Some).map_err(|error| anyhow!("{key}: {error}"))
}

/// Every table of a name.
fn each<T>(
    reader: &mut Reader<'_>,
    key: &'static str,
    parse: impl Fn(&mut Reader<'_>) -> anyhow::Result<T>,
) -> anyhow::Result<Vec<T>> {
    let tables = reader.tables(key)?.into_iter();
    tables
        .map(|mut table| {
            let parsed = parse(&mut table)?;
            table.finish()?;
            Ok(parsed)
        })
        .collect()
}

fn ball(table: &mut Reader<'_>) -> anyhow::Result<Ball> {
    let (at, radius) = (table.vector("at")?, table.number("radius")?);
    let (at, radius) = (table.required("at", at)?, table.required("radius", radius)?);
    if !(radius > 0.0 && radius.is_finite()) {
        bail!("a radius is {radius}; it must be finite and above 0");
    }
    Ok(Ball { at, radius })
}

fn vortex(table: &mut Reader<'_>) -> anyhow::Result<Vortex> {
    let (ball, circulation) = (ball(table)?, table.number("circulation")?);
    Ok(Vortex { ball, circulation: table.required("circulation", circulation)? })
}

fn density(table: &mut Reader<'_>) -> anyhow::Result<DensityScene> {
    Ok(DensityScene {
        name: table.text("name")?.unwrap_or_else(|| "density".to_owned()),
        initial: table.text("initial")?,
        picture: overlay(table)?,
        diffusivity: table.number("diffusivity")?.unwrap_or(0.0),
        weight: table.number("weight")?.unwrap_or(0.0),
        sources: each(table, "source", source)?,
    })
}

fn source(table: &mut Reader<'_>) -> anyhow::Result<(Region, f64)> {
    let region = match overlay(table)? {
        Some(picture) => Region::Picture(picture),
        None => Region::Ball(ball(table)?),
    };
    let rate = table.number("rate")?;
    Ok((region, table.required("rate", rate)?))
}

fn overlay(table: &mut Reader<'_>) -> anyhow::Result<Option<Overlay>> {
    const AXES: [&str; 3] = ["x", "y", "z"];
    let axis = table.name("axis", &AXES, |name| AXES.iter().position(|axis| *axis == name))?;
    let path = table.text("picture")?.map(PathBuf::from);
    Ok(path.map(|path| Overlay { path, axis: axis.unwrap_or(2) }))
}

fn force(table: &mut Reader<'_>) -> anyhow::Result<LocalForce> {
    let (ball, acceleration) = (ball(table)?, table.vector("acceleration")?);
    Ok(LocalForce { ball, acceleration: table.required("acceleration", acceleration)? })
}

fn moving_wall(table: &mut Reader<'_>) -> anyhow::Result<MovingWall> {
    let (ball, speed) = (ball(table)?, table.number("speed")?);
    Ok(MovingWall { ball, speed: table.required("speed", speed)? })
}

fn inflow(table: &mut Reader<'_>) -> anyhow::Result<InflowScene> {
    let (ball, speed) = (ball(table)?, table.number("speed")?);
    Ok(InflowScene { ball, speed: table.required("speed", speed)? })
}
