//! Why a computation ended.

/// The reason for which a computation ended. The result is valid in every case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
#[repr(u8)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum StopReason {
    /// The result is as accurate as asked.
    Tolerance = 1,
    /// The comparison with a threshold was decided.
    Threshold = 2,
    /// The time limit was reached.
    Time = 3,
    /// The memory limit would have been exceeded.
    Memory = 4,
    /// The limit on the number of pieces was reached.
    Pieces = 5,
    /// The limit on the number of steps of an iteration was reached.
    Steps = 6,
    /// An observer asked to stop.
    Cancelled = 7,
    /// The tolerance lies below what double precision can resolve for this input.
    Rounding = 8,
    /// More work would not narrow the result: a percentile where the distribution has a gap, for instance.
    Stalled = 9,
}

impl StopReason {
    /// All reasons.
    pub const ALL: [Self; 9] = [
        Self::Tolerance,
        Self::Threshold,
        Self::Time,
        Self::Memory,
        Self::Pieces,
        Self::Steps,
        Self::Cancelled,
        Self::Rounding,
        Self::Stalled,
    ];

    /// The reason in one word, as it appears in JSON.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Tolerance => "tolerance",
            Self::Threshold => "threshold",
            Self::Time => "time",
            Self::Memory => "memory",
            Self::Pieces => "pieces",
            Self::Steps => "steps",
            Self::Cancelled => "cancelled",
            Self::Rounding => "rounding",
            Self::Stalled => "stalled",
        }
    }

    /// Whether the computation ended before it reached what was asked, though double precision would have allowed more.
    pub const fn is_early(self) -> bool {
        matches!(
            self,
            Self::Time | Self::Memory | Self::Pieces | Self::Steps | Self::Cancelled | Self::Stalled
        )
    }
}

#[cfg(test)]
mod tests {
    use super::StopReason;
    use std::collections::HashSet;

    #[test]
    fn every_reason_has_its_own_name() {
        let names: HashSet<_> = StopReason::ALL.iter().map(|reason| reason.name()).collect();
        assert_eq!(names.len(), StopReason::ALL.len());
    }

    #[test]
    fn limits_cancelling_and_stalling_are_early() {
        let early: Vec<_> =
            StopReason::ALL.into_iter().filter(|r| r.is_early()).map(StopReason::name).collect();
        assert_eq!(early, ["time", "memory", "pieces", "steps", "cancelled", "stalled"]);
    }
}
