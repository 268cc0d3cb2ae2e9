//! The tree of a drawing: groups, nested drawings, and copies by `use`.

use super::lengths::{Of, length};
use super::path::Curve;
use super::shapes::{self, Wrong, attribute};
use super::transform::Transform;
use super::{Drawing, Element, FLATTENING, Missing, Polyline, SvgError, viewport};
use crate::{FillRule, Point};
use roxmltree::{Document, Node, NodeId, ParsingOptions};
use std::collections::HashMap;
use std::rc::Rc;

/// Elements whose content is not drawn in place.
const HIDDEN: [&str; 8] =
    ["defs", "clipPath", "mask", "symbol", "pattern", "marker", "metadata", "foreignObject"];

/// Largest number of elements that is read.
const MOST_NODES: u32 = 1 << 22;

/// Largest numbers of elements and of control points in copies, and of copies within copies.
const MOST_COPIES: usize = 1 << 20;
const MOST_POINTS: usize = 1 << 22;
const MOST_DEPTH: usize = 64;

/// The namespace of the older attribute for references.
const XLINK: &str = "http://www.w3.org/1999/xlink";

/// What an element has from those around it.
#[derive(Clone)]
struct Place {
    transform: Transform,
    fill_rule: FillRule,
    is_filled: bool,
    is_visible: bool,
    viewport: Option<Point>,
    copy: Option<Rc<Copy>>,
}

/// A copy by `use`.
struct Copy {
    /// The element that it shows, and the `use`, with its id.
    of: NodeId,
    by: NodeId,
    id: String,
    depth: usize,
    within: Option<Rc<Copy>>,
}

impl Copy {
    /// The copy and those that it is within.
    fn chain(this: Option<&Rc<Self>>) -> impl Iterator<Item = &Self> {
        std::iter::successors(this.map(Rc::as_ref), |copy| copy.within.as_deref())
    }
}

/// What is drawn of copies so far.
#[derive(Default)]
struct Count {
    elements: usize,
    points: usize,
}

