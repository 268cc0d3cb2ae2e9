//! Distances, their derivatives, and times of impact.

use glam::DVec3;
use pompeiu_contact::ccd::time_of_impact;
use pompeiu_contact::distance::{Closest, distance_sq};
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

/// The vector product and the scalar product of vectors of integers.
fn cross(u: [i128; 3], v: [i128; 3]) -> [i128; 3] {
    [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
}

fn dot(u: [i128; 3], v: [i128; 3]) -> i128 {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

#[test]
fn close_pairs_keep_all_digits() {
    // Coordinates are integers, from which squared distances of pairs a billionth of their size apart follow exactly.
    let mut numbers = Numbers(3);
    let mut worst = [0.0_f64; 2];
    for round in 0..400 {
        let mut whole = |scale: f64| numbers.point().to_array().map(|c| (c * scale).round() as i128);
        let (a, b, c, near) = (whole(1e9), whole(1e9), whole(1e9), whole(3.0));
        let of = |f: &dyn Fn(usize) -> i128| -> [i128; 3] { std::array::from_fn(f) };
        let (kind, corners, u, v, between) = if round % 2 == 0 {
            let p = of(&|k| (a[k] + b[k] + c[k]) / 3 + near[k]);
            let (u, v) = (of(&|k| b[k] - a[k]), of(&|k| c[k] - a[k]));
            (Kind::PointTriangle, [p, a, b, c], u, v, of(&|k| p[k] - a[k]))
        } else {
            // The diagonals of a parallelogram meet.
            let d = of(&|k| a[k] + b[k] - c[k] + near[k]);
            let (u, v) = (of(&|k| b[k] - a[k]), of(&|k| d[k] - c[k]));
            (Kind::EdgeEdge, [a, b, c, d], u, v, of(&|k| a[k] - c[k]))
        };
        let (normal, x) = (cross(u, v), corners.map(|p| DVec3::from_array(p.map(|c| c as f64))));
        let (height, square) = (dot(normal, between), dot(normal, normal));
        // The sine of the angle, on which the direction of a normal depends.
        let sine = (square as f64 / (dot(u, u) as f64 * dot(v, v) as f64)).sqrt();
        if height == 0 || sine < 0.1 {
            continue;
        }
        let closest = Closest::of(kind, &x);
        let expected = height as f64 / square as f64 * height as f64;
        worst[0] = worst[0].max((closest.distance_sq() / expected - 1.0).abs());
        let along = DVec3::from_array(normal.map(|c| c as f64)) * (height as f64 / square as f64);
        worst[1] = worst[1].max((closest.vector - along).length() / along.length());
    }
    assert!(worst[0] < 1e-14 && worst[1] < 1e-14, "{worst:?}");
}

#[test]
fn squared_distances_alone_are_those_of_the_closest_points() {
    let mut numbers = Numbers(9);
    for round in 0..4000 {
        let kind = KINDS[round % 4];
        let mut x = numbers.points();
        // Parallel and nearly parallel edges, flat triangles, points that are equal.
        let small = numbers.point() * [0.0, 1e-12, 1e-8, 1e-4][round / 4 % 4];
        match round / 16 % 4 {
            0 => x[3] = x[2] + (x[1] - x[0]) * 0.7 + small,
            1 => x[3] = x[1] * 0.4 + x[2] * 0.6 + small,
            2 => x[2] = x[1] + small,
            _ => {}
        }
        let (found, expected) = (distance_sq(kind, &x), Closest::of(kind, &x).distance_sq());
        assert!((found.sqrt() - expected.sqrt()).abs() < 1e-7, "{kind:?} {x:?}: {found} {expected}");
        if round / 16 % 4 == 3 {
            assert!((found - expected).abs() < 1e-13, "{kind:?} {x:?}: {found} {expected}");
        }
    }
}

/// Two edges that are parallel but for a part of their length, half of which is enough to be mollified.
fn nearly_parallel(numbers: &mut Numbers, part: f64) -> (Contact, [DVec3; 4]) {
    let [a, u, shift, turn] = numbers.points();
    let v = u + turn * part;
    let side = (shift - u * (shift.dot(u) / u.length_squared())).normalize() * 0.8;
    let x = [a, a + u, a + side, a + side + v];
    let mollified = 2.0 * u.cross(v).length_squared();
    (Contact { kind: Kind::EdgeEdge, vertices: [0, 1, 2, 3], weight: 1.0, mollified }, x)
}

#[test]
fn second_derivatives_of_mollified_pairs_are_those_of_differences() {
    let mut numbers = Numbers(10);
    let (h, d_hat, mut worst, mut looked_at) = (1e-6, 1.5, 0.0_f64, 0);
    for _ in 0..60 {
        let (pair, x) = nearly_parallel(&mut numbers, 0.3);
        let hessian = pair.second_derivatives(&x, d_hat);
        let moved = |j: usize, by: f64| {
            let mut x = x;
            x[j / 3][j % 3] += by;
            (Closest::of(pair.kind, &x).free, pair.derivatives(&x, d_hat, Projection::Normal).0)
        };
        let size = hessian.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        for j in 0..12 {
            let ((free, high), (same, low)) = (moved(j, h), moved(j, -h));
            if [free, same] != [Closest::of(pair.kind, &x).free; 2] {
                continue;
            }
            looked_at += 1;
            for i in 0..12 {
                let slope = (high[i / 3][i % 3] - low[i / 3][i % 3]) / (2.0 * h);
                worst = worst.max((slope - hessian[i][j]).abs() / size);
            }
        }
    }
    assert!(looked_at > 400 && worst < 1e-8, "{looked_at} {worst:e}");
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
    for round in 0..250 {
        let kind = KINDS[round % 4];
        let (contact, x) = if round < 200 {
            (Contact { kind, vertices: [0, 1, 2, 3], weight: 1.0, mollified: 0.0 }, numbers.points())
        } else {
            nearly_parallel(&mut numbers, 0.2)
        };
        let closest = Closest::of(contact.kind, &x);
        if closest.distance_sq() >= d_hat * d_hat {
            continue;
        }
        let (gradient, curvature) = contact.derivatives(&x, d_hat, Projection::Exact);
        let Curvature::Full(found) = curvature else { panic!("a matrix") };
        let [_, first, _] = pompeiu_contact::barrier::barrier(closest.distance_sq(), d_hat * d_hat);
        let by = |i: usize| closest.gradient()[i / 3][i % 3];
        let full = contact.second_derivatives(&x, d_hat);
        let expected = positive_part(&full);
        let size = full.iter().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
        for i in 0..12 {
            if round < 200 {
                assert!((gradient[i / 3][i % 3] - first * by(i)).abs() < 1e-12 * size.max(1.0));
            }
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

#[test]
fn times_of_impact_are_not_late_far_from_the_origin_and_in_any_unit() {
    let mut numbers = Numbers(6);
    let mut hits = 0;
    for round in 0..1500 {
        let kind = KINDS[round % 2];
        // Whole multiples of 2⁻²⁰, so that nothing is rounded when everything is moved.
        let mut whole = |scale: f64| (numbers.point() * scale * 1_048_576.0).round() / 1_048_576.0;
        let x: [DVec3; 4] = std::array::from_fn(|_| whole(1.0));
        let p: [DVec3; 4] = std::array::from_fn(|_| whole(2.0));
        let touches = |t: f64| {
            let at = std::array::from_fn(|i| x[i] + p[i] * t);
            Closest::of(kind, &at).distance_sq() < 1e-20
        };
        let Some(exact) = coplanar_times(&x, &p).into_iter().find(|&t| touches(t)) else { continue };
        hits += 1;
        for (shift, unit) in [(1e6, 1.0), (0.0, 1e-60), (0.0, 1e60)] {
            let placed = x.map(|x| (x + DVec3::splat(shift)) * unit);
            let found = time_of_impact(kind, &placed, &p.map(|p| p * unit));
            let found = found.expect("a contact that must be found");
            assert!(found < exact && found > 0.0, "{kind:?} {shift} {unit}: {found} {exact}");
        }
    }
    assert!(hits > 80, "{hits}");
}
