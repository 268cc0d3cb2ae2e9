//! What a page of two surfaces shows, as plain data: from this engine, from closed forms, or from elsewhere.

use pompeiu_figures::Image;
use pompeiu_figures::page::{Axis, Banner, Bounds, PointPair};

/// Two surfaces, A and B, how far the points of each are from the other one, where it is farthest, and how sure that is.
///
/// The page shows what it is given and proves nothing. Where the text says "proven", it is the caller who says so.
///
/// # Shapes and units
/// All lengths are in one unit, areas in its square; coordinates are those of the meshes. Fractions are between 0 and 1.
///
/// # Cost
/// The page takes 0.7 MB and some 30 bytes for each face where values are the same on both sides of an edge.
///
/// # Example
/// ```
/// use pompeiu_figures::page::{PageError, PointPair};
/// use pompeiu_hausdorff::show::{DeviationContent, DisplayTriangles, MeasuredSurface, SurfaceDeviation};
///
/// let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
/// let shifted = positions.iter().map(|[x, y, z]| [*x, *y, z + 0.5]).collect();
/// let surface = |name: &str, positions, deviation| MeasuredSurface {
///     name: name.into(),
///     path: format!("parts/{name}"),
///     vertices: 3,
///     faces: 1,
///     triangles: DisplayTriangles { positions, corners: vec![[0, 1, 2]], faces: vec![0], groups: None },
///     deviation,
/// };
/// let deviation = SurfaceDeviation {
///     values: vec![[0.5; 3]],
///     face_bounds: vec![[0.5, 0.5]],
///     distance: [0.5, 0.5],
///     witness: PointPair { from: [0.0; 3], to: [0.0, 0.0, 0.5] },
///     ..SurfaceDeviation::default()
/// };
/// let content = DeviationContent {
///     title: "A plate, and where it should be".into(),
///     unit: "mm".into(),
///     surfaces: [surface("a.stl", positions, Some(deviation)), surface("b.stl", shifted, None)],
///     ..DeviationContent::default()
/// };
/// assert!(content.page()?.html().contains("A plate"));
/// # Ok::<(), PageError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DeviationContent {
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
    /// Ends of tolerance bands, ascending: values are deviations of B from A, negative where it lacks something. May be empty.
    pub bands: Vec<f64>,
    /// What the surfaces are called; where that is empty, A and B.
    pub labels: [String; 2],
    /// The answer that a person acts on, above everything else, if there is one. Then colours end at the threshold at first, and what is
    /// farther is painted.
    pub verdict: Option<Banner>,
    /// A picture for browsers that cannot draw the surfaces.
    pub still: Option<Image>,
    /// Encloses the greater of both directed distances, if both were measured.
    pub distance: Option<Bounds>,
    /// A and B.
    pub surfaces: [MeasuredSurface; 2],
    /// How the answer was proved, paragraph by paragraph.
    pub proof: Vec<String>,
    /// What is said of a certificate beside the page, names and values; empty where there is none.
    pub attached: Vec<[String; 2]>,
    /// Anything else about the run, such as times: names and values.
    pub facts: Vec<[String; 2]>,
    /// The command that makes this page again.
    pub command: Option<String>,
    /// The version of the program.
    pub version: String,
}

/// A mesh, and what was measured on it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeasuredSurface {
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
    pub deviation: Option<SurfaceDeviation>,
}

/// Triangles to draw: the faces, or parts of them where values bend inside a face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DisplayTriangles {
    /// Where corners are. Equal positions are one vertex on the page.
    pub positions: Vec<[f64; 3]>,
    /// The positions of the corners of each.
    pub corners: Vec<[u32; 3]>,
    /// The face of the mesh that each is a part of.
    pub faces: Vec<u32>,
    /// Where a mesh has more faces than can be drawn, the number of groups of faces that are drawn as one each; then the numbers above and
    /// those of regions and bounds are those of groups.
    pub groups: Option<usize>,
}

/// How far the points of a surface are from the other one.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SurfaceDeviation {
    /// The distance at each corner of each display triangle; between them it is drawn linear.
    pub values: Vec<[f64; 3]>,
    /// For each face, or each group of faces, an enclosure of the largest distance (without sign) that it reaches.
    pub face_bounds: Vec<Bounds>,
    /// Encloses the directed distance.
    pub distance: Bounds,
    /// The reason for which the search ended.
    pub stop: String,
    /// The pair of points that proves the lower end.
    pub witness: PointPair,
    /// Numbers about the whole surface, with their names.
    pub statistics: Vec<(String, Bounds)>,
    /// The share of the area in each class of the tolerance bands, from too low to too high; may be empty.
    pub bands: Vec<Bounds>,
    /// How values are spread over the area.
    pub histogram: Histogram,
    /// How much of the area is farther than a distance.
    pub exceedance: Exceedance,
    /// The worst places, the worst first.
    pub regions: Vec<Region>,
    /// What the search had left, the coarsest tolerance first.
    pub stages: Vec<SearchStage>,
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

impl SurfaceDeviation {
    /// The largest distance that is known of: proven or drawn.
    pub(super) fn largest(&self) -> f64 {
        let drawn = self.values.as_flattened().iter().map(|value| value.abs());
        drawn.fold(self.distance[1], |a, b| if b > a { b } else { a })
    }

    /// The least recorded distance that such a share of the area is within; at most the largest.
    pub(super) fn distance_covering(&self, share: f64) -> f64 {
        let largest = self.largest();
        self.exceedance.covering(1.0 - share).map_or(largest, |distance| distance.min(largest))
    }
}

impl Exceedance {
    /// The least recorded distance, other than zero, that all but such a part of the area is within.
    pub(super) fn covering(&self, all_but: f64) -> Option<f64> {
        let place = self.fractions.iter().position(|fraction| fraction[1] <= all_but)?;
        self.distances.get(place).copied().filter(|at| *at != 0.0)
    }
}
