//! Interactive pages: one self-contained HTML file each, which makes no network requests.
//!
//! A [`Page`] is composed of generic parts. Each system composes its page in its own `show` module. The part that runs in the
//! browser (`web/`, bundled in `web/dist` so that nobody needs node to build this crate) interprets the parts, and has no code for
//! a particular page.
//!
//! # Parts
//! - A [`Space`] is a coordinate system, spatial or planar, with one camera.
//! - A [`Mesh`] lies in a space: triangles given by vertices or by corners, polygons, or another mesh with moved vertices.
//! - [`MeshValues`] are numbers or vectors at corners, vertices or faces of a mesh. A [`ValueScale`] colours them.
//! - A [`Player`] steps through time: layers with one [`Shape`] per step, charts that mark the current step.
//! - A [`Scene`] is a pane of the view, made of [layers](Layer): surfaces, arrows, curves, points, pairs of points. Tables, lists
//!   and scatter plots link to its [places](Place).
//! - An [`Arrangement`] lists the scenes that are shown together. Panes are linked: scenes of one space share their camera, and the
//!   point under the cursor on one mesh is marked on [linked](Page::link_meshes) meshes in the other panes.
//! - A [`Card`] stands beside the view and is made of [blocks](Block): paragraphs, statistics, facts, buttons, a threshold, the
//!   controls of a player, places, charts and tables. A page without scenes has only cards.
//!
//! Each part is checked when it is added, and refers to others by the ids returned for them. So every added part can be shown, and
//! [`Page::html`] cannot fail.
//!
//! # How a system composes a page
//! ```
//! use pompeiu_core::mesh::shapes::icosphere;
//! use pompeiu_figures::page::*;
//!
//! let sphere = icosphere(1.0, 2)?;
//! let mut page = Page::new("The height of a sphere");
//! let space = page.add_space(Space::Spatial(Axis::Z));
//! let mesh = page.add_mesh(space, Mesh::of("sphere", &sphere))?;
//! let scale = page.add_scale(ValueScale { title: "height".into(), unit: "mm".into(), span: Span::Signed, ..ValueScale::default() })?;
//! let heights = MeshValues::on_vertices(sphere.positions().iter().map(|p| p[2]).collect());
//! let values = page.add_values(mesh, scale, heights)?;
//! let mut scene = Scene::new("height", space);
//! scene.layers.push(Layer::new(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None }));
//! page.add_scene(scene)?;
//! let value = Amount::Enclosure { ends: [12.5, 12.6] };
//! let area = Statistic { name: "area".into(), value, unit: "mm²".into(), ..Statistic::default() };
//! page.add_card(Card::new("Numbers", vec![Block::Statistics(vec![area]), Block::Run]))?;
//! assert!(page.html().contains("The height of a sphere"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Accuracy
//! Values, vectors and enclosures are transferred in double precision: the page shows the given values to the last bit, and rounds
//! ends of enclosures outwards. Coordinates are rounded to single precision relative to the middle of their space, so that large
//! offsets cost no digits.
//!
//! # Cost
//! Linear in the size of the data. A page takes 0.7 MB, plus some 30 bytes for each face of a mesh with values at corners.

mod banner;
mod card;
mod chart;
mod document;
mod encode;
mod error;
mod ids;
mod mesh;
mod mesh_values;
mod player;
mod scene;
mod space;
mod table;
mod text;
mod values;

pub use banner::{Banner, BannerKind};
pub use card::{Amount, Block, Button, Card, Classes, Fact, PlaceItem, PlaceList, Statistic, Threshold};
pub use chart::{Chart, ChartAxis, ScatterPoint, Series};
pub use error::PageError;
pub use ids::{BoundsId, MeshId, PlaceId, PlayerId, ScaleId, SceneId, SpaceId, ToggleId, ValuesId};
pub use mesh::{Mesh, Polygon};
pub use mesh_values::MeshValues;
pub use player::{Player, PlayerControls};
pub use scene::{Color, Layer, Lines, Paint, Pair, Place, PointPair, Points, Scene, Shape};
pub use space::{Axis, Space};
pub use table::{Cell, Row, Table};
pub use text::Text;
pub use values::{Range, RangeEnd, Span, ValueScale};

