//! Outlines in SVG drawings: paths, polygons, rectangles, circles and ellipses, with their transforms, and copies of them by `use`.

mod lengths;
mod numbers;
mod path;
mod shapes;
mod transform;
mod tree;
mod viewport;

use crate::{FillRule, Point};
use std::fmt::Write;

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

/// An element of a drawing that draws something.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// The attribute `id` of the `use` that shows it, the outermost one that has an id, or its own; may be empty.
    pub id: String,
    /// Which points its curves enclose; even–odd for curves that are drawn as lines alone.
    pub fill_rule: FillRule,
    /// Whether what its curves enclose is filled, which also joins their ends. Where the drawing has a style sheet, which is not read, it
    /// is not known to be.
    pub is_filled: bool,
    /// Its curves, at least one.
    pub curves: Vec<Polyline>,
}

/// What a drawing shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawing {
    /// Its elements that draw something, in its order.
    pub elements: Vec<Element>,
    /// What it shows that is not in the elements: each visible `use` of what is not in it, and each visible text.
    pub missing: Vec<Missing>,
}

/// What is not in the curves of a drawing.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Missing {
    /// A `use` of what is not in the drawing.
    #[error(
        "line {line}: <use> draws nothing, for {}",
        match href.strip_prefix('#') {
            Some(id) => format!("no element has the id `{id}`"),
            None if href.is_empty() => "it has no href".to_owned(),
            None => format!("`{href}` is outside of the drawing, and other files are not read"),
        }
    )]
    Use {
        /// The line of the element.
        line: u32,
        /// What it refers to.
        href: String,
    },
    /// A text, whose outlines are in a font.
    #[error("line {line}: <text> is left out, for fonts are not read; convert it to paths")]
    Text {
        /// The line of the element.
        line: u32,
    },
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
    /// A `use` shows an element that contains it, or that shows it.
    #[error("line {line}: <use> of `{id}` shows itself, for it is part of what `{id}` shows; leave it out")]
    Cycle {
        /// The line of the element.
        line: u32,
        /// What it refers to.
        id: String,
    },
    /// Copies by `use` are too many.
    #[error("line {line}: copies by <use> have more than {most} {what}; use fewer copies")]
    Copies {
        /// The line of the `use` that is too much.
        line: u32,
        /// What there is too much of.
        what: &'static str,
        /// How many there may be.
        most: usize,
    },
}

/// Largest distance of chords from curves, relative to the diagonal of the curves of an element.
pub const FLATTENING: f64 = 1e-4;

/// The curves of a drawing, in its order: those of all its elements, see [`read_drawing`].
///
/// # Errors
/// [`SvgError`] with the line.
pub fn read(text: &str) -> Result<Vec<Polyline>, SvgError> {
    Ok(read_drawing(text)?.elements.into_iter().flat_map(|element| element.curves).collect())
}

