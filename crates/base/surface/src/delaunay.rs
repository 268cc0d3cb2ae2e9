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

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests may panic")]
mod tests {
    use super::*;
    use crate::EmbeddedSurface;
    use pompeiu_core::TriMesh;
    use pompeiu_core::mesh::shapes::{self, Diagonal};
    use pompeiu_core::mesh::{Random, displace_at_random};

    fn surface(mesh: &TriMesh) -> Surface {
        EmbeddedSurface::new(mesh).unwrap().surface().clone()
    }

    /// The sum of the cotangents opposite each inner edge.
    fn weights(surface: &Surface) -> Vec<f64> {
        let mesh = surface.mesh();
        let inner = mesh.edge_ids().map(|edge| mesh.edge_halfedge(edge));
        inner
            .filter_map(|h| Some((h, mesh.twin(h)?)))
            .map(|(h, twin)| surface.cotangent(h.previous()) + surface.cotangent(twin.previous()))
            .collect()
    }

    fn energy(surface: &Surface, values: &[f64]) -> f64 {
        let mesh = surface.mesh();
        let halfedges = mesh.face_ids().flat_map(SurfaceMesh::face_halfedges);
        halfedges
            .map(|h| {
                let step = values[mesh.head(h).index()] - values[mesh.tail(h).index()];
                0.5 * surface.cotangent(h.previous()) * step * step
            })
            .sum()
    }

    fn cases() -> Vec<Surface> {
        let torus = shapes::torus(2.0, 0.7, 24, 16).unwrap();
        vec![
            surface(&displace_at_random(&torus, 0.2, 1).unwrap()),
            surface(&displace_at_random(&shapes::icosphere(1.0, 3).unwrap(), 0.1, 2).unwrap()),
            surface(&shapes::schwarz_lantern(1.0, 2.0, 6, 40).unwrap()),
            surface(&shapes::uv_sphere(1.0, 40, 5).unwrap()),
            surface(&shapes::cuboid([1.0, 0.01, 5.0], 3).unwrap()),
        ]
    }

    #[test]
    fn all_edges_become_delaunay_and_the_surface_stays() {
        let mut flips = Vec::new();
        for before in cases() {
            let after = intrinsic_delaunay(&before).unwrap();
            flips.push(after.flips);
            assert_eq!(after.left, 0);
            let worst = weights(&after.surface).into_iter().fold(f64::INFINITY, f64::min);
            assert!(worst >= -1e-9, "{worst:e}");
            assert!((after.surface.area() / before.area() - 1.0).abs() < 1e-10);
            let (mesh, old) = (after.surface.mesh(), before.mesh());
            assert_eq!((mesh.edges(), mesh.faces()), (old.edges(), old.faces()));
            assert_eq!(mesh.genus(), old.genus());
            for (a, b) in after.surface.angle_defects().iter().zip(before.angle_defects()) {
                assert!((a - b).abs() < 1e-9, "{a} {b}");
            }
            // The result is Delaunay: a second run flips nothing.
            assert_eq!(intrinsic_delaunay(&after.surface).unwrap().flips, 0);
        }
        assert!(flips.iter().filter(|&&n| n > 0).count() >= 3, "{flips:?}");
    }

    #[test]
    fn energies_do_not_grow() {
        for before in cases() {
            let after = intrinsic_delaunay(&before).unwrap().surface;
            let mut random = Random::new(5);
            for _ in 0..20 {
                let values: Vec<f64> = (0..before.mesh().vertices()).map(|_| random.signed_unit()).collect();
                let (old, new) = (energy(&before, &values), energy(&after, &values));
                assert!(new <= old * (1.0 + 1e-12), "{old} {new}");
            }
        }
    }

    #[test]
    fn an_edge_may_come_back_to_its_vertex() {
        // A triangle covered twice, with an obtuse angle at vertex 2.
        let mesh = SurfaceMesh::from_faces(3, &[[0, 1, 2], [1, 0, 2]]).unwrap();
        let length = |edge| if mesh.ends(edge).iter().all(|v| v.0 < 2) { 1.8 } else { 1.0 };
        let lengths = EdgeData::from_fn(mesh.edges(), length);
        let before = Surface::from_edge_lengths(mesh, &lengths).unwrap();
        let after = intrinsic_delaunay(&before).unwrap();
        assert_eq!((after.flips, after.left), (1, 0));
        let mesh = after.surface.mesh();
        let loops = mesh.edge_ids().filter(|&edge| mesh.ends(edge) == [pompeiu_core::VertexId(2); 2]).count();
        assert_eq!((loops, mesh.edges(), mesh.euler_characteristic()), (1, 3, 2));
        assert!((after.surface.area() - before.area()).abs() < 1e-15);
        for (a, b) in after.surface.angle_defects().iter().zip(before.angle_defects()) {
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
    }

    #[test]
    fn a_plane_stays_a_plane() {
        // The long diagonal of each sheared cell becomes the short one.
        let grid = shapes::grid([4.0, 4.0], [4, 4], Diagonal::Rising).unwrap();
        let sheared = grid.positions().iter().map(|&[x, y, z]| [x + 0.5 * y, y, z]).collect();
        let mesh = TriMesh::new(sheared, grid.faces().to_vec()).unwrap();
        let after = intrinsic_delaunay(&surface(&mesh)).unwrap();
        assert_eq!((after.flips, after.left), (16, 0));
        let longest = after.surface.edge_lengths().into_iter().fold(0.0, f64::max);
        assert!((longest - 1.25_f64.sqrt()).abs() < 1e-14, "{longest}");
        // Right angles need no flip.
        assert_eq!(intrinsic_delaunay(&surface(&grid)).unwrap().flips, 0);
    }
}
