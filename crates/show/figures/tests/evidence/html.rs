//! Pages as files: what is in them, what is refused, and that the program in them was made from the sources beside it.

use pompeiu_figures::html::{
    Deviation, DeviationPage, DisplayTriangles, Exceedance, FieldsPage, Histogram, PageError, PageField,
    PageSurface, PointPair, Region, SearchStage, Statistic,
};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

const UPPER: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0]];
const LOWER: [[f64; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// One triangle above another, with something in every field.
fn page() -> DeviationPage {
    let surface = |name: &str, corners, deviation| PageSurface {
        name: name.into(),
        path: name.into(),
        vertices: 3,
        faces: 1,
        triangles: DisplayTriangles { corners: vec![corners], faces: vec![0] },
        deviation,
    };
    let pair = PointPair { from: UPPER[0], to: LOWER[0] };
    let deviation = Deviation {
        values: vec![[1.0; 3]],
        face_bounds: vec![[1.0, 1.0]],
        distance: [1.0, 1.0],
        stop: "done".into(),
        witness: pair,
        statistics: vec![Statistic { label: "mean".into(), value: [1.0, 1.0] }],
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
    DeviationPage {
        title: "Two triangles".into(),
        surfaces: [surface("a.obj", UPPER, Some(deviation)), surface("b.obj", LOWER, None)],
        ..DeviationPage::default()
    }
}

/// Something that is wrong with a page.
type Spoil = fn(&mut DeviationPage);

fn measured(page: &mut DeviationPage) -> &mut Deviation {
    page.surfaces[0].deviation.as_mut().unwrap()
}

#[test]
fn a_page_holds_all_it_needs() {
    let html = page().html().unwrap();
    assert!(html.contains("<title>Two triangles</title>") && html.ends_with("</html>\n"));
    for reference in [" src=", "href=\"http", "@import", "url(http"] {
        let outside = html.split("<script>").next().unwrap();
        assert!(!outside.contains(reference), "{reference}");
    }
    // Browsers count: each script element ends once.
    assert_eq!(html.matches("<script").count(), html.matches("</script>").count());
    assert_eq!(html, page().html().unwrap(), "the same bytes every time");
}

#[test]
fn names_cannot_end_the_element_they_stand_in() {
    let mut page = page();
    let plain = page.html().unwrap().matches("</script").count();
    let name = "</script></title><b>\"'&<!--";
    page.title = name.into();
    page.unit = name.into();
    page.surfaces[0].path = name.into();
    page.surfaces[1].name = name.into();
    let html = page.html().unwrap();
    assert_eq!(html.matches("</script").count(), plain);
    assert!(!html.contains("</title><b>") && !html.contains("<!--"));
    assert!(html.contains("<title>&lt;/script&gt;&lt;/title&gt;&lt;b&gt;&quot;&#39;&amp;&lt;!--</title>"));
}

#[test]
fn data_that_do_not_belong_together_are_refused() {
    let refused = |spoil: &dyn Fn(&mut DeviationPage)| {
        let mut page = page();
        spoil(&mut page);
        page.html().unwrap_err()
    };
    let not_finite: [Spoil; 12] = [
        |p| p.threshold = Some(f64::NAN),
        |p| p.distance = Some([0.0, f64::INFINITY]),
        |p| p.surfaces[1].triangles.corners[0][2][1] = f64::NAN,
        |p| measured(p).values[0][1] = f64::NEG_INFINITY,
        |p| measured(p).face_bounds[0][1] = f64::NAN,
        |p| measured(p).witness.to[0] = f64::NAN,
        |p| measured(p).statistics[0].value[0] = f64::NAN,
        |p| measured(p).histogram.edges[1] = f64::NAN,
        |p| measured(p).exceedance.fractions[0][0] = f64::NAN,
        |p| measured(p).regions[0].area = f64::INFINITY,
        |p| measured(p).regions[0].pair.to[2] = f64::NAN,
        |p| measured(p).stages[0].remaining[0][0][0] = f64::NAN,
    ];
    for (i, spoil) in not_finite.iter().enumerate() {
        assert!(matches!(refused(spoil), PageError::NonFinite { .. }), "{i}: {}", refused(spoil));
    }
    let lengths: [Spoil; 5] = [
        |p| p.surfaces[0].triangles.faces.push(0),
        |p| measured(p).values.push([0.0; 3]),
        |p| measured(p).face_bounds.clear(),
        |p| measured(p).histogram.edges.push(2.0),
        |p| measured(p).exceedance.distances.push(2.0),
    ];
    for (i, spoil) in lengths.iter().enumerate() {
        assert!(matches!(refused(spoil), PageError::Length { .. }), "{i}: {}", refused(spoil));
    }
    let crossed = refused(&|p| measured(p).distance = [1.0, 0.5]);
    assert!(matches!(crossed, PageError::Crossed { lower: 1.0, upper: 0.5, .. }));
    let falling = refused(&|p| measured(p).exceedance.distances = vec![1.0, 1.0]);
    assert!(matches!(falling, PageError::NotIncreasing { index: 1, .. }));
    let unknown = refused(&|p| measured(p).regions[0].faces = vec![0, 7]);
    assert_eq!(unknown.to_string(), "a region names face 7 at place 1, and there are 1 faces");
    assert_eq!(
        refused(&|p| p.surfaces[1].triangles = DisplayTriangles::default()),
        PageError::NoTriangles { surface: 1 }
    );
    assert_eq!(refused(&|p| p.surfaces[0].deviation = None), PageError::NothingMeasured);
}

#[test]
fn fields_that_do_not_belong_together_are_refused() {
    let page = FieldsPage {
        corners: vec![UPPER],
        fields: vec![PageField { label: "</script>".into(), vectors: vec![[1.0, 0.0, 0.0]], norm: 1.0 }],
        inner_products: vec![vec![1.0]],
        ..FieldsPage::default()
    };
    let html = page.html().unwrap();
    assert_eq!(html.matches("<script").count(), html.matches("</script>").count());
    let refused = |spoil: fn(&mut FieldsPage)| {
        let mut page = page.clone();
        spoil(&mut page);
        page.html().unwrap_err()
    };
    assert!(matches!(
        refused(|p| p.fields[0].vectors[0][1] = f64::NAN),
        PageError::NonFinite { index: 1, .. }
    ));
    assert!(matches!(refused(|p| p.fields[0].norm = f64::INFINITY), PageError::NonFinite { .. }));
    assert!(matches!(refused(|p| p.residual = f64::NAN), PageError::NonFinite { .. }));
    assert!(matches!(refused(|p| p.corners[0][0][0] = f64::NAN), PageError::NonFinite { .. }));
    assert!(matches!(
        refused(|p| p.fields[0].vectors.clear()),
        PageError::Length { found: 0, expected: 1, .. }
    ));
    assert!(matches!(refused(|p| p.inner_products[0].push(0.0)), PageError::Length { .. }));
    assert_eq!(refused(|p| p.corners.clear()), PageError::NoTriangles { surface: 0 });
    assert_eq!(refused(|p| p.fields.clear()), PageError::NothingMeasured);
}

fn web() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("web")
}

fn sum(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().fold(String::new(), |mut text, byte| {
        let _ = write!(text, "{byte:02x}");
        text
    })
}

/// The sum that `web/build` writes into what it makes: of the list that `sha256sum` prints.
fn sum_of_sources() -> String {
    let mut names = vec!["build".to_owned(), "package.json".into(), "package-lock.json".into()];
    let folder = fs::read_dir(web().join("src")).unwrap();
    let mut sources: Vec<_> =
        folder.map(|entry| format!("src/{}", entry.unwrap().file_name().into_string().unwrap())).collect();
    sources.sort();
    names.append(&mut sources);
    let line = |name: &String| format!("{}  {name}\n", sum(&fs::read(web().join(name)).unwrap()));
    sum(names.iter().map(line).collect::<String>().as_bytes())
}

#[test]
fn the_bundle_is_made_from_the_sources_beside_it() {
    for (kind, licences) in [("js", true), ("css", false)] {
        let text = fs::read_to_string(web().join("dist").join(format!("report.{kind}"))).unwrap();
        let (head, bundle) = text.split_once("*/\n").expect("a head");
        assert!(
            head.contains(&format!("sources {},", sum_of_sources())),
            "report.{kind} is older than its sources: run crates/show/figures/web/build"
        );
        assert!(head.contains(&format!("bundle {}", sum(bundle.as_bytes()))), "report.{kind} was edited");
        for package in ["three", "three-mesh-bvh"] {
            let named =
                head.contains(&format!("\n{package} ")) && head.contains("Permission is hereby granted");
            assert_eq!(named, licences, "the licence of {package} in report.{kind}");
        }
    }
}

#[test]
fn packages_are_pinned_and_no_registry_is_named() {
    let manifest: serde_json::Value =
        serde_json::from_str(&fs::read_to_string(web().join("package.json")).unwrap()).unwrap();
    for kind in ["dependencies", "devDependencies"] {
        for (name, version) in manifest[kind].as_object().unwrap() {
            assert!(version.as_str().unwrap().starts_with(|c: char| c.is_ascii_digit()), "{name} {version}");
        }
    }
    let lock = fs::read_to_string(web().join("package-lock.json")).unwrap();
    assert!(!lock.contains("\"resolved\"") && !lock.contains("http"), "hosts differ from place to place");
}
