//! What trilinear cells lose that stand for tricubic ones in files.

use glam::DVec3;
use pompeiu_volume::{
    BezierMesh, FACE_AXES, FACES, Faces, HexMesh, VolumeError, face_flux, face_points, volume,
};
use rayon::prelude::*;

/// What trilinear cells keep that stand for tricubic ones in files, as shares of theirs. The sides of sections are chords there.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct LinearShares {
    /// Of the volume.
    pub volume: f64,
    /// Of the area of the flat ends, which are sections; omitted if there are none.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub area: Option<f64>,
    /// Of what flows in at the inlet, with the velocity interpolated between corners; omitted without a flow.
    #[cfg_attr(feature = "serde", serde(skip_serializing_if = "Option::is_none"))]
    pub flux: Option<f64>,
}

/// Boundary faces of a mesh with their labels: 0 on the wall, and 1 + k on cap k.
#[derive(Clone, Copy)]
pub(crate) struct Labelled<'f> {
    pub(crate) faces: &'f Faces,
    pub(crate) labels: &'f [u32],
}

/// The shares of trilinear cells, so many along each axis of each patch; with the flux if there is a velocity, with the label of its inlet.
///
/// # Errors
/// [`VolumeError`] if they would be too many.
pub(crate) fn linear_shares(
    mesh: &BezierMesh,
    boundary: Labelled<'_>,
    parts: usize,
    velocity: Option<(&[DVec3], u32)>,
) -> Result<LinearShares, VolumeError> {
    let field = velocity.map(|(field, _)| field);
    let (fine, fields) = mesh.subdivided(parts, field.as_slice())?;
    let fine = fine.corner_mesh()?;
    let total: f64 =
        fine.cells().par_iter().map(|&cell| volume(&fine.corners(cell))).collect::<Vec<_>>().iter().sum();
    let ends = boundary.faces.boundary().iter().zip(boundary.labels).filter(|(_, label)| **label > 0);
    let caps = boundary.labels.iter().copied().max().unwrap_or(0) as usize;
    // Vectors, so that the area of an end is that seen along its axis.
    let mut areas = vec![[DVec3::ZERO; 2]; caps];
    let mut fluxes = [0.0; 2];
    for (face, &label) in ends {
        let [linear, cubic] = &mut areas[label as usize - 1];
        let points = mesh.control(face.cell as usize);
        *cubic += face_points(&points, face.place.into()).iter().map(|(_, area)| *area).sum::<DVec3>();
        let at_inlet = velocity.filter(|(_, inlet)| *inlet == label);
        if let Some((field, _)) = at_inlet {
            let field = mesh.cells()[face.cell as usize].map(|v| field[v as usize]);
            fluxes[1] += face_flux(&points, &field, face.place.into());
        }
        for quad in quads(&fine, face.cell as usize, face.place.into(), parts) {
            let corners = quad.map(|v| fine.positions()[v as usize]);
            *linear += 0.5 * (corners[2] - corners[0]).cross(corners[3] - corners[1]);
            if let (Some(_), Some(field)) = (at_inlet, fields.first()) {
                fluxes[0] += bilinear_flux(&corners, &quad.map(|v| field[v as usize]));
            }
        }
    }
    let [linear, cubic] = [0, 1].map(|k| areas.iter().map(|of| of[k].length()).sum::<f64>());
    Ok(LinearShares {
        volume: total / mesh.volume(),
        area: (cubic > 0.0).then(|| linear / cubic),
        flux: (fluxes[1] != 0.0).then(|| fluxes[0] / fluxes[1]),
    })
}

/// The faces of the parts of a cell on one of its faces, by vertices, counter-clockwise seen from outside.
fn quads(fine: &HexMesh, cell: usize, place: usize, parts: usize) -> impl Iterator<Item = [u32; 4]> {
    let (axis, side, _) = FACE_AXES[place];
    let on_face = move |part: &usize| part / parts.pow(axis as u32) % parts == side * (parts - 1);
    let first = cell * parts.pow(3);
    (0..parts.pow(3)).filter(on_face).map(move |part| FACES[place].map(|k| fine.cells()[first + part][k]))
}

/// The flux of a bilinear velocity through a bilinear face: exact, since two Gauss points along each direction integrate cubics.
fn bilinear_flux(corners: &[DVec3; 4], velocity: &[DVec3; 4]) -> f64 {
    let [a, b, c, d] = *corners;
    let offset = 0.5 / 3.0_f64.sqrt();
    let places = [0.5 - offset, 0.5 + offset];
    let at = |u: f64, v: f64| {
        let slopes = [(b - a) * (1.0 - v) + (c - d) * v, (d - a) * (1.0 - u) + (c - b) * u];
        let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v];
        let speed: DVec3 = velocity.iter().zip(weights).map(|(v, w)| *v * w).sum();
        0.25 * speed.dot(slopes[0].cross(slopes[1]))
    };
    places.iter().flat_map(|&u| places.map(|v| at(u, v))).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_loses_nothing_and_fluxes_of_quadratic_fields_are_those_of_their_chords() {
        let grid = HexMesh::grid([2, 3, 2], [2.0, 3.0, 1.0]);
        let mesh = BezierMesh::from_trilinear(&grid);
        let faces = Faces::new(&mesh.corner_mesh().unwrap()).unwrap();
        let is_inlet = |place: u8| (FACE_AXES[place as usize].0, FACE_AXES[place as usize].1) == (0, 0);
        let labels: Vec<u32> = faces.boundary().iter().map(|face| u32::from(is_inlet(face.place))).collect();
        let boundary = Labelled { faces: &faces, labels: &labels };
        // v = y (3 − y) along x: Bézier coefficients of each patch, by its values in thirds.
        let mut velocity = vec![DVec3::ZERO; mesh.points().len()];
        for (k, cell) in mesh.cells().iter().enumerate() {
            let points = mesh.control(k);
            let values = points.map(|p| DVec3::X * (p.y * (3.0 - p.y)));
            for (v, value) in cell.iter().zip(pompeiu_volume::bernstein::interpolate_lattice(&values)) {
                velocity[*v as usize] = value;
            }
        }
        for parts in [1, 2, 3] {
            let found = linear_shares(&mesh, boundary, parts, Some((&velocity, 1))).unwrap();
            assert!((found.volume - 1.0).abs() < 1e-14 && (found.area.unwrap() - 1.0).abs() < 1e-14);
            // A chord of y (3 − y) over a step h is below by h³/6; the whole is 9/2.
            let h = 1.0 / parts as f64;
            let expected = 1.0 - 3.0 / h * h.powi(3) / 6.0 / 4.5;
            assert!((found.flux.unwrap() - expected).abs() < 1e-13, "{parts} {found:?} {expected}");
        }
        let closed = vec![0; labels.len()];
        let none = linear_shares(&mesh, Labelled { labels: &closed, ..boundary }, 1, None).unwrap();
        assert_eq!((none.area, none.flux), (None, None));
    }
}
