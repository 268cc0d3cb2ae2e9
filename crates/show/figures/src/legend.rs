//! The colour bar.

use crate::image::Image;
use crate::text::{Run, Style};
use crate::ticks::Ticks;
use crate::{Rgb, Scale};

/// Where a figure has its colour bar.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LegendSide {
    /// To the right of the panels, with values increasing upwards.
    #[default]
    Right,
    /// Under the panels, with values increasing to the right.
    Bottom,
}

/// The distribution of values: shares in equal parts of the colour bar, from its lower end.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Histogram {
    pub(crate) name: String,
    pub(crate) shares: Vec<f64>,
}

/// A colour bar with numbers and a label, and histograms beside it.
pub(crate) struct Legend<'a> {
    scale: &'a Scale,
    histograms: &'a [Histogram],
    label: String,
    style: Style,
    side: LegendSide,
    ticks: Ticks,
    /// Pixels available along the side of the panels, which is the direction of the bar.
    room: f64,
    length: f64,
}

/// In ems: the gap between the panels and the first item, the width of the bar, and the gaps before numbers and label.
const GAP: f64 = 1.2;
const BAR: f64 = 1.15;
const TICK: f64 = 0.45;
const LABEL_GAP: f64 = 0.7;

/// In ems: the longest column of a histogram and the gap beside it; the size of its name relative to text.
const COLUMN: f64 = 3.9;
const COLUMN_GAP: f64 = 0.4;
const NAME: f64 = 0.85;

/// Colour of histogram columns: a grey that is visible on light and on dark pictures.
const COLUMN_COLOR: Rgb = [138, 142, 148];

/// Columns at least this many pixels wide are separated by an empty pixel.
const NARROW: f64 = 4.0;

/// In ems: the height of lines of numbers and labels, of digits, and of the middle of digits.
const LINE: f64 = 1.0;
const DIGIT: f64 = 0.73;
const MIDDLE: f64 = 0.36;

/// Share of the available length that the bar takes.
const PART: f64 = 0.72;

/// Smallest distance in ems of numbers above each other, and the largest number of numbers.
const SPACING: f64 = 3.2;
const MOST: usize = 8;

/// Smallest gap in ems between numbers beside each other.
const APART: f64 = 1.5;

