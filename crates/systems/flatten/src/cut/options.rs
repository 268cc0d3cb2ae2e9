//! The options of a cut.

use crate::symmetry::SymmetryPlane;
use pompeiu_core::{FaceId, VertexId};
use std::num::NonZeroUsize;

/// The strategy for choosing the edges to cut.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum CutStrategy {
    /// A cut that leaves a disk; closed surfaces of genus 0 are cut between their tips. Flattening adds cuts where distortion is
    /// high.
    #[default]
    Auto,
    /// The smallest cut that makes a surface a disk, by tree–cotree decomposition; for surfaces that are neither disks nor spheres.
    Genus,
    /// A shortest path between the two vertices farthest from each other in space; further cuts, up to this number, from the vertex
    /// farthest in space from the existing cut.
    Euclidean {
        /// Number of cuts, at least 1.
        cuts: usize,
    },
    /// The same with distances along edges; the pair is the vertex farthest from the first one, and the vertex farthest from that.
    Geodesic {
        /// Number of cuts, at least 1.
        cuts: usize,
    },
    /// A cut that leaves a disk, joined with the tips: local maxima of the average distance from the rest of the surface.
    Tips,
    /// A cut between two vertices chosen with medial balls: of the two balls farthest apart along the edges between balls, the
    /// touched vertices that are farthest apart.
    Medial {
        /// Number of balls.
        balls: NonZeroUsize,
    },
    /// A cut that leaves a disk, joined with the vertices nearest to the centres of medial balls.
    MedialTree {
        /// Number of balls.
        balls: NonZeroUsize,
    },
    /// A cut that leaves a disk, joined with a path along each bone: the edges of the minimum spanning tree of the medial balls.
    Bones {
        /// Number of balls.
        balls: NonZeroUsize,
        /// Whether to add an arc around the surface at the start of each bone.
        sections: bool,
    },
    /// A cut that leaves a disk, joined with these vertices by shortest paths.
    Through(Vec<VertexId>),
    /// Exactly these paths of edges, each given by its vertices.
    Along(Vec<Vec<VertexId>>),
}

impl CutStrategy {
    pub(super) fn follows_balls(&self) -> bool {
        matches!(self, Self::Medial { .. } | Self::MedialTree { .. } | Self::Bones { .. })
    }

    /// The name of the strategy in the command and in reports.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Genus => "genus",
            Self::Euclidean { .. } => "euclidean",
            Self::Geodesic { .. } => "geodesic",
            Self::Tips => "tips",
            Self::Medial { .. } => "medial",
            Self::MedialTree { .. } => "medial-tree",
            Self::Bones { .. } => "bones",
            Self::Through(_) => "through",
            Self::Along(_) => "along",
        }
    }
}

/// Options of a cut.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CutOptions {
    /// The strategy for choosing edges.
    pub strategy: CutStrategy,
    /// Vertices that no cut may touch.
    pub forbidden: Vec<VertexId>,
    /// Edges that no cut may take, by their ends.
    pub forbidden_edges: Vec<[VertexId; 2]>,
    /// Faces that no cut may enter; it may run along their border.
    pub forbidden_faces: Vec<FaceId>,
    /// How strongly paths avoid curvature: an edge costs its length times 1 + this times |κ| √area, with κ the mean of the absolute
    /// mean curvatures at both ends. At least 0.
    pub curvature: f64,
    /// For strategies that cut to the farthest vertex: stop as soon as the standard deviation (over the area) of the distance to
    /// the cut along edges is at most this, relative to the square root of the area. Above 0.
    pub spread: Option<f64>,
    /// A plane of symmetry of each component; the cut and the map will be symmetric, too. Edges must run along it.
    pub symmetry: Option<SymmetryPlane>,
}

impl CutOptions {
    /// Whether any place is forbidden.
    pub(crate) fn forbids(&self) -> bool {
        !(self.forbidden.is_empty() && self.forbidden_edges.is_empty() && self.forbidden_faces.is_empty())
    }
}
