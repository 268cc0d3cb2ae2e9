//! Points with normals, distributed evenly over a surface.

use super::super::samples::{Sample, samples};
use super::grid::Grid;
use glam::DVec3;
use pompeiu_core::TriMesh;
use pompeiu_core::geom::Frame;

/// Samples per point that is kept; normals are means over samples.
const SAMPLES_PER_POINT: f64 = 12.0;
/// Largest number of samples.
const MOST_SAMPLES: f64 = 60_000.0;

/// A point of a surface with the mean unit normal around it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Oriented {
    pub(super) point: DVec3,
    pub(super) normal: DVec3,
}

impl Oriented {
    /// A sample in the unit of the result, reversed if the orientation of the mesh is.
    pub(super) fn of(sample: Sample, unit: f64, inside_out: bool) -> Self {
        let normal = if inside_out { -sample.normal } else { sample.normal };
        Self { point: sample.point * unit, normal }
    }
}

/// Points at least `spacing` apart (on each side of the surface), with normals averaged over that radius, because normals of single
/// noisy faces are unreliable. `unit` scales from the frame of the mesh to the unit of the result.
pub(super) fn oriented(mesh: &TriMesh, frame: &Frame, unit: f64, area: f64, spacing: f64) -> Vec<Oriented> {
    let count = (SAMPLES_PER_POINT * area / (spacing * spacing)).clamp(100.0, MOST_SAMPLES);
    let all: Vec<Oriented> =
        samples(mesh, frame, count as usize).into_iter().map(|s| Oriented::of(s, unit, false)).collect();
    let close = |a: &Oriented, b: &Oriented| {
        a.point.distance_squared(b.point) < spacing * spacing && a.normal.dot(b.normal) > 0.0
    };
    let (mut kept, mut taken) = (Vec::new(), Grid::new(spacing));
    for sample in &all {
        if !taken.near(sample.point).any(|other| close(sample, &kept[other as usize])) {
            taken.insert(kept.len() as u32, sample.point);
            kept.push(*sample);
        }
    }
    let mut grid = Grid::new(spacing);
    for (i, sample) in all.iter().enumerate() {
        grid.insert(i as u32, sample.point);
    }
    let smooth = |sample: &Oriented| {
        let around = grid.near(sample.point).map(|other| all[other as usize]);
        let sum: DVec3 = around.filter(|other| close(sample, other)).map(|other| other.normal).sum();
        Oriented { normal: sum.try_normalize().unwrap_or(sample.normal), ..*sample }
    };
    kept.iter().map(smooth).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use pompeiu_core::geom::Aabb;
    use pompeiu_core::mesh::shapes::icosphere;

    #[test]
    fn points_of_a_sphere_are_apart_and_point_outwards() {
        let sphere = icosphere(1.0, 4).unwrap();
        let frame = Frame::of(&Aabb::of_faces(&sphere));
        let unit = frame.length_out(1.0);
        let points = oriented(&sphere, &frame, unit, 4.0 * std::f64::consts::PI, 0.1);
        assert!((700..1800).contains(&points.len()), "{}", points.len());
        let centre = DVec3::from_array(frame.map([0.0; 3])) * unit;
        for (i, p) in points.iter().enumerate() {
            assert!(p.normal.dot(p.point - centre) > 0.99);
            assert!(points[..i].iter().all(|q| q.point.distance(p.point) >= 0.1));
        }
    }
}
