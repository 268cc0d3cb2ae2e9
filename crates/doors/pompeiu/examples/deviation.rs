//! Where and how much two meshes deviate, with a page to explore:
//!
//! ```sh
//! cargo run --release --example deviation examples/meshes/sphere.obj examples/meshes/torus.obj deviation.html
//! ```

#![allow(clippy::print_stdout, reason = "this program is there to print")]

use pompeiu::core::run::Limits;
use pompeiu::hausdorff::PreparedPair;
use pompeiu::hausdorff::show::{DeviationPage, search_stages};
use pompeiu::prelude::*;

fn main() -> anyhow::Result<()> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let [a_path, b_path, page] = files.as_slice() else {
        anyhow::bail!("expected two meshes, and the page to write");
    };
    let pair = PreparedPair::new(read_mesh(a_path)?, read_mesh(b_path)?);
    let deviation = DeviationOptions { regions: 3, ..DeviationOptions::default() }.symmetric_of(&pair)?;

    for (meaning, directed) in [("missing", &deviation.a_to_b), ("excess", &deviation.b_to_a)] {
        println!("{meaning}: the largest distance lies in {:.4}", directed.distance.distance);
        if let Some(statistics) = &directed.statistics {
            println!("  mean {:.4}, root mean square {:.4}", statistics.mean, statistics.rms);
        }
        for region in &directed.regions {
            println!("  {} faces around {:?} reach {:.4}", region.faces.len(), region.centre, region.peak);
        }
    }
    let limits = Limits::default();
    let page_of = DeviationPage {
        pair: &pair,
        paths: [a_path, b_path],
        names: ["A", "B"],
        deviation: &deviation,
        stages: &search_stages(&pair, &limits),
        unit: "",
        up: [0.0, 0.0, 1.0],
        threshold: None,
        bands: None,
        verdict: None,
        proof: None,
        command: None,
    };
    pompeiu::io::write_whole(page, page_of.figures(&limits).html()?.as_bytes())?;
    Ok(())
}
