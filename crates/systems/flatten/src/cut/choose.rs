//! Choosing the edges to cut.

use super::costs::{Closed, Costs};
use super::disk::disk_cut;
use super::iterate::{Metric, iterate};
use super::skeleton::Skeleton;
use super::tips::tips;
use super::tree::GrowingCut;
use super::{CutError, open};
use crate::components::{Component, in_whole, split};
use crate::symmetry::{self, SymmetryError, SymmetryPlane};
use pompeiu_core::mesh::UnionFind;
use pompeiu_core::{FaceId, VertexId};
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, SurfaceMesh};
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
    fn follows_balls(&self) -> bool {
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
    fn forbids(&self) -> bool {
        !(self.forbidden.is_empty() && self.forbidden_edges.is_empty() && self.forbidden_faces.is_empty())
    }
}

/// Chooses the edges that open a surface, so that each of its components becomes a disk.
///
/// # Definition
/// See [`CutStrategy`]. Shortest paths run along edges. A cut never enters a forbidden vertex.
///
/// # Errors
/// [`CutError`]; [`CutError::NoDisk`] if the result is no disk, for instance a sphere cut by [`CutStrategy::Genus`].
///
/// # Cost
/// O(E log E) for each path and each root tried.
pub fn choose_cut(surface: &EmbeddedSurface, options: &CutOptions) -> Result<EdgeData<bool>, CutError> {
    let mesh = surface.mesh();
    let requested = requested_edges(mesh, options)?;
    let mut cut = EdgeData::filled(mesh.edges(), false);
    if let Some(requested) = requested {
        cut = requested;
    } else {
        for part in split(surface, options.symmetry.as_ref())? {
            let chosen = first_cut(&part, &part.options(options)).map_err(|error| in_whole(error, &part))?;
            part.mark_in(mesh, &chosen, &mut cut);
        }
    }
    open(mesh, &cut)?.check_disks()?;
    Ok(cut)
}

/// The edges of the paths that the caller gave, if these are the whole cut.
pub(crate) fn requested_edges(
    mesh: &SurfaceMesh,
    options: &CutOptions,
) -> Result<Option<EdgeData<bool>>, CutError> {
    let vertices = mesh.vertices();
    let mut named = options.forbidden.iter().chain(options.forbidden_edges.iter().flatten());
    if let Some(&vertex) = named.find(|v| v.index() >= vertices) {
        return Err(CutError::NoVertex { vertex, vertices });
    }
    if let Some(&ends) = options.forbidden_edges.iter().find(|&&ends| edge_between(mesh, ends).is_none()) {
        return Err(CutError::NoEdge { ends });
    }
    if let Some(&face) = options.forbidden_faces.iter().find(|face| face.index() >= mesh.faces()) {
        return Err(CutError::NoFace { face, faces: mesh.faces() });
    }
    if !options.curvature.is_finite() || options.curvature < 0.0 {
        return Err(CutError::Curvature { weight: options.curvature });
    }
    if let Some(spread) = options.spread.filter(|spread| !(spread.is_finite() && *spread > 0.0)) {
        return Err(CutError::Spread { spread });
    }
    match &options.strategy {
        CutStrategy::Through(through) => match through.iter().find(|v| v.index() >= vertices) {
            Some(&vertex) => Err(CutError::NoVertex { vertex, vertices }),
            None => Ok(None),
        },
        CutStrategy::Along(_) if options.symmetry.is_some() => {
            Err(SymmetryError::Strategy { strategy: options.strategy.name() }.into())
        }
        CutStrategy::Along(paths) => {
            let mut cut = EdgeData::filled(mesh.edges(), false);
            let closed = Closed::new(mesh, options);
            for step in paths.iter().flat_map(|path| path.windows(2)) {
                let ends = [step[0], step[1]];
                if let Some(&vertex) = ends.iter().find(|v| v.index() >= vertices) {
                    return Err(CutError::NoVertex { vertex, vertices });
                }
                let edge = edge_between(mesh, ends).ok_or(CutError::NoEdge { ends })?;
                if closed.forbid_edge(edge) {
                    return Err(CutError::ForbiddenEdge { ends });
                }
                cut[edge] = true;
            }
            Ok(Some(cut))
        }
        _ => Ok(None),
    }
}

/// The edge between two vertices.
pub(crate) fn edge_between(mesh: &SurfaceMesh, [a, b]: [VertexId; 2]) -> Option<EdgeId> {
    let around = mesh.outgoing(a).flat_map(|h| [h, h.previous()]);
    around.into_iter().find(|&h| a != b && [mesh.tail(h), mesh.head(h)].contains(&b)).map(|h| mesh.edge(h))
}

