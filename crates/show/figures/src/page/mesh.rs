//! Meshes of a page, and the vertices that their triangles share.

use super::encode::{first_use_indices, integers, singles};
use super::error::{check_faces, check_finite, check_length};
use super::mesh_values::MeshValues;
use super::space::Placement;
use super::{MeshId, PageError, SpaceId};
use pompeiu_core::TriMesh;
use rustc_hash::{FxBuildHasher, FxHashMap};
use serde_json::{Value, json};

/// Triangles to draw: the faces of a mesh, or parts of faces where values are not linear on a face.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    name: String,
    element: String,
    positions: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// The face of each triangle; `None` if triangles are faces.
    faces: Option<Vec<u32>>,
    face_count: usize,
}

/// A region of the plane inside a closed curve and outside others; curves are closed implicitly.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Polygon {
    /// The outer curve.
    pub outer: Vec<[f64; 2]>,
    /// The holes.
    pub holes: Vec<Vec<[f64; 2]>>,
}

impl Mesh {
    /// Triangles on shared vertices.
    pub fn new(name: impl Into<String>, positions: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        let face_count = triangles.len();
        Self { name: name.into(), element: "face".into(), positions, triangles, faces: None, face_count }
    }

    /// All faces of a mesh. The name is used to refer to faces: "face 3 of A".
    pub fn of(name: impl Into<String>, mesh: &TriMesh) -> Self {
        Self::new(name, mesh.positions().to_vec(), mesh.faces().to_vec())
    }

    /// Triangles by their corners. Corners at equal positions become one vertex on the page.
    pub fn from_corners(name: impl Into<String>, corners: &[[[f64; 3]; 3]]) -> Self {
        let triangles = (0..corners.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Self::new(name, corners.as_flattened().to_vec(), triangles)
    }

    /// Sets the face that each triangle is part of, and the number of faces.
    #[must_use]
    pub fn with_faces(mut self, faces: Vec<u32>, face_count: usize) -> Self {
        let are_triangles = face_count == self.triangles.len()
            && faces.iter().enumerate().all(|(i, &face)| i == face as usize);
        self.faces = (!are_triangles).then_some(faces);
        self.face_count = face_count;
        self
    }

    /// Sets another name for faces, such as "piece".
    #[must_use]
    pub fn with_element(mut self, element: impl Into<String>) -> Self {
        self.element = element.into();
        self
    }

    fn check(&self, index: usize) -> Result<(), PageError> {
        if self.triangles.is_empty() {
            return Err(PageError::NoTriangles { mesh: index });
        }
        check_finite("the positions of a mesh", self.positions.as_flattened())?;
        let corners = self.triangles.as_flattened();
        if let Some(at) = corners.iter().position(|&v| v as usize >= self.positions.len()) {
            let count = self.positions.len();
            return Err(PageError::Unknown { what: "vertex", index: corners[at] as usize, count });
        }
        if let Some(faces) = &self.faces {
            check_length("the list of faces of triangles", faces.len(), self.triangles.len())?;
            check_faces("the list of faces of triangles", faces, self.face_count)?;
        }
        Ok(())
    }
}

/// The geometry of a mesh of a page.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Geometry {
    Triangles(Mesh),
    /// The triangles of another mesh, with other vertex positions.
    Moved {
        of: MeshId,
        positions: Vec<[f64; 3]>,
    },
    Polygons {
        name: String,
        element: String,
        polygons: Vec<Polygon>,
    },
}

/// A mesh, in its space.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PlacedMesh {
    pub(super) space: SpaceId,
    pub(super) geometry: Geometry,
    /// Meshes whose triangles correspond one to one, moved ones included, share this number.
    pub(super) link: usize,
}

