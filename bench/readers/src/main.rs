//! Reading speed of pompeiu-io beside other readers; see README.md.

mod files;
mod readers;

use cpu_time::ProcessTime;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::mesh::{displace_at_random, shuffle};
use std::fs::File;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Subdivisions of the sphere: 20 · 4⁸ = 1 310 720 faces.
const LEVELS: u32 = 8;

/// How far each vertex is moved, in radii: coordinates then need all their digits.
const NOISE: f64 = 5e-4;

/// Timed runs per reader and file.
const RUNS: usize = 11;

type Reader = (&'static str, fn(&Path) -> usize);

fn main() -> io::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        ["peak", path] => peak(Path::new(path)),
        [] => compare(&std::env::temp_dir().join(format!("bench-readers-{}", std::process::id())), false),
        ["keep", folder] => compare(Path::new(folder), true),
        ["file", path] => {
            let path = Path::new(path);
            measure(path, &[("pompeiu-io", readers::ours)], readers::ours(path))
        }
        _ => {
            eprintln!("usage: bench-readers [file FILE | peak FILE | keep FOLDER]");
            std::process::exit(2);
        }
    }
}

fn compare(folder: &Path, keep: bool) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let sphere = icosphere(1.0, LEVELS).map_err(io::Error::other)?;
    let sphere = displace_at_random(&sphere, NOISE, 1).map_err(io::Error::other)?;
    let mesh = (sphere.positions(), sphere.faces());
    let mixed = shuffle(&sphere, 2);
    let mixed = (mixed.positions(), mixed.faces());
    let make = |name: &str, write: &dyn Fn(&mut BufWriter<File>) -> io::Result<()>| -> io::Result<PathBuf> {
        let path = folder.join(name);
        let mut out = BufWriter::new(File::create(&path)?);
        write(&mut out)?;
        Ok(path)
    };
    let tobj: &[Reader] = &[("tobj", readers::tobj)];
    let ply: &[Reader] = &[("ply-rs-bw", readers::ply_rs_bw)];
    let stl: &[Reader] = &[("stl_io", readers::stl_io)];
    let cases = [
        (make("six_digits.obj", &|out| files::obj(mesh, Some(6), out))?, tobj),
        (make("all_digits.obj", &|out| files::obj(mesh, None, out))?, tobj),
        (make("normals.obj", &|out| files::obj_with_normals(mesh, out))?, tobj),
        (make("float.ply", &|out| files::ply(mesh, false, out))?, ply),
        (make("double.ply", &|out| files::ply(mesh, true, out))?, ply),
        (make("ascii.ply", &|out| files::ply_ascii(mesh, out))?, ply),
        (make("binary.stl", &|out| files::stl(mesh, out))?, stl),
        (make("shuffled.stl", &|out| files::stl(mixed, out))?, stl),
        (make("ascii.off", &|out| files::off(mesh, out))?, &[]),
    ];
    println!("{} vertices, {} faces", mesh.0.len(), mesh.1.len());
    println!(
        "{:<16} {:>7}  {:<10} {:>12} {:>12} {:>12}",
        "file", "MB", "reader", "median MB/s", "best MB/s", "CPU ms"
    );
    for (path, others) in cases {
        let all: Vec<Reader> =
            [("pompeiu-io", readers::ours as fn(&Path) -> usize)].iter().chain(others).copied().collect();
        measure(&path, &all, mesh.1.len())?;
    }
    if !keep {
        std::fs::remove_dir_all(folder)?;
    }
    Ok(())
}

fn measure(path: &Path, all: &[Reader], faces: usize) -> io::Result<()> {
    let megabytes = path.metadata()?.len() as f64 / 1e6;
    let mut times = vec![Vec::new(); all.len()];
    for run in 0..=RUNS {
        for ((name, read), times) in all.iter().zip(&mut times) {
            let (start, cpu) = (Instant::now(), ProcessTime::now());
            let found = read(path);
            let time = (start.elapsed().as_secs_f64(), cpu.elapsed().as_secs_f64());
            assert_eq!(found, faces, "{name} on {}", path.display());
            // The first run warms the cache.
            if run > 0 {
                times.push(time);
            }
        }
    }
    for ((name, _), times) in all.iter().zip(&mut times) {
        let (mut wall, mut cpu): (Vec<f64>, Vec<f64>) = times.iter().copied().unzip();
        wall.sort_by(f64::total_cmp);
        cpu.sort_by(f64::total_cmp);
        println!(
            "{:<16} {:>7.1}  {:<10} {:>12.0} {:>12.0} {:>12.1}",
            path.file_name().unwrap_or_default().to_string_lossy(),
            megabytes,
            name,
            megabytes / wall[wall.len() / 2],
            megabytes / wall[0],
            1e3 * cpu[cpu.len() / 2],
        );
    }
    Ok(())
}

/// Reads one file and prints the peak memory of the process, kernel's own count.
fn peak(path: &Path) -> io::Result<()> {
    let before = high_water()?;
    let read = pompeiu_io::read(path).expect("a mesh");
    let after = high_water()?;
    let faces = read.mesh.faces().len();
    let output = 24 * read.mesh.positions().len() + 12 * faces;
    let mapped = if read.compressed { 0 } else { path.metadata()?.len() as usize };
    let grown = after - before;
    println!("{faces} faces, output {:.1} bytes per face", output as f64 / faces as f64);
    println!(
        "peak {:.1} bytes per face, of which at most {:.1} are the mapped file",
        grown as f64 / faces as f64,
        mapped as f64 / faces as f64
    );
    Ok(())
}

fn high_water() -> io::Result<usize> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or_default();
    Ok(line.split_whitespace().next().and_then(|kib| kib.parse::<usize>().ok()).unwrap_or(0) * 1024)
}
