//! Opening a surface.

use crate::{CutError, CutOptions, CutStrategy, Opened, SymmetryPlane, choose_cut, open, straighten};
use pompeiu_core::request::{Limit, Report, Request};
use pompeiu_core::run::StopReason;
use pompeiu_core::{FaceId, TriMesh, VertexId};
use pompeiu_surface::{EdgeData, EmbeddedSurface};
use std::num::NonZeroUsize;

#[cfg(feature = "clap")]
use pompeiu_core::request::values;

/// Most cuts where their number is left to the spread of distances.
const MOST_CUTS: usize = 100;

/// Open a surface along edges, so that each part becomes a disk.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CutRequest {
    /// The method that chooses the edges to cut.
    #[cfg_attr(feature = "clap", arg(long, value_enum))]
    pub strategy: Strategy,
    /// Number of cuts of the strategies euclidean and geodesic; with spread the most, 1 and 100 unless given.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub cuts: Option<NonZeroUsize>,
    /// With the strategies euclidean and geodesic, go on until the standard deviation of the distance from the cut is at most S √area.
    #[cfg_attr(feature = "clap", arg(long, value_name = "S"))]
    pub spread: Option<f64>,
    /// Number of balls of the strategies medial, medial-tree and bones.
    #[cfg_attr(feature = "clap", arg(long, value_name = "N"))]
    pub balls: NonZeroUsize,
    /// With the strategy bones, cut along an arc around the surface where each bone begins, too.
    #[cfg_attr(feature = "clap", arg(long))]
    pub sections: bool,
    /// Join these vertices, counted from 0, by shortest paths, instead of a strategy.
    #[cfg_attr(feature = "clap", arg(long, value_delimiter = ',', value_name = "V,V,…"))]
    pub through: Vec<u32>,
    /// Cut along this path of vertices joined by edges, and along nothing else; may be repeated.
    #[cfg_attr(feature = "clap", arg(long, value_parser = path, value_name = "V,V,…"))]
    pub along: Vec<Vec<u32>>,
    /// Let no cut touch these vertices.
    #[cfg_attr(feature = "clap", arg(long, value_delimiter = ',', value_name = "V,V,…"))]
    pub forbid: Vec<u32>,
    /// Let no cut take this edge, given by its ends; may be repeated.
    #[cfg_attr(feature = "clap", arg(long, value_parser = edge, value_name = "V,V"))]
    pub forbid_edges: Vec<[u32; 2]>,
    /// Let no cut enter these faces; it may run along their border.
    #[cfg_attr(feature = "clap", arg(long, value_delimiter = ',', value_name = "F,F,…"))]
    pub forbid_faces: Vec<u32>,
    /// Let no cut touch the vertices in this box, given by its least and its greatest coordinates.
    #[cfg_attr(
        feature = "clap",
        arg(long, value_parser = values::tuple::<6>, allow_hyphen_values = true, value_name = "X,Y,Z,X,Y,Z")
    )]
    pub forbid_box: Option<[f64; 6]>,
    /// Let paths keep away from curvature: an edge costs its length times 1 + W |κ| √area.
    #[cfg_attr(feature = "clap", arg(long, value_name = "W"))]
    pub avoid_curvature: f64,
    /// Keep a plane in which the surface is its own mirror image: x, y or z for the plane across that axis through the origin, x=C
    /// through C, or NX,NY,NZ,D for all points p with N · p = D; with the strategies auto, genus and tips, and with through.
    #[cfg_attr(feature = "clap", arg(long, allow_hyphen_values = true, value_name = "PLANE"))]
    pub symmetry: Option<SymmetryPlane>,
    /// Straighten the cut across faces, and insert it into the mesh.
    #[cfg_attr(feature = "clap", arg(long))]
    pub straighten: bool,
}

impl Default for CutRequest {
    fn default() -> Self {
        Self {
            strategy: Strategy::default(),
            cuts: None,
            spread: None,
            balls: const { NonZeroUsize::new(30).unwrap() },
            sections: false,
            through: Vec::new(),
            along: Vec::new(),
            forbid: Vec::new(),
            forbid_edges: Vec::new(),
            forbid_faces: Vec::new(),
            forbid_box: None,
            avoid_curvature: 0.0,
            symmetry: None,
            straighten: false,
        }
    }
}

/// The method that chooses the edges to cut.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Strategy {
    /// What leaves a disk of each part; the tips of a sphere joined.
    #[default]
    Auto,
    /// The least that makes a disk of what is neither a disk nor a sphere.
    Genus,
    /// The farthest pair of vertices in space joined, then the vertex farthest from the cut.
    Euclidean,
    /// The same with distances along the surface.
    Geodesic,
    /// What leaves a disk, and all tips.
    Tips,
    /// The touched vertices farthest apart of the balls at the ends of the longest path between balls.
    Medial,
    /// What leaves a disk, and the vertices nearest to the centres of balls.
    MedialTree,
    /// A path along each edge of the shortest tree between balls.
    Bones,
}

#[cfg(feature = "clap")]
fn path(text: &str) -> Result<Vec<u32>, String> {
    values::indices(text, 2)
}

#[cfg(feature = "clap")]
fn edge(text: &str) -> Result<[u32; 2], String> {
    let ends = values::indices(text, 2)?;
    ends.try_into().map_err(|_| "an edge has two ends".to_owned())
}

impl Request for CutRequest {
    const NAME: &'static str = "cut";
    const LIMITS: &'static [Limit] = &[];
    type Report = OpenedReport;
}

