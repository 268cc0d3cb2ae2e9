//! A deviation on paper.

use super::page::{DeviationFigures, DeviationPage, four_digits, percent};
use crate::deviation::{DirectedDeviation, Region};
use crate::digits::{self, percentage};
use crate::report::{Direction, Enclosure};
use pompeiu_figures::names::name;
use pompeiu_figures::page::Bounds;
use pompeiu_figures::paper::{Block, Document, Paper};
use pompeiu_figures::{FigureError, Theme, View};

/// Pixels of the picture: about 200 to an inch of an A4 page.
const PICTURE: [u32; 2] = [1400, 600];
/// Regions listed of each direction.
const REGIONS: usize = 5;

impl DeviationFigures<'_> {
    /// The same for printing: the verdict, a picture of both surfaces with its legend, the numbers, the worst regions, and what was
    /// measured with what.
    ///
    /// `verdict` is a sentence above all in place of that of the analysis; `provenance` are names and values, such as the files and their sums.
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
        let of = &self.of;
        // The verdict stands above the picture, as text.
        let untitled = DeviationPage { verdict: None, ..self.of };
        let image = self.drawn_as(&untitled, width, height, Theme::Light, view)?;
        let names = of.shown_names();
        let mut blocks: Vec<Block> = verdict
            .or_else(|| of.verdict.map(|(_, sentence)| sentence.to_owned()))
            .map(Block::Statement)
            .into_iter()
            .collect();
        let caption = format!(
            "Left: {a}, as it should be, coloured by its distance from {b}; what is far is missing there. Right: {b}, as it is, coloured by \
             its distance from {a}; what is far is excess material. The line joins the farthest point and its nearest one. Beside the \
             colours, histograms of both over the area: columns are as long as the roots of the shares.",
            a = names[0],
            b = names[1]
        );
        blocks.push(Block::Picture { image, caption });
        blocks.push(Block::Heading("How far, over the area".to_owned()));
        blocks.push(of.numbers(names));
        if let Some(bands) = of.bands {
            blocks.push(Block::Heading("Tolerance bands".to_owned()));
            blocks.push(of.classes(&bands.edges, names));
        }
        blocks.push(Block::Heading("Where".to_owned()));
        blocks.push(of.places(names));
        blocks.push(Block::Paragraph(
            "Each number is an interval that is proven to hold the value for all points of all faces of the meshes as stored, rounding \
             included; where both ends agree in the digits shown, one number is shown."
                .to_owned(),
        ));
        if let Some(proof) = of.proof {
            blocks.push(Block::Heading("Proof attached".to_owned()));
            blocks.push(named(proof.rows()));
        }
        blocks.push(Block::Heading("What was measured".to_owned()));
        blocks.push(named(provenance.to_vec()));
        Ok(Document {
            title: format!("Deviation of {} and {}", name(of.paths[0]), name(of.paths[1])),
            blocks,
            footer: format!("pompeiu {}", env!("CARGO_PKG_VERSION")),
            paper,
        })
    }
}

impl DeviationPage<'_> {
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
        if both.iter().any(|directed| directed.signed.is_some()) {
            row("signed mean: negative is inside", &|directed| Some(directed.signed?.mean.shown()));
            row("standard deviation", &|directed| Some(brief(directed.signed?.standard_deviation)));
            row("most inside", &|directed| Some(directed.signed?.lowest.shown()));
            row("most outside", &|directed| Some(directed.signed?.highest.shown()));
        }
        if let Some(threshold) = self.threshold {
            row(&format!("share of the area beyond {threshold}"), &|directed| {
                let share = directed.statistics.as_ref()?.above.as_ref()?.share;
                Some(percentage(share.lower(), share.upper()))
            });
        }
        let columns = vec![
            (format!("distance{unit}"), 1.2),
            (format!("{a} to {b}: material missing"), 1.4),
            (format!("{b} to {a}: excess material"), 1.4),
        ];
        Block::Table { columns, rows }
    }

    /// Shares of both areas in each class.
    fn classes(&self, edges: &[f64], [a, b]: [&str; 2]) -> Block {
        let ends: Vec<String> = edges.iter().map(f64::to_string).collect();
        let [there, back] = [Direction::AToB, Direction::BToA].map(|direction| self.shares(direction));
        let cell = |shares: &[Bounds], i: usize| {
            shares.get(i).map_or_else(|| "no area".to_owned(), |[lower, upper]| percentage(*lower, *upper))
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
            (&self.deviation.a_to_b, format!("missing on {b}")),
            (&self.deviation.b_to_a, format!("excess on {b}")),
        ] {
            rows.extend(directed.regions.iter().take(REGIONS).map(|region| place(region, &name)));
        }
        let columns = [("", 1.2), ("largest", 1.0), ("at (x, y, z)", 2.0), ("area", 0.8), ("faces", 0.6)];
        Block::Table { columns: columns.map(|(name, share)| (name.to_owned(), share)).to_vec(), rows }
    }
}

/// Names and values.
fn named(rows: Vec<[String; 2]>) -> Block {
    let columns = vec![(String::new(), 1.0), (String::new(), 4.0)];
    Block::Table { columns, rows: rows.into_iter().map(Vec::from).collect() }
}

/// What the classes between some ends are called, from the lowest.
fn class_names(ends: &[String]) -> Vec<String> {
    let [Some(first), Some(last)] = [ends.first(), ends.last()] else { return Vec::new() };
    let inner = ends.windows(2).map(|ends| format!("{} to {}", ends[0], ends[1]));
    std::iter::once(format!("too low, below {first}"))
        .chain(inner)
        .chain([format!("too high, above {last}")])
        .collect()
}

fn place(region: &Region, name: &str) -> Vec<String> {
    let [x, y, z] = region.witness.from.position.map(four_digits);
    vec![
        name.to_owned(),
        brief(region.peak),
        format!("({x}, {y}, {z})"),
        four_digits(region.area),
        region.faces.len().to_string(),
    ]
}

/// The digits in which the terminal shows it, too.
fn brief(enclosure: Enclosure) -> String {
    digits::brief(enclosure.lower(), enclosure.upper())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_digits_are_short() {
        let shown = [0.0, 1.2, 12_345.678, -6.11437e-19, 0.000_123_46].map(four_digits);
        assert_eq!(shown, ["0", "1.2", "12350", "-6.114e-19", "0.0001235"]);
    }
}
