//! Draws how far two meshes are from each other, both ways, with the points that prove it:
//!
//! ```sh
//! cargo run --release --example figure examples/meshes/lantern.obj examples/meshes/cylinder.obj distance.png
//! ```

use pompeiu::figures::{ColorMap, Figure, Mark, Panel, Scale, Values};
use pompeiu::hausdorff::{DeviationOptions, DirectedDeviation};
use pompeiu::prelude::*;
use std::borrow::Cow;
use std::path::Path;

/// Part of the distance that colours may be wrong by.
const ACCURACY: f64 = 0.01;

/// Triangles that are drawn at most, beyond those that the meshes have.
const MOST: usize = 1_000_000;

/// Triangles to draw, and the distances at their corners.
fn tessellation(
    deviation: &DirectedDeviation,
    [mesh, other]: [&TriMesh; 2],
    tolerance: f64,
) -> anyhow::Result<(TriMesh, Vec<[f64; 3]>)> {
    let triangles = deviation.tessellation(mesh, other, tolerance, MOST);
    let positions = triangles.iter().flat_map(|triangle| triangle.corners).collect();
    let faces = (0..triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Ok((TriMesh::new(positions, faces)?, triangles.iter().map(|triangle| triangle.distances).collect()))
}

/// A file's name without its folders.
fn name(path: &str) -> Cow<'_, str> {
    Path::new(path).file_name().map_or(Cow::Borrowed(path), |name| name.to_string_lossy())
}

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [a, b, image] = arguments.as_slice() else {
        anyhow::bail!("expected three arguments: mesh A, mesh B, and the picture to write");
    };
    let (mesh_a, mesh_b) = (read_mesh(a)?, read_mesh(b)?);
    let deviation = DeviationOptions::default().symmetric(&mesh_a, &mesh_b)?;
    let upper = deviation.distance.upper();
    let scale = Scale::new(ColorMap::Viridis, 0.0, upper)?;

    let directions =
        [([&mesh_a, &mesh_b], &deviation.a_to_b, a, b), ([&mesh_b, &mesh_a], &deviation.b_to_a, b, a)];
    let drawn: Vec<_> = directions
        .iter()
        .map(|(meshes, directed, ..)| tessellation(directed, *meshes, ACCURACY * upper))
        .collect::<Result<_, _>>()?;
    let mut figure = Figure::new(1600, 900)
        .with_title(format!("Pompeiu–Hausdorff distance in {}", deviation.distance))
        .with_scale(scale, "distance");
    for ((_, directed, from, to), (triangles, distances)) in directions.iter().zip(&drawn) {
        let witness = &directed.distance.witness;
        let [far, near] = [witness.from.position, witness.to.position];
        figure = figure.with_panel(
            Panel::new(triangles)
                .with_values(Values::Corners(distances))
                .with_title(format!("{} → {}", name(from), name(to)))
                .with_mark(Mark::segment(far, near))
                .with_mark(Mark::point(near))
                .with_mark(Mark::point(far).with_color([220, 30, 30])),
        );
    }
    let mut png = Vec::new();
    figure.draw()?.write_png(&mut png)?;
    pompeiu::io::write_whole(image, &png)?;
    Ok(())
}
