//! The narrowest necks of puzzles, how many borders have no tab, and whether all pieces are locked:
//! `cargo run --release -p pompeiu-puzzle --example necks`.
#![allow(clippy::print_stdout, reason = "a table for people")]

use pompeiu_planar::{Outline, ShapeError};
use pompeiu_puzzle::{Layout, PuzzleOptions, Tab, make, report};
use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    for layout in [Layout::Grid, Layout::Hexagons, Layout::Voronoi] {
        for tab in [Tab::Knob, Tab::Dovetail] {
            for pieces in [24, 200, 1000] {
                row(
                    "rectangle",
                    &PuzzleOptions { layout, tab, pieces, seed: 1, ..PuzzleOptions::default() },
                )?;
            }
        }
        for (name, outline) in outlines()? {
            for pieces in [12, 40, 100, 400] {
                let outline = Some(outline.clone());
                row(name, &PuzzleOptions { layout, pieces, outline, seed: 1, ..PuzzleOptions::default() })?;
            }
        }
    }
    Ok(())
}

fn row(name: &str, options: &PuzzleOptions) -> Result<(), Box<dyn Error>> {
    let PuzzleOptions { layout, tab, pieces, .. } = options;
    let started = std::time::Instant::now();
    let puzzle = make(options)?;
    let made = started.elapsed();
    let found = report(&puzzle);
    let neck = found.narrowest().map_or(f64::NAN, |(_, neck)| neck.width);
    println!(
        "{name} {layout:?} {tab:?} {pieces}: {} pieces, least neck {neck:.3} = {:.3} sides, {} of {} borders without a tab, {} clusters, {made:.0?}",
        puzzle.pieces(),
        neck / found.unit(),
        found.without_tab.len(),
        puzzle.borders().iter().filter(|border| border.right.is_some()).count(),
        found.clusters.len(),
    );
    Ok(())
}

/// A disc, a gear, a star, a flower and a spiral.
fn outlines() -> Result<[(&'static str, Outline); 5], ShapeError> {
    let polar = |n: usize, radius: &dyn Fn(f64) -> f64| {
        let at = |i: usize| {
            let angle = std::f64::consts::TAU * (i as f64 + 0.137) / n as f64;
            let (sine, cosine) = libm::sincos(angle);
            [radius(angle) * cosine, radius(angle) * sine]
        };
        Outline::new((0..n).map(at).collect())
    };
    let spiral = |side: f64, k: usize| {
        let angle = 0.1 + 0.1 * k as f64;
        let (sine, cosine) = libm::sincos(angle);
        let radius = 5.0 + 2.0 * angle + side;
        [radius * cosine, radius * sine]
    };
    let inner = (0..120).map(|k| spiral(-2.0, k));
    let points = inner.chain((0..120).rev().map(|k| spiral(2.0, k))).collect();
    Ok([
        ("disc", polar(200, &|_| 1.0)?),
        ("gear", polar(600, &|a| 1.0 + 0.3 * libm::tanh(6.0 * libm::sin(12.0 * a)))?),
        ("star", polar(10, &|a| 1.0 + 0.5 * libm::cos(5.0 * a))?),
        ("flower", polar(300, &|a| 1.0 + 0.8 * libm::cos(5.0 * a))?),
        ("spiral", Outline::new(points)?),
    ])
}
