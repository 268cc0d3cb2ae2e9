//! Deviations: what passes beside their JSON.

use super::DeviationPage;
use crate::ask::{Asked, Asking, Beside, Given, Outcome, failure};
use pompeiu::hausdorff::deviation::FaceDeviation;
use pompeiu::hausdorff::{
    DeviationMeasures, DirectedDeviation, Direction, Enclosure, PreparedPair, Progress,
};
use pompeiu::matching::request::AlignedDeviationRequest;

/// Arrays of faces and vertices by their names in Python, with those of one direction apart from those of the other.
macro_rules! named {
    ($($name:literal),*) => {
        [$([concat!("a_to_b.", $name), concat!("b_to_a.", $name)]),*]
    };
}

const NAMES: [[&str; 2]; 8] = named!(
    "face_max",
    "face_min",
    "face_mean",
    "vertex_distances",
    "vertex_error",
    "signed_vertex_distances",
    "vertex_winding",
    "face_winding"
);

fn arrays(found: &DirectedDeviation) -> Vec<(&'static str, Beside)> {
    let place = usize::from(found.direction == Direction::BToA);
    let of_faces = |end: fn(&FaceDeviation) -> &Enclosure| {
        let row = |face: &FaceDeviation| [end(face).lower(), end(face).upper()];
        Some(Beside::Intervals(found.faces.iter().map(row).collect()))
    };
    let winding = |of: fn(&pompeiu::hausdorff::deviation::Sides) -> &Vec<f64>| {
        found.sides.as_ref().map(|sides| Beside::Numbers(of(sides).clone()))
    };
    let all = [
        of_faces(|face| &face.max),
        of_faces(|face| &face.min),
        of_faces(|face| &face.mean),
        Some(Beside::Numbers(found.vertices.clone())),
        Some(Beside::Numbers(vec![found.vertex_error])),
        found.signed_vertices().map(Beside::Numbers),
        winding(|sides| &sides.vertex_winding),
        winding(|sides| &sides.face_winding),
    ];
    NAMES.into_iter().zip(all).filter_map(|(names, array)| Some((names[place], array?))).collect()
}

impl Asked for AlignedDeviationRequest {
    type Told = Progress;

    /// The report with the arrays of both directions and what figures are made from.
    fn ask(&self, asking: &Asking<'_, Progress>) -> Outcome<Self> {
        let [a, b] = asking.meshes()?;
        let groups = [0, 1].map(|i| match asking.given.get(i) {
            Some(Given::Mesh(mesh)) => mesh.get().groups(),
            _ => &[],
        });
        let prepared = PreparedPair::new(a.clone(), b.clone());
        let (prepared, report) =
            self.run(prepared, groups, &asking.context, Some(asking.watch)).map_err(failure)?;
        let deviation = &report.measured.deviation;
        let mut beside = arrays(&deviation.a_to_b);
        beside.extend(arrays(&deviation.b_to_a));
        let unit = self.deviation.measures.unit.clone();
        let page = DeviationPage::new(prepared, report.measured.clone(), unit);
        beside.push(("page", Beside::Page(Box::new(page))));
        Ok((report, beside))
    }
}

impl Asked for DeviationMeasures {
    type Told = Progress;

    fn ask(&self, asking: &Asking<'_, Progress>) -> Outcome<Self> {
        let [a, b] = asking.meshes()?;
        let report = self.run(a, b, &asking.context, Some(asking.watch)).map_err(failure)?;
        let beside = arrays(&report.deviation);
        Ok((report, beside))
    }
}
