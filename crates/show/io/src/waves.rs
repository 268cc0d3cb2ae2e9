//! Parsing pieces in parallel and consuming them in order.

use rayon::prelude::*;

/// Pieces in progress per thread: enough to balance the load, few enough for the buffers to stay in the cache.
const PIECES_PER_THREAD: usize = 4;

/// Calls `parse` on every piece, in parallel, each with a buffer, and `take` on every filled buffer, in the order of the pieces.
/// Stops at the first error in that order.
///
/// `parse` receives buffers as `take` left them. While one wave of pieces is taken, the next one is parsed, so there are only as
/// many buffers as two waves need. The result does not depend on the number of threads.
pub(crate) fn in_order<P: Sync, B: Default + Send, E: Send>(
    pieces: &[P],
    parse: impl Fn(&P, &mut B) -> Result<(), E> + Sync,
    mut take: impl FnMut(&P, &mut B) -> Result<(), E> + Send,
) -> Result<(), E> {
    let width = PIECES_PER_THREAD * rayon::current_num_threads();
    let mut filled: Vec<(B, Result<(), E>)> = Vec::new();
    let mut next: Vec<(B, Result<(), E>)> = Vec::new();
    let mut waves = pieces.chunks(width);
    let mut taken: &[P] = &[];
    loop {
        let wave = waves.next().unwrap_or_default();
        if next.len() < wave.len() {
            next.resize_with(wave.len(), || (B::default(), Ok(())));
        }
        let (done, ()) = rayon::join(
            || {
                for (piece, (buffer, outcome)) in taken.iter().zip(&mut filled) {
                    std::mem::replace(outcome, Ok(()))?;
                    take(piece, buffer)?;
                }
                Ok(())
            },
            || {
                next.par_iter_mut()
                    .zip(wave)
                    .with_max_len(1)
                    .for_each(|((buffer, outcome), piece)| *outcome = parse(piece, buffer));
            },
        );
        done?;
        if wave.is_empty() {
            return Ok(());
        }
        taken = wave;
        std::mem::swap(&mut filled, &mut next);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_the_order_and_stops_at_the_first_error() {
        let pieces: Vec<u32> = (0..1000).collect();
        for failing in [0, 7, 500, 999, 1000] {
            let mut seen = Vec::new();
            let outcome = in_order(
                &pieces,
                |&piece, buffer: &mut Vec<u32>| {
                    buffer.push(piece);
                    if piece >= failing { Err(piece) } else { Ok(()) }
                },
                |_, buffer| {
                    seen.append(buffer);
                    Ok(())
                },
            );
            assert_eq!(outcome, if failing < 1000 { Err(failing) } else { Ok(()) });
            assert_eq!(seen, (0..failing).collect::<Vec<_>>());
        }
    }
}
