//! The wall around a node: a smooth union of the tubes that meet there.

use super::least_shift::{Half, facing_of, least_shift};
use crate::RoundCone;
use crate::cone::MeasuredCone;
use glam::DVec3;

/// The middle of a face on the wall, or of an edge, whose vertices are listed twice.
#[derive(Clone, Copy)]
pub(super) struct Middle {
    pub(super) vertices: [u32; 4],
    /// The radius of the cone next to it.
    pub(super) radius: f64,
}

/// The smooth union of groups of cones.
#[derive(Clone, Default)]
pub(super) struct Wall {
    /// The cones of each tube, and balls as cones without length.
    groups: Vec<Vec<MeasuredCone>>,
    /// Width of the blend, in micrometres.
    blend: f64,
}

impl Wall {
    pub(super) fn new(groups: Vec<Vec<RoundCone>>, blend: f64) -> Self {
        let measured = |group: Vec<RoundCone>| group.into_iter().map(MeasuredCone::new).collect();
        Self { groups: groups.into_iter().map(measured).collect(), blend }
    }

    /// The wall whose cones have radii divided by a factor, except for those of the last `balls` groups, with sharper creases.
    pub(super) fn divided(&self, factor: f64, balls: usize) -> Self {
        let count = self.groups.len() - balls;
        let divided = |(index, group): (usize, &Vec<MeasuredCone>)| {
            let factor = if index < count { factor } else { 1.0 };
            let cone =
                |cone: &MeasuredCone| RoundCone { radii: cone.shape.radii.map(|r| r / factor), ..cone.shape };
            group.iter().map(cone).collect()
        };
        Self::new(self.groups.iter().enumerate().map(divided).collect(), SHARPER * self.blend)
    }

    /// `−k log Σ exp(−f / k)` over the groups, `f` the distance from the nearest cone of each, and its gradient.
    ///
    /// It is below the least distance by at most `k log n`, so the wall expands by at most that.
    pub(super) fn distance(&self, p: DVec3) -> (f64, DVec3) {
        self.of_groups(p, |found| self.blended(p, found))
    }

    /// The signed distance that is to be closed where the wall of a mesh is at `p`, and its gradient: outside of the cones that from their smooth
    /// union; inside, how far the point has to be moved to leave all of them, not only the nearest one, if their surfaces are planes.
    pub(super) fn way(&self, p: DVec3) -> (f64, DVec3) {
        self.of_groups(p, |found| {
            let deepest =
                found.iter().fold((f64::INFINITY, DVec3::ZERO), |a, b| if b.0 < a.0 { *b } else { a });
            if deepest.0 >= 0.0 {
                return self.blended(p, found);
            }
            let outwards = (p - deepest.1).normalize_or_zero();
            let alone = (deepest.0, outwards);
            if found.iter().all(|(distance, _)| *distance >= -deepest.0 || *distance == deepest.0) {
                return alone;
            }
            let half = |&(distance, centre): &(f64, DVec3)| ((p - centre).normalize_or_zero(), -distance);
            let halves: Vec<Half> = found.iter().map(half).collect();
            let most = FARTHEST * self.radius(p);
            match least_shift(&halves) {
                Some(shift) => (-shift.length().min(most), shift.normalize_or(outwards)),
                None => alone,
            }
        })
    }

    /// Calls a function with the distance of a point from the nearest cone of each group, and the centre of the ball next to it.
    fn of_groups<R>(&self, p: DVec3, function: impl FnOnce(&[(f64, DVec3)]) -> R) -> R {
        let (mut few, mut many) = ([(0.0, DVec3::ZERO); FEW], Vec::new());
        let found = if let Some(found) = few.get_mut(..self.groups.len()) {
            found
        } else {
            many.resize(self.groups.len(), (0.0, DVec3::ZERO));
            &mut many[..]
        };
        for (group, best) in self.groups.iter().zip(&mut *found) {
            *best = (f64::INFINITY, DVec3::ZERO);
            for cone in group {
                let (distance, t) = cone.distance(p);
                if distance < best.0 {
                    *best = (distance, cone.shape.ends[0].lerp(cone.shape.ends[1], t));
                }
            }
        }
        function(found)
    }

