//! The page of a run: its surfaces over time, and charts of what was measured.

use super::ContactFrame;
use crate::{Bodies, ContactStep, Obstacle};
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_figures::names::axis;
use pompeiu_figures::page::{
    Block, Card, Chart, ChartAxis, Fact, Layer, Mesh, MeshId, MeshValues, Page, PageError, Paint, Player,
    PlayerControls, PlayerId, Scene, Series, Shape, Space, SpaceId, Text, ValueScale,
};
use pompeiu_figures::{
    ColorMap, Figure, FigureError, Image, Panel, Scale, Theme, Values, View, vertex_normals,
};
use std::f64::consts::{PI, TAU};

/// The page of a run.
#[derive(Clone, Debug)]
pub struct ContactPage<'r> {
    /// What the run is called.
    pub name: &'r str,
    /// The bodies and obstacles.
    pub bodies: &'r Bodies,
    /// The distance below which surfaces push each other.
    pub distance: f64,
    /// What was measured at the start.
    pub start: &'r ContactStep,
    /// What was measured after each step.
    pub steps: &'r [ContactStep],
    /// Frames, in order.
    pub frames: &'r [ContactFrame],
    /// What the exact test found, in words.
    pub certificate: String,
    /// Which way is up.
    pub up: [f64; 3],
    /// The command that makes the page again.
    pub command: Option<&'r str>,
}

/// Positions, and faces.
type Triangles = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Milliseconds from one frame to the next.
const INTERVAL: u32 = 80;

/// Segments around a ball that is drawn.
const SEGMENTS: usize = 48;

/// The half side of a plane that is drawn, in extents of the bodies.
const PLANE: f64 = 1.5;