impl PlacedMesh {
    /// Checks the mesh that is about to get this index.
    pub(super) fn check(&self, index: usize, meshes: &[Self]) -> Result<(), PageError> {
        match &self.geometry {
            Geometry::Triangles(mesh) => mesh.check(index),
            Geometry::Moved { of, positions } => {
                check_finite("the positions of a moved mesh", positions.as_flattened())?;
                let expected = of.of(meshes)?.vertex_count();
                check_length("the list of positions of a moved mesh", positions.len(), expected)
            }
            Geometry::Polygons { polygons, .. } => {
                if polygons.is_empty() {
                    return Err(PageError::NoTriangles { mesh: index });
                }
                for polygon in polygons {
                    for ring in std::iter::once(&polygon.outer).chain(&polygon.holes) {
                        check_finite("the points of a polygon", ring.as_flattened())?;
                        if ring.len() < 3 {
                            return Err(PageError::Length {
                                what: "a closed curve of a polygon, of at least three points,",
                                found: ring.len(),
                                expected: 3,
                            });
                        }
                    }
                }
                Ok(())
            }
        }
    }

    pub(super) fn face_count(&self, meshes: &[Self]) -> usize {
        match &self.geometry {
            Geometry::Triangles(mesh) => mesh.face_count,
            Geometry::Moved { of, .. } => meshes[of.0].face_count(meshes),
            Geometry::Polygons { polygons, .. } => polygons.len(),
        }
    }

    /// The number of triangles, if it is known before triangulation.
    pub(super) fn triangle_count(&self, meshes: &[Self]) -> usize {
        match &self.geometry {
            Geometry::Triangles(mesh) => mesh.triangles.len(),
            Geometry::Moved { of, .. } => meshes[of.0].triangle_count(meshes),
            Geometry::Polygons { .. } => 0,
        }
    }

    pub(super) fn vertex_count(&self) -> usize {
        match &self.geometry {
            Geometry::Triangles(mesh) => mesh.positions.len(),
            Geometry::Moved { positions, .. } => positions.len(),
            Geometry::Polygons { .. } => 0,
        }
    }

    pub(super) fn points(&self) -> Vec<[f64; 3]> {
        match &self.geometry {
            Geometry::Triangles(mesh) => {
                let mut is_used = vec![false; mesh.positions.len()];
                mesh.triangles.as_flattened().iter().for_each(|&v| is_used[v as usize] = true);
                let used = mesh.positions.iter().zip(is_used).filter(|(_, is_used)| *is_used);
                used.map(|(position, _)| *position).collect()
            }
            Geometry::Moved { positions, .. } => positions.clone(),
            Geometry::Polygons { polygons, .. } => {
                polygons.iter().flat_map(|polygon| &polygon.outer).map(|&[x, y]| [x, y, 0.0]).collect()
            }
        }
    }
}

/// Vertices of the page shared by corners of triangles.
#[derive(Debug)]
pub(super) struct SharedCorners {
    /// The mesh vertex of each position, in the order of first use.
    pub(super) vertices: Vec<u32>,
    /// The position of each page vertex; first uses are in increasing order.
    pub(super) places: Vec<u32>,
    /// For each page vertex, its first occurrence among the corners of triangles.
    pub(super) first: Vec<usize>,
    /// Three page vertices per triangle; first uses are in increasing order.
    pub(super) indices: Vec<u32>,
}

impl SharedCorners {
    /// Merges corners whose rounded positions and values agree bit for bit. Different mesh vertices are not merged if `apart`, that
    /// is if there are values per vertex.
    pub(super) fn new(mesh: &Mesh, placement: Placement, apart: bool, values: &[&MeshValues]) -> Self {
        let (vertices, place_of) = placed_corners(mesh, placement, apart);
        let mut indices = place_of.clone();
        for values in values {
            for component in 0..values.width() {
                indices = divided(&indices, |i| values.at(i, component).to_bits());
            }
        }
        let (mut places, mut first) = (vec![], vec![]);
        for (i, &index) in indices.iter().enumerate() {
            if index as usize == places.len() {
                places.push(place_of[i]);
                first.push(i);
            }
        }
        Self { vertices, places, first, indices }
    }
}

/// No number yet.
const NONE: u32 = u32::MAX;

