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
    println!("layout     tab       pieces  sheet / puzzle  used   filled  seconds");
    for (layout, tab) in [
        (Layout::Grid, Tab::None),
        (Layout::Grid, Tab::Knob),
        (Layout::Hexagons, Tab::Knob),
        (Layout::Voronoi, Tab::Dovetail),
    ] {
        for pieces in [24, 100] {
            let side = (2500.0 * pieces as f64).sqrt();
            let options = PuzzleOptions {
                layout,
                tab,
                pieces,
                size: [1.2 * side, side / 1.2],
                ..PuzzleOptions::default()
            };
            let puzzle = make(&options)?;
            // The least sheet, in steps of 5 %, that has room.
            for percent in (110..300).step_by(5) {
                let scale = (f64::from(percent) / 100.0).sqrt();
                let sheet = options.size.map(|x| scale * x);
                let started = Instant::now();
                let Ok(packing) = pack(&puzzle, sheet, 0.3, &Control::default()) else { continue };
                let (seconds, whole) = (started.elapsed().as_secs_f64(), f64::from(percent) / 100.0);
                println!(
                    "{:<10} {:<9} {pieces:<7} {whole:<15.2} {:<6.3} {:<7.3} {seconds:.2}",
                    format!("{layout:?}"),
                    format!("{tab:?}"),
                    packing.used,
                    packing.filled
                );
                break;
            }
        }
    }
    Ok(())
}
