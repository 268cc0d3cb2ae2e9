//! Chords of straight sides: inner edges between two vertices of one side of the boundary, divided at their midpoints.
//!
//! A convex combination map puts such an edge, and the faces beyond it, on the side itself. Without chords it is one-to-one
//! (`floater_mean_2003`, and the references there).

use crate::components::split;
use crate::cut::open;
use crate::map::straight_sides;
use crate::opened::{Disk, opened_surface};
use crate::straight::{divide, marked};
use crate::{ConvexBoundary, CutError, FlattenError};
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, HalfedgeId, SurfaceError};

/// A surface whose disks have no chords, and its cut.
pub(crate) struct WithoutChords {
    /// The vertices of the input, the midpoints, and the parts of the faces.
    pub(crate) mesh: TriMesh,
    pub(crate) surface: EmbeddedSurface,
    pub(crate) cut: EdgeData<bool>,
    /// Number of edges that were divided.
    pub(crate) divided: usize,
}

/// Divides the chords of the disks that a cut leaves; `None` if there are none.
pub(crate) fn without_chords(
    surface: &EmbeddedSurface,
    cut: &EdgeData<bool>,
    boundary: &ConvexBoundary,
) -> Result<Option<WithoutChords>, FlattenError> {
    let mut made: Option<WithoutChords> = None;
    loop {
        let (surface, cut) = made.as_ref().map_or((surface, cut), |made| (&made.surface, &made.cut));
        // Dividing can change the first vertex of a boundary loop and, with it, the corners. It ends, because no new edge joins two
        // vertices of the boundary.
        let chords = chords(surface, cut, boundary)?;
        if chords.is_empty() {
            return Ok(made);
        }
        let before = made.as_ref().map_or(0, |made| made.divided);
        made = Some(divided(surface, cut, &chords, before)?);
    }
}

/// The chords of all disks, as edges of the whole surface.
fn chords(
    surface: &EmbeddedSurface,
    cut: &EdgeData<bool>,
    boundary: &ConvexBoundary,
) -> Result<Vec<EdgeId>, FlattenError> {
    let opened = open(surface.mesh(), cut)?;
    opened.check_disks()?;
    let mut chords = Vec::new();
    for part in split(&opened_surface(&opened, surface)?, None)? {
        // As the map sees it: corners depend on the first edge of the boundary loop.
        let nothing_more = EdgeData::filled(part.surface.mesh().edges(), false);
        let disk = Disk::new(&part, &nothing_more)?;
        let mesh = disk.surface.mesh();
        let Some(&first) = mesh.boundary_loops().first() else { continue };
        let along: Vec<HalfedgeId> = mesh.boundary_loop(first).collect();
        let lengths: Vec<f64> =
            along.iter().map(|&h| disk.surface.surface().edge_length(mesh.edge(h))).collect();
        let sides = straight_sides(boundary, &lengths)?;
        let mut place = vec![None; mesh.vertices()];
        for (i, &h) in along.iter().enumerate() {
            place[mesh.tail(h).index()] = Some(i);
        }
        let on_one_side = |edge: EdgeId| {
            let [Some(v), Some(w)] = mesh.ends(edge).map(|v| place[v.index()]) else { return false };
            let is_on = |i: usize, [first, last]: [usize; 2]| {
                (first..=last).contains(&i) || (i == 0 && last == along.len())
            };
            sides.iter().any(|&side| is_on(v, side) && is_on(w, side))
        };
        let inner = mesh.edge_ids().filter(|&edge| !mesh.is_boundary_edge(edge) && on_one_side(edge));
        // Opening keeps faces and their corners.
        chords.extend(inner.map(|edge| part.edge_in(surface.mesh(), edge)));
    }
    Ok(chords)
}

fn divided(
    surface: &EmbeddedSurface,
    cut: &EdgeData<bool>,
    chords: &[EdgeId],
    before: usize,
) -> Result<WithoutChords, FlattenError> {
    let mesh = surface.mesh();
    let mut positions = surface.positions().as_slice().to_vec();
    let mut on_edges: EdgeData<Vec<(f64, u32)>> = EdgeData::filled(mesh.edges(), Vec::new());
    for &edge in chords {
        let [p, q] = mesh.ends(edge).map(|v| surface.positions()[v]);
        on_edges[edge].push((0.5, positions.len() as u32));
        positions.push([0, 1, 2].map(|k| 0.5 * p[k] + 0.5 * q[k]));
    }
    let paths: Vec<[u32; 2]> =
        mesh.edge_ids().filter(|&edge| cut[edge]).map(|edge| mesh.ends(edge).map(|v| v.0)).collect();
    let astray = CutError::Straight { vertex: mesh.ends(chords[0])[0] };
    let parts = divide(mesh, &positions, on_edges, &vec![Vec::new(); mesh.faces()]);
    let (faces, _) = parts.ok_or(astray)?;
    let mesh = TriMesh::new(positions, faces).map_err(|_| CutError::from(SurfaceError::NoFaces))?;
    let surface = EmbeddedSurface::new(&mesh).map_err(CutError::from)?;
    let cut = marked(surface.mesh(), &paths).ok_or(astray)?;
    Ok(WithoutChords { mesh, surface, cut, divided: before + chords.len() })
}

impl WithoutChords {
    /// The edges of the cut as paths, as [`CutStrategy::Along`](crate::CutStrategy::Along) takes them.
    pub(crate) fn paths(&self) -> Vec<Vec<VertexId>> {
        let mesh = self.surface.mesh();
        mesh.edge_ids().filter(|&edge| self.cut[edge]).map(|edge| mesh.ends(edge).to_vec()).collect()
    }
}