impl<'a> Legend<'a> {
    /// A legend for a side of the panels with this length in pixels.
    pub(crate) fn new(
        (scale, label): (&'a Scale, &str),
        histograms: &'a [Histogram],
        style: Style,
        side: LegendSide,
        room: f64,
    ) -> Self {
        let length = (PART * room).floor();
        let ticks = ticks(scale, style, side, length);
        let label =
            [label, &ticks.multiplier].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>();
        let label = style.fit(&label.join("   "), room);
        Self { scale, histograms, label, style, side, ticks, room, length }
    }

    /// Ems between the panels and the bar.
    fn bar(&self) -> f64 {
        GAP + self.histograms.len() as f64 * (COLUMN + COLUMN_GAP)
    }

    /// Pixels that the legend takes from the panels.
    pub(crate) fn thickness(&self) -> f64 {
        let em = self.style.size;
        let label = if self.label.is_empty() { 0.0 } else { LABEL_GAP + LINE };
        let numbers = match self.side {
            LegendSide::Right => widest(&self.ticks, self.style),
            LegendSide::Bottom => DIGIT * em,
        };
        (self.bar() + BAR + TICK + label) * em + numbers
    }

    /// The colour at a position along the bar.
    fn color(&self, part: f64) -> Rgb {
        match self.scale.classes().len() {
            0 => {
                let (low, high) = self.scale.range();
                self.scale.color(low * (1.0 - part) + high * part)
            }
            ends => self.scale.class_color(((part * (ends + 1) as f64) as usize).min(ends)),
        }
    }

    /// Draws the legend into the part of the picture whose upper left corner is at `at`.
    pub(crate) fn draw(&self, image: &mut Image, at: [f64; 2]) {
        let (em, start) = (self.style.size, (0.5 * (self.room - self.length)).floor());
        let [near, far] = [self.bar(), self.bar() + BAR].map(|ems| (ems * em + 0.5).floor());
        // Converts positions along and across the bar to pixels.
        let place = |along: f64, across: f64| match self.side {
            LegendSide::Right => [at[0] + across, at[1] + start + self.length - along],
            LegendSide::Bottom => [at[0] + start + along, at[1] + across],
        };
        for (i, histogram) in self.histograms.iter().enumerate() {
            let base = GAP + COLUMN + i as f64 * (COLUMN + COLUMN_GAP);
            self.draw_histogram(image, histogram, (base * em).floor(), &place);
        }
        for step in 0..self.length as usize {
            let color = self.color((step as f64 + 0.5) / self.length);
            fill(image, place(step as f64, near), place(step as f64 + 1.0, far), color);
        }
        for (i, (&value, text)) in self.ticks.values.iter().zip(&self.ticks.texts).enumerate() {
            // Class boundaries are drawn at equal distances.
            let part = match self.scale.classes().len() {
                0 => self.scale.place(value),
                ends => (i + 1) as f64 / (ends + 1) as f64,
            };
            let along = (self.length * part - 0.5).floor();
            fill(image, place(along, far), place(along + 1.0, far + (0.25 * em).ceil()), self.style.color);
            let [x, y] = place(along + 0.5, far + TICK * em);
            let text_at = match self.side {
                LegendSide::Right => [x, y + MIDDLE * em],
                LegendSide::Bottom => [x - 0.5 * self.style.width(text), y + DIGIT * em],
            };
            self.style.draw(image, text, text_at, Run::Across);
        }
        let half = 0.5 * self.style.width(&self.label);
        // The baseline of the label is above the lower end of its line, to leave room for descenders.
        let label = self.thickness() - 0.22 * em;
        let [x, y] = place(0.5 * self.length, label);
        match self.side {
            LegendSide::Right => self.style.draw(image, &self.label, [x, y + half], Run::Up),
            LegendSide::Bottom => self.style.draw(image, &self.label, [x - half, y], Run::Across),
        }
    }
}

impl Legend<'_> {
    /// Columns that extend from a base across the bar towards the panels, and the name at the end of the bar.
    fn draw_histogram(
        &self,
        image: &mut Image,
        Histogram { name, shares }: &Histogram,
        base: f64,
        place: &dyn Fn(f64, f64) -> [f64; 2],
    ) {
        let em = self.style.size;
        let highest = shares.iter().fold(0.0, |highest: f64, share| highest.max(*share));
        let each = self.length / shares.len() as f64;
        let free = if each > NARROW { 1.0 } else { 0.0 };
        for (i, share) in shares.iter().enumerate().filter(|(_, share)| **share > 0.0) {
            // Square roots, so that small shares remain visible, as on pages.
            let long = (COLUMN * em * (share / highest).sqrt()).ceil();
            let [from, to] = [i, i + 1].map(|i| (i as f64 * each).floor());
            fill(image, place(from, base - long), place(to - free, base), COLUMN_COLOR);
        }
        let style = Style { size: NAME * em, ..self.style };
        match self.side {
            LegendSide::Right => {
                let name = style.fit(name, (COLUMN + COLUMN_GAP) * em);
                let [x, y] = place(self.length + 0.5 * em, base);
                style.draw(image, &name, [x - style.width(&name), y], Run::Across);
            }
            LegendSide::Bottom => {
                let name = style.fit(name, 0.5 * (self.room - self.length) - 0.5 * em);
                let [x, y] = place(-0.5 * em, base);
                style.draw(image, &name, [x - style.width(&name), y], Run::Across);
            }
        }
    }
}

/// As many ticks as fit.
fn ticks(scale: &Scale, style: Style, side: LegendSide, length: f64) -> Ticks {
    if !scale.classes().is_empty() {
        return Ticks::at(scale.classes());
    }
    let (low, high) = scale.range();
    let most = (length / (SPACING * style.size)).clamp(2.0, MOST as f64) as usize;
    let fits = |ticks: &Ticks| match side {
        LegendSide::Right => true,
        LegendSide::Bottom => {
            let each = length * (scale.place(ticks.values[1]) - scale.place(ticks.values[0]));
            each > widest(ticks, style) + APART * style.size
        }
    };
    let numbers = (2..=most).rev().map(|count| Ticks::new(low, high, count));
    let chosen = numbers.into_iter().find(|ticks| ticks.values.len() < 2 || fits(ticks));
    chosen.unwrap_or_else(|| {
        let mut ticks = Ticks::new(low, high, 2);
        ticks.values.truncate(1);
        ticks.texts.truncate(1);
        ticks
    })
}

/// The width of the longest number in pixels.
fn widest(ticks: &Ticks, style: Style) -> f64 {
    let widths = ticks.texts.iter().map(|text| style.width(text));
    widths.fold(0.0, |widest: f64, width| if width > widest { width } else { widest })
}

