//! The curves of basic shapes and paths.

use super::lengths::{Of, length};
use super::numbers::numbers;
use super::path::{self, Curve};
use crate::Point;
use roxmltree::Node;

/// An attribute, and what is wrong with it.
pub(super) type Wrong = (&'static str, String);

/// A length in an attribute of an element; 0 if it has none.
pub(super) fn attribute(
    node: Node<'_, '_>,
    name: &'static str,
    of: Of,
    viewport: Option<Point>,
) -> Result<f64, Wrong> {
    node.attribute(name).map_or(Ok(0.0), |text| length(text, of, viewport).map_err(|why| (name, why)))
}

/// The curves of an element; none if it draws none, as shapes of no width, height or radius.
pub(super) fn curves(node: Node<'_, '_>, viewport: Option<Point>) -> Result<Vec<Curve>, Wrong> {
    let place = |name, of| attribute(node, name, of, viewport);
    let size = |name: &'static str, of| match attribute(node, name, of, viewport) {
        Ok(x) if x < 0.0 => Err((name, format!("it is {x}; it must not be negative"))),
        other => other,
    };
    Ok(match node.tag_name().name() {
        "path" => path::parse(node.attribute("d").unwrap_or_default()).map_err(|why| ("d", why))?,
        name @ ("polygon" | "polyline") => {
            let text = node.attribute("points").unwrap_or_default();
            let numbers = numbers(text).map_err(|why| ("points", why))?;
            if numbers.len() % 2 == 1 {
                return Err(("points", format!("there are {} numbers, which is odd", numbers.len())));
            }
            let points: Vec<Point> = numbers.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
            Curve::through(&points, name == "polygon").into_iter().collect()
        }
        "rect" => {
            let corner = [place("x", Of::Width)?, place("y", Of::Height)?];
            let extent = [size("width", Of::Width)?, size("height", Of::Height)?];
            if extent.contains(&0.0) {
                return Ok(Vec::new());
            }
            // A radius that is absent, or `auto`, is the other one.
            let radius = |name, of| {
                let is_given = node.attribute(name).is_some_and(|text| text.trim() != "auto");
                if is_given { size(name, of).map(Some) } else { Ok(None) }
            };
            let radii = [radius("rx", Of::Width)?, radius("ry", Of::Height)?];
            let radii = [0, 1].map(|k| radii[k].or(radii[1 - k]).unwrap_or(0.0).min(0.5 * extent[k]));
            vec![Curve::rectangle(corner, extent, radii)]
        }
        "circle" => {
            let r = size("r", Of::Diagonal)?;
            ellipse([place("cx", Of::Width)?, place("cy", Of::Height)?], [r, r])
        }
        "ellipse" => ellipse(
            [place("cx", Of::Width)?, place("cy", Of::Height)?],
            [size("rx", Of::Width)?, size("ry", Of::Height)?],
        ),
        _ => Vec::new(),
    })
}

fn ellipse(centre: Point, radii: [f64; 2]) -> Vec<Curve> {
    if radii.contains(&0.0) { Vec::new() } else { vec![Curve::ellipse(centre, radii)] }
}
