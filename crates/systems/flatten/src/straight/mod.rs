//! Straight cuts across faces: paths are straightened by edge flips and inserted into the mesh.

mod insert;
mod net;
mod shorten;
mod walk;

use crate::CutError;
use insert::insert;
pub(crate) use insert::{divide, marked};
use net::Net;
use pompeiu_core::mesh::FaceData;
use pompeiu_core::{FaceId, TriMesh, VertexId};
use pompeiu_surface::{EdgeData, EmbeddedSurface, SurfaceError};
use shorten::Network;
use walk::walk;

/// A surface into which a straightened cut was inserted.
#[derive(Clone, Debug)]
pub struct Straightened {
    /// The vertices of the input, new vertices where the cut crosses its edges, and the parts of its faces.
    pub mesh: TriMesh,
    /// The same with its geometry.
    pub surface: EmbeddedSurface,
    /// The edges of the cut.
    pub cut: EdgeData<bool>,
    /// For each face, the face of the input that it is a part of.
    pub faces: FaceData<FaceId>,
}

impl Straightened {
    /// The edges of the cut as paths of two vertices, as [`CutStrategy::Along`](crate::CutStrategy::Along) takes them.
    pub fn paths(&self) -> Vec<Vec<VertexId>> {
        let mesh = self.surface.mesh();
        mesh.edge_ids().filter(|&edge| self.cut[edge]).map(|edge| mesh.ends(edge).to_vec()).collect()
    }
}

/// Straightens the paths of a cut by edge flips, and inserts them as edges of the mesh.
///
/// # Definition
/// A path runs between ends, branches and the boundary, which stay fixed. While the angle on one side of a vertex of a path is less
/// than π, the path is moved past the vertex on that side, after the edges there are flipped out of the way in an intrinsic
/// triangulation. A path that would touch another path, itself or the boundary stays. So paths do not cross or meet, and opening
/// the result gives the same components. The final paths are inserted: with a vertex wherever a path crosses an edge, and with
/// faces divided along the paths.
///
/// # Accuracy
/// The surface is unchanged up to the rounding of points on edges.
///
/// # Errors
/// [`CutError::Straight`] if rounding makes a path invalid, and [`CutError::Geometry`] if a part of a face is too thin.
///
/// # Source
/// `sharp_you_2020`.
pub fn straighten(surface: &EmbeddedSurface, cut: &EdgeData<bool>) -> Result<Straightened, CutError> {
    let mut net = Net::new(surface.surface());
    let mut network = Network::new(surface.mesh(), cut);
    network.shorten(&mut net);
    let mut lines = Vec::new();
    for &name in network.paths.iter().flatten() {
        let slot = net.slot(name);
        let (from, to) = (net.tail(slot), net.head(slot));
        let way = walk(surface.surface(), from, net.direction(slot), net.length(slot), to);
        lines.push((from, way.ok_or(CutError::Straight { vertex: from })?, to));
    }
    let astray = CutError::Straight { vertex: lines.first().map_or(VertexId(0), |line| line.0) };
    let inserted = insert(surface, &lines).ok_or(astray)?;
    let mesh = TriMesh::new(inserted.positions, inserted.faces).map_err(|_| SurfaceError::NoFaces)?;
    let straight = EmbeddedSurface::new(&mesh)?;
    let cut = marked(straight.mesh(), &inserted.paths).ok_or(astray)?;
    let faces = FaceData::from_fn(inserted.parents.len(), |face: FaceId| inserted.parents[face.index()]);
    Ok(Straightened { mesh, surface: straight, cut, faces })
}