/// The elements of a drawing. Bézier curves and arcs become chords at most [`FLATTENING`] away from them.
///
/// # Definition
/// Paths, polygons, polylines, rectangles, circles and ellipses, with the transforms of all elements around them; groups, nested drawings
/// with their viewports, and what `use` shows, symbols too. Elements without curves, with `display` `none`, those that are not visible, and
/// shapes of no width, height or radius draw nothing. Nor does a `use` of an id that no element has, or of another file: as viewers do, it is
/// left out, and it is listed. So is text.
///
/// # Limits
/// The `viewBox` of the whole drawing only says what percentages refer to: coordinates are those of its user space. Style sheets and
/// clipping are ignored. Copies by `use` have at most about a million elements, four million points and a depth of 64.
///
/// # Errors
/// [`SvgError`] with the line; also for a `use` of itself.
pub fn read_drawing(text: &str) -> Result<Drawing, SvgError> {
    tree::drawing(text)
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
    fn uses_show_copies_where_they_say() {
        let text = "<svg xmlns:xlink='http://www.w3.org/1999/xlink' viewBox='0 0 200 100'>\
            <defs><rect id='r' width='3' height='2'/><g id='two'><use xlink:href='#r' x='5'/><use id='in' href='#r'/></g>\
            <symbol id='s' viewBox='0 0 10 10'><rect width='10' height='10'/></symbol></defs>\
            <use href='#two' transform='scale(2)' y='1'/><use id='out' href='#two'/>\
            <use href='#s' x='1' width='40' height='20'/><rect width='50%' height='10%' rx='0'/></svg>";
        let found = read_drawing(text).unwrap().elements;
        let first =
            |i: usize| (found[i].id.as_str(), found[i].curves[0].points[0], found[i].curves[0].points[2]);
        assert_eq!(found.len(), 6);
        assert_eq!(first(0), ("r", [10.0, 2.0], [16.0, 6.0]));
        assert_eq!(first(1), ("in", [0.0, 2.0], [6.0, 6.0]));
        assert_eq!(first(2), ("out", [5.0, 0.0], [8.0, 2.0]));
        assert_eq!(first(4), ("", [11.0, 0.0], [31.0, 20.0]));
        assert_eq!(first(5), ("", [0.0, 0.0], [100.0, 10.0]));
    }

    #[test]
    fn uses_of_themselves_and_too_many_are_refused() {
        let cycle = "<svg>\n<g id='a'><use href='#b'/></g>\n<g id='b'><rect width='1' height='1'/>\n<use href='#a'/></g></svg>";
        assert_eq!(read(cycle), Err(SvgError::Cycle { line: 2, id: "b".into() }));
        let of_root = "<svg id='all'><use href='#all'/></svg>";
        assert!(matches!(read(of_root), Err(SvgError::Cycle { line: 1, .. })));
        // Ten copies of ten copies and so on: a thousand millions.
        let mut text = "<svg><defs><rect id='g0' width='1' height='1'/>".to_owned();
        for level in 1..10 {
            let copies = format!("<use href='#g{}'/>", level - 1).repeat(10);
            let _ = write!(text, "<g id='g{level}'>{copies}</g>");
        }
        text.push_str("</defs><use href='#g9'/></svg>");
        assert!(
            matches!(read(&text), Err(SvgError::Copies { .. })),
            "{:?}",
            read(&text).map(|all| all.len())
        );
    }

    #[test]
    fn uses_of_what_is_not_there_draw_nothing_and_are_listed() {
        let text = "<svg><use href='#none'/>\n<rect width='1' height='2'/><use href='other.svg#a'/>\n<use/><use href='#'/>\n\
            <use href='#none' visibility='hidden'/><g display='none'><use href='#none'/></g></svg>";
        let found = read_drawing(text).unwrap();
        assert_eq!((found.elements.len(), found.elements[0].curves[0].points[2]), (1, [1.0, 2.0]));
        let said: Vec<String> = found.missing.iter().map(Missing::to_string).collect();
        let expected = [
            "line 1: <use> draws nothing, for no element has the id `none`",
            "line 2: <use> draws nothing, for `other.svg#a` is outside of the drawing, and other files are not read",
            "line 3: <use> draws nothing, for it has no href",
            "line 3: <use> draws nothing, for no element has the id ``",
        ];
        assert_eq!(said, expected);
        // Copies of a group with such a use.
        let group =
            "<svg><g id='g'><use href='#none'/><rect width='1' height='2'/></g><use href='#g' x='3'/></svg>";
        let found = read_drawing(group).unwrap();
        assert_eq!((found.elements.len(), found.missing.len()), (2, 1));
    }

    #[test]
    fn texts_are_listed_where_they_are_seen() {
        let text = "<svg><rect width='1' height='2'/>\n<text x='1'><tspan>Hi</tspan></text><text> </text><text visibility='hidden'>no</text>\
            \n<defs><text id='t'>Ho</text></defs>\n<use href='#t'/></svg>";
        let found = read_drawing(text).unwrap();
        let said: Vec<String> = found.missing.iter().map(Missing::to_string).collect();
        let of =
            |line| format!("line {line}: <text> is left out, for fonts are not read; convert it to paths");
        assert_eq!((found.elements.len(), said), (1, vec![of(2), of(3)]));
    }

    #[test]
    fn rectangles_may_be_round_and_what_has_no_size_is_not_drawn() {
        let found = read(
            "<svg><rect width='4' height='2' rx='9'/><rect width='4'/><circle r='0'/><path d='M1 1Z'/>\
             <g style='fill:red; display : none'><circle r='1'/></g></svg>",
        );
        let found = found.unwrap();
        assert_eq!(found.len(), 1);
        let off = |p: &Point| (((p[0] - 2.0) / 2.0).powi(2) + (p[1] - 1.0).powi(2) - 1.0).abs();
        assert!(found[0].points.iter().all(|p| off(p) < 1e-3), "an ellipse: {found:?}");
        assert!(read("<svg><circle r='-1'/></svg>").is_err());
    }

    #[test]
    fn what_is_hidden_is_not_drawn_but_for_what_is_visible_in_it() {
        let text = "<svg><g visibility='hidden'><circle r='1'/><rect width='1' height='2' style='visibility:visible'/></g>\
            <circle r='1' style='visibility: collapse'/></svg>";
        let found = read(text).unwrap();
        assert_eq!((found.len(), found[0].points[2]), (1, [1.0, 2.0]));
    }

    #[test]
    fn transforms_may_be_properties_and_have_an_origin() {
        let text = "<svg><rect width='1' height='2' style='transform: translate(3px, 4px) scale(2)' transform='scale(9)'/>\
            <rect width='1' height='2' transform='scale(2)' transform-origin='1 2'/><rect width='1' height='2' transform='none'/></svg>";
        let found: Vec<Vec<Point>> = read(text).unwrap().into_iter().map(|curve| curve.points).collect();
        let corners = |i: usize| (found[i][0], found[i][2]);
        assert_eq!(corners(0), ([3.0, 4.0], [5.0, 8.0]));
        assert_eq!(corners(1), ([-1.0, -2.0], [1.0, 2.0]));
        assert_eq!(corners(2), ([0.0, 0.0], [1.0, 2.0]));
        let error = read("<svg><rect transform='scale(2)' transform-origin='left'/></svg>").unwrap_err();
        assert!(error.to_string().contains("transform-origin"), "{error}");
    }

    #[test]
    fn fill_rules_are_inherited() {
        let text = "<svg><g style='fill-rule:evenodd'><path d='M0 0h1v1z'/><path fill-rule='nonzero' d='M0 0h1v1z'/></g>\
            <path d='M0 0h1v1z'/></svg>";
        let rules: Vec<FillRule> =
            read_drawing(text).unwrap().elements.iter().map(|element| element.fill_rule).collect();
        assert_eq!(rules, [FillRule::EvenOdd, FillRule::NonZero, FillRule::NonZero]);
    }

    #[test]
    fn what_is_filled_is_known_unless_a_style_sheet_may_say_otherwise() {
        let filled = |text: &str| -> Vec<bool> {
            read_drawing(text).unwrap().elements.iter().map(|element| element.is_filled).collect()
        };
        let two = "<polyline points='0,0 1,0 0,1'/><g fill='none'><path d='M0 0h1v1'/></g>";
        assert_eq!(filled(&format!("<svg>{two}</svg>")), [true, false]);
        assert_eq!(filled(&format!("<svg><style>path {{ fill: none }}</style>{two}</svg>")), [false; 2]);
    }

    #[test]
    fn document_types_and_their_entities_are_read() {
        let text = "<?xml version='1.0' standalone='no'?>\n<!DOCTYPE svg PUBLIC '-//W3C//DTD SVG 1.1//EN'\n\
            'http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd' [<!ENTITY ns 'http://www.w3.org/2000/svg'>\
            <!ENTITY d 'M0 0h2v1'>]>\n<svg xmlns='&ns;'><path d='&d;z'/></svg>";
        assert_eq!(read(text).unwrap()[0].points, [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0]]);
        // A thousand millions of entities.
        let mut text = "<!DOCTYPE svg [<!ENTITY e0 'M0 0h2v1'>".to_owned();
        for level in 1..10 {
            let copies = format!("&e{};", level - 1).repeat(10);
            let _ = write!(text, "<!ENTITY e{level} '{copies}'>");
        }
        text.push_str("]><svg><path d='&e9;'/></svg>");
        assert!(matches!(read(&text), Err(SvgError::Xml(_))));
    }

    #[test]
    fn what_is_wrong_is_said_with_its_line() {
        assert!(matches!(read("<svg><path"), Err(SvgError::Xml(_))));
        assert_eq!(read("<html/>"), Err(SvgError::Root("html".into())));
        let error = read("<svg>\n<path d='M 1 2 L x'/></svg>").unwrap_err();
        assert!(matches!(error, SvgError::Attribute { line: 2, attribute: "d", .. }), "{error}");
    }
}