impl ContactPage<'_> {
    /// The page as an HTML file.
    ///
    /// # Errors
    /// [`PageError`] if there is no frame, or one does not fit the bodies.
    pub fn html(&self) -> Result<String, PageError> {
        let mut page = Page::new(format!("Contact: {}", self.name));
        page.subtitle = Text::from(format!("{}, ", self.name))
            .count(self.bodies.faces().len(), "face")
            .text(", ")
            .count(self.steps.len(), "step");
        page.picture = "contact".into();
        page.command = self.command.map(str::to_owned);
        env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
        let space = page.add_space(Space::Spatial(axis(self.up)));
        let player = page.add_player(Player {
            label: "Step".into(),
            steps: self.frames.len(),
            interval: INTERVAL,
            repeats: true,
            ..Player::default()
        })?;
        let mut scene = Scene::new("bodies", space);
        scene.layers = vec![self.surfaces(&mut page, space, player)?];
        for obstacle in &self.bodies.obstacles {
            let (positions, triangles) = self.drawn(obstacle);
            let mesh = page.add_mesh(space, Mesh::new("obstacle", positions, triangles))?;
            scene.layers.push(Layer::new(Shape::Surface { mesh, paint: Paint::Plain, bounds: None }));
        }
        page.add_scene(scene)?;
        let steps = self.frames.iter().map(|frame| self.told(frame)).collect();
        page.set_player_below(PlayerControls { player, steps, off: Text::default() })?;
        self.add_charts(&mut page, player)?;
        page.add_card(Card::new("Run", vec![Block::Facts(self.facts()), Block::Run]))?;
        Ok(page.html())
    }

    /// The surfaces of all frames, coloured by how far they are from where they started.
    fn surfaces(&self, page: &mut Page, space: SpaceId, player: PlayerId) -> Result<Layer, PageError> {
        let scale = page
            .add_scale(ValueScale { title: "distance from the start".to_owned(), ..ValueScale::default() })?;
        // Vertices inside of solids are not drawn.
        let mut number = vec![None; self.bodies.positions().len()];
        let mut used = Vec::new();
        let mut faces = self.bodies.faces().to_vec();
        for corner in faces.iter_mut().flatten() {
            let v = *corner as usize;
            *corner = *number[v].get_or_insert_with(|| {
                used.push(v);
                (used.len() - 1) as u32
            });
        }
        let mut shapes = Vec::with_capacity(self.frames.len());
        let mut first: Option<MeshId> = None;
        for frame in self.frames {
            let at = |v: &usize| frame.positions.get(*v).copied();
            let positions: Vec<[f64; 3]> = used.iter().filter_map(at).collect();
            let started = used.iter().map(|&v| self.bodies.positions()[v]);
            let moved = positions.iter().zip(started).map(|(x, start)| DVec3::from_array(*x).distance(start));
            let moved = moved.collect();
            let mesh = match first {
                Some(of) => page.add_moved_mesh(space, of, positions)?,
                None => page.add_mesh(space, Mesh::new(self.name, positions, faces.clone()))?,
            };
            first.get_or_insert(mesh);
            let values = page.add_values(mesh, scale, MeshValues::on_vertices(moved))?;
            shapes.push(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None });
        }
        Ok(Layer::over_time(player, shapes))
    }

    /// A picture of a frame, of the given size in pixels: the surfaces, coloured by how far they are from where they started, and the
    /// obstacles. All frames have the same scale and the same extent.
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
        let moved = |frame: &ContactFrame| -> Vec<f64> {
            let pairs = frame.positions.iter().zip(self.bodies.positions());
            pairs.map(|(x, start)| DVec3::from_array(*x).distance(*start)).collect()
        };
        let greatest = self.frames.iter().flat_map(moved).fold(0.0, |a, b| if b > a { b } else { a });
        let scale = Scale::new(ColorMap::Viridis, 0.0, if greatest > 0.0 { greatest } else { 1.0 })?;
        let mut figure = Figure::new(width, height).with_theme(theme).with_view(view.with_up(self.up));
        let Some(frame) = self.frames.get(frame) else { return figure.draw() };
        let (mut positions, mut faces) = (frame.positions.clone(), self.bodies.faces().to_vec());
        let mut values = moved(frame);
        for obstacle in &self.bodies.obstacles {
            let (drawn, triangles) = self.drawn(obstacle);
            let first = positions.len() as u32;
            // Obstacles have no distance, and the colour for that.
            values.resize(values.len() + drawn.len(), f64::NAN);
            positions.extend(drawn);
            faces.extend(triangles.iter().map(|face| face.map(|v| first + v)));
        }
        // Faces without extent at the corners of the box of all frames: the camera shows the same part of space in each.
        for corner in self.corners() {
            faces.push([positions.len() as u32; 3]);
            positions.push(corner);
            values.push(0.0);
        }
        // A frame that is no mesh, which no run has, is an empty picture.
        let Ok(mesh) = TriMesh::new(positions, faces) else { return figure.draw() };
        let normals = vertex_normals(&mesh);
        let title = format!("step {}, time {:.4}", frame.step, frame.time);
        let panel = Panel::new(&mesh).with_normals(&normals).with_values(Values::Vertices(&values));
        figure = figure.with_scale(scale, "distance from the start").with_panel(panel.with_title(title));
        figure.draw()
    }

    /// The corners of the box around all frames.
    fn corners(&self) -> impl Iterator<Item = [f64; 3]> {
        let all = || self.frames.iter().flat_map(|frame| &frame.positions).map(|x| DVec3::from_array(*x));
        let low = all().reduce(DVec3::min).unwrap_or_default();
        let high = all().reduce(DVec3::max).unwrap_or_default();
        (0..8).map(move |corner| {
            [0, 1, 2].map(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] })
        })
    }

    /// Triangles of an obstacle: a ball, or a square in a plane below the bodies.
    fn drawn(&self, obstacle: &Obstacle) -> Triangles {
        match *obstacle {
            Obstacle::Ball { centre, radius } => ball(centre, radius),
            Obstacle::HalfSpace { normal, offset } => {
                let all = || self.bodies.positions().iter().copied();
                let low = all().reduce(DVec3::min).unwrap_or_default();
                let high = all().reduce(DVec3::max).unwrap_or_default();
                let middle = 0.5 * (low + high);
                let centre = middle - normal * (normal.dot(middle) - offset);
                let side = normal.any_orthonormal_vector() * (PLANE * (high - low).max_element());
                let across = normal.cross(side);
                let corners = [-side - across, side - across, side + across, across - side];
                (corners.map(|corner| (centre + corner).to_array()).to_vec(), vec![[0, 1, 2], [0, 2, 3]])
            }
        }
    }

    fn add_charts(&self, page: &mut Page, player: PlayerId) -> Result<(), PageError> {
        if self.steps.iter().any(|step| step.least_gap.is_some()) {
            // No gap is known beyond the distance at which surfaces begin to push.
            let gaps = self.line("least gap", |step| step.least_gap.unwrap_or(self.distance));
            let title = Text::from("Least gap, as far as it is below ").number(self.distance, 3);
            page.add_card(Card::new(
                "Gap",
                vec![chart(player, "gap", title, "least gap", true, vec![gaps])],
            ))?;
        }
        let energies = vec![
            self.line("kinetic", |step| step.kinetic_energy),
            self.line("elastic", |step| step.elastic_energy),
            self.line("gravity", |step| step.potential_energy),
        ];
        let title = "Kinetic energy, elastic energy, energy of gravity".into();
        page.add_card(Card::new("Energy", vec![chart(player, "energy", title, "energy", false, energies)]))?;
        let iterations = self.line("Newton steps", |step| step.iterations as f64);
        let title = "Newton steps of each step in time".into();
        let chart = chart(player, "newton", title, "Newton steps", false, vec![iterations]);
        page.add_card(Card::new("Newton steps", vec![chart]))?;
        Ok(())
    }

    /// What was measured at a frame.
    fn measured(&self, frame: &ContactFrame) -> &ContactStep {
        frame.step.checked_sub(1).and_then(|i| self.steps.get(i)).unwrap_or(self.start)
    }

    /// A quantity with an entry for each frame, which the player marks.
    fn line(&self, label: &str, value: impl Fn(&ContactStep) -> f64) -> Series {
        let (x, y) = self.frames.iter().map(|frame| (frame.time, value(self.measured(frame)))).unzip();
        Series::Line { label: label.to_owned(), x, y }
    }

    fn told(&self, frame: &ContactFrame) -> Text {
        let text = Text::from(format!("step {}, time ", frame.step)).number(frame.time, 4);
        let step = self.measured(frame);
        let text = text.text(", ").count(step.pairs, "pair").text(" in contact");
        match step.least_gap {
            Some(gap) => text.text(", least gap ").number(gap, 3),
            None => text,
        }
    }

    fn facts(&self) -> Vec<Fact> {
        let mut facts = vec![Fact::new("intersections", self.certificate.clone())];
        let mut add = |name: &str, value: Text| facts.push(Fact::new(name, value));
        if let Some(gap) = self.steps.iter().filter_map(|step| step.least_gap).reduce(f64::min) {
            add("least gap", Text::default().number(gap, 4));
        }
        let iterations: usize = self.steps.iter().map(|step| step.iterations).sum();
        add("Newton steps", Text::from(iterations.to_string()));
        let most = self.steps.iter().map(|step| step.pairs).max().unwrap_or(0);
        add("most pairs in contact", Text::from(most.to_string()));
        facts
    }
}

