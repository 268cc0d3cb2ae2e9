//! Colours of everything except values.

use crate::Rgb;

/// Light or dark background.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Theme {
    /// White, for paper.
    #[default]
    Light,
    /// Nearly black, for screens.
    Dark,
}

/// The colours of a theme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Colors {
    pub(crate) background: Rgb,
    pub(crate) text: Rgb,
    pub(crate) edge: Rgb,
    /// The colour of meshes without values.
    pub(crate) mesh: Rgb,
    pub(crate) mark: Rgb,
}

impl Theme {
    pub(crate) fn colors(self) -> Colors {
        match self {
            Self::Light => Colors {
                background: [255, 255, 255],
                text: [34, 34, 38],
                edge: [24, 24, 28],
                mesh: [196, 202, 212],
                mark: [16, 16, 18],
            },
            Self::Dark => Colors {
                background: [22, 23, 27],
                text: [226, 227, 231],
                edge: [12, 12, 14],
                mesh: [172, 178, 190],
                mark: [250, 250, 250],
            },
        }
    }
}
