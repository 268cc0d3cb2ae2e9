//! Steps over time.

/// Steps that layers, charts and controls share: frames of a flow, stages of a search.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Player {
    /// What it steps through, such as "Stage of the search".
    pub label: String,
    /// How many steps there are, at least one.
    pub steps: usize,
    /// Whether it can be off, which it is at first: then its layers are not drawn.
    pub optional: bool,
    /// Milliseconds from one step to the next while it plays; 0 stands for 100.
    pub interval: u32,
    /// Whether it starts again after the last step.
    pub repeats: bool,
}

/// The controls of a player.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PlayerControls {
    /// The player.
    pub player: super::PlayerId,
    /// What is told of each step; the slider has as many.
    pub steps: Vec<super::Text>,
    /// What is told while it is off.
    pub off: super::Text,
}
