//! Flattens meshes: `cargo run --release -p pompeiu-flatten --example flatten -- [auto] [SECONDS] MESH…`, into as many charts as are needed
//! with `auto`, within a time.

#![allow(clippy::print_stdout, reason = "an example")]

use pompeiu_core::run::Limits;
use pompeiu_flatten::{Charts, FlattenOptions, flatten};
use pompeiu_surface::EmbeddedSurface;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "mesh, charts, flipped, overlapping, seam, symmetric Dirichlet, ratio, steps, ms: cut, factor, solve, check, total"
    );
    let mut options = FlattenOptions::default();
    for path in std::env::args().skip(1) {
        if path == "auto" {
            options.charts = Charts::Auto;
            continue;
        }
        if let Ok(seconds) = path.parse() {
            options.limits.time = Some(Limits::seconds(seconds)?);
            continue;
        }
        let surface = EmbeddedSurface::new(&pompeiu_io::read_mesh(&path)?)?;
        let report = flatten(&surface, &options)?.report;
        let ms = |span: std::time::Duration| span.as_millis();
        let timing = report.timing;
        println!(
            "{path}: {}, {}, {}, {:.2}, {:.3}, {:.1e}, {}, {} {} {} {} {}",
            report.charts,
            report.flipped,
            report.overlapping,
            report.cut.relative_length,
            report.distortion.symmetric_dirichlet.mean,
            report.distortion.least_singular_ratio,
            report.steps,
            ms(timing.cut),
            ms(timing.factor),
            ms(timing.solve),
            ms(timing.check),
            ms(timing.total)
        );
    }
    Ok(())
}
