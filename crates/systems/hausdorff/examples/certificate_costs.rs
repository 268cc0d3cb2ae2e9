//! What certificates cost: processor time of the engine, of writing and of verifying, and bytes beside the meshes' files.
//!
//! `cargo run --release -p pompeiu-hausdorff --example certificate_costs -- FOLDER...` measures `a.*` against `b.*` in each folder, on one
//! thread, and prints a table of comma-separated values; each time is a mean.
#![allow(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "a measurement prints, and stops at what it does not expect"
)]

use pompeiu_core::TriMesh;
use pompeiu_core::run::{Limits, on_threads};
use pompeiu_hausdorff::certificate::{CertificateOptions, Goal, write_certificate, write_packed};
use pompeiu_hausdorff::{HausdorffOptions, Tolerance};
use pompeiu_verify::{Soup, verify};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Nanoseconds of processor time that the threads of this process have taken.
fn processor() -> u64 {
    let tasks = fs::read_dir("/proc/self/task").unwrap();
    let first = |task: PathBuf| {
        let text = fs::read_to_string(task.join("schedstat")).unwrap_or_default();
        text.split(' ').next().and_then(|n| n.parse::<u64>().ok()).unwrap_or(0)
    };
    tasks.map(|task| first(task.unwrap().path())).sum()
}

/// Milliseconds that a run takes on average, over as many as take a tenth of a second, and what the last one returned.
fn timed<T>(mut run: impl FnMut() -> T) -> (f64, T) {
    let (before, started, mut count) = (processor(), Instant::now(), 0.0);
    loop {
        let result = run();
        count += 1.0;
        if started.elapsed() > Duration::from_millis(300) {
            // The clock of a thread goes on when it has waited.
            std::thread::sleep(Duration::from_millis(1));
            return ((processor() - before) as f64 / 1e6 / count, result);
        }
    }
}

fn file(folder: &Path, stem: &str) -> PathBuf {
    let mut files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.find(|path| path.file_stem().is_some_and(|name| name == stem)).unwrap()
}

fn main() {
    on_threads(Limits::threads(1).ok(), measure_all);
}

fn measure_all() {
    println!(
        "pair,faces_a,faces_b,slack,upper,engine_ms,write_ms,verify_ms,cells_a,cells_b,bytes,obj_bytes,write_factor,verify_factor,share_of_obj"
    );
    let mut slacks = vec![0.0];
    for argument in std::env::args().skip(1) {
        if let Ok(slack) = argument.parse::<f64>() {
            slacks = vec![slack];
            continue;
        }
        let folder = PathBuf::from(argument);
        let [a, b] = ["a", "b"].map(|stem| pompeiu_io::read(file(&folder, stem)).unwrap().mesh);
        for slack in slacks.iter().copied() {
            println!("{},{}", folder.file_name().unwrap().to_string_lossy(), measure(&a, &b, slack));
        }
    }
}

/// The bytes of a mesh as OBJ.
fn obj(mesh: &TriMesh) -> usize {
    let mut bytes = Vec::new();
    pompeiu_io::encode(
        &mut bytes,
        pompeiu_io::OutputFormat::Obj,
        mesh,
        &pompeiu_io::Attributes::for_mesh(mesh),
    )
    .unwrap();
    bytes.len()
}

fn measure(a: &TriMesh, b: &TriMesh, slack: f64) -> String {
    let options =
        HausdorffOptions { tolerance: Tolerance::RelativeToDiagonal(1e-8), ..HausdorffOptions::default() };
    let (engine, report) = timed(|| options.symmetric(a, b).unwrap());
    let diagonal = report.a_to_b.tolerance / 1e-8;
    let (write, written) = timed(|| {
        let mut bytes = Vec::new();
        let goals = Goal::of_both(&report, slack * diagonal);
        let options = CertificateOptions::default();
        let made = write_packed(&mut bytes, |into| write_certificate(a, b, goals, &options, into));
        made.map(|made| (made, bytes))
    });
    let size = obj(a) + obj(b);
    let start = format!(
        "{},{},{slack:e},{:e},{engine:.1},{write:.1}",
        a.faces().len(),
        b.faces().len(),
        report.distance.upper()
    );
    let (made, bytes) = match written {
        Ok(written) => written,
        Err(error) => return format!("{start},{error}"),
    };
    let [soup_a, soup_b] = [a, b].map(|mesh| Soup::new(mesh.positions(), mesh.faces()).unwrap());
    let (check, verified) = timed(|| verify(&soup_a, &soup_b, bytes.as_slice(), 1));
    verified.unwrap_or_else(|error| panic!("{error}"));
    let cells = [made.a_to_b, made.b_to_a].map(|claim| claim.unwrap().cells);
    let [by_write, by_verify] = [write, check].map(|time| time / engine);
    let share = bytes.len() as f64 / size as f64;
    format!(
        "{start},{check:.1},{},{},{},{size},{by_write:.2},{by_verify:.2},{share:.3}",
        cells[0],
        cells[1],
        bytes.len()
    )
}
