//! Turning the vertices of a core on a ball, so that each tube leaves from the middle of its quad.

use super::core::Core;
use glam::DVec3;

/// Rounds of averaging.
const ROUNDS: usize = 80;

/// Weight of the place in a regular quad around a tube, relative to that of the neighbours.
const OF_TUBE: f64 = 4.0;

/// Weight of the place in the core that was not turned.
const OF_CORE: f64 = 0.3;

/// Angle between a tube and the corners of its quad, over half the angle to the nearest other tube.
const SHARE: f64 = 0.8;

/// The same, over the angle between the axis of the tube and its rim on the ball: at least, and at most.
const RIM: [f64; 2] = [1.4, 8.0];

/// A tube as seen from the centre of the ball.
#[derive(Clone, Copy)]
pub(super) struct Ray {
    pub(super) direction: DVec3,
    /// Angle between its axis and its rim.
    pub(super) rim: f64,
    /// Its quad in the core.
    pub(super) quad: usize,
}

/// The vertices of a rotated core around the origin, on the same distances from it, turned so that the quads of tubes lie around them. The
/// others are evened out between them.
pub(super) fn turned(core: &Core, vertices: &[DVec3], rays: &[Ray]) -> Vec<DVec3> {
    let mut on_boundary = vec![false; vertices.len()];
    core.quads.iter().flatten().for_each(|&v| on_boundary[v] = true);
    let neighbours = neighbours(core, &on_boundary);
    let angles = rays.iter().map(|ray| reach(ray, rays, quad_angle(core, vertices, ray)));
    let angles: Vec<f64> = angles.collect();
    let anchors: Vec<DVec3> = vertices.iter().map(|p| p.normalize_or_zero()).collect();
    let mut units = anchors.clone();
    for _ in 0..ROUNDS {
        let mut sums: Vec<DVec3> = (0..units.len())
            .map(|v| {
                let around = &neighbours[v];
                let mean = around.iter().map(|&n| units[n]).sum::<DVec3>() / around.len().max(1) as f64;
                mean + anchors[v] * OF_CORE
            })
            .collect();
        for (ray, angle) in rays.iter().zip(&angles) {
            let quad = core.quads[ray.quad];
            let side = side_of(&quad.map(|v| units[v]), ray.direction);
            let across = ray.direction.cross(side);
            for (k, v) in quad.into_iter().enumerate() {
                let turn = std::f64::consts::FRAC_PI_4 * (2 * k + 1) as f64;
                let out = side * libm::cos(turn) + across * libm::sin(turn);
                sums[v] += (ray.direction * libm::cos(*angle) + out * libm::sin(*angle)) * OF_TUBE;
            }
        }
        for (v, sum) in sums.into_iter().enumerate().filter(|(v, _)| on_boundary[*v]) {
            units[v] = sum.normalize_or(units[v]);
        }
    }
    let mut found: Vec<DVec3> = vertices.iter().zip(&units).map(|(p, unit)| *unit * p.length()).collect();
    // Vertices inside of the core follow those on its boundary.
    for _ in 0..ROUNDS {
        let before = found.clone();
        for v in (0..found.len()).filter(|v| !on_boundary[*v]) {
            let around = &neighbours[v];
            found[v] = around.iter().map(|&n| before[n]).sum::<DVec3>() / around.len().max(1) as f64;
        }
    }
    found
}

/// The vertices that share an edge; for those on the boundary only others on it.
fn neighbours(core: &Core, on_boundary: &[bool]) -> Vec<Vec<usize>> {
    let mut found = vec![Vec::new(); on_boundary.len()];
    for block in &core.blocks {
        for face in pompeiu_volume::FACES {
            for k in 0..4 {
                let (a, b) = (block[face[k]], block[face[(k + 1) % 4]]);
                for (a, b) in [(a, b), (b, a)] {
                    if !on_boundary[a] || on_boundary[b] {
                        found[a].push(b);
                    }
                }
            }
        }
    }
    for list in &mut found {
        list.sort_unstable();
        list.dedup();
    }
    found
}

/// The mean angle between the middle of a tube's quad and its corners.
fn quad_angle(core: &Core, vertices: &[DVec3], ray: &Ray) -> f64 {
    let corners = core.quads[ray.quad].map(|v| vertices[v].normalize_or_zero());
    let middle = corners.iter().copied().sum::<DVec3>().normalize_or_zero();
    corners.iter().map(|c| libm::acos(c.dot(middle).clamp(-1.0, 1.0))).sum::<f64>() / 4.0
}

/// The angle between a tube and the corners of its quad.
fn reach(ray: &Ray, rays: &[Ray], usual: f64) -> f64 {
    let others = rays.iter().filter(|other| other.quad != ray.quad);
    // The space between two tubes is shared in the ratio of their angles.
    let room = others.map(|other| {
        let between = libm::acos(ray.direction.dot(other.direction).clamp(-1.0, 1.0));
        between * ray.rim / (ray.rim + other.rim)
    });
    let room = SHARE * room.fold(f64::INFINITY, f64::min);
    usual.min(room).min(RIM[1] * ray.rim).max(RIM[0] * ray.rim)
}

/// The direction in a section whose corners at 45°, 135°, … are closest to those of a quad.
pub(super) fn side_of(quad: &[DVec3; 4], axis: DVec3) -> DVec3 {
    let (e1, e2) = axis.any_orthonormal_pair();
    // The orientation of the pair relative to the axis.
    let e2 = if e1.cross(e2).dot(axis) < 0.0 { -e2 } else { e2 };
    let middle = quad.iter().copied().sum::<DVec3>() / 4.0;
    let (mut sine, mut cosine) = (0.0, 0.0);
    for (k, p) in quad.iter().enumerate() {
        let (x, y) = ((*p - middle).dot(e1), (*p - middle).dot(e2));
        let angle = libm::atan2(y, x) - std::f64::consts::FRAC_PI_4 * (2 * k + 1) as f64;
        sine += libm::sin(angle);
        cosine += libm::cos(angle);
    }
    let angle = libm::atan2(sine, cosine);
    (e1 * libm::cos(angle) + e2 * libm::sin(angle)).normalize()
}
