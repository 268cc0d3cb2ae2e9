//! One folder for each command: `args.rs` for its options, `run.rs` for what it does, `text.rs`, `json.rs` and `csv.rs` for how it
//! answers.

mod align;
mod completions;
mod complexity;
mod convert;
mod cut;
mod decompose;
mod deviation;
mod distance;
mod flatten;
mod flow;
mod fluid;
mod generate;
mod info;
mod man;
mod matrix;
mod medial;
mod neuron;
mod puzzle;
mod rank;
mod remesh;
mod repair;
mod simplify;

use crate::exit::Exit;
use crate::printer::Printer;
use clap::Subcommand;

/// The commands in the order of the help; each is a folder with a struct of options and a function `run`.
macro_rules! commands {
    ($($folder:ident::$Name:ident,)*) => {
        #[derive(Subcommand)]
        pub(crate) enum Command {
            $($Name($folder::$Name),)*
        }

        impl Command {
            pub(crate) fn run(&self, printer: &Printer) -> anyhow::Result<Exit> {
                match self {
                    $(Self::$Name(args) => $folder::run(args, printer),)*
                }
            }
        }
    };
}

commands! {
    distance::Distance,
    deviation::Deviation,
    align::Align,
    rank::Rank,
    matrix::Matrix,
    info::Info,
    decompose::Decompose,
    remesh::Remesh,
    flow::Flow,
    fluid::Fluid,
    flatten::Flatten,
    cut::Cut,
    medial::Medial,
    neuron::Neuron,
    complexity::Complexity,
    puzzle::Puzzle,
    simplify::Simplify,
    repair::Repair,
    convert::Convert,
    generate::Generate,
    completions::Completions,
    man::Man,
}

/// The JSON answers, by their commands.
#[cfg(test)]
pub(crate) mod answers {
    pub(crate) use super::align::Json as Align;
    pub(crate) use super::complexity::Json as Complexity;
    pub(crate) use super::cut::Json as Cut;
    pub(crate) use super::decompose::Json as Decompose;
    pub(crate) use super::deviation::Json as Deviation;
    pub(crate) use super::distance::Json as Distance;
    pub(crate) use super::flatten::Json as Flatten;
    pub(crate) use super::flow::Json as Flow;
    pub(crate) use super::fluid::Json as Fluid;
    pub(crate) use super::info::Json as Info;
    pub(crate) use super::matrix::Json as Matrix;
    pub(crate) use super::medial::Json as Medial;
    pub(crate) use super::neuron::Json as Neuron;
    pub(crate) use super::puzzle::Json as Puzzle;
    pub(crate) use super::rank::Json as Rank;
    pub(crate) use super::remesh::Json as Remesh;
    pub(crate) use super::repair::Json as Repair;
    pub(crate) use super::simplify::Json as Simplify;
}