/// A surface that was opened.
#[derive(Clone, Debug)]
pub struct CutAnswer {
    /// The surface that was cut: the input, or what a straightened cut made of it.
    pub surface: EmbeddedSurface,
    /// Which edges of it were cut.
    pub cut: EdgeData<bool>,
    /// The surface after the cut.
    pub mesh: TriMesh,
    /// What is said of it.
    pub report: OpenedReport,
}

/// The surface after the cut. Lengths are in the unit of the mesh.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct OpenedReport {
    /// Number of vertices.
    pub vertices: usize,
    /// The number of copies among them.
    pub copies: usize,
    /// Number of faces.
    pub faces: usize,
    /// Number of connected parts, each of them a disk.
    pub components: usize,
    /// The cut.
    pub cut: CutEdges,
    /// Vertices minus edges plus faces: 1 for each disk.
    pub euler_characteristic: isize,
    /// Number of boundary loops: 1 for each disk.
    pub boundary_loops: usize,
    /// For each vertex the vertex of the input that it is a copy of, vertices without faces not counted; those that a straightened cut
    /// made follow behind.
    pub vertex_map: Vec<u32>,
}

/// The cut.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct CutEdges {
    /// Number of edges.
    pub edges: usize,
    /// Their length.
    pub length: f64,
    /// The method that chose them.
    pub strategy: &'static str,
}

impl Report for OpenedReport {
    fn stop(&self) -> StopReason {
        StopReason::Tolerance
    }
}

impl CutRequest {
    /// Opens a surface.
    ///
    /// # Errors
    /// [`CutError`].
    pub fn run(&self, mut surface: EmbeddedSurface) -> Result<CutAnswer, CutError> {
        let options = self.options(&surface)?;
        let mut cut = choose_cut(&surface, &options)?;
        if self.straighten {
            let straight = straighten(&surface, &cut)?;
            (surface, cut) = (straight.surface, straight.cut);
        }
        let opened = open(surface.mesh(), &cut)?;
        let positions = opened.spread(surface.positions().as_slice());
        let mesh = TriMesh::new(positions, opened.faces().to_vec())?;
        let report = report(&surface, &cut, &opened, options.strategy.name());
        Ok(CutAnswer { surface, cut, mesh, report })
    }

    /// Where to cut, as the algorithms take it.
    ///
    /// # Errors
    /// [`CutError::Both`] if two ways to choose are given.
    pub fn options(&self, surface: &EmbeddedSurface) -> Result<CutOptions, CutError> {
        let ids = |list: &[u32]| -> Vec<VertexId> { list.iter().copied().map(VertexId).collect() };
        let given = [
            ("a strategy", self.strategy != Strategy::Auto),
            ("through", !self.through.is_empty()),
            ("along", !self.along.is_empty()),
        ];
        let given: Vec<&'static str> =
            given.into_iter().filter(|(_, is)| *is).map(|(name, _)| name).collect();
        if let [first, second, ..] = given[..] {
            return Err(CutError::Both { first, second });
        }
        if self.straighten && self.symmetry.is_some() {
            return Err(CutError::Both { first: "symmetry", second: "straighten" });
        }
        let strategy = if !self.through.is_empty() {
            CutStrategy::Through(ids(&self.through))
        } else if !self.along.is_empty() {
            CutStrategy::Along(self.along.iter().map(|path| ids(path)).collect())
        } else {
            match self.strategy {
                Strategy::Auto => CutStrategy::Auto,
                Strategy::Genus => CutStrategy::Genus,
                Strategy::Euclidean => CutStrategy::Euclidean { cuts: self.number() },
                Strategy::Geodesic => CutStrategy::Geodesic { cuts: self.number() },
                Strategy::Tips => CutStrategy::Tips,
                Strategy::Medial => CutStrategy::Medial { balls: self.balls },
                Strategy::MedialTree => CutStrategy::MedialTree { balls: self.balls },
                Strategy::Bones => CutStrategy::Bones { balls: self.balls, sections: self.sections },
            }
        };
        let mut forbidden = ids(&self.forbid);
        if let Some(b) = self.forbid_box {
            let is_inside = |p: &[f64; 3]| (0..3).all(|k| b[k] <= p[k] && p[k] <= b[k + 3]);
            forbidden.extend(surface.positions().entries().filter(|(_, p)| is_inside(p)).map(|(v, _)| v));
        }
        Ok(CutOptions {
            strategy,
            forbidden,
            forbidden_edges: self.forbid_edges.iter().map(|ends| ends.map(VertexId)).collect(),
            forbidden_faces: self.forbid_faces.iter().copied().map(FaceId).collect(),
            curvature: self.avoid_curvature,
            spread: self.spread,
            symmetry: self.symmetry,
        })
    }

    /// The number of cuts.
    fn number(&self) -> usize {
        let unless_given = if self.spread.is_some() { MOST_CUTS } else { 1 };
        self.cuts.map_or(unless_given, NonZeroUsize::get)
    }
}

fn report(
    surface: &EmbeddedSurface,
    cut: &EdgeData<bool>,
    opened: &Opened,
    strategy: &'static str,
) -> OpenedReport {
    let mesh = opened.mesh();
    let edges: Vec<_> = surface.mesh().edge_ids().filter(|&edge| cut[edge]).collect();
    OpenedReport {
        vertices: mesh.vertices(),
        copies: mesh.vertices() - surface.mesh().vertices(),
        faces: mesh.faces(),
        components: mesh.components(),
        cut: CutEdges {
            edges: edges.len(),
            length: edges.iter().fold(0.0, |sum, &edge| sum + surface.surface().edge_length(edge)),
            strategy,
        },
        euler_characteristic: mesh.euler_characteristic(),
        boundary_loops: mesh.boundary_loops().len(),
        vertex_map: opened.vertex_map().iter().map(|v| v.0).collect(),
    }
}
