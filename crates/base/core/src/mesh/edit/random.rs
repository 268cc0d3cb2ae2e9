//! Random numbers: small, seeded, the same on every machine.

/// The generator `SplitMix64`: the same numbers for the same seed on every machine.
///
/// # Source
/// `steele_splittable_2014`.
#[derive(Clone, Debug)]
pub struct Random(u64);

impl Random {
    /// The generator with this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform among the integers below `bound` (up to a bias of `bound / 2^64`).
    pub fn below(&mut self, bound: u32) -> u32 {
        ((u128::from(self.bits()) * u128::from(bound)) >> 64) as u32
    }

    /// Uniform in `[-1, 1)`.
    pub fn signed_unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    /// A direction, uniform on the unit sphere.
    pub fn direction(&mut self) -> [f64; 3] {
        loop {
            let p = [self.signed_unit(), self.signed_unit(), self.signed_unit()];
            let norm_sq = p[0] * p[0] + p[1] * p[1] + p[2] * p[2];
            if (0.01..=1.0).contains(&norm_sq) {
                let norm = norm_sq.sqrt();
                return p.map(|x| x / norm);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_are_those_of_the_published_generator() {
        let mut random = Random::new(1_234_567);
        let bits = [random.bits(), random.bits(), random.bits()];
        assert_eq!(bits, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn directions_are_unit_and_without_preference() {
        let mut random = Random::new(5);
        let directions: Vec<_> = (0..10_000).map(|_| random.direction()).collect();
        assert!(directions.iter().all(|d| (d.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-15));
        for axis in 0..3 {
            let mean = directions.iter().map(|d| d[axis]).sum::<f64>() / 10_000.0;
            let square = directions.iter().map(|d| d[axis] * d[axis]).sum::<f64>() / 10_000.0;
            assert!(mean.abs() < 0.03 && (square - 1.0 / 3.0).abs() < 0.02, "axis {axis}: {mean} {square}");
        }
    }
}
