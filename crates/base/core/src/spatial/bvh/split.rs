//! Where a range of faces is split: between bins along the widest axis, by the surface-area heuristic.
//!
//! # Source
//! Binning centres along the widest axis: `wald_fast_2007`. Sorting short ranges and filling leaves are our changes.

use crate::geom::Aabb;
use crate::geom::point_triangle::LANES;

/// What the builder sorts: a face by the box around it, rounded to single precision. Only the quality of the tree
/// depends on it; the boxes that searches use are taken from the triangles themselves.
#[derive(Clone, Copy)]
pub(super) struct Item {
    /// The unused fourth coordinates hold the low and the high half of the face's index.
    pub(super) bounds: Bounds,
}

/// A box in single precision. The fourth coordinate is unused: it lets loops over four compile to one instruction.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    lower: [f32; 4],
    upper: [f32; 4],
}

impl Bounds {
    const ZERO: Self = Self { lower: [0.0; 4], upper: [0.0; 4] };
    const EMPTY: Self = Self { lower: [f32::INFINITY; 4], upper: [f32::NEG_INFINITY; 4] };

    pub(super) fn of(items: &[Item]) -> Self {
        items.iter().fold(Self::EMPTY, |bounds, item| bounds.union(item.bounds))
    }

    #[inline]
    pub(super) fn union(mut self, other: Self) -> Self {
        self.add(&other);
        self
    }

    #[inline]
    pub(super) fn add(&mut self, other: &Self) {
        for k in 0..4 {
            self.lower[k] = if other.lower[k] < self.lower[k] { other.lower[k] } else { self.lower[k] };
            self.upper[k] = if other.upper[k] > self.upper[k] { other.upper[k] } else { self.upper[k] };
        }
    }

    fn half_area(&self) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|k| self.upper[k] - self.lower[k]);
        x * y + y * z + z * x
    }
}

impl Item {
    pub(super) const NONE: Self = Self { bounds: Bounds::ZERO };

    pub(super) fn new(aabb: &Aabb, face: u32) -> Self {
        let [x, y, z] = aabb.lower.map(|x| x as f32);
        let [u, v, w] = aabb.upper.map(|x| x as f32);
        let (low, high) = ((face & 0xffff) as f32, (face >> 16) as f32);
        Self { bounds: Bounds { lower: [x, y, z, low], upper: [u, v, w, high] } }
    }

    #[inline]
    pub(super) fn face(&self) -> u32 {
        self.bounds.lower[3] as u32 | (self.bounds.upper[3] as u32) << 16
    }

    #[inline]
    fn centre(&self, axis: usize) -> f32 {
        self.bounds.lower[axis] + self.bounds.upper[axis]
    }
}

const BINS: usize = 16;
/// Longer ranges are binned over their box instead of over their centres: slightly coarser, and one pass less.
const EXACT_CENTRES_UP_TO: usize = 512;
/// Ranges no longer than this are sorted.
pub(super) const FEW: usize = 64;
/// From this depth (in nodes) on, splits are at the median, which bounds the depth of the tree for every input.
pub(super) const MEDIAN_BELOW_DEPTH: usize = 24;

/// How a range was split.
pub(super) struct Split {
    /// Items on the left: a multiple of eight.
    pub(super) left: usize,
    /// Approximate boxes of both sides.
    pub(super) bounds: [Bounds; 2],
}

/// Reorders items into two sides.
pub(super) fn split(items: &mut [Item], bounds: &Bounds, depth: usize) -> Split {
    if items.len() <= FEW {
        return split_few(items);
    }
    let (low, high) = if items.len() > EXACT_CENTRES_UP_TO {
        ([0, 1, 2].map(|k| 2.0 * bounds.lower[k]), [0, 1, 2].map(|k| 2.0 * bounds.upper[k]))
    } else {
        range_of_centres(items)
    };
    let (axis, spread) = widest(low, high);
    if depth < MEDIAN_BELOW_DEPTH && spread.is_normal() {
        let scale = BINS as f32 * (1.0 - f32::EPSILON) / spread;
        if let Some((boundary, bounds)) = best_boundary(items, axis, low[axis], scale) {
            let left = partition(items, |item| bin_of(item, axis, low[axis], scale) < boundary);
            return Split { left: align(items, left, axis), bounds };
        }
    }
    let left = (items.len() / 2).next_multiple_of(LANES);
    items.select_nth_unstable_by(left, |a, b| {
        a.centre(axis).total_cmp(&b.centre(axis)).then(a.face().cmp(&b.face()))
    });
    Split { left, bounds: [Bounds::of(&items[..left]), Bounds::of(&items[left..])] }
}

