//! Options of where a surface is cut.

use crate::numbers::tuple;
use anyhow::Context;
use clap::{Args, ValueEnum};
use pompeiu::core::{FaceId, VertexId};
use pompeiu::flatten::{CutOptions, CutStrategy, SymmetryPlane};
use pompeiu::surface::EmbeddedSurface;
use std::num::NonZeroUsize;
use std::path::{Path as FilePath, PathBuf};

/// Most cuts where their number is left to the spread of distances.
const MOST_CUTS: usize = 100;

#[derive(Args)]
pub(crate) struct CutChoice {
    /// How the edges to cut are chosen
    #[arg(long, value_enum, default_value_t)]
    pub(crate) strategy: Strategy,
    /// Number of cuts of the strategies euclidean and geodesic; with --spread the most, 1 and 100 unless given
    #[arg(long, value_name = "N")]
    pub(crate) cuts: Option<NonZeroUsize>,
    /// With the strategies euclidean and geodesic, go on until the standard deviation of the distance from the cut is at most S √area
    #[arg(long, value_name = "S")]
    pub(crate) spread: Option<f64>,
    /// Number of balls of the strategies medial, medial-tree and bones
    #[arg(long, default_value = "30", value_name = "N")]
    pub(crate) balls: NonZeroUsize,
    /// With the strategy bones, cut along an arc around the surface where each bone begins, too
    #[arg(long)]
    pub(crate) sections: bool,
    /// Join these vertices, counted from 0, by shortest paths
    #[arg(long, value_delimiter = ',', value_name = "V,V,…", conflicts_with = "strategy")]
    pub(crate) through: Vec<u32>,
    /// Cut along this path of vertices joined by edges, and along nothing else; may be repeated
    #[arg(long, value_parser = path, value_name = "V,V,…", conflicts_with_all = ["strategy", "through"])]
    pub(crate) along: Vec<Path>,
    /// Let no cut touch these vertices
    #[arg(long, value_delimiter = ',', value_name = "V,V,…")]
    pub(crate) forbid: Vec<u32>,
    /// Let no cut touch the vertices in this box, given by its least and its greatest coordinates
    #[arg(long, value_parser = tuple::<6>, allow_hyphen_values = true, value_name = "X,Y,Z,X,Y,Z")]
    pub(crate) forbid_box: Option<[f64; 6]>,
    /// Let no cut enter what this text file names, one on each line: v I a vertex, e I J an edge, f I a face
    #[arg(long, value_name = "FILE")]
    pub(crate) forbid_file: Option<PathBuf>,
    /// Let paths keep away from curvature: an edge costs its length times 1 + W |κ| √area
    #[arg(long, default_value = "0", value_name = "W")]
    pub(crate) avoid_curvature: f64,
    /// Keep a plane in which the surface is its own mirror image: x, y or z for the plane across that axis through the origin, x=C through C,
    /// or NX,NY,NZ,D for all points p with N · p = D; with the strategies auto, genus and tips, and --through
    #[arg(long, value_parser = plane, allow_hyphen_values = true, value_name = "PLANE")]
    pub(crate) symmetry: Option<SymmetryPlane>,
    /// Straighten the cut across faces, and insert it into the mesh
    #[arg(long, conflicts_with = "symmetry")]
    pub(crate) straighten: bool,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Strategy {
    /// What leaves a disk of each part; the tips of a sphere joined
    #[default]
    Auto,
    /// The least that makes a disk of what is neither a disk nor a sphere
    Genus,
    /// The farthest pair of vertices in space joined, then the vertex farthest from the cut
    Euclidean,
    /// The same with distances along the surface
    Geodesic,
    /// What leaves a disk, and all tips
    Tips,
    /// The touched vertices farthest apart of the balls at the ends of the longest path between balls
    Medial,
    /// What leaves a disk, and the vertices nearest to the centres of balls
    MedialTree,
    /// A path along each edge of the shortest tree between balls
    Bones,
}

/// The vertices of a path.
#[derive(Clone)]
pub(crate) struct Path(Vec<VertexId>);

fn path(text: &str) -> Result<Path, String> {
    let vertex = |part: &str| {
        part.trim().parse().map(VertexId).map_err(|_| format!("`{part}` is no index of a vertex"))
    };
    let path: Vec<VertexId> = text.split(',').map(vertex).collect::<Result<_, _>>()?;
    if path.len() > 1 { Ok(Path(path)) } else { Err("a path has two vertices at least".to_owned()) }
}

fn plane(text: &str) -> Result<SymmetryPlane, String> {
    let (name, offset) = text.split_once('=').unwrap_or((text, "0"));
    if let Some(axis) = ["x", "y", "z"].iter().position(|axis| *axis == name) {
        let mut normal = [0.0; 3];
        normal[axis] = 1.0;
        let [offset] = tuple::<1>(offset)?;
        return Ok(SymmetryPlane { normal, offset });
    }
    let [x, y, z, offset] = tuple::<4>(text)
        .map_err(|_| format!("`{text}` is no plane; expected x, y, z, x=C or the four numbers NX,NY,NZ,D"))?;
    Ok(SymmetryPlane { normal: [x, y, z], offset })
}

impl CutChoice {
    /// What the library is asked for.
    ///
    /// # Errors
    /// If the selection file cannot be read.
    pub(crate) fn options(&self, surface: &EmbeddedSurface) -> anyhow::Result<CutOptions> {
        let ids = |list: &[u32]| -> Vec<VertexId> { list.iter().copied().map(VertexId).collect() };
        let strategy = if !self.through.is_empty() {
            CutStrategy::Through(ids(&self.through))
        } else if !self.along.is_empty() {
            CutStrategy::Along(self.along.iter().map(|path| path.0.clone()).collect())
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
        let mut selection = match &self.forbid_file {
            Some(path) => read_selection(path)?,
            None => Selection::default(),
        };
        forbidden.append(&mut selection.vertices);
        Ok(CutOptions {
            strategy,
            forbidden,
            forbidden_edges: selection.edges,
            forbidden_faces: selection.faces,
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

/// Vertices, edges and faces that a file names.
#[derive(Debug, Default, PartialEq)]
struct Selection {
    vertices: Vec<VertexId>,
    edges: Vec<[VertexId; 2]>,
    faces: Vec<FaceId>,
}

fn read_selection(path: &FilePath) -> anyhow::Result<Selection> {
    crate::files::check_readable(path)?;
    let text = std::fs::read_to_string(path).with_context(|| path.display().to_string())?;
    selection(&text).map_err(|line| {
        let shown = path.display();
        anyhow::anyhow!("{shown}: line {line} is none of `v I`, `e I J` and `f I`; empty lines and lines after # are left out")
    })
}

/// What lines name; the number of the first line that names nothing.
fn selection(text: &str) -> Result<Selection, usize> {
    let mut selection = Selection::default();
    for (number, line) in text.lines().enumerate() {
        let line = line.split('#').next().unwrap_or_default();
        let parts: Vec<&str> = line.split_whitespace().collect();
        let index = |text: &str| text.parse::<u32>().map_err(|_| number + 1);
        match parts[..] {
            [] => {}
            ["v", i] => selection.vertices.push(VertexId(index(i)?)),
            ["e", i, j] => selection.edges.push([VertexId(index(i)?), VertexId(index(j)?)]),
            ["f", i] => selection.faces.push(FaceId(index(i)?)),
            _ => return Err(number + 1),
        }
    }
    Ok(selection)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn selections_name_vertices_edges_and_faces() {
        let found = selection("v 3\n# all of it\n\ne 4 5 # one\nf 6").unwrap();
        let expected = Selection {
            vertices: vec![VertexId(3)],
            edges: vec![[VertexId(4), VertexId(5)]],
            faces: vec![FaceId(6)],
        };
        assert_eq!(found, expected);
        for (wrong, line) in [("v", 1), ("v 1\ne 2", 2), ("x 1", 1), ("\n\nv -1", 3)] {
            assert_eq!(selection(wrong), Err(line), "{wrong}");
        }
    }

    #[test]
    fn planes_are_named_or_given_by_numbers() {
        let expected = |normal, offset| Ok(SymmetryPlane { normal, offset });
        assert_eq!(plane("y"), expected([0.0, 1.0, 0.0], 0.0));
        assert_eq!(plane("x=-0.5"), expected([1.0, 0.0, 0.0], -0.5));
        assert_eq!(plane("0,3,4,-2"), expected([0.0, 3.0, 4.0], -2.0));
        for wrong in ["", "w", "x=", "x=a", "1,2,3", "1,2,3,4,5"] {
            assert!(plane(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn paths_are_lists_of_vertices() {
        assert!(path("3,4, 5").is_ok_and(|path| path.0 == [VertexId(3), VertexId(4), VertexId(5)]));
        for wrong in ["", "3", "3,x", "3,-1"] {
            assert!(path(wrong).is_err(), "{wrong}");
        }
    }
}
