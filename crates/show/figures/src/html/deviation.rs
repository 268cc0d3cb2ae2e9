//! The page of two surfaces and how far each is from the other.

use super::error::{check_bounds, check_finite};
use super::scene::Placement;
use super::{PageError, file};
use crate::ColorMap;
use serde_json::json;
use std::fmt::Write;

/// `[lower, upper]`: a number lies between them, ends included.
pub type Bounds = [f64; 2];

/// Two surfaces, A and B, how far the points of each are from the other one, where it is farthest, and how sure that is.
///
/// The page shows what it is given and proves nothing. Where the text says "proven", it is the caller who says so.
///
/// # Shapes and units
/// All lengths are in one unit, areas in its square; coordinates are those of the meshes. Fractions are between 0 and 1.
///
/// # Example
/// ```
/// use pompeiu_figures::html::*;
///
/// let corners = vec![[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]];
/// let shifted = vec![corners[0].map(|[x, y, z]| [x, y, z + 0.5])];
/// let surface = |name: &str, corners, deviation| PageSurface {
///     name: name.into(),
///     path: format!("parts/{name}"),
///     vertices: 3,
///     faces: 1,
///     triangles: DisplayTriangles { corners, faces: vec![0] },
///     deviation,
/// };
/// let deviation = Deviation {
///     values: vec![[0.5; 3]],
///     face_bounds: vec![[0.5, 0.5]],
///     distance: [0.5, 0.5],
///     witness: PointPair { from: [0.0; 3], to: [0.0, 0.0, 0.5] },
///     ..Deviation::default()
/// };
/// let page = DeviationPage {
///     title: "A plate, and where it should be".into(),
///     unit: "mm".into(),
///     surfaces: [surface("a.stl", corners, Some(deviation)), surface("b.stl", shifted, None)],
///     ..DeviationPage::default()
/// };
/// assert!(page.html()?.contains("A plate"));
/// # Ok::<(), PageError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviationPage {
    /// What the page is about.
    pub title: String,
    /// The unit of lengths as it is to be shown; empty where nobody knows.
    pub unit: String,
    /// The axis that points up at first.
    pub up: Axis,
    /// Whether values carry signs, for sides: then colours diverge from zero, and thresholds hold for sizes.
    pub signed: bool,
    /// Where the threshold stands at first; without one, at what all but a twentieth of the area is within.
    pub threshold: Option<f64>,
    /// Encloses the greater of both directed distances, if both were measured.
    pub distance: Option<Bounds>,
    /// A and B.
    pub surfaces: [PageSurface; 2],
    /// How the answer was proved, paragraph by paragraph.
    pub proof: Vec<String>,
    /// Anything else about the run, such as times: names and values.
    pub facts: Vec<[String; 2]>,
    /// The command that makes this page again.
    pub command: Option<String>,
    /// The version of the program.
    pub version: String,
}

/// One of the axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Axis {
    /// The first.
    X,
    /// The second, as in most formats made for pictures.
    #[default]
    Y,
    /// The third, as in most files of engineers.
    Z,
}

impl Axis {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
        }
    }
}

/// A mesh, and what was measured on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PageSurface {
    /// The name of the file.
    pub name: String,
    /// The file with its folder.
    pub path: String,
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Faces of the mesh.
    pub faces: usize,
    /// What to draw of it.
    pub triangles: DisplayTriangles,
    /// How far its points are from the other surface, where that was measured.
    pub deviation: Option<Deviation>,
}

/// Triangles to draw: the faces, or parts of them where values bend inside a face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DisplayTriangles {
    /// Corners of each.
    pub corners: Vec<[[f64; 3]; 3]>,
    /// The face of the mesh that each is a part of.
    pub faces: Vec<u32>,
}

/// How far the points of a surface are from the other one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The distance at each corner of each display triangle; between them it is drawn linear.
    pub values: Vec<[f64; 3]>,
    /// For each face, an enclosure of the largest distance (without sign) that it reaches.
    pub face_bounds: Vec<Bounds>,
    /// Encloses the directed distance.
    pub distance: Bounds,
    /// Why the search ended.
    pub stop: String,
    /// The pair of points that proves the lower end.
    pub witness: PointPair,
    /// Numbers about the whole surface.
    pub statistics: Vec<Statistic>,
    /// How values are spread over the area.
    pub histogram: Histogram,
    /// How much of the area is farther than a distance.
    pub exceedance: Exceedance,
    /// The worst places, the worst first.
    pub regions: Vec<Region>,
    /// What the search had left, the coarsest tolerance first.
    pub stages: Vec<SearchStage>,
}