/// The cut of a connected surface, before cuts are added to reduce distortion.
pub(crate) fn first_cut(part: &Component, options: &CutOptions) -> Result<EdgeData<bool>, CutError> {
    if let Some(images) = &part.images {
        return symmetry::first_cut(&part.surface, images, options);
    }
    let surface = &part.surface;
    let mesh = surface.mesh();
    let costs = Costs::new(surface, options);
    let nowhere = || CutError::Forbidden { face: FaceId(0) };
    let base = disk_cut(surface.surface(), &costs);
    if !costs.total(&base).is_finite() {
        return Err(nowhere());
    }
    let mut cut = GrowingCut::new(surface.surface(), &costs, base);
    let is_sphere = cut.is_empty();
    match &options.strategy {
        CutStrategy::Genus | CutStrategy::Along(_) => {}
        CutStrategy::Auto if !is_sphere => {}
        CutStrategy::Auto | CutStrategy::Tips => {
            let mut ends = tips(surface.surface());
            ends.retain(|&v| !costs.forbid(v));
            if !is_sphere || ends.len() > 1 {
                cut.join(&ends);
            }
            if is_sphere && !cut.edges.contains(&true) {
                iterate(surface, &costs, &mut cut, Metric::Straight, 1, None);
            }
        }
        CutStrategy::Euclidean { cuts } => {
            iterate(surface, &costs, &mut cut, Metric::Straight, *cuts, options.spread);
        }
        CutStrategy::Geodesic { cuts } => {
            iterate(surface, &costs, &mut cut, Metric::Surface, *cuts, options.spread);
        }
        CutStrategy::Medial { balls } => {
            let ends = Skeleton::new(surface, &costs, *balls)?.ends();
            cut.join(&ends);
        }
        CutStrategy::MedialTree { balls } => {
            let joints = Skeleton::new(surface, &costs, *balls)?.joints();
            cut.join(&joints.into_iter().flatten().collect::<Vec<_>>());
        }
        CutStrategy::Bones { balls, sections } => {
            let skeleton = Skeleton::new(surface, &costs, *balls)?;
            cut.edges = skeleton.bones(&cut.edges);
            if *sections {
                cut.edges = skeleton.with_sections(cut.edges);
            }
        }
        CutStrategy::Through(vertices) => {
            if !cut.join(vertices).is_empty() {
                return Err(nowhere());
            }
        }
    }
    if is_sphere && !cut.edges.contains(&true) && options.strategy.follows_balls() {
        // All balls are closest to the same vertex.
        cut = GrowingCut::new(surface.surface(), &costs, cut.edges);
        iterate(surface, &costs, &mut cut, Metric::Straight, 1, None);
    }
    if is_sphere {
        lengthen(surface, &costs, &mut cut.edges);
    }
    if !costs.total(&cut.edges).is_finite() {
        return Err(nowhere());
    }
    if open(mesh, &cut.edges)?.check_disks().is_err() && options.forbids() {
        return Err(nowhere());
    }
    Ok(cut.edges)
}

/// Adds edges to a cut in order, omitting those that would close a new loop.
pub(super) fn joined_edges(mesh: &SurfaceMesh, cut: &EdgeData<bool>, edges: &[EdgeId]) -> EdgeData<bool> {
    let mut joined = UnionFind::new(mesh.vertices());
    let of_cut = mesh.edge_ids().filter(|&edge| cut[edge] || mesh.is_boundary_edge(edge));
    for edge in of_cut {
        let [a, b] = mesh.ends(edge);
        joined.union(a.index(), b.index());
    }
    let mut cut = cut.clone();
    for &edge in edges {
        let [a, b] = mesh.ends(edge);
        if joined.union(a.index(), b.index()) {
            cut[edge] = true;
        }
    }
    cut
}

/// Extends a cut of a sphere that consists of a single edge, which would open nothing, to two edges.
fn lengthen(surface: &EmbeddedSurface, costs: &Costs, cut: &mut EdgeData<bool>) {
    let mesh = surface.mesh();
    let edges: Vec<EdgeId> = mesh.edge_ids().filter(|&edge| cut[edge]).collect();
    let [edge] = edges[..] else { return };
    let ends = mesh.ends(edge);
    let next = ends.into_iter().flat_map(|v| mesh.outgoing(v)).map(|h| mesh.edge(h)).filter(|&e| e != edge);
    if let Some(next) = next.min_by(|&a, &b| costs.of(a).total_cmp(&costs.of(b))) {
        cut[next] = true;
    }
}
