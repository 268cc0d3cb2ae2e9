//! How much of a piece lies in which class, and what all pieces come to.

use super::super::entry::{Entry, LESS, MORE, Sum};
use super::super::linear::{PartUpTo, greater, lesser};
use super::Bands;

/// The sign of the deviation on a piece.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sign {
    Positive,
    Negative,
    Unknown,
}

/// Least and greatest distance on a piece, each between two bounds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reach {
    pub(super) least: (f64, f64),
    pub(super) greatest: (f64, f64),
    /// Where the piece may meet the other surface, its sign is not known, and its distance is at most this; 0 where it does not.
    pub(super) unsigned: f64,
}

impl Reach {
    /// The signed values that may occur.
    pub(super) fn range(&self, sign: Sign) -> (f64, f64) {
        let least = if self.unsigned > 0.0 { -self.unsigned } else { self.least.0 };
        match sign {
            Sign::Positive => (least, self.greatest.1),
            Sign::Negative => (-self.greatest.1, -least),
            Sign::Unknown => (-self.greatest.1, self.greatest.1),
        }
    }

    /// Bounds on the least and on the greatest signed value.
    fn ends(&self, sign: Sign) -> [(f64, f64); 2] {
        let (low, high) = self.range(sign);
        let Self { least, greatest, .. } = *self;
        match sign {
            // Where the distance is greatest the sign is known.
            Sign::Positive => [(low, least.1), (greatest.0, high)],
            Sign::Negative => [(low, -greatest.0), (-least.1, high)],
            Sign::Unknown => [(low, least.1), (-least.1, high)],
        }
    }

    /// The class, if there is only one.
    pub(super) fn class(&self, sign: Sign, bands: &Bands) -> Option<usize> {
        let (low, high) = self.range(sign);
        let class = bands.class(low);
        (class == bands.class(high)).then_some(class)
    }
}

/// Sums over pieces.
#[derive(Clone, Debug)]
pub(super) struct Tally {
    pub(super) classes: Vec<Sum>,
    pub(super) area: Sum,
    pub(super) lowest: (f64, f64),
    pub(super) highest: (f64, f64),
    /// Area whose class is not known, rounded.
    pub(super) doubt: f64,
}

impl Tally {
    pub(super) fn new(bands: &Bands) -> Self {
        Self {
            classes: vec![Sum::default(); bands.edges().len() + 1],
            area: Sum::default(),
            lowest: (f64::INFINITY, f64::INFINITY),
            highest: (f64::NEG_INFINITY, f64::NEG_INFINITY),
            doubt: 0.0,
        }
    }

    pub(super) fn add(&mut self, other: &Self) {
        for (sum, more) in self.classes.iter_mut().zip(&other.classes) {
            *sum = sum.plus(*more);
        }
        self.area = self.area.plus(other.area);
        self.widen(other.lowest, other.highest);
        self.doubt += other.doubt;
    }

    /// Values that a piece reaches.
    pub(super) fn reach(&mut self, reach: &Reach, sign: Sign) {
        let [lowest, highest] = reach.ends(sign);
        self.widen(lowest, highest);
    }

    fn widen(&mut self, lowest: (f64, f64), highest: (f64, f64)) {
        self.lowest = (lesser(self.lowest.0, lowest.0), lesser(self.lowest.1, lowest.1));
        self.highest = (greater(self.highest.0, highest.0), greater(self.highest.1, highest.1));
    }

    /// An area that lies in one class.
    pub(super) fn whole(&mut self, class: usize, (low, high): (f64, f64)) {
        self.area.add(low, high);
        self.classes[class].add(low, high);
    }

    /// An area whose values lie in a range and nothing else is known.
    pub(super) fn anywhere(&mut self, (from, to): (f64, f64), bands: &Bands, (low, high): (f64, f64)) {
        self.area.add(low, high);
        for class in bands.class(from)..=bands.class(to) {
            self.classes[class].add(0.0, high);
        }
        self.doubt += high;
    }

