//! A deviation on paper.

use super::page::{DeviationFigures, DeviationPage, four_digits, percent};
use crate::deviation::{DirectedDeviation, Region};
use crate::digits::{self, percentage};
use crate::report::{Direction, Enclosure};
use pompeiu_figures::names::name;
use pompeiu_figures::page::Bounds;
use pompeiu_figures::paper::{Block, Document, Paper};
use pompeiu_figures::{Figure, FigureError, Image, Panel, Projection, Theme, Values, View};

/// Pixels of the picture: about 200 to an inch of an A4 page.
const PICTURE: [u32; 2] = [1400, 600];
/// Pixels of each of the standard views, which are in two rows of three.
const VIEW: [u32; 2] = [467, 380];
/// Pixels of an em in them: seven points on A4.
const TEXT: f64 = 19.0;
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
        let places = of.worst_places(names);
        blocks.push(listed(&places));
        if let Some(image) = self.views(&places, of.up)? {
            let caption = format!(
                "{b} from six sides in parallel projection, in the colours of the picture above, with the places of the table that are \
                 seen from there.",
                b = names[1]
            );
            blocks.push(Block::Picture { image, caption });
        }
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

impl DeviationFigures<'_> {
    /// The second mesh from six sides, with the worst places; none where there is nothing to draw.
    fn views(&self, places: &[Place<'_>], up: [f64; 3]) -> Result<Option<Image>, FigureError> {
        let triangles = &self.sides[1].drawing.triangles;
        let Ok(mesh) = triangles.mesh() else { return Ok(None) };
        let (scale, label) = self.of.scale()?;
        let drawn = standard_views(up).map(|(name, view)| {
            let mut panel =
                Panel::new(&mesh).with_values(Values::Corners(&triangles.distances)).with_title(name);
            for ((region, direction, _), number) in places.iter().zip(1..) {
                // The end that lies on the second mesh.
                let at = match direction {
                    Direction::AToB => region.witness.to.position,
                    Direction::BToA => region.witness.from.position,
                };
                panel = panel.with_label(at, format!("{number}: {}", brief(region.peak)));
            }
            let [width, height] = VIEW;
            let figure = Figure::new(width, height)
                .with_scale(scale, label.clone())
                .without_legend()
                .with_text_size(TEXT);
            figure.with_view(view).with_panel(panel).draw()
        });
        let drawn = drawn.into_iter().collect::<Result<Vec<_>, _>>()?;
        Ok(Some(Image::tiled(&drawn, 3, [255; 3])))
    }
}

/// Front, right and top, and the sides opposite of them, in parallel projection. The front is that of the pictures: towards smaller y if z
/// is up, else towards greater z.
fn standard_views(up: [f64; 3]) -> [(&'static str, View); 6] {
    let front = if up[2].abs() > 0.5 { [0.0, -1.0, 0.0] } else { [0.0, 0.0, 1.0] };
    let right = [
        up[1] * front[2] - up[2] * front[1],
        up[2] * front[0] - up[0] * front[2],
        up[0] * front[1] - up[1] * front[0],
    ];
    let opposite = |v: [f64; 3]| v.map(|x| -x);
    // Above and below, the front is at the bottom and at the top of the picture.
    [
        ("front", front, up),
        ("right", right, up),
        ("top", up, opposite(front)),
        ("back", opposite(front), up),
        ("left", opposite(right), up),
        ("bottom", opposite(up), front),
    ]
    .map(|(name, eye, up)| {
        let view = View::default().with_up(up).with_direction_to_eye(eye);
        (name, view.with_projection(Projection::Orthographic))
    })
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

    /// The worst places of both directions, the worst first.
    fn worst_places(&self, [_, b]: [&str; 2]) -> Vec<Place<'_>> {
        let mut places = Vec::new();
        for (directed, name) in [
            (&self.deviation.a_to_b, format!("missing on {b}")),
            (&self.deviation.b_to_a, format!("excess on {b}")),
        ] {
            let regions = directed.regions.iter().take(REGIONS);
            places.extend(regions.map(|region| (region, directed.direction, name.clone())));
        }
        places.sort_by(|x, y| y.0.peak.upper().total_cmp(&x.0.peak.upper()));
        places
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

/// A region, the direction in which it was found, and what it is.
type Place<'p> = (&'p Region, Direction, String);

fn listed(places: &[Place<'_>]) -> Block {
    let columns =
        [("", 0.3), ("", 1.2), ("largest", 1.0), ("at (x, y, z)", 2.0), ("area", 0.8), ("faces", 0.6)];
    let rows =
        places.iter().zip(1..).map(|((region, _, name), number)| place(region, number, name)).collect();
    Block::Table { columns: columns.map(|(name, share)| (name.to_owned(), share)).to_vec(), rows }
}

fn place(region: &Region, number: usize, name: &str) -> Vec<String> {
    let [x, y, z] = region.witness.from.position.map(four_digits);
    vec![
        number.to_string(),
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
