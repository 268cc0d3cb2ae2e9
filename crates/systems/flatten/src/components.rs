//! Splitting a surface into its connected components.

use crate::FlattenError;
use crate::cut::{CutError, CutOptions, CutStrategy};
use crate::symmetry::{Images, SymmetryError, SymmetryPlane};
use pompeiu_core::{FaceId, TriMesh, VertexId};
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, GeometryError, HalfedgeId, SurfaceMesh};

/// A connected component, with its faces and vertices in the whole surface.
#[derive(Clone, Debug)]
pub(crate) struct Component {
    pub(crate) surface: EmbeddedSurface,
    /// Its faces in the whole surface, increasing.
    pub(crate) faces: Vec<FaceId>,
    /// Its vertices in the whole surface, increasing.
    pub(crate) vertices: Vec<VertexId>,
    /// The mirror images of its vertices, if a plane of symmetry is given.
    pub(crate) images: Option<Images>,
}

impl Component {
    /// The half-edge of the whole surface.
    pub(crate) fn halfedge(&self, h: HalfedgeId) -> HalfedgeId {
        HalfedgeId::of(self.faces[h.face().index()], h.corner())
    }

    /// The edge of the whole surface.
    pub(crate) fn edge_in(&self, whole: &SurfaceMesh, edge: EdgeId) -> EdgeId {
        whole.edge(self.halfedge(self.surface.mesh().edge_halfedge(edge)))
    }

    /// Marks the edges of a cut of this component in one of the whole surface.
    pub(crate) fn mark_in(&self, whole: &SurfaceMesh, cut: &EdgeData<bool>, in_whole: &mut EdgeData<bool>) {
        for (edge, _) in cut.entries().filter(|(_, is_cut)| **is_cut) {
            in_whole[self.edge_in(whole, edge)] = true;
        }
    }

    /// The edges of a cut of the whole surface that lie in this component.
    pub(crate) fn restricted(&self, whole: &SurfaceMesh, cut: &EdgeData<bool>) -> EdgeData<bool> {
        EdgeData::from_fn(self.surface.mesh().edges(), |edge| cut[self.edge_in(whole, edge)])
    }

    /// The options restricted to this component.
    pub(crate) fn options(&self, options: &CutOptions) -> CutOptions {
        let vertex = |v: &VertexId| self.vertices.binary_search(v).ok().map(|v| VertexId(v as u32));
        let here = |all: &[VertexId]| -> Vec<VertexId> { all.iter().filter_map(vertex).collect() };
        let edge = |[a, b]: &[VertexId; 2]| Some([vertex(a)?, vertex(b)?]);
        let face = |face: &FaceId| self.faces.binary_search(face).ok().map(|f| FaceId(f as u32));
        let strategy = match &options.strategy {
            CutStrategy::Through(vertices) => CutStrategy::Through(here(vertices)),
            other => other.clone(),
        };
        CutOptions {
            strategy,
            forbidden: here(&options.forbidden),
            forbidden_edges: options.forbidden_edges.iter().filter_map(edge).collect(),
            forbidden_faces: options.forbidden_faces.iter().filter_map(face).collect(),
            curvature: options.curvature,
            spread: options.spread,
            symmetry: options.symmetry,
        }
    }
}

/// The components of a surface, in the order of their first vertices; with mirror images if a plane of symmetry is given.
pub(crate) fn split(
    surface: &EmbeddedSurface,
    plane: Option<&SymmetryPlane>,
) -> Result<Vec<Component>, CutError> {
    let mut parts = components(surface)?;
    let Some(plane) = plane else { return Ok(parts) };
    let count = parts.len();
    for part in &mut parts {
        part.images = Some(Images::new(&part.surface, plane).map_err(|error| match error {
            SymmetryError::NoImage { .. } if count > 1 && Images::new(surface, plane).is_ok() => {
                SymmetryError::Parts { face: part.faces[0] }
            }
            error => symmetry_in_whole(error, part),
        })?);
    }
    Ok(parts)
}

fn components(surface: &EmbeddedSurface) -> Result<Vec<Component>, GeometryError> {
    let mesh = surface.mesh();
    let mut vertices = vec![Vec::new(); mesh.components()];
    let mut faces = vec![Vec::new(); mesh.components()];
    let mut local = vec![0_u32; mesh.vertices()];
    for v in mesh.vertex_ids() {
        let of = &mut vertices[mesh.component(v)];
        local[v.index()] = of.len() as u32;
        of.push(v);
    }
    for face in mesh.face_ids() {
        faces[mesh.component(mesh.face(face)[0])].push(face);
    }
    let part = |(vertices, faces): (Vec<VertexId>, Vec<FaceId>)| {
        let positions = vertices.iter().map(|&v| surface.positions()[v]).collect();
        let triples = faces.iter().map(|&face| mesh.face(face).map(|v| local[v.index()])).collect();
        // The order of indices in the whole surface is kept.
        let part = TriMesh::new(positions, triples).map_err(|_| pompeiu_surface::SurfaceError::NoFaces)?;
        Ok(Component { surface: EmbeddedSurface::new(&part)?, faces, vertices, images: None })
    };
    vertices.into_iter().zip(faces).map(part).collect()
}

fn symmetry_in_whole(error: SymmetryError, component: &Component) -> SymmetryError {
    use SymmetryError::{Across, Chord, NoCut, NoImage};
    match error {
        Chord { ends } => Chord { ends: ends.map(|v| component.vertices[v.index()]) },
        NoImage { vertex, distance, most } => {
            NoImage { vertex: component.vertices[vertex.index()], distance, most }
        }
        Across { face } => Across { face: component.faces[face.index()] },
        NoCut { face } => NoCut { face: component.faces[face.index()] },
        other => other,
    }
}

/// Converts an error of a component to the numbering of the whole surface.
pub(crate) fn in_whole(error: CutError, component: &Component) -> CutError {
    use CutError::{Forbidden, Medial, NoDisk, SingleEdge, Symmetry};
    use pompeiu_medial::MedialError::Open;
    match error {
        NoDisk { face, euler_characteristic, boundary_loops } => {
            NoDisk { face: component.faces[face.index()], euler_characteristic, boundary_loops }
        }
        Forbidden { face } => Forbidden { face: component.faces[face.index()] },
        Medial(Open { loops, vertex }) => Medial(Open { loops, vertex: component.vertices[vertex.index()] }),
        Symmetry(error) => Symmetry(symmetry_in_whole(error, component)),
        SingleEdge { ends } => SingleEdge { ends: ends.map(|v| component.vertices[v.index()]) },
        other => other,
    }
}

pub(crate) fn error_in_whole(error: FlattenError, component: &Component) -> FlattenError {
    match error {
        FlattenError::Cut(error) => FlattenError::Cut(in_whole(error, component)),
        FlattenError::Crowded { faces, ratio } => FlattenError::Crowded {
            faces: faces.into_iter().map(|face| component.faces[face.index()]).collect(),
            ratio,
        },
        other => other,
    }
}
