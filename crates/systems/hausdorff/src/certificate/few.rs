//! Blocks without a tree over B, where there is no memory for one: whole faces, each near one of a few faces of B.
//!
//! This certifies what the coarse method finds from the same few faces ([`crate::coarse`]).

use super::encode::Block;
use super::face::Unfinished;
use pompeiu_verify::Pair;
use pompeiu_verify::kernel::{Facet, whole};
use std::ops::Range;

/// The bytes of the block of these faces, and its cells.
pub(super) fn block(
    pair: &Pair<'_>,
    few: &[u32],
    upper: f64,
    faces: Range<usize>,
) -> Result<(Vec<u8>, u64), Unfinished> {
    let (mut block, mut last) = (Block::default(), 0);
    for face in faces {
        let triangle = pair.a.triangle(face);
        let corners = whole(triangle);
        let covers = |place: &usize| {
            let facet = Facet::new(pair.b.triangle(few[*place] as usize), triangle[0]);
            corners.iter().all(|corner| facet.at_most(corner) <= upper)
        };
        last = std::iter::once(last).chain(0..few.len()).find(covers).ok_or(Unfinished::Far(face))?;
        block.whole(few[last]);
    }
    Ok(block.finish())
}
