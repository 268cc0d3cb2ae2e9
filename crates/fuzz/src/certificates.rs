//! Certificates: whatever the verifier accepts is true in exact arithmetic.

use pompeiu::core::TriMesh;
use pompeiu::core::mesh::shapes::{icosphere, torus};
use pompeiu_testkit::certificate::is_true;
use pompeiu_verify::{MAGIC, Soup, verify};
use std::sync::LazyLock;

/// The meshes that the inputs speak of.
static PAIR: LazyLock<[TriMesh; 2]> = LazyLock::new(|| {
    let made = [torus(0.8, 0.4, 7, 5), icosphere(1.0, 0)];
    made.map(|mesh| mesh.expect("small shapes are meshes"))
});

/// A certificate without the first 72 bytes, name and hashes, which would keep everything else from being looked at.
pub(crate) fn run(bytes: &[u8]) {
    let [a, b] = &*PAIR;
    let [soup_a, soup_b] = [a, b]
        .map(|mesh| Soup::new(mesh.positions(), mesh.faces()).expect("a mesh is finite and has a face"));
    let whole = [&MAGIC[..], &soup_a.hash(), &soup_b.hash(), bytes].concat();
    let verdict = verify(&soup_a, &soup_b, &whole[..], 1);
    let on_two = verify(&soup_a, &soup_b, &whole[..], 2);
    match (verdict, on_two) {
        (Ok(one), Ok(two)) => {
            assert_eq!(one, two, "the verdict depends on the number of threads");
            assert!(is_true(a, b, &whole), "a certificate was accepted that is not true");
        }
        (Err(one), Err(two)) => assert_eq!(one.to_string(), two.to_string()),
        (one, two) => panic!("on one thread {one:?}, on two {two:?}"),
    }
    drop(verify(&soup_a, &soup_b, bytes, 1));
}
