//! Outlines from a file: a picture, a drawing, or a list of points.

use crate::crossing::first_crossing_of;
use crate::dxf::{self, DxfError};
use crate::outline::signed_area;
use crate::picture::{Picture, PictureError, PictureFormat};
use crate::silhouette::{SilhouetteError, SilhouetteOptions, silhouette_and_rest};
use crate::svg::{self, Missing, Polyline, SvgError};
use crate::{FillRule, Outline, OutlineError, Point, Region, Turn, orientation, regions};
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Why a file cannot be used as outlines.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FileError {
    /// It cannot be read.
    #[error("it cannot be read: {0}")]
    Io(#[from] std::io::Error),
    /// It is larger than the limit.
    #[error("it has {found} bytes; at most {most} are read")]
    Large {
        /// Bytes that it has.
        found: u64,
        /// Largest number of bytes that is read.
        most: u64,
    },
    /// The picture cannot be read.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// No shape was found in the picture.
    #[error(transparent)]
    Silhouette(#[from] SilhouetteError),
    /// The SVG drawing cannot be read.
    #[error(transparent)]
    Svg(#[from] SvgError),
    /// What is not in the curves of a drawing.
    #[error(transparent)]
    Missing(#[from] Missing),
    /// A drawing of nothing but what has no curves.
    #[error("there is no curve in the drawing: {0}")]
    OnlyMissing(Missing),
    /// The DXF drawing cannot be read.
    #[error(transparent)]
    Dxf(#[from] DxfError),
    /// A curve is no valid outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
    /// A curve crosses itself, and the parts on both sides of the crossing cancel each other.
    #[error(
        "a curve crosses itself: side {} meets side {} near ({}, {}), so that the areas of its parts cancel each other; move its corners apart \
         there, or draw the parts one by one", sides[0], sides[1], place[0], place[1]
    )]
    Bow {
        /// The sides, each named by the corner that it starts from.
        sides: [usize; 2],
        /// Approximate place.
        place: Point,
    },
    /// A line of a list of points does not hold two numbers.
    #[error("line {line}: expected two numbers, found `{found}`")]
    Line {
        /// Its number.
        line: usize,
        /// What stands there.
        found: String,
    },
    /// A drawing without a curve.
    #[error("there is no curve in the drawing")]
    Empty,
    /// A curve that is not closed.
    #[error("curve {index} of the drawing is open: it ends at ({}, {}), not where it began; close it", end[0], end[1])]
    Open {
        /// Its place in the drawing.
        index: usize,
        /// Where it ends.
        end: Point,
    },
    /// A folder without a shape.
    #[error("holds no picture (PNG, JPEG, GIF, BMP), drawing (SVG, DXF) or list of points")]
    NoShapes,
    /// Neither a picture nor a drawing.
    #[error("it is neither a picture (PNG, JPEG, GIF, BMP) nor a drawing (SVG, DXF) nor a list of points")]
    Unrecognised,
}

/// Largest size of a file that is read, in bytes.
const MOST_BYTES: u64 = 1 << 30;

/// Suffixes of pictures.
const PICTURES: [&str; 5] = ["png", "jpg", "jpeg", "gif", "bmp"];

/// Suffixes of drawings and lists.
const DRAWINGS: [&str; 4] = ["svg", "dxf", "txt", "csv"];

fn has_suffix(path: &Path, list: &[&str]) -> bool {
    path.extension().is_some_and(|suffix| list.iter().any(|known| suffix.eq_ignore_ascii_case(known)))
}

/// Whether a file's suffix is that of a picture.
pub fn is_picture(path: &Path) -> bool {
    has_suffix(path, &PICTURES)
}

/// Whether a file's suffix is that of a picture, a drawing or a list of points.
pub fn is_shape(path: &Path) -> bool {
    is_picture(path) || has_suffix(path, &DRAWINGS)
}

/// The shapes in a folder, by their suffixes and in the order of their names; a file itself.
///
/// # Errors
/// [`FileError`] if the folder cannot be read, or holds none.
pub fn shapes_in(path: &Path) -> Result<Vec<PathBuf>, FileError> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let entries = std::fs::read_dir(path)?.map(|entry| entry.map(|entry| entry.path()));
    let mut found = entries.collect::<Result<Vec<_>, _>>()?;
    found.retain(|path| path.is_file() && is_shape(path));
    found.sort();
    if found.is_empty() { Err(FileError::NoShapes) } else { Ok(found) }
}

/// A shape of a drawing.
#[derive(Debug)]
pub struct DrawnShape {
    /// What tells it from the other shapes of its file: the `id` of its element, or its place, from 1; none for the only one, and for what is
    /// not in the drawing.
    pub name: Option<String>,
    /// The shape, or why it cannot be used.
    pub region: Result<Region, FileError>,
}

/// The shapes in a file, in their order, and what of a picture is not measured: its other parts.
///
/// # Definition
/// A picture shows one shape, its largest part, and a list of points is one. In an SVG drawing each element is a shape, with the holes that
/// its fill rule leaves, or several where its parts lie beside each other; the ends of open curves are joined if it is filled. In a DXF drawing each curve, with the curves inside as holes, by the
/// even–odd rule. Each `use` of what is not in a drawing is an error in the place of a shape, after all shapes.
///
/// # Errors
/// [`FileError`] if nothing in the file can be used; it does not name the file.
pub fn read_shapes(
    path: &Path,
    options: &SilhouetteOptions,
) -> Result<(Vec<DrawnShape>, Option<LeftOut>), FileError> {
    let (shapes, rest) = shapes_and_rest(path, options)?;
    Ok((shapes, other_parts(&rest)))
}

/// Parts of a picture that are left out, by their areas relative to that of its shape.
fn other_parts(areas: &[f64]) -> Option<LeftOut> {
    (!areas.is_empty()).then(|| LeftOut::Shapes { others: areas.len(), share: areas.iter().sum() })
}

/// The shapes in a file, and of the parts of a picture that are not its shape their areas relative to that.
fn shapes_and_rest(
    path: &Path,
    options: &SilhouetteOptions,
) -> Result<(Vec<DrawnShape>, Vec<f64>), FileError> {
    let (mut groups, missing, rest) = match content(path, options)? {
        Content::Shape(region, rest) => (vec![(String::new(), Ok(vec![region]))], Vec::new(), rest),
        Content::Groups(groups, missing) => (groups, missing, Vec::new()),
    };
    if groups.is_empty() {
        return Err(missing.into_iter().next().map_or(FileError::Empty, FileError::OnlyMissing));
    }
    if let [(_, found)] = &mut groups[..]
        && found.is_err()
    {
        std::mem::replace(found, Ok(Vec::new()))?;
    }
    let mut shapes: Vec<DrawnShape> = Vec::new();
    for (id, found) in groups {
        let of = |region| DrawnShape { name: Some(id.clone()), region };
        match found {
            Ok(regions) => shapes.extend(regions.into_iter().map(|region| of(Ok(region)))),
            Err(error) => shapes.push(of(Err(error))),
        }
    }
    name(&mut shapes);
    shapes.extend(missing.into_iter().map(|missing| DrawnShape { name: None, region: Err(missing.into()) }));
    Ok((shapes, rest))
}

/// Names shapes by their ids, or by their places where these are empty, numbers, or not the only ones.
fn name(shapes: &mut [DrawnShape]) {
    let mut times: HashMap<String, usize> = HashMap::new();
    for shape in &*shapes {
        *times.entry(shape.name.clone().unwrap_or_default()).or_default() += 1;
    }
    let is_alone = shapes.len() == 1;
    for (i, shape) in shapes.iter_mut().enumerate() {
        let is_usable = |id: &String| !id.is_empty() && id.parse::<u64>().is_err() && times[id] == 1;
        let id = shape.name.take().filter(is_usable);
        shape.name = (!is_alone).then(|| id.unwrap_or_else(|| (i + 1).to_string()));
    }
}

/// What is in a file: one shape, and the areas of other parts of a picture relative to it; or the shapes of each element of a drawing, with its id, and what is missing.
enum Content {
    Shape(Region, Vec<f64>),
    Groups(Vec<(String, Result<Vec<Region>, FileError>)>, Vec<Missing>),
}

fn content(path: &Path, options: &SilhouetteOptions) -> Result<Content, FileError> {
    let found = std::fs::metadata(path)?.len();
    if found > MOST_BYTES {
        return Err(FileError::Large { found, most: MOST_BYTES });
    }
    let bytes = std::fs::read(path)?;
    if is_picture(path) || PictureFormat::of(&bytes).is_some() {
        let (region, rest) = silhouette_and_rest(&Picture::read(&bytes)?, options)?;
        return Ok(Content::Shape(region, rest));
    }
    let text = text(&bytes).ok_or(FileError::Unrecognised)?;
    let mut index = 0;
    let mut closed = |curves: Vec<Polyline>, is_filled: bool| -> Result<Vec<Vec<Point>>, FileError> {
        let first = index;
        index += curves.len();
        let joined = |curve: Polyline| Polyline { is_closed: curve.is_closed || is_filled, ..curve };
        curves.into_iter().enumerate().map(|(i, curve)| closed(first + i, joined(curve))).collect()
    };
    if text.trim_start().starts_with('<') {
        let drawing = svg::read_drawing(&text)?;
        let shapes = drawing.elements.into_iter().map(|element| {
            let curves = closed(element.curves, element.is_filled);
            (element.id, curves.and_then(|curves| Ok(regions(curves, element.fill_rule)?)))
        });
        Ok(Content::Groups(shapes.collect(), drawing.missing))
    } else if has_suffix(path, &["dxf"]) {
        let curves = dxf::read(&text)?;
        if curves.is_empty() {
            return Err(FileError::Empty);
        }
        let shape = regions(closed(curves, false)?, FillRule::EvenOdd)?;
        Ok(Content::Groups(vec![(String::new(), Ok(shape))], Vec::new()))
    } else {
        Ok(Content::Shape(Region { outer: list(&text)?, holes: Vec::new() }, Vec::new()))
    }
}

/// The text of a file: UTF-8, or UTF-16 with a byte order mark, or else Latin 1, in which the numbers are those of every code page.
/// `None` if it is no text.
fn text(bytes: &[u8]) -> Option<String> {
    let wide = |order: fn([u8; 2]) -> u16| {
        let units = bytes[2..].chunks_exact(2).map(|pair| order([pair[0], pair[1]]));
        char::decode_utf16(units).collect::<Result<String, _>>().ok()
    };
    match bytes {
        [0xff, 0xfe, ..] => wide(u16::from_le_bytes),
        [0xfe, 0xff, ..] => wide(u16::from_be_bytes),
        _ => match std::str::from_utf8(bytes) {
            Ok(text) => Some(text.trim_start_matches('\u{feff}').to_owned()),
            Err(_) if bytes.contains(&0) => None,
            Err(_) => Some(bytes.iter().map(|byte| char::from(*byte)).collect()),
        },
    }
}

/// The closed outlines in a file, in their order: of each shape in it, see [`read_shapes`], the outer one followed by its holes; and each
/// `use` of what is not in the drawing, which is left out.
///
/// # Errors
/// [`FileError`], also if one of the shapes cannot be used; it does not name the file.
pub fn read_outlines(
    path: &Path,
    options: &SilhouetteOptions,
) -> Result<(Vec<Outline>, Vec<Missing>), FileError> {
    let (mut outlines, mut missing) = (Vec::new(), Vec::new());
    for shape in shapes_and_rest(path, options)?.0 {
        match shape.region {
            Ok(Region { outer, holes }) => {
                outlines.push(outer);
                outlines.extend(holes);
            }
            Err(FileError::Missing(left_out)) => missing.push(left_out),
            Err(error) => return Err(error),
        }
    }
    Ok((outlines, missing))
}

/// What of a file is not in the region that is read from it.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LeftOut {
    /// What is not in the curves of a drawing.
    #[error(transparent)]
    Missing(#[from] Missing),
    /// Shapes beside the largest one, of a picture those of at least a thousandth of it.
    #[error(
        "only the largest of {} shapes is used; the others have {:.1} % of its area: leave them out, or join them to it", others + 1, 100.0 * share
    )]
    Shapes {
        /// Number of the other shapes.
        others: usize,
        /// Their area, relative to that of the largest one.
        share: f64,
    },
}

