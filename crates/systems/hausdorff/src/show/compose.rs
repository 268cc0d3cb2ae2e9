//! The page of two surfaces and how far each is from the other, from shared blocks.

use super::content::{DeviationContent, MeasuredSurface, SurfaceDeviation};
use pompeiu_figures::ColorMap;
use pompeiu_figures::page::{
    Amount, Arrangement, Block, Bounds, BoundsId, Button, Card, Cell, Chart, ChartAxis, Classes, Fact, Layer,
    Mesh, MeshId, MeshValues, Page, PageError, Paint, Pair, Place, PlaceId, PlaceItem, PlaceList, Player,
    PlayerControls, PlayerId, Range, RangeEnd, Row, ScaleId, Scene, SceneId, Series, Shape, Space, SpaceId,
    Span, Statistic, Table, Text, Threshold, ToggleId, ValueScale, ValuesId,
};
use std::fmt::Write;

const LABELS: [&str; 2] = ["A", "B"];

/// Milliseconds that a stage of the search is shown while they play.
const STAGE_INTERVAL: u32 = 900;

/// A direction that was measured, on the page.
struct Side<'c> {
    /// 0 from A to B, 1 from B to A.
    index: usize,
    deviation: &'c SurfaceDeviation,
    largest: f64,
    values: ValuesId,
    bounds: BoundsId,
    scene: SceneId,
}

/// What both scenes refer to.
struct Shared {
    space: SpaceId,
    meshes: [MeshId; 2],
    scale: ScaleId,
    player: Option<PlayerId>,
    other: ToggleId,
    pair: ToggleId,
}

impl DeviationContent {
    /// The page, to be written with [`Page::html`].
    ///
    /// # Errors
    /// What is missing, does not belong together or is no number; see [`PageError`].
    pub fn page(&self) -> Result<Page, PageError> {
        let directions: Vec<(usize, &SurfaceDeviation)> =
            (0..2).filter_map(|i| Some((i, self.surfaces[i].deviation.as_ref()?))).collect();
        let Some(&(_, first)) = directions.first() else { return Err(PageError::NothingToShow) };
        let mut page = Page::new(self.title.clone());
        let [a, b] = [&self.surfaces[0], &self.surfaces[1]];
        let labels = [0, 1].map(|i| self.label(i));
        page.subtitle = Text::from(format!("{}: {}  \u{b7}  {}: {}", labels[0], a.name, labels[1], b.name));
        page.banner.clone_from(&self.verdict);
        page.summary = self.summary();
        page.picture = "deviation".into();
        page.command.clone_from(&self.command);
        page.version.clone_from(&self.version);
        page.still.clone_from(&self.still);

        let space = page.add_space(Space::Spatial(self.up));
        let mesh = |page: &mut Page, i: usize| {
            let MeasuredSurface { triangles, faces, .. } = &self.surfaces[i];
            let (positions, corners) = (triangles.positions.clone(), triangles.corners.clone());
            let mesh = Mesh::new(self.label(i), positions, corners);
            let mesh = match triangles.groups {
                Some(groups) => {
                    mesh.with_faces(triangles.faces.clone(), groups).with_element("group of faces")
                }
                None => mesh.with_faces(triangles.faces.clone(), *faces),
            };
            page.add_mesh(space, mesh)
        };
        let meshes = [mesh(&mut page, 0)?, mesh(&mut page, 1)?];
        let scale = page.add_scale(ValueScale {
            title: self.quantity().into(),
            unit: self.unit.clone(),
            colors: if self.signed { ColorMap::Vik } else { ColorMap::Viridis },
            span: if self.signed { Span::Signed } else { Span::Size },
            threshold: Some(self.threshold.unwrap_or_else(|| first.distance_covering(0.95))),
            bands: self.bands.clone(),
            painting: self.is_judged_by_threshold(),
        })?;
        let steps = directions.iter().map(|(_, deviation)| deviation.stages.len()).max().unwrap_or(0);
        let player = Player {
            label: "Stage of the search".into(),
            steps,
            optional: true,
            interval: STAGE_INTERVAL,
            repeats: false,
        };
        let player = if steps > 0 { Some(page.add_player(player)?) } else { None };
        let other = page.add_toggle("Other surface", true);
        let pair = page.add_toggle("Farthest pair", true);
        let shared = Shared { space, meshes, scale, player, other, pair };
        let sides = directions
            .into_iter()
            .map(|(index, deviation)| self.add_scene(&mut page, &shared, index, deviation))
            .collect::<Result<Vec<_>, _>>()?;
        self.add_ranges(&mut page, scale, &sides)?;
        self.add_arrangements(&mut page, &sides)?;
        self.add_cards(&mut page, &shared, &sides)?;
        // A verdict is about the worst place of both directions; else the first direction comes first.
        let proven = |side: &Side<'_>| side.deviation.distance[0];
        let worst = match sides.as_slice() {
            [first, second] if self.verdict.is_some() && proven(second) > proven(first) => Some(second),
            all => all.first(),
        };
        if let Some(side) = worst {
            page.open_with(side.scene)?;
        }
        Ok(page)
    }

