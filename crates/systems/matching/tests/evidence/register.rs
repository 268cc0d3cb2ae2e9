//! Registration from any start: known motions are recovered from parts, and ambiguity is reported.

use crate::align::{assert_near, asymmetric, inverse, motion};
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{Diagonal, Ends, cube, cylinder, grid, icosphere};
use pompeiu_core::mesh::{Affine, Random, displace_at_random, subdivide, transform};
use pompeiu_core::run::Limits;
use pompeiu_matching::align::{AlignError, Fixed, Registration, RegistrationOptions, register};

fn registered(moving: &TriMesh, fixed: &TriMesh) -> Registration {
    register(moving, &Fixed::new(fixed).unwrap(), &RegistrationOptions::default()).unwrap()
}

/// The faces whose centroids have a first coordinate in a range.
fn between(mesh: &TriMesh, low: f64, high: f64) -> TriMesh {
    let centroid = |f: &[u32; 3]| f.iter().map(|v| mesh.positions()[*v as usize][0]).sum::<f64>() / 3.0;
    let faces = mesh.faces().iter().filter(|f| (low..high).contains(&centroid(f))).copied().collect();
    TriMesh::new(mesh.positions().to_vec(), faces).unwrap()
}

#[test]
fn the_whole_and_either_part_are_laid_where_they_were() {
    let whole = asymmetric();
    let mut random = Random::new(21);
    // The box of the shape reaches from about -2 to 2.2 along x.
    for (moving, fixed) in [
        (whole.clone(), whole.clone()),
        (between(&whole, 0.0, 9.0), whole.clone()),
        (between(&whole, -9.0, 1.9), between(&whole, -0.6, 9.0)),
    ] {
        let motion = motion(&mut random, 7.0);
        let moved = transform(&moving, &motion).unwrap();
        let found = registered(&moved, &fixed);
        assert_near(&found.map(), &inverse(&motion), 1e-6);
        assert!(found.is_unique() && found.rms < 1e-6 && found.scale == 1.0, "{found:?}");
    }
}

#[test]
fn noise_another_tessellation_and_another_size_are_overcome() {
    let shape = asymmetric();
    let scan = displace_at_random(&subdivide(&shape).unwrap(), 0.01, 9).unwrap();
    let motion = motion(&mut Random::new(8), 3.0);
    let scan = transform(&scan, &motion).unwrap();
    assert_near(&registered(&scan, &shape).map(), &inverse(&motion), 0.01);
    // With a factor: the map is that of the larger mesh after it has shrunk.
    let larger = transform(&transform(&shape, &motion).unwrap(), &Affine::scale([2.5; 3])).unwrap();
    let options = RegistrationOptions { scale: true, ..RegistrationOptions::default() };
    let found = register(&larger, &Fixed::new(&shape).unwrap(), &options).unwrap();
    assert!((found.scale - 0.4).abs() < 1e-7, "{found:?}");
    assert!(found.scale_deviation.unwrap() < 1e-7 && found.fits, "{found:?}");
    let mut expected = inverse(&motion);
    expected.linear = expected.linear.map(|row| row.map(|x| 0.4 * x));
    assert_near(&found.map(), &expected, 1e-6);
}

#[test]
fn the_deviation_of_a_scale_is_that_of_its_scatter() {
    let shape = asymmetric();
    let fixed = Fixed::new(&shape).unwrap();
    let options = RegistrationOptions { scale: true, ..RegistrationOptions::default() };
    let fine = subdivide(&subdivide(&shape).unwrap()).unwrap();
    let found: Vec<Registration> = (0..6)
        .map(|seed| register(&displace_at_random(&fine, 0.01, seed).unwrap(), &fixed, &options).unwrap())
        .collect();
    let told = found[0].scale_deviation.unwrap();
    let scatter = (found.iter().map(|found| (found.scale - 1.0).powi(2)).sum::<f64>() / 6.0).sqrt();
    // Samples of one face share its error, so they scatter more than independent ones.
    assert!(told < 3.0 * scatter && scatter < 10.0 * told && told < 1e-3, "{told} {scatter}");
    assert_eq!(registered(&shape, &shape).scale_deviation, None);
}

#[test]
fn different_shapes_do_not_fit() {
    let shape = asymmetric();
    let other = icosphere(1.3, 3).unwrap();
    let found = registered(&other, &shape);
    assert!(!found.fits && !found.is_unique(), "{found:?}");
    // A scale does not collapse one into a corner of the other.
    let options = RegistrationOptions { scale: true, ..RegistrationOptions::default() };
    let torus = transform(
        &pompeiu_core::mesh::shapes::torus(5.0, 1.0, 40, 20).unwrap(),
        &motion(&mut Random::new(3), 1.0),
    );
    let found = register(&torus.unwrap(), &Fixed::new(&shape).unwrap(), &options).unwrap();
    assert!(!found.fits && found.scale > 0.1, "{found:?}");
}

