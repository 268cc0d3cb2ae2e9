//! Surfaces, fields, and norms of differences between fields.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{self, Ends};
use pompeiu_core::mesh::{ElementData, ElementId, displace_at_random, merge, shuffle, subdivide};
use pompeiu_surface::{EmbeddedSurface, Surface, flat_torus};

pub(crate) use pompeiu_operators::FaceField as Field;

pub(crate) fn surface(mesh: &TriMesh) -> Surface {
    EmbeddedSurface::new(mesh).unwrap().surface().clone()
}

/// A name, a surface, and the dimension of its harmonic fields.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) surface: Surface,
    pub(crate) harmonic: usize,
}

fn case(name: &'static str, mesh: &TriMesh, harmonic: usize) -> Case {
    Case { name, surface: surface(mesh), harmonic }
}

/// Surfaces of every kind: closed, open, of several genera and components, with uneven faces, without an embedding.
pub(crate) fn cases() -> Vec<Case> {
    let sphere = shapes::icosphere(1.0, 2).unwrap();
    let torus = shapes::torus(2.0, 0.7, 24, 16).unwrap();
    let annulus = shapes::cylinder(1.0, 1.5, 17, 6, Ends::Open).unwrap();
    let disk = shapes::disk(1.0, 20, 6).unwrap();
    let rough = shuffle(&displace_at_random(&torus, 0.1, 4).unwrap(), 9);
    let plate = shapes::perforated_plate(1.0, 3).unwrap();
    let (positions, mut faces) = subdivide(&plate).unwrap().into_parts();
    for f in [403, 283, 135, 3] {
        faces.remove(f);
    }
    let open_plate = TriMesh::new(positions, faces).unwrap();
    let parts = merge(&[&torus, &annulus, &sphere, &disk]).unwrap();
    let mut all = vec![
        case("sphere", &sphere, 0),
        case("torus", &torus, 2),
        case("rough torus", &rough, 2),
        case("annulus", &annulus, 1),
        case("disk", &disk, 0),
        case("plate with three holes", &plate, 6),
        case("plate with three holes and four openings", &open_plate, 9),
        case("four components", &parts, 3),
    ];
    let flat = flat_torus([3.0, 2.0], [12, 9]).unwrap();
    all.push(Case { name: "flat torus", surface: flat, harmonic: 2 });
    all
}

/// External meshes, where they are present.
pub(crate) fn shared_cases() -> Vec<Case> {
    let named = [("3holes", 6), ("fertility", 8)];
    named
        .into_iter()
        .filter_map(|(name, harmonic)| Some(Case { name, surface: surface(&shared(name)?), harmonic }))
        .collect()
}

/// A shared OFF file, if it is present.
pub(crate) fn shared(name: &str) -> Option<TriMesh> {
    Some(pompeiu_io::read_mesh(pompeiu_testkit::data::file(&format!("meshes/{name}.off"))?).unwrap())
}

/// Numbers in [−1, 1), by a linear congruence.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub(crate) fn values<I: ElementId>(&mut self, count: usize) -> ElementData<I, f64> {
        ElementData::from_fn(count, |_| self.next())
    }

    pub(crate) fn field(&mut self, surface: &Surface) -> Field {
        Field::from_fn(surface.mesh().faces(), |_| [self.next(), self.next()])
    }
}

pub(crate) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |m, x| if x.abs() > m { x.abs() } else { m })
}
