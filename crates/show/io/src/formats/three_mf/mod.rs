//! 3MF: a zip archive of XML, as slicers write it.
//!
//! Reads the meshes of all items of the build, with the components of their objects and the transforms of both, also where objects are in
//! other parts of the archive (the production extension). Coordinates are converted to millimetres from the unit that the file states; a
//! file in millimetres keeps every bit. Colours, textures, beams and slices are skipped.

mod build;
mod model;
mod package;

use super::Input;
use crate::error::FormatError;
use crate::expansion::Allowance;
use crate::raw::RawMesh;
use build::Build;
use model::Model;
use package::Package;
use std::collections::{BTreeSet, HashMap};

/// Reads the build of a 3MF file.
pub(crate) fn read(input: Input<'_>) -> Result<RawMesh, FormatError> {
    let (models, root, allowance) = models(input)?;
    // Objects that are used often are not longer than their file: the allowance holds for copies, too.
    Build::new(&models, allowance).place(&root)
}

/// What the file has besides its surface.
pub(crate) fn left_out(input: Input<'_>) -> Result<Vec<String>, FormatError> {
    let (models, ..) = models(input)?;
    // In the order of the names, whatever that of the parts is.
    let found: BTreeSet<&str> = models.values().flat_map(|model| model.left_out.iter().copied()).collect();
    let meshes = models.values().flat_map(|model| model.objects.values());
    let several = meshes.filter(|object| !object.faces.is_empty()).count() > 1;
    Ok(found.into_iter().chain(several.then_some("separate objects")).map(str::to_owned).collect())
}

/// The parts with objects by name, the name of the first, and what may still be unpacked.
fn models(input: Input<'_>) -> Result<(HashMap<String, Model>, String, Allowance), FormatError> {
    let mut allowance = Allowance::of_file(input.stored_bytes);
    let mut package = Package::open(input.bytes)?;
    let root = package.model_part(&mut allowance)?;
    let mut models = HashMap::new();
    let mut missing = vec![root.clone()];
    while let Some(part) = missing.pop() {
        if models.contains_key(&part) {
            continue;
        }
        let model = package.read(&part, &mut allowance, |xml| Model::parse(xml))?;
        missing.extend(model.other_parts().map(str::to_owned));
        models.insert(part, model);
    }
    Ok((models, root, allowance))
}