/// The axis along which a box is widest, and how wide.
fn widest(low: [f32; 3], high: [f32; 3]) -> (usize, f32) {
    let axis = (0..3).fold(0, |w, k| if high[k] - low[k] > high[w] - low[w] { k } else { w });
    (axis, high[axis] - low[axis])
}

/// Sorts items along the widest axis, and splits them at the multiple of eight where the boxes cost least, by area times count.
fn split_few(items: &mut [Item]) -> Split {
    let (low, high) = range_of_centres(items);
    let (axis, spread) = widest(low, high);
    let count = items.len();
    // Distinct integer keys: the coordinate along the axis, then the index of the item.
    let scale = if spread.is_normal() { (1 << 24) as f32 / spread } else { 0.0 };
    let mut keys = [i32::MAX; FEW];
    for ((key, item), place) in keys.iter_mut().zip(&*items).zip(0..) {
        *key = (((item.centre(axis) - low[axis]) * scale) as i32) << FEW.ilog2() | place;
    }
    let mut sorted = [Item::NONE; FEW];
    for (ranks, own) in (0..count).step_by(LANES).map(|i| (ranks(&keys, count, i), i..count.min(i + LANES))) {
        for (item, rank) in items[own].iter().zip(ranks) {
            sorted[rank as usize] = *item;
        }
    }
    items.copy_from_slice(&sorted[..count]);

    let eights = count.div_ceil(LANES);
    let mut rights = [Bounds::EMPTY; FEW / LANES + 1];
    for i in (0..eights).rev() {
        rights[i] = rights[i + 1].union(Bounds::of(&items[i * LANES..count.min((i + 1) * LANES)]));
    }
    let (mut best, mut least) = (Split { left: LANES, bounds: [Bounds::EMPTY; 2] }, f32::INFINITY);
    let mut left = Bounds::EMPTY;
    for i in 1..eights {
        left.add(&Bounds::of(&items[(i - 1) * LANES..i * LANES]));
        let cost = left.half_area() * (i * LANES) as f32 + rights[i].half_area() * (count - i * LANES) as f32;
        if cost < least || i == 1 {
            (best, least) = (Split { left: i * LANES, bounds: [left, rights[i]] }, cost);
        }
    }
    best
}

/// How many of the first keys are less than each of eight.
#[inline]
fn ranks(keys: &[i32; FEW], count: usize, first: usize) -> [i32; LANES] {
    let mut own = [0; LANES];
    own.copy_from_slice(&keys[first..first + LANES]);
    let mut ranks = [0; LANES];
    for key in &keys[..count] {
        for lane in 0..LANES {
            ranks[lane] += i32::from(*key < own[lane]);
        }
    }
    ranks
}

/// Range of the doubled box centres (the sums of lower and upper end).
fn range_of_centres(items: &[Item]) -> ([f32; 3], [f32; 3]) {
    let mut low = [f32::INFINITY; 4];
    let mut high = [f32::NEG_INFINITY; 4];
    for Item { bounds, .. } in items {
        for k in 0..4 {
            let c = bounds.lower[k] + bounds.upper[k];
            low[k] = if c < low[k] { c } else { low[k] };
            high[k] = if c > high[k] { c } else { high[k] };
        }
    }
    ([low[0], low[1], low[2]], [high[0], high[1], high[2]])
}

