//! Shapes drawn as pixels beside the shapes themselves: at several sizes and angles, and ranked at one size and at twice that.

use pompeiu_complexity::generate::{self, PointOrder};
use pompeiu_complexity::{Measure, MeasureOptions, Measures, spearman};
use pompeiu_planar::picture::Picture;
use pompeiu_planar::silhouette::{Foreground, SilhouetteOptions, silhouette};
use pompeiu_planar::{Outline, Point, fill, first_crossing};
use std::f64::consts::TAU;

/// The outline turned, and scaled to so many pixels across but for a margin.
fn placed(outline: &Outline, pixels: usize, degrees: f64) -> Outline {
    let (s, c) = degrees.to_radians().sin_cos();
    let turned = outline.map(|[x, y]| [c * x - s * y, s * x + c * y]).unwrap();
    let [low, high] = turned.bounds();
    let scale = (pixels as f64 - 8.3) / (high[0] - low[0]).max(high[1] - low[1]);
    turned.map(|[x, y]| [4.12 + scale * (x - low[0]), 4.17 + scale * (y - low[1])]).unwrap()
}

/// The outline as it is read from a picture of so many pixels across: of two levels, or anti-aliased.
fn drawn(outline: &Outline, pixels: usize, degrees: f64, is_smooth: bool) -> Outline {
    let outline = placed(outline, pixels, degrees);
    let mut levels = fill([&outline], pixels, pixels);
    if !is_smooth {
        for level in &mut levels {
            *level = f32::from(u8::from(*level > 0.5));
        }
    }
    let picture = Picture::new(pixels, pixels, levels).unwrap();
    let options = SilhouetteOptions { foreground: Foreground::Light, ..SilhouetteOptions::default() };
    silhouette(&picture, &options).unwrap().outer
}

fn of(outline: &Outline) -> Measures {
    Measures::of(outline, &MeasureOptions::default()).unwrap()
}

fn polar(corners: usize, radius: impl Fn(f64) -> f64) -> Outline {
    let at = |i: usize| {
        let angle = TAU * i as f64 / corners as f64;
        [radius(angle) * angle.cos(), radius(angle) * angle.sin()]
    };
    Outline::new((0..corners).map(at).collect()).unwrap()
}

fn star(arms: usize, inner: f64) -> Outline {
    let at = |i: usize| -> Point {
        let angle = TAU * i as f64 / (2 * arms) as f64;
        let radius = if i.is_multiple_of(2) { 1.0 } else { inner };
        [radius * angle.cos(), radius * angle.sin()]
    };
    Outline::new((0..2 * arms).map(at).collect()).unwrap()
}

#[test]
fn pixels_do_not_change_measures() {
    let shapes = [
        ("circle", polar(4000, |_| 1.0)),
        ("ellipse", polar(4000, |_| 1.0).map(|[x, y]| [x, 0.4 * y]).unwrap()),
        ("square", polar(4, |_| 1.0)),
        ("star", star(5, 0.6)),
        ("clover", polar(4000, |a| 1.0 + 0.5 * (4.0 * a).cos())),
    ];
    for (name, shape) in &shapes {
        let expected = of(shape);
        for (pixels, degrees) in [(128, 22.5), (128, 45.0), (200, 8.0), (256, 0.0), (256, 37.0)] {
            for is_smooth in [false, true] {
                let found = of(&drawn(shape, pixels, degrees, is_smooth));
                let place = format!("{name}, {pixels} pixels, {degrees}°, smooth {is_smooth}");
                for measure in ["compactness", "total-curvature", "hull"].map(|n| Measure::named(n).unwrap())
                {
                    let [a, b] = [&expected, &found].map(|m| measure.value(m));
                    assert!((a / b - 1.0).abs() < 0.02, "{place}: {} {a} {b}", measure.name);
                }
                // The dents of the clover are so shallow that one of them can have a second peak.
                let [a, b] = [&expected, &found].map(|m| m.curvature.peaks);
                assert!(a.abs_diff(b) <= usize::from(*name == "clover"), "{place}: {a} {b} peaks");
            }
        }
    }
}

