//! The bar that explains colours.

use crate::Scale;
use crate::image::Image;
use crate::text::{Run, Style};
use crate::ticks::Ticks;

/// A bar of colours with numbers and a label, which goes to the right of panels.
pub(crate) struct Legend<'a> {
    scale: &'a Scale,
    label: String,
    style: Style,
    ticks: Ticks,
}

/// In ems: from panels to the bar, the bar, from the bar to numbers, from numbers to the label.
const GAP: f64 = 1.2;
const BAR: f64 = 1.15;
const TICK: f64 = 0.45;
const LABEL_GAP: f64 = 0.7;

/// Part of the height there is that the bar takes.
const PART: f64 = 0.72;

/// Ems from one number to the next, at least.
const SPACING: f64 = 3.2;

impl<'a> Legend<'a> {
    pub(crate) fn new(scale: &'a Scale, label: &str, style: Style, height: f64) -> Self {
        let (low, high) = scale.range();
        let count = (PART * height / (SPACING * style.size)).clamp(1.0, 8.0) as usize;
        let ticks = Ticks::new(low, high, count);
        let label =
            [label, &ticks.multiplier].into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>();
        Self { scale, label: style.fit(&label.join("   "), height), style, ticks }
    }

    fn numbers(&self) -> f64 {
        let widths = self.ticks.texts.iter().map(|text| self.style.width(text));
        widths.fold(0.0, |widest: f64, width| if width > widest { width } else { widest })
    }

    /// Pixels it takes from panels.
    pub(crate) fn width(&self) -> f64 {
        let label = if self.label.is_empty() { 0.0 } else { LABEL_GAP + 1.0 };
        (GAP + BAR + TICK + label) * self.style.size + self.numbers()
    }

    /// Draws it into the part of the picture that starts at `at`.
    pub(crate) fn draw(&self, image: &mut Image, at: [f64; 2], height: f64) {
        let em = self.style.size;
        let left = (at[0] + GAP * em + 0.5).floor();
        let right = left + (BAR * em + 0.5).floor();
        let length = (PART * height).floor();
        let top = (at[1] + 0.5 * (height - length)).floor();
        let (low, high) = self.scale.range();
        let rows = length as usize;
        for row in 0..rows {
            let part = (rows - row) as f64 - 0.5;
            let part = part / rows as f64;
            let value = low * (1.0 - part) + high * part;
            let y = top + row as f64;
            image.fill([left, y], [right, y + 1.0], self.scale.color(value));
        }
        for (&value, text) in self.ticks.values.iter().zip(&self.ticks.texts) {
            let y = (top + length * (1.0 - self.scale.place(value))).floor();
            image.fill([right, y], [right + (0.25 * em).ceil(), y + 1.0], self.style.color);
            // The middle of digits is 0.36 em over their baseline.
            self.style.draw(image, text, [right + TICK * em, y + 0.36 * em], Run::Across);
        }
        let across = right + (TICK + LABEL_GAP + 0.78) * em + self.numbers();
        let middle = top + 0.5 * (length + self.style.width(&self.label));
        self.style.draw(image, &self.label, [across, middle], Run::Up);
    }
}