    /// A triangle of a piece, class by class. Where the distance may be no greater than `touching`, a sign does not hold.
    pub(super) fn entry(&mut self, entry: &Entry, sign: Sign, touching: f64, bands: &Bands) {
        let (low, high) = entry.area();
        self.area.add(low, high);
        let (below, above) = (PartUpTo::new(entry.lower()), PartUpTo::new(entry.upper()));
        let unsigned = below.above(touching);
        let mut before = (0.0, 0.0);
        for (class, sum) in self.classes.iter_mut().enumerate() {
            let up_to = match bands.edges().get(class) {
                Some(edge) => part_up_to(*edge, class == 0, sign, unsigned, &below, &above),
                None => (1.0, 1.0),
            };
            let least = greater(up_to.0 - before.1, 0.0);
            let most = lesser(greater(up_to.1 - before.0, 0.0), 1.0);
            sum.add(low * least * LESS, high * most * MORE);
            self.doubt += high * (most - least) * 0.5;
            before = up_to;
        }
    }
}

/// Bounds on the part of a triangle where the signed value is at most `edge`, or less than that. The distance lies between two
/// functions; on a part of at most `unsigned` the sign is not known.
fn part_up_to(
    edge: f64,
    strictly: bool,
    sign: Sign,
    unsigned: f64,
    below: &PartUpTo,
    above: &PartUpTo,
) -> (f64, f64) {
    // The part with a distance of at most a level, or less than that: the function above decides what certainly is.
    let within = |level: f64, strictly: bool| {
        if level < 0.0 || strictly && level == 0.0 {
            return (0.0, 0.0);
        }
        let at = if strictly { level.next_down() } else { level };
        (above.below(at), below.above(level))
    };
    let rest = |(low, high): (f64, f64)| {
        // Nothing and all of it leave no rounding.
        let is_exact = |x: f64| x == 0.0 || x == 1.0;
        let least = if is_exact(high) { 1.0 - high } else { greater((1.0 - high).next_down(), 0.0) };
        let most = if is_exact(low) { 1.0 - low } else { (1.0 - low).next_up() };
        (least, most)
    };
    let positive = within(edge, strictly);
    // A value of -d is at most the edge where d is not less than its size.
    let negative = rest(within(-edge, !strictly));
    match sign {
        // Either sign makes a value smaller or greater than the one that is known.
        Sign::Positive => {
            (positive.0, lesser((positive.1 + unsigned).next_up(), greater(positive.1, negative.1)))
        }
        Sign::Negative => {
            (greater((negative.0 - unsigned).next_down(), lesser(positive.0, negative.0)), negative.1)
        }
        Sign::Unknown => (lesser(positive.0, negative.0), greater(positive.1, negative.1)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where the distance is known, the parts are those of a linear function.
    #[test]
    fn parts_of_a_linear_function() {
        // From 0 to 1 along one edge: a quarter of the area is up to one half.
        let part = PartUpTo::new([0.0, 0.0, 1.0]);
        let of = |edge: f64, sign: Sign| part_up_to(edge, false, sign, 0.0, &part, &part);
        let near = |(low, high): (f64, f64), value: f64| low <= value && value <= high && high - low < 1e-12;
        assert!(near(of(0.5, Sign::Positive), 0.75) && near(of(-0.5, Sign::Positive), 0.0));
        assert!(near(of(-0.5, Sign::Negative), 0.25) && near(of(0.5, Sign::Negative), 1.0));
        // A tenth of it may be on the other side.
        let (low, high) = part_up_to(-0.5, false, Sign::Negative, 0.1, &part, &part);
        assert!((low - 0.15).abs() < 1e-12 && (high - 0.25).abs() < 1e-12);
        let (low, high) = of(0.5, Sign::Unknown);
        assert!((low - 0.75).abs() < 1e-12 && (high - 1.0).abs() < 1e-12);
    }

    #[test]
    fn ends_belong_to_the_class_below_and_the_first_to_its_own() {
        let flat = PartUpTo::new([0.5; 3]);
        let of = |edge: f64, strictly, sign| part_up_to(edge, strictly, sign, 0.0, &flat, &flat);
        assert_eq!(of(0.5, false, Sign::Positive), (1.0, 1.0));
        assert_eq!(of(0.5, true, Sign::Positive).0, 0.0);
        assert_eq!(of(-0.5, false, Sign::Negative).1, 1.0);
        assert_eq!(of(-0.5, true, Sign::Negative).0, 0.0);
    }
}
