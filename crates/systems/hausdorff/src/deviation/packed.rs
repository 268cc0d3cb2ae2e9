//! Entries in half of the memory, where what is asked leaves room for their rounding.

use super::entry::{Entry, SMALL, STEP, at_least};
use std::ops::Range;

/// From this accuracy on entries are packed: what that adds is a thousandth of it. Few faces take little memory as it is.
const COARSE: f64 = 1e-4;
const MANY: usize = 1 << 12;

/// Whether the entries of so many faces should be packed.
pub(super) fn are_packed(accuracy: f64, faces: usize) -> bool {
    accuracy >= COARSE && faces >= MANY
}

/// An [`Entry`] in fewer digits, all rounded outwards: values by less than 2^-22 of themselves, widths and what the area may be
/// greater by less than 2^-6 of themselves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Packed {
    lower: [f32; 3],
    area: f32,
    width: [u16; 3],
    more: u16,
}

impl Packed {
    pub(super) fn new(entry: &Entry) -> Self {
        let (lower, upper) = (entry.lower(), entry.upper());
        let (low, high) = entry.area();
        let area = at_most(low);
        let ends: [(f32, u16); 3] = std::array::from_fn(|j| between(lower[j], upper[j]));
        Self {
            lower: ends.map(|(lower, _)| lower),
            area,
            width: ends.map(|(_, width)| width),
            more: upper_half(at_least(high - f64::from(area), high)),
        }
    }

    #[inline]
    pub(super) fn entry(&self) -> Entry {
        Entry {
            lower: self.lower.map(f64::from),
            width: self.width.map(whole),
            area: f64::from(self.area),
            more: whole(self.more),
        }
    }
}

/// A lower end and a width for values at a corner. Where the lower one is negative it is what gives way to the rounding of the width, as in an
/// [`Entry`]: a part of a width from far below zero to nearly zero would be far more than the upper one.
fn between(lower: f64, upper: f64) -> (f32, u16) {
    let rounded = at_most(lower);
    let width = upper_half(at_least(upper - f64::from(rounded), upper));
    if lower < 0.0 {
        // No less than the exact difference, so that the sum is no less than the upper end.
        let raised = at_least(upper - f64::from(whole(width)), upper);
        return (if raised < rounded { raised } else { rounded }, width);
    }
    (rounded, width)
}

fn whole(half: u16) -> f32 {
    f32::from_bits(u32::from(half) << 16)
}

/// Rounded down.
fn at_most(x: f64) -> f32 {
    if x.abs() > SMALL {
        return (x - STEP * x.abs()) as f32;
    }
    let rounded = x as f32;
    if f64::from(rounded) > x { rounded.next_down() } else { rounded }
}

/// The upper half of the digits of a number that is not negative, rounded up: the other half is counted as one more unless it is
/// zero.
fn upper_half(x: f32) -> u16 {
    const LOWER: u32 = (1 << 16) - 1;
    let x = if x > 0.0 { x } else { 0.0 };
    ((x.to_bits() + LOWER) >> 16) as u16
}

/// Entries, in full or packed.
#[derive(Clone, Debug)]
pub(super) enum Entries {
    Full(Vec<Entry>),
    Packed(Vec<Packed>),
}

impl Entries {
    /// None yet.
    pub(super) fn new(packed: bool) -> Self {
        if packed { Self::Packed(Vec::new()) } else { Self::Full(Vec::new()) }
    }

    /// Bytes of each.
    pub(super) fn size(packed: bool) -> usize {
        if packed { size_of::<Packed>() } else { size_of::<Entry>() }
    }

