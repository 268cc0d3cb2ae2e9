//! Which edges and vertices of the input are kept: boundaries, creases, selected ones.

use super::connectivity::{DynamicMesh, NONE};
use super::marked::Hold;
use glam::DVec3;
use pompeiu_core::VertexId;
use pompeiu_core::mesh::UnionFind;

/// A curve that turns by more than this at a vertex has a corner there, in degrees.
const CORNER_TURN: f64 = 50.0;

/// What remeshing keeps beside the boundary. The default keeps nothing else.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Features<'f> {
    /// Edges whose faces meet at more than this angle between their normals, in degrees, are kept.
    pub angle: Option<f64>,
    /// Edges that are kept, by their ends.
    pub edges: &'f [[VertexId; 2]],
    /// Vertices that stay where they are.
    pub vertices: &'f [VertexId],
}

/// Why something cannot be kept.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FeatureError {
    /// An angle out of range.
    #[error("the angle of features is {0} degrees; it must be between 0 and 180")]
    Angle(f64),
    /// A vertex that is to be kept does not exist.
    #[error("vertex {vertex} is to be kept, but there are {vertices} vertices")]
    NoVertex {
        /// Its index.
        vertex: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// Repairing numbers vertices anew.
    #[error("vertices and edges cannot be selected on a mesh that is repaired first; repair it, then select")]
    Repaired,
}

impl Features<'_> {
    /// Whether nothing but boundaries is kept.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Whether they make sense for a mesh with so many vertices.
    pub(super) fn check(&self, vertices: usize) -> Result<(), FeatureError> {
        if let Some(angle) = self.angle.filter(|x| !(0.0..=180.0).contains(x)) {
            return Err(FeatureError::Angle(angle));
        }
        let kept = self.vertices.iter().chain(self.edges.iter().flatten());
        match kept.map(|v| v.0).find(|&v| v as usize >= vertices) {
            Some(vertex) => Err(FeatureError::NoVertex { vertex, vertices }),
            None => Ok(()),
        }
    }
}

/// The curves of a surface and what holds each of its vertices.
pub(super) struct Curves {
    /// The curve of each halfedge's edge; [`NONE`] for most.
    pub(super) of_halfedge: Vec<u32>,
    pub(super) hold: Vec<Hold>,
}

impl Curves {
    /// No curves, not even boundaries: every vertex is free.
    pub(super) fn none(mesh: &DynamicMesh) -> Self {
        Self { of_halfedge: vec![NONE; mesh.origin.len()], hold: vec![Hold::Free; mesh.positions.len()] }
    }

    /// Finds edges that are kept, cuts them into curves at corners.
    pub(super) fn find(mesh: &DynamicMesh, features: &Features<'_>) -> Self {
        let kept = kept_edges(mesh, features);
        let mut around: Vec<Vec<u32>> = vec![Vec::new(); mesh.positions.len()];
        for h in (0..mesh.halfedge_slots()).filter(|&h| kept[h as usize]) {
            if mesh.names_edge(h) {
                around[mesh.from(h) as usize].push(h);
                around[mesh.to(h) as usize].push(h);
            }
        }
        let mut hold: Vec<Hold> = vec![Hold::Free; mesh.positions.len()];
        for (v, edges) in around.iter().enumerate() {
            if !edges.is_empty() && !passes(mesh, v as u32, edges) {
                hold[v] = Hold::Corner;
            }
        }
        for v in features.vertices {
            hold[v.index()] = Hold::Corner;
        }
        let mut curves = Self { of_halfedge: vec![NONE; kept.len()], hold };
        curves.number(mesh, &around);
        curves
    }

