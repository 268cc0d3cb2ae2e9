//! The `pompeiu` command: two mesh files in, a certified distance out.

mod aligned;
mod appearance;
mod args;
mod called;
mod certificate;
mod commands;
mod door;
mod exit;
mod field;
mod files;
mod film;
#[cfg(test)]
mod generated;
mod interrupt;
mod many;
mod meant;
mod numbers;
mod page;
mod pair;
mod printer;
mod series;
mod surface;
mod threads;
mod wait;

use exit::Exit;
use printer::Printer;

fn main() -> std::process::ExitCode {
    let args = args::parse().unwrap_or_else(|error| {
        let _ = error.print();
        if let Some(meant) = meant::meant(&error) {
            Printer::hint(&meant);
        }
        std::process::exit(error.exit_code())
    });
    let printer = Printer::new(args.quiet);
    let done = args.command.run(&printer);
    let exit = done.unwrap_or_else(|error| {
        Printer::error(&error);
        if error.is::<exit::OutOfTime>() { Exit::Undecided } else { Exit::Unusable }
    });
    exit.into()
}
