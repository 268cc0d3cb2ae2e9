//! The page of a run: the interface over time, and charts of pressures and solves.

use super::CoupleFrame;
use super::drawn::{Drawing, Strip};
use crate::WindowReport;
use crate::scenario::{RunReport, Scenario};
use pompeiu_figures::ColorMap;
use pompeiu_figures::page::{
    Block, Card, Chart, ChartAxis, Color, Fact, Layer, Lines, Mesh, MeshId, MeshValues, Page, PageError,
    Paint, Player, PlayerControls, PlayerId, ScaleId, Scene, Series, Shape, Space, SpaceId, Span, Text,
    ValueScale,
};

/// The page of a run.
///
/// # Limits
/// Pressures are those at the interface, not inside of the fluid. Small displacements are drawn larger, by a factor that the page says.
#[derive(Clone, Copy, Debug)]
pub struct CouplePage<'r> {
    /// What is coupled: piston, tube, channel, box.
    pub kind: &'r str,
    /// The problem.
    pub scenario: &'r Scenario,
    /// Windows that were asked for.
    pub windows: usize,
    /// The run.
    pub run: &'r RunReport,
    /// Frames, in order.
    pub frames: &'r [CoupleFrame],
    /// The command that makes the page again.
    pub command: Option<&'r str>,
}

/// Milliseconds from one frame to the next.
const INTERVAL: u32 = 80;

/// What a scene needs.
struct Made<'p> {
    page: &'p mut Page,
    space: SpaceId,
    player: PlayerId,
    drawing: Drawing,
}

