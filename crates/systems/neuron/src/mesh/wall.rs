//! The wall around a node: a smooth union of the tubes that meet there.

use crate::RoundCone;
use glam::DVec3;

/// The middle of a face on the wall, or of an edge, whose vertices are listed twice.
#[derive(Clone, Copy)]
pub(super) struct Middle {
    pub(super) vertices: [u32; 4],
    /// The radius of the cone next to it.
    pub(super) radius: f64,
}

/// The smooth union of groups of cones.
pub(super) struct Wall {
    /// The cones of each tube, and balls as cones without length.
    pub(super) groups: Vec<Vec<RoundCone>>,
    /// Width of the blend, in micrometres.
    pub(super) blend: f64,
}

impl Wall {
    /// `−k log Σ exp(−f / k)` over the groups, `f` the distance from the nearest cone of each, and its gradient.
    ///
    /// It is below the least distance by at most `k log n`, so the wall expands by at most that.
    pub(super) fn distance(&self, p: DVec3) -> (f64, DVec3) {
        let mut nearest = f64::INFINITY;
        let mut found = Vec::with_capacity(self.groups.len());
        for group in &self.groups {
            let mut best = (f64::INFINITY, DVec3::ZERO);
            for cone in group {
                let (distance, t) = cone.distance(p);
                if distance < best.0 {
                    best = (distance, cone.ends[0].lerp(cone.ends[1], t));
                }
            }
            nearest = nearest.min(best.0);
            found.push(best);
        }
        let (mut sum, mut gradient) = (0.0, DVec3::ZERO);
        for (distance, centre) in found {
            if distance - nearest > self.range() {
                continue;
            }
            let weight = libm::exp((nearest - distance) / self.blend);
            sum += weight;
            gradient += weight * (p - centre).normalize_or_zero();
        }
        (nearest - self.blend * libm::log(sum), gradient / sum)
    }

    /// Distance beyond the nearest group from which on another one does not change the wall.
    pub(super) fn range(&self) -> f64 {
        FAR * self.blend
    }

    /// Adds the penalty for vertices off the wall to an energy, `weight` times the squared distance over `scale`, and its
    /// derivatives to the gradient with respect to all vertices.
    pub(super) fn add_cost(
        &self,
        (vertices, weight): (&[u32], f64),
        scale: f64,
        positions: &[DVec3],
        energy: &mut f64,
        gradient: &mut [DVec3],
    ) {
        for &v in vertices {
            let (distance, slope) = self.distance(positions[v as usize]);
            let relative = distance / scale;
            *energy += weight * relative * relative;
            gradient[v as usize] += slope * (2.0 * weight * relative / scale);
        }
    }

    /// Adds the penalty for middles of edges and faces off the wall, so that vertices move into concave corners: for each one `weight`
    /// times the squared distance over its radius.
    pub(super) fn add_middles(
        &self,
        middles: &[Middle],
        weight: f64,
        positions: &[DVec3],
        energy: &mut f64,
        gradient: &mut [DVec3],
    ) {
        for Middle { vertices: [a, b, c, d], radius } in middles {
            let corners = [a, b, c, d].map(|v| *v as usize);
            let (distance, slope) = self.distance(corners.iter().map(|v| positions[*v]).sum::<DVec3>() / 4.0);
            let relative = distance / radius;
            *energy += weight * relative * relative;
            let slope = slope * (0.5 * weight * relative / radius);
            for v in corners {
                gradient[v] += slope;
            }
        }
    }

    /// The radius of the cone next to a point.
    pub(super) fn radius(&self, p: DVec3) -> f64 {
        let mut best = (f64::INFINITY, 0.0);
        for cone in self.groups.iter().flatten() {
            let (distance, t) = cone.distance(p);
            if distance < best.0 {
                best = (distance, cone.radii[0] + (cone.radii[1] - cone.radii[0]) * t);
            }
        }
        best.1
    }

    /// Where a ray from inside intersects the wall.
    pub(super) fn leave(&self, from: DVec3, direction: DVec3, scale: f64) -> DVec3 {
        let inside = |t: f64| self.distance(from + direction * t).0 < 0.0;
        let mut high = 0.1 * scale;
        let mut low = 0.0;
        for _ in 0..MOST_STEPS {
            if !inside(high) {
                break;
            }
            low = high;
            high += 0.1 * scale;
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            if inside(middle) {
                low = middle;
            } else {
                high = middle;
            }
        }
        from + direction * (0.5 * (low + high))
    }

    /// A point projected onto the wall along the gradient.
    pub(super) fn project(&self, mut p: DVec3) -> DVec3 {
        for _ in 0..PROJECTIONS {
            let (distance, gradient) = self.distance(p);
            let slope = gradient.length_squared();
            if slope < 1e-6 {
                break;
            }
            p -= gradient * (distance / slope);
        }
        p
    }
}

/// From this distance beyond the nearest group on, in widths of the blend, another one adds less than the rounding of the sum.
const FAR: f64 = 40.0;
/// Largest number of steps, of a tenth of the radius, along a ray.
const MOST_STEPS: usize = 200;
/// Halvings of the step that crosses the wall.
const HALVINGS: usize = 40;
/// Newton steps of a projection.
const PROJECTIONS: usize = 8;