use crate::Image;
use encode::doubles;
use error::{check_bounds, check_faces, check_finite, check_length};
use mesh::{Geometry, PlacedMesh, SharedCorners};
use rayon::prelude::*;
use serde_json::{Value, json};
use space::Placement;
use values::{PlacedValues, RangedScale};

/// `[lower, upper]`: an interval that contains a number, ends included.
pub type Bounds = [f64; 2];

/// A page to explore in a browser; see the [module](self).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Page {
    title: String,
    /// The subtitle.
    pub subtitle: Text,
    /// The answer above everything else, if there is one.
    pub banner: Option<Banner>,
    /// The answer in one sentence, for readers without scripts.
    pub summary: String,
    /// File name for a saved picture of the view, without `.png`.
    pub picture: String,
    /// The command that reproduces this page.
    pub command: Option<String>,
    /// The version of the program.
    pub version: String,
    /// A picture to show if the browser cannot draw the scenes.
    pub still: Option<Image>,
    spaces: Vec<Space>,
    meshes: Vec<PlacedMesh>,
    values: Vec<PlacedValues>,
    bounds: Vec<(MeshId, Vec<Bounds>)>,
    scales: Vec<RangedScale>,
    players: Vec<Player>,
    toggles: Vec<(String, bool)>,
    scenes: Vec<Scene>,
    arrangements: Vec<Arrangement>,
    below: Option<PlayerControls>,
    opening: Option<SceneId>,
    cards: Vec<Card>,
}

/// Scenes that are shown together.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Arrangement {
    /// Identifier for scripts and tests.
    pub key: String,
    /// Its label.
    pub text: String,
    /// A longer description.
    pub hint: String,
    /// The scenes, from left to right and from top to bottom.
    pub scenes: Vec<SceneId>,
}

impl Page {
    /// An empty page.
    pub fn new(title: impl Into<String>) -> Self {
        let title = title.into();
        Self { summary: format!("{title}."), title, picture: "picture".into(), ..Self::default() }
    }

    /// The title.
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Adds a coordinate system.
    pub fn add_space(&mut self, space: Space) -> SpaceId {
        self.spaces.push(space);
        SpaceId(self.spaces.len() - 1)
    }

    /// Adds a mesh.
    ///
    /// # Errors
    /// [`PageError`] if there is no triangle, a coordinate is not finite, or a vertex or face does not exist.
    pub fn add_mesh(&mut self, space: SpaceId, mesh: Mesh) -> Result<MeshId, PageError> {
        self.place_mesh(space, Geometry::Triangles(mesh), self.meshes.len())
    }

    /// Adds a mesh again with other vertex positions, possibly in another space. The two meshes are linked.
    ///
    /// # Errors
    /// [`PageError`] if the number of positions differs from the number of vertices, a coordinate is not finite, or the mesh has no
    /// vertices of its own because it is made of polygons.
    pub fn add_moved_mesh(
        &mut self,
        space: SpaceId,
        of: MeshId,
        positions: Vec<[f64; 3]>,
    ) -> Result<MeshId, PageError> {
        let mesh = of.of(&self.meshes)?;
        let (of, link) = match mesh.geometry {
            Geometry::Moved { of, .. } => (of, mesh.link),
            _ => (of, mesh.link),
        };
        self.place_mesh(space, Geometry::Moved { of, positions }, link)
    }

    /// Adds polygons in the plane; each is a face, called `element`.
    ///
    /// # Errors
    /// [`PageError`] if there is no polygon, one has fewer than three points, or a coordinate is not finite.
    pub fn add_polygons(
        &mut self,
        space: SpaceId,
        name: impl Into<String>,
        element: impl Into<String>,
        polygons: Vec<Polygon>,
    ) -> Result<MeshId, PageError> {
        let geometry = Geometry::Polygons { name: name.into(), element: element.into(), polygons };
        self.place_mesh(space, geometry, self.meshes.len())
    }

    fn place_mesh(&mut self, space: SpaceId, geometry: Geometry, link: usize) -> Result<MeshId, PageError> {
        space.of(&self.spaces)?;
        let mesh = PlacedMesh { space, geometry, link };
        mesh.check(self.meshes.len(), &self.meshes)?;
        self.meshes.push(mesh);
        Ok(MeshId(self.meshes.len() - 1))
    }

