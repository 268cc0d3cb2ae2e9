//! Compares infinitesimal and finite motions: random puzzles of 4 to 9 pieces, tested by `lock` and by shaking.
//!
//! ```sh
//! cargo run --release --package pompeiu-puzzle --example motions -- 1000 bench/record/motions.csv
//! ```

#![allow(clippy::print_stdout, reason = "an example prints")]

use pompeiu_core::mesh::edit::Random;
use pompeiu_puzzle::{Layout, Proof, Puzzle, PuzzleError, PuzzleOptions, Tab, lock, make, report, shake};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Random displacements for each puzzle.
const TRIES: usize = 24;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let count: u64 = arguments.next().map_or(Ok(100), |text| text.parse())?;
    let outcomes: Vec<(u64, usize, Proof, bool, Option<f64>)> = (0..count)
        .into_par_iter()
        .map(|seed| {
            let puzzle = random_puzzle(seed)?;
            let (proof, moves) = (lock(&puzzle).proof, shake(&puzzle, TRIES, seed).is_some());
            // Shaking cannot detect a shallow lock: record the depth of those that moved.
            let is_locked = matches!(proof, Proof::Merging | Proof::Multipliers);
            let depth = (is_locked && moves).then(|| report(&puzzle).depth).flatten();
            Ok((seed, puzzle.pieces(), proof, moves, depth))
        })
        .collect::<Result<_, PuzzleError>>()?;
    let mut table: BTreeMap<(String, bool), usize> = BTreeMap::new();
    let mut rows = String::from("seed,pieces,proof,moves_when_shaken,agree,depth\n");
    let mut agree = 0;
    for (seed, pieces, proof, moves, depth) in &outcomes {
        let is_locked = matches!(proof, Proof::Merging | Proof::Multipliers);
        agree += usize::from(is_locked != *moves);
        *table.entry((format!("{proof:?}"), *moves)).or_default() += 1;
        let depth = depth.map_or(String::new(), |depth| depth.to_string());
        writeln!(rows, "{seed},{pieces},{proof:?},{moves},{},{depth}", is_locked != *moves)?;
    }
    for ((proof, moves), number) in table {
        println!("{proof:<12} {} {number}", if moves { "moves when shaken " } else { "stays when shaken " });
    }
    println!("agreement    {agree} of {count}");
    if let Some(path) = arguments.next() {
        std::fs::write(path, rows)?;
    }
    Ok(())
}

/// A puzzle in which some borders are straight and some have a tab with a corner cut off.
fn random_puzzle(seed: u64) -> Result<Puzzle, PuzzleError> {
    let mut random = Random::new(seed);
    let tab = if seed.is_multiple_of(2) { Tab::Knob } else { Tab::Dovetail };
    let layout = if seed.is_multiple_of(3) { Layout::Grid } else { Layout::Voronoi };
    let pieces = 4 + random.below(6) as usize;
    let mut puzzle = make(&PuzzleOptions { pieces, tab, layout, seed, ..PuzzleOptions::default() })?;
    let inner: Vec<usize> =
        (0..puzzle.borders().len()).filter(|border| puzzle.borders()[*border].right.is_some()).collect();
    for border in inner {
        let mut course = puzzle.border_points(border);
        let n = course.len();
        match random.below(3) {
            0 => course = vec![course[0], course[n - 1]],
            1 if n > 5 => {
                course.remove(2);
            }
            _ => continue,
        }
        // The tab may collide with that of another border.
        puzzle = puzzle.with_border(border, &course).unwrap_or(puzzle);
    }
    Ok(puzzle)
}
