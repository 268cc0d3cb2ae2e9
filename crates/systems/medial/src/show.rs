//! The page and the picture of medial balls.

use crate::Medial;
use pompeiu_core::{MeshError, TriMesh};
use pompeiu_figures::names::{axis, name};
use pompeiu_figures::page::{
    Block, Card, Color, Fact, Layer, Lines, Mesh, MeshValues, Page, PageError, Paint, Scene, Shape, Space,
    Text, ValueScale,
};
use pompeiu_figures::{ColorMap, Figure, FigureError, Image, Mark, Panel, Scale, Theme, Values, View};

/// The page of a surface and its medial balls.
#[derive(Clone, Debug)]
pub struct MedialPage<'r> {
    path: &'r str,
    mesh: &'r TriMesh,
    medial: &'r Medial,
    spheres: TriMesh,
    /// The up direction.
    pub up: [f64; 3],
    /// The command that reproduces the page.
    pub command: Option<&'r str>,
}

impl<'r> MedialPage<'r> {
    /// The page of the balls of a mesh with this name.
    ///
    /// # Errors
    /// [`MeshError`] if coordinates overflow.
    pub fn new(path: &'r str, mesh: &'r TriMesh, medial: &'r Medial) -> Result<Self, MeshError> {
        Ok(Self { path, mesh, medial, spheres: medial.spheres()?, up: [0.0, 1.0, 0.0], command: None })
    }

    /// The radius of the ball at each vertex of its sphere.
    fn radii(&self) -> Vec<f64> {
        let each = self.spheres.positions().len() / self.medial.balls.len().max(1);
        self.medial.balls.iter().flat_map(|ball| std::iter::repeat_n(ball.radius, each)).collect()
    }

    fn bones(&self) -> Vec<Vec<[f64; 3]>> {
        let centre = |i: u32| self.medial.balls[i as usize].centre;
        self.medial.edges.iter().map(|edge| edge.map(centre).to_vec()).collect()
    }

    /// The page as an HTML file.
    ///
    /// # Errors
    /// [`PageError`] if coordinates are not finite.
    pub fn html(&self) -> Result<String, PageError> {
        let Medial { balls, edges, deviation, .. } = self.medial;
        let mut page = Page::new(format!("Balls in {}", name(self.path)));
        page.subtitle = Text::from(format!("{}, ", name(self.path)))
            .count(balls.len(), "ball")
            .text(", ")
            .count(edges.len(), "edge");
        page.picture = "medial".into();
        page.command = self.command.map(str::to_owned);
        env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
        let space = page.add_space(Space::Spatial(axis(self.up)));
        let surface = page.add_mesh(space, Mesh::of(name(self.path), self.mesh))?;
        let spheres = page.add_mesh(space, Mesh::of("balls", &self.spheres))?;
        let scale = page.add_scale(ValueScale { title: "radius".into(), ..ValueScale::default() })?;
        let values = page.add_values(spheres, scale, MeshValues::on_vertices(self.radii()))?;
        let ghost = || Layer::new(Shape::Surface { mesh: surface, paint: Paint::Ghost, bounds: None });
        let painted = Shape::Surface { mesh: spheres, paint: Paint::Values(values), bounds: None };
        let lines = Lines { paths: self.bones(), color: Color::Accent, width: 3.0, ..Lines::default() };
        for (label, layer) in [("balls", painted), ("edges", Shape::Lines(lines))] {
            let mut scene = Scene::new(label, space);
            scene.layers = vec![ghost(), Layer::new(layer)];
            page.add_scene(scene)?;
        }
        let text = Text::from("Every point of the surface lies within ")
            .number(deviation.surface_to_balls[1], 5)
            .text(" of the balls, and one of them at least ")
            .number(deviation.surface_to_balls[0], 5)
            .text(" away; the balls reach out of the surface by at most ")
            .number(deviation.balls_to_surface, 5)
            .text(".");
        page.add_card(Card::new("Deviation", vec![Block::Text(text)]))?;
        let overlaps = Text::default().count(self.medial.overlaps().len(), "pair of balls");
        let facts = vec![
            Fact::new("overlapping", overlaps),
            Fact::new("shrunk balls", Text::default().count(self.medial.shrunk, "ball")),
        ];
        page.add_card(Card::new("Balls and run", vec![Block::Facts(facts), Block::Run]))?;
        Ok(page.html())
    }

    /// A picture of the surface with its balls beside it, of the given size in pixels.
    ///
    /// # Errors
    /// [`FigureError`] for an invalid size or view.
    pub fn image(&self, width: u32, height: u32, theme: Theme, view: View) -> Result<Image, FigureError> {
        let radii = self.radii();
        let most = radii.iter().copied().fold(0.0, f64::max);
        let scale = Scale::new(ColorMap::Viridis, 0.0, most)?;
        let plain = Panel::new(self.mesh).with_title("surface");
        let mut balls = Panel::new(&self.spheres).with_values(Values::Vertices(&radii)).with_title("balls");
        for bone in self.bones() {
            balls = balls.with_mark(Mark::segment(bone[0], bone[1]).with_width(2.0));
        }
        let figure = Figure::new(width, height).with_theme(theme).with_view(view);
        figure.with_scale(scale, "radius").with_panel(plain).with_panel(balls).draw()
    }
}
