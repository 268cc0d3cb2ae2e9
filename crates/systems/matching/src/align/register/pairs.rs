//! Initial poses by voting of pairs of points with normals.
//!
//! The distance of two points, and the angles between their normals and their connecting line, are invariant under rigid motions.
//! Each pair of the moving surface votes for the motions that map it onto a pair of the fixed one with the same four numbers. Wrong
//! votes scatter; correct votes coincide, even if only a part of each surface has a counterpart.

use super::super::pose::{Pose, rotation};
use super::oriented::Oriented;
use super::placement::Placement;
use glam::{DMat3, DVec3};
use rayon::prelude::*;
use std::f64::consts::{PI, TAU};

/// Number of classes for an angle between 0 and π.
const ANGLES: usize = 15;
/// Number of classes for a distance.
const DISTANCES: usize = 48;
/// Number of classes for the rotation about a normal.
const TURNS: usize = 30;
/// Number of points of the moving surface for which votes are counted.
const REFERENCES: usize = 240;
/// Number of candidates that each of them may contribute.
const NAMED: usize = 4;
/// Smallest number of votes of a contributed candidate, relative to the best.
const NAMED_SHARE: f32 = 0.8;
/// Candidates whose rotations differ by less than this angle, in radians, are merged.
const SAME_TURN: f64 = 0.26;

/// A motion with the weight of its votes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    pub(super) placement: Placement,
    votes: f32,
}

/// A rotation that takes a unit vector to the first axis.
///
/// # Source
/// `duff_building_2017`.
fn onto_first_axis(n: DVec3) -> DMat3 {
    let sign = 1.0_f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    let u = DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
    let v = DVec3::new(b, sign + n.y * n.y * a, -n.y);
    DMat3::from_cols(n, u, v).transpose()
}

/// The class of an angle from its cosine.
///
/// # Source
/// `abramowitz_handbook_1964`, 4.4.45: error at most 7e-5, the same on every machine.
fn angle_class(cosine: f64) -> usize {
    let x = cosine.abs().min(1.0);
    let near = (1.0 - x).sqrt() * (1.570_728_8 + x * (-0.212_114_4 + x * (0.074_261 - x * 0.018_729_3)));
    let angle = if cosine < 0.0 { PI - near } else { near };
    ((angle * (ANGLES as f64 / PI)) as usize).min(ANGLES - 1)
}

/// Classification of pairs by their invariants.
#[derive(Clone, Copy, Debug)]
struct Classes {
    /// Width of a distance class.
    step: f64,
}

impl Classes {
    const COUNT: usize = DISTANCES * ANGLES * ANGLES * ANGLES;

    /// The class of a pair; `None` for points that coincide or are too far apart.
    fn of(self, from: &Oriented, to: &Oriented) -> Option<usize> {
        let line = to.point - from.point;
        let length = line.length();
        let distance = (length / self.step) as usize;
        if !(length > 0.0 && distance < DISTANCES) {
            return None;
        }
        let line = line / length;
        let angles = [from.normal.dot(line), to.normal.dot(line), from.normal.dot(to.normal)];
        Some(angles.into_iter().fold(distance, |class, cosine| class * ANGLES + angle_class(cosine)))
    }
}

/// The rotation angle of a point about the normal of another, in units of 1/65,536 of a full turn.
fn turn(onto: &DMat3, from: DVec3, to: DVec3) -> u16 {
    let p = *onto * (to - from);
    let share = libm::atan2(p.z, p.y) / TAU;
    // The width of the type drops full turns.
    (share * 65_536.0).floor() as i64 as u16
}

/// Pairs of points of the fixed surface, by class.
pub(super) struct Pairs<'p> {
    points: &'p [Oriented],
    onto: Vec<DMat3>,
    classes: Classes,
    /// Where each class begins.
    begins: Vec<u32>,
    /// The first point of each pair, and the rotation angle of the second about its normal.
    entries: Vec<(u16, u16)>,
}

