//! Clusters against exhaustive search and against known classes.

use pompeiu_complexity::generate::{self, PointOrder};
use pompeiu_complexity::{
    AnalyseOptions, MeasureOptions, Shape, adjusted_rand, analyse, cluster, faster_pam, matched_accuracy,
    optimal_medoids, silhouettes,
};
use pompeiu_core::mesh::edit::Random;
use pompeiu_core::run::Limits;
use pompeiu_planar::{Outline, Point, resample};

fn distances(random: &mut Random, n: usize) -> Vec<Vec<f64>> {
    let points: Vec<[f64; 2]> = (0..n).map(|_| [random.signed_unit(), random.signed_unit()]).collect();
    points.iter().map(|p| points.iter().map(|q| (p[0] - q[0]).hypot(p[1] - q[1])).collect()).collect()
}

fn loss(distances: &[Vec<f64>], medoids: &[usize]) -> f64 {
    distances.iter().map(|row| medoids.iter().map(|m| row[*m]).fold(f64::INFINITY, f64::min)).sum()
}

#[test]
fn swaps_end_where_no_swap_helps_and_the_optimum_is_below() {
    let mut random = Random::new(9);
    let mut reached = 0;
    for round in 0..60 {
        let n = 12 + round % 30;
        let k = 2 + round % 4;
        let d = distances(&mut random, n);
        let (found, medoids) = faster_pam(&d, (0..k).collect());
        assert!((found - loss(&d, &medoids)).abs() < 1e-12);
        for i in 0..k {
            for c in 0..n {
                let mut other = medoids.clone();
                other[i] = c;
                assert!(loss(&d, &other) > found - 1e-12);
            }
        }
        if n <= 20 {
            let (best, _) = optimal_medoids(&d, k);
            assert!(best <= found + 1e-12);
            reached += usize::from(best > found - 1e-12);
        }
    }
    assert!(reached > 10, "{reached}");
}

#[test]
fn the_same_start_leads_where_the_package_kmedoids_leads() {
    // kmedoids 0.5.5 (PyPI), fasterpam from medoids 0 to 4 on |i² mod 1009 − j² mod 1009| for 200 points.
    let at = |i: usize| (i * i % 1009) as f64;
    let d: Vec<Vec<f64>> = (0..200).map(|i| (0..200).map(|j| (at(i) - at(j)).abs()).collect()).collect();
    let (found, _) = faster_pam(&d, (0..5).collect());
    assert_eq!(found, KMEDOIDS_LOSS);
}

/// The result of that package.
const KMEDOIDS_LOSS: f64 = 9822.0;

#[test]
fn clusters_are_optimal_where_they_are_small_and_valid_where_not() {
    let names = ["x".to_owned()];
    let rows: Vec<Vec<f64>> = [0.0, 0.1, 0.2, 5.0, 5.1, 9.0].map(|x| vec![x]).to_vec();
    let found = cluster(&rows, &names, 3).unwrap();
    assert!(found.is_optimal);
    assert_eq!(matched_accuracy(&found.labels, &[0, 0, 0, 1, 1, 2]), Some(1.0));
    assert_eq!(found.silhouettes[5], 0.0);
    assert!(found.silhouettes[..5].iter().all(|s| *s > 0.9));
    assert!(cluster(&rows, &names, 7).is_err() && cluster(&rows, &names, 0).is_err());
    let same = cluster(&vec![vec![1.0]; 5], &names, 3).unwrap();
    assert_eq!(same.loss, 0.0);
    let mut seen = same.medoids.clone();
    seen.sort_unstable();
    seen.dedup();
    assert_eq!(seen.len(), 3);
}