pub(super) fn drawing(text: &str) -> Result<Drawing, SvgError> {
    // Illustrator, potrace and matplotlib begin drawings with a document type. Its entities are replaced in bounded depth and number.
    let options = ParsingOptions { allow_dtd: true, nodes_limit: MOST_NODES, ..ParsingOptions::default() };
    let document =
        Document::parse_with_options(text, options).map_err(|error| SvgError::Xml(error.to_string()))?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(SvgError::Root(root.tag_name().name().to_owned()));
    }
    let wrong = |node: Node<'_, '_>, (attribute, why): Wrong| SvgError::Attribute {
        line: line(node),
        element: node.tag_name().name().to_owned(),
        attribute,
        why,
    };
    let mut named: HashMap<&str, Node<'_, '_>> = HashMap::new();
    for node in root.descendants() {
        if let Some(id) = node.attribute("id") {
            named.entry(id).or_insert(node);
        }
    }
    let is_styled = root.descendants().any(|node| node.tag_name().name() == "style");
    let viewport = viewport::root(root).map_err(|why| wrong(root, why))?;
    let all = Place {
        transform: Transform::IDENTITY,
        fill_rule: FillRule::NonZero,
        is_filled: true,
        is_visible: true,
        viewport,
        copy: None,
    };
    let mut open = vec![(root, all)];
    let (mut elements, mut missing, mut count) = (Vec::new(), Vec::new(), Count::default());
    while let Some((node, above)) = open.pop() {
        if above.copy.is_some() {
            count.elements += 1;
            count.check(node)?;
        }
        let name = node.tag_name().name();
        // A symbol is drawn where a `use` shows it.
        let is_shown = above.copy.as_ref().is_some_and(|copy| copy.of == node.id());
        if (HIDDEN.contains(&name) && !(name == "symbol" && is_shown))
            || property(node, "display") == Some("none")
        {
            continue;
        }
        let mut place = placed(node, above).map_err(|why| wrong(node, why))?;
        if name == "use" {
            let Some(target) = used(node, &named) else {
                if place.is_visible {
                    missing.push(Missing::Use { line: line(node), href: href(node).to_owned() });
                }
                continue;
            };
            let shift = shift(node, place.viewport).map_err(|why| wrong(node, why))?;
            place.transform = place.transform.then_inner(shift);
            place.copy = Some(Rc::new(copied(node, target, place.copy.take())?));
            open.push((target, place));
            continue;
        }
        if name == "text" {
            let is_written =
                node.descendants().filter_map(|part| part.text()).any(|text| !text.trim().is_empty());
            if place.is_visible && is_written {
                missing.push(Missing::Text { line: line(node) });
            }
            continue;
        }
        if (name == "svg" && node != root) || name == "symbol" {
            let by = place.copy.as_ref().filter(|_| is_shown).map(|copy| copy.by);
            let shown_by = by.and_then(|by| document.get_node(by));
            let (transform, viewport) =
                viewport::nested(node, shown_by, place.viewport).map_err(|why| wrong(node, why))?;
            place.transform = place.transform.then_inner(transform);
            place.viewport = viewport;
        }
        let mut curves = shapes::curves(node, place.viewport).map_err(|why| wrong(node, why))?;
        if place.copy.is_some() {
            count.points += curves.iter().map(Curve::pieces).sum::<usize>();
            count.check(node)?;
        }
        if !curves.is_empty() && place.is_visible {
            for curve in &mut curves {
                curve.transform(&place.transform);
            }
            let outermost = Copy::chain(place.copy.as_ref()).filter(|copy| !copy.id.is_empty()).last();
            let id = outermost.map_or(node.attribute("id").unwrap_or_default(), |copy| &copy.id);
            // Of lines alone, one inside another is the border of a hole.
            let fill_rule = if place.is_filled { place.fill_rule } else { FillRule::EvenOdd };
            elements.push(element(id, (fill_rule, place.is_filled && !is_styled), &curves));
        }
        let children: Vec<Node<'_, '_>> = node.children().filter(Node::is_element).collect();
        open.extend(children.into_iter().rev().map(|child| (child, place.clone())));
    }
    // A copy may be within copies.
    missing.dedup();
    Ok(Drawing { elements, missing })
}

/// The line on which an element begins.
fn line(node: Node<'_, '_>) -> u32 {
    node.document().text_pos_at(node.range().start).row
}

/// A property in the attribute `style` of an element.
fn styled<'n>(node: Node<'n, '_>, name: &str) -> Option<&'n str> {
    let styles = node.attribute("style").unwrap_or_default().split(';');
    let styled = styles.filter_map(|style| style.split_once(':')).filter(|(of, _)| of.trim() == name);
    styled.map(|(_, value)| value.trim().trim_end_matches("!important").trim_end()).next_back()
}

/// A property of an element, from its attribute `style` or one of its own.
fn property<'n>(node: Node<'n, '_>, name: &str) -> Option<&'n str> {
    styled(node, name).or_else(|| node.attribute(name).map(str::trim))
}

/// The transform of an element, about the origin that it names.
fn transform(node: Node<'_, '_>, viewport: Option<Point>) -> Result<Transform, Wrong> {
    let own = match (styled(node, "transform"), node.attribute("transform")) {
        (Some(text), _) => Transform::parse_property(text),
        (None, Some(text)) => Transform::parse(text),
        (None, None) => return Ok(Transform::IDENTITY),
    };
    let own = own.map_err(|why| ("transform", why))?;
    let Some(origin) = property(node, "transform-origin") else { return Ok(own) };
    let words: Vec<&str> = origin.split_whitespace().collect();
    let [x, y] = words[..] else {
        let why = format!("`{origin}` is not two lengths; give the place in the transform itself");
        return Err(("transform-origin", why));
    };
    let at = |text, of| length(text, of, viewport).map_err(|why| ("transform-origin", why));
    let [x, y] = [at(x, Of::Width)?, at(y, Of::Height)?];
    Ok(Transform::shift([x, y]).then_inner(own).then_inner(Transform::shift([-x, -y])))
}