impl<'p> Pairs<'p> {
    /// `step` is the spacing of the points.
    ///
    /// # Cost
    /// O(n²) for n points.
    pub(super) fn new(points: &'p [Oriented], step: f64) -> Self {
        let classes = Classes { step };
        let onto: Vec<DMat3> = points.iter().map(|p| onto_first_axis(p.normal)).collect();
        let found: Vec<Vec<(u32, (u16, u16))>> = (0..points.len())
            .into_par_iter()
            .map(|i| {
                let (from, onto) = (&points[i], &onto[i]);
                let pair = |to: &Oriented| {
                    let class = classes.of(from, to)?;
                    Some((class as u32, (i as u16, turn(onto, from.point, to.point))))
                };
                points.iter().filter_map(pair).collect()
            })
            .collect();
        let mut begins = vec![0_u32; Classes::COUNT + 1];
        for (class, _) in found.iter().flatten() {
            begins[*class as usize + 1] += 1;
        }
        for class in 0..Classes::COUNT {
            begins[class + 1] += begins[class];
        }
        let mut next = begins.clone();
        let mut entries = vec![(0, 0); begins[Classes::COUNT] as usize];
        for &(class, pair) in found.iter().flatten() {
            let place = &mut next[class as usize];
            entries[*place as usize] = pair;
            *place += 1;
        }
        Self { points, onto, classes, begins, entries }
    }

    fn of_class(&self, class: usize) -> &[(u16, u16)] {
        &self.entries[self.begins[class] as usize..self.begins[class + 1] as usize]
    }

    /// The motions with the most votes that map one point of the other surface onto a point of this one. Votes in a class with many
    /// pairs have less weight, because they are less specific.
    fn voted(&self, points: &[Oriented], reference: usize, votes: &mut Vec<f32>) -> Vec<Candidate> {
        votes.clear();
        votes.resize(self.points.len() * TURNS, 0.0);
        let from = &points[reference];
        let onto = onto_first_axis(from.normal);
        for to in points {
            let Some(class) = self.classes.of(from, to) else { continue };
            let alike = self.of_class(class);
            let weight = 1.0 / (alike.len() as f32).sqrt();
            let own = turn(&onto, from.point, to.point);
            for &(i, its) in alike {
                let by = usize::from(its.wrapping_sub(own)) * TURNS / 65_536;
                votes[usize::from(i) * TURNS + by] += weight;
            }
        }
        let mut best: Vec<(f32, usize)> = Vec::with_capacity(NAMED + 1);
        for (point, turns) in votes.chunks_exact(TURNS).enumerate() {
            for by in 0..TURNS {
                // An angle near the border of two classes votes for both.
                let beside = turns[(by + 1) % TURNS].max(turns[(by + TURNS - 1) % TURNS]);
                let value = turns[by] + 0.5 * beside;
                if best.len() < NAMED || value > best[NAMED - 1].0 {
                    let place = best.partition_point(|(other, _)| *other >= value);
                    best.insert(place, (value, point * TURNS + by));
                    best.truncate(NAMED);
                }
            }
        }
        let most = best.first().map_or(0.0, |best| best.0);
        best.retain(|(value, _)| *value > 0.0 && *value >= NAMED_SHARE * most);
        let candidate = |(votes, place): (f32, usize)| {
            let angle = ((place % TURNS) as f64 + 0.5) * (TAU / TURNS as f64);
            let to = place / TURNS;
            let rotation = self.onto[to].transpose() * rotation(DVec3::X * angle) * onto;
            let translation = self.points[to].point - rotation * from.point;
            Candidate { placement: Placement { pose: Pose { rotation, translation }, scale: 1.0 }, votes }
        };
        best.into_iter().map(candidate).collect()
    }
}

