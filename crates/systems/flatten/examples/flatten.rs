//! Flattens meshes with default options: `cargo run --release -p pompeiu-flatten --example flatten -- MESH…`.

#![allow(clippy::print_stdout, reason = "an example")]

use pompeiu_flatten::{FlattenOptions, flatten};
use pompeiu_surface::EmbeddedSurface;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(
        "mesh, charts, flipped, overlapping, seam, symmetric Dirichlet, ratio, steps, ms: cut, factor, solve, check, total"
    );
    for path in std::env::args().skip(1) {
        let surface = EmbeddedSurface::new(&pompeiu_io::read_mesh(&path)?)?;
        let report = flatten(&surface, &FlattenOptions::default())?.report;
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
