//! Checks skeletons, given as SWC files, and says of each whether it can be meshed, its problems and the seconds.
//!
//! `cargo run --release -p pompeiu-neuron --example check -- FILE...`

use pompeiu_neuron::{MeshOptions, Preparation, Problem, meshability, prepare};
use std::time::Instant;

#[expect(clippy::print_stdout, reason = "an example")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let preparation = Preparation { repair: true, ..Preparation::default() };
    for path in std::env::args().skip(1) {
        let prepared = prepare(&std::fs::read(&path)?, &preparation)?;
        let started = Instant::now();
        let found = meshability(&prepared.skeleton, &MeshOptions::default())?;
        let seconds = started.elapsed().as_secs_f64();
        println!("{path}: meshable {:?}, {seconds:.2} s", found.meshable);
        for Problem { kind, sample, message, .. } in &found.problems {
            println!("  {kind:?} at {sample}: {message}");
        }
    }
    Ok(())
}