    pub(super) fn len(&self) -> usize {
        match self {
            Self::Full(all) => all.len(),
            Self::Packed(all) => all.len(),
        }
    }

    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Full(all) => size_of_val(&all[..]),
            Self::Packed(all) => size_of_val(&all[..]),
        }
    }

    pub(super) fn push(&mut self, entry: &Entry) {
        match self {
            Self::Full(all) => all.push(*entry),
            Self::Packed(all) => all.push(Packed::new(entry)),
        }
    }

    pub(super) fn truncate(&mut self, count: usize) {
        match self {
            Self::Full(all) => all.truncate(count),
            Self::Packed(all) => all.truncate(count),
        }
    }

    /// Appends some of others, which are stored the same way.
    pub(super) fn extend_from(&mut self, others: &Self, range: Range<usize>) {
        match (self, others) {
            (Self::Full(all), Self::Full(others)) => all.extend_from_slice(&others[range]),
            (Self::Packed(all), Self::Packed(others)) => all.extend_from_slice(&others[range]),
            (all, others) => others.range(range).for_each(|entry| all.push(&entry)),
        }
    }

    pub(super) fn range(&self, range: Range<usize>) -> impl Iterator<Item = Entry> + '_ {
        let (full, packed) = match self {
            Self::Full(all) => (&all[range], &[][..]),
            Self::Packed(all) => (&[][..], &all[range]),
        };
        full.iter().copied().chain(packed.iter().map(Packed::entry))
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = Entry> + '_ {
        self.range(0..self.len())
    }
}

#[cfg(test)]
mod tests {
    use super::super::linear::greater;
    use super::super::polygon::{MOST_CORNERS, Polygon};
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn packed_entries_take_half() {
        assert_eq!((size_of::<Packed>(), size_of::<Entry>()), (24, 48));
    }

    /// Where one face of B ends the planes behind which B lies fall off steeply, however near the surface is.
    #[test]
    fn what_says_nothing_from_below_costs_no_digits_above() {
        let mut polygon = Polygon::whole(0.0);
        polygon.lower[..3].copy_from_slice(&[-1e-15, -1e-3, -1e-15]);
        polygon.upper[..3].copy_from_slice(&[1e-15, 1e-15, 1e-9]);
        let packed = Packed::new(&Entry::new(&polygon, [0, 1, 2], (1.0, 1.0))).entry();
        for (exact, found) in polygon.upper.into_iter().zip(packed.upper()) {
            assert!(exact <= found && found <= 1.02 * exact, "{found}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        /// What is packed lies outside of what was, and not far.
        #[test]
        fn packing_rounds_outwards(
            values in prop::array::uniform3((-1.0..1.0_f64, -30..3_i32)),
            widths in prop::array::uniform3((0.0..1.0_f64, -30..3_i32)),
            area in (0.1..1.0_f64, -30..3_i32),
            more in 0.0..1e-3_f64,
        ) {
            let of = |(x, order): (f64, i32)| x * 10.0_f64.powi(order);
            let mut polygon = Polygon::whole(0.0);
            polygon.lower = [0.0; MOST_CORNERS];
            for j in 0..3 {
                polygon.lower[j] = of(values[j]);
                // The function above is nowhere negative.
                polygon.upper[j] = greater(of(values[j]), 0.0) + of(widths[j]);
            }
            let area = of(area);
            let full = Entry::new(&polygon, [0, 1, 2], (area, area * (1.0 + more)));
            let packed = Packed::new(&full).entry();
            for j in 0..3 {
                let (low, high) = (full.lower()[j], full.upper()[j]);
                prop_assert!(packed.lower()[j] <= low && high <= packed.upper()[j]);
                let slack = 1e-6 * (low.abs() + high) + 1e-37;
                let of_width = 0.016 * (high - low);
                let (of_lower, of_upper) = if low < 0.0 { (of_width, 0.0) } else { (0.0, of_width) };
                prop_assert!(low - packed.lower()[j] <= slack + of_lower);
                prop_assert!(packed.upper()[j] - high <= slack + of_upper);
            }
            let ((low, high), (packed_low, packed_high)) = (full.area(), packed.area());
            prop_assert!(packed_low <= low && high <= packed_high);
            prop_assert!(low - packed_low <= 1e-6 * low && packed_high - high <= 1e-6 * high + 0.016 * (high - low));
        }
    }
}
