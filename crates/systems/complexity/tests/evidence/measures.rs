//! Measures of shapes with known values, and invariance under motions.

use crate::{circle, elsewhere};
use pompeiu_complexity::{Measure, MeasureOptions, Measures, generate};
use pompeiu_planar::Outline;
use std::f64::consts::PI;

fn of(outline: &Outline) -> Measures {
    Measures::of(outline, &MeasureOptions::default()).unwrap()
}

#[test]
fn a_circle_has_its_closed_forms() {
    let measures = of(&circle(100_000));
    let b = |m: f64| m / PI * (PI / m).sin();
    let found = measures.boundary;
    for (value, m) in
        [(found.m500, 500.0), (found.m100, 100.0), (found.m50, 50.0), (found.m25, 25.0), (found.m8, 8.0)]
    {
        assert!((value - b(m)).abs() < 1e-9, "{m}: {value}");
    }
    // A polygon of 1000 corners through which all eight points pass: exact.
    let polygon = of(&circle(1000)).boundary.m8;
    let exact = 8.0 * (PI / 8.0).sin() / (1000.0 * (PI / 1000.0).sin());
    assert!((polygon - exact).abs() < 1e-13, "{polygon} {exact}");
    assert!((b(8.0) - 0.974_495_358_404_43).abs() < 1e-13);
    let curvature = &measures.curvature;
    assert_eq!((curvature.neg5, curvature.one_minus_first_bin, curvature.peaks), (0.0, 0.0, 0));
    assert!((curvature.total - 1.0).abs() < 1e-12);
    assert!((measures.global.compactness - 1.0).abs() < 1e-8);
    assert!((measures.coverage.circle - 1.0).abs() < 1e-8 && (measures.global.diameter - 1.0).abs() < 1e-8);
    assert!((measures.moments.elongation - 1.0).abs() < 1e-8 && (measures.moments.spread - 1.0).abs() < 1e-8);
    assert!((measures.moments.hu[0] - 1.0 / (2.0 * PI)).abs() < 1e-9);
    assert!(measures.skeleton.length < 1e-6 && measures.skeleton.ends == 0);
    assert!((measures.skeleton.radius - 1.0 / PI.sqrt()).abs() < 1e-6);
}

#[test]
fn a_rectangle_has_its_closed_forms() {
    let rectangle = Outline::new(vec![[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [0.0, 1.0]]).unwrap();
    let measures = Measures::of(&rectangle, &MeasureOptions { smoothing: 0.0 }).unwrap();
    assert!((measures.moments.elongation - 3.0).abs() < 1e-12);
    assert!((measures.moments.spread - PI / 3.0).abs() < 1e-12);
    assert!((measures.moments.hu[0] - (9.0 + 1.0) / 36.0).abs() < 1e-12);
    assert_eq!((measures.coverage.hull, measures.global.convexity), (1.0, 1.0));
    assert!((measures.coverage.rectangle - 1.0).abs() < 1e-15);
    assert!((measures.global.aspect - 1.0 / 3.0).abs() < 1e-15);
    assert!((measures.coverage.circle - 3.0 / (PI * 2.5)).abs() < 1e-12);
    assert!((measures.global.diameter - PI / 4.0 * 10.0 / 3.0).abs() < 1e-12);
    assert_eq!((measures.curvature.peaks, measures.curvature.neg5), (4, 0.0));
    assert!((measures.curvature.total - 1.0).abs() < 1e-12);
    // The axis: a segment of length 2, and four branches to the corners that stop where circles touch points 5 % apart.
    let skeleton = measures.skeleton;
    assert_eq!((skeleton.ends, skeleton.junctions), (4, 2));
    let whole = (2.0 + 4.0 * 0.5_f64.sqrt()) / 3.0_f64.sqrt();
    assert!(skeleton.length < whole && skeleton.length > whole - 4.0 * 0.3 / 3.0_f64.sqrt(), "{skeleton:?}");
    // The square turns at its corners and nowhere else.
    let square = Outline::new(vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]).unwrap();
    let measures = Measures::of(&square, &MeasureOptions { smoothing: 0.0 }).unwrap();
    assert_eq!(measures.curvature.histogram[5] * 500.0, 4.0);
    assert_eq!(measures.curvature.first_bin * 500.0, 496.0);
}

