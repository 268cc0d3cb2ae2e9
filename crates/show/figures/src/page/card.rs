//! Cards: the text, numbers, charts and tables beside the view.

use super::error::{check_bounds, check_finite, check_increasing, check_length};
use super::{BoundsId, Chart, PageError, PlaceId, PlayerControls, ScaleId, SceneId, Table, Text, ValuesId};
use serde::Serialize;

/// Blocks under a heading.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Card {
    /// The heading.
    pub title: String,
    /// The scene to which the card belongs; it is shown only while that scene is selected. `None`: always.
    pub scene: Option<SceneId>,
    /// The blocks from top to bottom.
    pub blocks: Vec<Block>,
}

impl Card {
    /// A card that is always shown.
    pub fn new(title: impl Into<String>, blocks: Vec<Block>) -> Self {
        Self { title: title.into(), scene: None, blocks }
    }

    /// Shows the card only while this scene is selected.
    #[must_use]
    pub fn with_scene(mut self, scene: SceneId) -> Self {
        self.scene = Some(scene);
        self
    }
}

/// A part of a card.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", content = "of", rename_all = "camelCase")]
pub enum Block {
    /// A paragraph.
    Text(Text),
    /// A less prominent paragraph.
    Note(Text),
    /// The most important number.
    Headline(Statistic),
    /// Named numbers, one per line.
    Statistics(Vec<Statistic>),
    /// Names with their meanings: files, options.
    Facts(Vec<Fact>),
    /// How the page was made: the command, the origin of the view, the version of the program.
    Run,
    /// Buttons in a row.
    Buttons(Vec<Button>),
    /// A slider for a threshold, with the share of the area beyond it.
    Threshold(Threshold),
    /// The controls of a player.
    Player(PlayerControls),
    /// A list of places with values.
    Places(PlaceList),
    /// A chart.
    Chart(Chart),
    /// A table.
    Table(Table),
    /// Shares of the area in the classes of a scale.
    Classes(Classes),
}

/// A named number.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Statistic {
    /// Identifier for scripts and tests; may be empty.
    pub key: String,
    /// The label.
    pub name: String,
    /// The number or its enclosure.
    pub value: Amount,
    /// Its unit.
    pub unit: String,
    /// A remark in smaller type.
    pub note: Text,
}

/// A number or its enclosure.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Amount {
    /// A number with this many significant digits.
    Number {
        /// The number.
        number: f64,
        /// Digits, from 1 to 17.
        digits: u8,
    },
    /// An interval that contains the number, ends included.
    Enclosure {
        /// The ends.
        ends: [f64; 2],
    },
}

impl Default for Amount {
    fn default() -> Self {
        Self::Number { number: 0.0, digits: 1 }
    }
}

/// A name with its meaning.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Fact {
    /// The name.
    pub name: String,
    /// The meaning.
    pub value: Text,
    /// A remark in smaller type.
    pub note: Text,
}

impl Fact {
    /// A fact without a note.
    pub fn new(name: impl Into<String>, value: impl Into<Text>) -> Self {
        Self { name: name.into(), value: value.into(), note: Text::default() }
    }
}

/// A button.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "kind", content = "text", rename_all = "camelCase")]
pub enum Button {
    /// Moves the camera to see the first pair of points of the selected scene from the side.
    LookAtPair(String),
    /// Moves the camera to show everything.
    ShowAll(String),
}

/// What lies beyond a threshold: a slider, the remaining share of the area and number of faces, and surfaces coloured by it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Threshold {
    /// The scale that has the threshold.
    pub scale: ScaleId,
    /// The upper end of the slider.
    pub end: f64,
    /// The object whose area and faces are counted.
    pub of: String,
    /// The comparative for values beyond the threshold: "farther", "greater".
    pub beyond: String,
    /// Increasing thresholds, and enclosures of the share of the area beyond each, which never increases.
    pub share: Option<(Vec<f64>, Vec<[f64; 2]>)>,
    /// Enclosures of the largest value of each face.
    pub bounds: Option<BoundsId>,
}

/// Shares of the area in the classes between the [bands](super::ValueScale::bands) of a scale. If the user moves the class
/// boundaries, shares are recomputed from the displayed values and marked as estimates.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Classes {
    /// Identifier for scripts and tests; may be empty.
    pub key: String,
    /// A description for screen readers.
    pub caption: String,
    /// The scale that has the classes.
    pub scale: ScaleId,
    /// The values whose shares are shown.
    pub values: ValuesId,
    /// Labels of the lowest and the highest class: "too low", "too high".
    pub outer: [String; 2],
    /// For each class, from the lowest, an enclosure of its share of the area.
    pub shares: Vec<[f64; 2]>,
}

/// A list of places of a scene, with values.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PlaceList {
    /// Identifier for scripts and tests; may be empty.
    pub key: String,
    /// The scale that colours the values.
    pub scale: Option<ScaleId>,
    /// The places.
    pub items: Vec<PlaceItem>,
    /// The text for an empty list.
    pub none: String,
}

/// A place in a list.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlaceItem {
    /// The place.
    pub place: PlaceId,
    /// The enclosure of the value there.
    pub ends: [f64; 2],
    /// A remark in smaller type.
    pub note: Text,
}

impl Statistic {
    fn check(&self) -> Result<(), PageError> {
        match &self.value {
            Amount::Number { number, .. } => check_finite("a statistic", [number])?,
            Amount::Enclosure { ends } => check_bounds("a statistic", [ends])?,
        }
        check_finite("a statistic", self.note.numbers())
    }
}

impl Block {
    /// The checks that need no other part of the page.
    pub(super) fn check(&self) -> Result<(), PageError> {
        match self {
            Self::Text(text) | Self::Note(text) => check_finite("a paragraph", text.numbers()),
            Self::Headline(statistic) => statistic.check(),
            Self::Statistics(all) => all.iter().try_for_each(Statistic::check),
            Self::Facts(facts) => facts
                .iter()
                .try_for_each(|fact| check_finite("a fact", fact.value.numbers().chain(fact.note.numbers()))),
            Self::Run | Self::Buttons(_) => Ok(()),
            Self::Threshold(Threshold { end, share, .. }) => {
                check_finite("the end of the threshold", [end])?;
                let Some((at, shares)) = share else { return Ok(()) };
                check_increasing("the places of the share beyond a threshold", at)?;
                check_length("the share beyond a threshold", shares.len(), at.len())?;
                check_bounds("the share beyond a threshold", shares)
            }
            Self::Player(controls) => {
                let numbers = controls.steps.iter().chain([&controls.off]).flat_map(Text::numbers);
                check_finite("the text of a step", numbers)
            }
            Self::Places(list) => list.items.iter().try_for_each(|item| {
                check_bounds("the value of a place", [&item.ends])?;
                check_finite("the note of a place", item.note.numbers())
            }),
            Self::Chart(chart) => chart.check(),
            Self::Table(table) => table.check(),
            Self::Classes(classes) => check_bounds("the shares of classes", &classes.shares),
        }
    }
}