    /// Links two meshes whose triangles correspond one to one and corner by corner: a surface and its map to the plane, cut open or
    /// not. The point under the cursor on one is marked on the other.
    ///
    /// # Errors
    /// [`PageError`] if they have different numbers of triangles.
    pub fn link_meshes(&mut self, one: MeshId, other: MeshId) -> Result<(), PageError> {
        let (a, b) = (one.of(&self.meshes)?, other.of(&self.meshes)?);
        let count = |mesh: &PlacedMesh| [mesh.triangle_count(&self.meshes), mesh.face_count(&self.meshes)];
        for (found, expected) in count(b).into_iter().zip(count(a)) {
            check_length("a linked mesh", found, expected)?;
        }
        let (to, from) = (a.link, b.link);
        for mesh in self.meshes.iter_mut().filter(|mesh| mesh.link == from) {
            mesh.link = to;
        }
        Ok(())
    }

    /// Adds a scale.
    ///
    /// # Errors
    /// [`PageError`] if its threshold or span is not finite, or its span is reversed.
    pub fn add_scale(&mut self, scale: ValueScale) -> Result<ScaleId, PageError> {
        let scale = RangedScale { scale, ranges: vec![], first: 0 };
        scale.check()?;
        self.scales.push(scale);
        Ok(ScaleId(self.scales.len() - 1))
    }

    /// Adds a range that users can select for a scale. The first one must contain all values; it is selected at first unless
    /// [`start_with_range`](Self::start_with_range) selects another. By default the scale ends at the greatest absolute value.
    ///
    /// # Errors
    /// [`PageError`] if an end is not finite, or a scene or the scale does not exist.
    pub fn add_range(&mut self, scale: ScaleId, range: Range) -> Result<(), PageError> {
        scale.of(&self.scales)?;
        if let RangeEnd::Scenes(ends) = &range.end {
            check_finite("the end of a range", ends.iter().map(|(_, end)| end))?;
            ends.iter().try_for_each(|(scene, _)| scene.of(&self.scenes).map(|_| ()))?;
        }
        self.scales[scale.0].ranges.push(range);
        Ok(())
    }

    /// Selects the initial range among those added so far.
    ///
    /// # Errors
    /// [`PageError`] if the scale does not exist, or has no such range.
    pub fn start_with_range(&mut self, scale: ScaleId, choice: usize) -> Result<(), PageError> {
        scale.of(&self.scales)?;
        let scale = &mut self.scales[scale.0];
        let count = scale.ranges.len();
        if choice >= count {
            return Err(PageError::Unknown { what: "choice of where a scale ends", index: choice, count });
        }
        scale.first = choice;
        Ok(())
    }

    /// Adds values on a mesh. They can be shown on the mesh and on every moved copy of it.
    ///
    /// # Errors
    /// [`PageError`] if their number is not that of corners, vertices or faces, or one is not finite.
    pub fn add_values(
        &mut self,
        mesh: MeshId,
        scale: ScaleId,
        values: MeshValues,
    ) -> Result<ValuesId, PageError> {
        scale.of(&self.scales)?;
        let values = PlacedValues { mesh: self.unmoved(mesh)?, scale, values };
        values.check(&self.meshes)?;
        self.values.push(values);
        Ok(ValuesId(self.values.len() - 1))
    }

    /// Adds an enclosure for each face of a mesh.
    ///
    /// # Errors
    /// [`PageError`] if their number is not that of the faces, or one is not a valid interval.
    pub fn add_bounds(&mut self, mesh: MeshId, bounds: Vec<Bounds>) -> Result<BoundsId, PageError> {
        let faces = mesh.of(&self.meshes)?.face_count(&self.meshes);
        check_length("the list of bounds of faces", bounds.len(), faces)?;
        check_bounds("the list of bounds of faces", &bounds)?;
        self.bounds.push((mesh, bounds));
        Ok(BoundsId(self.bounds.len() - 1))
    }

    /// Adds steps over time.
    ///
    /// # Errors
    /// [`PageError::Length`] if there is no step.
    pub fn add_player(&mut self, player: Player) -> Result<PlayerId, PageError> {
        if player.steps == 0 {
            return Err(PageError::Length { what: "a player, of at least one step,", found: 0, expected: 1 });
        }
        self.players.push(player);
        Ok(PlayerId(self.players.len() - 1))
    }

