//! A deviation on paper.

use super::compose::class_names;
use super::page::{DeviationPage, percent};
use crate::deviation::{DirectedDeviation, Region};
use crate::report::{Direction, Enclosure};
use pompeiu_figures::names::name;
use pompeiu_figures::page::Bounds;
use pompeiu_figures::paper::{Block, Document, Paper};
use pompeiu_figures::{FigureError, Theme, View};

/// Pixels of the picture: about 200 to an inch of an A4 page.
const PICTURE: [u32; 2] = [1400, 600];
/// Regions listed of each direction.
const REGIONS: usize = 5;

impl DeviationPage<'_> {
    /// The same for printing: the verdict, a picture of both surfaces with its legend, the numbers, the worst regions, and what was
    /// measured with what.
    ///
    /// `verdict` is a sentence above all, if there is one; `provenance` are names and values, such as the files and their sums.
    ///
    /// # Errors
    /// [`FigureError`] if the picture cannot be drawn.
    pub fn document(
        &self,
        verdict: Option<String>,
        provenance: &[[String; 2]],
        view: View,
        paper: Paper,
    ) -> Result<Document, FigureError> {
        let [width, height] = PICTURE;
        let image = self.image(width, height, Theme::Light, view)?;
        let names = [self.a.path, self.b.path].map(name);
        let mut blocks: Vec<Block> = verdict.map(Block::Statement).into_iter().collect();
        let caption = format!(
            "Left: {}, as it should be, coloured by its distance from {}; what is far is missing there. Right: {}, as it is, coloured by \
             its distance from {}; what is far was invented. The line joins the farthest point and its nearest one.",
            names[0], names[1], names[1], names[0]
        );
        blocks.push(Block::Picture { image, caption });
        blocks.push(Block::Heading("How far, over the area".to_owned()));
        blocks.push(self.numbers(names));
        if let Some(bands) = self.bands {
            blocks.push(Block::Heading("Tolerance bands".to_owned()));
            blocks.push(self.classes(&bands.edges, names));
        }
        blocks.push(Block::Heading("Where".to_owned()));
        blocks.push(self.places(names));
        blocks.push(Block::Paragraph(
            "Each number is an interval that is proven to hold the value for all points of all faces of the meshes as stored, rounding \
             included; where both ends agree in the digits shown, one number is shown."
                .to_owned(),
        ));
        blocks.push(Block::Heading("What was measured".to_owned()));
        blocks.push(Block::Table {
            columns: vec![(String::new(), 1.0), (String::new(), 4.0)],
            rows: provenance.iter().map(|row| row.to_vec()).collect(),
        });
        Ok(Document {
            title: format!("Deviation of {} and {}", names[0], names[1]),
            blocks,
            footer: format!("pompeiu {}", env!("CARGO_PKG_VERSION")),
            paper,
        })
    }

    fn numbers(&self, [a, b]: [&str; 2]) -> Block {
        let both = [&self.deviation.a_to_b, &self.deviation.b_to_a];
        let unit = if self.unit.is_empty() { String::new() } else { format!(", in {}", self.unit) };
        let mut rows = Vec::new();
        let mut row = |name: &str, cell: &dyn Fn(&DirectedDeviation) -> Option<String>| {
            let [left, right] = both.map(|directed| cell(directed).unwrap_or_else(|| "no area".to_owned()));
            rows.push(vec![name.to_owned(), left, right]);
        };
        row("largest", &|directed| Some(brief(directed.distance.distance)));
        row("mean", &|directed| Some(brief(directed.statistics.as_ref()?.mean)));
        row("root mean square", &|directed| Some(brief(directed.statistics.as_ref()?.rms)));
        let shares =
            both.iter().find_map(|directed| directed.statistics.as_ref()).map(|found| &found.percentiles);
        for (i, percentile) in shares.into_iter().flatten().enumerate() {
            let name = format!("{} % of the area within", percent(percentile.share));
            row(&name, &|directed| Some(brief(directed.statistics.as_ref()?.percentiles.get(i)?.distance)));
        }
        if let Some(threshold) = self.threshold {
            row(&format!("share of the area beyond {threshold}"), &|directed| {
                let share = directed.statistics.as_ref()?.above.as_ref()?.share;
                Some(percentage([share.lower(), share.upper()]))
            });
        }
        let columns = vec![
            (format!("distance{unit}"), 1.2),
            (format!("{a} to {b}: missing"), 1.4),
            (format!("{b} to {a}: invented"), 1.4),
        ];
        Block::Table { columns, rows }
    }

    /// Shares of both areas in each class.
    fn classes(&self, edges: &[f64], [a, b]: [&str; 2]) -> Block {
        let ends: Vec<String> = edges.iter().map(f64::to_string).collect();
        let [there, back] = [Direction::AToB, Direction::BToA].map(|direction| self.shares(direction));
        let cell = |shares: &[Bounds], i: usize| {
            shares.get(i).map_or_else(|| "no area".to_owned(), |share| percentage(*share))
        };
        let row = |(i, name)| vec![name, cell(&there, i), cell(&back, i)];
        let unit = if self.unit.is_empty() { String::new() } else { format!(", in {}", self.unit) };
        let columns = vec![
            (format!("deviation of {b}{unit}"), 1.6),
            (format!("share of {a}'s area"), 1.2),
            (format!("share of {b}'s area"), 1.2),
        ];
        Block::Table { columns, rows: class_names(&ends).into_iter().enumerate().map(row).collect() }
    }

    fn places(&self, [_, b]: [&str; 2]) -> Block {
        let mut rows = Vec::new();
        for (directed, name) in [
            (&self.deviation.a_to_b, format!("missing in {b}")),
            (&self.deviation.b_to_a, format!("invented by {b}")),
        ] {
            rows.extend(directed.regions.iter().take(REGIONS).map(|region| place(region, &name)));
        }
        let columns = [("", 1.2), ("largest", 1.0), ("at (x, y, z)", 2.0), ("area", 0.8), ("faces", 0.6)];
        Block::Table { columns: columns.map(|(name, share)| (name.to_owned(), share)).to_vec(), rows }
    }
}