#[test]
fn corners_in_pictures_of_two_levels_are_where_sides_meet() {
    let shapes = [
        ("pentagon", polar(5, |_| 1.0)),
        ("hexagon", polar(6, |_| 1.0)),
        ("octagon", polar(8, |_| 1.0)),
        ("star of 5", star(5, 0.42)),
        ("star of 8", star(8, 0.6)),
    ];
    for (name, shape) in &shapes {
        let expected = of(shape);
        for (pixels, degrees) in
            [128, 192].into_iter().flat_map(|n| [5.0, 10.0, 22.5, 30.0, 37.0].map(|a| (n, a)))
        {
            let found = of(&drawn(shape, pixels, degrees, false));
            for measure in ["compactness", "total-curvature"].map(|n| Measure::named(n).unwrap()) {
                let [a, b] = [&expected, &found].map(|m| measure.value(m));
                let place = format!("{name}, {pixels} pixels, {degrees}°");
                assert!((a / b - 1.0).abs() < 0.02, "{place}: {} {a} {b}", measure.name);
            }
        }
    }
}

#[test]
fn bends_of_curves_are_not_taken_for_corners() {
    for points in [5, 8] {
        let simple = (1..100).filter_map(|seed| generate::polyline(points, seed, PointOrder::Angle).ok());
        let shape = simple.into_iter().find(|outline| first_crossing(outline).is_none()).unwrap();
        let expected = of(&shape).curvature.peaks;
        for (pixels, degrees) in
            [128, 192].into_iter().flat_map(|n| [0.0, 5.0, 10.0, 22.5, 30.0, 37.0, 45.0].map(|a| (n, a)))
        {
            let found = of(&drawn(&shape, pixels, degrees, false)).curvature.peaks;
            assert_eq!(
                found, expected,
                "peaks of the curve through {points} points, {pixels} pixels, {degrees}°"
            );
        }
    }
}

/// A rectangle whose corners are arcs.
fn rounded([width, height]: Point, radius: f64) -> Outline {
    let corners = [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]];
    let at = |i: usize| {
        let [x, y] = corners[i / 33];
        let angle = TAU / 4.0 * ((i / 33) as f64 + (i % 33) as f64 / 32.0);
        [x * (width - radius) + radius * angle.cos(), y * (height - radius) + radius * angle.sin()]
    };
    Outline::new((0..132).map(at).collect()).unwrap()
}

#[test]
fn convex_shapes_do_not_differ_in_total_curvature() {
    let shapes = [
        ("square with round corners", rounded([1.0, 1.0], 0.3)),
        ("square with small arcs", rounded([1.0, 1.0], 0.1)),
        ("stadium", rounded([1.0, 0.25], 0.25)),
        ("dodecagon", polar(12, |_| 1.0)),
    ];
    for (name, shape) in &shapes {
        for (pixels, degrees) in [(256, 0.0), (256, 30.0), (256, 45.0), (400, 0.0)] {
            for is_smooth in [false, true] {
                let found = of(&drawn(shape, pixels, degrees, is_smooth)).curvature.total;
                let place = format!("{name}, {pixels} pixels, {degrees}°, smooth {is_smooth}");
                assert!((found - 1.0).abs() < 1e-9, "{place}: {found}");
            }
        }
    }
}

