//! Meshes and pairs of meshes.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{Ends, cube, cylinder, icosphere, schwarz_lantern, torus};
use pompeiu_core::mesh::{Affine, displace_at_random, transform};
use std::path::PathBuf;

/// A mesh with a name.
pub struct Named {
    pub name: &'static str,
    pub mesh: TriMesh,
}

/// Two meshes whose distance is asked for, small enough to be counted under an emulator.
pub struct Pair {
    pub name: &'static str,
    pub a: TriMesh,
    pub b: TriMesh,
}

/// A unit sphere of `20 · 4^subdivisions` faces with its vertices displaced by 1e-3.
pub fn noisy_sphere(subdivisions: u32) -> TriMesh {
    let sphere = icosphere(1.0, subdivisions).expect("a sphere");
    displace_at_random(&sphere, 1e-3, 1).expect("finite")
}

/// Meshes that the timed kernels run on: one of our own, and one from the folder of data where there is one.
pub fn timed() -> Vec<Named> {
    let mut meshes = vec![Named { name: "sphere", mesh: noisy_sphere(6) }];
    let data = std::env::var_os("POMPEIU_DATA").map_or_else(beside_the_repository, PathBuf::from);
    let path = data.join("meshes/armadillo.obj");
    if path.exists() {
        meshes.push(Named { name: "armadillo", mesh: pompeiu_io::read_mesh(&path).expect("a mesh") });
    }
    meshes
}

fn beside_the_repository() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data")
}

/// One pair for each way in which the search spends its time.
pub fn pairs() -> Vec<Pair> {
    let pair = |name, a, b| Pair { name, a, b };
    let sphere = icosphere(1.0, 4).expect("a sphere");
    let turned = |mesh: &TriMesh| {
        let turn = Affine::rotate([1.0, 2.0, 3.0], 40.0).expect("an axis");
        transform(mesh, &turn).expect("finite")
    };
    vec![
        // Mostly games: curved against curved, at similar resolution.
        pair(
            "curved",
            schwarz_lantern(1.0, 2.0, 32, 8).expect("a lantern"),
            cylinder(1.0, 2.0, 48, 24, Ends::Open).expect("a cylinder"),
        ),
        // Mostly cuts: one surface meshed twice, distance zero.
        pair("coplanar", turned(&cube(1.0, 8).expect("a cube")), turned(&cube(1.0, 13).expect("a cube"))),
        // Cover queries, many of them with a neighbour.
        pair("noisy", displace_at_random(&sphere, 1e-4, 2).expect("finite"), sphere),
        // The sweep over many small faces against a few large ones.
        pair("coarse", torus(1.0, 0.4, 80, 40).expect("a torus"), torus(1.0, 0.4, 20, 10).expect("a torus")),
        // Nothing but building, sorting and covering.
        pair("self", noisy_sphere(4), noisy_sphere(4)),
    ]
}
