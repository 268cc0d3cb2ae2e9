//! Motions that leave an alignment unchanged.

use super::super::equations::Equations;
use glam::DVec3;
use pompeiu_core::geom::eigenpairs;

/// A motion is free if its eigenvalue is below this share of the largest one: it moves points along their normals by less than the
/// square root of this share.
const FREE: f64 = 1e-3;

/// A rotation and translation that leave the fit unchanged: the rotation about the axis of a cylinder, the translations within a
/// plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Freedom {
    /// The rotation vector, times the radius of the points.
    pub(super) turn: DVec3,
    pub(super) shift: DVec3,
}

/// The free motions of points with normals. Lever arms are relative to `about`, in units of `radius`. The two parts of each motion
/// together have length 1; pure translations come last.
///
/// # Source
/// Eigenvectors of the normal equations, `gelfand_geometrically_2003`.
pub(super) fn free_motions(
    points: impl Iterator<Item = (DVec3, DVec3)>,
    about: DVec3,
    radius: f64,
) -> Vec<Freedom> {
    let mut equations = Equations::<6>::new();
    for (p, n) in points {
        let turn = ((p - about) / radius).cross(n);
        equations.add(1.0, [turn.x, turn.y, turn.z, n.x, n.y, n.z], 0.0);
    }
    let lower = equations.matrix;
    let pairs = eigenpairs::<6>(std::array::from_fn(|i| std::array::from_fn(|j| lower[i.max(j)][i.min(j)])));
    let free: Vec<[f64; 6]> =
        pairs.iter().filter(|pair| pair.0 <= FREE * pairs[0].0).map(|pair| pair.1).collect();
    // Any basis is valid; one with as many pure translations as possible is the easiest to understand.
    let turns: Vec<DVec3> = free.iter().map(|v| DVec3::from_slice(&v[..3])).collect();
    let gram: [[f64; 6]; 6] = std::array::from_fn(|i| {
        std::array::from_fn(|j| match (turns.get(i), turns.get(j)) {
            (Some(a), Some(b)) => a.dot(*b),
            // Zero components come last.
            _ => -f64::from(u8::from(i == j)),
        })
    });
    let mixed = |weights: &[f64; 6]| {
        let sum = |part: std::ops::Range<usize>| {
            free.iter().zip(weights).map(|(v, w)| DVec3::from_slice(&v[part.clone()]) * *w).sum::<DVec3>()
        };
        Freedom { turn: sum(0..3), shift: sum(3..6) }
    };
    eigenpairs(gram).iter().take(free.len()).map(|(_, weights)| mixed(weights)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a closed cylinder about the z-axis with its normals.
    fn side() -> impl Iterator<Item = (DVec3, DVec3)> {
        (0..400).map(|k| {
            let angle = f64::from(k) * 2.4;
            let normal = DVec3::new(angle.cos(), angle.sin(), 0.0);
            (normal + DVec3::Z * (f64::from(k) / 200.0 - 1.0), normal)
        })
    }

    #[test]
    fn a_tube_turns_and_slides_and_a_rod_only_turns() {
        let free = free_motions(side(), DVec3::ZERO, 1.0);
        assert_eq!(free.len(), 2);
        assert!(free[0].turn.z.abs() > 1.0 - 1e-6 && free[1].shift.z.abs() > 1.0 - 1e-6, "{free:?}");
        let caps = (0..100).map(|k| {
            let z = if k % 2 == 0 { 1.0 } else { -1.0 };
            let angle = f64::from(k) * 2.4;
            (DVec3::new(0.5 * angle.cos(), 0.5 * angle.sin(), z), DVec3::Z * z)
        });
        let free = free_motions(side().chain(caps), DVec3::ZERO, 1.0);
        assert!(free.len() == 1 && free[0].turn.z.abs() > 1.0 - 1e-6, "{free:?}");
    }

    #[test]
    fn a_plane_slides_twice_and_turns_once() {
        let plane =
            (0..100).map(|k| (DVec3::new(f64::from(k % 10) - 4.5, f64::from(k / 10) - 4.5, 0.0), DVec3::Z));
        let free = free_motions(plane, DVec3::ZERO, 3.0);
        assert_eq!(free.len(), 3);
        assert!(
            free[0].turn.z.abs() > 1.0 - 1e-9 && free[1..].iter().all(|f| f.turn.length() < 1e-9),
            "{free:?}"
        );
    }
}