    fn add_scene<'c>(
        &self,
        page: &mut Page,
        shared: &Shared,
        index: usize,
        deviation: &'c SurfaceDeviation,
    ) -> Result<Side<'c>, PageError> {
        let mesh = shared.meshes[index];
        let values = MeshValues::on_corners(deviation.values.clone());
        let values = page.add_values(mesh, shared.scale, values)?;
        let bounds = page.add_bounds(mesh, deviation.face_bounds.clone())?;
        let [from, to] = [self.label(index), self.label(1 - index)];
        let label = if self.bands.is_empty() {
            format!("{from}, {} from {to}", self.quantity())
        } else {
            format!("{from}, deviation of {} from {}", self.label(1), self.label(0))
        };
        let mut scene = Scene::new(label, shared.space);
        scene.name = format!("{from} \u{2192} {to}");
        let painted = Shape::Surface { mesh, paint: Paint::Values(values), bounds: Some(bounds) };
        let ghost = Shape::Surface { mesh: shared.meshes[1 - index], paint: Paint::Ghost, bounds: None };
        let label = Text::default().number(deviation.distance[0], 5).text(self.with_unit(""));
        let pair = Shape::Pairs(vec![Pair { points: deviation.witness, label }]);
        let mut painted = Layer::new(painted);
        let player = shared.player.filter(|_| !deviation.stages.is_empty());
        if let Some(player) = player {
            painted = painted.plain_while(player);
        }
        scene.layers = vec![painted, Layer::new(ghost).with_toggle(shared.other)];
        if let Some(player) = player {
            let pieces = deviation.stages.iter().map(|stage| Shape::Pieces(stage.remaining.clone()));
            scene.layers.push(Layer::over_time(player, pieces.collect()));
        }
        scene.layers.push(Layer::new(pair).with_toggle(shared.pair));
        let places = deviation.regions.iter().enumerate().map(|(i, region)| Place {
            center: region.center,
            radius: region.extent / 2.0,
            pair: Some(region.pair),
            faces: region.faces.clone(),
            mesh: Some(mesh),
            label: (i + 1).to_string(),
        });
        scene.places = places.collect();
        let scene = page.add_scene(scene)?;
        Ok(Side { index, deviation, largest: deviation.largest(), values, bounds, scene })
    }

    fn add_ranges(&self, page: &mut Page, scale: ScaleId, sides: &[Side<'_>]) -> Result<(), PageError> {
        let all = largest(sides);
        let ends = |end: &dyn Fn(&Side<'_>) -> f64| {
            RangeEnd::Scenes(sides.iter().map(|side| (side.scene, end(side))).collect())
        };
        let ranges = [
            ("the largest here", ends(&|side| side.largest)),
            ("the largest of both", ends(&|_| all)),
            ("99\u{202f}% of the area", ends(&|side| side.deviation.distance_covering(0.99))),
            ("the threshold", RangeEnd::Threshold),
        ];
        for (text, end) in ranges {
            page.add_range(scale, Range { text: text.into(), end })?;
        }
        // Where a tolerance is asked for, colours end there. Else a few far points would leave everything else in one dark colour.
        page.start_with_range(scale, if self.is_judged_by_threshold() { 3 } else { 2 })
    }

    fn add_arrangements(&self, page: &mut Page, sides: &[Side<'_>]) -> Result<(), PageError> {
        let one = |side: &Side<'_>| {
            let b = self.label(1);
            let (key, text) = [("missing", format!("Missing on {b}")), ("excess", format!("Excess on {b}"))]
                [side.index]
                .clone();
            let [from, to] = [self.label(side.index), self.label(1 - side.index)];
            let hint = format!("{from} \u{2192} {to}");
            Arrangement { key: key.into(), text, hint, scenes: vec![side.scene] }
        };
        let mut arrangements: Vec<_> = sides.iter().map(one).collect();
        if sides.len() > 1 {
            arrangements.push(Arrangement {
                key: "both".into(),
                text: "Side by side".into(),
                hint: String::new(),
                scenes: sides.iter().map(|side| side.scene).collect(),
            });
        }
        arrangements.into_iter().try_for_each(|arrangement| page.add_arrangement(arrangement))
    }

    fn add_cards(&self, page: &mut Page, shared: &Shared, sides: &[Side<'_>]) -> Result<(), PageError> {
        page.add_card(self.distance(sides))?;
        if !self.attached.is_empty() {
            let rows = self.attached.iter().map(|[name, value]| Fact::new(name, value.as_str()));
            page.add_card(Card::new("Proof attached", vec![Block::Facts(rows.collect())]))?;
        }
        let most = largest(sides);
        for side in sides {
            page.add_card(
                Card::new(
                    "Out of tolerance",
                    vec![side.threshold(shared.scale, most, self.label(side.index))],
                )
                .with_scene(side.scene),
            )?;
            if !side.deviation.bands.is_empty() {
                let classes = vec![side.classes(shared.scale, self.label(side.index))];
                page.add_card(Card::new("Tolerance bands", classes).with_scene(side.scene))?;
            }
            if sides.iter().any(|side| !side.deviation.regions.is_empty()) {
                page.add_card(
                    Card::new("Worst regions", vec![self.regions(side, shared.scale)]).with_scene(side.scene),
                )?;
            }
            if let Some(player) = shared.player {
                let card = Card::new("What the search had left", self.stages(side, player));
                page.add_card(card.with_scene(side.scene))?;
            }
            let charts = vec![self.histogram(side, shared.scale), self.share_beyond(side, shared.scale)];
            page.add_card(Card::new("Distribution over the area", charts).with_scene(side.scene))?;
            page.add_card(Card::new("Statistics", vec![side.statistics()]).with_scene(side.scene))?;
        }
        let proof = self.proof.iter().map(|paragraph| Block::Text(paragraph.as_str().into()));
        page.add_card(Card::new("How it was proved", proof.collect()))?;
        let file = |i: usize| {
            let MeasuredSurface { path, faces, vertices, .. } = &self.surfaces[i];
            let note =
                Text::default().count(*faces, "face").text(", ").count(*vertices, "").text(" vertices");
            Fact { name: self.label(i).into(), value: path.as_str().into(), note }
        };
        let run = self.facts.iter().map(|[name, value]| Fact::new(name, value.as_str()));
        let facts = [file(0), file(1)].into_iter().chain(run).collect();
        page.add_card(Card::new("Files and run", vec![Block::Facts(facts), Block::Run]))
    }

    /// The enclosures, and the way to the pair that proves them.
    fn distance(&self, sides: &[Side<'_>]) -> Card {
        let mut blocks = vec![];
        if let Some(ends) = self.distance {
            blocks.push(Block::Headline(Statistic {
                key: "distance".into(),
                name: "H(A, B)".into(),
                value: Amount::Enclosure { ends },
                unit: self.unit.clone(),
                note: Text::default(),
            }));
        }
        let directed = |side: &Side<'_>| Statistic {
            name: format!("{} \u{2192} {}", self.label(side.index), self.label(1 - side.index)),
            value: Amount::Enclosure { ends: side.deviation.distance },
            note: side.deviation.stop.as_str().into(),
            ..Statistic::default()
        };
        blocks.push(Block::Statistics(sides.iter().map(directed).collect()));
        blocks.push(Block::Buttons(vec![
            Button::LookAtPair("Fly to the farthest pair".into()),
            Button::ShowAll("Show all".into()),
        ]));
        Card::new("Distance", blocks)
    }

    /// What a surface is called.
    fn label(&self, i: usize) -> &str {
        if self.labels[i].is_empty() { LABELS[i] } else { &self.labels[i] }
    }

    /// Whether there is a verdict on a threshold.
    fn is_judged_by_threshold(&self) -> bool {
        self.verdict.is_some() && self.threshold.is_some_and(|threshold| threshold > 0.0)
    }

    /// What colours show.
    fn quantity(&self) -> &'static str {
        match (self.bands.is_empty(), self.signed) {
            (false, _) => "deviation of B",
            (true, true) => "signed distance",
            (true, false) => "distance",
        }
    }

    fn regions(&self, side: &Side<'_>, scale: ScaleId) -> Block {
        let unit = self.with_unit("");
        let square = if self.unit.is_empty() { String::new() } else { format!("{unit}\u{b2}") };
        let item = |(i, region): (usize, &super::content::Region)| PlaceItem {
            place: PlaceId { scene: side.scene, place: i },
            ends: region.peak,
            note: Text::default()
                .number(region.extent, 3)
                .text(format!("{unit} across, area "))
                .number(region.area, 3)
                .text(square.as_str()),
        };
        Block::Places(PlaceList {
            key: "regions".into(),
            scale: Some(scale),
            items: side.deviation.regions.iter().enumerate().map(item).collect(),
            none: "None were given in this direction.".into(),
        })
    }

    /// What the search had left at each tolerance, and how the enclosure closed.
    fn stages(&self, side: &Side<'_>, player: PlayerId) -> Vec<Block> {
        let stages = &side.deviation.stages;
        let unit = self.with_unit("");
        let step = |stage: &super::content::SearchStage| {
            Text::from("At ")
                .number(stage.tolerance, 3)
                .text(format!("{unit}: "))
                .count(stage.remaining.len(), "part")
                .text(format!(" of {} left, distance in ", self.label(side.index)))
                .enclosure(stage.distance)
        };
        let off = match stages.len() {
            0 => Text::from("No stages were recorded in this direction."),
            n => Text::from("Off. Move the slider: ").count(n, "stage").text(if n == 1 {
                " was recorded."
            } else {
                " were recorded."
            }),
        };
        let controls = PlayerControls { player, steps: stages.iter().map(step).collect(), off };
        let note = "Parts that could not yet be ruled out as the place of the maximum, at finer and finer tolerances.";
        let mut blocks = vec![Block::Note(note.into()), Block::Player(controls)];
        let widths: Vec<f64> = stages.iter().map(|stage| stage.distance[1] - stage.distance[0]).collect();
        if let [first, .., last] | [first @ last] = widths[..] {
            let title = Text::from("Width of the enclosure at ")
                .count(widths.len(), "stage")
                .text(", from ")
                .number(first, 3)
                .text(" to ")
                .number(last, 3)
                .text(unit);
            let in_unit = if self.unit.is_empty() { String::new() } else { format!(", {}", self.unit) };
            let label = format!("width of the enclosure{in_unit} (logarithmic), stage by stage");
            blocks.push(Block::Chart(Chart {
                key: "convergence".into(),
                title,
                y: ChartAxis { label, logarithmic: true, ..ChartAxis::default() },
                series: vec![Series::Bars { values: widths }],
                player: Some(player),
                ..Chart::default()
            }));
        }
        blocks
    }

    fn histogram(&self, side: &Side<'_>, scale: ScaleId) -> Block {
        let found = &side.deviation.histogram;
        Block::Chart(Chart {
            key: "histogram".into(),
            title: format!("Histogram: share of the area of {} by distance", self.label(side.index)).into(),
            x: ChartAxis { label: self.distance_label(), ..ChartAxis::default() },
            y: ChartAxis { label: "% of area".into(), percent: true, low: Some(0.0), ..ChartAxis::default() },
            series: vec![Series::Histogram { edges: found.edges.clone(), shares: found.fractions.clone() }],
            scale: Some(scale),
            ..Chart::default()
        })
    }

    /// The share of the area farther than each distance: between two curves.
    fn share_beyond(&self, side: &Side<'_>, scale: ScaleId) -> Block {
        let found = &side.deviation.exceedance;
        let last = found.distances.last().copied().unwrap_or(0.0);
        let high = if last > side.largest { last } else { side.largest };
        let title =
            format!("Share of the area of {} that is farther than a distance", self.label(side.index));
        let band = Series::Band {
            label: String::new(),
            x: found.distances.clone(),
            y: found.fractions.clone(),
            falling: true,
        };
        Block::Chart(Chart {
            key: "share-beyond".into(),
            title: title.into(),
            x: ChartAxis {
                label: self.distance_label(),
                low: Some(0.0),
                high: Some(if high > 0.0 { high } else { 1.0 }),
                ..ChartAxis::default()
            },
            y: ChartAxis {
                label: "% farther than".into(),
                percent: true,
                low: Some(0.0),
                high: Some(1.0),
                ..ChartAxis::default()
            },
            series: vec![band],
            scale: Some(scale),
            sets_threshold: true,
            player: None,
        })
    }

    fn distance_label(&self) -> String {
        if self.unit.is_empty() { "distance".into() } else { format!("distance in {}", self.unit) }
    }

    /// A text followed by the unit, where that is known.
    fn with_unit(&self, text: &str) -> String {
        if self.unit.is_empty() { text.into() } else { format!("{text} {}", self.unit) }
    }

    /// The answer in a sentence, for readers without scripts.
    fn summary(&self) -> String {
        let mut text = format!("{}.", self.title);
        for (from, to) in [(0, 1), (1, 0)].map(|(i, j)| (&self.surfaces[i], &self.surfaces[j])) {
            if let Some(SurfaceDeviation { distance: [lower, upper], .. }) = &from.deviation {
                let ends = self.with_unit(&format!("[{lower}, {upper}]"));
                let _ = write!(text, " The farthest point of {} is {ends} away from {}.", from.name, to.name);
            }
        }
        text
    }
}

