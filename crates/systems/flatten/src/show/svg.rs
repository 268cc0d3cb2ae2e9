//! The layout as an SVG drawing.

use crate::Flattening;
use crate::pack::bounds;
use pompeiu_surface::{EmbeddedSurface, HalfedgeId};
use std::fmt::Write;

/// Side of the drawing, in its own unit.
const SIDE: f64 = 1000.0;

/// Darkest and lightest channel of a colour of a cut.
const CHANNELS: [f64; 2] = [30.0, 215.0];

/// The layout of a map as SVG: edges of faces thin, the boundary of the surface black, and both sides of each cut edge in the same
/// colour, which depends on the position of the edge in space.
///
/// # Shapes and units
/// A square of 1000 units; the map fills it, its second axis upwards. Coordinates are rounded to a thousandth of a unit.
pub fn layout_svg(surface: &EmbeddedSurface, flat: &Flattening) -> String {
    let [lower, upper] = bounds(&flat.uv);
    let around = bounds(surface.positions());
    let extent = (upper[0] - lower[0]).max(upper[1] - lower[1]);
    let scale = if extent > 0.0 { SIDE / extent } else { 1.0 };
    let mesh = flat.opened.mesh();
    let place = |h: HalfedgeId| {
        let [x, y] = flat.uv[mesh.tail(h)];
        [scale * (x - lower[0]), SIDE - scale * (y - lower[1])]
    };
    let segment = |text: &mut String, h: HalfedgeId| {
        let ([a, b], [c, d]) = (place(h), place(h.next()));
        let _ = write!(text, "M{a:.3} {b:.3}L{c:.3} {d:.3}");
    };
    let (mut inside, mut boundary, mut cuts) = (String::new(), String::new(), String::new());
    let whole = surface.mesh();
    for edge in mesh.edge_ids() {
        // Half-edges keep their indices when a surface is opened.
        let h = mesh.edge_halfedge(edge);
        if !mesh.is_boundary_edge(edge) {
            segment(&mut inside, h);
        } else if whole.is_boundary_edge(whole.edge(h)) {
            segment(&mut boundary, h);
        } else {
            let mut path = String::new();
            segment(&mut path, h);
            let [r, g, b] = color(surface, around, h);
            let _ = writeln!(cuts, "<path d=\"{path}\" stroke=\"#{r:02x}{g:02x}{b:02x}\"/>");
        }
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"-10 -10 {0} {0}\" fill=\"none\" stroke-linecap=\"round\">\n\
         <path d=\"{inside}\" stroke=\"#888\" stroke-width=\"0.3\"/>\n\
         <path d=\"{boundary}\" stroke=\"#000\" stroke-width=\"2\"/>\n\
         <g stroke-width=\"3\">\n{cuts}</g>\n</svg>\n",
        SIDE + 20.0
    )
}

/// A colour for an edge, by the position of its midpoint in the bounding box of the surface.
fn color(surface: &EmbeddedSurface, [lower, upper]: [[f64; 3]; 2], h: HalfedgeId) -> [u8; 3] {
    let whole = surface.mesh();
    let [a, b] = [whole.tail(h), whole.head(h)].map(|v| surface.positions()[v]);
    [0, 1, 2].map(|k| {
        let (middle, width) = (0.5 * a[k] + 0.5 * b[k], upper[k] - lower[k]);
        let share = if width > 0.0 { (middle - lower[k]) / width } else { 0.5 };
        (CHANNELS[0] + share * (CHANNELS[1] - CHANNELS[0])) as u8
    })
}
