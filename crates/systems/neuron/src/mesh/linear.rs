//! What trilinear cells lose that stand for tricubic ones in files.

use glam::DVec3;
use pompeiu_volume::bernstein::bernstein;
use pompeiu_volume::{BezierMesh, CORNER_PLACES, FACE_AXES, FACES, Faces, face_flux, face_points, volume};
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
/// Patch by patch: all trilinear cells at once take a hundred times the memory of the patches.
pub(crate) fn linear_shares(
    mesh: &BezierMesh,
    boundary: Labelled<'_>,
    parts: usize,
    velocity: Option<(&[DVec3], u32)>,
) -> LinearShares {
    let weights: Vec<[f64; 4]> = (0..=parts).map(|k| bernstein(k as f64 / parts as f64)).collect();
    let of_patch = |patch: usize| Parts::new(&mesh.control(patch), &weights).volume();
    let volumes: Vec<f64> = (0..mesh.cells().len()).into_par_iter().map(of_patch).collect();
    let ends = boundary.faces.boundary().iter().zip(boundary.labels).filter(|(_, label)| **label > 0);
    let caps = boundary.labels.iter().copied().max().unwrap_or(0) as usize;
    // Vectors, so that the area of an end is that seen along its axis.
    let mut areas = vec![[DVec3::ZERO; 2]; caps];
    let mut fluxes = [0.0; 2];
    for (face, &label) in ends {
        let [linear, cubic] = &mut areas[label as usize - 1];
        let (points, place) = (mesh.control(face.cell as usize), face.place.into());
        *cubic += face_points(&points, place).iter().map(|(_, area)| *area).sum::<DVec3>();
        let quads = Parts::new(&points, &weights).quads(place);
        for corners in &quads {
            *linear += 0.5 * (corners[2] - corners[0]).cross(corners[3] - corners[1]);
        }
        if let Some((field, _)) = velocity.filter(|(_, inlet)| *inlet == label) {
            let field = mesh.cells()[face.cell as usize].map(|v| field[v as usize]);
            fluxes[1] += face_flux(&points, &field, place);
            let velocities = Parts::new(&field, &weights).quads(place);
            fluxes[0] += quads.iter().zip(&velocities).map(|(a, b)| bilinear_flux(a, b)).sum::<f64>();
        }
    }
    let [linear, cubic] = [0, 1].map(|k| areas.iter().map(|of| of[k].length()).sum::<f64>());
    LinearShares {
        volume: volumes.iter().sum::<f64>() / mesh.volume(),
        area: (cubic > 0.0).then(|| linear / cubic),
        flux: (fluxes[1] != 0.0).then(|| fluxes[0] / fluxes[1]),
    }
}

/// The trilinear cells in the place of a patch, by the points of their lattice, the first axis fastest.
struct Parts {
    points: Vec<DVec3>,
    parts: usize,
}

impl Parts {
    /// Those of a patch, or of a field in it, from its coefficients and the weights of these at the steps along each axis.
    fn new(coefficients: &[DVec3; 64], weights: &[[f64; 4]]) -> Self {
        let at = |[u, v, w]: [&[f64; 4]; 3]| -> DVec3 {
            let weight = |n: usize| u[n % 4] * v[n / 4 % 4] * w[n / 16];
            coefficients.iter().enumerate().map(|(n, p)| *p * weight(n)).sum()
        };
        let along = || weights.iter();
        let points = along().flat_map(|w| along().flat_map(move |v| along().map(move |u| at([u, v, w]))));
        Self { points: points.collect(), parts: weights.len() - 1 }
    }

    /// The corners of the cell with this number.
    fn cell(&self, number: usize) -> [DVec3; 8] {
        let (n, side) = (self.parts, self.parts + 1);
        let [i, j, k] = [number % n, number / n % n, number / n / n];
        CORNER_PLACES.map(|[a, b, c]| self.points[i + a + side * (j + b + side * (k + c))])
    }

    fn volume(&self) -> f64 {
        (0..self.parts.pow(3)).map(|number| volume(&self.cell(number))).sum()
    }

    /// The faces of cells on a face of the patch, counter-clockwise seen from outside.
    fn quads(&self, place: usize) -> Vec<[DVec3; 4]> {
        let (axis, side, _) = FACE_AXES[place];
        let n = self.parts;
        let on_face = |number: &usize| number / n.pow(axis as u32) % n == side * (n - 1);
        let cells = (0..n.pow(3)).filter(on_face).map(|number| self.cell(number));
        cells.map(|corners| FACES[place].map(|k| corners[k])).collect()
    }
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
    use pompeiu_volume::HexMesh;

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
            let found = linear_shares(&mesh, boundary, parts, Some((&velocity, 1)));
            assert!((found.volume - 1.0).abs() < 1e-14 && (found.area.unwrap() - 1.0).abs() < 1e-14);
            // A chord of y (3 − y) over a step h is below by h³/6; the whole is 9/2.
            let h = 1.0 / parts as f64;
            let expected = 1.0 - 3.0 / h * h.powi(3) / 6.0 / 4.5;
            assert!((found.flux.unwrap() - expected).abs() < 1e-13, "{parts} {found:?} {expected}");
        }
        let closed = vec![0; labels.len()];
        let none = linear_shares(&mesh, Labelled { labels: &closed, ..boundary }, 1, None);
        assert_eq!((none.area, none.flux), (None, None));
    }
}