#[test]
fn silhouettes_and_rand_have_their_worked_values() {
    let at = [0.0_f64, 2.0, 10.0, 12.0];
    let d: Vec<Vec<f64>> = at.iter().map(|x| at.iter().map(|y| (x - y).abs()).collect()).collect();
    let found = silhouettes(&d, &[0, 0, 1, 1], 2);
    assert_eq!(found, [(11.0 - 2.0) / 11.0, (9.0 - 2.0) / 9.0, (9.0 - 2.0) / 9.0, (11.0 - 2.0) / 11.0]);
    assert_eq!(adjusted_rand(&[0, 0, 1, 1], &[1, 1, 0, 0]), Some(1.0));
    // Six points, (1 1 2 | 2 3 3) against (1 2 3 | 1 2 3): no pair agrees.
    let rand = adjusted_rand(&[0, 0, 0, 1, 1, 1], &[0, 0, 1, 1, 2, 2]).unwrap();
    assert!((rand - (2.0 - 6.0 * 3.0 / 15.0) / (4.5 - 6.0 * 3.0 / 15.0)).abs() < 1e-14);
    assert_eq!(matched_accuracy(&[0, 1, 1, 1], &[1, 0, 0, 1]), Some(0.75));
}

#[test]
fn the_four_classes_of_polylines_are_told_apart() {
    // Smooth curves need no smoothing of points: the default is for the pixels of pictures.
    let measure = MeasureOptions { smoothing: 0.0 };
    for order in [PointOrder::Random, PointOrder::Angle] {
        let mut shapes = Vec::new();
        let mut classes = Vec::new();
        for (class, points) in [5, 10, 15, 25].into_iter().enumerate() {
            for seed in 0..42 {
                let outline = generate::polyline(points, 1000 * points as u64 + seed, order).unwrap();
                shapes.push(Shape { file: format!("{points}-{seed}"), outline });
                classes.push(class);
            }
        }
        let options = AnalyseOptions {
            clusters: Some(4),
            measure: measure.clone(),
            features: curvature_features(),
            ..AnalyseOptions::default()
        };
        let report = analyse(&shapes, &options).unwrap();
        let accuracy = matched_accuracy(&report.clusters.as_ref().unwrap().labels, &classes).unwrap();
        assert!(accuracy >= 0.97, "{order:?}: {accuracy}");
        let some = &shapes[..20];
        let one = AnalyseOptions { clusters: None, limits: threads(1), ..options.clone() };
        let several = AnalyseOptions { limits: threads(3), ..one.clone() };
        let [one, several] = [one, several].map(|options| analyse(some, &options).unwrap());
        assert_eq!((&one.shapes, &one.ranking), (&several.shapes, &several.ranking));
    }
}

/// What tells curves apart that differ in their bends alone.
fn curvature_features() -> Vec<String> {
    ["log:peaks", "log:total-curvature"].map(str::to_owned).to_vec()
}

/// Outlines of a class: without detail, as corners or as a radius by angle.
fn classes() -> Vec<Outline> {
    let polar = |radius: &dyn Fn(f64) -> f64| -> Vec<Point> {
        let angles = (0..720).map(|i| std::f64::consts::TAU * f64::from(i) / 720.0);
        angles.map(|a| [radius(a) * a.cos(), radius(a) * a.sin()]).collect()
    };
    let ellipse = |h: f64| polar(&|_| 1.0).into_iter().map(|[x, y]| [x, h * y]).collect::<Vec<_>>();
    let star = |n: usize, inner: f64| -> Vec<Point> {
        let at = |i: usize| {
            let angle = std::f64::consts::PI * i as f64 / n as f64;
            let r = if i.is_multiple_of(2) { 1.0 } else { inner };
            [r * angle.cos(), r * angle.sin()]
        };
        (0..2 * n).map(at).collect()
    };
    let rectangle = |h: f64| vec![[0.0, 0.0], [2.0, 0.0], [2.0, h], [0.0, h]];
    let u = |w: f64| {
        vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [2.0 - w, 2.0], [2.0 - w, w], [w, w], [w, 2.0], [0.0, 2.0]]
    };
    let all = vec![
        polar(&|_| 1.0),
        ellipse(0.5),
        rectangle(2.0),
        rectangle(0.3),
        vec![[0.0, 0.0], [2.0, 0.0], [1.0, 1.8]],
        star(5, 0.42),
        star(9, 0.6),
        polar(&|a| 1.0 + 0.5 * (4.0 * a).cos()),
        polar(&|a| 1.0 + 0.35 * (6.0 * a).cos()),
        u(0.6),
        vec![[0.0, 0.0], [2.0, 0.0], [2.0, 0.6], [0.6, 0.6], [0.6, 2.0], [0.0, 2.0]],
        vec![[0.0, 0.3], [1.3, 0.3], [1.3, 0.8], [2.2, 0.0], [1.3, -0.8], [1.3, -0.3], [0.0, -0.3]],
    ];
    all.into_iter().map(|points| Outline::new(points).unwrap()).collect()
}

