//! Simplifies a mesh: within a share of its diagonal, or with `fast` or `best` to a share of its faces:
//! `cargo run --release --example simplify -- MESH SHARE [fast|best]`.

use pompeiu_core::geom::Aabb;
use pompeiu_remesh::{Effort, SimplifyOptions, SimplifyTarget, simplify};
use std::time::Instant;

#[allow(clippy::print_stdout, reason = "an example prints what it found")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, share, effort @ ..] = &arguments[..] else {
        return Err("usage: simplify MESH SHARE [fast|best]".into());
    };
    let mesh = pompeiu_io::read_mesh(file)?;
    let (share, diagonal) = (share.parse::<f64>()?, Aabb::of_faces(&mesh).diagonal());
    let target = match effort {
        [] => SimplifyTarget::Within(share * diagonal),
        _ => SimplifyTarget::Faces((share * mesh.faces().len() as f64) as usize),
    };
    let effort = if effort == ["fast"] { Effort::Fast } else { Effort::Best };
    let started = Instant::now();
    let found = simplify(&mesh, &SimplifyOptions { effort, ..SimplifyOptions::new(target) })?;
    let (lower, upper) = (found.distance.distance.lower(), found.distance.distance.upper());
    println!("{} faces to {}", mesh.faces().len(), found.mesh.faces().len());
    println!("distance between {lower} and {upper}, {:.4} % of the diagonal", 100.0 * upper / diagonal);
    println!("{:.2} s, {:?}", started.elapsed().as_secs_f64(), found.timing);
    if let Some(path) = std::env::var_os("OUT") {
        pompeiu_io::write(path, &found.mesh)?;
    }
    Ok(())
}
