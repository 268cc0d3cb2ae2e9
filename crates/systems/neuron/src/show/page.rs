//! The page.

use super::NeuronSurface;
use crate::{Cap, Frame, NeuronReport, Parameters, TransportState};
use pompeiu_figures::ColorMap;
use pompeiu_figures::names::name;
use pompeiu_figures::page::{
    Amount, Arrangement, Axis, Block, Card, Cell, Chart, ChartAxis, Fact, Layer, Mesh, MeshId, MeshValues,
    Page, PageError, Paint, Player, PlayerControls, PlayerId, Row, Scene, SceneId, Series, Shape, Space,
    SpaceId, Span, Statistic, Table, Text, ValueScale,
};

/// The page of a transport.
#[derive(Clone, Copy, Debug)]
pub struct NeuronPage<'r> {
    /// The file of the skeleton or mesh, or another name.
    pub path: &'r str,
    /// The boundary of its cells.
    pub surface: &'r NeuronSurface,
    /// The flat ends.
    pub caps: &'r [Cap],
    /// The cap that is the inlet.
    pub inlet: u32,
    /// The parameters of the transport.
    pub parameters: &'r Parameters,
    /// Its result.
    pub state: &'r TransportState,
    /// The report.
    pub report: &'r NeuronReport,
    /// The command that reproduces the page.
    pub command: Option<&'r str>,
}

/// Milliseconds from one frame to the next.
const INTERVAL: u32 = 200;

/// Largest number of values in a page, of about 11 bytes each.
const MOST_VALUES: usize = 4_000_000;

/// Smallest number of frames in a page, if there are as many.
const LEAST_FRAMES: usize = 6;

/// Largest number of points of a curve.
const MOST_POINTS: usize = 400;

/// A displayed concentration.
struct Quantity {
    name: &'static str,
    /// What it is in a sentence.
    title: &'static str,
    of: fn(&[f64; 3]) -> f64,
}

const TOTAL: Quantity = Quantity { name: "total", title: "All material", of: |v| v[0] + v[1] + v[2] };
const KINDS: [Quantity; 3] = [
    Quantity { name: "free", title: "Free material", of: |v| v[0] },
    Quantity { name: "plus", title: "Material carried away from the inlet", of: |v| v[1] },
    Quantity { name: "minus", title: "Material carried towards the inlet", of: |v| v[2] },
];