    fn blended(&self, p: DVec3, found: &[(f64, DVec3)]) -> (f64, DVec3) {
        let nearest = found.iter().map(|(distance, _)| *distance).fold(f64::INFINITY, f64::min);
        let (mut sum, mut gradient) = (0.0, DVec3::ZERO);
        for &(distance, centre) in found {
            if distance - nearest > self.range() {
                continue;
            }
            let weight = if distance == nearest { 1.0 } else { libm::exp((nearest - distance) / self.blend) };
            sum += weight;
            gradient += weight * (p - centre).normalize_or_zero();
        }
        if sum == 1.0 { (nearest, gradient) } else { (nearest - self.blend * libm::log(sum), gradient / sum) }
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
        (positions, near): (&[DVec3], &mut NearWalls),
        energy: &mut f64,
        gradient: &mut [DVec3],
    ) {
        for (k, &v) in vertices.iter().enumerate() {
            let (distance, slope) = near.distance(k, self, positions[v as usize]);
            let relative = distance / scale;
            *energy += weight * relative * relative;
            gradient[v as usize] += slope * (2.0 * weight * relative / scale);
        }
    }

    /// Adds the penalty for middles of edges and faces off the wall, so that vertices move into concave corners: for each one `weight`
    /// times the squared distance over its radius.
    pub(super) fn add_middles(
        &self,
        (middles, weight): (&[Middle], f64),
        (positions, near): (&[DVec3], &mut NearWalls),
        energy: &mut f64,
        gradient: &mut [DVec3],
    ) {
        for (k, Middle { vertices: [a, b, c, d], radius }) in middles.iter().enumerate() {
            let corners = [a, b, c, d].map(|v| *v as usize);
            let middle = corners.iter().map(|v| positions[*v]).sum::<DVec3>() / 4.0;
            let (distance, slope) = near.distance(k, self, middle);
            let relative = distance / radius;
            *energy += weight * relative * relative;
            let slope = slope * (0.5 * weight * relative / radius);
            for v in corners {
                gradient[v] += slope;
            }
        }
    }

    /// The part of the wall that is the same within `reach` of a point.
    pub(super) fn near(&self, centre: DVec3, reach: f64) -> Self {
        let of_group = |group: &Vec<MeasuredCone>| {
            let distances: Vec<f64> = group.iter().map(|cone| cone.distance(centre).0).collect();
            let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
            let pairs = group.iter().zip(distances);
            let kept = pairs.filter(|(_, distance)| *distance <= least + 2.0 * reach).map(|(cone, _)| *cone);
            (least, kept.collect::<Vec<_>>())
        };
        let groups: Vec<(f64, Vec<MeasuredCone>)> = self.groups.iter().map(of_group).collect();
        let least = groups.iter().map(|(least, _)| *least).fold(f64::INFINITY, f64::min);
        let limit = least + 2.0 * reach + self.range();
        let groups =
            groups.into_iter().filter(|(least, _)| *least <= limit).map(|(_, group)| group).collect();
        Self { groups, blend: self.blend }
    }

    /// The radius of the cone next to a point.
    pub(super) fn radius(&self, p: DVec3) -> f64 {
        let mut best = (f64::INFINITY, 0.0);
        for cone in self.groups.iter().flatten() {
            let (distance, t) = cone.distance(p);
            if distance < best.0 {
                let [from, to] = cone.shape.radii;
                best = (distance, from + (to - from) * t);
            }
        }
        best.1
    }

    /// The least radius of the cones near a point, which is that of a thin tube where it leaves a thick one.
    pub(super) fn least_radius(&self, p: DVec3) -> f64 {
        let mut least = self.radius(p);
        for cone in self.groups.iter().flatten() {
            let (distance, t) = cone.distance(p);
            let [from, to] = cone.shape.radii;
            let radius = from + (to - from) * t;
            if distance <= CLOSE * radius {
                least = least.min(radius);
            }
        }
        least
    }

    /// The length of a short move that leaves all cones: the shortest one into half-spaces beyond the nearest cone of each group, those where
    /// it ends; also to both sides of the crotch of a fork.
    pub(super) fn way_out(&self, p: DVec3) -> f64 {
        let alone = self.of_groups(p, |found| {
            let least = found.iter().map(|(distance, _)| *distance).fold(f64::INFINITY, f64::min);
            let others = found.iter().filter(|(distance, _)| *distance < -least).count();
            (others < 2).then_some(-least)
        });
        if let Some(depth) = alone {
            return depth.max(0.0);
        }
        let halves = self.halves(p, DVec3::ZERO);
        let deepest = halves.iter().map(|(_, offset)| *offset).fold(0.0, f64::max);
        let least = self.way_out_from(p, DVec3::ZERO, deepest);
        let most = FARTHEST * self.radius(p);
        if least <= deepest * (1.0 + LEFT) {
            return least.min(most);
        }
        let across = facing_of(&halves).map_or(DVec3::ZERO, |[a, b]| a.cross(b).normalize_or_zero());
        // As far as the surface of a tube is from a point at this depth, along its circumference.
        let aside = across * (2.0 * deepest * self.radius(p)).sqrt();
        [aside, -aside]
            .into_iter()
            .map(|first| self.way_out_from(p, first, deepest))
            .fold(least.min(most), f64::min)
    }

