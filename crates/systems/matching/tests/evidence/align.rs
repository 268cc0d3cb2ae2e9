//! Alignment: known motions are recovered, and meshes that cannot be aligned are reported.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{cube, icosphere, torus};
use pompeiu_core::mesh::{Affine, Random, displace_at_random, merge, subdivide, transform};
use pompeiu_matching::align::{AlignError, Alignment, Fixed, affine, align, matrix};

/// A shape without any symmetry: a dented sphere, longer than wide, with a torus through it.
pub(crate) fn asymmetric() -> TriMesh {
    let stretched = transform(&icosphere(1.0, 3).unwrap(), &Affine::scale([2.0, 1.3, 0.8])).unwrap();
    let ring = transform(&torus(0.5, 0.2, 24, 12).unwrap(), &Affine::translate([1.5, 0.4, 0.3])).unwrap();
    displace_at_random(&merge(&[&stretched, &ring]).unwrap(), 0.02, 3).unwrap()
}

/// The map that undoes a motion.
pub(crate) fn inverse(motion: &Affine) -> Affine {
    let r = motion.linear;
    let linear = [0, 1, 2].map(|i| [0, 1, 2].map(|j| r[j][i]));
    let back = Affine { linear, translation: [0.0; 3] }.apply(motion.translation);
    Affine { linear, translation: back.map(|x| -x) }
}

pub(crate) fn motion(random: &mut Random, shift: f64) -> Affine {
    let turn = Affine::rotate(random.direction(), 180.0 * random.signed_unit()).unwrap();
    Affine { translation: random.direction().map(|x| shift * x), ..turn }
}

#[track_caller]
pub(crate) fn assert_near(found: &Affine, expected: &Affine, tolerance: f64) {
    let entries = |map: &Affine| -> Vec<f64> { matrix(map).into_iter().flatten().collect() };
    for (x, y) in entries(found).into_iter().zip(entries(expected)) {
        assert!((x - y).abs() <= tolerance, "{found:?}\n{expected:?}");
    }
}

#[test]
fn a_rigid_motion_of_an_asymmetric_shape_is_found_again() {
    let mesh = asymmetric();
    let fixed = Fixed::new(&mesh).unwrap();
    let mut random = Random::new(11);
    for _ in 0..6 {
        let motion = motion(&mut random, 5.0);
        let moved = transform(&mesh, &motion).unwrap();
        let found = align(&moved, &fixed, Alignment::Rigid).unwrap().unwrap();
        assert_near(&found, &inverse(&motion), 1e-9);
    }
}

#[test]
fn another_mesh_of_the_same_surface_is_aligned_too() {
    let mesh = asymmetric();
    let fixed = Fixed::new(&mesh).unwrap();
    let motion = motion(&mut Random::new(5), 2.0);
    let moved = transform(&subdivide(&mesh).unwrap(), &motion).unwrap();
    let found = align(&moved, &fixed, Alignment::Rigid).unwrap().unwrap();
    assert_near(&found, &inverse(&motion), 1e-9);
}

#[test]
fn units_and_places_do_not_matter() {
    let mesh = asymmetric();
    let turn = Affine::rotate([1.0, 2.0, -0.5], 100.0).unwrap();
    for scale in [1e-150, 1e-6, 1e6, 1e150] {
        let sized = transform(&mesh, &Affine::scale([scale; 3])).unwrap();
        let motion = Affine { translation: [100.0 * scale, 0.0, -3.0 * scale], ..turn };
        let moved = transform(&sized, &motion).unwrap();
        let found = align(&moved, &Fixed::new(&sized).unwrap(), Alignment::Rigid).unwrap().unwrap();
        let mut expected = inverse(&motion);
        let mut found = found;
        expected.translation = expected.translation.map(|x| x / scale);
        found.translation = found.translation.map(|x| x / scale);
        assert_near(&found, &expected, 1e-9);
    }
}

#[test]
fn centroids_and_scales_are_matched() {
    let mesh = asymmetric();
    let fixed = Fixed::new(&mesh).unwrap();
    let moved = transform(&mesh, &Affine::translate([3.0, -2.0, 1.0])).unwrap();
    let found = align(&moved, &fixed, Alignment::Centroid).unwrap().unwrap();
    assert_near(&found, &Affine::translate([-3.0, 2.0, -1.0]), 1e-13);
    let change = Affine { translation: [6.0, -4.0, 2.0], ..Affine::scale([2.0; 3]) };
    let found = align(&transform(&mesh, &change).unwrap(), &fixed, Alignment::Scale).unwrap().unwrap();
    assert_near(&found, &Affine { translation: [-3.0, 2.0, -1.0], ..Affine::scale([0.5; 3]) }, 1e-13);
    assert_eq!(align(&moved, &fixed, Alignment::None).unwrap(), None);
    assert_eq!(affine(&matrix(&found)), found);
}

