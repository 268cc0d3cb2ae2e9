//! Draws what is left of a mesh A while the point of A farthest from a mesh B is searched for:
//!
//! ```sh
//! cargo run --release --example what_is_left examples/meshes/sphere.obj examples/meshes/torus.obj left.svg
//! ```
//!
//! An observer sees, at each of three tolerances, the pieces of A that may still hold the farthest point. The last panel
//! shows the two points that prove the lower bound.

use anyhow::Context;
use glam::{DVec2, DVec3};
use pompeiu::core::MeshSummary;
use pompeiu::hausdorff::{Observer, Stage, Witness};
use pompeiu::prelude::*;
use std::collections::HashMap;
use std::fmt::Write;
use std::sync::Mutex;

fn main() -> anyhow::Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [a, b, picture] = arguments.as_slice() else {
        anyhow::bail!("expected three arguments: mesh A, mesh B, and the SVG file to write");
    };
    let command = format!("cargo run --release --example what_is_left {a} {b} {picture}");
    let svg = draw(&read_mesh(a)?, &read_mesh(b)?, &command)?;
    // Under its own name only once it is complete.
    let unfinished = format!("{picture}.tmp");
    std::fs::write(&unfinished, svg)
        .and_then(|()| std::fs::rename(&unfinished, picture))
        .context(picture.clone())
}

/// Tolerances to stop at on the way, as fractions of the diagonal of the joint bounding box.
const STAGES: [f64; 3] = [1e-2, 1e-3, 1e-4];

#[derive(Default)]
struct Stages(Mutex<Vec<Stage>>);

impl Observer for Stages {
    fn stage(&self, stage: &Stage) {
        self.0.lock().expect("no thread panicked").push(stage.clone());
    }
}

/// Pieces that may still hold the farthest point, by the face of A that they are a part of.
type Left = HashMap<FaceId, Vec<[[f64; 3]; 3]>>;

