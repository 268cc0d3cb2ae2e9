//! Outlines from a file: a picture, a drawing, or a list of points.

use crate::dxf::{self, DxfError};
use crate::picture::{Picture, PictureError, PictureFormat};
use crate::silhouette::{SilhouetteError, SilhouetteOptions, silhouette};
use crate::svg::{self, Polyline, SvgError};
use crate::{Outline, OutlineError, Region};
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
    /// The DXF drawing cannot be read.
    #[error(transparent)]
    Dxf(#[from] DxfError),
    /// A curve is no valid outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
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
        end: crate::Point,
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

/// The closed outlines in a file, in their order: the shape in a picture followed by its holes; the curves of a drawing; or the
/// polygon of a list of points with one `x y` or `x,y` per line.
///
/// # Errors
/// [`FileError`]; it does not name the file.
pub fn read_outlines(path: &Path, options: &SilhouetteOptions) -> Result<Vec<Outline>, FileError> {
    let found = std::fs::metadata(path)?.len();
    if found > MOST_BYTES {
        return Err(FileError::Large { found, most: MOST_BYTES });
    }
    let bytes = std::fs::read(path)?;
    if is_picture(path) || PictureFormat::of(&bytes).is_some() {
        let Region { outer, holes } = silhouette(&Picture::read(&bytes)?, options)?;
        return Ok([outer].into_iter().chain(holes).collect());
    }
    let text = String::from_utf8(bytes).map_err(|_| FileError::Unrecognised)?;
    let polylines = if text.trim_start().starts_with('<') {
        svg::read(&text)?
    } else if has_suffix(path, &["dxf"]) {
        dxf::read(&text)?
    } else {
        return Ok(vec![list(&text)?]);
    };
    if polylines.is_empty() {
        return Err(FileError::Empty);
    }
    polylines.into_iter().enumerate().map(|(index, polyline)| closed(index, polyline)).collect()
}

/// The region that a file shows: its outline of greatest area, with the outlines inside it as holes.
///
/// # Errors
/// As [`read_outlines`].
pub fn read_region(path: &Path, options: &SilhouetteOptions) -> Result<Region, FileError> {
    let mut outlines = read_outlines(path, options)?;
    let largest =
        (0..outlines.len()).max_by(|i, j| outlines[*i].area().total_cmp(&outlines[*j].area()).then(j.cmp(i)));
    let outer = outlines.swap_remove(largest.ok_or(FileError::Empty)?);
    outlines.retain(|hole| outer.contains(hole.points()[0]));
    Ok(Region { outer, holes: outlines })
}

fn closed(index: usize, Polyline { points, is_closed, .. }: Polyline) -> Result<Outline, FileError> {
    match points.last() {
        Some(end) if !is_closed && points.first() != Some(end) => Err(FileError::Open { index, end: *end }),
        _ => Ok(Outline::new(points)?),
    }
}

fn list(text: &str) -> Result<Outline, FileError> {
    let mut points = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty()
            || line.starts_with('#')
            || (i == 0 && line.starts_with(|c: char| c.is_alphabetic()))
        {
            continue;
        }
        let numbers: Option<Vec<f64>> = line
            .split(|c: char| c == ',' || c == ';' || c.is_whitespace())
            .filter(|part| !part.is_empty())
            .map(|part| part.parse().ok())
            .collect();
        match numbers.as_deref() {
            Some(&[x, y]) => points.push([x, y]),
            _ => return Err(FileError::Line { line: i + 1, found: line.chars().take(40).collect() }),
        }
    }
    Ok(Outline::new(points)?)
}
