//! The answer above everything else on a page.

use serde::Serialize;

/// An answer that readers act on, above everything else. Its kind is told by a sign and by words, not by colour alone.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Banner {
    /// What kind of answer it is.
    pub kind: BannerKind,
    /// The answer in a few words.
    pub head: String,
    /// What it follows from.
    pub text: String,
}

/// The kind of an answer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum BannerKind {
    /// As it should be.
    Good,
    /// Not as it should be.
    Bad,
    /// Neither is known.
    #[default]
    Open,
}