    /// Adds a toggle for layers.
    pub fn add_toggle(&mut self, text: impl Into<String>, on: bool) -> ToggleId {
        self.toggles.push((text.into(), on));
        ToggleId(self.toggles.len() - 1)
    }

    /// Adds a scene.
    ///
    /// # Errors
    /// [`PageError`] if it refers to parts that the page does not have or that do not belong together, or a number is not finite.
    pub fn add_scene(&mut self, scene: Scene) -> Result<SceneId, PageError> {
        scene.space.of(&self.spaces)?;
        for layer in &scene.layers {
            self.check_layer(layer, scene.space)?;
        }
        for place in &scene.places {
            check_finite("a place", place.center.iter().chain([&place.radius]))?;
            if let Some(PointPair { from, to }) = &place.pair {
                check_finite("the pair of a place", from.iter().chain(to))?;
            }
            let faces = match place.mesh {
                Some(mesh) => mesh.of(&self.meshes)?.face_count(&self.meshes),
                None => 0,
            };
            check_faces("the list of faces of a place", &place.faces, faces)?;
        }
        self.scenes.push(scene);
        Ok(SceneId(self.scenes.len() - 1))
    }

    fn check_layer(&self, layer: &Layer, space: SpaceId) -> Result<(), PageError> {
        let steps = match layer.player {
            Some(player) => player.of(&self.players)?.steps,
            None => 1,
        };
        if layer.frames.is_empty() || layer.frames.len() > steps {
            let what = "a layer, of a frame for each step at most,";
            return Err(PageError::Length { what, found: layer.frames.len(), expected: steps });
        }
        if let Some(player) = layer.plain_while {
            player.of(&self.players)?;
        }
        if let Some(toggle) = layer.toggle {
            toggle.of(&self.toggles)?;
        }
        for shape in &layer.frames {
            shape.check()?;
            if let Some(scale) = shape.scale() {
                scale.of(&self.scales)?;
            }
            match *shape {
                Shape::Surface { mesh, paint, bounds } => {
                    self.check_space(mesh, space)?;
                    if let Paint::Values(values) = paint {
                        self.check_mesh(values.of(&self.values)?.mesh, mesh)?;
                    }
                    if let Some(bounds) = bounds {
                        let of = bounds.of(&self.bounds)?.0;
                        self.check_mesh(self.unmoved(of)?, mesh)?;
                    }
                }
                Shape::Arrows { mesh, vectors } => {
                    self.check_space(mesh, space)?;
                    let vectors = vectors.of(&self.values)?;
                    self.check_mesh(vectors.mesh, mesh)?;
                    if !vectors.is_vector() {
                        return Err(PageError::Length { what: "a vector", found: 1, expected: 3 });
                    }
                }
                _ => {}
            }
        }
        Ok(())
    }

    fn check_space(&self, mesh: MeshId, space: SpaceId) -> Result<(), PageError> {
        let found = mesh.of(&self.meshes)?.space;
        if found == space { Ok(()) } else { Err(PageError::Apart { what: "mesh", of: "space" }) }
    }

    /// Checks that values of one mesh are shown on that mesh, or on a moved copy of it.
    fn check_mesh(&self, of: MeshId, on: MeshId) -> Result<(), PageError> {
        if self.unmoved(on)? == of {
            Ok(())
        } else {
            Err(PageError::Apart { what: "array of values", of: "mesh" })
        }
    }

    fn unmoved(&self, mesh: MeshId) -> Result<MeshId, PageError> {
        Ok(match mesh.of(&self.meshes)?.geometry {
            Geometry::Moved { of, .. } => of,
            _ => mesh,
        })
    }

    /// Adds an arrangement of scenes; the first one is shown at first. By default all scenes are shown together.
    ///
    /// # Errors
    /// [`PageError`] if it has no scene, or one that does not exist.
    pub fn add_arrangement(&mut self, arrangement: Arrangement) -> Result<(), PageError> {
        if arrangement.scenes.is_empty() {
            return Err(PageError::Length {
                what: "an arrangement, of at least one scene,",
                found: 0,
                expected: 1,
            });
        }
        arrangement.scenes.iter().try_for_each(|scene| scene.of(&self.scenes).map(|_| ()))?;
        self.arrangements.push(arrangement);
        Ok(())
    }

