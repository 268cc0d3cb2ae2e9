//! What is counted: each case prepares its input and hands back the work.

use bench_kernels::sweep::Sweep;
use bench_kernels::{files, meshes, points};
use pompeiu_core::TriMesh;
use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::spatial::{Bvh, Workspace, morton_order};
use pompeiu_hausdorff::directed_hausdorff;
use std::hint::black_box;

pub type Work = Box<dyn FnMut()>;

const NAMES: [&str; 14] = [
    "distance/curved",
    "distance/coplanar",
    "distance/noisy",
    "distance/coarse",
    "distance/self",
    "build",
    "morton",
    "nearest/near",
    "nearest/far",
    "cover",
    "read/obj_6_digits",
    "read/obj",
    "read/ply",
    "read/stl",
];

/// Subdivisions of the sphere that kernels are counted on: 20 480 faces.
const LEVELS: u32 = 5;

/// Queries of a batch.
const QUERIES: usize = 2000;

pub fn names() -> impl Iterator<Item = &'static str> {
    NAMES.into_iter()
}

/// Only what happens in here is counted: the emulator knows it by its name.
#[inline(never)]
pub fn counted_region(work: &mut dyn FnMut()) {
    work();
    // Not a jump to the work as the last thing: the emulator must see this function return.
    black_box(());
}

pub fn prepare(name: &str) -> Option<Work> {
    let (kind, which) = name.split_once('/').unwrap_or((name, ""));
    let sphere = || meshes::noisy_sphere(LEVELS);
    Some(match kind {
        "distance" => distance(meshes::pairs().into_iter().find(|pair| pair.name == which)?),
        "build" => build(sphere()),
        "morton" => morton(sphere()),
        "nearest" => {
            let mesh = sphere();
            let points = match which {
                "near" => points::near(&mesh, QUERIES),
                "far" => points::far(&mesh, QUERIES),
                _ => return None,
            };
            nearest(&mesh, points)
        }
        "cover" => cover(&sphere()),
        "read" => read(files::of_mesh(&sphere()).into_iter().find(|file| file.name == which)?),
        _ => return None,
    })
}

/// The whole answer: frame, tree, search, proof.
fn distance(meshes::Pair { a, b, .. }: meshes::Pair) -> Work {
    Box::new(move || {
        black_box(directed_hausdorff(&a, &b));
    })
}

fn build(mesh: TriMesh) -> Work {
    let frame = Frame::of(&Aabb::of_faces(&mesh));
    Box::new(move || {
        black_box(Bvh::build(&mesh, &frame));
    })
}

fn morton(mesh: TriMesh) -> Work {
    let aabb = Aabb::of_faces(&mesh);
    Box::new(move || {
        black_box(morton_order(&mesh, &aabb));
    })
}

fn nearest(mesh: &TriMesh, points: Vec<[f64; 3]>) -> Work {
    let frame = Frame::of(&Aabb::of_faces(mesh));
    let bvh = Bvh::build(mesh, &frame);
    let points: Vec<_> = points.into_iter().map(|p| frame.map(p)).collect();
    let mut workspace = Workspace::default();
    Box::new(move || {
        for &p in &points {
            black_box(bvh.nearest(p, bvh.any_slot(), &mut workspace));
        }
    })
}

fn cover(mesh: &TriMesh) -> Work {
    let mut sweep = Sweep::new(mesh, 1e-3);
    Box::new(move || {
        black_box(sweep.run());
    })
}

fn read(file: files::File) -> Work {
    Box::new(move || {
        black_box(pompeiu_io::read_bytes(&file.bytes, Some(file.format)).expect("a mesh"));
    })
}
