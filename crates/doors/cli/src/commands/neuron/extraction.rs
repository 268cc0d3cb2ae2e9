//! The files of `NeuronTransportIGA`, and partitions for parallel work.

use crate::files;
use crate::interrupt::while_writing;
use crate::numbers::counted;
use crate::printer::Printer;
use anyhow::{Context, bail};
use pompeiu::io::write_stream;
use pompeiu::neuron::{Cap, CubicMesh, NeuronMesh};
use pompeiu::volume::{
    ExtractionFiles, HierarchicalSplines, UnstructuredSplines, controlmesh, epart, iga_units, partition,
    partition_quality, read_bzmeshinfo, read_bzpt,
};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Differences up to which splines are those of another program, whose files have six digits.
const AGREEMENT: f64 = 1e-6;

/// Writes the splines over a mesh as `NeuronTransportIGA` does, into a folder that is made.
pub(super) fn write(folder: &Path, mesh: &NeuronMesh, printer: &Printer) -> anyhow::Result<()> {
    fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let text = controlmesh(&mesh.mesh, &labels(mesh));
    files::write_whole(&folder.join("controlmesh.vtk"), text.as_bytes(), printer)?;
    let places = iga_units(mesh.mesh.positions());
    write_files(folder, printer, |files| files.write_unstructured(&mesh.mesh, &mesh.faces, &places))
}

/// Writes which splines each element has, and their Bézier coefficients, into a folder that is made.
pub(super) fn write_splines(
    folder: &Path,
    mesh: &CubicMesh,
    splines: &HierarchicalSplines,
    printer: &Printer,
) -> anyhow::Result<()> {
    fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    let places = iga_units(&splines.represent(&mesh.mesh, mesh.mesh.points()));
    write_files(folder, printer, |files| files.write_hierarchical(splines, &places))
}

/// Writes the files about splines; they appear once all of them are written.
fn write_files(
    folder: &Path,
    printer: &Printer,
    fill: impl FnOnce(&mut ExtractionFiles<&mut (dyn Write + Send)>) -> io::Result<()>,
) -> anyhow::Result<()> {
    let places = ["bzmeshinfo.txt", "bzpt.txt", "cmat.txt"].map(|name| folder.join(name));
    let [info, points, matrix] = &places;
    let written = while_writing(|| {
        write_stream(info, |bzmeshinfo| {
            write_stream(points, |bzpt| {
                write_stream(matrix, |cmat| fill(&mut ExtractionFiles { bzmeshinfo, bzpt, cmat }))
            })
        })
    });
    written.with_context(|| folder.display().to_string())?;
    for place in &places {
        let size = fs::metadata(place).with_context(|| place.display().to_string())?.len();
        files::note_size(place, size, printer);
    }
    Ok(())
}

/// The number of each vertex: −1 inside, 0 on the wall and at the rims of ends, 1 at the inlet, 2 and more at other ends.
fn labels(mesh: &NeuronMesh) -> Vec<i64> {
    let root = mesh.caps.iter().position(|cap: &Cap| cap.is_root).unwrap_or(0);
    let mut others = 2..;
    let number = |cap: usize| if cap == root { 1 } else { others.next().unwrap_or(2) };
    let numbers: Vec<i64> = (0..mesh.caps.len()).map(number).collect();
    let mut labels = vec![-1; mesh.mesh.positions().len()];
    let boundary = || mesh.faces.boundary().iter().zip(&mesh.labels);
    for (face, &label) in boundary().filter(|(_, label)| **label > 0) {
        for &v in &face.vertices {
            labels[v as usize] = numbers[label as usize - 1];
        }
    }
    for (face, _) in boundary().filter(|(_, label)| **label == 0) {
        for &v in &face.vertices {
            labels[v as usize] = 0;
        }
    }
    labels
}

/// Compares the splines over a mesh with the files of a folder; gives whether they agree.
pub(super) fn compare(folder: &Path, mesh: &NeuronMesh, printer: &Printer) -> anyhow::Result<bool> {
    let splines = UnstructuredSplines::new(&mesh.mesh, &mesh.faces);
    let mut agree = None;
    let mut told = |name: &str, difference: Option<f64>| {
        match difference {
            Some(off) => printer.note(format_args!("{name}: agrees to {off:.1e}")),
            None => printer.note(format_args!("{name}: other cells, or other functions in a cell")),
        }
        let agrees = difference.is_some_and(|off| off <= AGREEMENT);
        agree = Some(agree.unwrap_or(true) && agrees);
    };
    let read = |name: &str| -> anyhow::Result<Option<(PathBuf, String)>> {
        let path = folder.join(name);
        if !path.exists() {
            return Ok(None);
        }
        let text = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
        Ok(Some((path, text)))
    };
    if let Some((path, text)) = read("bzmeshinfo.txt")? {
        let functions = read_bzmeshinfo(&text).with_context(|| path.display().to_string())?;
        let own = splines.cells().iter().map(|cell| &cell.functions);
        told("bzmeshinfo.txt", own.eq(functions.iter()).then_some(0.0));
    }
    if let Some((path, text)) = read("cmat.txt")? {
        let theirs = UnstructuredSplines::from_cmat(&text).with_context(|| path.display().to_string())?;
        told("cmat.txt", splines.difference(&theirs));
    }
    if let Some((path, text)) = read("bzpt.txt")? {
        let theirs = read_bzpt(&text).with_context(|| path.display().to_string())?;
        let own = splines.bezier_points(&iga_units(mesh.mesh.positions()));
        let pairs = own.iter().flatten().zip(theirs.iter().flatten());
        let most = pairs.map(|(a, b)| (*a - *b).abs().max_element()).fold(0.0, f64::max);
        told("bzpt.txt", (own.len() == theirs.len()).then_some(most));
    }
    match agree {
        Some(agree) => Ok(agree),
        None => bail!("{}: has none of bzmeshinfo.txt, cmat.txt and bzpt.txt", folder.display()),
    }
}

/// Writes which process works on which cell, as METIS does beside a file of a mesh.
pub(super) fn write_partition(
    beside: &Path,
    mesh: &NeuronMesh,
    parts: usize,
    printer: &Printer,
) -> anyhow::Result<()> {
    let of = partition(mesh.mesh.cells().len(), &mesh.faces, parts);
    let mut name = beside.as_os_str().to_owned();
    name.push(format!(".epart.{parts}"));
    let place = PathBuf::from(name);
    files::write_whole(&place, epart(&of).as_bytes(), printer)?;
    let quality = partition_quality(&mesh.faces, &of);
    printer.note(format_args!(
        "{}: {}, the largest {:.3} times the mean, {} between them",
        place.display(),
        counted(parts, "part"),
        quality.imbalance,
        counted(quality.cut, "face")
    ));
    Ok(())
}
