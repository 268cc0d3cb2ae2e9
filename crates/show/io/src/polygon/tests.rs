use super::*;
use crate::raw::RawMesh;
use std::collections::BTreeMap;

/// Triangulates one polygon with corners 0, 1, 2, … at `positions`.
fn triangles(positions: &[[f64; 3]]) -> Vec<[u32; 3]> {
    let mut raw = RawMesh::default();
    let corners = 0..positions.len() as u32;
    raw.push_polygon(corners);
    triangulate(positions, &mut raw.faces, &raw.polygons).unwrap();
    raw.faces
}

fn flat(points: &[[f64; 2]]) -> Vec<[f64; 3]> {
    points.iter().map(|p| [p[0], p[1], 0.0]).collect()
}

fn area(triangle: [u32; 3], positions: &[[f64; 3]]) -> f64 {
    let [a, b, c] = triangle.map(|i| positions[i as usize]);
    cross(subtract(b, a), subtract(c, a))[2] / 2.0
}

/// The triangles have the orientation and area of the polygon and meet edge to edge, with its edges as boundary.
fn check(points: &[[f64; 2]], expected_area: f64) {
    check_within(points, expected_area, 0.0);
}

/// The same for corners that are collinear up to rounding: a triangle may be reversed by this part of the area.
fn check_within(points: &[[f64; 2]], expected_area: f64, slack: f64) {
    let positions = flat(points);
    let triangles = triangles(&positions);
    let n = points.len() as u32;
    assert_eq!(triangles.len(), points.len() - 2);
    let areas: Vec<f64> = triangles.iter().map(|&t| area(t, &positions)).collect();
    let least = -slack * expected_area * expected_area;
    assert!(areas.iter().all(|a| a * expected_area >= least), "{triangles:?} {areas:?}");
    let bound = if slack > 0.0 { 1e-12 * expected_area.abs() } else { 1e-12 };
    assert!((areas.iter().sum::<f64>() - expected_area).abs() < bound, "{triangles:?} {areas:?}");
    let mut edges = BTreeMap::new();
    for &[a, b, c] in &triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry((from, to)).or_insert(0) += 1;
            *edges.entry((to, from)).or_insert(0) -= 1;
        }
    }
    for ((from, to), count) in edges {
        let side = i32::from((from + 1) % n == to) - i32::from((to + 1) % n == from);
        assert_eq!(count, side, "edge {from} {to} of {points:?}: {triangles:?}");
    }
}

#[test]
fn convex_and_concave_polygons_are_covered() {
    check(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]], 1.0);
    // An arrow head, with the dent at every place in the order, both ways around.
    let arrow = [[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0]];
    let ell = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let comb =
        [[0.0, 0.0], [5.0, 0.0], [5.0, 3.0], [4.0, 1.0], [3.0, 3.0], [2.0, 1.0], [1.0, 3.0], [0.0, 1.0]];
    for (polygon, area) in [(&arrow[..], 1.5), (&ell, 3.0), (&comb, 10.0)] {
        for shift in 0..polygon.len() {
            let mut rotated = polygon.to_vec();
            rotated.rotate_left(shift);
            check(&rotated, area);
            rotated.reverse();
            check(&rotated, -area);
        }
    }
}

#[test]
fn corners_on_straight_stretches_stay_connected() {
    let square =
        [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [0.0, 2.0], [0.0, 1.0]];
    let ell =
        [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 1.5], [1.0, 2.0], [0.0, 2.0]];
    let tee = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 2.0]];
    for (polygon, area) in [(&square[..], 4.0), (&ell, 3.0), (&tee, 2.0)] {
        for shift in 0..polygon.len() {
            let mut rotated = polygon.to_vec();
            rotated.rotate_left(shift);
            check(&rotated, area);
        }
    }
}

#[test]
fn a_spiral_with_many_corners_is_covered() {
    let (turns, steps) = (5.0, 400);
    let angle = |i: usize| f64::from(i as u32) / f64::from(steps as u32) * turns * std::f64::consts::TAU;
    let outer = (0..=steps).map(|i| (angle(i), 1.0));
    let inner = (0..=steps).rev().map(|i| (angle(i), 0.8));
    let points: Vec<[f64; 2]> =
        outer.chain(inner).map(|(t, r)| [r * (1.0 + t) * t.cos(), r * (1.0 + t) * t.sin()]).collect();
    let doubled: f64 = (0..points.len())
        .map(|i| (points[i], points[(i + 1) % points.len()]))
        .map(|(p, q)| p[0] * q[1] - p[1] * q[0])
        .sum();
    let positions = flat(&points);
    let areas: Vec<f64> = triangles(&positions).iter().map(|&t| area(t, &positions)).collect();
    assert_eq!(areas.len(), points.len() - 2);
    assert!(areas.iter().all(|&a| a >= 0.0));
    assert!((2.0 * areas.iter().sum::<f64>() - doubled).abs() < 1e-9 * doubled);
}

