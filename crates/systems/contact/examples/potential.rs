//! The barriers of a mesh in a file, for the comparison with another program (`bench/contact`).
//!
//! Input: doubles: the numbers of vertices and faces, d̂, the positions, displacements and a vector for the Hessian, corners of faces. Output:
//! doubles: the potential, its gradient, the unprojected Hessian times the vector. The numbers of pairs and of those that are mollified, the
//! part of the displacements that is free, and the best milliseconds of five of: pairs, potential, gradient, Hessian with the normal part,
//! Hessian with the exact projection, free part are printed.

#![allow(clippy::print_stdout, reason = "its output is read by the comparison")]

use glam::DVec3;
use pompeiu_contact::barrier::cross_squared;
use pompeiu_contact::{Bodies, Check, ContactOptions, Material, PairSet, Projection, Simulation};
use std::time::Instant;

/// The result, and the best milliseconds of five runs.
fn timed<T>(mut of: impl FnMut() -> T) -> (T, f64) {
    let mut best = f64::INFINITY;
    let mut once = || {
        let started = Instant::now();
        let result = of();
        best = best.min(1e3 * started.elapsed().as_secs_f64());
        result
    };
    let mut result = once();
    for _ in 0..4 {
        result = once();
    }
    (result, best)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let [input, output] = &files[..] else {
        return Err("expected the files of the input and the output".into());
    };
    let bytes = std::fs::read(input)?;
    let numbers: Vec<f64> = bytes.as_chunks().0.iter().map(|bytes| f64::from_le_bytes(*bytes)).collect();
    let (n, d_hat, rest) = (numbers[0] as usize, numbers[2], &numbers[3..]);
    let vectors =
        |part: &[f64]| part.as_chunks::<3>().0.iter().map(|v| DVec3::from_array(*v)).collect::<Vec<_>>();
    let [x, p, v] = [0, 1, 2].map(|k| vectors(&rest[3 * n * k..3 * n * (k + 1)]));
    let faces: Vec<[u32; 3]> = rest[9 * n..].as_chunks::<3>().0.iter().map(|f| f.map(|i| i as u32)).collect();

    let mut bodies = Bodies::new();
    bodies.add_shell(&x, &faces, Material { young: 1e5, poisson: 0.3, density: 300.0 }, 1e-3)?;
    let options = ContactOptions {
        distance: d_hat,
        pairs: PairSet::Plain,
        check: Check::Never,
        ..ContactOptions::new(0.01, 1.0)
    };
    let simulation = Simulation::new(bodies, options)?;
    let (pairs, of_pairs) = timed(|| simulation.contact_pairs());
    let (potential, of_potential) = timed(|| simulation.potential(&pairs));
    let (gradient, of_gradient) = timed(|| simulation.potential_gradient(&pairs));
    let (normal, of_normal) = timed(|| simulation.potential_hessian(&pairs, Projection::Normal));
    let (exact, of_exact) = timed(|| simulation.potential_hessian(&pairs, Projection::Exact));
    normal?;
    exact?;
    let (free, of_free) = timed(|| simulation.free_part(&p));

    let mut product = vec![DVec3::ZERO; n];
    let mut mollified = 0;
    for pair in &pairs {
        let at = pair.vertices.map(|i| x[i as usize]);
        mollified += usize::from(pair.mollified > 0.0 && cross_squared(&at).0 < pair.mollified);
        let hessian = pair.second_derivatives(&x, d_hat);
        for i in 0..12 {
            let row: f64 = (0..12).map(|j| hessian[i][j] * v[pair.vertices[j / 3] as usize][j % 3]).sum();
            product[pair.vertices[i / 3] as usize][i % 3] += row;
        }
    }
    println!("{} {mollified} {free}", pairs.len());
    println!("{of_pairs} {of_potential} {of_gradient} {of_normal} {of_exact} {of_free}");
    let vectors = gradient.iter().chain(&product).flat_map(DVec3::to_array);
    let written: Vec<u8> = std::iter::once(potential).chain(vectors).flat_map(f64::to_le_bytes).collect();
    std::fs::write(output, written)?;
    Ok(())
}
