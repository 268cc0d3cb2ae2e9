//! Points that queries ask about.

use pompeiu_core::TriMesh;
use pompeiu_core::geom::Aabb;
use pompeiu_core::mesh::displace_at_random;

/// Points in no order, each within a hundredth of the diagonal of a vertex: what measuring a scan asks.
pub fn near(mesh: &TriMesh, count: usize) -> Vec<[f64; 3]> {
    let diagonal = Aabb::of_faces(mesh).diagonal();
    let displaced = displace_at_random(mesh, 0.01 * diagonal, 3).expect("finite");
    let positions = displaced.positions();
    uniform(count).map(|[x, _, _]| positions[(x * positions.len() as f64) as usize]).collect()
}

/// Points spread over the box of a mesh, most of them far from its surface.
pub fn far(mesh: &TriMesh, count: usize) -> Vec<[f64; 3]> {
    let Aabb { lower, upper } = Aabb::of_faces(mesh);
    uniform(count).map(|p| [0, 1, 2].map(|k| lower[k] + p[k] * (upper[k] - lower[k]))).collect()
}

/// Points that fill the unit cube evenly: multiples, modulo one, of the powers of 1/r with r⁴ = r + 1.
fn uniform(count: usize) -> impl Iterator<Item = [f64; 3]> {
    const R: f64 = 1.220_744_084_605_759_5;
    (1..=count).map(|i| [R.recip(), R.powi(-2), R.powi(-3)].map(|step| (i as f64 * step).fract()))
}

/// The corners of a face and their mean, coordinate by coordinate: what the tree takes for a cover.
pub fn with_centre(corners: [[f64; 3]; 3]) -> [[f64; 4]; 3] {
    [0, 1, 2].map(|k| {
        let [x, y, z] = corners.map(|corner| corner[k]);
        [x, y, z, (x + y + z) / 3.0]
    })
}
