//! Times operators, solves, the splitting of fields and tracing on one mesh, on one thread, and writes what others can be
//! compared with: `operators-bench MESH SUBDIVISIONS FOLDER`.

use anyhow::{Context, Result};
use pompeiu::core::mesh::{Random, subdivide};
use pompeiu::core::{FaceId, TriMesh, VertexId};
use pompeiu::fields::{DecompositionOptions, HodgeSolver};
use pompeiu::operators::{Boundary, HarmonicBasis, HeatMethod, HeatOptions, Splitting, cotan_laplacian, random_field};
use pompeiu::solve::{LinearSolver, SemidefiniteCholesky};
use pompeiu::surface::{EmbeddedSurface, Ray, TraceOptions, Tracer};
use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// Each time is the least of so many.
const RUNS: usize = 3;

const RAYS: usize = 20_000;

/// Lengths of rays, in mean edges.
const LENGTHS: [f64; 3] = [1.0, 3.0, 10.0];

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, subdivisions, folder] = &arguments[..] else {
        anyhow::bail!("usage: operators-bench MESH SUBDIVISIONS FOLDER");
    };
    let folder = Path::new(folder);
    let mut mesh = pompeiu::io::read_mesh(file)?;
    for _ in 0..subdivisions.parse().context("SUBDIVISIONS")? {
        mesh = subdivide(&mesh)?;
    }
    pompeiu::io::write(folder.join("mesh.obj"), &mesh)?;

    let mut times = serde_json::Map::new();
    let mut record = |name: &str, ms: f64| {
        times.insert(name.into(), ms.into());
    };
    let (embedded, ms) = least(|| Ok(EmbeddedSurface::new(&mesh)?))?;
    record("surface", ms);
    let surface = embedded.surface();
    let vertices = mesh.positions().len();
    let group: Vec<Option<u32>> =
        embedded.mesh().vertex_ids().map(|v| Some(embedded.mesh().component(v) as u32)).collect();
    let (laplacian, ms) = least(|| Ok(cotan_laplacian(surface)?))?;
    record("cotan_assemble", ms);
    let (solver, ms) =
        least(|| Ok(SemidefiniteCholesky::new(laplacian.clone(), &vec![false; vertices], &group)?))?;
    record("cotan_factor", ms);
    let heights: Vec<f64> = mesh.positions().iter().map(|p| p[2]).collect();
    record("cotan_solve", least(|| Ok(solver.solve(&heights)?))?.1);
    let basis = || Ok(HarmonicBasis::new(surface, Splitting::Primal, Boundary::Tangential)?);
    record("harmonic_basis", least(basis)?.1);
    let (hodge, ms) = least(|| Ok(HodgeSolver::new(surface, &DecompositionOptions::default())?))?;
    record("hodge_setup", ms);
    let field = random_field(surface.mesh(), 1);
    record("hodge_split", least(|| Ok(hodge.decompose(&field)?))?.1);
    let (heat, ms) = least(|| Ok(HeatMethod::new(surface, &HeatOptions::default())?))?;
    record("heat_setup", ms);
    let (distances, ms) = least(|| Ok(heat.distances(&[VertexId(0)])?))?;
    record("heat_distances", ms);
    let text: String = distances.iter().fold(String::new(), |text, d| text + &d.to_string() + "\n");
    std::fs::write(folder.join("distances.txt"), text)?;
    trace(&mesh, &embedded, folder, &mut record)?;
    println!("{}", serde_json::to_string(&times)?);
    Ok(())
}

/// The result of the last run, and the least time in milliseconds.
fn least<T>(run: impl Fn() -> Result<T>) -> Result<(T, f64)> {
    let mut best = f64::INFINITY;
    let mut last = None;
    for _ in 0..RUNS {
        let start = Instant::now();
        last = Some(black_box(run()?));
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
    }
    Ok((last.context("no runs")?, best))
}

/// Rays from random places in random directions, in the order of faces; microseconds each.
fn trace(
    mesh: &TriMesh,
    embedded: &EmbeddedSurface,
    folder: &Path,
    record: &mut impl FnMut(&str, f64),
) -> Result<()> {
    let surface = embedded.surface();
    let (tracer, ms) = least(|| Ok(Tracer::new(surface, &TraceOptions::default())))?;
    record("tracer_setup", ms);
    let lengths = surface.edge_lengths();
    let edge = lengths.iter().sum::<f64>() / lengths.len() as f64;
    let mut random = Random::new(1);
    for length in LENGTHS {
        let mut rays: Vec<(Ray, [f64; 3])> = (0..RAYS)
            .map(|_| {
                let face = FaceId(random.below(mesh.faces().len() as u32));
                let weights = [0; 3].map(|_| 0.1 + random.signed_unit().abs());
                let sum: f64 = weights.iter().sum();
                let weights = weights.map(|w| w / sum);
                let angle = random.signed_unit() * std::f64::consts::PI;
                let direction = [angle.cos(), angle.sin()];
                let point = surface.point(face, weights);
                (Ray { face, point, direction, length: length * edge }, weights)
            })
            .collect();
        rays.sort_by_key(|(ray, _)| ray.face);
        let only: Vec<Ray> = rays.iter().map(|(ray, _)| *ray).collect();
        let (ends, ms) = least(|| Ok(only.iter().map(|ray| tracer.trace(ray)).collect::<Vec<_>>()))?;
        record(&format!("trace_{length}_us"), ms * 1e3 / RAYS as f64);
        let mut text = String::new();
        for ((ray, weights), end) in rays.iter().zip(&ends) {
            let way = embedded.to_space(ray.face, ray.direction).map(|x| x * ray.length);
            let (at, corners) = (surface.barycentric(end.face, end.point), mesh.corners(end.face));
            let place = [0, 1, 2].map(|i| (0..3).map(|k| at[k] * corners[k][i]).sum::<f64>());
            write!(text, "{}", ray.face)?;
            for x in weights.iter().chain(&way).chain(&place) {
                write!(text, " {x}")?;
            }
            text.push('\n');
        }
        std::fs::write(folder.join(format!("rays-{length}.txt")), text)?;
    }
    Ok(())
}
