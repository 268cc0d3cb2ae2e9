//! How a mesh looks in its file, and what of that an output has a place for.

mod carried;

pub(crate) use carried::Carried;

use crate::printer::Printer;
use pompeiu::core::TriMesh;
use pompeiu::io::{Appearance, Attributes, OutputFormat, read_appearance};
use std::path::Path;

/// Reads how a mesh looks and drops what `output` has no place for, which is said in one line.
pub(crate) fn read(
    input: &Path,
    mesh: &TriMesh,
    output: &Path,
    printer: &Printer,
) -> anyhow::Result<Appearance> {
    let mut found = read_appearance(input, mesh)?;
    let Some(format) = OutputFormat::from_path(output) else { return Ok(found) };
    let mut said = Vec::new();
    let lost = lost(&found, format);
    if !lost.is_empty() {
        let others = OutputFormat::ALL.into_iter().filter(|other| self::lost(&found, *other).is_empty());
        let others: Vec<&str> = others.map(OutputFormat::name).collect();
        let advice =
            if others.is_empty() { String::new() } else { format!("; write {}", joined(&others, "or")) };
        let name = format.name();
        said.push(format!(
            "{} are not in the output, because {name} has no place for them{advice}",
            joined(&lost, "and")
        ));
    }
    if !found.left_out.is_empty() {
        said.push(format!("{} are not read", joined(&found.left_out, "and")));
    }
    if !said.is_empty() {
        printer.warning(format_args!("{}: {}", input.display(), said.join("; ")));
    }
    fit(&mut found, format);
    Ok(found)
}

/// Says in one line that an output has nothing of how the input looks, if that has any.
pub(crate) fn leave_out(input: &Path, mesh: &TriMesh, why: &str, printer: &Printer) -> anyhow::Result<()> {
    let found = read_appearance(input, mesh)?;
    let all: Vec<String> = parts(&found).into_iter().chain(found.left_out).collect();
    if !all.is_empty() {
        printer.warning(format_args!(
            "{}: {} are not in the output, {why}",
            input.display(),
            joined(&all, "and")
        ));
    }
    Ok(())
}

/// The attributes of a mesh that has the faces of the input, in their order.
pub(crate) fn of_same_faces(found: Appearance, mesh: &TriMesh) -> anyhow::Result<Attributes> {
    Ok(Attributes::for_mesh(mesh).with_appearance(found)?)
}

/// All that is known, in the plural.
fn parts(found: &Appearance) -> Vec<String> {
    let parts = [
        (found.colors.is_some(), "colours"),
        (!found.texture.is_empty(), "texture coordinates"),
        (found.normals.is_some(), "normals"),
        (found.materials.is_some(), "materials"),
    ];
    parts.into_iter().filter(|(has, _)| *has).map(|(_, name)| name.to_owned()).collect()
}

/// What a format has no place for, in the plural.
fn lost(found: &Appearance, format: OutputFormat) -> Vec<String> {
    let sets = found.texture.len();
    let materials = found.materials.as_ref();
    let described = materials.is_some_and(|materials| materials.descriptions.is_some());
    let keeps_colors = format.holds_vertex_colors();
    let keeps_names = format.holds_materials();
    let parts = [
        (found.colors.is_some() && !keeps_colors, "colours"),
        (keeps_colors && !format.holds_descriptions() && has_opacity(found), "opacities of colours"),
        (sets > 0 && !format.holds_texture(), "texture coordinates"),
        (format.holds_texture() && sets > format.texture_sets(), "further sets of texture coordinates"),
        (found.normals.is_some() && !format.holds_normals(), "normals"),
        (materials.is_some() && !keeps_names, "materials"),
        (described && keeps_names && !format.holds_descriptions(), "materials but for their names"),
        (
            materials.is_some_and(|materials| materials.library.is_some()) && format == OutputFormat::Glb,
            "materials but for their names",
        ),
    ];
    parts.into_iter().filter(|(is_lost, _)| *is_lost).map(|(_, name)| name.to_owned()).collect()
}

fn has_opacity(found: &Appearance) -> bool {
    found.linear_colors.as_ref().is_some_and(|colors| colors.values.iter().any(|color| color[3] < 1.0))
}

/// Drops what a format has no place for.
fn fit(found: &mut Appearance, format: OutputFormat) {
    if !format.holds_vertex_colors() {
        found.colors = None;
    }
    if !format.holds_descriptions() {
        found.linear_colors = None;
    }
    found.texture.truncate(format.texture_sets());
    if !format.holds_normals() {
        found.normals = None;
    }
    if !format.holds_materials() {
        found.materials = None;
    }
    if let Some(materials) = &mut found.materials {
        materials.descriptions.take_if(|_| !format.holds_descriptions());
        materials.library.take_if(|_| format != OutputFormat::Obj);
    }
}

/// Names in a row, the last one after a word.
fn joined<S: AsRef<str>>(names: &[S], word: &str) -> String {
    match names {
        [] => String::new(),
        [only] => only.as_ref().to_owned(),
        [first @ .., last] => {
            let first: Vec<&str> = first.iter().map(AsRef::as_ref).collect();
            format!("{} {word} {}", first.join(", "), last.as_ref())
        }
    }
}
