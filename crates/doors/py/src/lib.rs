//! The native half of the Python package `pompeiu`.
//!
//! Conversions only: arrays and options in, plain data out. What people call, and the classes of results, are in Python beside
//! it (`python/pompeiu`); what is computed is in the library.

mod arrays;
mod ask;
mod certificate;
mod complexity;
mod contact;
mod couple;
mod errors;
mod fields;
mod files;
mod flatten;
mod flow;
mod fluid;
mod hausdorff;
mod json;
mod matching;
mod mesh;
mod neuron;
mod neuron_flow;
mod neuron_run;
mod page;
mod puzzle;
mod shapes;
mod square;
mod wait;

/// The module `pompeiu._native`.
#[pyo3::pymodule]
mod _native {
    #[pymodule_export]
    use crate::ask::ask;
    #[pymodule_export]
    use crate::certificate::{verify_certificate, write_certificate};
    #[pymodule_export]
    use crate::complexity::{k_medoids, noisy_circle, polyline, read_outlines};
    #[pymodule_export]
    use crate::contact::contact;
    #[pymodule_export]
    use crate::couple::couple;
    #[pymodule_export]
    use crate::fields::{HodgeDecomposition, degrees_of_freedom};
    #[pymodule_export]
    use crate::files::{is_mesh_file, read_mesh, read_mesh_or_points, read_options, write_mesh, write_whole};
    #[pymodule_export]
    use crate::flatten::straighten;
    #[pymodule_export]
    use crate::flow::{intersections, simplify};
    #[pymodule_export]
    use crate::fluid::Simulation;
    #[pymodule_export]
    use crate::hausdorff::{DeviationPage, Target};
    #[pymodule_export]
    use crate::matching::{Entries, Ranking, Template, matrix_entries};
    #[pymodule_export]
    use crate::mesh::Mesh;
    #[pymodule_export]
    use crate::neuron::{NeuronSkeleton, neuron_options, read_neuron_mesh, read_skeleton};
    #[pymodule_export]
    use crate::neuron_flow::{NeuronFlow, NeuronSplineSpace};
    #[pymodule_export]
    use crate::neuron_run::{NeuronHexahedra, NeuronRun};
    #[pymodule_export]
    use crate::page::RunPage;
    #[pymodule_export]
    use crate::puzzle::PuzzleDrawings;
    #[pymodule_export]
    use crate::shapes::{cube, cylinder, grid, icosphere, schwarz_lantern, torus};
    #[pymodule_export]
    use crate::square::SquareSimulation;
    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
