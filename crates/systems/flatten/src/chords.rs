//! Chords of straight sides: inner edges between two vertices of one side of the boundary, divided at their midpoints.
//!
//! A convex combination map puts such an edge, and the faces beyond it, on the side itself. Without chords it is one-to-one
//! (`floater_mean_2003`, and the references there).

use crate::components::split;
use crate::map::straight_sides;
use crate::opened::{Disk, disks};
use crate::straight::{divide, marked};
use crate::{ConvexBoundary, CutError, FlattenError, SymmetryError, SymmetryPlane};
use pompeiu_core::TriMesh;
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, SurfaceError};

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
    plane: Option<&SymmetryPlane>,
) -> Result<Option<WithoutChords>, FlattenError> {
    let mut made: Option<WithoutChords> = None;
    loop {
        let (surface, cut) = made.as_ref().map_or((surface, cut), |made| (&made.surface, &made.cut));
        // Dividing can change the first vertex of a boundary loop and, with it, the corners. It ends, because no new edge joins two
        // vertices of the boundary.
        let chords = chords(surface, cut, boundary, plane)?;
        if chords.is_empty() {
            return Ok(made);
        }
        let before = made.as_ref().map_or(0, |made| made.divided);
        made = Some(divided(surface, cut, &chords, before)?);
    }
}

/// The chords of all disks, as edges of the whole surface; where a plane of symmetry is given, with their mirror images.
fn chords(
    surface: &EmbeddedSurface,
    cut: &EdgeData<bool>,
    boundary: &ConvexBoundary,
    plane: Option<&SymmetryPlane>,
) -> Result<Vec<EdgeId>, FlattenError> {
    let mut found = EdgeData::filled(surface.mesh().edges(), false);
    // With a plane of symmetry each component is one disk.
    let parts = if plane.is_some() { split(surface, plane)? } else { disks(surface, cut)? };
    for part in parts {
        // As the map sees it: corners depend on the first edge of the boundary loop.
        let of_part = match plane {
            Some(_) => part.restricted(surface.mesh(), cut),
            None => EdgeData::filled(part.surface.mesh().edges(), false),
        };
        let disk = Disk::new(&part, &of_part)?;
        for edge in chords_of(&disk, boundary)? {
            // Opening keeps faces and their corners.
            let h = disk.surface.mesh().edge_halfedge(edge);
            found[surface.mesh().edge(part.halfedge(h))] = true;
            let Some(images) = &part.images else { continue };
            let edge = part.surface.mesh().edge(h);
            let Some(image) = images.of_edge(edge) else {
                let ends = part.surface.mesh().ends(edge).map(|v| part.vertices[v.index()]);
                return Err(CutError::from(SymmetryError::Chord { ends }).into());
            };
            found[part.edge_in(surface.mesh(), image)] = true;
        }
    }
    Ok(surface.mesh().edge_ids().filter(|&edge| found[edge]).collect())
}

/// The chords of a disk.
fn chords_of(disk: &Disk, boundary: &ConvexBoundary) -> Result<Vec<EdgeId>, FlattenError> {
    let mesh = disk.surface.mesh();
    let Some(along) = disk.along() else { return Ok(Vec::new()) };
    let n = along.len();
    let lengths: Vec<f64> = along.iter().map(|&h| disk.surface.surface().edge_length(mesh.edge(h))).collect();
    let sides = straight_sides(boundary, &lengths, disk.mirror())?;
    let mut place = vec![None; mesh.vertices()];
    for (i, &h) in along.iter().enumerate() {
        place[mesh.tail(h).index()] = Some(i);
    }
    let on_one_side = |edge: EdgeId| {
        let [Some(v), Some(w)] = mesh.ends(edge).map(|v| place[v.index()]) else { return false };
        let is_on = |i: usize, [first, last]: [usize; 2]| (i + n - first) % n <= (last + n - first) % n;
        sides.iter().any(|&side| is_on(v, side) && is_on(w, side))
    };
    Ok(mesh.edge_ids().filter(|&edge| !mesh.is_boundary_edge(edge) && on_one_side(edge)).collect())
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
