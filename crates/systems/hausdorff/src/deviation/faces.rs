//! Distances face by face and vertex by vertex.

use super::distribution::{Sum, mean_of};
use super::linear::{greater, least, lesser};
use super::maxima::Maximum;
use super::report::{FaceDeviation, Field};
use super::statistics::length_out;
use pompeiu_core::exact::Interval;
use pompeiu_core::geom::Frame;
use pompeiu_core::spatial::{Bvh, Workspace};
use pompeiu_core::{FaceId, TriMesh};
use rayon::prelude::*;

/// Encloses the areas of the faces in a frame.
pub(super) fn areas(mesh: &TriMesh, frame: &Frame) -> Vec<(f64, f64)> {
    let area = |face: u32| {
        let [a, b, c] = mesh.corners(FaceId(face)).map(|p| frame.enclosure(p));
        let u = [0, 1, 2].map(|k| b[k] - a[k]);
        let v = [0, 1, 2].map(|k| c[k] - a[k]);
        let n = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| u[i] * v[j] - u[j] * v[i]);
        let doubled = (n[0].square() + n[1].square() + n[2].square()).sqrt();
        let area = Interval::point(0.5) * doubled;
        (greater(area.lower(), 0.0), area.upper())
    };
    (0..mesh.faces().len() as u32).into_par_iter().map(area).collect()
}

/// The enclosures of each face.
pub(super) fn faces(field: &Field, maxima: &[Maximum]) -> Vec<FaceDeviation> {
    (0..field.areas.len()).into_par_iter().map(|face| of_face(field, face, &maxima[face])).collect()
}

fn of_face(field: &Field, face: usize, maximum: &Maximum) -> FaceDeviation {
    let max = (maximum.lower, maximum.upper);
    let mut min = (f64::INFINITY, f64::INFINITY);
    let (mut shares, mut means) = (Sum::default(), Sum::default());
    for piece in field.of_face(face) {
        min = (lesser(min.0, least(piece.lower)), lesser(min.1, least(piece.upper)));
        let (low, high) = super::distribution::area_of(piece, (1.0, 1.0));
        let (below, above) = mean_of(piece.lower, piece.upper);
        shares.add(low, high);
        means.add(low * below, high * above);
    }
    let mean = means.enclosure().divide_by_positive(shares.enclosure());
    let mean = (greater(mean.lower(), 0.0), lesser(mean.upper(), max.1));
    let out = |(low, high): (f64, f64)| length_out(&field.frame, greater(lesser(low, high), 0.0), high);
    FaceDeviation { max: out(max), min: out(min), mean: out(mean) }
}

/// Distances of the vertices that belong to faces, in the unit of the mesh; NaN for the others.
pub(super) fn vertices(mesh: &TriMesh, frame: &Frame, bvh: &Bvh, order: &[u32]) -> Vec<f64> {
    const TASK: usize = 256;
    // Each vertex with the first of its faces in the order, in which neighbours are close.
    let mut seen = vec![false; mesh.positions().len()];
    let mut referenced = Vec::new();
    for &f in order {
        for v in mesh.faces()[f as usize] {
            if !std::mem::replace(&mut seen[v as usize], true) {
                referenced.push(v);
            }
        }
    }
    let distances: Vec<Vec<f64>> = referenced
        .par_chunks(TASK)
        .map(|vertices| {
            let mut workspace = Workspace::default();
            let mut hint = bvh.any_slot();
            let of_vertex = |v: &u32| {
                let nearest = bvh.nearest(frame.map(mesh.positions()[*v as usize]), hint, &mut workspace);
                hint = nearest.slot;
                frame.length_out(nearest.distance_sq.sqrt())
            };
            vertices.iter().map(of_vertex).collect()
        })
        .collect();
    let mut out = vec![f64::NAN; mesh.positions().len()];
    for (v, d) in referenced.into_iter().zip(distances.into_iter().flatten()) {
        out[v as usize] = d;
    }
    out
}
