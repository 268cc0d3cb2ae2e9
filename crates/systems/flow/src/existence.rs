//! Where two boundary loops are too far apart for a connected minimal surface.

use glam::DVec3;

/// A double cone whose two nappes hold one boundary loop each, so steep that no connected minimal surface spans both.
///
/// # Source
/// `dierkes_minimal_2010`, enclosure and non-existence theorems: the cone `x² + y² < sinh²(τ) z²` with `τ tanh τ = 1`, that of the catenoids through its apex.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Cone {
    /// The apex, where the nappes meet.
    pub apex: [f64; 3],
    /// Unit vector along the axis, towards the second loop.
    pub axis: [f64; 3],
}

/// `sinh² τ` where `τ tanh τ = 1`.
const SQUARED_SLOPE: f64 = 2.276_717_8;
/// A point counts as inside the cone if it is by this part of the distance from the apex: a margin for rounding.
const MARGIN: f64 = 1e-9;
/// Places along the axis, and rounds of finer ones around the best.
const PLACES: usize = 33;
const ROUNDS: usize = 12;

/// By how much the loops miss the cone with this apex and axis: negative if both lie inside.
fn miss(loops: [&[DVec3]; 2], apex: DVec3, axis: DVec3) -> f64 {
    let slope = SQUARED_SLOPE.sqrt();
    let of = |points: &[DVec3], sign: f64| {
        points.iter().fold(f64::NEG_INFINITY, |worst, p| {
            let from = *p - apex;
            let along = sign * from.dot(axis);
            let across = (from - from.dot(axis) * axis).length();
            let by = (across - slope * along) / from.length().max(f64::MIN_POSITIVE) + MARGIN;
            if by > worst { by } else { worst }
        })
    };
    let [first, second] = [of(loops[0], -1.0), of(loops[1], 1.0)];
    if first > second { first } else { second }
}

/// A cone for two loops, if one is found. Only some axes are tried, so that none is no proof that a surface exists.
pub(crate) fn separating_cone(loops: [&[DVec3]; 2]) -> Option<Cone> {
    let centre = |points: &[DVec3]| points.iter().sum::<DVec3>() / points.len() as f64;
    let normal = |points: &[DVec3]| {
        let middle = centre(points);
        let next = points.iter().cycle().skip(1);
        points.iter().zip(next).map(|(p, q)| (*p - middle).cross(*q - middle)).sum::<DVec3>()
    };
    let [from, to] = loops.map(centre);
    let along = (to - from).try_normalize()?;
    let [first, second] = loops.map(|points| {
        let n = normal(points).normalize_or_zero();
        if n.dot(along) < 0.0 { -n } else { n }
    });
    let axes = [along, first, second, first + second, along + first + second];
    axes.into_iter().filter_map(DVec3::try_normalize).find_map(|axis| {
        // The apex is sought on lines between the centres, closer and closer to the best place.
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..ROUNDS {
            let at = |k: usize| low + (high - low) * k as f64 / (PLACES - 1) as f64;
            let value = |k: usize| miss(loops, from.lerp(to, at(k)), axis);
            let best = (0..PLACES).fold((0, f64::INFINITY), |best, k| {
                let here = value(k);
                if here < best.1 { (k, here) } else { best }
            });
            if best.1 < 0.0 {
                let apex = from.lerp(to, at(best.0)).to_array();
                return Some(Cone { apex, axis: axis.to_array() });
            }
            (low, high) = (at(best.0.saturating_sub(1)), at((best.0 + 1).min(PLACES - 1)));
        }
        None
    })
}