/// What an element has for its own content.
fn placed(node: Node<'_, '_>, above: Place) -> Result<Place, Wrong> {
    let transform = above.transform.then_inner(transform(node, above.viewport)?);
    let fill_rule = match property(node, "fill-rule") {
        Some("evenodd") => FillRule::EvenOdd,
        Some("nonzero") => FillRule::NonZero,
        _ => above.fill_rule,
    };
    let is_filled = match property(node, "fill") {
        Some("inherit") | None => above.is_filled,
        Some(paint) => paint != "none",
    };
    let is_visible = match property(node, "visibility") {
        Some("hidden" | "collapse") => false,
        Some("visible") => true,
        _ => above.is_visible,
    };
    Ok(Place { transform, fill_rule, is_filled, is_visible, ..above })
}

/// The reference of a `use`.
fn href<'n>(node: Node<'n, '_>) -> &'n str {
    node.attribute("href").or_else(|| node.attribute((XLINK, "href"))).unwrap_or_default().trim()
}

/// The element that a `use` refers to, if it is in the drawing.
fn used<'d>(node: Node<'d, 'd>, named: &HashMap<&str, Node<'d, 'd>>) -> Option<Node<'d, 'd>> {
    named.get(href(node).strip_prefix('#')?).copied()
}

/// How a `use` moves what it shows.
fn shift(node: Node<'_, '_>, viewport: Option<Point>) -> Result<Transform, Wrong> {
    let x = attribute(node, "x", Of::Width, viewport)?;
    let y = attribute(node, "y", Of::Height, viewport)?;
    Ok(Transform::shift([x, y]))
}

/// The copy of an element that a `use` shows, which is within another copy.
fn copied(by: Node<'_, '_>, of: Node<'_, '_>, within: Option<Rc<Copy>>) -> Result<Copy, SvgError> {
    let depth = 1 + within.as_ref().map_or(0, |copy| copy.depth);
    let is_around = by.ancestors().any(|around| around == of);
    if is_around || Copy::chain(within.as_ref()).any(|copy| copy.of == of.id()) {
        let id = of.attribute("id").unwrap_or_default().to_owned();
        return Err(SvgError::Cycle { line: line(by), id });
    }
    if depth > MOST_DEPTH {
        return Err(SvgError::Copies {
            line: line(by),
            what: "levels of copies within copies",
            most: MOST_DEPTH,
        });
    }
    let id = by.attribute("id").unwrap_or_default().to_owned();
    Ok(Copy { of: of.id(), by: by.id(), id, depth, within })
}

impl Count {
    fn check(&self, node: Node<'_, '_>) -> Result<(), SvgError> {
        let many = |what, most| Err(SvgError::Copies { line: line(node), what, most });
        match self {
            Self { elements, .. } if *elements > MOST_COPIES => many("elements", MOST_COPIES),
            Self { points, .. } if *points > MOST_POINTS => many("points", MOST_POINTS),
            Self { .. } => Ok(()),
        }
    }
}

/// An element with its curves as chords.
fn element(id: &str, (fill_rule, is_filled): (FillRule, bool), curves: &[Curve]) -> Element {
    let controls: Vec<Point> = curves.iter().flat_map(Curve::controls).collect();
    let [low, high] = crate::outline::bounds(&controls);
    let tolerance = FLATTENING * crate::outline::distance(low, high);
    let flat = |curve: &Curve| Polyline {
        id: id.to_owned(),
        points: curve.flatten(tolerance),
        is_closed: curve.is_closed,
    };
    Element { id: id.to_owned(), fill_rule, is_filled, curves: curves.iter().map(flat).collect() }
}
