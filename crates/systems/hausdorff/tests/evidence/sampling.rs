//! Dense sampling brackets the distance.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{Diagonal, grid, icosphere, torus};
use pompeiu_core::mesh::{Affine, displace_at_random, transform};
use pompeiu_hausdorff::directed_hausdorff;
use pompeiu_testkit::effort::cases;
use pompeiu_testkit::sampling::sample;
use pompeiu_testkit::strategies::pair;
use proptest::prelude::*;

/// The samples and their distances are rounded.
const ROUNDING: f64 = 1e-14;

fn check(a: &TriMesh, b: &TriMesh, n: u32) {
    let (s, d) = (sample(a, b, n), directed_hausdorff(a, b).distance);
    let slack = ROUNDING * crate::support::largest_coordinate(&[a, b]);
    assert!(s.largest <= d.upper() + slack, "{s:?} {d:?}");
    assert!(d.lower() <= s.largest + s.covering_radius + slack, "{s:?} {d:?}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(64)))]

    #[test]
    fn random_meshes((a, b) in pair()) {
        check(&a, &b, 24);
    }
}

#[test]
fn curved_and_noisy_surfaces() {
    let sphere = icosphere(1.0, 2).unwrap();
    let turn = Affine::rotate([1.0, 2.0, 3.0], 40.0).unwrap();
    let turned = transform(&sphere, &turn).unwrap();
    let noisy = displace_at_random(&sphere, 0.03, 5).unwrap();
    let ring = torus(1.0, 0.4, 16, 8).unwrap();
    let flat = grid([2.0, 2.0], [4, 4], Diagonal::Alternating).unwrap();
    let bumpy = displace_at_random(&flat, 0.2, 9).unwrap();
    for (a, b) in [
        (&sphere, &turned),
        (&sphere, &noisy),
        (&ring, &sphere),
        (&sphere, &ring),
        (&flat, &bumpy),
        (&bumpy, &flat),
    ] {
        check(a, b, 6);
    }
}