/// The number of the rounded position of each corner, in the order of first use, and the first vertex at each. Every vertex has a number of
/// its own if `apart`.
fn placed_corners(mesh: &Mesh, placement: Placement, apart: bool) -> (Vec<u32>, Vec<u32>) {
    let (mut vertices, mut number_of) = (vec![], vec![NONE; mesh.positions.len()]);
    let mut known = FxHashMap::with_capacity_and_hasher(mesh.positions.len(), FxBuildHasher);
    let number = |&v: &u32| {
        let number = &mut number_of[v as usize];
        if *number == NONE {
            let next = vertices.len() as u32;
            *number = if apart {
                next
            } else {
                let place = placement.place(mesh.positions[v as usize]).map(f32::to_bits);
                *known.entry(place).or_insert(next)
            };
            if *number == next {
                vertices.push(v);
            }
        }
        *number
    };
    let numbers = mesh.triangles.as_flattened().iter().map(number).collect();
    (vertices, numbers)
}

/// Numbers pairs of an index and of what `key` gives for its place, in the order of their first occurrence. Indices are numbers in the order
/// of first use, and most have one key.
fn divided(indices: &[u32], key: impl Fn(usize) -> u64) -> Vec<u32> {
    let mut first: Vec<(u64, u32)> = vec![];
    let mut others = FxHashMap::default();
    let mut count = 0;
    let number = |(i, &index): (usize, &u32)| {
        let key = key(i);
        let number = match first.get(index as usize) {
            None => {
                first.push((key, count));
                count
            }
            Some((known, number)) if *known == key => *number,
            Some(_) => *others.entry((index, key)).or_insert(count),
        };
        count += u32::from(number == count);
        number
    };
    indices.iter().enumerate().map(number).collect()
}

impl PlacedMesh {
    /// The data of the mesh; `shared` are the vertices of this mesh, or of the one it is moved from.
    pub(super) fn data(&self, placement: Placement, shared: Option<&SharedCorners>) -> Value {
        let at_places = |positions: &[[f64; 3]]| {
            let vertices = shared.map_or(&[][..], |shared| &shared.vertices);
            let placed: Vec<_> = vertices.iter().map(|&v| placement.place(positions[v as usize])).collect();
            singles(placed.as_flattened().iter().copied())
        };
        match &self.geometry {
            Geometry::Triangles(mesh) => json!({
                "kind": "triangles", "name": mesh.name, "element": mesh.element, "space": self.space,
                "link": self.link, "faces": mesh.face_count,
                "positions": at_places(&mesh.positions),
                "places": shared.map(|shared| first_use_indices(&shared.places)),
                "indices": shared.map(|shared| first_use_indices(&shared.indices)),
                "triangleFaces": mesh.faces.as_ref().map(|faces| integers(faces.iter().copied())),
            }),
            Geometry::Moved { of, positions } => json!({
                "kind": "moved", "of": of, "space": self.space, "link": self.link,
                "positions": at_places(positions),
            }),
            Geometry::Polygons { name, element, polygons } => json!({
                "kind": "polygons", "name": name, "element": element, "space": self.space, "link": self.link,
                "faces": polygons.len(), "polygons": polygons,
            }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_are_shared_where_place_and_value_agree() {
        let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
        let corners = [[a, b, c], [b, d, c]];
        let placement = Placement::around(corners.as_flattened().iter().copied());
        let mesh = Mesh::from_corners("", &corners);
        assert_eq!(SharedCorners::new(&mesh, placement, false, &[]).indices, [0, 1, 2, 1, 3, 2]);
        let values = MeshValues::on_corners(vec![[0.0, 1.0, 2.0], [1.5, 3.0, 2.0]]);
        let jump = SharedCorners::new(&mesh, placement, false, &[&values]);
        assert_eq!(jump.indices, [0, 1, 2, 3, 4, 2]);
        assert_eq!(
            jump.first.iter().map(|&i| values.at(i, 0)).collect::<Vec<_>>(),
            [0.0, 1.0, 2.0, 1.5, 3.0]
        );
        assert_eq!((jump.vertices, jump.places), (vec![0, 1, 2, 4], vec![0, 1, 2, 1, 3]));
        let apart = SharedCorners::new(&mesh, placement, true, &[]);
        assert_eq!(apart.indices, [0, 1, 2, 3, 4, 5]);
    }
}
