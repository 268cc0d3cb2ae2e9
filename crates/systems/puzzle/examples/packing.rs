//! How much of a sheet packed pieces fill, and the time that it takes.
//!
//! ```sh
//! cargo run --release --package pompeiu-puzzle --example packing
//! ```

#![allow(clippy::print_stdout, reason = "an example prints")]

use pompeiu_core::run::Control;
use pompeiu_puzzle::{Layout, PuzzleOptions, Tab, make, pack};
use std::error::Error;
use std::time::Instant;

fn main() -> Result<(), Box<dyn Error>> {
    println!("layout     tab       pieces  kerf  filled  seconds");
    for (layout, tab) in [
        (Layout::Grid, Tab::None),
        (Layout::Grid, Tab::Knob),
        (Layout::Hexagons, Tab::Knob),
        (Layout::Voronoi, Tab::Dovetail),
    ] {
        for (pieces, kerf) in [(20, 0.2), (50, 0.2), (50, 1.0), (100, 0.2), (300, 0.2), (1000, 0.2)] {
            let side = (2500.0 * pieces as f64).sqrt();
            let options = PuzzleOptions {
                layout,
                tab,
                pieces,
                size: [1.2 * side, side / 1.2],
                ..PuzzleOptions::default()
            };
            let puzzle = make(&options)?;
            // On twice the area all pieces have room.
            let sheet = options.size.map(|x| 2.0_f64.sqrt() * x);
            let started = Instant::now();
            let packing = pack(&puzzle, sheet, kerf, &Control::default())?;
            let seconds = started.elapsed().as_secs_f64();
            println!(
                "{:<10} {:<9} {pieces:<7} {kerf:<5} {:<7.3} {seconds:.2}",
                format!("{layout:?}"),
                format!("{tab:?}"),
                packing.filled
            );
        }
    }
    Ok(())
}
