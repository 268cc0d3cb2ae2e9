//! Bounds on scaled Jacobians over whole cells: below the values at points, computed by other means, and close to the least of them.

use super::{Random, UNIT};
use glam::DVec3;
use pompeiu_volume::{
    SCALED_JACOBIAN_GAP, place_of_64, scaled_jacobian, scaled_jacobian_bezier, scaled_jacobian_bound,
    scaled_jacobian_bound_bezier,
};

/// Sample points along each axis of a cell, less one.
const N: usize = 12;

/// The scaled Jacobian of a map of the unit cube, by central differences of fourth order: exact for cubics, but for rounding.
fn scaled(map: &dyn Fn([f64; 3]) -> DVec3, place: [f64; 3]) -> f64 {
    const H: f64 = 1e-2;
    let [a, b, c] = [0, 1, 2].map(|axis| {
        let at = |step: f64| {
            let mut place = place;
            place[axis] += step * H;
            map(place)
        };
        ((at(1.0) - at(-1.0)) * 8.0 - (at(2.0) - at(-2.0))) / (12.0 * H)
    });
    a.dot(b.cross(c)) / (a.length() * b.length() * c.length())
}

fn least(map: &dyn Fn([f64; 3]) -> DVec3) -> f64 {
    let places = (0..=N).flat_map(|i| (0..=N).flat_map(move |j| (0..=N).map(move |k| [i, j, k])));
    places.map(|place| scaled(map, place.map(|i| i as f64 / N as f64))).fold(f64::INFINITY, f64::min)
}

fn trilinear(corners: &[DVec3; 8], place: [f64; 3]) -> DVec3 {
    let factor = |x: f64, side: f64| if side > 0.5 { x } else { 1.0 - x };
    let weight = |p: DVec3| (0..3).map(|k| factor(place[k], p[k])).product::<f64>();
    corners.iter().zip(UNIT).map(|(p, unit)| *p * weight(unit)).sum()
}

fn tricubic(points: &[DVec3; 64], place: [f64; 3]) -> DVec3 {
    let basis = place.map(|t| {
        let s = 1.0 - t;
        [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t]
    });
    let weight = |k: usize| {
        let [i, j, l] = place_of_64(k);
        basis[0][i] * basis[1][j] * basis[2][l]
    };
    points.iter().enumerate().map(|(k, p)| *p * weight(k)).sum()
}

#[test]
fn bounds_of_trilinear_cells_are_proven_and_close() {
    let mut random = Random(21);
    let mut decided = 0;
    for trial in 0..200 {
        let size = 0.05 + 0.03 * f64::from(trial % 10);
        let stretch = DVec3::new(1.0, 0.2 + f64::from(trial % 7), 30.0);
        let mut shift = || size * (random.next() - 0.5) * 2.0;
        let corners = UNIT.map(|p| (p + DVec3::new(shift(), shift(), shift())) * stretch);
        let least = least(&|place| trilinear(&corners, place));
        let at_points = scaled_jacobian(&corners);
        let bound = scaled_jacobian_bound(&corners, at_points);
        assert!(bound <= least + 1e-9, "{bound} {least}");
        if least > 0.05 {
            decided += 1;
            // Samples are a little above the least value.
            assert!(bound > least.min(at_points) - SCALED_JACOBIAN_GAP - 0.02, "{bound} {least}");
        }
        // A value of another cell ends the search early, but not wrongly.
        assert!(scaled_jacobian_bound(&corners, -0.5) <= least + 1e-9);
    }
    assert!(decided > 80, "{decided}");
    let skew = UNIT.map(|p| DVec3::new(2.0 * p.x + p.z, 3.0 * p.y, p.z));
    let bound = scaled_jacobian_bound(&skew, 1.0);
    assert!(bound <= 0.5_f64.sqrt() && bound > 0.5_f64.sqrt() - 1e-12, "{bound}");
    assert_eq!(scaled_jacobian_bound(&UNIT.map(|p| p * DVec3::new(1.0, 1.0, -1.0)), -1.0), -1.0);
    assert_eq!(scaled_jacobian_bound(&UNIT.map(|p| p * f64::NAN), 1.0), -1.0);
}

#[test]
fn values_between_the_points_are_found() {
    let mut random = Random(23);
    let mut lower = 0;
    for _ in 0..4000 {
        let mut shift = || 0.9 * (random.next() - 0.5);
        let corners = UNIT.map(|p| p + DVec3::new(shift(), shift(), shift()));
        let at_points = scaled_jacobian(&corners);
        if at_points > 0.0 && scaled_jacobian_bound(&corners, at_points) < at_points - 0.01 {
            lower += 1;
            assert!(least(&|place| trilinear(&corners, place)) < at_points);
        }
    }
    assert!(lower > 3, "{lower}");
}

#[test]
fn bounds_of_tricubic_cells_are_proven_and_close() {
    let mut random = Random(22);
    let mut decided = 0;
    for trial in 0..36 {
        let size = 0.02 + 0.01 * f64::from(trial % 6);
        let stretch = DVec3::new(1.0, 0.2 + f64::from(trial % 7), 30.0);
        let points: [DVec3; 64] = std::array::from_fn(|k| {
            let mut shift = || size * (random.next() - 0.5) * 2.0;
            let place = place_of_64(k).map(|i| i as f64 / 3.0);
            (DVec3::from_array(place) + DVec3::new(shift(), shift(), shift())) * stretch
        });
        let least = least(&|place| tricubic(&points, place));
        let at_points = scaled_jacobian_bezier(&points);
        let bound = scaled_jacobian_bound_bezier(&points, at_points);
        assert!(bound <= least + 1e-9, "{bound} {least}");
        if least > 0.05 {
            decided += 1;
            assert!(bound > least.min(at_points) - SCALED_JACOBIAN_GAP - 0.03, "{bound} {least}");
        }
    }
    assert!(decided > 8, "{decided}");
}
