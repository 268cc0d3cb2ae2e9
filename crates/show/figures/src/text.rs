//! Text: one embedded typeface in two weights.
//!
//! # Source
//! Inter by Rasmus Andersson, SIL Open Font License 1.1 (`fonts/LICENSE-Inter`), reduced to Latin, Greek, digits and the signs that
//! figures need.

use crate::{Rgb, image::Image};
use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont, point};

/// Font weight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Weight {
    Regular,
    SemiBold,
}

/// A weight at a size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Style {
    pub(crate) weight: Weight,
    /// Pixels per em.
    pub(crate) size: f64,
    pub(crate) color: Rgb,
}

/// Direction of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Run {
    /// To the right.
    Across,
    /// Upwards, with letters rotated to the left.
    Up,
}

impl Style {
    fn font(self) -> Option<FontRef<'static>> {
        let bytes: &'static [u8] = match self.weight {
            Weight::Regular => include_bytes!("../fonts/Inter-Regular.ttf"),
            Weight::SemiBold => include_bytes!("../fonts/Inter-SemiBold.ttf"),
        };
        FontRef::try_from_slice(bytes).ok()
    }

    /// The glyphs of a line that starts at the origin, and its width.
    fn lay_out(self, font: &FontRef, text: &str) -> (Vec<Glyph>, f64) {
        let em = font.units_per_em().unwrap_or(1.0);
        let scale = PxScale::from(self.size as f32 * font.height_unscaled() / em);
        let scaled = font.as_scaled(scale);
        let mut at = 0.0;
        let glyphs = text.chars().map(|character| {
            let id = scaled.glyph_id(if character.is_control() { ' ' } else { character });
            let glyph = id.with_scale_and_position(scale, point(at, 0.0));
            at += scaled.h_advance(id);
            glyph
        });
        (glyphs.collect(), f64::from(at))
    }

    /// Width of a line of text in pixels.
    pub(crate) fn width(self, text: &str) -> f64 {
        self.font().map_or(0.0, |font| self.lay_out(&font, text).1)
    }

    /// The text, shortened with an ellipsis to fit into a width.
    pub(crate) fn fit(self, text: &str, width: f64) -> String {
        if self.width(text) <= width {
            return text.to_owned();
        }
        let mut kept: Vec<char> = text.chars().collect();
        while kept.pop().is_some() {
            let shorter: String = kept.iter().collect::<String>().trim_end().to_owned() + "…";
            if self.width(&shorter) <= width {
                return shorter;
            }
        }
        String::new()
    }

    /// Draws a line of text with the start of its baseline at `at`.
    ///
    /// `at` is in pixels from the upper left corner of the picture. It is rounded to whole pixels, which keeps letters sharp.
    pub(crate) fn draw(self, image: &mut Image, text: &str, at: [f64; 2], run: Run) {
        let Some(font) = self.font() else { return };
        let [x, y] = at.map(|c| (c + 0.5).floor() as i64);
        for glyph in self.lay_out(&font, text).0 {
            let Some(outline) = font.outline_glyph(glyph) else { continue };
            let corner = outline.px_bounds().min;
            let [left, top] = [corner.x, corner.y].map(|c| c.floor() as i64);
            outline.draw(|column, row, coverage| {
                let (across, down) = (left + i64::from(column), top + i64::from(row));
                let [px, py] = match run {
                    Run::Across => [x + across, y + down],
                    Run::Up => [x + down, y - across],
                };
                image.blend(px, py, self.color, f64::from(coverage).clamp(0.0, 1.0));
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STYLE: Style = Style { weight: Weight::Regular, size: 20.0, color: [0, 0, 0] };

    #[test]
    fn the_typefaces_have_what_figures_need() {
        for weight in [Weight::Regular, Weight::SemiBold] {
            let font = Style { weight, ..STYLE }.font().unwrap();
            for character in
                "AZaz09 .,:;()[]/+−×·=<>≤≥≈≠±°µαβγδεθλμπσφωΔΩ∞√∂∑∫→←↔…–—“”‘’′″⁰¹²³⁴⁵⁶⁷⁸⁹⁻₀₁₂ÄÖÜäöüßéñçø"
                    .chars()
            {
                assert_ne!(font.glyph_id(character).0, 0, "{character} in {weight:?}");
            }
        }
    }

    #[test]
    fn text_is_cut_to_the_room_there_is() {
        assert_eq!(STYLE.fit("deviation", 500.0), "deviation");
        let cut = STYLE.fit("deviation from the other mesh", 120.0);
        assert!(cut.starts_with("dev") && cut.ends_with('…') && STYLE.width(&cut) <= 120.0, "{cut}");
        assert_eq!(STYLE.fit("deviation", 1.0), "");
        assert!(STYLE.width("mm") > STYLE.width("m"));
    }

    #[test]
    fn text_that_runs_up_is_text_that_runs_across_turned() {
        let draw = |at, run| {
            let mut image = Image::filled(60, 60, [255; 3]);
            STYLE.draw(&mut image, "Rg1", at, run);
            image
        };
        let [across, up] = [draw([5.0, 30.0], Run::Across), draw([30.0, 54.0], Run::Up)];
        let turned = |x: u32, y: u32| up.pixel(y, 59 - x);
        assert!((0..60).all(|y| (0..60).all(|x| across.pixel(x, y) == turned(x, y))));
        assert!(across.pixels().contains(&[0; 3]), "the inside of a letter is covered in full");
    }
}
