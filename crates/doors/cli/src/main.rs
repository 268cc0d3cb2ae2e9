//! The `pompeiu` command: two mesh files in, a certified distance out.

mod args;
mod called;
mod commands;
mod exit;
mod files;
mod json;
mod many;
mod numbers;
mod page;
mod pair;
mod printer;
mod threads;
mod wait;

use args::{Args, Command};
use clap::Parser;
use exit::Exit;
use printer::Printer;

fn main() -> std::process::ExitCode {
    let args = Args::parse();
    let printer = Printer::new(args.quiet);
    let done = match args.command {
        Command::Distance(args) => commands::distance::run(&args, &printer),
        Command::Deviation(args) => commands::deviation::run(&args, &printer),
        Command::Info(args) => commands::info::run(&args, &printer),
        Command::Rank(args) => commands::rank::run(&args, &printer),
        Command::Matrix(args) => commands::matrix::run(&args, &printer),
        Command::Decompose(args) => commands::decompose::run(&args, &printer),
        Command::Convert(args) => commands::convert::run(&args, &printer),
        Command::Generate(args) => commands::generate::run(args, &printer),
        Command::Completions(args) => commands::completions::run(&args),
        Command::Man(args) => commands::man::run(&args, &printer),
    };
    let exit = done.unwrap_or_else(|error| {
        Printer::error(&error);
        Exit::Unusable
    });
    exit.into()
}
