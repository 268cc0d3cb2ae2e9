//! Results for people to look at: pages to explore in a browser, pictures for papers and logs.
//!
//! Nothing is computed here that is not already in a result, except what a search has left at coarser tolerances, which is
//! searched for again. [`DeviationPage`] shows a result of this crate; [`DeviationContent`] is the same page from plain data.

mod compose;
mod content;
mod draw;
mod group;
mod page;
mod paper;
mod signs;
mod snap;
mod spread;
mod stages;
mod triangles;

pub use content::{
    DeviationContent, DisplayTriangles, Exceedance, Histogram, MeasuredSurface, Region, SearchStage,
    SurfaceDeviation,
};
pub use page::{DeviationFigures, DeviationPage};
pub use stages::search_stages;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::deviation::Bands;
    use crate::target::tests::TREES;
    use crate::{DeviationOptions, PreparedPair};
    use pompeiu_core::mesh::shapes::{icosphere, torus};
    use pompeiu_core::run::Limits;
    use pompeiu_figures::View;
    use pompeiu_figures::paper::Paper;

    /// A deviation with tolerance bands, a page and a document builds one tree over each mesh.
    #[test]
    fn two_trees_serve_all_that_is_made_of_a_pair() {
        let limits = Limits::default();
        let pair = PreparedPair::new(icosphere(1.0, 3).unwrap(), torus(0.75, 0.25, 32, 16).unwrap());
        let before = TREES.get();
        let options = DeviationOptions { signed: true, ..DeviationOptions::default() };
        let deviation = options.symmetric_of(&pair).unwrap();
        let bands = Bands::new(&[[-0.1, 0.1]]).unwrap();
        let bands = deviation.bands_of(&pair, &bands, 0.01, &limits, None);
        let found = DeviationPage {
            pair: &pair,
            paths: ["a", "b"],
            names: ["A", "B"],
            deviation: &deviation,
            stages: &search_stages(&pair, &limits),
            unit: "mm",
            up: [0.0, 0.0, 1.0],
            threshold: None,
            bands: Some(&bands),
            verdict: None,
            proof: None,
            command: None,
        };
        let figures = found.figures(&limits);
        assert!(figures.html().is_ok());
        assert!(figures.document(None, &[], View::default(), Paper::A4).is_ok());
        assert_eq!(TREES.get() - before, 2);
        // A pair that is used for one question keeps none.
        let (a, b) = (pair.a().clone(), pair.b().clone());
        let once = PreparedPair::for_one_question(&a, &b);
        assert_eq!(once.bytes(), 0);
        assert_eq!(options.symmetric_of(&once).unwrap().distance, deviation.distance);
        assert_eq!((once.bytes(), TREES.get() - before), (0, 4));
    }
}
