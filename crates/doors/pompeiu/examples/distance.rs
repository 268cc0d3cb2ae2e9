//! Prints an enclosure of the distance between two meshes, and where it is attained:
//!
//! ```sh
//! cargo run --release --example distance examples/meshes/lantern.obj examples/meshes/cylinder.obj
//! ```

#![allow(clippy::print_stdout, reason = "this program is there to print")]

use pompeiu::prelude::*;

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [a, b] = arguments.as_slice() else {
        anyhow::bail!("expected two arguments: mesh A and mesh B");
    };
    let report = symmetric_hausdorff(&read_mesh(a)?, &read_mesh(b)?);

    println!("H in {}", report.distance);
    for (from, to, directed) in [(a, b, report.a_to_b), (b, a, report.b_to_a)] {
        println!("h in {} from {from} to {to}", directed.distance);
        let Witness { from, to } = directed.witness;
        println!("  farthest point   {:?} on face {}", from.position, from.face);
        println!("  nearest to that  {:?} on face {}", to.position, to.face);
    }
    Ok(())
}
