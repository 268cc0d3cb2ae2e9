//! Scenes: the layers drawn in one pane, and places in it.

use super::encode::{first_use_indices, integers, singles};
use super::error::{check_finite, check_length};
use super::space::Placement;
use super::{BoundsId, MeshId, PageError, PlayerId, ScaleId, SpaceId, ToggleId, ValuesId};
use serde_json::{Value, json};

/// A pane of the view: layers in one space.
#[derive(Clone, Debug, PartialEq)]
pub struct Scene {
    /// The title of the pane.
    pub label: String,
    /// A short name, for selecting whose numbers are shown.
    pub name: String,
    /// Scenes of one space share coordinates and a camera.
    pub space: SpaceId,
    /// The layers.
    pub layers: Vec<Layer>,
    /// Places that tables, lists and charts link to.
    pub places: Vec<Place>,
}

impl Scene {
    /// An empty scene.
    pub fn new(label: impl Into<String>, space: SpaceId) -> Self {
        let label = label.into();
        Self { name: label.clone(), label, space, layers: vec![], places: vec![] }
    }
}

/// A shape, drawn always or at some steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    pub(super) frames: Vec<Shape>,
    pub(super) player: Option<PlayerId>,
    pub(super) toggle: Option<ToggleId>,
    pub(super) plain_while: Option<PlayerId>,
}

impl Layer {
    /// The same shape at all times.
    pub fn new(shape: Shape) -> Self {
        Self { frames: vec![shape], player: None, toggle: None, plain_while: None }
    }

    /// One shape for each step of a player. If there are fewer shapes than steps, the last one stays. Nothing is drawn while the
    /// player is off.
    pub fn over_time(player: PlayerId, frames: Vec<Shape>) -> Self {
        Self { frames, player: Some(player), toggle: None, plain_while: None }
    }

    /// Adds a toggle to the layer.
    #[must_use]
    pub fn with_toggle(mut self, toggle: ToggleId) -> Self {
        self.toggle = Some(toggle);
        self
    }

    /// Draws the layer uncoloured while a player is on, so that the player's layers stand out.
    #[must_use]
    pub fn plain_while(mut self, player: PlayerId) -> Self {
        self.plain_while = Some(player);
        self
    }
}

/// The shape drawn by a layer.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A mesh.
    Surface {
        /// The mesh.
        mesh: MeshId,
        /// How it is coloured.
        paint: Paint,
        /// Enclosures of the largest value of each face, shown at the cursor.
        bounds: Option<BoundsId>,
    },
    /// Arrows for vectors on a mesh, as many as are legible. Their lengths are comparable across scenes.
    Arrows {
        /// The mesh to draw them on: that of the values, or a moved copy of it.
        mesh: MeshId,
        /// The vectors.
        vectors: ValuesId,
    },
    /// Triangles in the highlight colour; small ones have a ring around them.
    Pieces(Vec<[[f64; 3]; 3]>),
    /// Curves.
    Lines(Lines),
    /// Points.
    Points(Points),
    /// Pairs of points, joined, with a label each. They have a fixed size on the screen.
    Pairs(Vec<Pair>),
}

/// How a surface is coloured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// By values.
    Values(ValuesId),
    /// Not at all.
    Plain,
    /// Translucent, more so where the surface faces the viewer.
    Ghost,
}

/// A colour of the theme, which differs between light and dark, or a fixed colour.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Color {
    /// The colour of text.
    #[default]
    Ink,
    /// The colour of controls.
    Accent,
    /// The colour of thresholds.
    Limit,
    /// The colour of secondary items.
    Soft,
    /// A fixed colour.
    Fixed(crate::Rgb),
}

impl Color {
    fn data(self) -> Value {
        match self {
            Self::Ink => json!("--ink"),
            Self::Accent => json!("--accent"),
            Self::Limit => json!("--limit"),
            Self::Soft => json!("--soft"),
            Self::Fixed([r, g, b]) => json!(format!("rgb({r}, {g}, {b})")),
        }
    }
}

/// Curves: paths from point to point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lines {
    /// The points of each path.
    pub paths: Vec<Vec<[f64; 3]>>,
    /// Whether the last point of each path is joined to the first.
    pub closed: bool,
    /// A value at each point of each path, in order, and the scale that colours them.
    pub values: Option<(ScaleId, Vec<f64>)>,
    /// The colour where there are no values.
    pub color: Color,
    /// The width in pixels; 0 stands for 1.5.
    pub width: f64,
    /// Whether streaks move along the paths, from their first points to their last ones.
    pub moving: bool,
}

