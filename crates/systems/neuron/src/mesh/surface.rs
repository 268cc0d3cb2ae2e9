//! The distance of the mesh's wall from the tubes, computed by the Hausdorff engine.

use super::options::SurfaceDistance;
use super::sweep::{RadialLength, stations};
use super::tube::{Tube, is_ball};
use crate::Skeleton;
use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::run::Control;
use pompeiu_hausdorff::{HausdorffOptions, Observer, Progress};
use std::ops::ControlFlow;

/// Sides of the polygons that approximate the circles of a tube: their sagitta is 0.1 % of the radius.
const SIDES: u32 = 64;

/// Rings of a triangulated tube per radius of length.
const RINGS: f64 = 3.0;

/// Subdivisions of the icosahedron that approximates a soma.
const SUBDIVISIONS: u32 = 4;

/// Ends the search when meshing has to end.
struct Watch<'c>(&'c Control);

impl Observer for Watch<'_> {
    fn progress(&self, _: &Progress) -> ControlFlow<()> {
        if self.0.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

/// Bounds on the greatest distance of a point of the wall, given as triangles, from the tubes as triangulated here. `None` if the
/// tubes are too large to be triangulated.
pub(super) fn surface_distance(
    skeleton: &Skeleton,
    tubes: &[Tube],
    (wall, wall_triangles): (Vec<[f64; 3]>, Vec<[u32; 3]>),
    factor: f64,
    control: &Control,
) -> Option<SurfaceDistance> {
    let wall = TriMesh::new(wall, wall_triangles).ok()?;
    let (mut positions, mut triangles): (Vec<[f64; 3]>, Vec<[u32; 3]>) = (Vec::new(), Vec::new());
    for tube in tubes {
        let lengths = RadialLength::new(tube, 0.0, tube.length());
        let places = lengths.places(1.0 / (RINGS * factor), 1);
        let rings = places.len() - 1;
        let base = u32::try_from(positions.len()).ok()?;
        for station in stations(tube, &places, None) {
            for k in 0..SIDES {
                let angle = std::f64::consts::TAU * f64::from(k) / f64::from(SIDES);
                let place = [libm::cos(angle), libm::sin(angle)].map(|x| x / factor);
                positions.push(station.at(place).to_array());
            }
        }
        for ring in 0..rings as u32 {
            for k in 0..SIDES {
                let at = |ring: u32, k: u32| base + ring * SIDES + k % SIDES;
                let [a, b, c, d] = [at(ring, k), at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    for (_, sample) in skeleton.samples().iter().enumerate().filter(|(i, _)| is_ball(skeleton, *i)) {
        let ball = icosphere(sample.radius, SUBDIVISIONS).ok()?;
        let base = u32::try_from(positions.len()).ok()?;
        let centre = sample.position.to_array();
        positions.extend(ball.positions().iter().map(|p| [0, 1, 2].map(|k| p[k] + centre[k])));
        triangles.extend(ball.faces().iter().map(|f| f.map(|v| v + base)));
    }
    let tubes = TriMesh::new(positions, triangles).ok()?;
    let watch = Watch(control);
    let options = HausdorffOptions { observer: Some(&watch), ..HausdorffOptions::default() };
    let report = options.directed(&wall, &tubes).ok()?;
    Some(SurfaceDistance { lower: report.distance.lower(), upper: report.distance.upper() })
}
