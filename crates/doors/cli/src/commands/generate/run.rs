//! Runs the command.

use super::args::Generate;
use super::shape::{Finish, Shape};
use crate::exit::Exit;
use crate::files;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::core::TriMesh;
use pompeiu::core::mesh::shapes::{self, Ends};
use pompeiu::core::mesh::{Affine, displace_at_random, ripple, shuffle, subdivide, transform, unweld};

pub(crate) fn run(args: &Generate, printer: &Printer) -> anyhow::Result<Exit> {
    match &args.shape {
        Shape::Polyline(curve) => curve.write(printer)?,
        Shape::NoisyCircle(circle) => circle.write(printer)?,
        shape => write(shape, printer)?,
    }
    Ok(Exit::Done)
}

fn write(shape: &Shape, printer: &Printer) -> anyhow::Result<()> {
    let Some((mesh, finish)) = make(shape, printer)? else { return Ok(()) };
    files::write(&finish.output, &finished(mesh, finish)?, printer)
}

/// The mesh of a shape; none of one in the plane.
fn make<'s>(shape: &'s Shape, printer: &Printer) -> anyhow::Result<Option<(TriMesh, &'s Finish)>> {
    let ends = |capped| if capped { Ends::Capped } else { Ends::Open };
    let (mesh, finish) = match shape {
        Shape::Icosphere { radius, subdivisions, finish } => {
            (shapes::icosphere(*radius, *subdivisions), finish)
        }
        Shape::UvSphere { radius, segments, rings, finish } => {
            (shapes::uv_sphere(*radius, *segments, *rings), finish)
        }
        Shape::Torus { major_radius, minor_radius, major_segments, minor_segments, finish } => {
            (shapes::torus(*major_radius, *minor_radius, *major_segments, *minor_segments), finish)
        }
        Shape::Cube { side, cells, finish } => (shapes::cube(*side, *cells), finish),
        Shape::Box { size, cells, finish } => (shapes::cuboid(*size, *cells), finish),
        Shape::Grid { size, cells, diagonal, finish } => {
            (shapes::grid(*size, *cells, (*diagonal).into()), finish)
        }
        Shape::Disk { radius, segments, rings, finish } => (shapes::disk(*radius, *segments, *rings), finish),
        Shape::Cylinder { radius, height, segments, rows, capped, finish } => {
            (shapes::cylinder(*radius, *height, *segments, *rows, ends(*capped)), finish)
        }
        Shape::SchwarzLantern { radius, height, segments, bands, finish } => {
            (shapes::schwarz_lantern(*radius, *height, *segments, *bands), finish)
        }
        Shape::Cone { radius, height, segments, capped, finish } => {
            (shapes::cone(*radius, *height, *segments, ends(*capped)), finish)
        }
        Shape::Tent { side, height, finish } => (shapes::tent(*side, *height), finish),
        Shape::Tetrahedron { edge, finish } => (shapes::tetrahedron(*edge), finish),
        Shape::Icosahedron { radius, finish } => (shapes::icosahedron(*radius), finish),
        Shape::Catenoid { waist, height, segments, rows, finish } => {
            (shapes::catenoid(*waist, *height, *segments, *rows), finish)
        }
        Shape::Helicoid { radius, pitch, turns, segments, strips, finish } => {
            (shapes::helicoid(*radius, *pitch, *turns, *segments, *strips), finish)
        }
        Shape::Enneper { radius, segments, rings, finish } => {
            (shapes::enneper(*radius, *segments, *rings), finish)
        }
        Shape::Scherk { half, cells, finish } => (shapes::scherk(*half, *cells), finish),
        Shape::Dumbbell { radius, neck, segments, rows, finish } => {
            (shapes::dumbbell(*radius, *neck, *segments, *rows), finish)
        }
        Shape::MobiusStrip { radius, width, segments, strips, finish } => {
            (shapes::mobius_strip(*radius, *width, *segments, *strips), finish)
        }
        Shape::PerforatedPlate { edge, holes, finish } => (shapes::perforated_plate(*edge, *holes), finish),
        Shape::PointLattice { side, cells, finish } => (shapes::point_lattice(*side, *cells), finish),
        Shape::Wire { input, rows, finish } => {
            files::check_place(&finish.output, &[input])?;
            (shapes::span(&pompeiu::io::read_loops(input)?, *rows), finish)
        }
        Shape::Polyline(_) | Shape::NoisyCircle(_) => return Ok(None),
        Shape::Mesh { input, finish } => {
            files::check_writable(&finish.output)?;
            if files::are_same(input, &finish.output) {
                bail!("{}: is both input and output; give the output another name", input.display());
            }
            let read = files::read(input)?;
            files::warn_of_changes(input, &read, printer);
            (Ok(read.mesh), finish)
        }
    };
    Ok(Some((mesh?, finish)))
}

/// Applies the edits in the order in which the help lists them.
fn finished(mut mesh: TriMesh, finish: &Finish) -> anyhow::Result<TriMesh> {
    for _ in 0..finish.subdivide {
        mesh = subdivide(&mesh).context("--subdivide")?;
    }
    if let Some([amplitude, wavelength]) = finish.ripple {
        if !(amplitude.is_finite() && wavelength.is_finite() && wavelength != 0.0) {
            bail!(
                "--ripple: the amplitude {amplitude} and the wavelength {wavelength} must be finite, the wavelength not zero"
            );
        }
        mesh = ripple(&mesh, amplitude, wavelength).context("--ripple")?;
    }
    if let Some(amplitude) = finish.noise {
        mesh = displace_at_random(&mesh, amplitude, finish.seed).context("--noise")?;
    }
    if let Some(factor) = finish.scale {
        mesh = transform(&mesh, &Affine::scale([factor; 3])).context("--scale")?;
    }
    if let Some([x, y, z, degrees]) = finish.rotate {
        let Some(rotation) = Affine::rotate([x, y, z], degrees) else {
            bail!("--rotate: the axis {x},{y},{z} and the angle {degrees} must be finite, the axis not zero");
        };
        mesh = transform(&mesh, &rotation).context("--rotate")?;
    }
    if let Some(translation) = finish.translate {
        mesh = transform(&mesh, &Affine::translate(translation)).context("--translate")?;
    }
    if let Some(seed) = finish.shuffle {
        mesh = shuffle(&mesh, seed);
    }
    if finish.unweld {
        mesh = unweld(&mesh).context("--unweld")?;
    }
    Ok(mesh)
}
