//! Ids by which parts of a page refer to each other.

use super::PageError;
use serde::Serialize;

macro_rules! ids {
    ($($(#[$doc:meta])* $name:ident, $what:literal;)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
        #[serde(transparent)]
        pub struct $name(pub(super) usize);

        impl $name {
            /// The part, if the page has it.
            pub(super) fn of<T>(self, parts: &[T]) -> Result<&T, PageError> {
                parts.get(self.0).ok_or(PageError::Unknown { what: $what, index: self.0, count: parts.len() })
            }
        }
    )*};
}

ids! {
    /// A [`Space`](super::Space) of a page.
    SpaceId, "space";
    /// A mesh of a page.
    MeshId, "mesh";
    /// Values on a mesh.
    ValuesId, "array of values";
    /// Enclosures, one for each face of a mesh.
    BoundsId, "array of enclosures";
    /// A [`ValueScale`](super::ValueScale) of a page.
    ScaleId, "scale";
    /// A [`Player`](super::Player) of a page.
    PlayerId, "player";
    /// A toggle for layers.
    ToggleId, "toggle";
    /// A [`Scene`](super::Scene) of a page.
    SceneId, "scene";
}

/// A [`Place`](super::Place) of a scene, by its index there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct PlaceId {
    /// The scene.
    pub scene: SceneId,
    /// Which of its places.
    pub place: usize,
}
