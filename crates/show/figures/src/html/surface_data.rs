//! What is checked of a measured surface, and how it is written into a page.

use super::PageError;
use super::deviation::{
    Bounds, Deviation, DisplayTriangles, Exceedance, Histogram, PageSurface, Region, SearchStage, Statistic,
};
use super::encode::{doubles, first_use_indices, integers, singles};
use super::error::{check_bounds, check_faces, check_finite, check_increasing, check_length};
use super::scene::{Indexed, Placement};
use serde_json::{Value, json};

impl PageSurface {
    pub(super) fn check(&self) -> Result<(), PageError> {
        let DisplayTriangles { corners, faces } = &self.triangles;
        check_finite("a corner of a display triangle", corners.as_flattened().as_flattened())?;
        check_length("the list of faces of display triangles", faces.len(), corners.len())?;
        check_faces("the list of faces of display triangles", faces, self.faces)?;
        let Some(d) = &self.deviation else { return Ok(()) };
        check_length("the list of values", d.values.len(), corners.len())?;
        check_finite("the list of values", d.values.as_flattened())?;
        check_length("the list of bounds of faces", d.face_bounds.len(), self.faces)?;
        check_bounds("the list of bounds of faces", &d.face_bounds)?;
        check_bounds("the directed distance", [&d.distance])?;
        check_finite("the witness", d.witness.from.iter().chain(&d.witness.to))?;
        check_bounds("the list of statistics", d.statistics.iter().map(|statistic| &statistic.value))?;
        let Histogram { edges, fractions } = &d.histogram;
        check_increasing("the list of ends of the histogram", edges)?;
        check_length("the histogram", fractions.len(), edges.len().saturating_sub(1))?;
        check_bounds("the histogram", fractions)?;
        let Exceedance { distances, fractions } = &d.exceedance;
        check_increasing("the list of distances of the cumulative curve", distances)?;
        check_length("the cumulative curve", fractions.len(), distances.len())?;
        check_bounds("the cumulative curve", fractions)?;
        for region in &d.regions {
            check_finite("a region", [&region.extent, &region.area])?;
            check_finite("a region", region.center.iter().chain(&region.pair.from).chain(&region.pair.to))?;
            check_bounds("the peak of a region", [&region.peak])?;
            check_faces("a region", &region.faces, self.faces)?;
        }
        for stage in &d.stages {
            check_finite("the tolerance of a stage", [&stage.tolerance])?;
            check_bounds("the distance at a stage", [&stage.distance])?;
            check_finite("what a stage has left", stage.remaining.as_flattened().as_flattened())?;
        }
        Ok(())
    }

    pub(super) fn data(&self, label: &str, placement: Placement) -> Value {
        let DisplayTriangles { corners, faces } = &self.triangles;
        let values = self.deviation.as_ref().map(|deviation| deviation.values.as_slice());
        let indexed = Indexed::new(placement, corners, values);
        let whole = faces.iter().enumerate().all(|(triangle, &face)| triangle == face as usize);
        json!({
            "label": label,
            "name": self.name,
            "path": self.path,
            "faces": self.faces,
            "vertices": self.vertices,
            "positions": singles(indexed.positions.as_flattened().iter().copied()),
            "places": first_use_indices(&indexed.places),
            "indices": first_use_indices(&indexed.indices),
            "triangleFaces": (!whole).then(|| integers(faces.iter().copied())),
            "measured": self.deviation.as_ref().map(|deviation| deviation.data(&indexed.values, placement)),
        })
    }
}

impl Deviation {
    fn data(&self, values: &[f64], placement: Placement) -> Value {
        let lower = |bounds: &[Bounds]| bounds.iter().map(|b| b[0]).collect::<Vec<_>>();
        let upper = |bounds: &[Bounds]| bounds.iter().map(|b| b[1]).collect::<Vec<_>>();
        let statistic = |s: &Statistic| json!({ "label": s.label, "lower": s.value[0], "upper": s.value[1] });
        let region = |r: &Region| {
            json!({
                "center": r.center, "extent": r.extent, "area": r.area, "peak": r.peak,
                "point": r.pair.from, "nearest": r.pair.to, "faces": integers(r.faces.iter().copied()),
            })
        };
        let stage = |s: &SearchStage| {
            let indexed = Indexed::new(placement, &s.remaining, None);
            json!({
                "tolerance": s.tolerance, "lower": s.distance[0], "upper": s.distance[1], "count": s.remaining.len(),
                "positions": singles(indexed.positions.as_flattened().iter().copied()),
                "indices": first_use_indices(&indexed.indices),
            })
        };
        json!({
            "values": doubles(values.iter().copied()),
            "bounds": doubles(self.face_bounds.as_flattened().iter().copied()),
            "distance": self.distance,
            "stop": self.stop,
            "witness": { "from": self.witness.from, "to": self.witness.to },
            "statistics": self.statistics.iter().map(statistic).collect::<Vec<_>>(),
            "histogram": {
                "edges": self.histogram.edges,
                "lower": lower(&self.histogram.fractions), "upper": upper(&self.histogram.fractions),
            },
            "exceedance": {
                "at": self.exceedance.distances,
                "lower": lower(&self.exceedance.fractions), "upper": upper(&self.exceedance.fractions),
            },
            "regions": self.regions.iter().map(region).collect::<Vec<_>>(),
            "stages": self.stages.iter().map(stage).collect::<Vec<_>>(),
        })
    }
}