/// Points as discs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Points {
    /// Where they are.
    pub positions: Vec<[f64; 3]>,
    /// A value for each, and the scale that colours them.
    pub values: Option<(ScaleId, Vec<f64>)>,
    /// The colour where there are no values.
    pub color: Color,
    /// The diameter in pixels; 0 stands for 7.
    pub size: f64,
}

/// Two corresponding points.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct PointPair {
    /// One, drawn filled.
    pub from: [f64; 3],
    /// The other one, drawn hollow.
    pub to: [f64; 3],
}

/// A pair of points with a label.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pair {
    /// The points.
    pub points: PointPair,
    /// The label.
    pub label: super::Text,
}

/// A place of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Place {
    /// Its centre.
    pub center: [f64; 3],
    /// The radius of a ball around the centre that contains it.
    pub radius: f64,
    /// A pair of points to be seen from the side.
    pub pair: Option<PointPair>,
    /// Faces of a mesh to highlight; may be empty.
    pub faces: Vec<u32>,
    /// The mesh.
    pub mesh: Option<MeshId>,
    /// The label of its mark.
    pub label: String,
}

impl Lines {
    /// The edges between the given faces and all others: the outlines of regions, and the boundary of the mesh if all faces are
    /// given. Triangles are given by vertices; each edge is a path of its own.
    pub fn outline(positions: &[[f64; 3]], triangles: &[[u32; 3]], faces: &[u32]) -> Self {
        let mut edges: Vec<[u32; 2]> = faces
            .iter()
            .filter_map(|&face| triangles.get(face as usize))
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[a, b]| if a < b { [a, b] } else { [b, a] })
            .collect();
        edges.sort_unstable();
        let single = edges.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).map(|same| same[0]);
        let point = |v: u32| positions.get(v as usize).copied();
        let path = |[a, b]: [u32; 2]| Some(vec![point(a)?, point(b)?]);
        Self { paths: single.filter_map(path).collect(), ..Self::default() }
    }

    fn check(&self) -> Result<(), PageError> {
        let points = self.paths.iter().map(Vec::len).sum();
        for path in &self.paths {
            check_finite("a path", path.as_flattened())?;
        }
        check_finite("the width of lines", [&self.width])?;
        check_values(self.values.as_ref(), points)
    }

    fn points(&self) -> impl Iterator<Item = [f64; 3]> {
        self.paths.iter().flatten().copied()
    }

    fn data(&self, placement: Placement) -> Value {
        json!({
            "kind": "lines", "points": placed(placement, self.points()),
            "lengths": integers(self.paths.iter().map(|path| path.len() as u32)),
            "closed": self.closed, "scale": self.values.as_ref().map(|values| values.0),
            "values": self.values.as_ref().map(|(_, values)| super::encode::doubles(values.iter().copied())),
            "color": self.color.data(), "width": if self.width > 0.0 { self.width } else { 1.5 }, "moving": self.moving,
        })
    }
}

impl Points {
    fn check(&self) -> Result<(), PageError> {
        check_finite("the list of points", self.positions.as_flattened())?;
        check_finite("the size of points", [&self.size])?;
        check_values(self.values.as_ref(), self.positions.len())
    }

    fn data(&self, placement: Placement) -> Value {
        json!({
            "kind": "points", "points": placed(placement, self.positions.iter().copied()),
            "scale": self.values.as_ref().map(|values| values.0),
            "values": self.values.as_ref().map(|(_, values)| super::encode::doubles(values.iter().copied())),
            "color": self.color.data(), "size": if self.size > 0.0 { self.size } else { 7.0 },
        })
    }
}

fn check_values(values: Option<&(ScaleId, Vec<f64>)>, points: usize) -> Result<(), PageError> {
    let Some((_, values)) = values else { return Ok(()) };
    check_finite("the values at points", values)?;
    check_length("the list of values at points", values.len(), points)
}

fn placed(placement: Placement, points: impl Iterator<Item = [f64; 3]>) -> Value {
    let points: Vec<_> = points.map(|point| placement.place(point)).collect();
    singles(points.as_flattened().iter().copied())
}

