//! Steps over time.

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
