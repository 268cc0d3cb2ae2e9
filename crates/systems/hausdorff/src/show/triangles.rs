//! What is drawn of a surface: triangles on positions that neighbours share.

use pompeiu_core::{MeshError, TriMesh};

/// Triangles with a distance at each corner, between which it is drawn linear.
#[derive(Default)]
pub(super) struct Triangles {
    /// Rounded, in the unit of the mesh.
    pub(super) positions: Vec<[f64; 3]>,
    /// The three positions of each triangle.
    pub(super) corners: Vec<[u32; 3]>,
    /// The face, or the group of faces, that each triangle is or is a part of.
    pub(super) faces: Vec<u32>,
    pub(super) distances: Vec<[f64; 3]>,
}

impl Triangles {
    /// Room for the faces of a mesh.
    pub(super) fn with_capacity(mesh: &TriMesh) -> Self {
        let (vertices, faces) = (mesh.positions().len(), mesh.faces().len());
        Self {
            positions: Vec::with_capacity(vertices),
            corners: Vec::with_capacity(faces),
            faces: Vec::with_capacity(faces),
            distances: Vec::with_capacity(faces),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.corners.len()
    }

    pub(super) fn push(&mut self, face: u32, corners: [u32; 3], distances: [f64; 3]) {
        self.faces.push(face);
        self.corners.push(corners);
        self.distances.push(distances);
    }

    /// Adds a position, and gives its number.
    pub(super) fn add(&mut self, position: [f64; 3]) -> u32 {
        self.positions.push(position);
        self.positions.len() as u32 - 1
    }

    /// Corners and distances of each triangle.
    pub(super) fn iter(&self) -> impl Iterator<Item = ([[f64; 3]; 3], [f64; 3])> {
        let corners = self.corners.iter().map(|at| at.map(|v| self.positions[v as usize]));
        corners.zip(self.distances.iter().copied())
    }

    /// The triangles as a mesh of its own.
    pub(super) fn mesh(&self) -> Result<TriMesh, MeshError> {
        TriMesh::new(self.positions.clone(), self.corners.clone())
    }
}

/// The vertices of a mesh among the positions that are drawn, each added where it is first used.
pub(super) struct Vertices<'m> {
    mesh: &'m TriMesh,
    places: Vec<u32>,
}

impl<'m> Vertices<'m> {
    pub(super) fn of(mesh: &'m TriMesh) -> Self {
        Self { mesh, places: vec![u32::MAX; mesh.positions().len()] }
    }

    /// The number of a vertex among the positions, rounded as given where it is new.
    pub(super) fn place(
        &mut self,
        vertex: u32,
        triangles: &mut Triangles,
        round: impl Fn([f64; 3]) -> [f64; 3],
    ) -> u32 {
        let place = &mut self.places[vertex as usize];
        if *place == u32::MAX {
            *place = triangles.add(round(self.mesh.positions()[vertex as usize]));
        }
        *place
    }
}