#[test]
fn what_a_share_of_the_points_says_is_not_bent_by_the_rest() {
    let shape = asymmetric();
    let dented = {
        let (mut positions, faces) = shape.clone().into_parts();
        for p in positions.iter_mut().filter(|p| p[0] < -0.8) {
            p[0] -= 0.1;
        }
        TriMesh::new(positions, faces).unwrap()
    };
    let options = RegistrationOptions { overlap: Some(0.5), ..RegistrationOptions::default() };
    let found = register(&dented, &Fixed::new(&shape).unwrap(), &options).unwrap();
    assert_near(&found.map(), &Affine::IDENTITY, 1e-6);
}

#[test]
fn what_is_not_unique_is_said() {
    let motion = motion(&mut Random::new(2), 4.0);
    let turned = |mesh: &TriMesh| transform(mesh, &motion).unwrap();
    let cube = cube(1.0, 3).unwrap();
    let found = registered(&turned(&cube), &cube);
    let ends = |k: usize| cube.positions().iter().map(move |p| p[k]);
    let middle: [f64; 3] = std::array::from_fn(|k| {
        f64::midpoint(ends(k).fold(f64::MAX, f64::min), ends(k).fold(f64::MIN, f64::max))
    });
    assert!(found.rms < 1e-6 && found.alternatives.len() >= 3 && found.free_motions.is_empty(), "{found:?}");
    for other in &found.alternatives {
        let quarter = other.apart_degrees;
        assert!([90.0, 120.0, 180.0].iter().any(|angle| (angle - quarter).abs() < 0.01), "{quarter}");
        // The axis passes through the centre of the cube.
        let off: [f64; 3] = std::array::from_fn(|k| other.point[k] - middle[k]);
        let along: f64 = (0..3).map(|k| off[k] * other.axis[k]).sum();
        let across: f64 = (0..3).map(|k| (off[k] - along * other.axis[k]).powi(2)).sum();
        assert!(across.sqrt() < 1e-6 && other.slide.abs() < 1e-6, "{other:?}");
    }
    let rod = cylinder(0.5, 3.0, 96, 24, Ends::Capped).unwrap();
    let found = registered(&turned(&rod), &rod);
    assert_eq!(found.free_motions.len(), 1, "{found:?}");
    let [free] = found.free_motions[..] else { unreachable!() };
    assert!(free.turn[2].abs() > 0.999 && free.point[0].hypot(free.point[1]) < 1e-2, "{free:?}");
    assert_eq!(
        registered(&turned(&icosphere(1.0, 3).unwrap()), &icosphere(1.0, 3).unwrap()).free_motions.len(),
        3
    );
    let plate = grid([2.0, 1.0], [20, 10], Diagonal::Rising).unwrap();
    let found = registered(&turned(&between(&plate, -9.0, 1.0)), &plate);
    assert!(found.free_motions.len() == 3 && !found.is_unique(), "{found:?}");
}

#[test]
fn a_surface_turned_inside_out_is_laid_on_the_other_side() {
    let shape = asymmetric();
    let motion = motion(&mut Random::new(31), 2.0);
    let (positions, faces) = transform(&shape, &motion).unwrap().into_parts();
    let inside_out = TriMesh::new(positions, faces.into_iter().map(|[a, b, c]| [a, c, b]).collect()).unwrap();
    let found = registered(&inside_out, &shape);
    assert_near(&found.map(), &inverse(&motion), 1e-6);
    // The reach follows the spread of the distances, as it does for the shape itself.
    assert!(found.reach <= 1.01 * registered(&shape, &shape).reach, "{}", found.reach);
}

#[test]
fn bits_do_not_depend_on_threads_and_units_do_not_matter() {
    let shape = asymmetric();
    let motion = motion(&mut Random::new(6), 3.0);
    let part = transform(&between(&shape, -0.5, 9.0), &motion).unwrap();
    let fixed = Fixed::new(&shape).unwrap();
    let on = |threads| {
        let limits = Limits { threads: Some(Limits::threads(threads).unwrap()), ..Limits::default() };
        register(&part, &fixed, &RegistrationOptions { limits, ..RegistrationOptions::default() }).unwrap()
    };
    let found = on(1);
    assert_eq!(found.matrix, on(3).matrix);
    let tiny = Affine::scale([2.0_f64.powi(-400); 3]);
    let [a, b] = [&part, &shape].map(|mesh| transform(mesh, &tiny).unwrap());
    let scaled = registered(&a, &b);
    assert_eq!((scaled.map().linear, scaled.matched), (found.map().linear, found.matched));
}

#[test]
fn what_cannot_be_registered_is_refused() {
    let shape = asymmetric();
    let fixed = Fixed::new(&shape).unwrap();
    for overlap in [0.0, -1.0, 1.5, f64::NAN] {
        let options = RegistrationOptions { overlap: Some(overlap), ..RegistrationOptions::default() };
        assert!(matches!(register(&shape, &fixed, &options), Err(AlignError::Overlap(_))));
    }
    let point = TriMesh::new(vec![[1.0, 2.0, 3.0]], vec![[0, 0, 0]]).unwrap();
    assert_eq!(
        register(&point, &fixed, &RegistrationOptions::default()).unwrap_err(),
        AlignError::NoArea { faces: 1 }
    );
    let time = Limits { time: Some(std::time::Duration::ZERO), ..Limits::default() };
    let found =
        register(&shape, &fixed, &RegistrationOptions { limits: time, ..RegistrationOptions::default() })
            .unwrap();
    assert!(found.stop.is_early());
}
