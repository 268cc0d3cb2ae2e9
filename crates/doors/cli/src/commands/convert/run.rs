//! Runs the command.

use super::args::Convert;
use crate::appearance;
use crate::exit::Exit;
use crate::files;
use crate::printer::Printer;
use anyhow::bail;

pub(crate) fn run(args: &Convert, printer: &Printer) -> anyhow::Result<Exit> {
    let output = args.output.path();
    files::check_writable(output)?;
    files::check_readable(&args.input)?;
    if files::are_same(&args.input, output) {
        bail!("{}: is both input and output; give the output another name", args.input.display());
    }
    let read = files::read(&args.input)?;
    files::warn_of_changes(&args.input, &read, printer);
    let found = appearance::read(&args.input, &read.mesh, output, printer)?;
    let attributes = appearance::of_same_faces(found, &read.mesh)?;
    files::write_with(output, &read.mesh, &attributes, printer)?;
    Ok(Exit::Done)
}
