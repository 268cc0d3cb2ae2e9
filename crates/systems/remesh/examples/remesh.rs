//! Remeshes with a share of the mean edge length:
//! `cargo run --release --example remesh -- MESH SHARE [within=SHARE] [features=ANGLE] [adaptive=SHARE] [seconds=LIMIT]`, shares of the
//! diagonal.

use pompeiu_core::geom::Aabb;
use pompeiu_core::run::Limits;
use pompeiu_remesh::{Features, Intersections, Quality, RemeshOptions, Sizing, remesh};
use std::time::Instant;

#[allow(clippy::print_stdout, reason = "an example prints what it found")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, share, further @ ..] = &arguments[..] else {
        return Err(
            "usage: remesh MESH SHARE [within=SHARE] [features=ANGLE] [adaptive=SHARE] [seconds=LIMIT]"
                .into(),
        );
    };
    let mesh = pompeiu_io::read_mesh(file)?;
    let diagonal = Aabb::of_faces(&mesh).diagonal();
    let length = share.parse::<f64>()? * Quality::of(&mesh)?.edge_length.mean;
    let mut options =
        RemeshOptions { intersections: Intersections::Report, ..RemeshOptions::new(Sizing::Length(length)) };
    for word in further {
        let (name, value) = word.split_once('=').ok_or("expected name=value")?;
        let value: f64 = value.parse()?;
        match name {
            "within" => options.within = Some(value * diagonal),
            "seconds" => options.limits.time = Some(Limits::seconds(value)?),
            "features" => options.features = Features { angle: Some(value), ..Features::default() },
            "adaptive" => {
                let between = [1e-4, 0.1].map(|share| share * diagonal);
                options.sizing = Sizing::ChordHeight { tolerance: value * diagonal, between };
            }
            _ => return Err(format!("unknown option {name}").into()),
        }
    }
    let started = Instant::now();
    let found = remesh(&mesh, &options)?;
    let least = found.after.least_angle;
    println!("{} faces, angles from {:.4}, mean {:.2}", found.after.faces, least.least, least.mean);
    println!("{:?}, {:?}", found.intersections, found.stop);
    let distance = found.distance.map_or(0.0, |report| report.distance.upper());
    println!("distance {:.5} % of the diagonal", 100.0 * distance / diagonal);
    println!("{:.2} s, {:?}", started.elapsed().as_secs_f64(), found.timing);
    if let Some(path) = std::env::var_os("OUT") {
        pompeiu_io::write(path, &found.mesh)?;
    }
    Ok(())
}