fn chart(
    player: PlayerId,
    key: &str,
    title: Text,
    label: &str,
    logarithmic: bool,
    series: Vec<Series>,
) -> Block {
    Block::Chart(Chart {
        key: key.to_owned(),
        title,
        x: ChartAxis { label: "time".into(), ..ChartAxis::default() },
        y: ChartAxis { label: label.to_owned(), logarithmic, ..ChartAxis::default() },
        series,
        player: Some(player),
        ..Chart::default()
    })
}

/// A ball as circles of latitude between two poles.
fn ball(centre: DVec3, radius: f64) -> Triangles {
    let rings = SEGMENTS / 2;
    let mut positions = vec![(centre + DVec3::Z * radius).to_array()];
    for ring in 1..rings {
        let polar = PI * ring as f64 / rings as f64;
        for segment in 0..SEGMENTS {
            let around = TAU * segment as f64 / SEGMENTS as f64;
            let (s, c) = (libm::sin(polar), libm::cos(polar));
            let direction = DVec3::new(s * libm::cos(around), s * libm::sin(around), c);
            positions.push((centre + direction * radius).to_array());
        }
    }
    positions.push((centre - DVec3::Z * radius).to_array());
    let at = |ring: usize, segment: usize| (1 + (ring - 1) * SEGMENTS + segment % SEGMENTS) as u32;
    let last = (positions.len() - 1) as u32;
    let mut triangles = Vec::new();
    for segment in 0..SEGMENTS {
        triangles.push([0, at(1, segment), at(1, segment + 1)]);
        triangles.push([last, at(rings - 1, segment + 1), at(rings - 1, segment)]);
        for ring in 1..rings - 1 {
            let [a, b] = [at(ring, segment), at(ring, segment + 1)];
            let [c, d] = [at(ring + 1, segment), at(ring + 1, segment + 1)];
            triangles.extend([[a, c, d], [a, d, b]]);
        }
    }
    (positions, triangles)
}
