//! The page and the picture of a flow.

use super::FluidFrame;
use crate::report::range;
use crate::{FluidStep, SchemeReport};
use pompeiu_core::TriMesh;
use pompeiu_figures::names::{axis, name};
use pompeiu_figures::page::{
    Amount, Arrangement, Block, Card, Chart, ChartAxis, Color, Fact, Layer, Lines, Mesh, MeshId, MeshValues,
    Page, PageError, Paint, Player, PlayerControls, PlayerId, Scene, SceneId, Series, Shape, Space, SpaceId,
    Span, Statistic, Text, ToggleId, ValueScale,
};
use pompeiu_figures::{
    ColorMap, Figure, FigureError, Image, Panel, Scale, Theme, Values, View, vertex_normals,
};

/// The page of a flow.
#[derive(Clone, Copy, Debug)]
pub struct FluidPage<'r> {
    /// The file of the mesh or another name.
    pub path: &'r str,
    /// The mesh.
    pub mesh: &'r TriMesh,
    /// The scheme.
    pub scheme: &'r SchemeReport,
    /// Measured quantities, initially and after each step.
    pub steps: &'r [FluidStep],
    /// Frames, in order.
    pub frames: &'r [FluidFrame],
    /// The up direction; `None` for a flow in the plane.
    pub up: Option<[f64; 3]>,
    /// The command that reproduces the page.
    pub command: Option<&'r str>,
}

/// Milliseconds from one frame to the next.
const INTERVAL: u32 = 80;

/// A quantity at vertices, frame by frame.
struct Quantity<'r> {
    name: &'r str,
    span: Span,
    colors: ColorMap,
    /// The colour of streaks, which stands out from those of the values.
    streaks: Color,
    values: Vec<&'r [f64]>,
}

impl<'r> FluidPage<'r> {
    /// The page as an HTML file.
    ///
    /// # Errors
    /// [`PageError`] if there is no frame, or one does not fit the mesh.
    pub fn html(&self) -> Result<String, PageError> {
        let mut page = Page::new(format!("Flow on {}", name(self.path)));
        page.subtitle = Text::from(format!("{}, ", name(self.path)))
            .count(self.mesh.faces().len(), "face")
            .text(", ")
            .count(self.steps.len().saturating_sub(1), "step");
        page.picture = "fluid".into();
        page.command = self.command.map(str::to_owned);
        env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
        let space = page.add_space(self.up.map_or(Space::Plane, |up| Space::Spatial(axis(up))));
        let mesh = page.add_mesh(space, Mesh::of(name(self.path), self.mesh))?;
        let player = page.add_player(Player {
            label: "Step".into(),
            steps: self.frames.len(),
            interval: INTERVAL,
            repeats: true,
            ..Player::default()
        })?;
        let streaks = page.add_toggle("Streaks", true);
        let quantities = self.quantities();
        let scenes = quantities
            .iter()
            .map(|quantity| self.add_scene(&mut page, quantity, (space, mesh, player, streaks)))
            .collect::<Result<Vec<_>, _>>()?;
        arrange(&mut page, &quantities, &scenes)?;
        let told = self.frames.iter().map(|frame| self.told(frame.step)).collect();
        page.set_player_below(PlayerControls { player, steps: told, off: Text::default() })?;
        page.add_card(Card::new(
            "Energy",
            vec![
                self.chart(player, "energy", "Kinetic energy", |step| Some(step.energy)),
                Block::Statistics(self.energies()),
            ],
        ))?;
        for (i, density) in self.scheme.densities.iter().enumerate() {
            let title = format!("Mass of {density}");
            let chart = self.chart(player, &format!("mass-{i}"), &title, |step| step.mass.get(i).copied());
            page.add_card(Card::new(title, vec![chart]))?;
        }
        page.add_card(Card::new("Run", vec![Block::Facts(self.facts()), Block::Run]))?;
        Ok(page.html())
    }