impl Shape {
    /// The scale of values at points.
    pub(super) fn scale(&self) -> Option<ScaleId> {
        match self {
            Self::Lines(lines) => lines.values.as_ref().map(|values| values.0),
            Self::Points(points) => points.values.as_ref().map(|values| values.0),
            _ => None,
        }
    }

    /// The greatest absolute value at points.
    pub(super) fn largest(&self) -> f64 {
        let values = match self {
            Self::Lines(Lines { values: Some((_, values)), .. })
            | Self::Points(Points { values: Some((_, values)), .. }) => values.as_slice(),
            _ => &[],
        };
        values.iter().map(|x| x.abs()).fold(0.0, |a, b| if b > a { b } else { a })
    }

    /// The checks that need no other part of the page.
    pub(super) fn check(&self) -> Result<(), PageError> {
        match self {
            Self::Surface { .. } | Self::Arrows { .. } => Ok(()),
            Self::Pieces(pieces) => check_finite("a piece", pieces.as_flattened().as_flattened()),
            Self::Lines(lines) => lines.check(),
            Self::Points(points) => points.check(),
            Self::Pairs(pairs) => {
                pairs.iter().try_for_each(|Pair { points: PointPair { from, to }, label }| {
                    check_finite("a pair of points", from.iter().chain(to))?;
                    check_finite("the label of a pair", label.numbers())
                })
            }
        }
    }

    /// The points of the shape that belong to no mesh.
    pub(super) fn points(&self) -> Vec<[f64; 3]> {
        match self {
            Self::Lines(lines) => lines.points().collect(),
            Self::Points(points) => points.positions.clone(),
            _ => vec![],
        }
    }

    pub(super) fn data(&self, placement: Placement) -> Value {
        match self {
            Self::Surface { mesh, paint, bounds } => {
                let (paint, values) = match paint {
                    Paint::Values(values) => ("values", Some(values)),
                    Paint::Plain => ("plain", None),
                    Paint::Ghost => ("ghost", None),
                };
                json!({ "kind": "surface", "mesh": mesh, "paint": paint, "values": values, "bounds": bounds })
            }
            Self::Arrows { mesh, vectors } => json!({ "kind": "arrows", "mesh": mesh, "vectors": vectors }),
            Self::Pieces(pieces) => {
                let mesh = super::Mesh::from_corners("", pieces);
                let shared = super::mesh::SharedCorners::new(&mesh, placement, false, &[]);
                let corners = pieces.as_flattened();
                json!({
                    "kind": "pieces", "indices": first_use_indices(&shared.indices),
                    "points": placed(placement, shared.vertices.iter().map(|&v| corners[v as usize])),
                })
            }
            Self::Lines(lines) => lines.data(placement),
            Self::Points(points) => points.data(placement),
            Self::Pairs(pairs) => {
                let pair = |pair: &Pair| json!({ "from": pair.points.from, "to": pair.points.to, "label": pair.label });
                json!({ "kind": "pairs", "pairs": pairs.iter().map(pair).collect::<Vec<_>>() })
            }
        }
    }
}

impl Scene {
    pub(super) fn data(&self, placement: Placement) -> Value {
        let layer = |layer: &Layer| {
            json!({
                "frames": layer.frames.iter().map(|shape| shape.data(placement)).collect::<Vec<_>>(),
                "player": layer.player, "toggle": layer.toggle, "plainWhile": layer.plain_while,
            })
        };
        let place = |place: &Place| {
            json!({
                "center": place.center, "radius": place.radius, "pair": place.pair, "mesh": place.mesh,
                "faces": integers(place.faces.iter().copied()), "label": place.label,
            })
        };
        json!({
            "label": self.label, "name": self.name, "space": self.space,
            "layers": self.layers.iter().map(layer).collect::<Vec<_>>(),
            "places": self.places.iter().map(place).collect::<Vec<_>>(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outlines_are_edges_with_one_face() {
        let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let triangles = [[0, 1, 2], [0, 2, 3]];
        let square = Lines::outline(&positions, &triangles, &[0, 1]);
        assert_eq!(square.paths.len(), 4, "the diagonal is inside");
        assert!(!square.paths.contains(&vec![positions[0], positions[2]]));
        assert_eq!(Lines::outline(&positions, &triangles, &[1]).paths.len(), 3);
        assert!(Lines::outline(&positions, &triangles, &[9]).paths.is_empty());
    }
}
