//! The way of a part of a face of A over B, from face to face, and when it is given up.
//!
//! # Source
//! That a way is circular is noticed as in `brent_improved_1980`.

use pompeiu_core::spatial::Slot;

/// Steps from face to face, after which a part is cut no more by the edges of faces.
const MOST_STEPS: u8 = 40;
/// Steps that a cut by a face which is not across an edge counts.
const STEPS_OF_BISECTOR: u8 = 10;
/// Halvings of a part.
const MOST_HALVINGS: u8 = 24;

/// How a part came to where it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Walk {
    steps: u8,
    halvings: u8,
    /// A face on the way: the one after so many steps as the greatest power of two that was reached.
    mark: Slot,
    is_circular: bool,
}

impl Walk {
    /// Begins over a face.
    pub(super) fn new(slot: Slot) -> Self {
        Self { steps: 0, halvings: 0, mark: slot, is_circular: false }
    }

    /// After a step to a face.
    ///
    /// Planes that bisect the angles at edges need not meet in a line over a vertex: what lies between them is led around it forever, and comes
    /// back to the mark.
    pub(super) fn to(self, slot: Slot) -> Self {
        let steps = self.steps.saturating_add(1);
        let is_circular = self.is_circular || slot == self.mark;
        let mark = if steps.is_power_of_two() { slot } else { self.mark };
        Self { steps, mark, is_circular, ..self }
    }

    /// After a cut that leads over no edge.
    pub(super) fn cut(self) -> Self {
        Self { steps: self.steps.saturating_add(1), ..self }
    }

    /// After a cut by the bisector of two faces.
    pub(super) fn aside(self) -> Self {
        Self { steps: self.steps.saturating_add(STEPS_OF_BISECTOR), ..self }
    }

    /// Of a half that is over this face.
    pub(super) fn half(self, slot: Slot) -> Self {
        Self { halvings: self.halvings + 1, ..Self::new(slot) }
    }

    /// Whether no more steps should be made.
    pub(super) fn is_over(self) -> bool {
        self.steps > MOST_STEPS
    }

    /// Whether there was only no end of the faces that the part is over.
    pub(super) fn is_too_long(self) -> bool {
        self.is_over() && !self.is_circular
    }

    /// Whether a part may be halved.
    pub(super) fn may_halve(self) -> bool {
        self.halvings < MOST_HALVINGS
    }
}