impl NeuronPage<'_> {
    /// The page as an HTML file.
    ///
    /// # Errors
    /// [`PageError`] if there is no frame, or a number is not finite.
    pub fn html(&self) -> Result<String, PageError> {
        let mut page = Page::new(format!("Transport through {}", name(self.path)));
        page.subtitle = Text::from(format!("{}, ", name(self.path)))
            .count(self.report.mesh.as_ref().map_or(0, |mesh| mesh.hexahedra), "cell")
            .text(", ")
            .count(self.state.step, "step");
        page.picture = "transport".into();
        page.command = self.command.map(str::to_owned);
        env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
        let space = page.add_space(Space::Spatial(Axis::Z));
        let shown =
            Mesh::new(name(self.path), self.surface.positions.clone(), self.surface.triangles.clone());
        let mesh = page.add_mesh(space, shown)?;
        let quantities = self.quantities();
        let frames = self.frames(quantities.len());
        let player = page.add_player(Player {
            label: "Time".into(),
            steps: frames.len(),
            interval: INTERVAL,
            repeats: true,
            ..Player::default()
        })?;
        let scenes = quantities
            .iter()
            .map(|quantity| self.add_scene(&mut page, quantity, &frames, (space, mesh, player)))
            .collect::<Result<Vec<_>, _>>()?;
        arrange(&mut page, &quantities, &scenes)?;
        let told = frames.iter().map(|frame| {
            let text = Text::from("time ").number(frame.time, 5).text(" s, step ");
            text.text(frame.step.to_string())
        });
        let steps = told.collect();
        page.set_player_below(PlayerControls { player, steps, off: Text::default() })?;
        for quantity in &quantities {
            page.add_card(Card::new(quantity.title, vec![Block::Chart(self.chart(quantity))]))?;
        }
        page.add_card(Card::new("At the ends", vec![Block::Table(self.table())]))?;
        page.add_card(Card::new("Checks", vec![Block::Statistics(self.checks())]))?;
        page.add_card(Card::new("Run", vec![Block::Facts(self.facts()), Block::Run]))?;
        Ok(page.html())
    }

    /// The sum first, then each kind that occurs.
    fn quantities(&self) -> Vec<Quantity> {
        let is_there = |quantity: &Quantity| {
            self.state.frames.iter().flat_map(|frame| &frame.values).any(|v| (quantity.of)(v) > 0.0)
        };
        let kinds: Vec<Quantity> = KINDS.into_iter().filter(is_there).collect();
        if kinds.len() == 1 { kinds } else { std::iter::once(TOTAL).chain(kinds).collect() }
    }

    /// As many evenly spaced frames as a page of this size can hold.
    fn frames(&self, quantities: usize) -> Vec<&Frame> {
        let all = &self.state.frames;
        let most = MOST_VALUES / (self.surface.vertices() * quantities).max(1);
        let count = most.max(LEAST_FRAMES).min(all.len());
        (0..count).map(|k| &all[if count > 1 { k * (all.len() - 1) / (count - 1) } else { 0 }]).collect()
    }

    fn add_scene(
        &self,
        page: &mut Page,
        quantity: &Quantity,
        frames: &[&Frame],
        (space, mesh, player): (SpaceId, MeshId, PlayerId),
    ) -> Result<SceneId, PageError> {
        let scale = page.add_scale(ValueScale {
            title: quantity.name.to_owned(),
            unit: "mM".to_owned(),
            colors: ColorMap::Viridis,
            span: Span::Size,
            ..ValueScale::default()
        })?;
        let mut shapes = Vec::with_capacity(frames.len());
        for frame in frames {
            let values = self.surface.at_vertices(|cell| (quantity.of)(&frame.values[cell]));
            let values = page.add_values(mesh, scale, MeshValues::on_vertices(values))?;
            shapes.push(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None });
        }
        let mut scene = Scene::new(quantity.name, space);
        scene.layers = vec![Layer::over_time(player, shapes)];
        page.add_scene(scene)
    }

    /// The concentration at every end over time, the inlet last.
    fn chart(&self, quantity: &Quantity) -> Chart {
        let stride = self.state.ends.len().div_ceil(MOST_POINTS).max(1);
        let last = self.state.ends.len() - 1;
        let steps: Vec<usize> = (0..last).step_by(stride).chain([last]).collect();
        let x: Vec<f64> = steps.iter().map(|&step| step as f64 * self.parameters.step).collect();
        let line = |cap: usize| Series::Line {
            label: self.end_name(cap),
            x: x.clone(),
            y: steps.iter().map(|&step| (quantity.of)(&self.state.ends[step][cap])).collect(),
        };
        let inlet = self.inlet as usize;
        let tips = (0..self.caps.len()).filter(|cap| *cap != inlet).chain([inlet]);
        Chart {
            key: format!("ends-{}", quantity.name),
            title: format!("{} at the ends", quantity.title).into(),
            x: ChartAxis { label: "time in s".into(), ..ChartAxis::default() },
            y: ChartAxis {
                label: format!("{} in mM", quantity.name),
                low: Some(0.0),
                ..ChartAxis::default()
            },
            series: tips.map(line).collect(),
            ..Chart::default()
        }
    }

    fn end_name(&self, cap: usize) -> String {
        let kind = if cap == self.inlet as usize { "inlet" } else { "end" };
        format!("{kind} {}", self.caps[cap].sample)
    }

    fn table(&self) -> Table {
        let number = |value: f64| Cell::Number { value, digits: 4 };
        let last = &self.state.ends[self.state.ends.len() - 1];
        let row = |(cap, v): (usize, &[f64; 3])| Row {
            cells: vec![
                Cell::text(self.end_name(cap)),
                number(v[0]),
                number(v[1]),
                number(v[2]),
                number(v.iter().sum()),
            ],
            place: None,
        };
        Table {
            key: "ends".into(),
            caption: "Concentrations at the flat ends after the last step".into(),
            columns: ["", "free", "plus", "minus", "total"].map(str::to_owned).to_vec(),
            rows: last.iter().enumerate().map(row).collect(),
            sortable: true,
        }
    }

    fn checks(&self) -> Vec<Statistic> {
        let number = |key: &str, name: &str, number: f64| Statistic {
            key: key.to_owned(),
            name: name.to_owned(),
            value: Amount::Number { number, digits: 3 },
            ..Statistic::default()
        };
        let mut list = Vec::new();
        if let Some(transport) = &self.report.transport {
            list.push(number("mass-balance", "error of the balance of mass", transport.mass_balance));
            list.push(number("minimum", "least concentration", transport.minimum));
            list.push(number("maximum", "greatest concentration", transport.maximum));
        }
        if let Some(flow) = &self.report.flow {
            list.push(number("drift", "drift of the flux through sections", flow.section_flux_drift));
        }
        if let Some(mesh) = &self.report.mesh {
            list.push(number("quality", "least scaled Jacobian", mesh.min_scaled_jacobian));
        }
        list
    }

    fn facts(&self) -> Vec<Fact> {
        let p = self.parameters;
        let quantity = |value: f64, unit: &str| Text::default().number(value, 4).text(unit);
        let mut facts = vec![
            Fact::new("diffusion", quantity(p.diffusion, " µm²/s")),
            Fact::new("speed away from the inlet", quantity(p.speed_plus, " µm/s")),
            Fact::new("speed towards it", quantity(p.speed_minus, " µm/s")),
            Fact::new("attachment", quantity(p.attach_plus, " and ").number(p.attach_minus, 4).text(" /s")),
            Fact::new("detachment", quantity(p.detach_plus, " and ").number(p.detach_minus, 4).text(" /s")),
            Fact::new("step", quantity(p.step, " s")),
        ];
        if let Some(flow) = &self.report.flow {
            facts.push(Fact::new("Reynolds number", Text::default().number(flow.reynolds, 3)));
            facts.push(Fact::new("pressure drop", quantity(flow.pressure_drop, " Pa")));
        }
        facts
    }
}

/// Each quantity alone, and all side by side.
fn arrange(page: &mut Page, quantities: &[Quantity], scenes: &[SceneId]) -> Result<(), PageError> {
    let arrangement = |key: &str, text: &str, scenes: &[SceneId]| Arrangement {
        key: key.to_owned(),
        text: text.to_owned(),
        hint: String::new(),
        scenes: scenes.to_vec(),
    };
    for (quantity, &scene) in quantities.iter().zip(scenes) {
        page.add_arrangement(arrangement(quantity.name, quantity.name, &[scene]))?;
    }
    if scenes.len() > 1 {
        page.add_arrangement(arrangement("all", "All", scenes))?;
    }
    Ok(())
}