    /// Opens the page with a scene, turned so that its first [pair](Shape::Pairs) is seen from outside of what is drawn. By default the first
    /// arrangement is seen from a corner.
    ///
    /// # Errors
    /// [`PageError`] if the scene does not exist.
    pub fn open_with(&mut self, scene: SceneId) -> Result<(), PageError> {
        scene.of(&self.scenes)?;
        self.opening = Some(scene);
        Ok(())
    }

    /// Puts the controls of a player below the view.
    ///
    /// # Errors
    /// As for cards.
    pub fn set_player_below(&mut self, controls: PlayerControls) -> Result<(), PageError> {
        self.check_controls(&controls)?;
        Block::Player(controls.clone()).check()?;
        self.below = Some(controls);
        Ok(())
    }

    /// Adds a card beside the view.
    ///
    /// # Errors
    /// [`PageError`] if it refers to a part that the page does not have, a number is not finite, an interval is reversed, or lists
    /// that belong together differ in length.
    pub fn add_card(&mut self, card: Card) -> Result<(), PageError> {
        if let Some(scene) = card.scene {
            scene.of(&self.scenes)?;
        }
        for block in &card.blocks {
            block.check()?;
            self.check_block(block)?;
        }
        self.cards.push(card);
        Ok(())
    }

    /// Checks that the parts that a block refers to exist.
    fn check_block(&self, block: &Block) -> Result<(), PageError> {
        let scale = |scale: Option<ScaleId>| scale.map_or(Ok(()), |id| id.of(&self.scales).map(|_| ()));
        match block {
            Block::Threshold(Threshold { scale: of, bounds, .. }) => {
                scale(Some(*of))?;
                bounds.map_or(Ok(()), |bounds| bounds.of(&self.bounds).map(|_| ()))
            }
            Block::Player(controls) => self.check_controls(controls),
            Block::Places(list) => {
                scale(list.scale)?;
                list.items.iter().try_for_each(|item| self.check_place(item.place))
            }
            Block::Chart(chart) => {
                scale(chart.scale)?;
                if let Some(player) = chart.player {
                    player.of(&self.players)?;
                }
                chart.series.iter().flat_map(Series::places).try_for_each(|place| self.check_place(place))
            }
            Block::Table(table) => {
                table.rows.iter().filter_map(|row| row.place).try_for_each(|place| self.check_place(place))
            }
            Block::Classes(classes) => {
                let expected = classes.scale.of(&self.scales)?.scale.bands.len() + 1;
                classes.values.of(&self.values)?;
                check_length("the shares of classes", classes.shares.len(), expected)
            }
            _ => Ok(()),
        }
    }

    fn check_controls(&self, controls: &PlayerControls) -> Result<(), PageError> {
        let steps = controls.player.of(&self.players)?.steps;
        let found = controls.steps.len();
        if found > steps {
            return Err(PageError::Length { what: "the list of texts of steps", found, expected: steps });
        }
        Ok(())
    }

    fn check_place(&self, place: PlaceId) -> Result<(), PageError> {
        let places = &place.scene.of(&self.scenes)?.places;
        if place.place < places.len() {
            return Ok(());
        }
        Err(PageError::Unknown { what: "place", index: place.place, count: places.len() })
    }

    /// The page as an HTML file.
    pub fn html(&self) -> String {
        document::file(&self.title, &self.summary, &self.data())
    }

