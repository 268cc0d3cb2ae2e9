//! Intrinsic Delaunay triangulations by edge flips; the surface itself does not change.

use crate::build::NONE;
use crate::surface::FlatFace;
use crate::{EdgeData, GeometryError, Surface, SurfaceMesh};

/// An edge is flipped only if the cotangents of its two opposite angles sum to less than minus this. For angles that add up to half
/// a turn the exact sum is zero, and rounding may make it slightly negative.
const COCIRCULAR: f64 = 1e-12;

/// Flips per edge before giving up; practical meshes need a few.
const MOST_FLIPS_PER_EDGE: usize = 1000;

/// A surface with another triangulation of the same vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct IntrinsicDelaunay {
    /// The same surface and vertices with other edges: geodesics of the surface, in general not straight in space. There may be
    /// several edges between two vertices, and edges from a vertex to itself.
    pub surface: Surface,
    /// How many edges were flipped.
    pub flips: usize,
    /// Edges that are still not Delaunay because the limit on flips was reached: zero in all but contrived cases.
    pub left: usize,
}

/// The intrinsic Delaunay triangulation: the two angles opposite each inner edge add up to at most half a turn.
///
/// On a surface without boundary its cotangent Laplacian has no positive entry off the diagonal, so the maximum principle holds.
/// Boundary edges opposite an obtuse angle remain an exception, as they cannot be flipped. Among all triangulations with these
/// vertices it has the least Dirichlet energies.
///
/// # Definition
/// While the cotangents opposite an edge sum to less than zero, its two faces are unfolded into a plane and the edge is replaced by
/// the other diagonal. This ends after finitely many flips, and the result does not depend on their order, except for cocircular
/// points. Vertices keep their numbers; edges and faces do not.
///
/// # Accuracy
/// New lengths are computed from the lengths of four sides: each flip adds a few rounding errors.
/// # Errors
/// [`GeometryError::DegenerateFace`] if a face of the result is too thin.
/// # Cost
/// O(E) and O(1) for each flip.
/// # Source
/// `bobenko_laplace_2007`, `fisher_algorithm_2007`.
pub fn intrinsic_delaunay(surface: &Surface) -> Result<IntrinsicDelaunay, GeometryError> {
    let mut net = Net::new(surface);
    let count = net.twins.len();
    let mut waiting = vec![true; count];
    let mut open: Vec<u32> = (0..count as u32).rev().collect();
    let mut flips = 0;
    while let Some(h) = open.pop() {
        waiting[h as usize] = false;
        if !net.must_flip(h) || flips >= MOST_FLIPS_PER_EDGE * count {
            continue;
        }
        let sides = net.flip(h);
        flips += 1;
        for side in sides {
            if !std::mem::replace(&mut waiting[side as usize], true) {
                open.push(side);
            }
        }
    }
    let left = (0..count as u32).filter(|&h| net.twins[h as usize] > h && net.must_flip(h)).count();
    Ok(IntrinsicDelaunay { surface: net.into_surface(surface.mesh().vertices())?, flips, left })
}

/// Half-edges with their lengths.
struct Net {
    tails: Vec<u32>,
    twins: Vec<u32>,
    lengths: Vec<f64>,
}

fn next(h: u32) -> u32 {
    if h % 3 == 2 { h - 2 } else { h + 1 }
}

impl Net {
    fn new(surface: &Surface) -> Self {
        let mesh = surface.mesh();
        let halfedges = || mesh.face_ids().flat_map(SurfaceMesh::face_halfedges);
        Self {
            tails: halfedges().map(|h| mesh.tail(h).0).collect(),
            twins: halfedges().map(|h| mesh.twin(h).map_or(NONE, |twin| twin.0)).collect(),
            lengths: halfedges().map(|h| surface.edge_length(mesh.edge(h))).collect(),
        }
    }

    /// The face of a half-edge in the plane, with the half-edge on the first axis.
    fn flat(&self, h: u32) -> FlatFace {
        let (second, third) = (next(h), next(next(h)));
        FlatFace::from_lengths([h, second, third].map(|side| self.lengths[side as usize]))
    }

    /// Whether an edge is not Delaunay.
    fn must_flip(&self, h: u32) -> bool {
        let twin = self.twins[h as usize];
        // An edge with the same face on both sides lies in a cone and has no other diagonal.
        if twin == NONE || twin / 3 == h / 3 {
            return false;
        }
        let cotangent = |h: u32| {
            let flat = self.flat(h);
            let [x, y] = flat.apex;
            // The cotangent of the angle at the apex, between the vectors to both ends.
            (x * (x - flat.length) + y * y) / (flat.length * y)
        };
        cotangent(h) + cotangent(twin) < -COCIRCULAR
    }

    /// Replaces an edge by the other diagonal of its two faces; returns the half-edges of the four sides.
    fn flip(&mut self, h: u32) -> [u32; 4] {
        let t = self.twins[h as usize];
        let (here, there) = (self.flat(h), self.flat(t));
        // The other face is seen from the other end of the edge.
        let across = [here.apex[0] - (here.length - there.apex[0]), here.apex[1] + there.apex[1]];
        let diagonal = (across[0] * across[0] + across[1] * across[1]).sqrt();
        let (f, g) = (3 * (h / 3), 3 * (t / 3));
        // From a to b over c on one side, from b to a over d on the other.
        let (bc, ca) = (next(h), next(next(h)));
        let (ad, db) = (next(t), next(next(t)));
        let [a, b, c, d] = [h, t, ca, db].map(|side| self.tails[side as usize]);
        // The faces d, c, a and c, d, b.
        let moved = [(ca, f + 1), (ad, f + 2), (db, g + 1), (bc, g + 2)];
        let old = moved.map(|(from, _)| (self.twins[from as usize], self.lengths[from as usize]));
        for ((_, to), (twin, length)) in moved.into_iter().zip(old) {
            let twin = moved.iter().find(|(from, _)| *from == twin).map_or(twin, |&(_, to)| to);
            self.twins[to as usize] = twin;
            self.lengths[to as usize] = length;
            if twin != NONE {
                self.twins[twin as usize] = to;
            }
        }
        for (side, twin) in [(f, g), (g, f)] {
            self.twins[side as usize] = twin;
            self.lengths[side as usize] = diagonal;
        }
        for (side, tail) in [(f, d), (f + 1, c), (f + 2, a), (g, c), (g + 1, d), (g + 2, b)] {
            self.tails[side as usize] = tail;
        }
        moved.map(|(_, to)| to)
    }

    fn into_surface(self, vertices: usize) -> Result<Surface, GeometryError> {
        let mesh = SurfaceMesh::from_twins(vertices, self.tails, self.twins)?;
        let length = |edge| self.lengths[mesh.edge_halfedge(edge).index()];
        let lengths = EdgeData::from_fn(mesh.edges(), length);
        Surface::from_edge_lengths(mesh, &lengths)
    }
}
