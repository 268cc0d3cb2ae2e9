//! The page and the picture of a flat map.

use crate::pack::bounds;
use crate::{Flattening, MeanMax};
use pompeiu_core::TriMesh;
use pompeiu_figures::names::{axis, name};
use pompeiu_figures::page::{
    Amount, Block, Card, Color, Fact, Layer, Lines, Mesh, MeshValues, Page, PageError, Paint, Scene, Shape,
    Space, Statistic, Text, ValueScale,
};
use pompeiu_figures::{ColorMap, Figure, FigureError, Image, Mark, Panel, Scale, Theme, Values, View};
use pompeiu_surface::EmbeddedSurface;

/// The page of a surface and its flat map.
#[derive(Clone, Copy, Debug)]
pub struct FlattenPage<'r> {
    /// The file of the mesh or another name.
    pub path: &'r str,
    /// The surface.
    pub surface: &'r EmbeddedSurface,
    /// Its map.
    pub flat: &'r Flattening,
    /// The up direction.
    pub up: [f64; 3],
    /// The command that reproduces the page.
    pub command: Option<&'r str>,
}

/// The greatest change of length shown by colours.
const MOST_SHOWN: f64 = 4.0;

/// The colour of outlines in pictures.
const OUTLINE: pompeiu_figures::Rgb = [200, 40, 40];

