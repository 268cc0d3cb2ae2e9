//! Seams along creases.
//!
//! Faces between the creases of what was designed are often parts of planes, cylinders and cones, which are flat or can be unrolled.

use crate::FlattenError;
use crate::components::{in_whole, split};
use crate::cut::{first_cut, open};
use crate::opened::opened_surface;
use crate::{CutOptions, CutStrategy};
use pompeiu_core::mesh::UnionFind;
use pompeiu_surface::{EdgeData, EdgeId, EmbeddedSurface};

/// An edge is a crease where the normals of its faces are farther apart than this angle, in degrees: more than the sides of a cylinder of
/// 12 are.
const CREASE: f64 = 35.0;

/// Regions between creases at most, as a share of the faces: where there are more, creases are roughness. Up to so many may be a greater share
/// if fewer than one in [`FEW_ALONE`] is one face, as the flanks of the teeth of a gear are, of two faces each; and so few any.
const MOST_REGIONS: f64 = 0.05;
const SOME_REGIONS: (usize, f64) = (1024, 0.15);
const FEW_ALONE: usize = 10;
const FEW_REGIONS: usize = 8;

/// The edges between regions that no crease divides, with what makes disks of these; none where creases bound no regions, or too many.
pub(crate) fn seams_along_creases(
    surface: &EmbeddedSurface,
    options: &CutOptions,
) -> Result<Option<EdgeData<bool>>, FlattenError> {
    let mesh = surface.mesh();
    let normals = surface.face_normals();
    let least = libm::cos(CREASE.to_radians());
    let across = |edge: EdgeId| {
        let h = mesh.edge_halfedge(edge);
        mesh.twin(h).map(|t| [h.face(), t.face()])
    };
    let mut regions = UnionFind::new(mesh.faces());
    for [f, g] in mesh.edge_ids().filter_map(across) {
        let [m, n] = [normals[f], normals[g]];
        if m[0] * n[0] + m[1] * n[1] + m[2] * n[2] >= least {
            regions.union(f.index(), g.index());
        }
    }
    let mut sizes = vec![0_usize; mesh.faces()];
    for f in 0..mesh.faces() {
        sizes[regions.find(f)] += 1;
    }
    let count = sizes.iter().filter(|size| **size > 0).count();
    let alone = sizes.iter().filter(|size| **size == 1).count();
    let share = |share: f64| (share * mesh.faces() as f64) as usize;
    let some =
        if FEW_ALONE * alone < count { share(SOME_REGIONS.1).min(SOME_REGIONS.0) } else { FEW_REGIONS };
    let most = share(MOST_REGIONS).max(some).max(FEW_REGIONS);
    if count <= mesh.components() || count > most {
        return Ok(None);
    }
    let mut seams = EdgeData::filled(mesh.edges(), false);
    for edge in mesh.edge_ids() {
        seams[edge] = across(edge).is_some_and(|[f, g]| regions.find(f.index()) != regions.find(g.index()));
    }
    let opened = open(mesh, &seams)?;
    // A region that is a sphere is cut between its tips, any other into a disk.
    let options = &CutOptions { strategy: CutStrategy::Auto, ..options.clone() };
    for part in split(&opened_surface(&opened, surface)?, None)? {
        let first = first_cut(&part, options).map_err(|error| in_whole(error, &part))?;
        part.mark_in(mesh, &first, &mut seams);
    }
    Ok(Some(seams))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seams::{ShortSeams, seam_length};
    use crate::watch::Watch;
    use pompeiu_core::TriMesh;
    use pompeiu_core::mesh::shapes::{Ends, cube, cylinder, icosphere};
    use pompeiu_core::run::{Control, Limits};

    fn seams(mesh: &TriMesh) -> (EmbeddedSurface, Option<EdgeData<bool>>) {
        let surface = EmbeddedSurface::new(mesh).unwrap();
        let found = seams_along_creases(&surface, &CutOptions::default()).unwrap();
        (surface, found)
    }

    #[test]
    fn regions_between_creases_become_disks() {
        let (surface, found) = seams(&cylinder(1.0, 4.0, 64, 3, Ends::Capped).unwrap());
        let rims = 2.0 * 64.0 * 2.0 * (std::f64::consts::PI / 64.0).sin();
        assert!((seam_length(surface.surface(), &found.unwrap()) - rims - 4.0).abs() < 1e-12);
        assert!(seams(&icosphere(1.0, 3).unwrap()).1.is_none());
        // Each face of a rough surface would be a region of its own.
        assert!(seams(&icosphere(1.0, 0).unwrap()).1.is_none());
    }

    /// A cube of side 2 has 12 edges. Five at most can be closed without distortion; those that meet at a corner count as one arc, which is
    /// closed as a whole or not at all.
    #[test]
    fn a_cube_is_unfolded() {
        let (surface, found) = seams(&cube(2.0, 3).unwrap());
        let found = found.unwrap();
        assert!((seam_length(surface.surface(), &found) - 24.0).abs() < 1e-12);
        let control = Control::start(&Limits::default());
        let watch = Watch::new(&control, None, 1);
        let mut closing = ShortSeams::new(surface.surface(), &found).unwrap();
        let closed = closing.shrink(1e-9, &watch).unwrap();
        let left = seam_length(surface.surface(), &closed);
        assert!((14.0 - 1e-9..=16.0 + 1e-9).contains(&left), "{left}");
        assert!(closing.estimate() < 1e-9);
        open(surface.mesh(), &closed).unwrap().check_disks().unwrap();
    }
}
