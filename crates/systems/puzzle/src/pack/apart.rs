//! Whether paths keep their distances.

use pompeiu_planar::{Outline, Point, bounds, from_segment, segments_meet};
use rayon::prelude::*;

/// The pairs of paths that are nearer than a distance, with their distance, which is 0 where they meet or one lies in the other.
pub(super) fn too_near(paths: &[Vec<Point>], least: f64) -> Vec<(usize, usize, f64)> {
    let boxes: Vec<[Point; 2]> = paths.iter().map(|path| bounds(path)).collect();
    let longest = boxes.iter().map(|[low, high]| high[1] - low[1]).fold(0.0, f64::max);
    // By the lower end of boxes: those that reach into another one are not far before it.
    let mut order: Vec<usize> = (0..paths.len()).collect();
    order.sort_by(|i, j| boxes[*i][0][1].total_cmp(&boxes[*j][0][1]).then(i.cmp(j)));
    let found: Vec<Vec<(usize, usize, f64)>> = (0..order.len())
        .into_par_iter()
        .map(|at| {
            let i = order[at];
            let from = boxes[i][0][1] - longest - least;
            let before = order[..at].iter().rev().take_while(|j| boxes[**j][0][1] >= from);
            before
                .filter(|j| is_near(boxes[i], boxes[**j], least))
                .filter_map(|j| {
                    let distance = distance([&paths[i], &paths[*j]], [boxes[i], boxes[*j]], least);
                    (distance < least).then_some((i.min(*j), i.max(*j), distance))
                })
                .collect()
        })
        .collect();
    found.into_iter().flatten().collect()
}

fn is_near([a, b]: [Point; 2], [c, d]: [Point; 2], within: f64) -> bool {
    (0..2).all(|k| a[k] <= d[k] + within && c[k] <= b[k] + within)
}

/// The distance between two paths if it is less than one, else anything that is not; 0 if they meet, or one lies in the other.
fn distance(paths: [&[Point]; 2], boxes: [[Point; 2]; 2], least: f64) -> f64 {
    let sides = |k: usize| -> Vec<[Point; 2]> {
        let path = paths[k];
        let all = path.iter().zip(path.iter().cycle().skip(1)).map(|(a, b)| [*a, *b]);
        all.filter(|side| is_near(bounds(side), boxes[1 - k], least)).collect()
    };
    let [first, second] = [sides(0), sides(1)];
    let mut found = f64::INFINITY;
    for s in &first {
        let around = bounds(s);
        for t in &second {
            if is_near(around, bounds(t), least) {
                if segments_meet(*s, *t) {
                    return 0.0;
                }
                let ends = s.iter().map(|p| (p, t)).chain(t.iter().map(|p| (p, s)));
                let distance = |(p, side): (&Point, &[Point; 2])| {
                    let [x, y] = from_segment(*p, *side);
                    libm::hypot(x, y)
                };
                found = ends.map(distance).fold(found, f64::min);
            }
        }
    }
    // What lies in another one has its box in that one's box: outlines, which are tested for crossings, are made for few pairs.
    let is_in = |i: usize, j: usize| {
        let ([a, b], [c, d]) = (boxes[i], boxes[j]);
        (0..2).all(|k| c[k] <= a[k] && b[k] <= d[k])
            && Outline::new(paths[j].to_vec()).is_ok_and(|outline| outline.contains(paths[i][0]))
    };
    if found >= least && (is_in(0, 1) || is_in(1, 0)) {
        return 0.0;
    }
    found
}
