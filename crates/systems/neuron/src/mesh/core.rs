//! Core complexes: small hexahedral complexes in the middle of a node, to whose boundary tubes attach.

use glam::DVec3;
use pompeiu_volume::FACES;
use std::collections::HashMap;

/// Cells around the origin, with half-extent about 1.
pub(super) struct Core {
    pub(super) vertices: Vec<DVec3>,
    pub(super) blocks: Vec<[usize; 8]>,
    /// Its boundary quads, counter-clockwise seen from outside.
    pub(super) quads: Vec<[usize; 4]>,
    /// Where it is placed already: for each vertex the point from which the wall lies behind it.
    pub(super) axis: Option<Vec<DVec3>>,
}

impl Core {
    fn new(vertices: Vec<DVec3>, blocks: Vec<[usize; 8]>) -> Self {
        let mut seen: HashMap<[usize; 4], usize> = HashMap::new();
        let mut all = Vec::new();
        for block in &blocks {
            for face in FACES {
                let quad = face.map(|k| block[k]);
                let mut key = quad;
                key.sort_unstable();
                *seen.entry(key).or_default() += 1;
                all.push((key, quad));
            }
        }
        let quads = all.into_iter().filter(|(key, _)| seen[key] == 1).map(|(_, quad)| quad).collect();
        Self { vertices, blocks, quads, axis: None }
    }

    /// Cells with vertices where they shall be, each with the point of an axis from which the wall lies behind it.
    pub(super) fn placed(vertices: Vec<DVec3>, axis: Vec<DVec3>, blocks: Vec<[usize; 8]>) -> Self {
        Self { axis: Some(axis), ..Self::new(vertices, blocks) }
    }

    /// `n` × `n` × `n` cubes, rounded towards a ball if there are several.
    fn cube(n: usize) -> Self {
        let at = |i: usize| 2.0 * i as f64 / n as f64 - 1.0;
        let index = |i: usize, j: usize, k: usize| i + (n + 1) * (j + (n + 1) * k);
        let mut vertices = Vec::new();
        let mut blocks = Vec::new();
        for k in 0..=n {
            for j in 0..=n {
                for i in 0..=n {
                    let p = DVec3::new(at(i), at(j), at(k));
                    let greatest = p.abs().max_element();
                    let length = p.length();
                    // Boundary vertices lie halfway to the ball through the centres of the sides.
                    let round = if length > 0.0 { p * (greatest / length) * 1.2 } else { p };
                    vertices.push(if n == 1 { p } else { p.lerp(round, 0.6) });
                    if i < n && j < n && k < n {
                        let layer = |k| {
                            [index(i, j, k), index(i + 1, j, k), index(i + 1, j + 1, k), index(i, j + 1, k)]
                        };
                        let (a, b) = (layer(k), layer(k + 1));
                        blocks.push([a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]]);
                    }
                }
            }
        }
        Self::new(vertices, blocks)
    }

    /// `v` quads around an axis, one layer high.
    fn prism(v: usize) -> Self {
        let mut vertices = Vec::new();
        let mut blocks = Vec::new();
        for height in [-0.8, 0.8] {
            vertices.push(DVec3::new(0.0, 0.0, height));
            for k in 0..2 * v {
                let angle = std::f64::consts::PI * k as f64 / v as f64;
                vertices.push(DVec3::new(1.3 * libm::cos(angle), 1.3 * libm::sin(angle), height));
            }
        }
        let (top, rim) = (2 * v + 1, |k: usize| 1 + k % (2 * v));
        for q in 0..v {
            let bottom = [0, rim(2 * q), rim(2 * q + 1), rim(2 * q + 2)];
            let [a, b, c, d] = bottom;
            blocks.push([a, b, c, d, a + top, b + top, c + top, d + top]);
        }
        Self::new(vertices, blocks)
    }

    pub(super) fn centre(&self, quad: usize) -> DVec3 {
        self.quads[quad].iter().map(|&v| self.vertices[v]).sum::<DVec3>() / 4.0
    }
}

/// The complexes for a number of tubes, simplest first.
pub(super) fn library(arms: usize) -> Vec<Core> {
    let mut cores = Vec::new();
    if arms <= 6 {
        cores.push(Core::cube(1));
    }
    if (3..=8).contains(&arms) {
        cores.extend([3, 4].map(Core::prism));
    }
    if arms > 3 {
        cores.push(Core::cube(2));
    }
    if arms > 8 {
        cores.push(Core::cube(3));
    }
    if arms > 20 {
        cores.push(Core::cube(4));
    }
    cores
}

/// The complexes for a soma with a number of tubes, simplest first: with fewer quads, faces of the wall would be far inside of the ball.
pub(super) fn library_of_balls(arms: usize) -> Vec<Core> {
    let most = if arms > 20 { 4 } else { 3 };
    (2..=most).map(Core::cube).collect()
}
