//! The bar that explains colours.

use crate::image::Image;
use crate::text::{Run, Style};
use crate::ticks::Ticks;
use crate::{Rgb, Scale};

/// Where a figure explains its colours.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LegendSide {
    /// To the right of panels, with values that grow to the top.
    #[default]
    Right,
    /// Under the panels, with values that grow to the right.
    Bottom,
}

/// A bar of colours with numbers and a label.
pub(crate) struct Legend<'a> {
    scale: &'a Scale,
    label: String,
    style: Style,
    side: LegendSide,
    ticks: Ticks,
    /// Pixels along the side of the panels, and along the bar.
    room: f64,
    length: f64,
}

/// In ems: from panels to the bar, the bar, from the bar to numbers, from numbers to the label.
const GAP: f64 = 1.2;
const BAR: f64 = 1.15;
const TICK: f64 = 0.45;
const LABEL_GAP: f64 = 0.7;

/// Lines of numbers and labels, the height of digits, and that of their middle, in ems.
const LINE: f64 = 1.0;
const DIGIT: f64 = 0.73;
const MIDDLE: f64 = 0.36;

/// Part of the room there is that the bar takes.
const PART: f64 = 0.72;

/// Ems from one number to the next at least, over each other, and the most numbers there are.
const SPACING: f64 = 3.2;
const MOST: usize = 8;

/// Ems between numbers beside each other, at least.
const APART: f64 = 1.5;

impl<'a> Legend<'a> {
    /// A legend on a side of panels that has room for so many pixels along them.
    pub(crate) fn new(scale: &'a Scale, label: &str, style: Style, side: LegendSide, room: f64) -> Self {
        let length = (PART * room).floor();
        let ticks = ticks(scale, style, side, length);
        let label =
            [label, &ticks.multiplier].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>();
        Self { scale, label: style.fit(&label.join("   "), room), style, side, ticks, room, length }
    }

    /// Pixels it takes from panels.
    pub(crate) fn thickness(&self) -> f64 {
        let em = self.style.size;
        let label = if self.label.is_empty() { 0.0 } else { LABEL_GAP + LINE };
        let numbers = match self.side {
            LegendSide::Right => widest(&self.ticks, self.style),
            LegendSide::Bottom => DIGIT * em,
        };
        (GAP + BAR + TICK + label) * em + numbers
    }

    /// The colour at a part of the bar.
    fn color(&self, part: f64) -> Rgb {
        match self.scale.classes().len() {
            0 => {
                let (low, high) = self.scale.range();
                self.scale.color(low * (1.0 - part) + high * part)
            }
            ends => self.scale.class_color(((part * (ends + 1) as f64) as usize).min(ends)),
        }
    }

    /// Draws it into the part of the picture whose upper left corner is at `at`.
    pub(crate) fn draw(&self, image: &mut Image, at: [f64; 2]) {
        let (em, start) = (self.style.size, (0.5 * (self.room - self.length)).floor());
        let [near, far] = [GAP, GAP + BAR].map(|ems| (ems * em + 0.5).floor());
        // From places along and across the bar to places in the picture.
        let place = |along: f64, across: f64| match self.side {
            LegendSide::Right => [at[0] + across, at[1] + start + self.length - along],
            LegendSide::Bottom => [at[0] + start + along, at[1] + across],
        };
        for step in 0..self.length as usize {
            let color = self.color((step as f64 + 0.5) / self.length);
            fill(image, place(step as f64, near), place(step as f64 + 1.0, far), color);
        }
        for (i, (&value, text)) in self.ticks.values.iter().zip(&self.ticks.texts).enumerate() {
            // Ends of classes stand at one distance from each other.
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
        // The baseline of the label is above the lower end of its line, where letters such as g go.
        let label = self.thickness() - 0.22 * em;
        let [x, y] = place(0.5 * self.length, label);
        match self.side {
            LegendSide::Right => self.style.draw(image, &self.label, [x, y + half], Run::Up),
            LegendSide::Bottom => self.style.draw(image, &self.label, [x - half, y], Run::Across),
        }
    }
}

/// As many numbers as there is room for.
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

/// Pixels that the longest number takes.
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
            let legend = Legend::new(&scale, "height", STYLE, side, 500.0);
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
        let legend = Legend::new(&scale, "deviation", STYLE, LegendSide::Right, 500.0);
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
    fn numbers_beside_each_other_keep_apart() {
        let scale = Scale::new(ColorMap::Viridis, 0.0, 12_345.678).unwrap();
        for room in [60.0, 200.0, 400.0, 900.0] {
            let legend = Legend::new(&scale, "", STYLE, LegendSide::Bottom, room);
            let each = legend.length / 12_345.678 * legend.ticks.values.get(1).map_or(1e9, |step| *step);
            assert!(each > widest(&legend.ticks, STYLE) + STYLE.size, "{room}: {:?}", legend.ticks.texts);
        }
    }
}
