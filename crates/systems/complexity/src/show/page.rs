//! The gallery page: shapes in order of complexity, a sortable table, a scatter plot of measures, clusters.

use crate::{Agreement, ComplexityReport, Measure, Shape};
use pompeiu_figures::page::{
    Amount, Block, Card, Cell, Chart, ChartAxis, Color, Fact, Layer, Lines, Page, PageError, Place, PlaceId,
    Row, ScatterPoint, Scene, Series, Shape as Drawn, Space, Statistic, Table, Text,
};
use pompeiu_figures::{Image, Rgb};
use pompeiu_planar::{Outline, Point, fill};

/// The data of the gallery page.
#[derive(Clone, Copy, Debug)]
pub struct ComplexityPage<'r> {
    /// The title.
    pub title: &'r str,
    /// The shapes; those that the report lacks are omitted.
    pub shapes: &'r [Shape],
    /// The report.
    pub report: &'r ComplexityReport,
    /// The command that reproduces the page.
    pub command: Option<&'r str>,
}

/// Columns of the table in addition to the ranking measure.
const SHOWN: [&str; 6] = ["boundary-25", "t18", "peaks", "total-curvature", "skeleton-length", "convexity"];

/// The two measures of the scatter plot.
const AXES: [&str; 2] = ["boundary", "t18"];

/// Side of a thumbnail in pixels.
const SMALL: usize = 48;

/// Share of a gallery cell's side that a shape fills.
const FILLED: f64 = 0.86;

/// Bins of histograms.
const BINS: usize = 20;

/// Colours of clusters.
const COLORS: [Rgb; 8] = [
    [31, 119, 180],
    [214, 95, 14],
    [44, 140, 60],
    [176, 50, 60],
    [117, 92, 170],
    [124, 84, 66],
    [200, 90, 160],
    [20, 150, 160],
];

/// Digits of measures.
const DIGITS: u8 = 5;

