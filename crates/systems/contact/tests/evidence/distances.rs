//! Distances, their derivatives, and times of impact.

use glam::DVec3;
use pompeiu_contact::ccd::time_of_impact;
use pompeiu_contact::distance::Closest;
use pompeiu_contact::{Contact, Curvature, Kind, Projection};

/// Numbers in [−1, 1) that are the same every time.
pub(crate) struct Numbers(pub(crate) u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn point(&mut self) -> DVec3 {
        DVec3::new(self.next(), self.next(), self.next())
    }

    fn points(&mut self) -> [DVec3; 4] {
        std::array::from_fn(|_| self.point())
    }
}

const KINDS: [Kind; 4] = [Kind::PointTriangle, Kind::EdgeEdge, Kind::PointEdge, Kind::PointPoint];

#[test]
fn no_point_of_a_pair_is_closer_than_the_closest() {
    let mut numbers = Numbers(1);
    for _ in 0..300 {
        let x = numbers.points();
        let steps = 60;
        let share = |i: usize| i as f64 / f64::from(steps);
        let triangle = Closest::of(Kind::PointTriangle, &x).distance_sq().sqrt();
        let edges = Closest::of(Kind::EdgeEdge, &x).distance_sq().sqrt();
        let (mut sampled, mut sampled_edges) = (f64::INFINITY, f64::INFINITY);
        for i in 0..=steps as usize {
            for j in 0..=steps as usize {
                let (s, t) = (share(i), share(j));
                sampled_edges = sampled_edges.min(x[0].lerp(x[1], s).distance(x[2].lerp(x[3], t)));
                if s + t <= 1.0 {
                    sampled = sampled.min(x[0].distance(x[1] * (1.0 - s - t) + x[2] * s + x[3] * t));
                }
            }
        }
        // A sample is within a step of the closest point on both parts.
        let near = 2.0 * 3.5 / f64::from(steps);
        assert!(triangle <= sampled + 1e-14 && sampled <= triangle + near, "{triangle} {sampled}");
        assert!(edges <= sampled_edges + 1e-14 && sampled_edges <= edges + near, "{edges} {sampled_edges}");
    }
}

#[test]
fn derivatives_of_distances_are_those_of_differences() {
    let mut numbers = Numbers(2);
    let h = 1e-5;
    let mut worst = [0.0_f64; 2];
    for round in 0..400 {
        let kind = KINDS[round % 4];
        let x = numbers.points();
        let closest = Closest::of(kind, &x);
        let (gradient, hessian) = (closest.gradient(), closest.hessian(&x));
        let moved = |j: usize, by: f64| {
            let mut x = x;
            x[j / 3][j % 3] += by;
            Closest::of(kind, &x)
        };
        // Where the closest points change their kind, second derivatives jump.
        let free = |j: usize| [moved(j, h).free, moved(j, -h).free];
        if (0..12).any(|j| free(j) != [closest.free; 2]) {
            continue;
        }
        for j in 0..12 {
            let (high, low) = (moved(j, h), moved(j, -h));
            let slope = (high.distance_sq() - low.distance_sq()) / (2.0 * h);
            worst[0] = worst[0].max((slope - gradient[j / 3][j % 3]).abs());
            for i in 0..12 {
                let slope = (high.gradient()[i / 3][i % 3] - low.gradient()[i / 3][i % 3]) / (2.0 * h);
                let size = 1.0 + hessian.iter().flatten().map(|x| x * x).sum::<f64>();
                worst[1] = worst[1].max((slope - hessian[i][j]).abs() / size);
            }
        }
    }
    assert!(worst[0] < 1e-8 && worst[1] < 1e-6, "{worst:?}");
}

#[test]
fn close_pairs_lose_no_more_digits_than_they_must() {
    // A point straight above a triangle in a plane through other coordinates: the distance and the direction are known.
    let mut numbers = Numbers(3);
    for distance in [1e-3, 1e-6] {
        for _ in 0..200 {
            let [a, b, c, _] = numbers.points();
            let n = (b - a).cross(c - a).normalize();
            let p = (a + b + c) / 3.0 + n * distance;
            let closest = Closest::of(Kind::PointTriangle, &[p, a, b, c]);
            let error = (closest.distance_sq().sqrt() / distance - 1.0).abs();
            // Rounding of p alone is 1e-16 of its size.
            assert!(error < 4e-15 / distance, "{distance}: {error}");
        }
    }
}

