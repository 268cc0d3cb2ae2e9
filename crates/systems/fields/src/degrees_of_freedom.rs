//! Dimensions of the spaces.

use pompeiu_operators::hodge::DirichletPotential;
use pompeiu_operators::{Boundary, Splitting};
use pompeiu_surface::SurfaceMesh;

/// The dimensions of the spaces: with a different function space for each potential, and with a single one for both.
///
/// Fields have two degrees of freedom on each face. Gradients of continuous functions, rotated gradients of functions continuous at
/// midpoints, and harmonic fields together span them exactly. With continuous functions for both potentials the span is too small:
/// the residual has nothing to do with the topology, and its dimension grows with the number of faces. With functions continuous at
/// midpoints for both there are more unknowns than degrees of freedom, the two ranges are not orthogonal, and the parts of a field
/// are not unique.
///
/// Computed from the numbers of elements; the tests compare with numerical ranks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(into = "crate::data::Dimensions"))]
pub struct DegreesOfFreedom {
    /// Two for each face.
    pub total: usize,
    /// Dimension of the harmonic fields: 2g for each closed component, 2g + b − 1 for one with b boundary loops.
    pub harmonic: usize,
    /// `G_v a + J G_e b`: the mixed spaces, which span the orthogonal complement of the harmonic fields.
    pub mixed: Ranks,
    /// `G_v a + J G_v c`.
    pub conforming: Ranks,
    /// `G_e c + J G_e b`.
    pub nonconforming: Ranks,
}

/// Ranks of a gradient and of a rotated gradient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Ranks {
    /// Dimension of the gradients.
    pub gradient: usize,
    /// Dimension of the rotated gradients.
    pub rotated: usize,
    /// Degrees of freedom minus both ranks: equal to the harmonic dimension for a correct splitting, negative if the ranges
    /// overlap.
    pub residual_dimension: isize,
}

impl DegreesOfFreedom {
    /// Counts the dimensions on a surface, for the primal splitting (the dual one has the same).
    pub fn of(mesh: &SurfaceMesh, boundary: Boundary) -> Self {
        let fixed = DirichletPotential::of(Splitting::Primal, boundary);
        let loops = mesh.boundary_loops_of_components();
        let closed = loops.iter().filter(|&&b| b == 0).count();
        let inner_vertices = mesh.vertex_ids().filter(|&v| !mesh.is_boundary_vertex(v)).count();
        let inner_edges = mesh.edge_ids().filter(|&e| !mesh.is_boundary_edge(e)).count();
        // Without a boundary condition, constants on every component are in the kernel; with one, only those on closed components.
        let vertices = [mesh.vertices() - mesh.components(), inner_vertices - closed];
        let edges = [mesh.edges() - mesh.components(), inner_edges - closed];
        let total = 2 * mesh.faces();
        let ranks = |gradient: usize, rotated: usize| Ranks {
            gradient,
            rotated,
            residual_dimension: total.cast_signed() - (gradient + rotated).cast_signed(),
        };
        let [mixed, conforming, nonconforming] = match fixed {
            DirichletPotential::CrouzeixRaviart => {
                [ranks(vertices[0], edges[1]), ranks(vertices[0], vertices[1]), ranks(edges[0], edges[1])]
            }
            DirichletPotential::Conforming => {
                [ranks(vertices[1], edges[0]), ranks(vertices[1], vertices[0]), ranks(edges[1], edges[0])]
            }
        };
        let holes: usize = loops.iter().map(|&b| b.saturating_sub(1)).sum();
        Self { total, harmonic: 2 * mesh.genus() + holes, mixed, conforming, nonconforming }
    }

    /// Whether the dimensions of the mixed splitting add up, as they must on every surface.
    pub fn adds_up(&self) -> bool {
        self.mixed.residual_dimension == self.harmonic.cast_signed()
    }
}
