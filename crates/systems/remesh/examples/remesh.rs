//! Remeshes with a share of the mean edge length: `cargo run --release --example remesh -- MESH SHARE`.

use pompeiu_remesh::{Quality, RemeshOptions, Sizing, remesh};

#[allow(clippy::print_stdout, reason = "an example prints what it found")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, share] = &arguments[..] else { return Err("usage: remesh MESH SHARE".into()) };
    let mesh = pompeiu_io::read_mesh(file)?;
    let length = share.parse::<f64>()? * Quality::of(&mesh)?.edge_length.mean;
    let found = remesh(&mesh, &RemeshOptions::new(Sizing::Length(length)))?;
    println!("{:#?}", found.after);
    println!("{:?} {:?}", found.distance.map(|d| d.distance), found.timing);
    if let Some(path) = std::env::var_os("OUT") {
        pompeiu_io::write(path, &found.mesh)?;
    }
    Ok(())
}