/// The region that a file shows: its outline of greatest area, with the outlines inside it as holes; and what is left out of a drawing, that
/// is shapes beside it and each `use` of what is not there.
///
/// # Errors
/// As [`read_outlines`].
pub fn read_region(path: &Path, options: &SilhouetteOptions) -> Result<(Region, Vec<LeftOut>), FileError> {
    let mut outlines = Vec::new();
    let (shapes, rest) = shapes_and_rest(path, options)?;
    let mut left_out: Vec<LeftOut> = other_parts(&rest).into_iter().collect();
    for shape in shapes {
        match shape.region {
            Ok(Region { outer, holes }) => {
                outlines.push((outer, true));
                outlines.extend(holes.into_iter().map(|hole| (hole, false)));
            }
            Err(FileError::Missing(missing)) => left_out.push(missing.into()),
            Err(error) => return Err(error),
        }
    }
    let areas: Vec<f64> = outlines.iter().map(|(outline, _)| outline.area()).collect();
    let largest = (0..areas.len()).max_by(|i, j| areas[*i].total_cmp(&areas[*j]).then(j.cmp(i)));
    let (outer, _) = outlines.swap_remove(largest.ok_or(FileError::Empty)?);
    let (inside, beside): (Vec<_>, Vec<_>) =
        outlines.into_iter().partition(|(other, _)| outer.contains(other.points()[0]));
    let others = || beside.iter().filter(|(_, is_outer)| *is_outer).map(|(other, _)| other.area());
    if others().next().is_some() {
        let share = others().sum::<f64>() / outer.area();
        left_out.push(LeftOut::Shapes { others: others().count(), share });
    }
    Ok((Region { outer, holes: inside.into_iter().map(|(hole, _)| hole).collect() }, left_out))
}

