//! Virtual boundaries: faces around a disk that are mapped with it and then removed, so that its own boundary need not be convex.

use crate::FlattenError;
use glam::DVec3;
use pompeiu_core::{TriMesh, VertexId};
use pompeiu_surface::plane::{Vec2, norm, scale, sub};
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface, GeometryError, HalfedgeId, Surface, SurfaceMesh};
use std::num::NonZeroUsize;

/// A virtual boundary: faces around a disk that are mapped with it to a convex curve, and then removed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct VirtualBoundary {
    /// Number of layers; each has one vertex for each vertex of the boundary.
    pub layers: NonZeroUsize,
    /// Ratio of the sizes of consecutive layers, above 1.
    pub scale: f64,
    /// How its edge lengths are determined.
    pub kind: RingKind,
}

impl Default for VirtualBoundary {
    fn default() -> Self {
        Self { layers: NonZeroUsize::MIN, scale: 1.2, kind: RingKind::default() }
    }
}

/// The source of the edge lengths of a virtual boundary.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum RingKind {
    /// From circles: layer k lies on the circle of radius r aᵏ, where 2 π r is the length of the boundary, at angles proportional
    /// to the lengths of its edges. Edges of the boundary keep their lengths.
    #[default]
    Intrinsic,
    /// From positions in space: layer k is the boundary scaled about its centroid by aᵏ.
    Extrinsic,
}

/// A disk followed by the faces of a virtual boundary.
///
/// # Source
/// `lee_parametrization_2002`, with one vertex in each layer for each boundary vertex.
pub(super) fn surrounded(
    surface: &EmbeddedSurface,
    ring: &VirtualBoundary,
) -> Result<(Surface, Vec<[u32; 3]>), FlattenError> {
    if !ring.scale.is_finite() || ring.scale <= 1.0 {
        let expected = "it must be a number above 1";
        return Err(FlattenError::Option {
            what: "scale of the virtual boundary",
            value: ring.scale,
            expected,
        });
    }
    let mesh = surface.mesh();
    let n = mesh.vertices();
    let along: Vec<HalfedgeId> =
        mesh.boundary_loops().first().map(|&first| mesh.boundary_loop(first).collect()).unwrap_or_default();
    let b = along.len();
    let mut inner: Vec<u32> = along.iter().map(|&h| mesh.tail(h).0).collect();
    let mut faces: Vec<[u32; 3]> = mesh.face_ids().map(|face| mesh.face(face).map(|v| v.0)).collect();
    for layer in 0..ring.layers.get() {
        let outer: Vec<u32> = (0..b).map(|i| (n + layer * b + i) as u32).collect();
        for i in 0..b {
            let next = (i + 1) % b;
            faces.push([inner[next], inner[i], outer[i]]);
            faces.push([inner[next], outer[i], outer[next]]);
        }
        inner = outer;
    }
    let vertices = n + ring.layers.get() * b;
    let surface = match ring.kind {
        RingKind::Intrinsic => intrinsic(surface, ring, &along, vertices, &faces)?,
        RingKind::Extrinsic => extrinsic(surface, ring, &along, &faces)?,
    };
    Ok((surface, faces))
}

fn intrinsic(
    surface: &EmbeddedSurface,
    ring: &VirtualBoundary,
    along: &[HalfedgeId],
    vertices: usize,
    faces: &[[u32; 3]],
) -> Result<Surface, FlattenError> {
    let (whole, metric) = (surface.mesh(), surface.surface());
    let (n, b) = (whole.vertices(), along.len());
    let lengths: Vec<f64> = along.iter().map(|&h| metric.edge_length(whole.edge(h))).collect();
    let perimeter: f64 = lengths.iter().sum();
    let mut at = Vec::with_capacity(b);
    let mut place_of_boundary = vec![0_usize; n];
    let mut passed = 0.0;
    for (i, length) in lengths.iter().enumerate() {
        let angle = std::f64::consts::TAU * (passed / perimeter);
        at.push([libm::cos(angle), libm::sin(angle)]);
        place_of_boundary[whole.tail(along[i]).index()] = i;
        passed += length;
    }
    let radius = perimeter / std::f64::consts::TAU;
    let mut radii = vec![radius];
    for layer in 0..ring.layers.get() {
        radii.push(radii[layer] * ring.scale);
    }
    let place = |v: VertexId| -> Vec2 {
        let v = v.index();
        if v < n {
            scale(radius, at[place_of_boundary[v]])
        } else {
            scale(radii[1 + (v - n) / b], at[(v - n) % b])
        }
    };
    let mesh = SurfaceMesh::from_faces(vertices, faces).map_err(GeometryError::from)?;
    // The first faces are those of the disk, with the same corners.
    let own = |edge: EdgeId| -> Option<f64> {
        let h = mesh.edge_halfedge(edge);
        let mut sides = [Some(h), mesh.twin(h)].into_iter().flatten();
        let inside = sides.find(|h| h.face().index() < whole.faces())?;
        Some(metric.edge_length(whole.edge(HalfedgeId::of(inside.face(), inside.corner()))))
    };
    let lengths = EdgeData::from_fn(mesh.edges(), |edge| {
        own(edge).unwrap_or_else(|| {
            let [p, q] = mesh.ends(edge).map(place);
            norm(sub(p, q))
        })
    });
    Ok(Surface::from_edge_lengths(mesh, &lengths)?)
}

fn extrinsic(
    surface: &EmbeddedSurface,
    ring: &VirtualBoundary,
    along: &[HalfedgeId],
    faces: &[[u32; 3]],
) -> Result<Surface, FlattenError> {
    let mesh = surface.mesh();
    let place = |v: VertexId| DVec3::from_array(surface.positions()[v]);
    let (mut sum, mut perimeter) = (DVec3::ZERO, 0.0);
    for &h in along {
        let length = surface.surface().edge_length(mesh.edge(h));
        sum += 0.5 * length * (place(mesh.tail(h)) + place(mesh.head(h)));
        perimeter += length;
    }
    let centroid = sum / perimeter;
    let mut positions = surface.positions().as_slice().to_vec();
    let mut factor = 1.0;
    for _ in 0..ring.layers.get() {
        factor *= ring.scale;
        positions
            .extend(along.iter().map(|&h| (centroid + factor * (place(mesh.tail(h)) - centroid)).to_array()));
    }
    let whole = TriMesh::new(positions, faces.to_vec()).map_err(|_| FlattenError::Option {
        what: "scale of the virtual boundary",
        value: ring.scale,
        expected: "its outermost layer must stay within the range of numbers",
    })?;
    Ok(EmbeddedSurface::new(&whole)?.surface().clone())
}
