//! How a mesh looks, carried over to another mesh near it.

use anyhow::Context;
use pompeiu::core::{TriMesh, VertexId};
use pompeiu::io::{self, Appearance, Attributes, Materials};
use pompeiu::remesh::{Carrier, CornerValues, Kept};
use std::path::Path;

/// Colours, texture coordinates and materials of the input, ready to be asked for the values on a surface near it. Normals are not among
/// them: they are those of the new faces.
#[derive(Default)]
pub(crate) struct Carried {
    /// The sets of texture coordinates.
    sets: Vec<Carrier<2>>,
    /// One value everywhere, where there are materials and no texture coordinates.
    plain: Option<Carrier<2>>,
    materials: Option<Materials>,
    colors: Option<Carrier<3>>,
    linear_colors: Option<Carrier<4>>,
    /// Edges of the input where texture coordinates or materials change.
    pub(crate) seams: Vec<[VertexId; 2]>,
}

impl Carried {
    /// Prepares what is known of a mesh, which is that of the file `input`.
    pub(crate) fn of(found: Appearance, mesh: &TriMesh, input: &Path) -> anyhow::Result<Self> {
        Self::prepare(found, mesh).with_context(|| input.display().to_string())
    }

    fn prepare(found: Appearance, mesh: &TriMesh) -> anyhow::Result<Self> {
        let groups = found.materials.as_ref().map_or(&[][..], |materials| &materials.faces);
        let sets = found.texture.into_iter().map(|set| Carrier::new(mesh, values(set), groups));
        let sets = sets.collect::<Result<Vec<_>, _>>()?;
        let plain = if sets.is_empty() && !groups.is_empty() {
            let one = CornerValues { values: vec![[0.0; 2]], corners: vec![[0; 3]; mesh.faces().len()] };
            Some(Carrier::new(mesh, one, groups)?)
        } else {
            None
        };
        let linear_colors =
            found.linear_colors.map(|colors| Carrier::new(mesh, values(colors), &[])).transpose()?;
        let colors = found.colors.filter(|_| linear_colors.is_none()).map(|colors| {
            let values = colors.into_iter().map(|color| color.map(f64::from)).collect();
            Carrier::new(mesh, CornerValues { values, corners: mesh.faces().to_vec() }, &[])
        });
        let mut seams: Vec<[VertexId; 2]> = sets.iter().chain(&plain).flat_map(Carrier::seams).collect();
        seams.sort_unstable();
        seams.dedup();
        Ok(Self {
            sets,
            plain,
            materials: found.materials,
            colors: colors.transpose()?,
            linear_colors,
            seams,
        })
    }

    /// What there is, for reports.
    pub(crate) fn kept(&self) -> Kept {
        Kept {
            texture: !self.sets.is_empty(),
            seam_edges: self.seams.len(),
            materials: self.materials.as_ref().map_or(0, |materials| {
                let mut used = materials.faces.clone();
                used.sort_unstable();
                used.dedup();
                used.len()
            }),
            colors: self.colors.is_some() || self.linear_colors.is_some(),
        }
    }

    /// The values on a mesh near the input, of which the edges `kept` lie on curves of the input.
    pub(crate) fn attributes(&self, mesh: &TriMesh, kept: &[[VertexId; 2]]) -> anyhow::Result<Attributes> {
        let mut attributes = Attributes::for_mesh(mesh);
        for set in &self.sets {
            let carried = set.carry(mesh, kept)?;
            attributes = attributes.with_texture(carried.values, carried.corners, None)?;
        }
        if let (Some(places), Some(materials)) = (self.sets.first().or(self.plain.as_ref()), &self.materials)
        {
            let faces = places.faces_below(mesh).iter().map(|f| materials.faces[*f as usize]).collect();
            attributes = attributes.with_materials(Materials { faces, ..materials.clone() })?;
        }
        if let Some(colors) = &self.colors {
            let carried = colors.at_vertices(mesh)?.into_iter();
            let colors = carried.map(|color| color.map(|x| x.round() as u8)).collect();
            attributes = attributes.with_vertex_colors(colors)?;
        }
        if let Some(colors) = &self.linear_colors {
            let CornerValues { values, corners } = colors.carry(mesh, kept)?;
            attributes = attributes.with_linear_colors(io::CornerValues { values, corners })?;
        }
        Ok(attributes)
    }
}

fn values<const N: usize>(set: io::CornerValues<N>) -> CornerValues<N> {
    CornerValues { values: set.values, corners: set.corners }
}
