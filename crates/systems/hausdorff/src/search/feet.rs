//! Faces of B prepared for feet.

use pompeiu_core::geom::Foot;
use pompeiu_core::spatial::{Bvh, Slot};

const FEET: usize = 32;

/// Faces of B prepared for feet, each kept until another one takes its place.
pub(super) struct Feet([Option<(Slot, Foot)>; FEET]);

impl Default for Feet {
    fn default() -> Self {
        Self([None; FEET])
    }
}

impl Feet {
    #[inline]
    pub(super) fn of(&mut self, bvh: &Bvh, slot: Slot) -> &Foot {
        let place = &mut self.0[slot.index() % FEET];
        if place.as_ref().is_none_or(|(known, _)| *known != slot) {
            *place = None;
        }
        &place.get_or_insert_with(|| (slot, Foot::new(bvh.corners(slot)))).1
    }
}
