//! The page and the picture of a remeshed surface.

use crate::{Quality, Range, Remeshed, angles};
use glam::DVec3;
use pompeiu_core::{FaceId, TriMesh};
use pompeiu_figures::names::{axis, name};
use pompeiu_figures::page::{
    Block, Card, Cell, Chart, ChartAxis, Fact, Page, PageError, Row, Series, Space, Table, Text,
};
use pompeiu_figures::{Figure, FigureError, Image, Panel, Theme, View};
use pompeiu_hausdorff::certificate::AttachedProof;

/// A remeshed surface to be shown beside the mesh it was made from.
#[derive(Clone, Copy, Debug)]
pub struct RemeshPage<'r> {
    /// The file of the mesh, or whatever else it is called.
    pub path: &'r str,
    /// The mesh.
    pub input: &'r TriMesh,
    /// What was made of it.
    pub found: &'r Remeshed,
    /// A certificate that the result is within a distance of the input, if there is one.
    pub proof: Option<&'r AttachedProof>,
    /// Which way is up.
    pub up: [f64; 3],
    /// The command that makes the page again.
    pub command: Option<&'r str>,
}

/// Bins of the histograms, up to the angle of an equilateral triangle.
const BINS: usize = 30;
const GREATEST_LEAST_ANGLE: f64 = 60.0;

/// A range of a quality.
type RangeOf = fn(&Quality) -> Range;

impl RemeshPage<'_> {
    fn both(&self) -> [(&'static str, &TriMesh, &Quality); 2] {
        [("before", self.input, &self.found.before), ("after", &self.found.mesh, &self.found.after)]
    }

    /// The page as a file.
    ///
    /// # Errors
    /// [`PageError`] where numbers are not finite.
    pub fn html(&self) -> Result<String, PageError> {
        let mut page = Page::new(format!("{} remeshed", name(self.path)));
        page.picture = "remesh".into();
        page.command = self.command.map(str::to_owned);
        env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
        let space = page.add_space(Space::Spatial(axis(self.up)));
        page.add_before_and_after(space, self.both().map(|(_, mesh, _)| mesh))?;
        page.add_card(Card::new("Triangles", vec![Block::Table(self.table()), Block::Facts(self.facts())]))?;
        let charts = self.both().map(|(label, mesh, _)| Block::Chart(least_angles(label, mesh)));
        page.add_card(Card::new("Least angles", charts.to_vec()))?;
        if let Some(proof) = self.proof {
            let rows = proof.rows().into_iter().map(|[name, value]| Fact::new(&name, value));
            page.add_card(Card::new("Proof attached", vec![Block::Facts(rows.collect())]))?;
        }
        page.add_card(Card::new("Run", vec![Block::Run]))?;
        Ok(page.html())
    }

    fn table(&self) -> Table {
        let row = |label: &str, digits: u8, of: &dyn Fn(&Quality) -> f64| {
            let values = self.both().map(|(.., quality)| Cell::Number { value: of(quality), digits });
            let cells = std::iter::once(Cell::Text { text: label.into() }).chain(values).collect();
            Row { cells, place: None }
        };
        let mut rows = vec![
            row("vertices", 10, &|q| q.vertices as f64),
            row("edges", 10, &|q| q.edges as f64),
            row("faces", 10, &|q| q.faces as f64),
        ];
        let ranges: [(&str, RangeOf); 2] =
            [("edge length", |q| q.edge_length), ("least angle of a face, degrees", |q| q.least_angle)];
        for (label, range) in ranges {
            rows.push(row(&format!("{label}: least"), 4, &|q| range(q).least));
            rows.push(row(&format!("{label}: mean"), 4, &|q| range(q).mean));
            rows.push(row(&format!("{label}: greatest"), 4, &|q| range(q).greatest));
        }
        rows.push(row("greatest angle, degrees", 4, &|q| q.greatest_angle));
        rows.push(row("vertices of regular valence, %", 4, &|q| 100.0 * q.regular));
        rows.push(row("valence regular ± 1, %", 4, &|q| 100.0 * q.nearly_regular));
        Table {
            key: "quality".into(),
            caption: "Triangles before and after".into(),
            columns: ["", "before", "after"].map(str::to_owned).to_vec(),
            rows,
            sortable: false,
        }
    }

    fn facts(&self) -> Vec<Fact> {
        let mut facts = vec![
            Fact::new("stopped", self.found.stop.name()),
            Fact::new("iterations", self.found.iterations.to_string()),
        ];
        if let Some(share) = self.found.after.near_target {
            facts.push(Fact::new(
                "edges of 4/5 to 4/3 of their target",
                Text::default().number(100.0 * share, 4).text(" %"),
            ));
        }
        if let Some(report) = &self.found.distance {
            let text = Text::default().number(report.distance.lower(), 6).text(" to ");
            facts.push(Fact::new("distance from the input", text.number(report.distance.upper(), 6)));
        }
        if let Some(count) = self.found.intersections {
            facts.push(Fact::new("pairs of faces that intersect", count.pairs.to_string()));
        }
        facts
    }

    /// A picture of both surfaces, of the given size in pixels.
    ///
    /// # Errors
    /// [`FigureError`] for a size that is none.
    pub fn image(&self, width: u32, height: u32, theme: Theme, view: View) -> Result<Image, FigureError> {
        let mut figure = Figure::new(width, height).with_theme(theme).with_view(view);
        for (label, mesh, quality) in self.both() {
            figure =
                figure.with_panel(Panel::new(mesh).with_title(format!("{label}: {} faces", quality.faces)));
        }
        figure.draw()
    }
}