    /// The half-spaces beyond the nearest cone of each group to `p` moved by `shift`, for moves of `p`.
    fn halves(&self, p: DVec3, shift: DVec3) -> Vec<Half> {
        self.of_groups(p + shift, |found| {
            let half = |&(distance, centre): &(f64, DVec3)| {
                let normal = (p + shift - centre).normalize_or_zero();
                (normal, normal.dot(shift) - distance)
            };
            found.iter().map(half).collect()
        })
    }

    fn way_out_from(&self, p: DVec3, first: DVec3, deepest: f64) -> f64 {
        let (mut shift, mut least) = (first, f64::INFINITY);
        for step in 0..MOST_MOVES {
            let halves = self.halves(p, shift);
            let is_out =
                halves.iter().all(|(normal, offset)| offset - normal.dot(shift) <= LEFT * self.blend);
            if is_out && (step > 0 || first == DVec3::ZERO) {
                let length = shift.length();
                let is_less = length < NOTABLY * least;
                least = least.min(length);
                if !is_less {
                    break;
                }
            }
            match least_shift(&halves).filter(|found| found.length() <= LONGEST * deepest) {
                Some(found) => shift = found,
                None => break,
            }
        }
        least
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

/// The parts of a wall near points that move little from one step to the next.
pub(super) struct NearWalls(Vec<NearWall>);

/// The part of a wall that is the same within `reach` of a point.
#[derive(Clone)]
struct NearWall {
    centre: DVec3,
    reach: f64,
    wall: Wall,
}

impl NearWalls {
    /// Those of so many points, which are not known yet.
    pub(super) fn new(count: usize) -> Self {
        Self(vec![NearWall { centre: DVec3::NAN, reach: 0.0, wall: Wall::default() }; count])
    }

    /// The distance of the point with this number from the wall.
    pub(super) fn distance(&mut self, index: usize, wall: &Wall, p: DVec3) -> (f64, DVec3) {
        self.near(index, wall, p).distance(p)
    }

    /// [`Wall::way`] of the point with this number.
    pub(super) fn way(&mut self, index: usize, wall: &Wall, p: DVec3) -> (f64, DVec3) {
        self.near(index, wall, p).way(p)
    }

    fn near(&mut self, index: usize, wall: &Wall, p: DVec3) -> &Wall {
        let near = &mut self.0[index];
        let is_known = p.distance(near.centre) <= near.reach;
        if !is_known {
            let reach = REACH * wall.radius(p);
            *near = NearWall { centre: p, reach, wall: wall.near(p, reach) };
        }
        &near.wall
    }
}

/// Width of the blend of the wall that is followed, over that of the wall in the beginning.
const SHARPER: f64 = 0.4;
/// Most steps of a move out of cones.
const MOST_MOVES: usize = 12;
/// A move that is no shorter than this share of the one before is not improved.
const NOTABLY: f64 = 0.99;
/// Longest move into half-spaces, relative to the one into the farthest of them: those of nearly opposite normals meet far away.
const LONGEST: f64 = 20.0;
/// Greatest distance that is to be closed, in radii: along a crotch at a small angle it may be much greater than the depth in a cone.
const FARTHEST: f64 = 2.0;
/// Depth in a cone up to which a point has left it, in widths of the blend.
const LEFT: f64 = 0.02;
/// Distance from a cone up to which a point is near it, in radii.
const CLOSE: f64 = 0.5;
/// How far a point moves before the part of the wall near it is taken anew, in radii.
const REACH: f64 = 0.1;
/// Number of groups whose distances need no memory of their own.
const FEW: usize = 8;
/// From this distance beyond the nearest group on, in widths of the blend, another one adds less than the rounding of the sum.
const FAR: f64 = 40.0;
/// Largest number of steps, of a tenth of the radius, along a ray.
const MOST_STEPS: usize = 200;
/// Halvings of the step that crosses the wall.
const HALVINGS: usize = 40;
/// Newton steps of a projection.
const PROJECTIONS: usize = 8;
