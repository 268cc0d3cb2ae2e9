//! The clock: that of the system, and on `wasm32-unknown-unknown`, which has none, one that the program sets.

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
pub use std::time::Instant;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
pub use unknown::{Instant, set_clock};

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
mod unknown {
    use std::ops::{Add, Sub};
    use std::sync::OnceLock;
    use std::time::Duration;

    static CLOCK: OnceLock<fn() -> Duration> = OnceLock::new();

    /// Sets what tells the time since any fixed moment, once for the program. Until then the clock stands still: no time limit ends
    /// anything.
    pub fn set_clock(clock: fn() -> Duration) {
        // The first one stays, so that time never goes back.
        let _ = CLOCK.set(clock);
    }

    /// A moment, as `std::time::Instant` is on other targets: there the one of the standard library panics.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
    pub struct Instant(Duration);

    impl Instant {
        /// This moment.
        pub fn now() -> Self {
            Self(CLOCK.get().map_or(Duration::ZERO, |clock| clock()))
        }

        /// The time since this moment.
        pub fn elapsed(&self) -> Duration {
            Self::now().saturating_duration_since(*self)
        }

        /// The time since an earlier moment; none if that is later.
        pub fn saturating_duration_since(&self, earlier: Self) -> Duration {
            self.0.saturating_sub(earlier.0)
        }

        /// The time since an earlier moment; none if that is later.
        pub fn duration_since(&self, earlier: Self) -> Duration {
            self.saturating_duration_since(earlier)
        }

        /// The moment so much later, if the clock can tell it.
        pub fn checked_add(&self, span: Duration) -> Option<Self> {
            self.0.checked_add(span).map(Self)
        }

        /// The moment so much earlier, if the clock had begun.
        pub fn checked_sub(&self, span: Duration) -> Option<Self> {
            self.0.checked_sub(span).map(Self)
        }
    }

    impl Add<Duration> for Instant {
        type Output = Self;

        fn add(self, span: Duration) -> Self {
            Self(self.0.saturating_add(span))
        }
    }

    impl Sub for Instant {
        type Output = Duration;

        fn sub(self, earlier: Self) -> Duration {
            self.saturating_duration_since(earlier)
        }
    }
}
