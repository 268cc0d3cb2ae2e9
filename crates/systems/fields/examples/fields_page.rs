//! Writes a page of a tangent field on a torus and of the parts that it was made from:
//!
//! ```sh
//! cargo run --release -p pompeiu-fields --features figures --example fields_page fields.html [--faces 8000]
//! ```
//!
//! The parts are the gradient of a function, the rotated gradient of another one, both linear on faces, and the field of the
//! angle around the axis, which is harmonic. Beside the page, `fields.html.json` holds what it was made from.

#![allow(clippy::print_stdout, reason = "this program is there to print")]

use glam::DVec3;
use pompeiu_core::mesh::shapes::torus;
use pompeiu_fields::show::{FieldsContent, NamedField, TextTable};
use pompeiu_figures::page::Axis;
use serde_json::json;
use std::error::Error;

const RADII: [f64; 2] = [1.0, 0.42];

type Field = Vec<DVec3>;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let out = arguments.next().ok_or("expected the file to write")?;
    let mut faces = 8000.0;
    while let Some(option) = arguments.next() {
        let value = arguments.next().ok_or(format!("{option} needs a value"))?;
        match option.as_str() {
            "--faces" => faces = value.parse::<f64>()?,
            _ => return Err(format!("unknown option {option}").into()),
        }
    }
    let around = (faces / 2.0 * RADII[0] / RADII[1]).sqrt().max(8.0) as u32;
    let across = (f64::from(around) * RADII[1] / RADII[0]).max(5.0) as u32;
    let mesh = torus(RADII[0], RADII[1], around, across)?;
    let corners: Vec<[[f64; 3]; 3]> = mesh.face_ids().map(|face| mesh.corners(face)).collect();
    let faces: Vec<[DVec3; 3]> = corners.iter().map(|face| face.map(DVec3::from)).collect();
    let cross = |[a, b, c]: &[DVec3; 3]| (b - a).cross(c - a);

    // Of the function that is linear on the face and has these values at its corners.
    let gradient = |face: &[DVec3; 3], of: fn(DVec3) -> f64| {
        let [a, b, c] = face;
        let n = cross(face);
        (n.cross(c - b) * of(*a) + n.cross(a - c) * of(*b) + n.cross(b - a) * of(*c)) / n.length_squared()
    };
    let hills = |p: DVec3| 0.55 * (1.7 * p.x).sin() + 0.4 * p.y * p.z;
    let stream = |p: DVec3| 0.35 * (2.0 * p.y).cos() + 0.3 * p.x * p.z;
    let gradients: Field = faces.iter().map(|face| gradient(face, hills)).collect();
    let rotated: Field =
        faces.iter().map(|face| cross(face).normalize().cross(gradient(face, stream))).collect();
    let harmonic: Field = faces
        .iter()
        .map(|face| {
            let [a, b, c] = face;
            let (p, n) = ((a + b + c) / 3.0, cross(face).normalize());
            let around = DVec3::new(-p.y, p.x, 0.0) / (p.x * p.x + p.y * p.y);
            0.6 * (around - n * n.dot(around))
        })
        .collect();
    let whole: Field = (0..faces.len()).map(|f| gradients[f] + rotated[f] + harmonic[f]).collect();

    let product = |u: &Field, w: &Field| -> f64 {
        faces.iter().zip(u.iter().zip(w)).map(|(face, (u, w))| cross(face).length() / 2.0 * u.dot(*w)).sum()
    };
    let parts =
        [("field", whole), ("gradient", gradients), ("rotated gradient", rotated), ("harmonic", harmonic)];
    let rest: Field =
        (0..faces.len()).map(|f| parts[0].1[f] - parts[1].1[f] - parts[2].1[f] - parts[3].1[f]).collect();
    let page = FieldsContent {
        title: "A field on a torus, and its parts".into(),
        up: Axis::Z,
        name: "torus".into(),
        path: "made for this page".into(),
        vertices: mesh.positions().len(),
        fields: parts
            .iter()
            .map(|(label, field)| NamedField {
                label: (*label).into(),
                vectors: field.iter().map(DVec3::to_array).collect(),
                norm: product(field, field).sqrt(),
            })
            .collect(),
        inner_products: parts
            .iter()
            .map(|(_, u)| parts.iter().map(|(_, w)| product(u, w)).collect())
            .collect(),
        residual: product(&rest, &rest).sqrt(),
        tables: vec![TextTable {
            title: "Degrees of freedom".into(),
            head: vec![String::new(), "dimension".into()],
            rows: vec![
                vec!["fields".into(), (2 * corners.len()).to_string()],
                vec!["harmonic".into(), "2".into()],
            ],
        }],
        notes: vec!["The field is the sum of its parts, so nothing is left over but rounding.".into()],
        command: Some("cargo run -p pompeiu-fields --features figures --example fields_page".into()),
        version: env!("CARGO_PKG_VERSION").into(),
        corners,
        ..FieldsContent::default()
    };
    let html = page.page()?.html();
    std::fs::write(&out, &html)?;
    let truth = json!({
        "corners": page.corners, "fields": page.fields.iter().map(|f| &f.vectors).collect::<Vec<_>>(),
        "norms": page.fields.iter().map(|f| f.norm).collect::<Vec<_>>(), "products": page.inner_products, "residual": page.residual,
    });
    std::fs::write(format!("{out}.json"), truth.to_string())?;
    println!("{} bytes for {} faces", html.len(), page.corners.len());
    Ok(())
}
