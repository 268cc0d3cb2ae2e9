//! Shapes with known answers: for tests, examples and benchmarks.
//!
//! Unless a shape says otherwise it is centred at the origin with its axis along z, closed shapes are oriented
//! outwards, and vertices are shared. Sizes are in a length unit of the caller's. The same arguments give the same bits
//! on every machine: angles go through [`libm`], not through the platform's mathematics library.
//!
//! ```
//! use pompeiu_core::mesh::MeshSummary;
//! use pompeiu_core::mesh::shapes::torus;
//!
//! let summary = MeshSummary::of(&torus(2.0, 0.5, 40, 20)?);
//! assert_eq!(summary.faces, 1600);
//! assert_eq!(summary.connectivity.genus, Some(1));
//! # Ok::<(), pompeiu_core::mesh::shapes::ShapeError>(())
//! ```

mod arrays;
mod cone;
mod cylinder;
mod error;
mod minimal;
mod mobius;
mod planar;
mod plate;
mod polyhedra;
mod span;
mod sphere;
mod torus;

pub use cone::{cone, tent};
pub use cylinder::{Ends, cylinder, schwarz_lantern};
pub use error::ShapeError;
pub use minimal::{catenoid, dumbbell, enneper, helicoid, revolved, scherk};
pub use mobius::mobius_strip;
pub use planar::{Diagonal, disk, grid, point_lattice};
pub use plate::perforated_plate;
pub use polyhedra::{cube, cuboid, icosahedron, tetrahedron};
pub use span::span;
pub use sphere::{icosphere, uv_sphere};
pub use torus::torus;

#[cfg(test)]
pub(super) mod measure {
    //! Plain measurements, to hold shapes against their closed forms.
    use crate::mesh::{FaceId, TriMesh};
    use std::collections::BTreeMap;

    fn cross_and_corner(mesh: &TriMesh, face: usize) -> ([f64; 3], [f64; 3]) {
        let [a, b, c] = mesh.corners(FaceId(face as u32));
        let u: [f64; 3] = std::array::from_fn(|i| b[i] - a[i]);
        let v: [f64; 3] = std::array::from_fn(|i| c[i] - a[i]);
        (std::array::from_fn(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3]), a)
    }

    pub(in crate::mesh) fn area(mesh: &TriMesh) -> f64 {
        (0..mesh.faces().len())
            .map(|f| cross_and_corner(mesh, f).0.iter().map(|x| x * x).sum::<f64>().sqrt() / 2.0)
            .sum()
    }

    pub(in crate::mesh) fn volume(mesh: &TriMesh) -> f64 {
        (0..mesh.faces().len())
            .map(|f| {
                let (n, a) = cross_and_corner(mesh, f);
                (n[0] * a[0] + n[1] * a[1] + n[2] * a[2]) / 6.0
            })
            .sum()
    }

    /// Number of edges, of edges in one face only, and whether no directed edge occurs twice.
    pub(in crate::mesh) fn edges(mesh: &TriMesh) -> (usize, usize, bool) {
        let mut uses: BTreeMap<[u32; 2], Vec<[u32; 2]>> = BTreeMap::new();
        for face in mesh.faces() {
            for i in 0..3 {
                let edge = [face[i], face[(i + 1) % 3]];
                let key = [edge[0].min(edge[1]), edge[0].max(edge[1])];
                uses.entry(key).or_default().push(edge);
            }
        }
        let boundary = uses.values().filter(|u| u.len() == 1).count();
        let consistent = uses.values().all(|u| u.len() == 1 || u.len() == 2 && u[0] != u[1]);
        (uses.len(), boundary, consistent)
    }

    pub(in crate::mesh) fn euler_characteristic(mesh: &TriMesh) -> i128 {
        mesh.positions().len() as i128 - edges(mesh).0 as i128 + mesh.faces().len() as i128
    }

    #[track_caller]
    pub(in crate::mesh) fn assert_close(value: f64, expected: f64) {
        assert!((value - expected).abs() <= 1e-13 * expected.abs().max(1.0), "{value} is not {expected}");
    }

    /// Closed, consistently oriented, enclosing this volume.
    #[track_caller]
    pub(in crate::mesh) fn assert_solid(mesh: &TriMesh, expected_volume: f64) {
        let (_, boundary, consistent) = edges(mesh);
        assert_eq!((boundary, consistent), (0, true));
        assert_close(volume(mesh), expected_volume);
    }
}