    /// Densities first, then the vorticity.
    fn quantities(&self) -> Vec<Quantity<'r>> {
        let mut quantities: Vec<Quantity<'r>> = Vec::new();
        for (i, density) in self.scheme.densities.iter().enumerate() {
            let values: Vec<&[f64]> =
                self.frames.iter().filter_map(|frame| frame.densities.get(i).map(Vec::as_slice)).collect();
            let [least, most] = range(values.iter().copied().flatten().copied());
            let most = if most > least { most } else { least + 1.0 };
            quantities.push(Quantity {
                name: density,
                span: Span::Between(least, most),
                colors: ColorMap::Viridis,
                streaks: Color::Fixed([255, 255, 255]),
                values,
            });
        }
        let values = self.frames.iter().map(|frame| frame.vorticity.as_slice()).collect();
        quantities.push(Quantity {
            name: "vorticity",
            span: Span::Signed,
            colors: ColorMap::Vik,
            streaks: Color::Ink,
            values,
        });
        quantities
    }

    fn add_scene(
        &self,
        page: &mut Page,
        quantity: &Quantity<'_>,
        (space, mesh, player, streaks): (SpaceId, MeshId, PlayerId, ToggleId),
    ) -> Result<SceneId, PageError> {
        let scale = page.add_scale(ValueScale {
            title: quantity.name.to_owned(),
            colors: quantity.colors,
            span: quantity.span,
            ..ValueScale::default()
        })?;
        let mut shapes = Vec::with_capacity(quantity.values.len());
        for values in &quantity.values {
            let values = page.add_values(mesh, scale, MeshValues::on_vertices(values.to_vec()))?;
            shapes.push(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None });
        }
        let lines = |frame: &FluidFrame| {
            Shape::Lines(Lines {
                paths: frame.curves.clone(),
                color: quantity.streaks,
                width: 1.6,
                moving: true,
                ..Lines::default()
            })
        };
        let mut scene = Scene::new(quantity.name, space);
        scene.layers = vec![
            Layer::over_time(player, shapes),
            Layer::over_time(player, self.frames.iter().map(lines).collect()).with_toggle(streaks),
        ];
        page.add_scene(scene)
    }

    fn chart(
        &self,
        player: PlayerId,
        key: &str,
        title: &str,
        value: impl Fn(&FluidStep) -> Option<f64>,
    ) -> Block {
        let shown = self.frames.iter().filter_map(|frame| self.steps.get(frame.step));
        let (x, y) = shown.filter_map(|step| Some((step.time, value(step)?))).unzip();
        Block::Chart(Chart {
            key: key.to_owned(),
            title: title.to_owned().into(),
            x: ChartAxis { label: "time".into(), ..ChartAxis::default() },
            y: ChartAxis { label: title.to_lowercase(), low: Some(0.0), ..ChartAxis::default() },
            series: vec![Series::Line { label: title.to_lowercase(), x, y }],
            player: Some(player),
            ..Chart::default()
        })
    }

    fn energies(&self) -> Vec<Statistic> {
        let number = |key: &str, name: &str, number: f64| Statistic {
            key: key.to_owned(),
            name: name.to_owned(),
            value: Amount::Number { number, digits: 8 },
            ..Statistic::default()
        };
        let (Some(first), Some(last)) = (self.steps.first(), self.steps.last()) else { return Vec::new() };
        vec![
            number("energy-initial", "at first", first.energy),
            number("energy-final", "at the end", last.energy),
        ]
    }

    fn told(&self, index: usize) -> Text {
        let Some(step) = self.steps.get(index) else { return Text::from(format!("step {index}")) };
        let text = Text::from(format!("step {index}, time ")).number(step.time, 4);
        text.text(", fastest ").number(step.max_speed, 4)
    }

    fn facts(&self) -> Vec<Fact> {
        let scheme = self.scheme;
        let mut facts = vec![Fact::new("scheme", scheme.name)];
        let mut add = |name: &str, value: Text| facts.push(Fact::new(name, value));
        add("step", Text::default().number(scheme.time_step, 4));
        if scheme.viscosity > 0.0 {
            let model = format!(", {}", scheme.viscosity_model.name());
            add("viscosity", Text::default().number(scheme.viscosity, 4).text(&model));
        }
        if !scheme.densities.is_empty() {
            add("densities", scheme.transport.name().into());
        }
        if scheme.harmonic_fields > 0 {
            add("harmonic fields", scheme.harmonic_fields.to_string().as_str().into());
        }
        if let Some(last) = self.steps.last() {
            add("divergence", Text::default().number(last.divergence, 2));
            add("total vorticity", Text::default().number(last.total_vorticity, 2));
        }
        facts
    }

    /// A picture of a frame, of the given size in pixels: the first density, or the vorticity if there is none. All frames have the
    /// same scale.
    ///
    /// # Errors
    /// [`FigureError`] for an invalid size.
    pub fn image(
        &self,
        frame: usize,
        width: u32,
        height: u32,
        theme: Theme,
        view: View,
    ) -> Result<Image, FigureError> {
        let quantities = self.quantities();
        let mut figure = Figure::new(width, height).with_theme(theme).with_view(view);
        let normals = vertex_normals(self.mesh);
        if let Some(quantity) = quantities.first() {
            let scale = if let Span::Between(least, most) = quantity.span {
                Scale::new(quantity.colors, least, most)?
            } else {
                let [least, most] = range(quantity.values.iter().copied().flatten().copied());
                let extent = if -least > most { -least } else { most };
                Scale::symmetric(quantity.colors, if extent > 0.0 { extent } else { 1.0 })?
            };
            figure = figure.with_scale(scale, quantity.name);
            let mut panel = Panel::new(self.mesh).with_normals(&normals);
            if let Some(values) = quantity.values.get(frame) {
                panel = panel.with_values(Values::Vertices(values));
            }
            if let Some(step) = self.frames.get(frame).and_then(|frame| self.steps.get(frame.step)) {
                panel = panel.with_title(format!("time {:.4}", step.time));
            }
            figure = figure.with_panel(panel);
        }
        figure.draw()
    }
}

/// Arrangements with all quantities side by side, and with each one alone.
fn arrange(page: &mut Page, quantities: &[Quantity<'_>], scenes: &[SceneId]) -> Result<(), PageError> {
    for (i, (quantity, &scene)) in quantities.iter().zip(scenes).enumerate() {
        page.add_arrangement(Arrangement {
            key: i.to_string(),
            text: quantity.name.to_owned(),
            hint: String::new(),
            scenes: vec![scene],
        })?;
    }
    if scenes.len() > 1 {
        page.add_arrangement(Arrangement {
            key: "all".into(),
            text: "All".into(),
            hint: String::new(),
            scenes: scenes.to_vec(),
        })?;
    }
    Ok(())
}
