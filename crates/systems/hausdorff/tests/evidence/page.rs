//! Pages of deviation: what is in them, and what is refused.

use pompeiu_core::mesh::displace_at_random;
use pompeiu_core::mesh::shapes::icosphere;
use pompeiu_core::run::Limits;
use pompeiu_figures::page::{PageError, PointPair};
use pompeiu_hausdorff::show::{
    DeviationContent, DeviationPage, DisplayTriangles, Exceedance, Histogram, MeasuredSurface, Region,
    SearchStage, SurfaceDeviation, search_stages,
};
use pompeiu_hausdorff::{DeviationOptions, PreparedPair};

const UPPER: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
const LOWER: [[f64; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// One triangle above another, with something in every field.
fn page() -> DeviationContent {
    let surface = |name: &str, corners: [[f64; 3]; 3], deviation| MeasuredSurface {
        name: name.into(),
        path: name.into(),
        vertices: 3,
        faces: 1,
        triangles: DisplayTriangles {
            positions: corners.to_vec(),
            corners: vec![[0, 1, 2]],
            faces: vec![0],
            groups: None,
        },
        deviation,
    };
    let pair = PointPair { from: UPPER[0], to: LOWER[0] };
    let deviation = SurfaceDeviation {
        values: vec![[1.0; 3]],
        face_bounds: vec![[1.0, 1.0]],
        distance: [1.0, 1.0],
        stop: "done".into(),
        witness: pair,
        statistics: vec![("mean".into(), [1.0, 1.0])],
        bands: vec![[0.0, 0.0], [0.0, 0.0], [1.0, 1.0]],
        histogram: Histogram { edges: vec![0.0, 1.0], fractions: vec![[1.0, 1.0]] },
        exceedance: Exceedance { distances: vec![0.0, 1.0], fractions: vec![[1.0, 1.0], [0.0, 0.0]] },
        regions: vec![Region {
            extent: 1.0,
            area: 0.5,
            peak: [1.0, 1.0],
            pair,
            faces: vec![0],
            ..Region::default()
        }],
        stages: vec![SearchStage { tolerance: 0.1, distance: [1.0, 1.1], remaining: vec![UPPER] }],
    };
    DeviationContent {
        title: "Two triangles".into(),
        bands: vec![-0.5, 0.5],
        surfaces: [surface("a.obj", UPPER, Some(deviation)), surface("b.obj", LOWER, None)],
        ..DeviationContent::default()
    }
}

/// Something that is wrong with a page.
type Spoil = fn(&mut DeviationContent);

fn measured(page: &mut DeviationContent) -> &mut SurfaceDeviation {
    page.surfaces[0].deviation.as_mut().unwrap()
}

#[test]
fn a_page_holds_all_it_needs() {
    let html = page().page().unwrap().html();
    assert!(html.contains("<title>Two triangles</title>") && html.ends_with("</html>\n"));
    for reference in [" src=", "href=\"http", "@import", "url(http"] {
        let outside = html.split("<script>").next().unwrap();
        assert!(!outside.contains(reference), "{reference}");
    }
    // Browsers count: each script element ends once.
    assert_eq!(html.matches("<script").count(), html.matches("</script>").count());
    assert_eq!(html, page().page().unwrap().html(), "the same bytes every time");
}

#[test]
fn names_cannot_end_the_element_they_stand_in() {
    let mut page = page();
    let plain = page.page().unwrap().html().matches("</script").count();
    let name = "</script></title><b>\"'&<!--";
    page.title = name.into();
    page.unit = name.into();
    page.surfaces[0].path = name.into();
    page.surfaces[1].name = name.into();
    let html = page.page().unwrap().html();
    assert_eq!(html.matches("</script").count(), plain);
    assert!(!html.contains("</title><b>") && !html.contains("<!--"));
    assert!(html.contains("<title>&lt;/script&gt;&lt;/title&gt;&lt;b&gt;&quot;&#39;&amp;&lt;!--</title>"));
}

#[test]
fn data_that_do_not_belong_together_are_refused() {
    let refused = |spoil: &dyn Fn(&mut DeviationContent)| {
        let mut page = page();
        spoil(&mut page);
        page.page().unwrap_err()
    };
    let not_finite: [Spoil; 13] = [
        |p| p.bands[1] = f64::NAN,
        |p| p.threshold = Some(f64::NAN),
        |p| p.distance = Some([0.0, f64::INFINITY]),
        |p| p.surfaces[1].triangles.positions[2][1] = f64::NAN,
        |p| measured(p).values[0][1] = f64::NEG_INFINITY,
        |p| measured(p).face_bounds[0][1] = f64::NAN,
        |p| measured(p).witness.to[0] = f64::NAN,
        |p| measured(p).statistics[0].1[0] = f64::NAN,
        |p| measured(p).histogram.edges[1] = f64::NAN,
        |p| measured(p).exceedance.fractions[0][0] = f64::NAN,
        |p| measured(p).regions[0].area = f64::INFINITY,
        |p| measured(p).regions[0].pair.to[2] = f64::NAN,
        |p| measured(p).stages[0].remaining[0][0][0] = f64::NAN,
    ];
    for (i, spoil) in not_finite.iter().enumerate() {
        assert!(matches!(refused(spoil), PageError::NonFinite { .. }), "{i}: {}", refused(spoil));
    }
    let lengths: [Spoil; 6] = [
        |p| p.surfaces[0].triangles.faces.push(0),
        |p| measured(p).values.push([0.0; 3]),
        |p| measured(p).face_bounds.clear(),
        |p| measured(p).bands.push([0.0; 2]),
        |p| measured(p).histogram.edges.push(2.0),
        |p| measured(p).exceedance.distances.push(2.0),
    ];
    for (i, spoil) in lengths.iter().enumerate() {
        assert!(matches!(refused(spoil), PageError::Length { .. }), "{i}: {}", refused(spoil));
    }
    let crossed = refused(&|p| measured(p).distance = [1.0, 0.5]);
    assert!(matches!(crossed, PageError::Crossed { lower: 1.0, upper: 0.5, .. }));
    let bands = refused(&|p| p.bands = vec![-1.0, 0.5, 0.5]);
    assert!(matches!(bands, PageError::Crossed { index: 1, lower: 0.5, .. }));
    let falling = refused(&|p| measured(p).exceedance.distances = vec![1.0, 1.0]);
    assert!(matches!(falling, PageError::NotIncreasing { index: 1, .. }));
    let unknown = refused(&|p| measured(p).regions[0].faces = vec![0, 7]);
    assert_eq!(
        unknown.to_string(),
        "the list of faces of a place names face 7 at place 1, and there are 1 faces"
    );
    assert_eq!(
        refused(&|p| p.surfaces[1].triangles = DisplayTriangles::default()),
        PageError::NoTriangles { mesh: 1 }
    );
    assert_eq!(refused(&|p| p.surfaces[0].deviation = None), PageError::NothingToShow);
}

/// Rough surfaces with as many faces as are drawn one by one make the longest page.
#[test]
fn a_page_is_short_whatever_the_pair() {
    let rough = |seed| displace_at_random(&icosphere(1.0, 6).unwrap(), 0.004, seed).unwrap();
    let pair = PreparedPair::new(rough(1), rough(2));
    let options = DeviationOptions { accuracy: 0.5, regions: 20, ..DeviationOptions::default() };
    let limits = Limits::default();
    let found = DeviationPage {
        pair: &pair,
        paths: ["a.ply", "b.ply"],
        names: ["A", "B"],
        deviation: &options.symmetric_of(&pair).unwrap(),
        stages: &search_stages(&pair, &limits),
        unit: "mm",
        up: [0.0, 0.0, 1.0],
        threshold: None,
        bands: None,
        verdict: None,
        proof: None,
        command: None,
    };
    let bytes = found.figures(&limits).html().unwrap().len();
    assert!(bytes < 5 << 20, "{bytes}");
}
