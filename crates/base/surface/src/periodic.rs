//! Surfaces without an embedding in space.

use crate::{EdgeData, GeometryError, Surface, SurfaceError, SurfaceMesh};

/// The flat torus: a rectangle whose opposite sides are glued, split into `cells[0] × cells[1]` rectangles with one diagonal
/// each.
///
/// Every vertex is flat, so the surface is locally the plane; the frame of every even face is that of the rectangle.
///
/// # Shapes and units
/// `size`: lengths of the two sides. With n × m cells, vertex `(i, j)` is number `j n + i`; faces `2 (j n + i)`, below the
/// diagonal, and the next, above it, belong to its cell.
/// # Errors
/// [`GeometryError`]: fewer than three cells along a side, or a side whose length is not positive.
pub fn flat_torus(size: [f64; 2], cells: [u32; 2]) -> Result<Surface, GeometryError> {
    let [n, m] = cells;
    let count = u64::from(n) * u64::from(m);
    if count > u64::from(u32::MAX / 6) {
        return Err(SurfaceError::TooManyFaces { faces: 2 * count as usize }.into());
    }
    let vertex = |i: u32, j: u32| (j % m) * n + i % n;
    let mut faces = Vec::with_capacity(2 * count as usize);
    for j in 0..m {
        for i in 0..n {
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            faces.extend([[a, b, c], [c, d, a]]);
        }
    }
    let mesh = SurfaceMesh::from_faces(count as usize, &faces)?;
    let [width, height] = [size[0] / f64::from(n), size[1] / f64::from(m)];
    let sides = [width, height, width.hypot(height)];
    let lengths = EdgeData::from_fn(mesh.edges(), |edge| sides[mesh.edge_halfedge(edge).corner()]);
    Surface::from_edge_lengths(mesh, &lengths)
}