/// Fills the rectangle between two opposite corners.
fn fill(image: &mut Image, [a, b]: [f64; 2], [c, d]: [f64; 2], color: Rgb) {
    let order = |p: f64, q: f64| if p < q { [p, q] } else { [q, p] };
    let ([left, right], [top, bottom]) = (order(a, c), order(b, d));
    image.fill([left, top], [right, bottom], color);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ColorMap;
    use crate::text::Weight;

    const STYLE: Style = Style { weight: Weight::Regular, size: 16.0, color: [0, 0, 0] };

    #[test]
    fn bars_show_the_scale_from_end_to_end() {
        let scale = Scale::new(ColorMap::Viridis, -1.0, 1.0).unwrap().with_limit(0.75);
        for side in [LegendSide::Right, LegendSide::Bottom] {
            let legend = Legend::new((&scale, "height"), &[], STYLE, side, 500.0);
            let mut image = Image::filled(500, 500, [255; 3]);
            legend.draw(&mut image, [0.0, 0.0]);
            let across = (1.7 * STYLE.size) as u32;
            let bar: Vec<Rgb> = (0..500)
                .filter_map(|along| match side {
                    LegendSide::Right => image.pixel(across, 499 - along),
                    LegendSide::Bottom => image.pixel(along, across),
                })
                .filter(|&color| color != [255; 3])
                .collect();
            assert_eq!(bar.len(), 360, "{side:?}");
            let red = ColorMap::Viridis.contrast();
            assert_eq!(bar.iter().map(|&color| color == red).collect::<Vec<_>>(), {
                (0..360).map(|i| !(45..315).contains(&i)).collect::<Vec<_>>()
            });
            assert_eq!(bar[180], scale.color(1.0 / 360.0), "{side:?}");
        }
    }

    #[test]
    fn classes_take_equal_parts_of_the_bar() {
        let scale = Scale::new(ColorMap::Vik, -1.0, 1.0).unwrap().with_classes(&[-0.05, 0.1]).unwrap();
        let legend = Legend::new((&scale, "deviation"), &[], STYLE, LegendSide::Right, 500.0);
        assert_eq!(legend.ticks.texts, ["−0.05", "0.1"]);
        let mut image = Image::filled(500, 500, [255; 3]);
        legend.draw(&mut image, [0.0, 0.0]);
        let across = (1.7 * STYLE.size) as u32;
        let bar: Vec<Rgb> =
            (0..500).rev().filter_map(|y| image.pixel(across, y)).filter(|c| *c != [255; 3]).collect();
        assert_eq!(bar.len(), 360);
        assert!(bar.iter().enumerate().all(|(i, color)| *color == scale.class_color(i / 120)));
    }

    #[test]
    fn histograms_stand_beside_the_bar_with_columns_as_long_as_roots_of_shares() {
        let scale = Scale::new(ColorMap::Viridis, 0.0, 1.0).unwrap();
        let shares = vec![0.16, 0.0, 0.64, 0.04, f64::NAN];
        let histograms = [Histogram { name: String::new(), shares }];
        for side in [LegendSide::Right, LegendSide::Bottom] {
            let legend = Legend::new((&scale, ""), &histograms, STYLE, side, 500.0);
            let alone = Legend::new((&scale, ""), &[], STYLE, side, 500.0);
            let wider = legend.thickness() - alone.thickness();
            assert!((wider - (COLUMN + COLUMN_GAP) * STYLE.size).abs() < 1e-9, "{wider}");
            let mut image = Image::filled(500, 500, [255; 3]);
            legend.draw(&mut image, [0.0, 0.0]);
            // In the middle of each fifth of the bar, which is 360 pixels long.
            let lengths = [0, 1, 2, 3, 4].map(|i| {
                let along = 70 + 36 + 72 * i;
                let pixels = (0..500).filter_map(|across| match side {
                    LegendSide::Right => image.pixel(across, 499 - along),
                    LegendSide::Bottom => image.pixel(along, across),
                });
                pixels.filter(|color| *color == COLUMN_COLOR).count() as f64
            });
            for (length, part) in lengths.into_iter().zip([0.5, 0.0, 1.0, 0.25, 0.0]) {
                assert!((length - part * COLUMN * STYLE.size).abs() <= 1.0, "{side:?}: {lengths:?}");
            }
        }
    }

    #[test]
    fn numbers_beside_each_other_keep_apart() {
        let scale = Scale::new(ColorMap::Viridis, 0.0, 12_345.678).unwrap();
        for room in [60.0, 200.0, 400.0, 900.0] {
            let legend = Legend::new((&scale, ""), &[], STYLE, LegendSide::Bottom, room);
            let each = legend.length / 12_345.678 * legend.ticks.values.get(1).map_or(1e9, |step| *step);
            assert!(each > widest(&legend.ticks, STYLE) + STYLE.size, "{room}: {:?}", legend.ticks.texts);
        }
    }
}
