//! What deviations of surfaces that lie apart cost, in processor time and memory by face:
//!
//! ```sh
//! cargo run --release -p pompeiu-hausdorff --example deviation_cost -- bunny.obj deformed=0.03 [--accuracy 0.01] [--threads 1] [--signed]
//! ```
//!
//! A surface is a file or `icosphere=LEVELS`; the second may also be the first `deformed=a` by the amplitude a, `turned=DEGREES` about the
//! third axis through its centre, or `scaled=FACTOR` from its centre; `+SURFACE` in front subdivides it once. A deformation adds a times the
//! diagonal of the bounding box times (sin 6y, sin 5z, sin 7x), with coordinates in which the longest side of the box is one.
//!
//! Prints one line: faces, seconds of all processors, microseconds by face of both surfaces, bytes by face (the peak of the process less
//! what it took before), pieces, and the enclosures of distance, mean, root mean square and percentiles in both directions.

#![allow(clippy::print_stdout, reason = "this program is there to print")]

use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::mesh::subdivide;
use pompeiu_core::run::Limits;
use pompeiu_hausdorff::{DeviationOptions, DirectedDeviation};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (mut accuracy, mut threads, mut threshold, mut signed) = (0.01, 1, None, false);
    let mut surfaces = Vec::new();
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument} needs a value"));
        match argument.as_str() {
            "--accuracy" => accuracy = value()?.parse()?,
            "--threads" => threads = value()?.parse()?,
            "--threshold" => threshold = Some(value()?.parse()?),
            "--signed" => signed = true,
            _ => surfaces.push(argument),
        }
    }
    let [a, b] = &surfaces[..] else { return Err("expected two surfaces".into()) };
    let a = surface(a, None)?;
    let b = surface(b, Some(&a))?;
    let (before, held) = (processor_seconds(), bytes("VmRSS:"));
    let limits = Limits { threads: Some(Limits::threads(threads)?), ..Limits::default() };
    let options = DeviationOptions { accuracy, threshold, signed, limits, ..DeviationOptions::default() };
    let deviation = options.symmetric(&a, &b)?;
    let seconds = processor_seconds() - before;
    let faces = a.faces().len() + b.faces().len();
    let per_face = 1.0 / faces as f64;
    println!(
        "{faces} faces, {seconds:.2} s, {:.1} us a face, {:.0} bytes a face",
        seconds * 1e6 * per_face,
        (bytes("VmHWM:") - held) * per_face
    );
    show(&deviation.a_to_b);
    show(&deviation.b_to_a);
    Ok(())
}

fn show(deviation: &DirectedDeviation) {
    let work = &deviation.work;
    print!(
        "  {:?} {} pieces, {} looks, {} distances, {} rounds, {:.3} {:.3} {:.3} s; distance {}",
        deviation.stop,
        work.pieces,
        work.looks,
        work.distances,
        work.rounds,
        work.build.as_secs_f64(),
        work.search.as_secs_f64(),
        work.refine.as_secs_f64(),
        deviation.distance.distance
    );
    if let Some(statistics) = &deviation.statistics {
        print!(" mean {} rms {}", statistics.mean, statistics.rms);
        for percentile in &statistics.percentiles {
            print!(" {}% {}", 100.0 * percentile.share, percentile.distance);
        }
        let width = 100.0 * statistics.mean.gap() / statistics.mean.lower();
        print!("; mean {width:.3} % wide, {} regions", deviation.regions.len());
    }
    println!();
}

fn surface(name: &str, of: Option<&TriMesh>) -> Result<TriMesh, Box<dyn Error>> {
    if let Some(rest) = name.strip_prefix('+') {
        return Ok(subdivide(&surface(rest, of)?)?);
    }
    let original = || of.ok_or("only the second surface may be made from the first");
    Ok(match name.split_once('=') {
        Some(("icosphere", levels)) => icosphere(1.0, levels.parse()?)?,
        Some(("deformed", amplitude)) => deformed(original()?, amplitude.parse()?)?,
        Some(("turned", degrees)) => {
            let (sin, cos) = degrees.parse::<f64>()?.to_radians().sin_cos();
            moved(original()?, |[x, y, z]| [cos * x - sin * y, sin * x + cos * y, z])?
        }
        Some(("scaled", factor)) => {
            let factor: f64 = factor.parse()?;
            moved(original()?, |p| p.map(|x| factor * x))?
        }
        _ => pompeiu_io::read_mesh(name)?,
    })
}

/// Moves the points as they lie about the centre of the box.
fn moved(mesh: &TriMesh, map: impl Fn([f64; 3]) -> [f64; 3]) -> Result<TriMesh, Box<dyn Error>> {
    let aabb = Aabb::of_faces(mesh);
    let centre = [0, 1, 2].map(|k| 0.5 * (aabb.lower[k] + aabb.upper[k]));
    let map = |p: &[f64; 3]| {
        let q = map([0, 1, 2].map(|k| p[k] - centre[k]));
        [0, 1, 2].map(|k| centre[k] + q[k])
    };
    Ok(TriMesh::new(mesh.positions().iter().map(map).collect(), mesh.faces().to_vec())?)
}

fn deformed(mesh: &TriMesh, amplitude: f64) -> Result<TriMesh, Box<dyn Error>> {
    let aabb = Aabb::of_faces(mesh);
    let sides = [0, 1, 2].map(|k| aabb.upper[k] - aabb.lower[k]);
    let longest = sides.iter().fold(0.0, |a: f64, b| a.max(*b));
    let far = amplitude * sides.iter().map(|x| x * x).sum::<f64>().sqrt();
    let map = |p: &[f64; 3]| {
        let [x, y, z] = [0, 1, 2].map(|k| (p[k] - aabb.lower[k]) / longest);
        let by = [(6.0 * y).sin(), (5.0 * z).sin(), (7.0 * x).sin()];
        [0, 1, 2].map(|k| p[k] + far * by[k])
    };
    Ok(TriMesh::new(mesh.positions().iter().map(map).collect(), mesh.faces().to_vec())?)
}

/// Of all threads of this process.
fn processor_seconds() -> f64 {
    /// Ticks in which Linux counts processor time.
    const TICKS: f64 = 100.0;
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let tick = |i: usize| fields.get(i).and_then(|x| x.parse::<f64>().ok()).unwrap_or(f64::NAN);
    (tick(11) + tick(12)) / TICKS
}

fn bytes(row: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix(row));
    let kilobytes = line.and_then(|line| line.trim().trim_end_matches("kB").trim().parse::<f64>().ok());
    1024.0 * kilobytes.unwrap_or(f64::NAN)
}
