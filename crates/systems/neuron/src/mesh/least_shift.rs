//! The shortest move into half-spaces.

use glam::DVec3;

/// The points `x` with `normal · x >= offset`; the normal is a unit vector.
pub(super) type Half = (DVec3, f64);

/// Offset by which a half-space may be missed, relative to the greatest one.
const MISSED: f64 = 1e-9;

/// Determinant of the cosines between normals up to which they count as linearly dependent.
const DEPENDENT: f64 = 1e-10;

/// The shortest vector in all half-spaces; `None` if there is none, up to rounding.
///
/// # Cost
/// Half-spaces are added one after another, the one that is missed most first, and at most three of them determine the vector: a few
/// times the number of half-spaces, which are few.
pub(super) fn least_shift(halves: &[Half]) -> Option<DVec3> {
    let greatest = halves.iter().map(|(_, offset)| offset.abs()).fold(0.0, f64::max);
    let missed = |(normal, offset): &Half, shift: DVec3| offset - normal.dot(shift);
    let mut shift = DVec3::ZERO;
    // Those that determine the vector.
    let (mut basis, mut count) = ([0; 3], 0);
    for _ in 0..4 * halves.len() + 4 {
        let worst =
            (0..halves.len()).map(|i| (missed(&halves[i], shift), i)).max_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, new)) = worst.filter(|(missing, _)| *missing > MISSED * greatest) else {
            return Some(shift);
        };
        let old = basis;
        let old = &old[..count];
        let mut best: Option<(f64, DVec3)> = None;
        let mut try_basis = |with: &[usize]| {
            let chosen = with.iter().map(|i| halves[*i]);
            let Some(found) = meeting(chosen) else { return };
            let is_in = old.iter().chain([&new]).all(|i| missed(&halves[*i], found) <= MISSED * greatest);
            let length = found.length_squared();
            if is_in && best.is_none_or(|(least, _)| length < least) {
                best = Some((length, found));
                basis = [0; 3];
                basis[..with.len()].copy_from_slice(with);
                count = with.len();
            }
        };
        try_basis(&[new]);
        for (k, &a) in old.iter().enumerate() {
            try_basis(&[new, a]);
            for &b in &old[..k] {
                try_basis(&[new, a, b]);
            }
        }
        shift = best?.1;
    }
    None
}

/// The normals of the two half-spaces that face each other most; `None` if there are fewer.
pub(super) fn facing_of(halves: &[Half]) -> Option<[DVec3; 2]> {
    let pairs = (0..halves.len()).flat_map(|i| (0..i).map(move |j| [halves[i].0, halves[j].0]));
    pairs.min_by(|x, y| x[0].dot(x[1]).total_cmp(&y[0].dot(y[1])))
}

/// The shortest vector on the planes of up to three half-spaces.
fn meeting(halves: impl Iterator<Item = Half>) -> Option<DVec3> {
    let (mut normals, mut offsets, mut count) = ([DVec3::ZERO; 3], DVec3::ZERO, 0);
    for (normal, offset) in halves.take(3) {
        normals[count] = normal;
        offsets[count] = offset;
        count += 1;
    }
    let [a, b, c] = normals;
    match count {
        1 => Some(a * offsets.x),
        2 => {
            let cosine = a.dot(b);
            let determinant = 1.0 - cosine * cosine;
            let [x, y] = [offsets.x - cosine * offsets.y, offsets.y - cosine * offsets.x];
            (determinant > DEPENDENT).then(|| (a * x + b * y) / determinant)
        }
        _ => {
            let determinant = a.dot(b.cross(c));
            let sum = b.cross(c) * offsets.x + c.cross(a) * offsets.y + a.cross(b) * offsets.z;
            (determinant * determinant > DEPENDENT).then(|| sum / determinant)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Alternating projections with corrections (Dykstra's), which end at the same vector.
    fn slowly(halves: &[Half]) -> DVec3 {
        let (mut shift, mut weights) = (DVec3::ZERO, vec![0.0_f64; halves.len()]);
        for _ in 0..20_000 {
            for ((normal, offset), weight) in halves.iter().zip(&mut weights) {
                let more = (offset - normal.dot(shift)).max(-*weight);
                *weight += more;
                shift += *normal * more;
            }
        }
        shift
    }

    #[test]
    fn it_is_where_projections_end() {
        let part = |k: u32, seed: f64| libm::sin(seed * f64::from(k + 1));
        for count in 1..9 {
            for case in 0..40 {
                let half = |k: u32| {
                    let k = 50 * case + k;
                    // Normals in a half-space have a common direction, so that there is such a vector.
                    let normal = DVec3::new(part(k, 7.1), part(k, 3.3), 0.3 + part(k, 5.7).abs());
                    (normal.normalize(), 0.5 + part(k, 2.9))
                };
                let halves: Vec<Half> = (0..count).map(half).collect();
                let found = least_shift(&halves).unwrap();
                assert!(found.distance(slowly(&halves)) < 1e-6, "{halves:?}: {found}");
            }
        }
    }

    #[test]
    fn opposite_half_spaces_have_none() {
        assert_eq!(least_shift(&[]), Some(DVec3::ZERO));
        assert_eq!(least_shift(&[(DVec3::X, 1.0), (-DVec3::X, 1.0)]), None);
        assert_eq!(least_shift(&[(DVec3::X, 1.0), (-DVec3::X, -3.0)]), Some(DVec3::X));
    }
}
