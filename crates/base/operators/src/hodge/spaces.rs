//! Spaces of potentials.

use crate::OperatorError;
use crate::error::name_thin_faces;
use crate::laplacian::{cotan_laplacian, crouzeix_raviart_laplacian};
use pompeiu_solve::SemidefiniteCholesky;
use pompeiu_surface::{Relative, Surface, SurfaceMesh};

/// Which of the two potentials is conforming, and which is nonconforming (Crouzeix–Raviart).
///
/// `u = G_v a + J G_e b + h` in the primal splitting, `u = G_e b + J G_v a + h` in the dual one. The harmonic fields of one splitting
/// are those of the other, rotated by a quarter turn; they are different fields.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Splitting {
    /// Gradients of continuous functions, rotated gradients of functions that agree at midpoints of edges.
    #[default]
    Primal,
    /// Gradients of functions that agree at midpoints of edges, rotated gradients of continuous functions.
    Dual,
}

/// The boundary condition. It has no effect on closed components.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Boundary {
    /// Harmonic Neumann fields, tangential to the boundary: the potential of the rotated gradient is zero there, so that neither the
    /// rotated gradient nor the harmonic part has a normal component.
    #[default]
    Tangential,
    /// Harmonic Dirichlet fields, normal to the boundary: the potential of the gradient is zero there, so that neither the gradient
    /// nor the harmonic part has a tangential component.
    Normal,
}

/// Which of the two potentials of the primal splitting has a homogeneous Dirichlet condition at the boundary; the other
/// one has the natural, Neumann condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DirichletPotential {
    /// The nonconforming one (Crouzeix–Raviart).
    CrouzeixRaviart,
    /// The conforming one.
    Conforming,
}

impl DirichletPotential {
    /// The dual splitting is the primal splitting of the field rotated back by a quarter turn, which also exchanges tangential and
    /// normal at the boundary.
    pub fn of(splitting: Splitting, boundary: Boundary) -> Self {
        match (splitting, boundary) {
            (Splitting::Primal, Boundary::Tangential) | (Splitting::Dual, Boundary::Normal) => {
                Self::CrouzeixRaviart
            }
            (Splitting::Primal, Boundary::Normal) | (Splitting::Dual, Boundary::Tangential) => {
                Self::Conforming
            }
        }
    }

    pub(super) fn relative(self) -> Relative {
        match self {
            Self::CrouzeixRaviart => Relative::ToNothing,
            Self::Conforming => Relative::ToBoundary,
        }
    }
}

/// Which components have a boundary.
fn open_components(mesh: &SurfaceMesh) -> Vec<bool> {
    mesh.boundary_loops_of_components().into_iter().map(|loops| loops > 0).collect()
}

/// The component of each unknown where constants are in the kernel: everywhere except in a component whose boundary is fixed.
fn groups(mesh: &SurfaceMesh, fixed: bool, components: impl Iterator<Item = usize>) -> Vec<Option<u32>> {
    let open = open_components(mesh);
    components.map(|component| (!(fixed && open[component])).then_some(component as u32)).collect()
}

/// The cotangent Laplacian, factored; `fixed`: potentials are zero at boundary vertices.
///
/// # Errors
/// [`OperatorError::ThinFaces`] if it cannot be factored because of thin faces; [`OperatorError::Solve`].
pub fn conforming_system(surface: &Surface, fixed: bool) -> Result<SemidefiniteCholesky, OperatorError> {
    let mesh = surface.mesh();
    let at_boundary: Vec<bool> = mesh.vertex_ids().map(|v| fixed && mesh.is_boundary_vertex(v)).collect();
    let group = groups(mesh, fixed, mesh.vertex_ids().map(|v| mesh.component(v)));
    SemidefiniteCholesky::new(cotan_laplacian(surface)?, &at_boundary, &group)
        .map_err(|error| name_thin_faces(surface, error))
}

/// The Crouzeix–Raviart Laplacian, factored; `fixed`: potentials are zero at boundary edges.
///
/// # Errors
/// [`OperatorError::ThinFaces`] if it cannot be factored because of thin faces; [`OperatorError::Solve`].
pub fn crouzeix_raviart_system(
    surface: &Surface,
    fixed: bool,
) -> Result<SemidefiniteCholesky, OperatorError> {
    let mesh = surface.mesh();
    let at_boundary: Vec<bool> = mesh.edge_ids().map(|e| fixed && mesh.is_boundary_edge(e)).collect();
    let group = groups(mesh, fixed, mesh.edge_ids().map(|e| mesh.component(mesh.ends(e)[0])));
    SemidefiniteCholesky::new(crouzeix_raviart_laplacian(surface)?, &at_boundary, &group)
        .map_err(|error| name_thin_faces(surface, error))
}
