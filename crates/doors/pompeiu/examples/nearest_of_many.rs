//! Ranks meshes by how far they are from one reference, whose tree is built once:
//!
//! ```sh
//! cargo run --release --example nearest_of_many examples/meshes/sphere.obj examples/meshes/*.obj
//! ```

#![allow(clippy::print_stdout, reason = "this program is there to print")]

use pompeiu::prelude::*;

fn main() -> anyhow::Result<()> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let [reference, candidates @ ..] = files.as_slice() else {
        anyhow::bail!("expected a reference mesh, and the meshes to rank");
    };
    let target = Target::new(&read_mesh(reference)?);
    let options =
        HausdorffOptions { tolerance: Tolerance::RelativeToDistance(1e-3), ..HausdorffOptions::default() };

    let measure = |file| Ok((options.directed_to(&read_mesh(file)?, &target)?.distance, file));
    let mut ranking = candidates.iter().map(measure).collect::<anyhow::Result<Vec<_>>>()?;
    ranking.sort_by(|(one, _), (other, _)| one.upper().total_cmp(&other.upper()));

    for (distance, file) in ranking {
        println!("h in {distance:.4}  {file}");
    }
    Ok(())
}
