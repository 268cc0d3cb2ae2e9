//! Options of where a surface is cut.

use crate::numbers::tuple;
use clap::{Args, ValueEnum};
use pompeiu::core::VertexId;
use pompeiu::flatten::{CutOptions, CutStrategy};
use pompeiu::surface::EmbeddedSurface;
use std::num::NonZeroUsize;

#[derive(Args)]
pub(crate) struct CutChoice {
    /// How the edges to cut are chosen
    #[arg(long, value_enum, default_value_t)]
    pub(crate) strategy: Strategy,
    /// Number of cuts of the strategy euclidean
    #[arg(long, default_value = "1", value_name = "N")]
    pub(crate) cuts: NonZeroUsize,
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
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum Strategy {
    /// What leaves a disk of each part; the tips of a sphere joined
    #[default]
    Auto,
    /// The least that makes a disk of what is neither a disk nor a sphere
    Genus,
    /// The farthest pair of vertices joined, then the vertex farthest from the cut
    Euclidean,
    /// What leaves a disk, and all tips
    Tips,
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

impl CutChoice {
    /// What the library is asked for.
    pub(crate) fn options(&self, surface: &EmbeddedSurface) -> CutOptions {
        let ids = |list: &[u32]| -> Vec<VertexId> { list.iter().copied().map(VertexId).collect() };
        let strategy = if !self.through.is_empty() {
            CutStrategy::Through(ids(&self.through))
        } else if !self.along.is_empty() {
            CutStrategy::Along(self.along.iter().map(|path| path.0.clone()).collect())
        } else {
            match self.strategy {
                Strategy::Auto => CutStrategy::Auto,
                Strategy::Genus => CutStrategy::Genus,
                Strategy::Euclidean => CutStrategy::Euclidean { cuts: self.cuts.get() },
                Strategy::Tips => CutStrategy::Tips,
            }
        };
        let mut forbidden = ids(&self.forbid);
        if let Some(b) = self.forbid_box {
            let is_inside = |p: &[f64; 3]| (0..3).all(|k| b[k] <= p[k] && p[k] <= b[k + 3]);
            forbidden.extend(surface.positions().entries().filter(|(_, p)| is_inside(p)).map(|(v, _)| v));
        }
        CutOptions { strategy, forbidden }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_lists_of_vertices() {
        assert!(path("3,4, 5").is_ok_and(|path| path.0 == [VertexId(3), VertexId(4), VertexId(5)]));
        for wrong in ["", "3", "3,x", "3,-1"] {
            assert!(path(wrong).is_err(), "{wrong}");
        }
    }
}
