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
    let report = symmetric_hausdorff(&pompeiu::io::read(a)?.mesh, &pompeiu::io::read(b)?.mesh);

    println!("{} <= H <= {}", report.distance().lower(), report.distance().upper());
    for (from, to, directed) in [(a, b, report.a_to_b), (b, a, report.b_to_a)] {
        println!("{} <= h <= {} from {from} to {to}", directed.distance.lower(), directed.distance.upper());
        let [far, near] = [directed.witness.a, directed.witness.b];
        println!("  farthest point   {:?} on face {}", far.position, far.face.index());
        println!("  nearest to that  {:?} on face {}", near.position, near.face.index());
    }
    Ok(())
}
