//! Outlines in SVG drawings: paths, polygons, rectangles, circles and ellipses, with their transforms.

mod numbers;
mod path;
mod transform;

use crate::Point;
use path::Curve;
use roxmltree::{Document, Node, ParsingOptions};
use std::fmt::Write;
use transform::Transform;

/// A curve of a drawing as a polyline.
#[derive(Clone, Debug, PartialEq)]
pub struct Polyline {
    /// The attribute `id` of its element; may be empty.
    pub id: String,
    /// Its points, in the unit of the drawing, y downwards.
    pub points: Vec<Point>,
    /// Whether the last point is joined with the first one.
    pub is_closed: bool,
}

/// Why a drawing cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SvgError {
    /// It is not XML.
    #[error("the drawing is no XML: {0}")]
    Xml(String),
    /// The XML is no SVG drawing.
    #[error("the drawing's first element is <{0}>; expected <svg>")]
    Root(String),
    /// An attribute cannot be read.
    #[error("line {line}: {attribute} of <{element}>: {why}")]
    Attribute {
        /// The line of the element.
        line: u32,
        /// The element's name.
        element: String,
        /// The attribute's name.
        attribute: &'static str,
        /// What is wrong.
        why: String,
    },
}

/// Largest distance of chords from curves, relative to the diagonal of all curves in the drawing.
pub const FLATTENING: f64 = 1e-4;

/// Elements whose content is not drawn in place.
const HIDDEN: [&str; 7] = ["defs", "clipPath", "mask", "symbol", "pattern", "marker", "metadata"];

/// Largest number of elements that is read.
const MOST_NODES: u32 = 1 << 22;

/// The curves of a drawing, in its order. Bézier curves and arcs become chords at most [`FLATTENING`] away from them.
///
/// # Limits
/// `viewBox`, units, style sheets and `use` are ignored; coordinates are those of the drawing's user space.
///
/// # Errors
/// [`SvgError`] with the line.
pub fn read(text: &str) -> Result<Vec<Polyline>, SvgError> {
    let options = ParsingOptions { nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document =
        Document::parse_with_options(text, options).map_err(|error| SvgError::Xml(error.to_string()))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(SvgError::Root(root.tag_name().name().to_owned()));
    }
    let mut curves: Vec<(String, Curve)> = Vec::new();
    let mut open = vec![(root, Transform::IDENTITY)];
    while let Some((node, above)) = open.pop() {
        let name = node.tag_name().name();
        if HIDDEN.contains(&name) || node.attribute("display") == Some("none") {
            continue;
        }
        let wrong = |attribute: &'static str| {
            let line = document.text_pos_at(node.range().start).row;
            let element = name.to_owned();
            move |why: String| SvgError::Attribute { line, element, attribute, why }
        };
        let own = node.attribute("transform").map_or(Ok(Transform::IDENTITY), Transform::parse);
        let transform = above.then_inner(own.map_err(wrong("transform"))?);
        let id = node.attribute("id").unwrap_or_default();
        for mut curve in element(node).map_err(|(attribute, why)| wrong(attribute)(why))? {
            curve.transform(&transform);
            curves.push((id.to_owned(), curve));
        }
        let children: Vec<Node<'_, '_>> = node.children().filter(Node::is_element).collect();
        open.extend(children.into_iter().rev().map(|child| (child, transform)));
    }
    let all: Vec<Point> = curves.iter().flat_map(|(_, curve)| curve.controls()).collect();
    let [low, high] = crate::outline::bounds(&all);
    let tolerance = FLATTENING * crate::outline::distance(low, high);
    let flat = |(id, curve): (String, Curve)| {
        let is_closed = curve.is_closed;
        Polyline { id, points: curve.flatten(tolerance), is_closed }
    };
    Ok(curves.into_iter().map(flat).collect())
}

type Wrong = (&'static str, String);

/// The curves of an element; none if it draws none.
fn element(node: Node<'_, '_>) -> Result<Vec<Curve>, Wrong> {
    let number = |name: &'static str| -> Result<f64, Wrong> {
        let Some(text) = node.attribute(name) else { return Ok(0.0) };
        let text = text.trim().trim_end_matches("px");
        match text.parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => Err((name, format!("`{text}` is not a number"))),
        }
    };
    Ok(match node.tag_name().name() {
        "path" => path::parse(node.attribute("d").unwrap_or_default()).map_err(|why| ("d", why))?,
        name @ ("polygon" | "polyline") => {
            let text = node.attribute("points").unwrap_or_default();
            let numbers = numbers::numbers(text).map_err(|why| ("points", why))?;
            if numbers.len() % 2 == 1 {
                return Err(("points", format!("there are {} numbers, which is odd", numbers.len())));
            }
            let points: Vec<Point> = numbers.chunks_exact(2).map(|p| [p[0], p[1]]).collect();
            Curve::through(&points, name == "polygon").into_iter().collect()
        }
        "rect" => {
            let [x, y, w, h] = [number("x")?, number("y")?, number("width")?, number("height")?];
            Curve::through(&[[x, y], [x + w, y], [x + w, y + h], [x, y + h]], true).into_iter().collect()
        }
        "circle" => {
            let r = number("r")?;
            vec![Curve::ellipse([number("cx")?, number("cy")?], [r, r])]
        }
        "ellipse" => vec![Curve::ellipse([number("cx")?, number("cy")?], [number("rx")?, number("ry")?])],
        _ => Vec::new(),
    })
}

/// The attribute `d` of a path through these points, every coordinate as the shortest decimal that reads back to it.
pub fn path_data(points: &[Point], is_closed: bool) -> String {
    let mut text = String::new();
    for (i, [x, y]) in points.iter().enumerate() {
        let _ = write!(text, "{}{x} {y}", if i == 0 { "M" } else { "L" });
    }
    if is_closed {
        text.push('Z');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapes_and_transforms_are_read_in_order() {
        let text = "<svg xmlns='http://www.w3.org/2000/svg'><g transform='translate(10 20) scale(2)'>\
            <rect id='r' x='1' y='1' width='3' height='2'/><polygon points='0,0 1,0 0,1'/></g>\
            <defs><circle r='5'/></defs><circle cx='1' r='2'/></svg>";
        let found = read(text).unwrap();
        assert_eq!(found.len(), 3);
        assert_eq!((found[0].id.as_str(), &found[0].points[..2]), ("r", &[[12.0, 22.0], [18.0, 22.0]][..]));
        assert_eq!(found[1].points, [[10.0, 20.0], [12.0, 20.0], [10.0, 22.0]]);
        let radius = |p: &Point| ((p[0] - 1.0).powi(2) + p[1] * p[1]).sqrt();
        assert!(found[2].points.iter().all(|p| (radius(p) - 2.0).abs() < 1e-3), "{:?}", found[2]);
        assert!(found[2].is_closed);
    }

    #[test]
    fn what_is_written_reads_back() {
        let points = vec![[0.1, 1.0 / 3.0], [1e-7, 2.5], [12345.678, -3.0]];
        let text = format!("<svg><path d=\"{}\"/></svg>", path_data(&points, true));
        assert_eq!(read(&text).unwrap()[0].points, points);
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        assert!(matches!(read("<svg><path"), Err(SvgError::Xml(_))));
        assert_eq!(read("<html/>"), Err(SvgError::Root("html".into())));
        let error = read("<svg>\n<path d='M 1 2 L x'/></svg>").unwrap_err();
        assert!(matches!(error, SvgError::Attribute { line: 2, attribute: "d", .. }), "{error}");
    }
}
