//! Edges in the order of their errors, roughly.

/// Buckets for each power of two.
const PER_OCTAVE: usize = 1 << BITS;
const BITS: u32 = 8;

/// Powers of two that are told apart: errors at or below 2^-`BELOW` are taken as equal, as are those of 2^`ABOVE` and more.
const BELOW: usize = 120;
const ABOVE: usize = 32;

/// An edge with its error, and the versions of its ends when that was computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Entry {
    pub(super) halfedge: u32,
    pub(super) error: f64,
    pub(super) versions: [u32; 2],
}

/// A queue in which errors that differ by less than a part in 256 may come in any order, the last first.
#[derive(Debug)]
pub(super) struct Queue {
    buckets: Vec<Vec<Entry>>,
    /// All buckets before this one are empty.
    first: usize,
}

impl Queue {
    pub(super) fn new() -> Self {
        Self { buckets: vec![Vec::new(); (BELOW + ABOVE) * PER_OCTAVE], first: 0 }
    }

    /// Adds an edge, whose error is not negative.
    pub(super) fn push(&mut self, entry: Entry) {
        // The bits of such numbers are ordered as the numbers are: exponent first, then the leading digits.
        let place = (entry.error.to_bits() >> (f64::MANTISSA_DIGITS - 1 - BITS)) as usize;
        let lowest = (f64::MAX_EXP as usize - 1 - BELOW) * PER_OCTAVE;
        let bucket = place.saturating_sub(lowest).min(self.buckets.len() - 1);
        self.buckets[bucket].push(entry);
        self.first = self.first.min(bucket);
    }

    /// Takes an edge of least error.
    pub(super) fn pop(&mut self) -> Option<Entry> {
        while self.first < self.buckets.len() {
            if let Some(entry) = self.buckets[self.first].pop() {
                return Some(entry);
            }
            self.first += 1;
        }
        None
    }

    pub(super) fn clear(&mut self) {
        self.buckets.iter_mut().for_each(Vec::clear);
        self.first = self.buckets.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::mesh::Random;

    #[test]
    fn errors_come_in_order_up_to_a_part_in_256() {
        let mut random = Random::new(3);
        let mut errors: Vec<f64> = (0..500)
            .map(|_| f64::from(random.below(1 << 20)) * f64::from(random.below(80)).exp2().recip())
            .collect();
        errors.extend([0.0, 1e-300, 1e300, f64::INFINITY, 1.0]);
        let mut queue = Queue::new();
        for (i, error) in errors.iter().enumerate() {
            queue.push(Entry { halfedge: i as u32, error: *error, versions: [0, i as u32] });
        }
        let mut found = Vec::new();
        let mut least = 0.0;
        while let Some(entry) = queue.pop() {
            assert_eq!(entry.versions, [0, entry.halfedge]);
            let error = errors[entry.halfedge as usize];
            assert!(
                error >= least * (1.0 - 1.0 / 256.0) || !(1e-36..=4e9).contains(&error),
                "{error} after {least}"
            );
            least = if error > least { error } else { least };
            found.push(entry.halfedge);
        }
        found.sort_unstable();
        assert_eq!(found, (0..errors.len() as u32).collect::<Vec<_>>());
        queue.push(Entry { halfedge: 1, error: 2.0, versions: [0, 0] });
        queue.clear();
        assert_eq!(queue.pop(), None);
    }
}