    fn data(&self) -> Value {
        let placements: Vec<Placement> = (0..self.spaces.len()).map(|i| self.placement(SpaceId(i))).collect();
        let space = |(space, placement): (&Space, &Placement)| {
            let up = match space {
                Space::Spatial(axis) => Some(axis.name()),
                Space::Plane => None,
            };
            json!({ "up": up, "origin": placement.origin, "scale": placement.scale })
        };
        let (shared, still) = rayon::join(
            || {
                let each = (0..self.meshes.len()).into_par_iter();
                each.map(|i| self.shared(i, &placements)).collect::<Vec<Option<SharedCorners>>>()
            },
            || self.still.as_ref().and_then(encode::png),
        );
        let of = |mesh: MeshId| match self.meshes[mesh.0].geometry {
            Geometry::Moved { of, .. } => shared[of.0].as_ref(),
            _ => shared[mesh.0].as_ref(),
        };
        let meshes = || {
            let each = self.meshes.par_iter().enumerate();
            each.map(|(i, mesh)| mesh.data(placements[mesh.space.0], of(MeshId(i)))).collect::<Vec<_>>()
        };
        let values = || self.values.par_iter().map(|values| values.data(of(values.mesh))).collect::<Vec<_>>();
        let (meshes, values) = rayon::join(meshes, values);
        let bounds = |(mesh, bounds): &(MeshId, Vec<Bounds>)| json!({ "mesh": mesh, "data": doubles(bounds.as_flattened().iter().copied()) });
        let scale = |(i, scale): (usize, &RangedScale)| scale.data(self.largest(ScaleId(i)));
        let all: Vec<SceneId> = (0..self.scenes.len()).map(SceneId).collect();
        let default =
            [Arrangement { key: "all".into(), text: "All".into(), hint: String::new(), scenes: all }];
        let arrangements = if self.arrangements.is_empty() && !self.scenes.is_empty() {
            default.as_slice()
        } else {
            &self.arrangements
        };
        json!({
            "title": self.title, "subtitle": self.subtitle, "banner": self.banner, "picture": self.picture,
            "command": self.command, "version": self.version,
            "still": still,
            "spaces": self.spaces.iter().zip(&placements).map(space).collect::<Vec<_>>(),
            "meshes": meshes,
            "values": values,
            "bounds": self.bounds.iter().map(bounds).collect::<Vec<_>>(),
            "scales": self.scales.iter().enumerate().map(scale).collect::<Vec<_>>(),
            "players": self.players,
            "toggles": self.toggles.iter().map(|(text, on)| json!({ "text": text, "on": on })).collect::<Vec<_>>(),
            "scenes": self.scenes.iter().map(|s| s.data(placements[s.space.0])).collect::<Vec<_>>(),
            "arrangements": arrangements, "below": self.below, "opening": self.opening,
            "cards": self.cards,
        })
    }

    /// The placement of everything in a space.
    fn placement(&self, space: SpaceId) -> Placement {
        let meshes = self.meshes.iter().filter(|mesh| mesh.space == space).flat_map(PlacedMesh::points);
        let scenes = self.scenes.iter().filter(|scene| scene.space == space);
        let shapes = scenes.flat_map(|scene| &scene.layers).flat_map(|layer| &layer.frames);
        Placement::around(meshes.chain(shapes.flat_map(Shape::points)))
    }

    /// The shared vertices of a mesh, if it has vertices of its own.
    fn shared(&self, index: usize, placements: &[Placement]) -> Option<SharedCorners> {
        let mesh = &self.meshes[index];
        let Geometry::Triangles(triangles) = &mesh.geometry else { return None };
        let of = |values: &&PlacedValues| values.mesh == MeshId(index);
        let is_moved =
            |other: &PlacedMesh| matches!(other.geometry, Geometry::Moved { of, .. } if of == MeshId(index));
        let apart = self.meshes.iter().any(is_moved)
            || self.values.iter().filter(of).any(PlacedValues::is_on_vertices);
        let at_corners: Vec<_> =
            self.values.iter().filter(of).filter(|v| v.is_on_corners()).map(|v| &v.values).collect();
        Some(SharedCorners::new(triangles, placements[mesh.space.0], apart, &at_corners))
    }

    /// The greatest absolute value on a scale; 1 if all values are zero.
    fn largest(&self, scale: ScaleId) -> f64 {
        let on_meshes =
            self.values.iter().filter(|values| values.scale == scale).map(|values| values.values.largest());
        let shapes = self.scenes.iter().flat_map(|scene| &scene.layers).flat_map(|layer| &layer.frames);
        let at_points = shapes.filter(|shape| shape.scale() == Some(scale)).map(Shape::largest);
        let largest = on_meshes.chain(at_points).fold(0.0, |a, b| if b > a { b } else { a });
        if largest > 0.0 { largest } else { 1.0 }
    }
}