/// A share of the area in percent, rounded outwards to two decimals.
fn percentage(share: Bounds) -> String {
    let ends = [(share[0] * 1e4).floor() / 1e2, (share[1] * 1e4).ceil() / 1e2];
    if ends[0] == ends[1] { format!("{} %", ends[0]) } else { format!("{} to {} %", ends[0], ends[1]) }
}

fn place(region: &Region, name: &str) -> Vec<String> {
    let [x, y, z] = region.witness.from.position.map(digits);
    vec![
        name.to_owned(),
        brief(region.peak),
        format!("({x}, {y}, {z})"),
        digits(region.area),
        region.faces.len().to_string(),
    ]
}

/// Four digits of what is not claimed to be exact.
fn digits(x: f64) -> String {
    let rounded: f64 = format!("{x:.3e}").parse().unwrap_or(x);
    rounded.to_string()
}

/// One number where both ends agree in five digits, else both with four, rounded away from each other.
fn brief(enclosure: Enclosure) -> String {
    let [lower, upper] = [enclosure.lower(), enclosure.upper()];
    let five = |x: f64| format!("{x:.4e}").parse::<f64>().unwrap_or(x);
    if five(lower) == five(upper) {
        return five(lower).to_string();
    }
    if lower == 0.0 {
        return format!("at most {}", outward(upper, true));
    }
    format!("{} to {}", outward(lower, false), outward(upper, true))
}

/// Four digits of a bound, not below it or not above it.
fn outward(x: f64, up: bool) -> f64 {
    let four = |x: f64| format!("{x:.3e}").parse::<f64>().unwrap_or(x);
    let nearest = four(x);
    if if up { nearest >= x } else { nearest <= x } {
        return nearest;
    }
    // The next number of four digits: of the exponent as it is written.
    let exponent: i32 = format!("{x:e}").split_once('e').and_then(|(_, e)| e.parse().ok()).unwrap_or(0);
    let unit = 10_f64.powi(exponent - 3);
    four(if up { nearest + unit } else { nearest - unit })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_are_rounded_away_from_each_other() {
        let shown = |lower, upper| brief(Enclosure::new(lower, upper).unwrap());
        assert_eq!(shown(0.018_366_3, 0.018_571_9), "0.01836 to 0.01858");
        assert_eq!(shown(0.999_96, 9.999_9), "0.9999 to 10");
        assert_eq!(shown(0.123_451, 0.123_454), "0.12345");
        assert_eq!(shown(0.0, 3.731_1e-3), "at most 0.003732");
    }
}
