//! From a scene to a simulation in the square.

use super::build::{Amounts, amounts, darkness, distance_sq, within};
use super::scene::{Ball, Overlay, Scene};
use anyhow::{Context, anyhow, bail};
use pompeiu::core::TriMesh;
use pompeiu::core::geom::Aabb;
use pompeiu::core::mesh::shapes::{Diagonal, grid};
use pompeiu::fluid::square::{Square, SquareDensity, SquareOptions};
use pompeiu::operators::vertex_values;
use std::path::Path;

/// Cells on a side at most: what a page and the systems of larger squares need no machine has.
const MOST_CELLS: usize = 4096;

/// The unit square.
const UNIT: Aabb = Aabb { lower: [0.0; 3], upper: [1.0; 3] };

/// The centres of the cells as vertices.
pub(super) fn centres(cells: usize) -> anyhow::Result<TriMesh> {
    if !(2..=MOST_CELLS).contains(&cells) {
        bail!("the square has {cells} cells on a side; expected 2 to {MOST_CELLS}");
    }
    let (sides, width) = (cells as u32 - 1, 1.0 - 1.0 / cells as f64);
    let (mut positions, faces) = grid([width; 2], [sides; 2], Diagonal::Alternating)?.into_parts();
    for position in &mut positions {
        position[0] += 0.5;
        position[1] += 0.5;
    }
    Ok(TriMesh::new(positions, faces)?)
}

/// The simulation of a scene, with its velocity at first.
pub(super) fn simulation(scene: &Scene, cells: usize, mesh: &TriMesh) -> anyhow::Result<Square> {
    for (what, given) in [
        ("scheme", scene.scheme.is_some()),
        ("integrator", scene.integrator.is_some()),
        ("correction", scene.correction.is_some()),
        ("diffusion", scene.diffusion.is_some()),
        ("cfl", scene.cfl.is_some()),
        ("viscosity_model", scene.viscosity_model.is_some()),
        ("transport", scene.transport.is_some()),
        ("rotation", scene.rotation.is_some()),
        ("confinement", scene.confinement.is_some()),
        ("vorticity", scene.vorticity.is_some()),
        ("harmonic", scene.harmonic.is_some()),
        ("moving_wall", !scene.walls.is_empty()),
        ("inflow", !scene.inflows.is_empty()),
        ("outflow", !scene.outflows.is_empty()),
    ] {
        if given {
            bail!("`{what}` is for surfaces; in the square leave it out");
        }
    }
    let mut square = Square::new(options(scene, cells, mesh)?)?;
    if let Some(text) = &scene.velocity {
        let (u, v) = text.split_once(';').ok_or_else(|| {
            anyhow!("velocity: expected two expressions with `;` between them, found `{text}`")
        })?;
        let values = |text: &str| vertex_values(text, mesh.positions()).context("velocity");
        let (u, v) = (values(u)?, values(v)?);
        square.set_velocity(&u.into_iter().zip(v).map(|(u, v)| [u, v]).collect::<Vec<_>>())?;
    } else if !scene.vortices.is_empty() {
        square.set_velocity(&around_vortices(scene, mesh))?;
    }
    Ok(square)
}

fn options(scene: &Scene, cells: usize, mesh: &TriMesh) -> anyhow::Result<SquareOptions> {
    let Some(dt) = scene.dt else { bail!("no length of a step is given; name one with --dt") };
    let count = cells * cells;
    let densities = scene.densities.iter().map(|density| {
        let Amounts { initial, source } = amounts(density, mesh, &UNIT)?;
        Ok(SquareDensity {
            name: density.name.clone(),
            initial,
            diffusivity: density.diffusivity,
            weight: density.weight,
            source,
        })
    });
    let mut force = scene.acceleration.map(|[x, y, _]| vec![[x, y]; count]);
    for local in &scene.forces {
        let force = force.get_or_insert_with(|| vec![[0.0; 2]; count]);
        for (f, inside) in force.iter_mut().zip(within(mesh, local.ball)) {
            if inside {
                f[0] += local.acceleration[0];
                f[1] += local.acceleration[1];
            }
        }
    }
    Ok(SquareOptions {
        scheme: scene.grid.unwrap_or_default(),
        edges: scene.edges.unwrap_or_default(),
        viscosity: scene.viscosity.unwrap_or(0.0),
        wall: scene.wall.unwrap_or_default(),
        lid: scene.lid.unwrap_or(0.0),
        gravity: scene.gravity.map_or([0.0; 2], |[x, y, _]| [x, y]),
        force,
        solid: scene.obstacles.as_deref().map(|path| obstacles(path, mesh)).transpose()?,
        densities: densities.collect::<anyhow::Result<_>>()?,
        ..SquareOptions::new(cells, dt)
    })
}

/// Which cells are dark in a picture that is laid over the square.
fn obstacles(path: &Path, mesh: &TriMesh) -> anyhow::Result<Vec<bool>> {
    /// What is darker than this is dark.
    const DARK: f64 = 0.5;
    let shares = darkness(&Overlay { path: path.to_owned(), axis: 2 }, mesh, &UNIT)?;
    Ok(shares.into_iter().map(|share| share > DARK).collect())
}

/// The velocity around Gaussians of vorticity in the plane.
fn around_vortices(scene: &Scene, mesh: &TriMesh) -> Vec<[f64; 2]> {
    let velocity = |p: &[f64; 3]| {
        let mut sum = [0.0; 2];
        for vortex in &scene.vortices {
            let Ball { at, radius } = vortex.ball;
            let away = distance_sq(*p, at);
            if away > 0.0 {
                let factor = -(-0.5 * away / (radius * radius)).exp_m1() / (std::f64::consts::TAU * away);
                sum[0] -= vortex.circulation * factor * (p[1] - at[1]);
                sum[1] += vortex.circulation * factor * (p[0] - at[0]);
            }
        }
        sum
    };
    mesh.positions().iter().map(velocity).collect()
}
