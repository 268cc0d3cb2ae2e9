//! The page and the picture of a flow.

use super::frames::Frame;
use crate::{Flow, FlowRecord};
use pompeiu_core::{MeshError, TriMesh};
use pompeiu_figures::names::{axis, name};
use pompeiu_figures::page::{
    Amount, Block, Card, Chart, ChartAxis, Fact, Layer, Mesh, Page, PageError, Paint, Player, PlayerControls,
    Scene, Series, Shape, Space, Statistic, Text,
};
use pompeiu_figures::{Figure, FigureError, Image, Panel, Theme, View};

/// A flow to be shown.
#[derive(Clone, Copy, Debug)]
pub struct FlowPage<'r> {
    /// The file of the mesh, or whatever else it is called.
    pub path: &'r str,
    /// The flow.
    pub flow: &'r Flow,
    /// Surfaces on its way, in order; see [`Frames`](super::Frames).
    pub frames: &'r [Frame],
    /// Which way is up.
    pub up: [f64; 3],
    /// The command that makes the page again.
    pub command: Option<&'r str>,
}

/// Milliseconds from one surface to the next.
const INTERVAL: u32 = 120;

impl FlowPage<'_> {
    /// The page as a file.
    ///
    /// # Errors
    /// [`PageError`] where there is no frame, or one is no mesh.
    pub fn html(&self) -> Result<String, PageError> {
        let mut page = Page::new(format!("{} on its way to least area", name(self.path)));
        let count = self.flow.mesh.faces().len();
        page.subtitle = Text::from(format!("{}, ", name(self.path)))
            .count(count, "face")
            .text(", ")
            .count(self.flow.steps, "step");
        page.picture = "flow".into();
        page.command = self.command.map(str::to_owned);
        env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
        let space = page.add_space(Space::Spatial(axis(self.up)));
        let player = page.add_player(Player {
            label: "Step of the flow".into(),
            steps: self.frames.len(),
            interval: INTERVAL,
            repeats: true,
            ..Player::default()
        })?;
        let mut shapes: Vec<Shape> = Vec::with_capacity(self.frames.len());
        // Frames of one connectivity share their triangles.
        let mut base: Option<(usize, pompeiu_figures::page::MeshId)> = None;
        for (i, frame) in self.frames.iter().enumerate() {
            let of = base.filter(|(first, _)| {
                let first = &self.frames[*first];
                first.faces == frame.faces && first.positions.len() == frame.positions.len()
            });
            let mesh = if let Some((_, of)) = of {
                page.add_moved_mesh(space, of, frame.positions.clone())?
            } else {
                let mesh = Mesh::new(name(self.path), frame.positions.clone(), frame.faces.clone());
                let id = page.add_mesh(space, mesh)?;
                base = Some((i, id));
                id
            };
            shapes.push(Shape::Surface { mesh, paint: Paint::Plain, bounds: None });
        }
        let mut scene = Scene::new("surface", space);
        scene.layers = vec![Layer::over_time(player, shapes)];
        page.add_scene(scene)?;
        let steps =
            self.frames.iter().map(|frame| told(frame.step, self.flow.history.get(frame.step))).collect();
        let controls = PlayerControls { player, steps, off: Text::default() };
        page.set_player_below(controls)?;
        let of_frames = |value: &dyn Fn(&FlowRecord) -> f64| -> (Vec<f64>, Vec<f64>) {
            let records = self
                .frames
                .iter()
                .filter_map(|f| self.flow.history.get(f.step).map(|r| (f.step as f64, value(r))));
            records.unzip()
        };
        let chart = |title: &str, label: &str, logarithmic: bool, (x, y): (Vec<f64>, Vec<f64>)| Chart {
            key: label.to_owned(),
            title: title.into(),
            x: ChartAxis { label: "step".into(), ..ChartAxis::default() },
            y: ChartAxis { label: label.to_owned(), logarithmic, ..ChartAxis::default() },
            series: vec![Series::Line { label: label.to_owned(), x, y }],
            player: Some(player),
            ..Chart::default()
        };
        let area = of_frames(&|record| record.area);
        let gradient = of_frames(&|record| record.gradient.normal);
        page.add_card(Card::new(
            "Area",
            vec![
                Block::Chart(chart("Area after each step", "area", false, area)),
                Block::Statistics(self.areas()),
            ],
        ))?;
        page.add_card(Card::new(
            "Gradient",
            vec![Block::Chart(chart(
                "Greatest gradient of the area along a normal",
                "gradient",
                true,
                gradient,
            ))],
        ))?;
        page.add_card(Card::new("Verdict", vec![Block::Facts(self.facts()), Block::Run]))?;
        Ok(page.html())
    }

    fn areas(&self) -> Vec<Statistic> {
        let number = |key: &str, name: &str, number: f64| Statistic {
            key: key.to_owned(),
            name: name.to_owned(),
            value: Amount::Number { number, digits: 8 },
            ..Statistic::default()
        };
        vec![
            number("area-initial", "at first", self.flow.area.initial),
            number("area-final", "at the end", self.flow.area.r#final),
        ]
    }

    fn facts(&self) -> Vec<Fact> {
        let mut facts = vec![Fact::new("stopped", self.flow.stop.name())];
        let mut add = |name: &str, value: Text| facts.push(Fact::new(name, value));
        add("gradient along normals", Text::default().number(self.flow.gradient.normal, 3));
        add("gradient across them", Text::default().number(self.flow.gradient.tangential, 3));
        if let Some(stability) = &self.flow.stability {
            let verdict = match stability.is_minimum() {
                Some(true) => "local minimum, least eigenvalue ",
                Some(false) => "saddle, least eigenvalue ",
                None => "undecided, least eigenvalue ",
            };
            add("stability", Text::from(verdict).number(stability.least_eigenvalue, 6));
        }
        if let Some(discs) = &self.flow.discs {
            let beside = if discs.less { "less than the surface: " } else { "more than the surface: " };
            add("two discs have", Text::from(beside).number(discs.area, 6));
        }
        if self.flow.cone.is_some() {
            add("existence", "no connected minimal surface spans both loops".into());
        }
        if let Some(neck) = &self.flow.neck {
            add("narrowest neck", Text::from("of length ").number(neck.length, 3));
        }
        facts
    }

    /// A picture of the first and the last surface, of the given size in pixels.
    ///
    /// # Errors
    /// [`FigureError`] for a size that is none.
    pub fn image(&self, width: u32, height: u32, theme: Theme, view: View) -> Result<Image, FigureError> {
        let mesh = |frame: &Frame| -> Result<TriMesh, MeshError> {
            TriMesh::new(frame.positions.clone(), frame.faces.clone())
        };
        let shown = [self.frames.first(), self.frames.last()].into_iter().flatten();
        let meshes: Vec<(usize, TriMesh)> =
            shown.filter_map(|frame| mesh(frame).ok().map(|mesh| (frame.step, mesh))).collect();
        let mut figure = Figure::new(width, height).with_theme(theme).with_view(view);
        for (step, mesh) in &meshes {
            let area = self.flow.history.get(*step).map_or(f64::NAN, |record| record.area);
            figure = figure.with_panel(Panel::new(mesh).with_title(format!("step {step}, area {area:.6}")));
        }
        figure.draw()
    }
}

/// What is told of a step.
fn told(step: usize, record: Option<&FlowRecord>) -> Text {
    let Some(record) = record else { return Text::from(format!("step {step}")) };
    let mut text = Text::from(format!("step {step}, area ")).number(record.area, 8);
    if let Some(time) = record.time {
        text = text.text(", time ").number(time, 4);
    }
    text.text(format!(", {} ({})", record.scheme.name(), record.reason.name()))
}