#[inline]
fn bin_of(item: &Item, axis: usize, low: f32, scale: f32) -> usize {
    let bin = ((item.centre(axis) - low) * scale) as usize;
    if bin < BINS { bin } else { BINS - 1 }
}

/// Moves the items that satisfy a predicate to the front; returns how many.
fn partition(items: &mut [Item], on_the_left: impl Fn(&Item) -> bool) -> usize {
    let mut left = 0;
    for i in 0..items.len() {
        // Branch-free, because the outcome is unpredictable.
        let goes_left = on_the_left(&items[i]);
        items.swap(left, i);
        left += usize::from(goes_left);
    }
    left
}

/// Moves the few items at a split that make its left size no multiple of eight; returns the new size.
fn align(items: &mut [Item], left: usize, axis: usize) -> usize {
    let most = (items.len() - 1) / LANES * LANES;
    let aligned = ((left + LANES / 2) / LANES * LANES).clamp(LANES, most);
    for end in (aligned..left).rev() {
        let last =
            (0..=end).fold(0, |m, i| if items[i].centre(axis) > items[m].centre(axis) { i } else { m });
        items.swap(last, end);
    }
    for start in left..aligned {
        let first = (start..items.len())
            .fold(start, |m, i| if items[i].centre(axis) < items[m].centre(axis) { i } else { m });
        items.swap(first, start);
    }
    aligned
}

/// The bin with which the right side of the cheapest split begins, by area times count, and the boxes of both sides; `None` if all
/// items are in one bin.
fn best_boundary(items: &[Item], axis: usize, low: f32, scale: f32) -> Option<(usize, [Bounds; 2])> {
    let mut bins = [(Bounds::EMPTY, 0); BINS];
    for item in items {
        let (bounds, count) = &mut bins[bin_of(item, axis, low, scale)];
        bounds.add(&item.bounds);
        *count += 1;
    }
    let mut rights = [(Bounds::EMPTY, 0.0); BINS];
    let (mut right, mut count) = (Bounds::EMPTY, 0);
    for i in (1..BINS).rev() {
        right.add(&bins[i].0);
        count += bins[i].1;
        rights[i] = (right, if count > 0 { right.half_area() * count as f32 } else { 0.0 });
    }
    let mut best = None;
    let mut least = f32::INFINITY;
    let (mut left, mut count) = (Bounds::EMPTY, 0);
    for i in 1..BINS {
        left.add(&bins[i - 1].0);
        count += bins[i - 1].1;
        if count == 0 || count == items.len() {
            continue;
        }
        let cost = left.half_area() * count as f32 + rights[i].1;
        if best.is_none() || cost < least {
            least = cost;
            best = Some((i, [left, rights[i].0]));
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Whatever the items: none is lost, left sides consist of full leaves, and for short ranges no centre on the left lies
        /// beyond one on the right.
        #[test]
        fn splits_are_partitions(
            points in prop::collection::vec((-1.0..1.0, -2..3_i32, 0.0..1e-30), 9..200)
        ) {
            let boxes = points.iter().map(|&(x, y, z)| Aabb { lower: [x, f64::from(y), z], upper: [x, f64::from(y), z] });
            let mut items: Vec<Item> = boxes.zip(0..).map(|(aabb, face)| Item::new(&aabb, face)).collect();
            let bounds = Bounds::of(&items);
            let (low, high) = range_of_centres(&items);
            let (axis, spread) = widest(low, high);
            let Split { left, .. } = split(&mut items, &bounds, 0);
            prop_assert!(left % LANES == 0 && 0 < left && left < items.len());
            if items.len() <= FEW {
                let greatest = items[..left].iter().map(|item| item.centre(axis)).fold(f32::MIN, f32::max);
                let least = items[left..].iter().map(|item| item.centre(axis)).fold(f32::MAX, f32::min);
                prop_assert!(greatest <= least + 1e-6 * spread);
            }
            let mut faces: Vec<u32> = items.iter().map(Item::face).collect();
            faces.sort_unstable();
            prop_assert!(faces.into_iter().eq(0..points.len() as u32));
        }
    }
}