fn closed(index: usize, Polyline { points, is_closed, .. }: Polyline) -> Result<Vec<Point>, FileError> {
    match points.last() {
        Some(end) if !is_closed && points.first() != Some(end) => Err(FileError::Open { index, end: *end }),
        _ => without_bow(points),
    }
}

/// The points of a closed curve, unless it has no area because it crosses itself.
fn without_bow(mut points: Vec<Point>) -> Result<Vec<Point>, FileError> {
    let is_finite = points.iter().flatten().all(|x| x.is_finite());
    if !is_finite || points.len() < 4 || signed_area(&points) != 0.0 {
        return Ok(points);
    }
    points.dedup();
    let first = points[0];
    points.pop_if(|last| *last == first);
    let is_flat = points.windows(3).all(|p| orientation(p[0], p[1], p[2]) == Turn::Straight);
    match first_crossing_of(&points).filter(|_| !is_flat) {
        Some(crossing) => Err(FileError::Bow { sides: crossing.sides, place: crossing.place }),
        None => Ok(points),
    }
}

fn list(text: &str) -> Result<Outline, FileError> {
    let mut points = Vec::new();
    let mut is_first = true;
    for (line, text) in lines(text) {
        let text = text.trim();
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        let is_heading = text.starts_with(|c: char| c.is_alphabetic() || c == '"');
        let numbers: Option<Vec<f64>> = text
            .split(|c: char| c == ',' || c == ';' || c.is_whitespace())
            .map(|part| part.trim_matches('"'))
            .filter(|part| !part.is_empty())
            .map(|part| part.parse().ok())
            .collect();
        match numbers.as_deref() {
            Some(&[x, y]) => points.push([x, y]),
            _ if is_first && is_heading => (),
            _ => return Err(FileError::Line { line, found: text.chars().take(40).collect() }),
        }
        is_first = false;
    }
    Ok(Outline::new(without_bow(points)?)?)
}

/// The lines of a text, which end with LF, CR LF or CR, and their numbers.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut rest = Some(text);
    let lines = std::iter::from_fn(move || {
        let text = rest?;
        let Some(end) = text.find(['\n', '\r']) else { return rest.take() };
        let after = if text[end..].starts_with("\r\n") { end + 2 } else { end + 1 };
        rest = Some(&text[after..]);
        Some(&text[..end])
    });
    lines.enumerate().map(|(i, line)| (i + 1, line))
}