#[test]
fn anti_aliased_bars_and_teeth_keep_their_widths() {
    // Teeth with tops of 9 pixels between dents of 13, and a bar 15 pixels wide whose sides cross few levels.
    let gear = |i: usize| -> Point {
        let (share, radius) = [(0.05, 0.8), (0.15, 1.0), (0.45, 1.0), (0.55, 0.8)][i % 4];
        let angle = TAU * ((i / 4) as f64 + share) / 12.0;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let shapes = [
        ("gear", Outline::new((0..48).map(gear).collect()).unwrap()),
        ("bar", Outline::new(vec![[0.0, 0.0], [10.0, 0.0], [10.0, 1.0], [0.0, 1.0]]).unwrap()),
    ];
    for (name, shape) in &shapes {
        let expected = of(shape).global.compactness;
        for degrees in [0.0, 7.0, 22.5, 30.0, 45.0] {
            let found = of(&drawn(shape, 128, degrees, true)).global.compactness;
            assert!((found / expected - 1.0).abs() < 0.025, "{name}, {degrees}°: {found}, {expected}");
        }
    }
}

#[test]
fn anti_aliased_tips_and_waves_keep_their_heights() {
    let shapes = [
        ("star of 5", star(5, 0.25), 0.02),
        ("star of 7", star(7, 0.5), 0.02),
        ("star of 9", star(9, 0.65), 0.02),
        ("14 round teeth", polar(4000, |a| 1.0 + 0.1 * (2.0 * (14.0 * a).cos()).tanh()), 0.02),
        ("24 waves of 1.7 pixels", polar(4000, |a| 1.0 + 0.03 * (24.0 * a).cos()), 0.025),
    ];
    for (name, shape, most) in &shapes {
        let expected = of(shape);
        for degrees in [0.0, 11.0, 22.5, 37.0, 45.0] {
            let found = of(&drawn(shape, 128, degrees, true));
            let [a, b] = [&expected, &found].map(|m| m.global.compactness);
            assert!((b / a - 1.0).abs() < *most, "{name}, {degrees}°: {b}, {a}");
            assert_eq!(found.curvature.peaks, expected.curvature.peaks, "{name}, {degrees}°");
        }
    }
}

#[test]
fn anti_aliased_corners_some_pixels_apart_are_two() {
    // Teeth with tops of 5.6 pixels.
    let gear = |i: usize| -> Point {
        let (share, radius) = [(0.07, 0.85), (0.13, 1.0), (0.37, 1.0), (0.43, 0.85)][i % 4];
        let angle = TAU * ((i / 4) as f64 + share) / 16.0;
        [radius * angle.cos(), radius * angle.sin()]
    };
    let gear = Outline::new((0..64).map(gear).collect()).unwrap();
    let expected = of(&gear).global.compactness;
    for degrees in [0.0, 22.5, 45.0] {
        let found = of(&drawn(&gear, 128, degrees, true)).global.compactness;
        assert!((found / expected - 1.0).abs() < 0.03, "{degrees}°: {found}, {expected}");
    }
}

#[test]
fn ranks_are_the_same_at_twice_the_size() {
    let mut shapes = Vec::new();
    for seed in 0..8 {
        for points in [5, 9, 14] {
            shapes.push(generate::polyline(points, seed, PointOrder::Angle).unwrap());
        }
        let arms = 3 + seed as usize;
        let depth = 0.1 + 0.08 * seed as f64;
        shapes.push(star(arms, 0.85 - 0.06 * seed as f64));
        shapes.push(polar(4000, |a| 1.0 + depth * (arms as f64 * a).cos()));
        shapes.push(polar(arms, |_| 1.0).map(|[x, y]| [x, (0.4 + depth) * y]).unwrap());
    }
    let measured = |pixels| -> Vec<Measures> {
        shapes.iter().map(|shape| of(&drawn(shape, pixels, 17.0, false))).collect()
    };
    let [one, two] = [measured(160), measured(320)];
    for measure in ["total-curvature", "compactness", "boundary-25", "convexity"] {
        let measure = Measure::named(measure).unwrap();
        let [a, b] = [&one, &two].map(|all| all.iter().map(|m| measure.value(m)).collect::<Vec<_>>());
        let found = spearman(&a, &b);
        assert!(found >= 0.99, "{}: {found}", measure.name);
    }
}