impl ComplexityPage<'_> {
    /// The page as an HTML file.
    ///
    /// # Errors
    /// [`PageError`] if a number is not finite.
    pub fn html(&self) -> Result<String, PageError> {
        let report = self.report;
        let mut page = Page::new(format!("Complexity of {}", self.title));
        page.subtitle =
            Text::default().count(report.shapes.len(), "shape").text(format!(", by {}", report.ranked_by));
        page.picture = "complexity".into();
        page.command = self.command.map(str::to_owned);
        env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
        let plane = page.add_space(Space::Plane);
        let order = self.order();
        let scene = page.add_scene(self.gallery(&order, plane))?;
        let place = |k: usize| PlaceId { scene, place: k };
        if let Some(agreement) = &report.agreement {
            let note =
                "Places of the ranking beside those it is compared with; p-values by permutation, two-sided.";
            let blocks = vec![Block::Statistics(statistics(agreement)), Block::Note(note.into())];
            page.add_card(Card::new("Agreement", blocks))?;
        }
        page.add_card(Card::new("Shapes", vec![Block::Table(self.table(&order, place))]))?;
        page.add_card(Card::new("Measures", self.charts(&order, place)))?;
        page.add_card(Card::new("Run", vec![Block::Facts(self.facts()), Block::Run]))?;
        Ok(page.html())
    }

    /// The shapes of the report from the simplest to the most complex, as indices.
    fn order(&self) -> Vec<usize> {
        let of = |file: &str| self.report.shapes.iter().position(|shape| shape.file == file);
        self.report.ranking.iter().filter_map(|ranked| of(&ranked.file)).collect()
    }

    fn outline(&self, i: usize) -> Option<&Outline> {
        let file = &self.report.shapes[i].file;
        self.shapes.iter().find(|shape| shape.file == *file).map(|shape| &shape.outline)
    }

    fn label(&self, i: usize) -> Option<usize> {
        self.report.clusters.as_ref().map(|clusters| clusters.labels[i])
    }

    /// All shapes in rows, coloured by cluster.
    fn gallery(&self, order: &[usize], plane: pompeiu_figures::page::SpaceId) -> Scene {
        let mut scene = Scene::new("from the simplest to the most complex, row by row", plane);
        let columns = (order.len() as f64).sqrt().ceil().max(1.0) as usize;
        let clusters = self.report.clusters.as_ref().map_or(1, |clusters| clusters.count);
        let mut paths: Vec<Vec<Vec<[f64; 3]>>> = vec![Vec::new(); clusters];
        for (k, &i) in order.iter().enumerate() {
            let center = [(k % columns) as f64, -((k / columns) as f64), 0.0];
            if let Some(outline) = self.outline(i) {
                let points = fitted(outline, FILLED).into_iter();
                let path = points.map(|[x, y]| [center[0] + x, center[1] - y, 0.0]).collect();
                paths[self.label(i).unwrap_or(0)].push(path);
            }
            let label = self.report.shapes[i].file.clone();
            scene.places.push(Place {
                center,
                radius: 0.6,
                pair: None,
                faces: Vec::new(),
                mesh: None,
                label,
            });
        }
        for (label, paths) in paths.into_iter().enumerate() {
            let color = match self.report.clusters {
                Some(_) => Color::Fixed(COLORS[label % COLORS.len()]),
                None => Color::Ink,
            };
            let lines = Lines { paths, closed: true, color, width: 1.5, ..Lines::default() };
            scene.layers.push(Layer::new(Drawn::Lines(lines)));
        }
        scene
    }

    fn table(&self, order: &[usize], place: impl Fn(usize) -> PlaceId) -> Table {
        let report = self.report;
        let mut columns = vec!["shape".to_owned(), "file".to_owned(), "rank".to_owned()];
        columns.extend(report.agreement.map(|_| "against".to_owned()));
        columns.push(report.ranked_by.clone());
        let others: Vec<&Measure> = SHOWN
            .iter()
            .filter(|name| **name != report.ranked_by)
            .filter_map(|name| Measure::ALL.iter().find(|measure| measure.name == *name))
            .collect();
        columns.extend(others.iter().map(|measure| measure.name.to_owned()));
        if report.clusters.is_some() {
            columns.extend(["cluster", "silhouette"].map(str::to_owned));
        }
        let rows = order.iter().enumerate().map(|(k, &i)| {
            let (shape, ranked) = (&report.shapes[i], &report.ranking[k]);
            let number = |value: f64| Cell::Number { value, digits: DIGITS };
            let picture = self
                .outline(i)
                .and_then(small)
                .map_or(Cell::Empty, |image| Cell::picture(&image, format!("the outline of {}", shape.file)));
            let mut cells = vec![picture, Cell::text(shape.file.as_str()), number(ranked.rank)];
            cells.extend(report.agreement.map(|_| ranked.against.map_or(Cell::Empty, number)));
            cells.push(number(ranked.value));
            cells.extend(others.iter().map(|measure| number(measure.value(&shape.measures))));
            if let Some(clusters) = &report.clusters {
                cells.extend([number(clusters.labels[i] as f64 + 1.0), number(clusters.silhouettes[i])]);
            }
            Row { cells, place: Some(place(k)) }
        });
        let caption = "Shapes with their measures; a click on a head sorts".to_owned();
        Table { key: "shapes".into(), caption, columns, rows: rows.collect(), sortable: true }
    }

    /// The scatter plot, and the histogram of the ranking measure.
    fn charts(&self, order: &[usize], place: impl Fn(usize) -> PlaceId) -> Vec<Block> {
        let report = self.report;
        let value = |name: &str, i: usize| {
            let measure = Measure::ALL.iter().find(|measure| measure.name == name);
            measure.map_or(0.0, |measure| measure.value(&report.shapes[i].measures))
        };
        let axis = |label: &str| ChartAxis { label: label.to_owned(), ..ChartAxis::default() };
        let clusters = report.clusters.as_ref().map_or(1, |clusters| clusters.count);
        let series = (0..clusters).map(|label| {
            let of_cluster = order.iter().enumerate().filter(|(_, i)| self.label(**i).unwrap_or(0) == label);
            let points = of_cluster.map(|(k, &i)| ScatterPoint {
                at: AXES.map(|name| value(name, i)),
                label: report.shapes[i].file.clone(),
                place: Some(place(k)),
            });
            let name =
                if report.clusters.is_some() { format!("cluster {}", label + 1) } else { String::new() };
            Series::Scatter { label: name, points: points.collect() }
        });
        let scatter = Chart {
            key: "scatter".into(),
            title: "Boundary ratio, mean of five, and share of corners".into(),
            x: axis(AXES[0]),
            y: axis(AXES[1]),
            series: series.collect(),
            ..Chart::default()
        };
        let values: Vec<f64> = order.iter().map(|i| value(&report.ranked_by, *i)).collect();
        let histogram = Chart {
            key: "histogram".into(),
            title: format!("Shares of shapes by {}", report.ranked_by).into(),
            x: axis(&report.ranked_by),
            y: ChartAxis { percent: true, low: Some(0.0), ..ChartAxis::default() },
            series: vec![histogram(&values)],
            ..Chart::default()
        };
        vec![Block::Chart(scatter), Block::Chart(histogram)]
    }

    fn facts(&self) -> Vec<Fact> {
        let report = self.report;
        let smoothing = report.shapes.first().map_or(0.0, |shape| shape.measures.curvature.smoothing);
        let mut facts = vec![
            Fact::new("ranked by", report.ranked_by.as_str()),
            Fact::new(
                "smoothing",
                Text::default().number(smoothing, 3).text(" of the length of each outline"),
            ),
        ];
        if let Some(clusters) = &report.clusters {
            facts.push(Fact::new("clusters in", clusters.features.join(", ")));
            facts.push(Fact::new("sum of distances", Text::default().number(clusters.loss, DIGITS)));
            facts.push(Fact::new("mean silhouette", Text::default().number(clusters.silhouette, DIGITS)));
        }
        facts
    }
}

