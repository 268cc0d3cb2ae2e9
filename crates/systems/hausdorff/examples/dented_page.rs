//! Writes a page of a hollow ball and a scan of it with a dent, to see that a browser looks at the dent from outside:
//!
//! ```sh
//! cargo run --release -p pompeiu-hausdorff --features figures --example dented_page page.html
//! ```
//!
//! Beside it, `page.html.json` holds the triangles of both and the radii of the wall.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::run::Limits;
use pompeiu_hausdorff::show::DeviationPage;
use pompeiu_hausdorff::{DeviationOptions, PreparedPair, VerdictAnswer};
use serde_json::json;
use std::error::Error;

const WALL: [f64; 2] = [0.9, 1.0];
/// Where the dent is, away from where a page looks from by itself, its radius and its depth.
const DENT: [f64; 3] = [-0.48, 0.8, -0.36];
const WIDTH: f64 = 0.25;
const DEPTH: f64 = 0.04;

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args().nth(1).ok_or("expected the file to write")?;
    let [model, scan] = [hollow(0.0)?, hollow(DEPTH)?];
    let triangles =
        [&model, &scan].map(|mesh| mesh.face_ids().map(|face| mesh.corners(face)).collect::<Vec<_>>());
    let pair = PreparedPair::new(model, scan);
    let deviation = DeviationOptions::default().symmetric_of(&pair)?;
    let page = DeviationPage {
        pair: &pair,
        paths: ["ball.stl", "scan.ply"],
        names: ["model", "scan"],
        deviation: &deviation,
        stages: &[],
        unit: "mm",
        up: [0.0, 0.0, 1.0],
        threshold: Some(0.01),
        bands: None,
        verdict: Some((VerdictAnswer::Out, "OUT OF TOLERANCE: the farthest point is 0.04 mm away")),
        proof: None,
        command: None,
    };
    std::fs::write(&out, page.figures(&Limits::default()).html()?)?;
    let truth = json!({ "wall": WALL, "dent": DENT, "depth": DEPTH, "triangles": triangles });
    std::fs::write(format!("{out}.json"), truth.to_string())?;
    Ok(())
}

/// A ball with a hollow inside, and a dent outside.
fn hollow(depth: f64) -> Result<TriMesh, Box<dyn Error>> {
    let sphere = icosphere(1.0, 5)?;
    let outer = sphere.positions().iter().map(|p| {
        let away = (0..3).map(|k| (p[k] - DENT[k]).powi(2)).sum::<f64>().sqrt() / WIDTH;
        let lower = if away < 1.0 { depth * (1.0 - away * away).powi(2) } else { 0.0 };
        p.map(|x| x * (WALL[1] - lower))
    });
    let inner = sphere.positions().iter().map(|p| p.map(|x| x * WALL[0]));
    let count = sphere.positions().len() as u32;
    let turned = sphere.faces().iter().map(|[a, b, c]| [a + count, c + count, b + count]);
    let faces = sphere.faces().iter().copied().chain(turned).collect();
    Ok(TriMesh::new(outer.chain(inner).collect(), faces)?)
}
