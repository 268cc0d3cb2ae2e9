//! Viewports: the places of nested drawings and of symbols.

use super::lengths::{Of, length};
use super::numbers::numbers;
use super::shapes::{Wrong, attribute};
use super::transform::Transform;
use crate::Point;
use roxmltree::Node;

/// The `viewBox` of an element: its corner and its size.
fn view_box(node: Node<'_, '_>) -> Result<Option<[f64; 4]>, Wrong> {
    let Some(text) = node.attribute("viewBox") else { return Ok(None) };
    match numbers(text).map_err(|why| ("viewBox", why))?[..] {
        [x, y, w, h] if w > 0.0 && h > 0.0 => Ok(Some([x, y, w, h])),
        _ => Err(("viewBox", format!("`{text}` is no corner with a width and a height above 0"))),
    }
}

/// The size that percentages in the outermost element refer to; none if it states none.
pub(super) fn root(node: Node<'_, '_>) -> Result<Option<Point>, Wrong> {
    if let Some([.., w, h]) = view_box(node)? {
        return Ok(Some([w, h]));
    }
    let side = |name, of| node.attribute(name).and_then(|text| length(text, of, None).ok());
    Ok(side("width", Of::Width).zip(side("height", Of::Height)).map(|(w, h)| [w, h]))
}

/// Where the content of a nested `svg`, or of a `symbol`, lies, and its size. The attributes of a `use` that shows it go before its own.
pub(super) fn nested(
    node: Node<'_, '_>,
    shown_by: Option<Node<'_, '_>>,
    outer: Option<Point>,
) -> Result<(Transform, Option<Point>), Wrong> {
    let place = [attribute(node, "x", Of::Width, outer)?, attribute(node, "y", Of::Height, outer)?];
    let side = |name: &'static str, of, k: usize| {
        let own = shown_by.and_then(|shown_by| shown_by.attribute(name)).or_else(|| node.attribute(name));
        match own.map(str::trim).filter(|text| *text != "auto") {
            Some(text) => length(text, of, outer).map(Some).map_err(|why| (name, why)),
            None => Ok(outer.map(|outer| outer[k])),
        }
    };
    let size = side("width", Of::Width, 0)?.zip(side("height", Of::Height, 1)?).map(|(w, h)| [w, h]);
    let moved = Transform::shift(place);
    let Some([x, y, w, h]) = view_box(node)? else { return Ok((moved, size)) };
    let inside = Transform::shift([-x, -y]);
    // A size that nothing states leaves the unit as it is.
    let Some(size) = size else { return Ok((moved.then_inner(inside), Some([w, h]))) };
    let fit = fit(node.attribute("preserveAspectRatio").unwrap_or_default(), size, [w, h])
        .map_err(|why| ("preserveAspectRatio", why))?;
    Ok((moved.then_inner(fit).then_inner(inside), Some([w, h])))
}

/// Scales a box into a viewport.
fn fit(ratio: &str, size: Point, inner: Point) -> Result<Transform, String> {
    let scales = [size[0] / inner[0], size[1] / inner[1]];
    let mut words = ratio.split_whitespace();
    let align = words.next().unwrap_or("xMidYMid");
    if align == "none" {
        return Ok(Transform::scale(scales));
    }
    let scale = match words.next() {
        Some("slice") => scales[0].max(scales[1]),
        None | Some("meet") => scales[0].min(scales[1]),
        Some(other) => return Err(format!("expected meet or slice, found `{other}`")),
    };
    let share = |text: Option<&str>| match text {
        Some("Min") => Some(0.0),
        Some("Mid") => Some(0.5),
        Some("Max") => Some(1.0),
        _ => None,
    };
    let shares = share(align.get(1..4))
        .zip(share(align.get(5..)))
        .filter(|_| align.starts_with('x') && align.get(4..5) == Some("Y"));
    let (x, y) =
        shares.ok_or_else(|| format!("expected none or a place such as xMidYMid, found `{align}`"))?;
    let shift = [x * (size[0] - scale * inner[0]), y * (size[1] - scale * inner[1])];
    Ok(Transform::shift(shift).then_inner(Transform::scale([scale, scale])))
}