/// The picture as an SVG document.
pub(crate) fn draw(a: &TriMesh, b: &TriMesh, command: &str) -> anyhow::Result<String> {
    let stages = Stages::default();
    let options =
        HausdorffOptions { stages: STAGES.to_vec(), observer: Some(&stages), ..HausdorffOptions::default() };
    let report = options.directed(a, b)?;
    let stages = stages.0.into_inner().expect("no thread panicked");
    let view = View::of(&[a, b]);

    let mut svg = head(command);
    // The search itself ends with one more stage, at the tolerance of the query.
    for (panel, stage) in stages.iter().enumerate() {
        let mut left = Left::new();
        for piece in &stage.remaining {
            left.entry(piece.face).or_default().push(piece.corners);
        }
        let x = MARGIN.x + PANEL.x * panel as f64;
        let _ = writeln!(svg, r#"<g transform="translate({x} {})">"#, MARGIN.y);
        svg += &surfaces(&view, a, b, &left);
        svg += &if let Some(tolerance) = STAGES.get(panel) {
            caption(&[
                &format!("Tolerance {} %", 100.0 * tolerance),
                &format!("{} of {} faces left", left.len(), a.faces().len()),
                &bounds(stage.lower, stage.upper, 4),
            ])
        } else {
            let Witness { from, to } = report.witness;
            let distance = bounds(report.distance.lower(), report.distance.upper(), 8);
            segment(view.project(from.position), view.project(to.position))
                + &caption(&["Default tolerance", "this pair proves the lower bound", &distance])
        };
        svg += "</g>\n";
    }
    Ok(svg + "</svg>\n")
}

const PANEL: DVec2 = DVec2::new(290.0, 250.0);
const MARGIN: DVec2 = DVec2::new(20.0, 64.0);
const FOOT: f64 = 96.0;

fn head(command: &str) -> String {
    let (width, height) = (2.0 * MARGIN.x + 4.0 * PANEL.x, MARGIN.y + PANEL.y + FOOT);
    let question = "How far is the grey surface from the blue one? \
        Only <tspan fill=\"#c24e00\">what is left</tspan> may still hold its farthest point.";
    let command = command.replace('&', "&amp;").replace('<', "&lt;");
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img">
<title>What is left of a surface while its farthest point is searched for</title>
<desc>Made by: {command}</desc>
<style>
text {{ font-family: system-ui, -apple-system, "Segoe UI", "Helvetica Neue", Arial, sans-serif; font-size: 17px }}
text {{ fill: #24292f; text-anchor: middle }}
path {{ stroke-width: 4; stroke-linejoin: round }}
.b {{ fill: #0072b2; fill-opacity: .045; stroke: #0072b2; stroke-opacity: .3 }}
</style>
<rect x=".5" y=".5" width="{}" height="{}" rx="14" fill="#fcfbf8" stroke="#d0d4d9"/>
<text x="{}" y="36" font-weight="600">{question}</text>
"##,
        width - 1.0,
        height - 1.0,
        0.5 * width,
    )
}

/// Three lines below a panel.
fn caption(lines: &[&str; 3]) -> String {
    let [title, left, bounds] = lines;
    let x = 0.5 * PANEL.x;
    let [y0, y1, y2] = [24.0, 49.0, 74.0].map(|y| PANEL.y + y);
    format!(
        r#"<text x="{x}" y="{y0}" font-weight="600">{title}</text>
<text x="{x}" y="{y1}">{left}</text>
<text x="{x}" y="{y2}">{bounds}</text>
"#
    )
}

/// Bounds to some significant digits, rounded outwards.
fn bounds(lower: f64, upper: f64, digits: u32) -> String {
    let decimals = (f64::from(digits) - upper.log10().ceil()).clamp(0.0, 17.0) as i32;
    let unit = 10.0_f64.powi(decimals);
    let (lower, upper) = ((lower * unit).floor() / unit, (upper * unit).ceil() / unit);
    let decimals = decimals as usize;
    format!("{lower:.decimals$} ≤ h ≤ {upper:.decimals$}")
}

/// Parallel projection onto a panel.
struct View {
    right: DVec3,
    up: DVec3,
    toward: DVec3,
    scale: f64,
    middle: DVec2,
}

impl View {
    /// Shows all of some meshes, z upwards.
    fn of(meshes: &[&TriMesh]) -> Self {
        let toward = DVec3::new(2.0, -4.0, 2.5).normalize();
        let right = DVec3::Z.cross(toward).normalize();
        let mut view = Self { right, up: toward.cross(right), toward, scale: 1.0, middle: DVec2::ZERO };
        let points = || meshes.iter().flat_map(|mesh| mesh.positions()).map(|&p| view.project(p));
        let lower = points().fold(DVec2::INFINITY, DVec2::min);
        let upper = points().fold(DVec2::NEG_INFINITY, DVec2::max);
        let scale = 0.94 * (PANEL / (upper - lower)).min_element();
        view.middle = 0.5 * PANEL - 0.5 * scale * (lower + upper);
        view.scale = scale;
        view
    }

    /// In pixels from the upper left corner of a panel.
    fn project(&self, point: [f64; 3]) -> DVec2 {
        let point = DVec3::from(point);
        self.middle + self.scale * DVec2::new(self.right.dot(point), -self.up.dot(point))
    }

    /// A path, in tenths of a pixel so that coordinates are short.
    fn path(&self, corners: [[f64; 3]; 3]) -> String {
        let [p, q, r] = corners.map(|corner| (10.0 * self.project(corner)).round());
        let (q, r) = (q - p, r - q);
        format!("M{} {}l{} {} {} {}z", p.x, p.y, q.x, q.y, r.x, r.y)
    }
}

/// Both meshes, the farther faces first, and on top of each face of A the pieces of it that are left.
fn surfaces(view: &View, a: &TriMesh, b: &TriMesh, left: &Left) -> String {
    let mut shapes = Vec::new();
    for (mesh, is_a) in [(a, true), (b, false)] {
        let solid = MeshSummary::of(mesh).volume.is_some_and(|volume| volume > 0.0);
        for face in (0..mesh.faces().len() as u32).map(FaceId) {
            let corners = mesh.corners(face);
            let [p, q, r] = corners.map(DVec3::from);
            let normal = (q - p).cross(r - p).normalize_or_zero();
            // The backs of a solid cannot be seen.
            if solid && normal.dot(view.toward) <= 0.0 {
                continue;
            }
            let (depth, light) = (view.toward.dot(p + q + r), normal.dot(LIGHT).abs());
            if is_a {
                shapes.push((depth, paint(GREY, light), view.path(corners)));
                for &piece in left.get(&face).into_iter().flatten() {
                    shapes.push((depth, paint(ORANGE, light), view.path(piece)));
                }
            } else {
                shapes.push((depth, r#"class="b""#.into(), view.path(corners)));
            }
        }
    }
    // Pieces stay on top of their face: the order of what is equally deep is kept.
    shapes.sort_by(|(one, ..), (other, ..)| one.total_cmp(other));

    let mut svg = String::from("<g transform=\"scale(.1)\">");
    for alike in shapes.chunk_by(|(_, style, _), (_, next, _)| style == next) {
        let paths: String = alike.iter().map(|(.., path)| path.as_str()).collect();
        let _ = write!(svg, "\n<path {} d=\"{paths}\"/>", alike[0].1);
    }
    svg + "\n</g>\n"
}

const LIGHT: DVec3 = DVec3::new(-0.3, -0.5, 0.8);
const GREY: [u8; 3] = [206, 212, 218];
const ORANGE: [u8; 3] = [240, 125, 20];

fn paint(colour: [u8; 3], light: f64) -> String {
    let [r, g, b] = colour.map(|c| ((0.68 + 0.4 * light) * f64::from(c)).min(255.0) as u8);
    let [dark_r, dark_g, dark_b] = [r, g, b].map(|c| c - c / 6);
    format!(r##"fill="#{r:02x}{g:02x}{b:02x}" stroke="#{dark_r:02x}{dark_g:02x}{dark_b:02x}""##)
}

/// The segment from a to b.
fn segment(a: DVec2, b: DVec2) -> String {
    format!(
        r##"<g stroke="#24292f" stroke-width="2.5">
<line x1="{ax:.1}" y1="{ay:.1}" x2="{bx:.1}" y2="{by:.1}"/>
<circle cx="{ax:.1}" cy="{ay:.1}" r="5" fill="#e8700a"/>
<circle cx="{bx:.1}" cy="{by:.1}" r="5" fill="#0072b2"/>
</g>
"##,
        ax = a.x,
        ay = a.y,
        bx = b.x,
        by = b.y,
    )
}