#[test]
fn scale_and_plane_do_not_matter() {
    let arrow = [[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0]];
    let ell = [[1.0, 1.0], [1.0, 2.0], [0.0, 2.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]];
    for polygon in [&arrow[..], &ell] {
        let expected = triangles(&flat(polygon));
        for scale in [1e-300, 1e-150, 1.0, 1e150, 1e300] {
            for axes in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
                let positions: Vec<[f64; 3]> = flat(polygon)
                    .iter()
                    .map(|p| axes.map(|axis| scale * (p[axis] + if axis == 2 { p[0] } else { 0.0 })))
                    .collect();
                assert_eq!(triangles(&positions), expected, "{scale} {axes:?}");
            }
        }
    }
}

#[test]
fn what_has_no_triangulation_stays_a_fan() {
    let nan = f64::NAN;
    let bow_tie = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]];
    let pentagram = [[0.0, 3.0], [2.0, -2.0], [-3.0, 1.0], [3.0, 1.0], [-2.0, -2.0]];
    for polygon in
        [&bow_tie[..], &pentagram, &[[0.0; 2]; 4], &[[1.0; 2]; 6], &[[0.0, nan]; 4], &[[f64::INFINITY; 2]; 5]]
    {
        let fan: Vec<[u32; 3]> = (2..polygon.len() as u32).map(|i| [0, i - 1, i]).collect();
        assert_eq!(triangles(&flat(polygon)), fan, "{polygon:?}");
    }
    let mut raw = RawMesh::default();
    raw.push_polygon([0, 1, 2, 9]);
    raw.push_polygon([0, 1, 2, 1, 9]);
    let fans = raw.faces.clone();
    triangulate(&[[0.0; 3]; 3], &mut raw.faces, &raw.polygons).unwrap();
    assert_eq!(raw.faces, fans);
}

#[test]
fn many_polygons_between_triangles_each_get_their_own() {
    let arrow = flat(&[[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0], [0.5, 0.9]]);
    let mut raw = RawMesh::default();
    for _ in 0..3 * POLYGONS_PER_TASK {
        raw.push_polygon([0, 1, 2]);
        raw.push_polygon([0, 1, 2, 3]);
        raw.push_polygon([2, 3, 4, 0, 1]);
    }
    triangulate(&arrow, &mut raw.faces, &raw.polygons).unwrap();
    assert_eq!(raw.faces.len(), 3 * POLYGONS_PER_TASK * 6);
    for group in raw.faces.chunks_exact(6) {
        assert_eq!(group[..3], [[0, 1, 2], [1, 2, 3], [1, 3, 0]]);
        assert_eq!(group[3..], raw.faces[3..6]);
    }
    assert_ne!(raw.faces[3..6], [[2, 3, 4], [2, 4, 0], [2, 0, 1]]);
}

/// Ear clipping skips corners that lie on another side.
#[test]
fn polygons_that_touch_themselves_are_covered() {
    let first = [[2.0, 2.0], [2.0, 3.0], [0.0, 1.0], [-1.0, 3.0], [-3.0, 2.0], [-2.0, 1.0], [-2.0, 0.0]];
    let second = [[-2.0, -1.0], [-3.0, -2.0], [-1.0, -1.0], [-2.0, -3.0], [-1.0, -3.0], [-1.0, 2.0]];
    for (polygon, area) in [(&first[..], 5.5), (&second, 3.0)] {
        let mut clipped: Vec<u32> = Vec::new();
        Earcut::new().earcut(polygon.iter().copied(), &[], &mut clipped);
        assert!(clipped.len() < 3 * (polygon.len() - 2), "nothing was skipped");
        check(polygon, area);
    }
}

/// Polygons around the origin on a small lattice, where corners often lie on a line with their neighbours.
#[test]
fn lattice_polygons_are_covered() {
    let mut state: u64 = 1;
    let mut random = |n: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % n
    };
    for _ in 0..50_000 {
        let count = 5 + random(8);
        let mut points: Vec<[f64; 2]> = (0..count)
            .map(|_| [random(7) as f64 - 3.0, random(7) as f64 - 3.0])
            .filter(|p| *p != [0.0; 2])
            .collect();
        points.sort_by(|p, q| f64::total_cmp(&p[1].atan2(p[0]), &q[1].atan2(q[0])));
        let turn = |p: [f64; 2], q: [f64; 2]| p[0] * q[1] - p[1] * q[0];
        let side = |i: usize| turn(points[i], points[(i + 1) % points.len()]);
        // The origin sees every side, so the polygon does not cross itself.
        if points.len() < 5 || (0..points.len()).any(|i| side(i) <= 0.0) {
            continue;
        }
        check(&points, (0..points.len()).map(side).sum::<f64>() / 2.0);
    }
}

/// A polygon with these corners around the origin: (angle in turns, radius).
fn around(count: u32, radius: impl Fn(u32) -> f64) -> Vec<[f64; 2]> {
    (0..count)
        .map(|i| (radius(i), std::f64::consts::TAU * f64::from(i) / f64::from(count)))
        .map(|(radius, angle)| [radius * angle.cos(), radius * angle.sin()])
        .collect()
}

