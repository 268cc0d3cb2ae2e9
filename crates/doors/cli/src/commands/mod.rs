//! One file or folder for each command. Those marked as systems are a struct of files with [`System`](crate::door::System); their
//! options are the request of the system. The others have `args.rs` for their options, `run.rs` for what they do, `text.rs`, `json.rs`
//! and `csv.rs` for how they answer.

mod align;
mod app;
mod completions;
mod complexity;
mod contact;
mod convert;
mod couple;
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
mod verify;

use crate::exit::Exit;
use crate::printer::Printer;
use clap::Subcommand;

/// The commands in the order of the help. Each is a module with a struct of arguments and a function `run`.
macro_rules! commands {
    ($($module:ident::$Name:ident $(: $system:ident)?,)*) => {
        #[derive(Subcommand)]
        #[allow(clippy::large_enum_variant, reason = "there is one value in a run")]
        pub(crate) enum Command {
            $($Name($module::$Name),)*
        }

        impl Command {
            pub(crate) fn run(&self, printer: &Printer) -> anyhow::Result<Exit> {
                match self {
                    $(Self::$Name(args) => $module::run(args, printer),)*
                }
            }
        }

        /// Visits the commands that are systems.
        #[cfg(test)]
        pub(crate) fn visit_systems(visitor: &mut impl crate::generated::Visitor) {
            $($(visitor.$system::<$module::Files>();)?)*
        }
    };
}

commands! {
    distance::Distance: system,
    verify::Verify: system,
    deviation::Deviation: system,
    align::Align: system,
    rank::Rank: system,
    matrix::Matrix: system,
    info::Info: system,
    decompose::Decompose: system,
    remesh::Remesh: system,
    flow::Flow: system,
    fluid::Fluid: system,
    couple::Couple: system,
    contact::Contact: system,
    flatten::Flatten: system,
    cut::Cut: system,
    medial::Medial: system,
    neuron::Neuron: system,
    complexity::Complexity: system,
    puzzle::Puzzle: system,
    simplify::Simplify: system,
    repair::Repair: system,
    app::App,
    convert::Convert,
    generate::Generate,
    completions::Completions,
    man::Man,
}
