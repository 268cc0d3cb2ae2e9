//! At most 256 colours for a picture.

use crate::Rgb;
use rustc_hash::FxHashMap;

/// Colours of a palette at most.
const MOST_COLORS: usize = 256;

/// Bits of each channel by which colours are told apart where there are too many.
const BITS: u32 = 5;

/// The colours of a picture, or near ones where it has more than 256.
///
/// # Source
/// Median cuts: `heckbert_color_1982`.
pub(crate) struct Palette {
    colors: Vec<Rgb>,
    of: Lookup,
}

enum Lookup {
    /// Every colour of the picture is in the palette.
    Exact(FxHashMap<Rgb, u8>),
    /// By the first bits of the channels.
    Near(Vec<u8>),
}

impl Palette {
    pub(crate) fn of(pixels: &[Rgb]) -> Self {
        let mut known = FxHashMap::default();
        let mut colors = Vec::new();
        for &color in pixels {
            let next = colors.len();
            known.entry(color).or_insert_with(|| {
                colors.push(color);
                next as u8
            });
            if colors.len() > MOST_COLORS {
                return Self::of_cuts(pixels);
            }
        }
        Self { colors, of: Lookup::Exact(known) }
    }

    /// The colours; each index of [`Palette::index`] is one of theirs.
    pub(crate) fn colors(&self) -> &[Rgb] {
        &self.colors
    }

    /// The index of the colour that stands for a colour of the picture.
    pub(crate) fn index(&self, color: Rgb) -> u8 {
        match &self.of {
            Lookup::Exact(known) => known.get(&color).copied().unwrap_or(0),
            Lookup::Near(indices) => indices[bin(color)],
        }
    }

    /// Cuts the box of all colours in two, again and again, each time the one with the most pixels times length of its longest side.
    fn of_cuts(pixels: &[Rgb]) -> Self {
        let mut bins = vec![Bin::default(); 1 << (3 * BITS)];
        for &color in pixels {
            let bin = &mut bins[bin(color)];
            bin.pixels += 1;
            (0..3).for_each(|i| bin.sum[i] += u64::from(color[i]));
        }
        let used: Vec<usize> = (0..bins.len()).filter(|b| bins[*b].pixels > 0).collect();
        let mut boxes = vec![ColorBox::of(used, &bins)];
        while boxes.len() < MOST_COLORS {
            let Some(at) =
                (0..boxes.len()).max_by_key(|i| boxes[*i].worth()).filter(|i| boxes[*i].worth() > 0)
            else {
                break;
            };
            let [low, high] = boxes.swap_remove(at).cut(&bins);
            boxes.extend([low, high]);
        }
        let mut indices = vec![0; bins.len()];
        let mut colors = Vec::with_capacity(boxes.len());
        for (i, part) in boxes.iter().enumerate() {
            part.bins.iter().for_each(|b| indices[*b] = i as u8);
            colors.push(part.mean(&bins));
        }
        Self { colors, of: Lookup::Near(indices) }
    }
}

/// The pixels whose colours have the same first bits.
#[derive(Clone, Default)]
struct Bin {
    pixels: u64,
    sum: [u64; 3],
}

/// The number of the bin of a colour.
fn bin(color: Rgb) -> usize {
    color.iter().fold(0, |bin, channel| bin << BITS | usize::from(channel >> (8 - BITS)))
}

fn channel(bin: usize, axis: usize) -> usize {
    bin >> (BITS as usize * (2 - axis)) & ((1 << BITS) - 1)
}

/// Bins within a box.
struct ColorBox {
    bins: Vec<usize>,
    pixels: u64,
    /// The axis along which it is longest, and how long it is there.
    longest: (usize, usize),
}

impl ColorBox {
    fn of(bins: Vec<usize>, all: &[Bin]) -> Self {
        let length = |axis: usize| {
            let values = || bins.iter().map(|b| channel(*b, axis));
            values().max().unwrap_or(0) - values().min().unwrap_or(0)
        };
        let axis = (0..3).max_by_key(|axis| length(*axis)).unwrap_or(0);
        let (pixels, longest) = (bins.iter().map(|b| all[*b].pixels).sum(), (axis, length(axis)));
        Self { bins, pixels, longest }
    }

    fn worth(&self) -> u64 {
        self.pixels * self.longest.1 as u64
    }

    /// Two boxes with about half of the pixels each; both have bins.
    fn cut(mut self, all: &[Bin]) -> [Self; 2] {
        let axis = self.longest.0;
        self.bins.sort_by_key(|b| channel(*b, axis));
        let mut before = 0;
        let middle = self.bins.iter().position(|b| {
            before += all[*b].pixels;
            2 * before >= self.pixels
        });
        let high = self.bins.split_off(middle.unwrap_or(0).clamp(1, self.bins.len() - 1));
        [Self::of(self.bins, all), Self::of(high, all)]
    }

    fn mean(&self, all: &[Bin]) -> Rgb {
        std::array::from_fn(|i| {
            let sum: u64 = self.bins.iter().map(|b| all[*b].sum[i]).sum();
            ((sum + self.pixels / 2) / self.pixels.max(1)) as u8
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_colours_stay_and_many_come_near() {
        let few: Vec<Rgb> = (0..=255).map(|i| [i, 7, 255 - i]).collect();
        let palette = Palette::of(&few);
        assert!(few.iter().all(|color| palette.colors()[usize::from(palette.index(*color))] == *color));
        let many: Vec<Rgb> =
            (0..64_u8).flat_map(|i| (0..64_u8).map(move |j| [4 * i, 4 * j, 2 * i + j])).collect();
        let palette = Palette::of(&many);
        assert_eq!(palette.colors().len(), 256);
        let worst = many.iter().map(|color| {
            let near = palette.colors()[usize::from(palette.index(*color))];
            (0..3).map(|i| near[i].abs_diff(color[i])).max().unwrap_or(0)
        });
        assert!(worst.max() <= Some(24), "a sixteenth of the range on each side, and a bin");
        let one = vec![[1, 2, 3]; 9];
        assert_eq!(Palette::of(&one).colors(), [[1, 2, 3]]);
    }
}
