//! Flow to least area, remeshing and simplification.

use crate::arrays::{array_of_rows, colors as rgb, faces, vectors};
use crate::ask::{Answered, Asked, Asking, Beside, Failure, Limited, Outcome, answer, failure, shifted};
use crate::errors::Raise;
use crate::mesh::Mesh;
use crate::wait::{self, Share, Told};
use numpy::PyArray2;
use pompeiu::core::TriMesh;
use pompeiu::core::spatial::self_intersections;
use pompeiu::flow::{FlowRequest, FlowStep};
use pompeiu::io::AttributeError;
use pompeiu::remesh::{Carrier, CornerValues, Kept, Simplified, SimplifyAnswer, SimplifyRequest};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::ops::ControlFlow;

/// What is told of a step: its number, the area, the gradient along normals.
pub(crate) struct Step(usize, f64, f64);

impl Told for Step {
    fn arguments<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (self.0, self.1, self.2).into_pyobject(py)
    }
}

impl Asked for FlowRequest {
    type Told = Step;

    fn ask(&self, asking: &Asking<'_, Step>) -> Outcome<Self> {
        let watch = asking.watch;
        let observer = |step: &FlowStep<'_>| {
            watch.tell(Step(step.step, step.record.area, step.record.gradient.normal));
            if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let flow = self.run(asking.mesh()?, &asking.context, Some(&observer)).map_err(failure)?;
        let mesh = shifted(flow.mesh.clone(), &flow.rounding)?;
        Ok((flow, vec![("mesh", mesh)]))
    }
}

/// Texture coordinates and which of them each corner of each face has.
type Texture<'py> = (Bound<'py, PyAny>, Bound<'py, PyAny>);

/// What is carried over from a mesh to those that are made of it.
struct Carried {
    texture: Option<Carrier<2>>,
    colors: Option<Carrier<3>>,
}

impl Carried {
    fn new(
        mesh: &TriMesh,
        texture: Option<Texture<'_>>,
        colors: Option<&Bound<'_, PyAny>>,
    ) -> PyResult<Self> {
        let texture = texture.map(|(coordinates, corners)| {
            let values: Vec<[f64; 2]> = vectors(&coordinates, "texture coordinates", "(k, 2)")?;
            let corners = faces(&corners, values.len())?;
            Carrier::new(mesh, CornerValues { values, corners }, &[]).map_err(Raise::raise)
        });
        let colors = colors.map(|given| {
            let values: Vec<_> =
                rgb(given, "colors")?.into_iter().map(|color| color.map(f64::from)).collect();
            let (found, expected) = (values.len(), mesh.positions().len());
            if found != expected {
                let (name, elements) = ("colors".into(), "vertices");
                return Err(AttributeError::Length { name, elements, expected, found }.raise());
            }
            let corners = mesh.faces().to_vec();
            Carrier::new(mesh, CornerValues { values, corners }, &[]).map_err(Raise::raise)
        });
        Ok(Self { texture: texture.transpose()?, colors: colors.transpose()? })
    }

    /// A result with what is carried over to it.
    fn to(&self, found: Simplified) -> Result<Vec<(&'static str, Beside)>, Failure> {
        let mut beside = Vec::new();
        if let Some(texture) = &self.texture {
            let carried = texture.carry(&found.mesh, &found.kept).map_err(failure)?;
            beside.push(("texture", Beside::Plane(carried.values)));
            beside.push(("corners", Beside::Triples(carried.corners)));
        }
        if let Some(colors) = &self.colors {
            let carried = colors.at_vertices(&found.mesh).map_err(failure)?.into_iter();
            let rounded = carried.map(|color| color.map(|x| x.round() as u8)).collect();
            beside.push(("colors", Beside::Colors(rounded)));
        }
        beside.push(("mesh", shifted(found.mesh, &found.rounding)?));
        Ok(beside)
    }
}

/// Reduces the number of faces; texture coordinates and colours are carried over.
#[pyfunction]
pub(crate) fn simplify<'py>(
    py: Python<'py>,
    mesh: Bound<'py, Mesh>,
    options: &str,
    limits: Limited,
    texture: Option<Texture<'py>>,
    colors: Option<&Bound<'py, PyAny>>,
    progress: Option<&Bound<'py, PyAny>>,
) -> PyResult<Answered<'py>> {
    let carried = Carried::new(mesh.get().inner(), texture, colors)?;
    let ask = move |request: &SimplifyRequest, asking: &Asking<'_, Share>| {
        let seams = carried.texture.as_ref().map(Carrier::seams).unwrap_or_default();
        let found = request.run(asking.mesh()?, &seams, &asking.watched()).map_err(failure)?;
        let SimplifyAnswer { levels, mut report } = found;
        report.kept = Kept {
            texture: carried.texture.is_some(),
            seam_edges: seams.len(),
            materials: 0,
            colors: carried.colors.is_some(),
        };
        let mut levels = levels.into_iter().map(|level| carried.to(level));
        let mut beside = levels.next().transpose()?.unwrap_or_default();
        beside.push(("finer", Beside::Each(levels.collect::<Result<_, _>>()?)));
        Ok((report, beside))
    };
    answer(py, &[mesh.into_any()], options, limits, progress, ask)
}

/// Pairs of faces, a point of each, a count, and whether these are all.
type Pairs<'py> = (Bound<'py, PyArray2<u32>>, Bound<'py, PyArray2<f64>>, usize, bool);

/// Pairs of faces that intersect, a point of each, how many further pairs only touch, and whether these are all.
#[pyfunction]
pub(crate) fn intersections<'py>(
    py: Python<'py>,
    mesh: &Bound<'py, Mesh>,
    most_pairs: usize,
) -> PyResult<Pairs<'py>> {
    let mesh = mesh.clone().unbind();
    let found = wait::abandonable(py, move || self_intersections(mesh.get().inner(), most_pairs))?;
    let faces: Vec<[u32; 2]> = found.pairs.iter().map(|pair| pair.faces.map(|f| f.0)).collect();
    let places: Vec<[f64; 3]> = found.pairs.iter().map(|pair| pair.place).collect();
    Ok((array_of_rows(py, faces)?, array_of_rows(py, places)?, found.touching, found.complete))
}
