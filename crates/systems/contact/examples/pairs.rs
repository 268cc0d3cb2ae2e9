//! Distances, gradients and times of impact of pairs in a file, for the comparison with another program (`bench/contact`).
//!
//! Input: 25 doubles for each pair, 0 for a point and a triangle or 1 for two edges, 12 coordinates, 12 displacements. Output: 14 doubles,
//! the squared distance, its gradient, and the time of impact or infinity. Seconds of both parts are printed.

#![allow(clippy::print_stdout, reason = "its output is read by the comparison")]

use glam::DVec3;
use pompeiu_contact::Kind;
use pompeiu_contact::ccd::time_of_impact;
use pompeiu_contact::distance::Closest;
use std::time::Instant;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = &files[..] else {
        return Err("expected the files of the input and the output".into());
    };
    let bytes = std::fs::read(input)?;
    let numbers: Vec<f64> = bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let pairs = numbers.as_chunks::<25>().0;
    let points = |row: &[f64]| -> [DVec3; 4] { std::array::from_fn(|i| DVec3::from_slice(&row[3 * i..])) };
    let kind = |row: &[f64; 25]| if row[0] > 0.0 { Kind::EdgeEdge } else { Kind::PointTriangle };
    let started = Instant::now();
    let distances: Vec<(f64, [DVec3; 4])> = pairs
        .iter()
        .map(|row| {
            let closest = Closest::of(kind(row), &points(&row[1..]));
            (closest.distance_sq(), closest.gradient())
        })
        .collect();
    let of_distances = started.elapsed();
    let started = Instant::now();
    let times: Vec<f64> = pairs
        .iter()
        .map(|row| {
            let time = time_of_impact(kind(row), &points(&row[1..]), &points(&row[13..]));
            time.unwrap_or(f64::INFINITY)
        })
        .collect();
    println!("{} {}", of_distances.as_secs_f64(), started.elapsed().as_secs_f64());
    let mut rows = Vec::with_capacity(bytes.len());
    for ((distance, gradient), time) in distances.iter().zip(&times) {
        let gradient = gradient.iter().flat_map(DVec3::to_array);
        for number in std::iter::once(*distance).chain(gradient).chain([*time]) {
            rows.extend(number.to_le_bytes());
        }
    }
    std::fs::write(output, rows)?;
    Ok(())
}
