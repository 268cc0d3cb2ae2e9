//! Cells that carry material.

use crate::{
    Cap, FlowCells, Frame, NeuronMesh, Parameters, Transport, TransportError, TransportOptions, transport,
    transport_in_flow,
};

/// Cells that carry material: trilinear ones, in which motors follow the potential flow, or those of a viscous flow.
#[derive(Clone, Debug)]
pub enum MaterialCells {
    /// Trilinear cells.
    Hexahedra(NeuronMesh),
    /// Subdivided tricubic cells of a flow.
    Flow(FlowCells),
}

impl MaterialCells {
    /// The flat ends.
    pub fn caps(&self) -> &[Cap] {
        match self {
            Self::Hexahedra(mesh) => &mesh.caps,
            Self::Flow(cells) => cells.caps(),
        }
    }

    /// Transport through them, with the field at so many steps, see [`transport`] and [`transport_in_flow`].
    ///
    /// # Errors
    /// [`TransportError`].
    pub fn transport(
        &self,
        parameters: &Parameters,
        frames: usize,
        options: &TransportOptions<'_>,
    ) -> Result<Transport, TransportError> {
        match self {
            Self::Hexahedra(mesh) => transport(mesh, parameters, frames, options),
            Self::Flow(cells) => transport_in_flow(cells, parameters, frames, options),
        }
    }

    /// Concentrations as a VTK XML unstructured grid; cells of a flow as Bézier hexahedra unless `linear`.
    ///
    /// # Errors
    /// [`std::io::ErrorKind::InvalidInput`] unless there are concentrations for each cell.
    pub fn vtu(&self, frame: &Frame, linear: bool) -> std::io::Result<Vec<u8>> {
        match self {
            Self::Hexahedra(mesh) => mesh.vtu_with(&frame.values),
            Self::Flow(cells) => cells.vtu(&frame.values, linear),
        }
    }

    /// Their surface, for pages.
    #[cfg(feature = "figures")]
    pub fn surface(&self) -> crate::NeuronSurface {
        match self {
            Self::Hexahedra(mesh) => crate::NeuronSurface::new(mesh),
            Self::Flow(cells) => crate::NeuronSurface::of_flow(cells),
        }
    }
}
