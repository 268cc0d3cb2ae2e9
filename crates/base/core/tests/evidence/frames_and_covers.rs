//! Images of points in a frame enclose the exact ones, and what is called a cover is near all corners.

use pompeiu_core::geom::{Aabb, Frame};
use pompeiu_core::mesh::shapes::torus;
use pompeiu_core::spatial::{Bvh, Cover, Nearest, Workspace};
use pompeiu_testkit::effort::cases;
use proptest::prelude::*;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(cases(500)))]

    /// Scaling back up is exact, so that a coordinate lies between the ends of what encloses its image.
    #[test]
    fn images_among_subnormal_numbers_are_enclosed(x in 1e-24..1e-20_f64) {
        let frame = Frame::of(&Aabb::of_points(&[[0.0; 3], [1e300, 0.0, 0.0]]));
        for x in [x, -x] {
            let image = frame.enclosure([x, 0.0, 0.0])[0];
            let [lower, upper] = [image.lower(), image.upper()].map(|end| frame.length_out(end));
            prop_assert!(lower <= x && x <= upper, "{lower:e} {x:e} {upper:e}");
        }
    }

    /// The error of the shift is computed exactly, as by Knuth's sum of two numbers.
    #[test]
    fn images_of_shifted_points_are_enclosed(x in -1e3..1e3_f64) {
        let frame = Frame::of(&Aabb::of_points(&[[1e6; 3], [1e6 + 1.0; 3]]));
        let (scaled, origin) = (frame.length_in(x), -frame.map([0.0; 3])[0]);
        prop_assert!(origin > 0.0);
        let image = scaled - origin;
        let part = image - scaled;
        let error = (scaled - (image - part)) + (-origin - part);
        let found = frame.enclosure([x; 3])[0];
        prop_assert!(found.lower() <= image && image <= found.upper());
        prop_assert!(error <= 0.0 || found.upper() > image, "{error:e}");
        prop_assert!(error >= 0.0 || found.lower() < image, "{error:e}");
    }

    #[test]
    fn covers_are_near_all_corners(
        at in prop::array::uniform3(-1.4..1.4_f64),
        corners in prop::array::uniform3(prop::array::uniform3(-0.3..0.3_f64)),
        limit in 0.05..0.5_f64,
    ) {
        let mesh = torus(1.0, 0.3, 24, 16).unwrap();
        let frame = Frame::of(&Aabb::of_faces(&mesh));
        let (bvh, mut workspace) = (Bvh::build(&mesh, &frame), Workspace::default());
        let corner = |i: usize, k: usize| 0.5 * (at[k] + corners[i][k]);
        let points = [0, 1, 2].map(|k| {
            let [p, q, r] = [0, 1, 2].map(|i| corner(i, k));
            [p, q, r, (p + q + r) / 3.0]
        });
        // The search has to improve on its start to find a cover.
        let slot = bvh.any_slot();
        let distance_sq = bvh.four_distances_sq(&points, slot, &mut workspace)[3];
        let start = Nearest { slot, distance_sq };
        if let Cover::By { slot, distance_sq } = bvh.cover(&points, limit * limit, start, &mut workspace) {
            let [p, q, r, _] = bvh.four_distances_sq(&points, slot, &mut workspace);
            let farthest = [p, q, r].into_iter().fold(0.0, f64::max);
            prop_assert_eq!(distance_sq, farthest);
            prop_assert!(farthest <= limit * limit);
        }
    }
}