/// How many faces have which least angle.
fn least_angles(label: &str, mesh: &TriMesh) -> Chart {
    let mut counts = [0_usize; BINS];
    for f in 0..mesh.faces().len() as u32 {
        let least = angles(mesh.corners(FaceId(f)).map(DVec3::from_array)).into_iter().fold(180.0, f64::min);
        counts[((least / GREATEST_LEAST_ANGLE * BINS as f64) as usize).min(BINS - 1)] += 1;
    }
    let share = |count: &usize| [*count as f64 / mesh.faces().len() as f64; 2];
    Chart {
        key: format!("least-angles-{label}"),
        title: format!("Share of faces by least angle, {label}").into(),
        x: ChartAxis { label: "degrees".into(), ..ChartAxis::default() },
        y: ChartAxis { label: "share".into(), ..ChartAxis::default() },
        series: vec![Series::Histogram {
            edges: (0..=BINS).map(|i| i as f64 * GREATEST_LEAST_ANGLE / BINS as f64).collect(),
            shares: counts.iter().map(share).collect(),
        }],
        ..Chart::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{RemeshOptions, Sizing, remesh};
    use pompeiu_core::mesh::shapes::icosphere;
    use pompeiu_hausdorff::certificate::Certificate;

    #[test]
    fn the_page_shows_both_surfaces() {
        let input = icosphere(1.0, 2).expect("a sphere");
        let found = remesh(&input, &RemeshOptions::new(Sizing::Length(0.4))).expect("a remeshed sphere");
        let proof = AttachedProof {
            file: "ball.phc".into(),
            sha256: "f00d".into(),
            certificate: Certificate::default(),
        };
        let page = RemeshPage {
            path: "ball.ply",
            input: &input,
            found: &found,
            proof: Some(&proof),
            up: [0.0, 0.0, 1.0],
            command: None,
        };
        let html = page.html().expect("a page");
        for part in [
            "ball.ply remeshed",
            "least-angles-before",
            "least-angles-after",
            "distance from the input",
            "ball.phc, checked with",
            "f00d",
        ] {
            assert!(html.contains(part), "{part}");
        }
        let shares = |mesh: &TriMesh| match &least_angles("", mesh).series[0] {
            Series::Histogram { shares, .. } => shares.iter().map(|s| s[0]).collect::<Vec<f64>>(),
            _ => Vec::new(),
        };
        // An icosphere of level 2 has least angles between 54 and 60 degrees.
        let before = shares(&input);
        assert!((before.iter().sum::<f64>() - 1.0).abs() < 1e-12 && before[..26].iter().all(|x| *x == 0.0));
    }
}
