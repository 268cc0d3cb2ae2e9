//! Symmetric maps.

use super::Images;
use crate::cut::Opened;
use pompeiu_core::VertexId;
use pompeiu_surface::plane::{Vec2, dot, sub};
use std::cmp::Ordering;

/// For each vertex of a disk, its mirror image; `None` if the cut is not symmetric.
///
/// The copies of vertices are matched along the outline, which the mirror reverses.
pub(crate) fn partners(opened: &Opened, images: &Images) -> Option<Vec<u32>> {
    let mesh = opened.mesh();
    let original = |v: VertexId| opened.vertex_map()[v];
    let mut partners: Vec<u32> = mesh.vertex_ids().map(|v| images.of(original(v)).0).collect();
    let around: Vec<_> = mesh.boundary_loop(*mesh.boundary_loops().first()?).collect();
    let n = around.len();
    let side = |i: usize| images.side_of(mesh.face(around[i].face()).map(original));
    let opposite = |s: Ordering, t: Ordering| s != Ordering::Equal && s == t.reverse();
    // Corner i corresponds to corner k - i, the edge after it to the one before that.
    let fits = |k: usize| {
        (0..n).all(|i| {
            let (v, w) = (original(mesh.tail(around[i])), original(mesh.tail(around[(k + n - i) % n])));
            images.of(v) == w && opposite(side(i), side((k + 2 * n - i - 1) % n))
        })
    };
    let k = (0..n).find(|&k| fits(k))?;
    for i in 0..n {
        partners[mesh.tail(around[i]).index()] = mesh.tail(around[(k + n - i) % n]).0;
    }
    let is_involution = partners.iter().enumerate().all(|(v, &w)| partners[w as usize] as usize == v);
    is_involution.then_some(partners)
}

/// The mean of a map and its mirror image, rotated so that the axis is x = 0: mirror images have opposite x and the same y,
/// exactly.
pub(crate) fn symmetrized(uv: &[Vec2], partners: &[u32]) -> Vec<Vec2> {
    let count = uv.len() as f64;
    let sum = uv.iter().fold([0.0; 2], |sum, p| [sum[0] + p[0], sum[1] + p[1]]);
    let centre = sum.map(|x| x / count);
    // The reflection [[c, s], [s, -c]] that maps positions nearest to those of their mirror images.
    let (mut c, mut s) = (0.0, 0.0);
    for (p, &w) in uv.iter().zip(partners) {
        let (p, q) = (sub(*p, centre), sub(uv[w as usize], centre));
        c += p[0] * q[0] - p[1] * q[1];
        s += p[0] * q[1] + p[1] * q[0];
    }
    // The axis is at half the angle; it is rotated to the y axis.
    let angle = std::f64::consts::FRAC_PI_2 - 0.5 * libm::atan2(s, c);
    let (cosine, sine) = (libm::cos(angle), libm::sin(angle));
    let turned = |v: usize| {
        let [x, y] = sub(uv[v], centre);
        [cosine * x - sine * y, sine * x + cosine * y]
    };
    (0..uv.len())
        .map(|v| {
            let (p, q) = (turned(v), turned(partners[v] as usize));
            [0.5 * (p[0] - q[0]), 0.5 * (p[1] + q[1])]
        })
        .collect()
}

/// The mean of a map and its mirror image about an axis, given by a point and its unit direction.
pub(crate) fn symmetrized_about(uv: &[Vec2], partners: &[u32], [point, direction]: [Vec2; 2]) -> Vec<Vec2> {
    let normal = [-direction[1], direction[0]];
    let mean = |(v, p): (usize, &Vec2)| {
        let q = uv[partners[v] as usize];
        let height = |p: Vec2| dot(sub(p, point), normal);
        // Both differ along the normal only by the sign.
        let (across, middle) = (0.5 * (height(*p) - height(q)), [0, 1].map(|k| 0.5 * (p[k] + q[k])));
        let off = height(middle);
        [0, 1].map(|k| middle[k] - off * normal[k] + across * normal[k])
    };
    uv.iter().enumerate().map(mean).collect()
}
