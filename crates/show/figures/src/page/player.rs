//! Steps over time.

use super::{Layer, Mesh, Page, PageError, Paint, Scene, Shape, SpaceId, Text};
use pompeiu_core::TriMesh;

/// Steps that layers, charts and controls share: frames of a flow, stages of a search.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Player {
    /// The label, such as "Stage of the search".
    pub label: String,
    /// The number of steps, at least one.
    pub steps: usize,
    /// Whether it can be switched off, as it is at first. Its layers are then not drawn.
    pub optional: bool,
    /// Milliseconds per step during playback; 0 stands for 100.
    pub interval: u32,
    /// Whether playback repeats.
    pub repeats: bool,
}

/// The controls of a player.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PlayerControls {
    /// The player.
    pub player: super::PlayerId,
    /// The text of each step, one per position of the slider.
    pub steps: Vec<super::Text>,
    /// The text while the player is off.
    pub off: super::Text,
}

/// Milliseconds from a surface before to the one after.
const BEFORE_AND_AFTER: u32 = 1500;

impl Page {
    /// Shows a surface before and after it was changed, in turn, and counts the faces of both in the subtitle.
    ///
    /// # Errors
    /// [`PageError`] where a mesh has no faces, or the space does not exist.
    pub fn add_before_and_after(&mut self, space: SpaceId, both: [&TriMesh; 2]) -> Result<(), PageError> {
        let labels = ["before", "after"];
        self.subtitle = Text::default()
            .count(both[0].faces().len(), "face")
            .text(" before, ")
            .count(both[1].faces().len(), "face")
            .text(" after");
        let player = self.add_player(Player {
            label: "Before and after".into(),
            steps: both.len(),
            interval: BEFORE_AND_AFTER,
            repeats: true,
            ..Player::default()
        })?;
        let mut shapes = Vec::new();
        for (label, mesh) in labels.into_iter().zip(both) {
            let mesh = self.add_mesh(space, Mesh::of(label, mesh))?;
            shapes.push(Shape::Surface { mesh, paint: Paint::Plain, bounds: None });
        }
        let mut scene = Scene::new("surface", space);
        scene.layers = vec![Layer::over_time(player, shapes)];
        self.add_scene(scene)?;
        let steps = labels.map(Text::from).to_vec();
        self.set_player_below(PlayerControls { player, steps, off: Text::default() })
    }
}
