//! Runs the command.

use super::args::App;
use crate::exit::Exit;
use crate::printer::Printer;
use crate::{files, interrupt};

pub(crate) fn run(args: &App, printer: &Printer) -> anyhow::Result<Exit> {
    for file in &args.files {
        files::check_readable(file)?;
    }
    let app = pompeiu_web::App::bind(args.port, args.files.clone())?;
    interrupt::listen();
    let address = app.address();
    Printer::answer(&format!("{address}\n"))?;
    if !args.no_browser
        && let Err(error) = open::that_detached(&address)
    {
        printer.warning(format_args!("no browser could be opened ({error}); open the address above in one"));
    }
    printer.note("The program ends when the page is closed, or with Ctrl-C.");
    app.run(&interrupt::token());
    Ok(Exit::Done)
}
