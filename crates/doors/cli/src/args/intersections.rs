//! What is done about faces of a result that intersect.

use clap::{Args, ValueEnum};
use pompeiu::remesh;

#[derive(Args)]
pub(crate) struct Intersections {
    /// What is done about faces of the result that intersect
    #[arg(long, value_enum, default_value_t, value_name = "WHAT")]
    pub(crate) intersections: What,
}

#[derive(Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum What {
    /// They are not looked for
    Ignore,
    /// They are counted
    #[default]
    Report,
    /// Nothing is written if there are any
    Refuse,
}

impl From<What> for remesh::Intersections {
    fn from(what: What) -> Self {
        match what {
            What::Ignore => Self::Ignore,
            What::Report => Self::Report,
            What::Refuse => Self::Refuse,
        }
    }
}
