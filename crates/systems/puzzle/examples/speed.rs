//! Processor time and wall time of one part, as JSON, for `bench/planar`.
//!
//! ```sh
//! cargo run --release --package pompeiu-puzzle --example speed -- map
//! ```

#![allow(clippy::print_stdout, reason = "an example prints")]

use pompeiu_planar::{Outline, Point};
use pompeiu_puzzle::{
    Answer, LikeOptions, Map, Method, PieceName, PieceShape, PuzzleOptions, Tab, Variant, make_like, register,
};
use std::time::Instant;

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

/// Number of repetitions.
const REPEATS: u32 = 20;

fn main() -> Outcome<()> {
    let mut arguments = std::env::args().skip(1);
    match arguments.next().as_deref() {
        Some("register") => registration(&arguments.next().ok_or("name a file of points")?),
        Some("map") => map(),
        Some("lloyd") => lloyd(),
        _ => Err("say register FILE, map or lloyd".into()),
    }
}

/// Processor time of this process so far, in milliseconds.
fn processor() -> f64 {
    let text = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    // After the name in parentheses: the 12th and 13th fields, in hundredths of a second.
    let fields: Vec<&str> = text.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |i: usize| fields.get(i).and_then(|text| text.parse::<f64>().ok()).unwrap_or(0.0);
    10.0 * (ticks(11) + ticks(12))
}

/// Mean processor time and wall time of a part, in milliseconds, over some repetitions.
fn timed(mut part: impl FnMut()) -> (f64, f64) {
    part();
    let (before, started) = (processor(), Instant::now());
    (0..REPEATS).for_each(|_| part());
    let wall = started.elapsed().as_secs_f64() * 1000.0;
    ((processor() - before) / f64::from(REPEATS), wall / f64::from(REPEATS))
}

/// Registers the first half of the points on the second half.
fn registration(path: &str) -> Outcome<()> {
    let text = std::fs::read_to_string(path)?;
    let points: Vec<Point> = text
        .lines()
        .map(|line| {
            let mut numbers = line.split_whitespace().map(str::parse);
            Ok([numbers.next().ok_or("a line is empty")??, numbers.next().ok_or("a line has one number")??])
        })
        .collect::<Outcome<_>>()?;
    let (shape, other) = points.split_at(points.len() / 2);
    let found = register(shape, other, false).ok_or("no registration")?;
    let (cpu, wall) = timed(|| {
        std::hint::black_box(register(shape, other, false));
    });
    println!("{{\"cpu_ms\":{cpu},\"wall_ms\":{wall},\"rms\":{}}}", found.rms);
    Ok(())
}

/// A table of 200² values of a shape with 256 sides.
fn map() -> Outcome<()> {
    let bird = PieceName::Bird.outline().ok_or("no bird")?;
    let shape = Outline::new(pompeiu_planar::resample(&bird, 256, 0))?;
    let (cpu, wall) = timed(|| {
        std::hint::black_box(Map::new(&shape, Answer::Least, Variant::Edges, 200));
    });
    println!("{{\"cpu_ms\":{cpu},\"wall_ms\":{wall}}}");
    Ok(())
}

/// A round of Lloyd's method on a million pixels: 24² per piece, hence 1,736 sites. Includes the borders at the end.
fn lloyd() -> Outcome<()> {
    let options =
        PuzzleOptions { pieces: 1736, size: [1.0, 1.0], tab: Tab::None, ..PuzzleOptions::default() };
    let method = Method::Lloyd { answer: Answer::SignedDistance, variant: Variant::Edges, feedback: false };
    let like = LikeOptions { shape: PieceShape::Built(PieceName::Bird), method, ..LikeOptions::default() };
    let (before, started) = (processor(), Instant::now());
    let made = make_like(&options, &like)?;
    let rounds = made.energy.len() as f64;
    let (cpu, wall) = ((processor() - before) / rounds, started.elapsed().as_secs_f64() * 1000.0 / rounds);
    println!("{{\"cpu_ms\":{cpu},\"wall_ms\":{wall}}}");
    Ok(())
}