/// A member of a class: bent by a smooth displacement, turned, scaled, and with a ragged outline.
fn member(class: &Outline, random: &mut Random) -> Outline {
    let unit = class.area().sqrt();
    let centre = class.centroid();
    let points = resample(class, 500, 0);
    let bends: Vec<[f64; 4]> = (0..3).map(|_| [0; 4].map(|_| random.signed_unit())).collect();
    let (turn, size) = (3.0 * random.signed_unit(), 50.0 * libm::exp(random.signed_unit()));
    // Raggedness of any wave length and strength, as of photographs and drawings.
    let (amplitude, reach) = (0.012 * random.signed_unit().abs(), 2 + random.below(8) as usize);
    let noise: Vec<f64> = points.iter().map(|_| random.signed_unit()).collect();
    let n = noise.len();
    let at = |i: usize| {
        let p = [0, 1].map(|k| (points[i][k] - centre[k]) / unit);
        let ragged: f64 = (0..reach).map(|k| noise[(i + k) % n]).sum::<f64>() / (reach as f64).sqrt();
        let mut q = p.map(|x| x * (1.0 + amplitude * ragged * 2.0));
        for [x, y, dx, dy] in &bends {
            let away = (p[0] - x).powi(2) + (p[1] - y).powi(2);
            let weight = 0.18 * libm::exp(-1.5 * away);
            q = [q[0] + weight * dx, q[1] + weight * dy];
        }
        let (s, c) = libm::sincos(turn);
        [size * (c * q[0] - s * q[1]), size * (s * q[0] + c * q[1])]
    };
    Outline::new((0..n).map(at).collect()).unwrap()
}

#[test]
fn default_features_tell_classes_apart_whose_members_differ_in_detail() {
    let mut random = Random::new(31);
    let (mut shapes, mut classes_of) = (Vec::new(), Vec::new());
    let classes = classes();
    for (class, outline) in classes.iter().enumerate() {
        for i in 0..12 {
            shapes.push(Shape { file: format!("{class}-{i}"), outline: member(outline, &mut random) });
            classes_of.push(class);
        }
    }
    let found = |features: Option<Vec<String>>| {
        let defaults = AnalyseOptions::default();
        let features = features.unwrap_or_else(|| defaults.features.clone());
        let options = AnalyseOptions { clusters: Some(classes.len()), features, ..defaults };
        let report = analyse(&shapes, &options).unwrap();
        adjusted_rand(&report.clusters.unwrap().labels, &classes_of).unwrap()
    };
    let (default, curvature) = (found(None), found(Some(curvature_features())));
    assert!(default > 0.75, "{default}");
    assert!(curvature < 0.5, "the members differ too little: {curvature}");
}

fn threads(count: usize) -> Limits {
    Limits { threads: Some(Limits::threads(count).unwrap()), ..Limits::default() }
}

#[test]
fn another_ranking_is_found_by_name() {
    let shapes: Vec<Shape> = (3..11)
        .map(|n| Shape {
            file: format!("folder/{n}.png"),
            outline: generate::polyline(n, 1, PointOrder::Random).unwrap(),
        })
        .collect();
    let options = AnalyseOptions {
        measure: MeasureOptions { smoothing: 0.01 },
        against: Some((3..11).map(|n| (n.to_string(), f64::from(n))).collect()),
        ..AnalyseOptions::default()
    };
    let report = analyse(&shapes, &options).unwrap();
    let agreement = report.agreement.unwrap();
    assert!(agreement.kendall > 0.3 && agreement.permutations == 40_320, "{agreement:?}");
    let short = AnalyseOptions { against: Some(vec![("3".into(), 1.0)]), ..options };
    assert!(analyse(&shapes, &short).unwrap_err().to_string().contains("4.png"));
}
