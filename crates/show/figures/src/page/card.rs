//! Cards: what stands beside the view, block by block.

use super::error::{check_bounds, check_finite, check_increasing, check_length};
use super::{BoundsId, Chart, PageError, PlaceId, PlayerControls, ScaleId, SceneId, Table, Text, ValuesId};
use serde::Serialize;

/// Blocks under a heading.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Card {
    /// The heading.
    pub title: String,
    /// The scene whose numbers these are; the card is there only while that scene is the chosen one.
    pub scene: Option<SceneId>,
    /// From top to bottom.
    pub blocks: Vec<Block>,
}

impl Card {
    /// A card that is always there.
    pub fn new(title: impl Into<String>, blocks: Vec<Block>) -> Self {
        Self { title: title.into(), scene: None, blocks }
    }

    /// Only while this scene is chosen.
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
    /// A paragraph of less weight.
    Note(Text),
    /// The number that matters most.
    Headline(Statistic),
    /// Numbers with names, one below the other.
    Statistics(Vec<Statistic>),
    /// Names and what they stand for: files, options.
    Facts(Vec<Fact>),
    /// How the page came to be: the command, the origin of the view, the version of the program.
    Run,
    /// Buttons beside each other.
    Buttons(Vec<Button>),
    /// What is beyond a threshold.
    Threshold(Threshold),
    /// Steps over time.
    Player(PlayerControls),
    /// Places in order, with a value each.
    Places(PlaceList),
    /// A chart.
    Chart(Chart),
    /// A table.
    Table(Table),
    /// Shares of the area in the classes of a scale.
    Classes(Classes),
}

/// A number with a name.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Statistic {
    /// A name that scripts and tests find it by; may be empty.
    pub key: String,
    /// What it is.
    pub name: String,
    /// The number, or what encloses it.
    pub value: Amount,
    /// Its unit.
    pub unit: String,
    /// Smaller, below it.
    pub note: Text,
}

/// A number, or what encloses one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Amount {
    /// The number, in so many significant digits.
    Number {
        /// The number.
        number: f64,
        /// Digits, from 1 to 17.
        digits: u8,
    },
    /// It lies between these, ends included.
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

/// A name and what it stands for.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Fact {
    /// The name.
    pub name: String,
    /// What it stands for.
    pub value: Text,
    /// Smaller, below it.
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
    /// Looks at the first pair of points of the chosen scene, from the side.
    LookAtPair(String),
    /// Shows all there is.
    ShowAll(String),
}

/// What is beyond a threshold: a slider, what it leaves of the area and of the faces, and the surfaces painted by it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Threshold {
    /// The scale that has the threshold.
    pub scale: ScaleId,
    /// The end of the slider.
    pub end: f64,
    /// What the area and the faces are of.
    pub of: String,
    /// What values beyond the threshold are, compared with it: "farther", "greater".
    pub beyond: String,
    /// Places, increasing, and enclosures of the share of the area beyond them, which never rises.
    pub share: Option<(Vec<f64>, Vec<[f64; 2]>)>,
    /// What encloses the largest value of each face.
    pub bounds: Option<BoundsId>,
}

/// Shares of the area in the classes between the [bands](super::ValueScale::bands) of a scale. Once their ends are moved in the legend,
/// shares are computed from what is drawn, and marked as estimates.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Classes {
    /// A name that scripts and tests find it by; may be empty.
    pub key: String,
    /// What it is about, for those who do not see it.
    pub caption: String,
    /// The scale that has the classes.
    pub scale: ScaleId,
    /// The values whose shares these are.
    pub values: ValuesId,
    /// What is said of the lowest class, and of the highest: "too low", "too high".
    pub outer: [String; 2],
    /// For each class, from the lowest, an enclosure of its share of the area.
    pub shares: Vec<[f64; 2]>,
}

/// Places of a scene, with values.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct PlaceList {
    /// A name that scripts and tests find it by; may be empty.
    pub key: String,
    /// The scale that colours the values.
    pub scale: Option<ScaleId>,
    /// The places.
    pub items: Vec<PlaceItem>,
    /// What stands there where there are none.
    pub none: String,
}

/// A place in a list.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlaceItem {
    /// The place.
    pub place: PlaceId,
    /// What encloses the value there.
    pub ends: [f64; 2],
    /// Smaller, below it.
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
    /// Checks what needs no other part of the page.
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
                check_finite("what is told of a step", numbers)
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
