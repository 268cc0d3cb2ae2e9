//! Times the contours of pictures at the level 0.5 for `bench/planar`. Arguments: a file of little-endian 32-bit floats, and the
//! side of a picture in pixels.
//!
//! ```sh
//! cargo run --release --package pompeiu-planar --example contours -- pictures.f32 256
//! ```

#![allow(clippy::print_stdout, reason = "an example prints")]

use pompeiu_planar::contour::contours;
use std::time::{Duration, Instant};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let path = arguments.next().ok_or("name a file of levels")?;
    let side: usize = arguments.next().ok_or("say the side of a picture")?.parse()?;
    let bytes = std::fs::read(path)?;
    let (mut points, mut took) = (0, Duration::ZERO);
    for picture in bytes.chunks_exact(4 * side * side) {
        let levels: Vec<f32> =
            picture.as_chunks::<4>().0.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
        let started = Instant::now();
        let found = contours(&levels, side, 0.5);
        took += started.elapsed();
        points += found.iter().map(|contour| contour.points.len()).sum::<usize>();
    }
    // Single-threaded and without waiting, so wall time is processor time unless the machine is busy.
    let milliseconds = took.as_secs_f64() * 1000.0;
    println!("{{\"points\":{points},\"cpu_ms\":{milliseconds},\"wall_ms\":{milliseconds}}}");
    Ok(())
}