impl FlattenPage<'_> {
    /// The greatest change of length on each face, clamped to a factor of four, flipped faces included.
    fn values(&self) -> Vec<f64> {
        let change = |&[s, t]: &[f64; 2]| {
            let shrinking = if t > 0.0 { 1.0 / t } else { MOST_SHOWN };
            (if s > shrinking { s } else { shrinking }).min(MOST_SHOWN)
        };
        self.flat.singular_values.iter().map(change).collect()
    }

    /// The positions of the map in space, scaled to the size of the surface.
    fn places(&self) -> Vec<[f64; 3]> {
        let factor = self.flat.report.distortion.scale;
        self.flat.uv.iter().map(|[x, y]| [factor * x, factor * y, 0.0]).collect()
    }

    /// The cut edges and the boundary, on the surface and on the map.
    fn outlines(&self, positions: &[[f64; 3]]) -> Vec<Vec<[f64; 3]>> {
        self.flat.outline().into_iter().map(|ends| ends.map(|v| positions[v as usize]).to_vec()).collect()
    }

    /// The page as an HTML file.
    ///
    /// # Errors
    /// [`PageError`] if coordinates are not finite.
    pub fn html(&self) -> Result<String, PageError> {
        let report = &self.flat.report;
        let mut page = Page::new(format!("{} laid flat", name(self.path)));
        page.subtitle = Text::from(format!("{}, ", name(self.path)))
            .count(self.flat.opened.faces().len(), "face")
            .text(", ")
            .count(report.charts, "chart");
        page.picture = "flatten".into();
        page.command = self.command.map(str::to_owned);
        env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
        let space = page.add_space(Space::Spatial(axis(self.up)));
        let plane = page.add_space(Space::Plane);
        let (positions, places) = (self.flat.opened.spread(self.surface.positions()), self.places());
        let triangles = self.flat.opened.faces().to_vec();
        let mesh = page.add_mesh(space, Mesh::new(name(self.path), positions.clone(), triangles))?;
        let map = page.add_moved_mesh(plane, mesh, places.clone())?;
        let scale = ValueScale { title: "greatest change of lengths".into(), ..ValueScale::default() };
        let scale = page.add_scale(scale)?;
        let values = page.add_values(mesh, scale, MeshValues::on_faces(self.values()))?;
        for (label, space, mesh, points) in
            [("surface", space, mesh, &positions), ("map", plane, map, &places)]
        {
            let mut scene = Scene::new(label, space);
            let lines =
                Lines { paths: self.outlines(points), color: Color::Accent, width: 2.0, ..Lines::default() };
            scene.layers = vec![
                Layer::new(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None }),
                Layer::new(Shape::Lines(lines)),
            ];
            page.add_scene(scene)?;
        }
        page.add_card(Card::new("Verdict", self.verdict()))?;
        let meaning = "Means over the area of the surface: symmetric Dirichlet energy (4 where lengths are kept), ratio of singular values, change of \
             areas, greatest change of lengths, L2 and L∞ stretch (each 1 where nothing is changed).";
        let distortion = vec![Block::Statistics(self.statistics()), Block::Note(meaning.into())];
        page.add_card(Card::new("Distortion", distortion))?;
        page.add_card(Card::new("Cut and run", vec![Block::Facts(self.facts()), Block::Run]))?;
        Ok(page.html())
    }

    fn verdict(&self) -> Vec<Block> {
        let report = &self.flat.report;
        let answer =
            if report.is_one_to_one() { "The map is one-to-one: " } else { "The map is not one-to-one: " };
        let text = Text::from(answer)
            .count(report.flipped, "flipped face")
            .text(", ")
            .count(report.overlapping, "overlapping face")
            .text(".");
        let note = "Decided by exact predicates on the coordinates of the map as they are stored.";
        vec![Block::Text(text), Block::Note(note.into())]
    }

    fn statistics(&self) -> Vec<Statistic> {
        let distortion = &self.flat.report.distortion;
        let one = |key: &str, name: &str, number: f64, max: f64| {
            let note =
                if max.is_finite() { Text::from("at most ").number(max, 5) } else { "without bound".into() };
            let is_shown = number.is_finite();
            Statistic {
                key: key.to_owned(),
                name: name.to_owned(),
                value: Amount::Number { number: if is_shown { number } else { 0.0 }, digits: 5 },
                note: if is_shown { note } else { "without bound, for faces are flipped".into() },
                ..Statistic::default()
            }
        };
        let of = |key: &str, name: &str, value: MeanMax| one(key, name, value.mean, value.max);
        let energy = distortion.symmetric_dirichlet;
        vec![
            one("symmetric-dirichlet", "Dirichlet", energy.mean, energy.max),
            of("angle", "angles", distortion.angle),
            of("area", "areas", distortion.area),
            of("isometric", "lengths", distortion.isometric),
            one("stretch", "stretch", distortion.stretch_l2, distortion.stretch_linf),
        ]
    }

    fn facts(&self) -> Vec<Fact> {
        let report = &self.flat.report;
        let cut =
            Text::default().count(report.cut.edges, "edge").text(", of length ").number(report.cut.length, 5);
        let strategy = Fact::new("chosen by", report.cut.strategy);
        vec![
            Fact::new("cut", cut),
            strategy,
            Fact::new("method", report.method),
            Fact::new("weights", report.weights),
        ]
    }

    /// A picture of the surface with its map beside it, on the same colour scale, of the given size in pixels.
    ///
    /// # Errors
    /// [`FigureError`] for an invalid size or view.
    pub fn image(&self, width: u32, height: u32, theme: Theme, view: View) -> Result<Image, FigureError> {
        let faces = self.flat.opened.faces();
        let positions = self.flat.opened.spread(self.surface.positions());
        // The map faces the camera, with the size of the surface.
        let [right, up, _] = view.frame()?;
        let places = self.places();
        let (centre, size) = middle(&positions);
        let (flat_centre, flat_size) = middle(&places);
        let factor = if flat_size > 0.0 { size / flat_size } else { 1.0 };
        let stand = |p: &[f64; 3]| -> [f64; 3] {
            let [x, y] = [0, 1].map(|k| factor * (p[k] - flat_centre[k]));
            [0, 1, 2].map(|k| centre[k] + x * right[k] + y * up[k])
        };
        let standing: Vec<[f64; 3]> = places.iter().map(stand).collect();
        let values = self.values();
        let most = values.iter().copied().fold(1.0, f64::max);
        let scale = Scale::new(ColorMap::Viridis, 1.0, if most > 1.0 { most } else { 2.0 })?;
        let mut figure = Figure::new(width, height).with_theme(theme).with_view(view);
        figure = figure.with_scale(scale, "greatest change of lengths");
        let meshes: Vec<(&str, Vec<[f64; 3]>, TriMesh)> = [("surface", positions), ("map", standing)]
            .into_iter()
            .filter_map(|(title, points)| {
                let mesh = TriMesh::new(points.clone(), faces.to_vec()).ok()?;
                Some((title, points, mesh))
            })
            .collect();
        for (title, points, mesh) in &meshes {
            let mut panel = Panel::new(mesh).with_values(Values::Faces(&values)).with_title(*title);
            for path in self.outlines(points) {
                let mark = Mark::segment(path[0], path[1]).with_width(2.0).with_color(OUTLINE);
                panel = panel.with_mark(mark.with_opacity_behind(0.0));
            }
            figure = figure.with_panel(panel);
        }
        figure.draw()
    }
}

/// The centre of the bounding box of some points, and its longest side.
fn middle(points: &[[f64; 3]]) -> ([f64; 3], f64) {
    let [lower, upper] = bounds(points);
    let size = (0..3).map(|k| upper[k] - lower[k]).fold(0.0, f64::max);
    ([0, 1, 2].map(|k| 0.5 * (lower[k] + upper[k])), size)
}
