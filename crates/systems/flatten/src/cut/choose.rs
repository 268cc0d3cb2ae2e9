//! Choosing the edges to cut.

use super::costs::{Closed, Costs};
use super::disk::disk_cut;
use super::edges::edge_between;
use super::iterate::{Metric, iterate};
use super::skeleton::Skeleton;
use super::tips::tips;
use super::tree::GrowingCut;
use super::{CutError, CutOptions, CutStrategy, open};
use crate::components::{Component, in_whole, split};
use crate::symmetry::{self, SymmetryError};
use pompeiu_core::FaceId;
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, SurfaceMesh};

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