/// A point of the surface that is measured, and one of the other surface nearest to it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PointPair {
    /// On the surface that is measured.
    pub from: [f64; 3],
    /// On the other one.
    pub to: [f64; 3],
}

/// A number with a name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Statistic {
    /// Its name.
    pub label: String,
    /// What encloses it.
    pub value: Bounds,
}

/// Fractions of the area by value.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Histogram {
    /// Ends of the bins, one more than there are bins.
    pub edges: Vec<f64>,
    /// For each bin, an enclosure of the fraction of the area in it.
    pub fractions: Vec<Bounds>,
}

/// Fractions of the area that are farther away than some distances.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Exceedance {
    /// The distances (sizes, where values are signed), increasing.
    pub distances: Vec<f64>,
    /// For each, an enclosure of the fraction of the area that is farther.
    pub fractions: Vec<Bounds>,
}

/// A connected place where the distance is large.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Region {
    /// Its middle.
    pub center: [f64; 3],
    /// Diameter of a ball around the middle that holds it.
    pub extent: f64,
    /// Its area.
    pub area: f64,
    /// Encloses the largest distance in it.
    pub peak: Bounds,
    /// Where that is, and the nearest point of the other surface.
    pub pair: PointPair,
    /// Its faces, to be outlined; may be empty.
    pub faces: Vec<u32>,
}

/// What a search knew at one tolerance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SearchStage {
    /// The tolerance, a length.
    pub tolerance: f64,
    /// What enclosed the directed distance then.
    pub distance: Bounds,
    /// Pieces that could still hold the maximum.
    pub remaining: Vec<[[f64; 3]; 3]>,
}

impl DeviationPage {
    /// The page as a file.
    ///
    /// # Accuracy
    /// Values and bounds travel in double precision; coordinates are rounded to single precision relative to the middle of the
    /// scene, so that large offsets cost no digits.
    ///
    /// # Errors
    /// What is missing, does not belong together or is no number; see [`PageError`].
    ///
    /// # Cost
    /// Linear in the triangles. The page takes 0.7 MB and some 30 bytes for each face where values are the same on both sides of
    /// an edge.
    pub fn html(&self) -> Result<String, PageError> {
        self.check()?;
        let points = self.surfaces.iter().flat_map(|s| s.triangles.corners.as_flattened());
        let placement = Placement::around(points);
        let colors = if self.signed { ColorMap::Vik } else { ColorMap::Viridis };
        let data = json!({
            "kind": "deviation",
            "title": self.title,
            "unit": self.unit,
            "up": self.up.name(),
            "signed": self.signed,
            "threshold": self.threshold,
            "distance": self.distance,
            "origin": placement.origin,
            "scale": placement.scale,
            "colors": { "name": colors.name(), "table": colors.table().as_flattened(), "contrast": colors.contrast() },
            "surfaces": [self.surfaces[0].data("A", placement), self.surfaces[1].data("B", placement)],
            "proof": self.proof,
            "facts": self.facts,
            "command": self.command,
            "version": self.version,
        });
        Ok(file(&self.title, &self.summary(), &data))
    }

    fn check(&self) -> Result<(), PageError> {
        check_finite("the threshold", &self.threshold)?;
        check_bounds("the distance", &self.distance)?;
        if self.surfaces.iter().all(|surface| surface.deviation.is_none()) {
            return Err(PageError::NothingMeasured);
        }
        for (i, surface) in self.surfaces.iter().enumerate() {
            if surface.triangles.corners.is_empty() {
                return Err(PageError::NoTriangles { surface: i });
            }
            surface.check()?;
        }
        Ok(())
    }

    /// The answer in a sentence, for readers without scripts.
    fn summary(&self) -> String {
        let [a, b] = [&self.surfaces[0], &self.surfaces[1]];
        let mut text = format!("{}.", self.title);
        for (from, to) in [(a, b), (b, a)] {
            if let Some(deviation) = &from.deviation {
                let [lower, upper] = deviation.distance;
                let unit = if self.unit.is_empty() { String::new() } else { format!(" {}", self.unit) };
                let _ = write!(
                    text,
                    " The farthest point of {} is [{lower}, {upper}]{unit} away from {}.",
                    from.name, to.name
                );
            }
        }
        text
    }
}
