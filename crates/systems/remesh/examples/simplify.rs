//! Simplifies a mesh within a share of its diagonal: `cargo run --release --example simplify -- MESH SHARE`.

use pompeiu_core::geom::Aabb;
use pompeiu_remesh::{SimplifyOptions, SimplifyTarget, simplify};
use std::time::Instant;

#[allow(clippy::print_stdout, reason = "an example prints what it found")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, share] = &arguments[..] else { return Err("usage: simplify MESH SHARE".into()) };
    let mesh = pompeiu_io::read_mesh(file)?;
    let within = share.parse::<f64>()? * Aabb::of_faces(&mesh).diagonal();
    let started = Instant::now();
    let found = simplify(&mesh, &SimplifyOptions::new(SimplifyTarget::Within(within)))?;
    let (lower, upper) = (found.distance.distance.lower(), found.distance.distance.upper());
    println!("{} faces to {}", mesh.faces().len(), found.mesh.faces().len());
    println!("distance between {lower} and {upper}, at most {within} asked for");
    println!("{:.2} s, {:?}", started.elapsed().as_secs_f64(), found.timing);
    Ok(())
}