impl CouplePage<'_> {
    /// The page as an HTML file. A run without a solved window has the answer alone.
    ///
    /// # Errors
    /// [`PageError`] if a frame does not fit the problem, or a value is not finite.
    pub fn html(&self) -> Result<String, PageError> {
        let mut page = Page::new(format!("Coupling: {}", self.kind));
        let done = self.run.windows.len();
        page.subtitle = Text::from(format!("{}, {}, {done} of ", self.kind, self.run.scheme))
            .count(self.windows, "window");
        page.picture = "couple".into();
        page.command = self.command.map(str::to_owned);
        env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
        let states = self.frames.iter().map(|frame| frame.x.as_slice());
        let mut facts = self.facts();
        // Numbers that make no sense were refused by the run.
        if let (Ok(drawing), false) = (Drawing::new(self.scenario, states), self.frames.is_empty()) {
            let factor = drawing.factor;
            if factor > 1.0 {
                let text = Text::from("displacements ").number(factor, 4).text(" times as large");
                facts.push(Fact::new("drawing", text));
            }
            let space = page.add_space(Space::Plane);
            let player = page.add_player(Player {
                label: "Window".into(),
                steps: self.frames.len(),
                interval: INTERVAL,
                repeats: true,
                ..Player::default()
            })?;
            self.add_scene(Made { page: &mut page, space, player, drawing })?;
            let steps = self.frames.iter().map(|frame| self.told(frame)).collect();
            page.set_player_below(PlayerControls { player, steps, off: Text::default() })?;
            self.add_charts(&mut page, player)?;
        }
        page.add_card(Card::new("Run", vec![Block::Facts(facts), Block::Run]))?;
        Ok(page.html())
    }

    /// The fluid and its wall in all frames, coloured by the pressure at the interface.
    fn add_scene(&self, made: Made<'_>) -> Result<(), PageError> {
        let Made { page, space, player, drawing } = made;
        let scale = page.add_scale(ValueScale {
            title: "pressure at the interface".to_owned(),
            colors: ColorMap::Vik,
            span: Span::Signed,
            ..ValueScale::default()
        })?;
        let (mut fluids, mut walls) = (Vec::new(), Vec::new());
        let mut first: [Option<MeshId>; 2] = [None; 2];
        for frame in self.frames {
            let (fluid, wall) = drawing.strips(&frame.x);
            let mesh = add_strip(page, space, ("fluid", &fluid), &mut first[0])?;
            let painted = match wall {
                Some(wall) => {
                    fluids.push(Shape::Surface { mesh, paint: Paint::Plain, bounds: None });
                    add_strip(page, space, ("wall", &wall), &mut first[1])?
                }
                None => mesh,
            };
            walls.push(painted_by(page, scale, painted, &frame.y, fluid.low.len())?);
        }
        let mut scene = Scene::new(self.kind, space);
        if !fluids.is_empty() {
            scene.layers.push(Layer::over_time(player, fluids));
        }
        scene.layers.push(Layer::over_time(player, walls));
        let rest = Lines { paths: drawing.rest(), color: Color::Ink, width: 1.0, ..Lines::default() };
        scene.layers.push(Layer::new(Shape::Lines(rest)));
        page.add_scene(scene)?;
        Ok(())
    }

    fn add_charts(&self, page: &mut Page, player: PlayerId) -> Result<(), PageError> {
        let is_each = self.frames.len() == self.run.windows.len();
        let title =
            if is_each { "Solves of each window" } else { "Solves a window, mean since the frame before" };
        let solves = self.line(|frame, since| {
            let count = frame.window.saturating_sub(since).max(1) as f64;
            self.windows_after(since, frame).iter().map(|window| window.solves as f64).sum::<f64>() / count
        });
        page.add_card(Card::new(title, vec![chart(player, "solves", title, "solves", solves)]))?;
        let pressure = self.line(|frame, _| frame.greatest_pressure);
        let title = "Greatest pressure, absolute";
        page.add_card(Card::new(title, vec![chart(player, "pressure", title, "pressure", pressure)]))
    }

    /// The windows after one, up to that of a frame.
    fn windows_after(&self, since: usize, frame: &CoupleFrame) -> &[WindowReport] {
        self.run.windows.get(since..frame.window).unwrap_or_default()
    }

    /// A quantity with an entry for each frame, which the player marks; from the frame, and the window of the frame before.
    fn line(&self, value: impl Fn(&CoupleFrame, usize) -> f64) -> [Vec<f64>; 2] {
        let mut since = 0;
        let entry = |frame: &CoupleFrame| {
            let y = value(frame, since);
            since = frame.window;
            (frame.window as f64, y)
        };
        let (x, y) = self.frames.iter().map(entry).unzip();
        [x, y]
    }

    fn told(&self, frame: &CoupleFrame) -> Text {
        let time = frame.window as f64 * self.scenario.time_step();
        let text = Text::from(format!("window {}, time ", frame.window)).number(time, 4);
        let window = frame.window.checked_sub(1).and_then(|i| self.run.windows.get(i));
        match window {
            Some(window) => text.text(", ").count(window.solves, "solve"),
            None => text,
        }
    }

    fn facts(&self) -> Vec<Fact> {
        let run = self.run;
        let mut facts = vec![Fact::new("scheme", run.scheme.as_str())];
        let mut add = |name: &str, value: Text| facts.push(Fact::new(name, value));
        add("solved", Text::from(format!("{} of ", run.windows.len())).count(self.windows, "window"));
        if let Some(mean) = run.mean_solves() {
            let most = run.windows.iter().map(|window| window.solves).max().unwrap_or(0);
            add("solves", Text::default().number(mean, 3).text(format!(" a window, at most {most}")));
        }
        let damped = run.windows.iter().filter(|window| window.damping < 1.0).count();
        if damped > 0 {
            add("damped", Text::default().count(damped, "window").text(", where the model alone failed"));
        }
        if let Some(added_mass) = run.added_mass {
            add("stability", added_mass.to_string().as_str().into());
        }
        if let Some(constant) = run.windows.last().and_then(|window| window.pressure_constant) {
            let text = Text::from("the constant of the pressure is chosen in each window, ");
            add("enclosed", text.number(constant, 4).text(" in the last"));
        }
        if let Some(distance) = run.from_monolithic {
            let text = Text::default().number(distance, 4);
            add(
                "reference",
                text.text(" from both solved at once (monolithic), relative to the greatest value"),
            );
        }
        if let Some(failure) = &run.failure {
            add("ended", failure.as_str().into());
        }
        facts
    }
}

/// A strip of a frame, which has the triangles of the first one.
fn add_strip(
    page: &mut Page,
    space: SpaceId,
    (name, strip): (&str, &Strip),
    first: &mut Option<MeshId>,
) -> Result<MeshId, PageError> {
    let mesh = match *first {
        Some(of) => page.add_moved_mesh(space, of, strip.positions())?,
        None => page.add_mesh(space, Mesh::new(name, strip.positions(), strip.triangles()))?,
    };
    first.get_or_insert(mesh);
    Ok(mesh)
}

/// A strip with a value at each place along it; one value is that of the whole strip.
fn painted_by(
    page: &mut Page,
    scale: ScaleId,
    mesh: MeshId,
    along: &[f64],
    count: usize,
) -> Result<Shape, PageError> {
    let along = if let [value] = along { vec![*value; count] } else { along.to_vec() };
    let values = page.add_values(mesh, scale, MeshValues::on_vertices([along.clone(), along].concat()))?;
    Ok(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None })
}

fn chart(player: PlayerId, key: &str, title: &str, label: &str, [x, y]: [Vec<f64>; 2]) -> Block {
    Block::Chart(Chart {
        key: key.to_owned(),
        title: title.into(),
        x: ChartAxis { label: "window".into(), ..ChartAxis::default() },
        y: ChartAxis { label: label.to_owned(), low: Some(0.0), ..ChartAxis::default() },
        series: vec![Series::Line { label: label.to_owned(), x, y }],
        player: Some(player),
        ..Chart::default()
    })
}