impl Side<'_> {
    /// The share of the area in each tolerance band.
    fn classes(&self, scale: ScaleId, label: &str) -> Block {
        Block::Classes(Classes {
            key: "bands".into(),
            caption: format!("Shares of the area of {label} in each tolerance band"),
            scale,
            values: self.values,
            outer: ["too low", "too high"].map(str::to_owned),
            shares: self.deviation.bands.clone(),
        })
    }

    fn threshold(&self, scale: ScaleId, end: f64, label: &str) -> Block {
        let found = &self.deviation.exceedance;
        Block::Threshold(Threshold {
            scale,
            end,
            of: label.into(),
            beyond: "farther".into(),
            share: Some((found.distances.clone(), found.fractions.clone())),
            bounds: Some(self.bounds),
        })
    }

    fn statistics(&self) -> Block {
        let row = |(name, ends): &(String, Bounds)| Row {
            cells: vec![Cell::text(name.as_str()), Cell::Lower { ends: *ends }, Cell::Upper { ends: *ends }],
            place: None,
        };
        Block::Table(Table {
            key: "statistics".into(),
            caption: "Each statistic with a lower and an upper end".into(),
            columns: ["over the area", "lower", "upper"].map(str::to_owned).to_vec(),
            rows: self.deviation.statistics.iter().map(row).collect(),
            sortable: false,
        })
    }
}

/// The largest distance of all directions; 1 where all are zero.
fn largest(sides: &[Side<'_>]) -> f64 {
    let largest = sides.iter().map(|side| side.largest).fold(0.0, |a, b| if b > a { b } else { a });
    if largest > 0.0 { largest } else { 1.0 }
}