#[test]
fn a_peak_of_curvature_stands_out_by_one_on_both_sides() {
    // A square whose corners are cut off, with two corners of 45° in place of each. Smoothed, the two have a maximum each if they are
    // more than two standard deviations apart. At 2.2 curvature falls by less than 1 between them, at 2.8 by two.
    let peaks = |deviations: f64| {
        let smoothing = 0.01;
        let side = deviations * smoothing;
        let cut = 4.0 * side / (2.0_f64.sqrt() + (8.0 - 32.0_f64.sqrt()) * side);
        let (a, b) = (cut, 1.0 - cut);
        let corners = [[a, 0.], [b, 0.], [1., a], [1., b], [b, 1.], [a, 1.], [0., b], [0., a]];
        let outline = Outline::new(corners.to_vec()).unwrap();
        Measures::of(&outline, &MeasureOptions { smoothing }).unwrap().curvature.peaks
    };
    assert_eq!([0.5, 2.2, 2.8, 6.0].map(peaks), [4, 4, 8, 8]);
}

#[test]
fn measures_do_not_depend_on_place_size_and_start() {
    let shapes = [
        generate::polyline(12, 4, generate::PointOrder::Angle).unwrap(),
        generate::polyline(9, 7, generate::PointOrder::Random).unwrap(),
        Outline::new(vec![[0.0, 0.0], [5.0, 0.5], [4.0, 3.0], [2.5, 1.0], [1.0, 4.0]]).unwrap(),
    ];
    for shape in &shapes {
        let expected = of(shape);
        for (angle, scale, shift, start) in
            [(0.7, 1.0, [0.0, 0.0], 0), (0.0, 1e-3, [0.0, 0.0], 3), (2.9, 17.0, [40.0, -9.0], 1234)]
        {
            let found = of(&elsewhere(shape, angle, scale, shift, start));
            for measure in Measure::ALL {
                let (a, b) = (measure.value(&expected), measure.value(&found));
                // Circumcentres lose digits.
                let most = if measure.name.starts_with("skeleton") { 1e-9 } else { 1e-12 };
                assert!((a - b).abs() <= most * a.abs().max(1.0), "{}: {a} {b}", measure.name);
            }
            for (a, b) in expected.moments.hu.iter().zip(&found.moments.hu) {
                assert!((a - b).abs() < 1e-12, "{a} {b}");
            }
        }
    }
}

#[test]
fn mirrors_change_one_sign_only() {
    let shape = generate::polyline(12, 4, generate::PointOrder::Angle).unwrap();
    let (a, b) = (of(&shape), of(&shape.map(|[x, y]| [-x, y]).unwrap()));
    for measure in Measure::ALL.iter().filter(|measure| !measure.name.starts_with("skeleton")) {
        let (a, b) = (measure.value(&a), measure.value(&b));
        assert!((a - b).abs() <= 1e-12 * a.abs().max(1.0), "{}: {a} {b}", measure.name);
    }
    assert!((a.moments.hu[5] - b.moments.hu[5]).abs() < 1e-12);
    assert!((a.moments.hu[6] + b.moments.hu[6]).abs() < 1e-12 && a.moments.hu[6] != 0.0);
}

#[test]
fn noise_and_points_make_shapes_more_complex() {
    let mean = |shapes: &dyn Fn(u64) -> Outline, value: &dyn Fn(&Measures) -> f64| {
        (0..10).map(|seed| value(&of(&shapes(seed)))).sum::<f64>() / 10.0
    };
    let levels = [1, 4, 8].map(|level| {
        let shape = |seed| generate::noisy_circle(20, level, 6, seed).unwrap();
        mean(&shape, &|m| m.boundary.m25)
    });
    assert!(levels[0] > levels[1] && levels[1] > levels[2], "{levels:?}");
    let points = [5, 10, 15, 25].map(|n| {
        let shape = |seed| generate::polyline(n, seed, generate::PointOrder::Random).unwrap();
        mean(&shape, &|m| m.boundary.m25)
    });
    assert!(points.windows(2).all(|pair| pair[0] > pair[1]), "{points:?}");
}

#[test]
fn generators_are_seeded_and_check_what_they_are_asked() {
    use generate::PointOrder::Random;
    assert_eq!(generate::polyline(8, 3, Random).unwrap(), generate::polyline(8, 3, Random).unwrap());
    assert_ne!(generate::polyline(8, 3, Random).unwrap(), generate::polyline(8, 4, Random).unwrap());
    let plain = generate::noisy_circle(20, 0, 5, 1).unwrap();
    assert_eq!(plain, generate::noisy_circle(20, 0, 5, 2).unwrap());
    assert!((plain.area() / (PI * 400.0) - 1.0).abs() < 0.02);
    assert!(generate::noisy_circle(20, 3, 5, 1).unwrap().area() > plain.area());
    assert!(generate::polyline(2, 1, Random).is_err() && generate::noisy_circle(1, 1, 1, 1).is_err());
    assert!(Measures::of(&plain, &MeasureOptions { smoothing: f64::NAN }).is_err());
}
