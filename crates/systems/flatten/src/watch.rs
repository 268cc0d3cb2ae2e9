//! Progress, cancellation and time of a computation.

use pompeiu_core::run::{Control, Instant, Limits, Progress, ProgressObserver, StopReason};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Time that is kept for what follows the maps (packing, checks and the report), for each face, and the greatest share of the limit for it.
const KEPT_PER_FACE: Duration = Duration::from_micros(2);
const KEPT_AT_MOST: u32 = 4;

/// Progress of a computation over several components, or of a part of it that may take a share of its time.
#[derive(Clone)]
pub(crate) struct Watch<'w> {
    control: &'w Control,
    observer: Option<Arc<Mutex<&'w dyn ProgressObserver>>>,
    components: usize,
    done: Arc<AtomicUsize>,
    deadline: Option<Instant>,
    /// Whether the end of the time of a part ends that part only.
    is_part: bool,
    /// Whether a part was ended by its time.
    was_cut_short: Arc<AtomicBool>,
}

impl<'w> Watch<'w> {
    pub(crate) fn new(
        control: &'w Control,
        observer: Option<&'w dyn ProgressObserver>,
        components: usize,
    ) -> Self {
        Self {
            control,
            observer: observer.map(|observer| Arc::new(Mutex::new(observer))),
            components,
            done: Arc::default(),
            deadline: None,
            is_part: false,
            was_cut_short: Arc::default(),
        }
    }

    /// The same with the time limit, counted from a moment, less what the rest of the computation takes for so many faces.
    pub(crate) fn within(self, limits: &Limits, began: Instant, faces: usize) -> Self {
        let for_maps = |time: Duration| {
            let kept = KEPT_PER_FACE.saturating_mul(u32::try_from(faces).unwrap_or(u32::MAX));
            time.saturating_sub(kept.min(time / KEPT_AT_MOST))
        };
        let deadline = limits.time.and_then(|time| began.checked_add(for_maps(time)));
        Self { deadline, ..self }
    }

    /// For a part of the computation that may take this share of the time that is left.
    pub(crate) fn for_share(&self, share: f64) -> Self {
        let now = Instant::now();
        let deadline = self.deadline.map(|deadline| {
            now.checked_add(deadline.saturating_duration_since(now).mul_f64(share)).unwrap_or(deadline)
        });
        Self { deadline, is_part: true, ..self.clone() }
    }

    /// Counts a component that is done.
    pub(crate) fn finish_one(&self) {
        self.done.fetch_add(1, Ordering::Relaxed);
    }

    /// Reports progress, and returns whether to stop.
    pub(crate) fn is_stopped(&self) -> bool {
        if let Some(observer) = &self.observer {
            let share = self.done.load(Ordering::Relaxed) as f64 / self.components as f64;
            let progress = Progress { doing: "flattening", share: (self.components > 1).then_some(share) };
            let observer = observer.lock().unwrap_or_else(PoisonError::into_inner);
            if observer.progress(&progress).is_break() {
                self.control.stop(StopReason::Cancelled);
            }
        }
        self.control.is_stopped() || self.is_over_after(Duration::ZERO)
    }

    /// Whether so much more work would take longer than there is time.
    pub(crate) fn is_over_after(&self, work: Duration) -> bool {
        let is_over = self
            .deadline
            .is_some_and(|deadline| Instant::now().checked_add(work).is_none_or(|then| then >= deadline));
        if is_over {
            self.was_cut_short.store(true, Ordering::Relaxed);
            if !self.is_part {
                self.control.stop(StopReason::Time);
            }
        }
        is_over
    }

    /// Whether a part of the computation was ended by its time.
    pub(crate) fn was_cut_short(&self) -> bool {
        self.was_cut_short.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOUR: Duration = Duration::from_hours(1);

    fn within(time: Duration, began: Instant, faces: usize) -> (Control, Limits, Instant, usize) {
        let limits = Limits { time: Some(time), ..Limits::default() };
        (Control::start(&limits), limits, began, faces)
    }

    #[test]
    fn the_end_of_a_part_does_not_end_the_whole() {
        let (control, limits, began, faces) = within(HOUR, Instant::now(), 0);
        let whole = Watch::new(&control, None, 1).within(&limits, began, faces);
        assert!(!whole.for_share(0.5).is_stopped() && !whole.was_cut_short());
        assert!(whole.for_share(0.5).for_share(0.0).is_stopped() && whole.was_cut_short());
        assert!(!whole.is_stopped() && control.reason().is_none());
        // Work that would take longer than is left is not begun.
        assert!(whole.for_share(0.5).is_over_after(HOUR / 2) && !whole.is_over_after(HOUR / 2));
        assert!(whole.is_over_after(HOUR) && control.reason() == Some(StopReason::Time));
    }

    #[test]
    fn time_is_kept_for_what_follows_the_maps() {
        // A million faces take two seconds, and a quarter of the limit at most.
        let until = |seconds: u64, faces: usize| {
            let (control, limits, began, faces) =
                within(HOUR + Duration::from_secs(seconds), Instant::now(), faces);
            let watch = Watch::new(&control, None, 1).within(&limits, began, faces);
            watch.is_over_after(HOUR)
        };
        assert!(until(1, 1_000_000) && !until(60, 1_000_000) && until(1200 - 1, usize::MAX));
        assert!(!until(1200 + 60, usize::MAX));
    }

    #[test]
    fn without_a_limit_no_part_ends() {
        let control = Control::default();
        let watch = Watch::new(&control, None, 1).within(&Limits::default(), Instant::now(), 7);
        assert!(!watch.for_share(0.0).is_over_after(HOUR) && !watch.is_stopped());
    }
}
