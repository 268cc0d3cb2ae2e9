//! Texture coordinates, materials and colours of the input, carried over to what is written.

use crate::files;
use crate::printer::Printer;
use anyhow::Context;
use pompeiu::core::{TriMesh, VertexId};
use pompeiu::io::{Attributes, Materials, OutputFormat, read_appearance};
use pompeiu::remesh::{Carrier, CornerValues, Kept, Simplified};
use std::path::Path;

/// How the input looks, as far as the output has a place for it.
#[derive(Default)]
pub(super) struct Appearance {
    /// Texture coordinates, or one value everywhere where there are only materials.
    places: Option<Carrier<2>>,
    has_texture: bool,
    materials: Option<Materials>,
    colors: Option<Carrier<3>>,
    pub(super) seams: Vec<[VertexId; 2]>,
}

impl Appearance {
    /// Reads what `output` has a place for, and warns of the rest.
    pub(super) fn read(
        input: &Path,
        mesh: &TriMesh,
        output: &Path,
        repair: bool,
        printer: &Printer,
    ) -> anyhow::Result<Self> {
        let mut found = read_appearance(input, mesh)?;
        let format = OutputFormat::from_path(output);
        let leave_out = |what: &str, why: &str| {
            printer.warning(format_args!("{}: {what} not in the output, {why}", input.display()));
        };
        if repair {
            if found.texture.is_some() || found.colors.is_some() || found.materials.is_some() {
                leave_out(
                    "colours and texture coordinates are",
                    "because repairing cuts faces apart; repair the mesh first",
                );
            }
            return Ok(Self::default());
        }
        if found.texture.is_some() && !format.is_some_and(OutputFormat::holds_texture) {
            found.texture = None;
            leave_out("texture coordinates are", "which has no place for them; write OBJ or GLB");
        }
        if found.colors.is_some() && !format.is_some_and(OutputFormat::holds_vertex_colors) {
            found.colors = None;
            leave_out("colours are", "which has no place for them; write PLY, OBJ, OFF or GLB");
        }
        if found.materials.is_some() && format != Some(OutputFormat::Obj) {
            found.materials = None;
            leave_out("materials are", "which has no place for them; write OBJ");
        }
        let file = || input.display().to_string();
        let has_texture = found.texture.is_some();
        let values = match found.texture {
            Some(texture) => Some(CornerValues { values: texture.coordinates, corners: texture.corners }),
            None => found
                .materials
                .as_ref()
                .map(|_| CornerValues { values: vec![[0.0; 2]], corners: vec![[0; 3]; mesh.faces().len()] }),
        };
        let groups = found.materials.as_ref().map_or(&[][..], |materials| &materials.faces);
        let places =
            values.map(|values| Carrier::new(mesh, values, groups)).transpose().with_context(file)?;
        let colors = found.colors.map(|colors| {
            let values = colors.into_iter().map(|color| color.map(f64::from)).collect();
            Carrier::new(mesh, CornerValues { values, corners: mesh.faces().to_vec() }, &[])
        });
        let colors = colors.transpose().with_context(file)?;
        let seams = places.as_ref().map(Carrier::seams).unwrap_or_default();
        Ok(Self { places, has_texture, materials: found.materials, colors, seams })
    }

    pub(super) fn kept(&self) -> Kept {
        Kept {
            texture: self.has_texture,
            seam_edges: self.seams.len(),
            materials: self.materials.as_ref().map_or(0, |materials| {
                let mut used = materials.faces.clone();
                used.sort_unstable();
                used.dedup();
                used.len()
            }),
            colors: self.colors.is_some(),
        }
    }

    /// Writes a result with what is carried over to it.
    pub(super) fn write(&self, path: &Path, found: &Simplified, printer: &Printer) -> anyhow::Result<()> {
        let mesh = &found.mesh;
        let mut attributes = Attributes::for_mesh(mesh);
        if let Some(places) = self.places.as_ref().filter(|_| self.has_texture) {
            let carried = places.carry(mesh, &found.kept)?;
            attributes = attributes.with_texture(carried.values, carried.corners, None)?;
        }
        if let (Some(places), Some(materials)) = (&self.places, &self.materials) {
            let faces = places.faces_below(mesh).iter().map(|f| materials.faces[*f as usize]).collect();
            attributes = attributes.with_materials(Materials { faces, ..materials.clone() })?;
        }
        if let Some(colors) = &self.colors {
            let carried = colors.at_vertices(mesh)?.into_iter();
            attributes =
                attributes.with_vertex_colors(carried.map(|c| c.map(|x| x.round() as u8)).collect())?;
        }
        files::write_shifted(path, mesh, &attributes, &found.rounding, printer)
    }
}