/// Jacobi's method for a symmetric matrix: the nearest positive semi-definite one.
fn positive_part(matrix: &[[f64; 12]; 12]) -> [[f64; 12]; 12] {
    let (mut a, mut v) = (*matrix, [[0.0; 12]; 12]);
    for (i, row) in v.iter_mut().enumerate() {
        row[i] = 1.0;
    }
    for _ in 0..60 {
        for p in 0..12 {
            for q in p + 1..12 {
                if a[p][q] == 0.0 {
                    continue;
                }
                let angle = 0.5 * (2.0 * a[p][q]).atan2(a[q][q] - a[p][p]);
                let (s, c) = angle.sin_cos();
                for k in 0..12 {
                    (a[k][p], a[k][q]) = (c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]);
                    (v[k][p], v[k][q]) = (c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]);
                }
                for k in 0..12 {
                    (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
                }
            }
        }
    }
    std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..12).map(|k| a[k][k].max(0.0) * v[i][k] * v[j][k]).sum())
    })
}

#[test]
fn the_projection_in_five_dimensions_is_that_in_twelve() {
    let mut numbers = Numbers(4);
    let d_hat = 1.5;
    for round in 0..200 {
        let kind = KINDS[round % 4];
        let x = numbers.points();
        let closest = Closest::of(kind, &x);
        if closest.distance_sq() >= d_hat * d_hat {
            continue;
        }
        let contact = Contact { kind, vertices: [0, 1, 2, 3], weight: 1.0, mollified: 0.0 };
        let (gradient, curvature) = contact.derivatives(&x, d_hat, Projection::Exact);
        let Curvature::Full(found) = curvature else { panic!("a matrix") };
        let [_, first, second] = pompeiu_contact::barrier::barrier(closest.distance_sq(), d_hat * d_hat);
        let by = |i: usize| closest.gradient()[i / 3][i % 3];
        let hessian = closest.hessian(&x);
        let full =
            std::array::from_fn(|i| std::array::from_fn(|j| second * by(i) * by(j) + first * hessian[i][j]));
        let expected = positive_part(&full);
        let size = full.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        for i in 0..12 {
            assert!((gradient[i / 3][i % 3] - first * by(i)).abs() < 1e-12 * size.max(1.0));
            for j in 0..12 {
                assert!(
                    (found[i][j] - expected[i][j]).abs() < 1e-12 * size,
                    "{kind:?} {} {}",
                    found[i][j],
                    expected[i][j]
                );
            }
        }
    }
}

/// Times in order at which a point is in the plane of a triangle, or two edges are in one plane.
fn coplanar_times(x: &[DVec3; 4], p: &[DVec3; 4]) -> Vec<f64> {
    let volume = |t: f64| {
        let [a, b, c, d] = std::array::from_fn(|i| x[i] + p[i] * t);
        (b - a).cross(c - a).dot(d - a)
    };
    let steps = 400;
    let mut times = Vec::new();
    for i in 0..steps {
        let (mut low, mut high) = (f64::from(i) / f64::from(steps), f64::from(i + 1) / f64::from(steps));
        if volume(low) * volume(high) > 0.0 {
            continue;
        }
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if volume(low) * volume(middle) <= 0.0 { high = middle } else { low = middle }
        }
        times.push(0.5 * (low + high));
    }
    times
}

#[test]
fn times_of_impact_are_never_late() {
    let mut numbers = Numbers(5);
    let (mut hits, mut gained) = (0, Vec::new());
    for round in 0..4000 {
        let kind = KINDS[round % 2];
        let x = numbers.points();
        let p: [DVec3; 4] = std::array::from_fn(|_| numbers.point() * 2.0);
        let found = time_of_impact(kind, &x, &p);
        let touches = |t: f64| {
            let at = std::array::from_fn(|i| x[i] + p[i] * t);
            Closest::of(kind, &at).distance_sq() < 1e-20
        };
        if let Some(exact) = coplanar_times(&x, &p).into_iter().find(|&t| touches(t)) {
            let found = found.expect("a contact that must be found");
            assert!(found < exact, "{kind:?}: {found} {exact}");
            hits += 1;
            gained.push(found / exact);
        }
    }
    assert!(hits > 200, "{hits}");
    gained.sort_by(f64::total_cmp);
    assert!(gained[hits / 2] > 0.85, "{}", gained[hits / 2]);
}