    /// Gives each curve a number, in the order of its first edge.
    fn number(&mut self, mesh: &DynamicMesh, around: &[Vec<u32>]) {
        let mut count = 0;
        for first in around.iter().flatten() {
            if self.of_halfedge[*first as usize] != NONE {
                continue;
            }
            let mut open = vec![*first];
            while let Some(h) = open.pop() {
                if self.of_halfedge[h as usize] != NONE {
                    continue;
                }
                for side in [Some(h), mesh.twin_of(h)].into_iter().flatten() {
                    self.of_halfedge[side as usize] = count;
                }
                for v in [mesh.from(h), mesh.to(h)] {
                    if self.hold[v as usize] != Hold::Corner {
                        self.hold[v as usize] = Hold::Curve(count);
                        open.extend(&around[v as usize]);
                    }
                }
            }
            count += 1;
        }
    }
}

/// Marks the halfedges of edges that are kept.
fn kept_edges(mesh: &DynamicMesh, features: &Features<'_>) -> Vec<bool> {
    let mut kept: Vec<bool> = mesh.twin.iter().map(|t| *t == NONE).collect();
    if let Some(angle) = features.angle {
        creases(mesh, angle).for_each(|h| kept[h as usize] = true);
    }
    for [u, v] in features.edges {
        for [from, to] in [[u.0, v.0], [v.0, u.0]] {
            let along = mesh.halfedges_from(from).find(|&h| mesh.to(h) == to);
            for h in along.into_iter().flat_map(|h| [Some(h), mesh.twin_of(h)]).flatten() {
                kept[h as usize] = true;
            }
        }
    }
    kept
}

/// The halfedges whose faces meet at more than an angle between their normals, in degrees.
fn creases(mesh: &DynamicMesh, angle: f64) -> impl Iterator<Item = u32> {
    let least = angle.to_radians().cos();
    let normal = |f: u32| {
        let [a, b, c] = mesh.corners(f).map(|v| mesh.positions[v as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let is_crease = move |&h: &u32| {
        // Beside a face without area there is no angle.
        mesh.twin_of(h).is_some_and(|t| {
            let [n, m] = [normal(h / 3), normal(t / 3)];
            n != DVec3::ZERO && m != DVec3::ZERO && n.dot(m) < least
        })
    };
    (0..mesh.halfedge_slots()).filter(is_crease)
}

/// Connected creases are curves if they have at most so many edges for each of their vertices; the creases of a rough surface have more.
const CURVES: f64 = 1.5;

/// The creases that lead to marked vertices, along other creases, where they form curves.
pub(super) fn creases_to(mesh: &DynamicMesh, angle: f64, marked: &[bool]) -> Vec<[VertexId; 2]> {
    let mut ends: Vec<[u32; 2]> =
        creases(mesh, angle).filter(|&h| mesh.names_edge(h)).map(|h| [mesh.from(h), mesh.to(h)]).collect();
    let count = mesh.positions.len();
    let mut parts = UnionFind::new(count);
    for [v, w] in &ends {
        parts.union(*v as usize, *w as usize);
    }
    let (mut edges, mut vertices, mut leads) = (vec![0_u32; count], vec![0_u32; count], vec![false; count]);
    let mut seen = vec![false; count];
    for [v, w] in &ends {
        edges[parts.find(*v as usize)] += 1;
        for v in [*v as usize, *w as usize] {
            let part = parts.find(v);
            leads[part] |= marked[v];
            vertices[part] += u32::from(!std::mem::replace(&mut seen[v], true));
        }
    }
    ends.retain(|[v, _]| {
        let part = parts.find(*v as usize);
        leads[part] && f64::from(edges[part]) <= CURVES * f64::from(vertices[part])
    });
    ends.into_iter().map(|ends| ends.map(VertexId)).collect()
}

/// Whether two edges that are kept run straight enough through a vertex to be one curve.
fn passes(mesh: &DynamicMesh, v: u32, edges: &[u32]) -> bool {
    let [one, two] = edges[..] else { return false };
    let away = |h: u32| {
        let other = if mesh.from(h) == v { mesh.to(h) } else { mesh.from(h) };
        (mesh.positions[other as usize] - mesh.positions[v as usize]).normalize_or_zero()
    };
    -away(one).dot(away(two)) > CORNER_TURN.to_radians().cos()
}
