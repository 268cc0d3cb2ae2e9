//! Predicates, areas and distances against brute force.

use pompeiu_core::mesh::edit::Random;
use pompeiu_planar::contour::contours;
use pompeiu_planar::{Outline, Point, first_crossing, hausdorff, intersection_area, resample, segments_meet};

fn polygon(random: &mut Random, corners: usize) -> Outline {
    let mut point = || [random.signed_unit(), random.signed_unit()];
    Outline::new((0..corners).map(|_| point()).collect()).unwrap()
}

#[test]
fn crossings_are_those_of_brute_force() {
    let mut random = Random::new(3);
    let mut simple = 0;
    for _ in 0..400 {
        let outline = polygon(&mut random, 5);
        let sides: Vec<[Point; 2]> = outline.sides().collect();
        let n = sides.len();
        let crossing =
            |i: usize, j: usize| j > i + 1 && !(i == 0 && j == n - 1) && segments_meet(sides[i], sides[j]);
        let expected = (0..n).flat_map(|i| (0..n).map(move |j| [i, j])).find(|[i, j]| crossing(*i, *j));
        assert_eq!(first_crossing(&outline).map(|c| c.sides), expected);
        simple += usize::from(expected.is_none());
    }
    assert!(simple > 20, "{simple}");
}

#[test]
fn common_areas_agree_with_counting() {
    let mut random = Random::new(8);
    for _ in 0..20 {
        let (a, b) = (polygon(&mut random, 7), polygon(&mut random, 6));
        let n = 400;
        let at = |i: usize| (i as f64 + 0.5) / f64::from(n) * 2.0 - 1.0;
        let counted = (0..n as usize)
            .flat_map(|i| (0..n as usize).map(move |j| (i, j)))
            .filter(|(i, j)| a.contains([at(*i), at(*j)]) && b.contains([at(*i), at(*j)]))
            .count();
        let cells = 4.0 * counted as f64 / f64::from(n * n);
        assert!((intersection_area(&a, &b) - cells).abs() < 0.01, "{} {cells}", intersection_area(&a, &b));
        assert!((intersection_area(&a, &b) - intersection_area(&b, &a)).abs() < 1e-13);
    }
}

#[test]
fn distances_agree_with_dense_sampling() {
    let mut random = Random::new(21);
    for _ in 0..10 {
        let (a, b) = (polygon(&mut random, 5), polygon(&mut random, 6));
        let dense = |from: &Outline, to: &Outline| {
            let samples = resample(from, 4000, 0);
            samples.iter().map(|p| pompeiu_planar::distance_to_outline(*p, to)).fold(0.0, f64::max)
        };
        let sampled = dense(&a, &b).max(dense(&b, &a));
        let found = hausdorff(&a, &b);
        assert!(found >= sampled - 1e-8 && found <= sampled + a.length().max(b.length()) / 4000.0);
    }
}

#[test]
fn contours_of_a_cone_lie_on_its_circle() {
    let (width, height, centre, radius) = (60, 50, [28.3, 24.6], 17.25);
    let level_at = |i: usize| {
        let (x, y) = ((i % width) as f64 - centre[0], (i / width) as f64 - centre[1]);
        (1.0 - (x * x + y * y).sqrt() / 40.0) as f32
    };
    let values: Vec<f32> = (0..width * height).map(level_at).collect();
    let found = contours(&values, width, 1.0 - radius / 40.0);
    assert_eq!(found.len(), 1);
    assert!(found[0].is_closed);
    let off = |p: &Point| ((p[0] - centre[0]).hypot(p[1] - centre[1]) - radius).abs();
    assert!(found[0].points.iter().all(|p| off(p) < 0.02));
    let area = Outline::new(found[0].points.clone()).unwrap().area();
    assert!((area / (std::f64::consts::PI * radius * radius) - 1.0).abs() < 2e-3);
}
