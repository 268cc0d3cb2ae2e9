//! Which of these meshes is most like that one, wherever they lie? Only as much is computed as the answer needs:
//!
//! ```sh
//! cargo run --release --example best_match examples/meshes/rough-sphere.obj examples/meshes/*.obj
//! ```

#![allow(clippy::print_stdout, reason = "this program is there to print")]

use pompeiu::matching::align::Alignment;
use pompeiu::matching::rank::{RankOptions, rank_meshes};
use pompeiu::prelude::*;

fn main() -> anyhow::Result<()> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let [template, targets @ ..] = files.as_slice() else {
        anyhow::bail!("expected a template, and the meshes to rank");
    };
    let meshes = targets.iter().map(read_mesh).collect::<Result<Vec<_>, _>>()?;
    let options = RankOptions { top: 3, alignment: Alignment::Centroid, ..RankOptions::default() };
    let report = rank_meshes(&read_mesh(template)?, &meshes, &options)?;
    for standing in &report.standings {
        println!("{:?} {:?}: {}", standing.ranks, standing.status, targets[standing.target]);
    }
    Ok(())
}