#[test]
fn shapes_with_symmetries_come_to_lie_on_themselves() {
    let shapes = [icosphere(1.0, 2).unwrap(), cube(1.0, 2).unwrap(), torus(2.0, 0.5, 32, 16).unwrap()];
    for (mesh, tolerance) in shapes.iter().zip([0.05, 1e-9, 0.02]) {
        let moved = transform(mesh, &motion(&mut Random::new(2), 4.0)).unwrap();
        let found = align(&moved, &Fixed::new(mesh).unwrap(), Alignment::Rigid).unwrap().unwrap();
        let distance = pompeiu_hausdorff::symmetric_hausdorff(&transform(&moved, &found).unwrap(), mesh);
        assert!(distance.distance.upper() < tolerance, "{:?}", distance.distance);
    }
}

#[test]
fn what_has_no_area_is_refused_and_thin_or_flat_meshes_are_not() {
    let corner = TriMesh::new(vec![[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], vec![[0, 1, 1], [0, 0, 0]]).unwrap();
    assert!(matches!(Fixed::new(&corner), Err(AlignError::NoArea { faces: 2 })));
    let mesh = asymmetric();
    let fixed = Fixed::new(&mesh).unwrap();
    let flat = TriMesh::new(vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]]).unwrap();
    for alignment in [Alignment::Centroid, Alignment::Scale, Alignment::Rigid] {
        assert_eq!(align(&corner, &fixed, alignment), Err(AlignError::NoArea { faces: 2 }));
        assert!(align(&flat, &fixed, alignment).unwrap().is_some());
        assert!(align(&mesh, &Fixed::new(&flat).unwrap(), alignment).unwrap().is_some());
    }
    let tiny = transform(&mesh, &Affine::scale([1e-300; 3])).unwrap();
    let huge = transform(&mesh, &Affine::scale([1e300; 3])).unwrap();
    for alignment in [Alignment::Scale, Alignment::Rigid] {
        assert_eq!(align(&tiny, &Fixed::new(&huge).unwrap(), alignment), Err(AlignError::Sizes));
        assert_eq!(align(&huge, &Fixed::new(&tiny).unwrap(), alignment), Err(AlignError::Sizes));
    }
}

/// The principal axes of a part differ from those of the whole: only closest points find its pose.
#[test]
fn a_part_is_moved_to_its_place_in_the_whole() {
    let mesh = asymmetric();
    let fixed = Fixed::new(&mesh).unwrap();
    let (positions, faces) = mesh.clone().into_parts();
    let kept = |face: &&[u32; 3]| face.iter().all(|&v| positions[v as usize][0] > -1.5);
    let faces: Vec<_> = faces.iter().filter(kept).copied().collect();
    let part = TriMesh::new(positions.clone(), faces).unwrap();
    assert!(part.faces().len() < mesh.faces().len());
    for seed in 0..3 {
        let motion = motion(&mut Random::new(seed), 3.0);
        let moved = transform(&part, &motion).unwrap();
        let found = align(&moved, &fixed, Alignment::Rigid).unwrap().unwrap();
        assert_near(&found, &inverse(&motion), 1e-9);
    }
}

/// A part of a row of identical shapes, neither the middle nor an end of it: it is found only from nearby.
#[test]
fn a_part_that_lies_near_its_place_is_moved_to_it() {
    /// Away from the origin, where every unit and origin of a frame counts.
    const PLACE: [f64; 3] = [70.0, 20.0, -30.0];
    let lookalike = |i: u64| {
        let dented = displace_at_random(&asymmetric(), 0.05, 10 + i).unwrap();
        transform(&dented, &Affine::translate([PLACE[0] + 6.0 * (i as f64 - 1.0), PLACE[1], PLACE[2]]))
            .unwrap()
    };
    let row: Vec<_> = (0..5).map(lookalike).collect();
    let fixed = Fixed::new(&merge(&row.iter().collect::<Vec<_>>()).unwrap()).unwrap();
    for seed in 0..3 {
        let mut random = Random::new(seed);
        let turn = Affine::rotate(random.direction(), 8.0).unwrap();
        let (shift, turned) = (random.direction(), turn.apply(PLACE));
        let translation = [0, 1, 2].map(|k| PLACE[k] - turned[k] + 0.2 * shift[k]);
        let motion = Affine { translation, ..turn };
        let moved = transform(&row[1], &motion).unwrap();
        let found = align(&moved, &fixed, Alignment::Rigid).unwrap().unwrap();
        assert_near(&found, &inverse(&motion), 1e-9);
    }
}