fn doubled_area(points: &[[f64; 2]]) -> f64 {
    let next = points.iter().cycle().skip(1);
    points.iter().zip(next).map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum()
}

/// Concave shapes with `n` corners: a star, a comb with its teeth up, to the right and askew, a spiral, a staircase.
fn concave_shapes(n: u32) -> Vec<Vec<[f64; 2]>> {
    let teeth = n / 2 - 1;
    let mut comb: Vec<[f64; 2]> = vec![[0.0, -1.0], [f64::from(2 * teeth), -1.0]];
    comb.extend((0..2 * teeth).rev().map(|i| [f64::from(i), f64::from(i % 2 * (7 + i % 5))]));
    let right = comb.iter().map(|[x, y]| [*y, -x]).collect();
    let askew = comb.iter().map(|[x, y]| [x - 3.0 * y, 2.0 * y + 0.3 * x]).collect();
    let outward = (0..n / 2).map(|i| (f64::from(i), 1.0));
    let back = (0..n - n / 2).rev().map(|i| (f64::from(i), 0.8));
    let spiral = outward.chain(back).map(|(i, inset)| {
        let angle = 40.0 * i / f64::from(n);
        let radius = inset + angle * 0.1;
        [radius * angle.cos(), radius * angle.sin()]
    });
    let mut stairs: Vec<[f64; 2]> =
        (0..n - 1).map(|i| [f64::from(i / 2), f64::from(i.div_ceil(2))]).collect();
    stairs.push([f64::from(n / 2), -1.0]);
    let steps = stairs.into_iter().rev().collect();
    vec![around(n, |i| f64::from(1 + i % 2)), comb, right, askew, spiral.collect(), steps]
}

#[test]
fn large_concave_polygons_are_covered() {
    for n in [1025, 1026, 3000] {
        for points in concave_shapes(n) {
            let area = doubled_area(&points) / 2.0;
            check_within(&points, area, 1e-14);
            let reversed: Vec<_> = points.into_iter().rev().collect();
            check_within(&reversed, -area, 1e-14);
        }
    }
}

#[test]
fn monotone_parts_cover_what_ear_clipping_covers() {
    let mut state: u64 = 7;
    let mut random = |n: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) % n
    };
    for round in 0..20_000 {
        let count = 5 + random(12) as u32;
        // Corners on a grid: many at one height, many on one line, whole rings of them on straight stretches.
        let points: Vec<[f64; 2]> = if round % 2 == 0 {
            {
                let radii: Vec<f64> = (0..count).map(|_| 1.0 + random(9) as f64).collect();
                around(count, |i| radii[i as usize])
            }
        } else {
            let stairs = (0..count).map(|i| [f64::from(i), random(3) as f64]);
            stairs.chain([[f64::from(count), 9.0], [0.0, 9.0]]).collect()
        };
        let mut triangles = Vec::new();
        monotone::triangulate(&points, &mut triangles);
        let areas = triangles.chunks_exact(3).map(|t| {
            let [a, b, c] = [t[0], t[1], t[2]].map(|corner| points[corner as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        });
        assert_eq!(triangles.len(), 3 * (points.len() - 2), "{points:?}");
        assert!(areas.clone().all(|area| area >= -1e-12), "{points:?} {triangles:?}");
        assert!((areas.sum::<f64>() - doubled_area(&points)).abs() < 1e-9, "{points:?} {triangles:?}");
    }
}

#[test]
fn polygons_with_too_many_corners_are_refused_when_they_cross_themselves() {
    let n = MOST_CORNERS_TO_CLIP as u32 + 4;
    let mut raw = RawMesh::default();
    raw.push_polygon([0, 1, 2]);
    raw.push_polygon(0..n);
    let fan = raw.faces.clone();
    let outcome =
        |points: &[[f64; 2]], faces: &mut Vec<[u32; 3]>| triangulate(&flat(points), faces, &raw.polygons);
    assert_eq!(outcome(&around(n, |_| 1.0), &mut raw.faces), Ok(()));
    assert_eq!(raw.faces, fan);
    assert_eq!(outcome(&around(n, |i| f64::from(1 + i % 2)), &mut raw.faces), Ok(()));
    assert_ne!(raw.faces, fan);
    let crossing: Vec<_> =
        (0..n).map(|i| [f64::from(i * 7919 % 10_007), f64::from(i * 104_729 % 9973)]).collect();
    assert_eq!(outcome(&crossing, &mut raw.faces), Err(Polygon { first: 1, corners: n }));
}

/// Arbitrary numbers instead of a polygon: neither a panic nor an endless loop.
#[test]
fn polygons_that_cross_themselves_stay_fans() {
    let mut state: u64 = 3;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) % 64) as f64
    };
    for _ in 0..50 {
        let points: Vec<[f64; 2]> = (0..1100).map(|_| [random(), random()]).collect();
        let mut raw = RawMesh::default();
        raw.push_polygon(0..1100);
        let fan = raw.faces.clone();
        assert_eq!(triangulate(&flat(&points), &mut raw.faces, &raw.polygons), Ok(()));
        assert_eq!(raw.faces, fan);
    }
}