fn statistics(agreement: &Agreement) -> Vec<Statistic> {
    let one = |key: &str, name: &str, number: f64, note: Text| Statistic {
        key: key.to_owned(),
        name: name.to_owned(),
        value: Amount::Number { number, digits: 4 },
        note,
        ..Statistic::default()
    };
    let p = |p: f64| Text::from("p = ").number(p, 3);
    vec![
        one("kendall", "Kendall", agreement.kendall, p(agreement.kendall_p)),
        one("spearman", "Spearman", agreement.spearman, p(agreement.spearman_p)),
        one("similarity", "same", agreement.similarity, "share in the same place".into()),
        one("distance", "distance", agreement.average_distance, "places on average".into()),
        one(
            "normalized",
            "relative",
            agreement.normalized_distance,
            "distance over the number of shapes".into(),
        ),
    ]
}

fn histogram(values: &[f64]) -> Series {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let width = if high > low { high - low } else { 1.0 };
    let edges: Vec<f64> = (0..=BINS).map(|i| low + width * i as f64 / BINS as f64).collect();
    let mut counts = [0_usize; BINS];
    for value in values {
        counts[(((value - low) / width * BINS as f64) as usize).min(BINS - 1)] += 1;
    }
    let shares = counts.iter().map(|count| [*count as f64 / values.len() as f64; 2]).collect();
    Series::Histogram { edges, shares }
}

/// An outline scaled into a square of this side around the origin.
fn fitted(outline: &Outline, side: f64) -> Vec<Point> {
    let [low, high] = outline.bounds();
    let scale = side / (high[0] - low[0]).max(high[1] - low[1]);
    outline.points().iter().map(|p| [0, 1].map(|k| scale * (p[k] - 0.5 * (low[k] + high[k])))).collect()
}

/// A thumbnail of an outline.
fn small(outline: &Outline) -> Option<Image> {
    let points = fitted(outline, SMALL as f64 - 4.0);
    let middle = 0.5 * (SMALL as f64 - 1.0);
    let placed = Outline::new(points.into_iter().map(|[x, y]| [middle + x, middle + y]).collect()).ok()?;
    let pixels = fill([&placed], SMALL, SMALL).into_iter().map(|share| {
        let level = 255.0 - 205.0 * share.clamp(0.0, 1.0);
        [level as u8; 3]
    });
    Image::new(SMALL as u32, SMALL as u32, pixels.collect())
}