/// The motions with the most votes that map the moving surface onto the fixed one, at most `count`. Two motions are compared at
/// `centre`, a point of the moving surface.
///
/// # Cost
/// One operation per pair of pairs in the same class.
/// # Source
/// `drost_model_2010`; votes are weighted by the rarity of their class.
pub(super) fn voted(pairs: &Pairs<'_>, moving: &[Oriented], centre: DVec3, count: usize) -> Vec<Placement> {
    let step = pairs.classes.step;
    let every = moving.len().div_ceil(REFERENCES).max(1);
    let named: Vec<Vec<Candidate>> = (0..moving.len())
        .into_par_iter()
        .step_by(every)
        .map_init(Vec::new, |votes, reference| pairs.voted(moving, reference, votes))
        .collect();
    let mut named: Vec<Candidate> = named.into_iter().flatten().collect();
    // Stable, so that equal scores stay in the order of the references.
    named.sort_by(|a, b| b.votes.total_cmp(&a.votes));
    let mut groups: Vec<Candidate> = Vec::new();
    for candidate in named {
        let same = |group: &&mut Candidate| {
            let [a, b] = [candidate.placement, group.placement];
            a.angle(&b) < SAME_TURN && a.apply(centre).distance(b.apply(centre)) < 2.0 * step
        };
        match groups.iter_mut().find(same) {
            Some(group) => group.votes += candidate.votes,
            None => groups.push(candidate),
        }
    }
    groups.sort_by(|a, b| b.votes.total_cmp(&a.votes));
    groups.truncate(count);
    groups.into_iter().map(|group| group.placement).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::Random;

    #[test]
    fn the_frame_of_a_normal_is_a_rotation_that_takes_it_to_the_first_axis() {
        let mut random = Random::new(11);
        for _ in 0..200 {
            let n = DVec3::from_array(std::array::from_fn(|_| random.signed_unit())).normalize();
            let onto = onto_first_axis(n);
            assert!((onto * n - DVec3::X).length() < 1e-14 && (onto.determinant() - 1.0).abs() < 1e-14);
        }
        assert!(onto_first_axis(-DVec3::Z).is_finite());
    }

    #[test]
    fn classes_of_angles_are_those_of_the_arc_cosine() {
        for k in 0..=10_000 {
            let angle = PI * f64::from(k) / 10_000.0;
            let class = angle * ANGLES as f64 / PI;
            if (class - class.round()).abs() > 1e-3 {
                assert_eq!(angle_class(angle.cos()), class as usize, "{angle}");
            }
        }
        assert_eq!(angle_class(0.0), ANGLES / 2);
        assert_eq!((angle_class(1.0 + 1e-15), angle_class(-1.0 - 1e-15)), (0, ANGLES - 1));
    }

    #[test]
    fn a_cloud_finds_its_place_by_a_third_of_its_points() {
        let mut random = Random::new(4);
        let mut vector = || DVec3::from_array(std::array::from_fn(|_| random.signed_unit()));
        let fixed: Vec<Oriented> =
            (0..300).map(|_| Oriented { point: vector(), normal: vector().normalize() }).collect();
        let rotation = DMat3::from_axis_angle(vector().normalize(), 2.1);
        let shift = vector();
        // Points that lie on the fixed ones after `expected`, and equally many elsewhere.
        let expected = Placement { pose: Pose { rotation, translation: shift }, scale: 1.0 };
        let back = |p: &Oriented| Oriented {
            point: rotation.transpose() * (p.point - shift),
            normal: rotation.transpose() * p.normal,
        };
        let mut moving: Vec<Oriented> = fixed[..100].iter().map(back).collect();
        moving.extend((0..200).map(|_| Oriented { point: vector(), normal: vector().normalize() }));
        let found = voted(&Pairs::new(&fixed, 0.08), &moving, DVec3::ZERO, 5);
        let is_near = |p: &Placement| p.angle(&expected) < 0.3 && p.apply(DVec3::ZERO).distance(shift) < 0.3;
        assert!(is_near(&found[0]), "{found:?} {expected:?}");
    }
}
