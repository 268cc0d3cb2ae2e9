//! The two files of a comparison.

use crate::args::Limits;
use crate::files;
use crate::printer::Printer;
use crate::wait::Wait;
use anyhow::bail;
use pompeiu::core::mesh::{unit_factor, unreferenced_vertices};
use pompeiu::io::ReadMesh;
use pompeiu::matching::request::RequestError;
use std::path::Path;
use std::time::Instant;

/// Refuses, before anything is read, what cannot be compared.
pub(crate) fn check([a, b]: [&Path; 2]) -> anyhow::Result<()> {
    files::check_readable(a)?;
    files::check_readable(b)?;
    if files::are_same(a, b) && !a.is_file() {
        bail!("{}: is given twice, but a pipe can be read only once; save it to a file", a.display());
    }
    Ok(())
}

/// An error of a comparison with the files that were compared.
pub(crate) fn in_files([a, b]: [&Path; 2], error: RequestError) -> anyhow::Error {
    match error {
        RequestError::Option(_) | RequestError::Deviation(_) => error.into(),
        _ => anyhow::Error::new(error).context(format!("{} and {}", a.display(), b.display())),
    }
}

/// Reads both with one of the functions of [`files`] within the time limit, and warns of what deserves it.
pub(crate) fn read_files(
    [a, b]: [&Path; 2],
    read: fn(&Path) -> anyhow::Result<ReadMesh>,
    (limits, started): (&Limits, Instant),
    wait: &Wait,
    printer: &Printer,
) -> anyhow::Result<[ReadMesh; 2]> {
    wait.show(format!("reading {} and {}", a.display(), b.display()));
    let paths = [a, b].map(Path::to_owned);
    let (first, second) = limits.while_reading(started, move || {
        // Counting runs on one thread: beside the other file it costs the least.
        let read = |path: &Path| read(path).map(|read| (unreferenced_vertices(&read.mesh), read));
        rayon::join(|| read(&paths[0]), || read(&paths[1]))
    })?;
    let (first, second) = (first?, second?);
    wait.suspend(|| warn([a, b], [&first, &second], printer));
    Ok([first.1, second.1])
}

fn warn(paths: [&Path; 2], files: [&(usize, ReadMesh); 2], printer: &Printer) {
    let [a, b] = paths;
    if files::are_same(a, b) {
        printer.warning(format_args!("{} and {} are the same file", a.display(), b.display()));
    }
    for (path, (unreferenced, read)) in paths.into_iter().zip(files) {
        files::warn_of_changes(path, read, printer);
        files::warn_of_unreferenced(path, *unreferenced, printer);
    }
    if let Some((factor, a_is_larger)) = unit_factor(&files[0].1.mesh, &files[1].1.mesh) {
        let [large, small] = if a_is_larger { paths } else { [paths[1], paths[0]] };
        printer.warning(format_args!(
            "{} is about {factor} times the size of {}; are they in the same unit?",
            large.display(),
            small.display()
        ));
    }
}
