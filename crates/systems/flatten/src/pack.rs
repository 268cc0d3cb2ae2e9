//! Packing charts into a square.

use pompeiu_surface::plane::{Rotation, Vec2, rotate};

/// Distance between charts, relative to the side of the square.
const MARGIN: f64 = 0.01;

/// Rotations tried for a chart, over a quarter turn.
const ANGLES: usize = 18;

/// Shelf widths tried.
const WIDTHS: usize = 40;

/// The least and greatest coordinates.
pub(crate) fn bounds<const N: usize>(points: &[[f64; N]]) -> [[f64; N]; 2] {
    let mut bounds = [[f64::INFINITY; N], [f64::NEG_INFINITY; N]];
    for p in points {
        for k in 0..N {
            bounds[0][k] = bounds[0][k].min(p[k]);
            bounds[1][k] = bounds[1][k].max(p[k]);
        }
    }
    bounds
}

/// Rotates a chart so that its bounding box is small, and wider than high.
pub(crate) fn turn(points: &mut [Vec2]) {
    let turned = |rotation: Rotation, points: &[Vec2]| -> Vec<Vec2> {
        points.iter().map(|&p| rotate(rotation, p)).collect()
    };
    let rotation = |k: usize| -> Rotation {
        let angle = std::f64::consts::FRAC_PI_2 * k as f64 / ANGLES as f64;
        [libm::cos(angle), libm::sin(angle)]
    };
    let size = |points: &[Vec2]| {
        let [lower, upper] = bounds(points);
        [upper[0] - lower[0], upper[1] - lower[1]]
    };
    let area = |k: &usize| {
        let [width, height] = size(&turned(rotation(*k), points));
        width * height
    };
    let areas: Vec<f64> = (0..ANGLES).map(|k| area(&k)).collect();
    let best = (0..ANGLES).fold(0, |best, k| if areas[k] < areas[best] { k } else { best });
    let result = turned(rotation(best), points);
    let [width, height] = size(&result);
    for (p, q) in points.iter_mut().zip(result) {
        // A quarter turn is exact.
        *p = if height > width { [q[1], -q[0]] } else { q };
    }
}

/// Moves charts, and scales them by a common factor, so that their bounding boxes lie in the unit square without touching.
///
/// # Definition
/// Shelf packing by decreasing height; of several shelf widths, the one with the smallest square is used.
pub(crate) fn pack(charts: &mut [Vec<Vec2>]) {
    let boxes: Vec<[Vec2; 2]> = charts.iter().map(|chart| bounds(chart)).collect();
    let sizes: Vec<Vec2> =
        boxes.iter().map(|[lower, upper]| [upper[0] - lower[0], upper[1] - lower[1]]).collect();
    let mut order: Vec<usize> = (0..charts.len()).collect();
    order.sort_by(|&a, &b| sizes[b][1].total_cmp(&sizes[a][1]));
    let widest = sizes.iter().map(|size| size[0]).fold(0.0, f64::max);
    let area: f64 = sizes.iter().map(|size| size[0] * size[1]).sum();
    let margin = MARGIN * area.sqrt();
    let shelves = |width: f64| {
        let (mut at, mut height, mut used) = ([margin, margin], 0.0_f64, 0.0_f64);
        let mut places = vec![[0.0; 2]; sizes.len()];
        for &i in &order {
            if at[0] > margin && at[0] + sizes[i][0] + margin > width {
                at = [margin, at[1] + height + margin];
                height = 0.0;
            }
            places[i] = at;
            at[0] += sizes[i][0] + margin;
            height = height.max(sizes[i][1]);
            used = used.max(at[0]);
        }
        (used.max(at[1] + height + margin), places)
    };
    let mut best: Option<(f64, Vec<Vec2>)> = None;
    for k in 0..=WIDTHS {
        let width = (widest + 2.0 * margin) * (1.0 + 0.1 * k as f64) + 0.05 * k as f64 * area.sqrt();
        let found = shelves(width);
        if best.as_ref().is_none_or(|(side, _)| found.0 < *side) {
            best = Some(found);
        }
    }
    let Some((side, places)) = best else { return };
    for ((chart, place), [lower, _]) in charts.iter_mut().zip(places).zip(boxes) {
        for p in chart.iter_mut() {
            *p = [0, 1].map(|k| ((p[k] - lower[k]) + place[k]) / side);
        }
    }
}
