//! Pages: rejected input, and that the bundled script was built from the sources beside it.

use pompeiu_figures::page::{
    Amount, Arrangement, Axis, Block, Card, Cell, Chart, Layer, Lines, Mesh, MeshId, MeshValues, Page,
    PageError, Paint, Pair, Place, PlaceId, PlaceItem, PlaceList, Player, PlayerControls, PlayerId, Points,
    Polygon, Range, RangeEnd, Row, ScaleId, ScatterPoint, Scene, SceneId, Series, Shape, Space, SpaceId,
    Span, Statistic, Table, Text, ValueScale,
};
use sha2::{Digest, Sha256};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

const CORNERS: [[[f64; 3]; 3]; 2] = [
    [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
];

/// A page with a square of two triangles, and the ids of its parts.
struct Square {
    page: Page,
    space: SpaceId,
    mesh: MeshId,
    scale: ScaleId,
    scene: SceneId,
    player: PlayerId,
}

fn square() -> Square {
    let mut page = Page::new("A square");
    let space = page.add_space(Space::Plane);
    let mesh = page.add_mesh(space, Mesh::from_corners("it", &CORNERS)).unwrap();
    let scale = page.add_scale(ValueScale::default()).unwrap();
    let values = page.add_values(mesh, scale, MeshValues::on_faces(vec![1.0, 2.0])).unwrap();
    let player = page.add_player(Player { steps: 2, ..Player::default() }).unwrap();
    let mut scene = Scene::new("square", space);
    scene.layers.push(Layer::new(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None }));
    scene.places.push(Place { faces: vec![1], mesh: Some(mesh), ..Place::default() });
    let scene = page.add_scene(scene).unwrap();
    Square { page, space, mesh, scale, scene, player }
}

#[test]
fn what_is_not_on_the_page_is_refused() {
    // Ids of a fuller page are invalid on an empty one.
    let Square { mesh, scale, scene, player, space, .. } = square();
    let mut empty = Page::new("");
    let unknown = |result: Result<(), PageError>| match result {
        Err(PageError::Unknown { index: 0, count: 0, .. }) => {}
        other => panic!("{other:?}"),
    };
    unknown(empty.add_mesh(space, Mesh::from_corners("", &CORNERS)).map(|_| ()));
    unknown(empty.add_bounds(mesh, vec![]).map(|_| ()));
    unknown(empty.add_values(mesh, scale, MeshValues::on_faces(vec![])).map(|_| ()));
    unknown(empty.add_scene(Scene::new("", space)).map(|_| ()));
    unknown(empty.add_arrangement(Arrangement { scenes: vec![scene], ..Arrangement::default() }));
    unknown(empty.add_card(Card::new("", vec![]).with_scene(scene)));
    let controls = PlayerControls { player, steps: vec![], off: Text::default() };
    unknown(empty.add_card(Card::new("", vec![Block::Player(controls)])));
    let place = PlaceId { scene, place: 0 };
    let row = Row { cells: vec![Cell::Empty], place: Some(place) };
    let table = Table { columns: vec![String::new()], rows: vec![row], ..Table::default() };
    unknown(empty.add_card(Card::new("", vec![Block::Table(table)])));
    let error = square().page.add_card(Card::new(
        "",
        vec![Block::Places(PlaceList {
            items: vec![PlaceItem {
                place: PlaceId { scene, place: 1 },
                ends: [0.0; 2],
                note: Text::default(),
            }],
            ..PlaceList::default()
        })],
    ));
    assert_eq!(error.unwrap_err().to_string(), "the page has no place 1: there are 1");
}

#[test]
fn what_does_not_belong_together_is_refused() {
    let Square { mut page, space, mesh, scale, player, .. } = square();
    let length = |result: Result<(), PageError>| {
        assert!(matches!(result, Err(PageError::Length { .. })), "{result:?}");
    };
    length(page.add_values(mesh, scale, MeshValues::on_corners(vec![[0.0; 3]])).map(|_| ()));
    length(page.add_values(mesh, scale, MeshValues::on_vertices(vec![0.0; 4])).map(|_| ()));
    length(page.add_values(mesh, scale, MeshValues::vectors_on_faces(vec![[0.0; 3]; 3])).map(|_| ()));
    length(page.add_moved_mesh(space, mesh, vec![[0.0; 3]; 4]).map(|_| ()));
    length(page.add_player(Player::default()).map(|_| ()));
    let one = page.add_mesh(space, Mesh::from_corners("", &CORNERS[..1])).unwrap();
    length(page.link_meshes(mesh, one));
    let outer = vec![[0.0, 0.0], [1.0, 0.0]];
    length(page.add_polygons(space, "", "", vec![Polygon { outer, holes: vec![] }]).map(|_| ()));
    let frames = vec![Shape::Points(Points::default()); 3];
    let mut scene = Scene::new("", space);
    scene.layers.push(Layer::over_time(player, frames));
    length(page.add_scene(scene).map(|_| ()));
    let line = Series::Line { label: String::new(), x: vec![0.0, 1.0], y: vec![0.0] };
    length(
        page.add_card(Card::new("", vec![Block::Chart(Chart { series: vec![line], ..Chart::default() })])),
    );

    let elsewhere = page.add_space(Space::Spatial(Axis::Z));
    let mut scene = Scene::new("", elsewhere);
    scene.layers.push(Layer::new(Shape::Surface { mesh, paint: Paint::Plain, bounds: None }));
    assert_eq!(page.add_scene(scene), Err(PageError::Apart { what: "mesh", of: "space" }));
    let values = page.add_values(one, scale, MeshValues::on_faces(vec![0.0])).unwrap();
    let mut scene = Scene::new("", space);
    scene.layers.push(Layer::new(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None }));
    assert_eq!(page.add_scene(scene), Err(PageError::Apart { what: "array of values", of: "mesh" }));
}

#[test]
fn numbers_that_are_none_are_refused() {
    let Square { mut page, space, mesh, scale, scene, .. } = square();
    let none = |result: Result<(), PageError>| {
        assert!(matches!(result, Err(PageError::NonFinite { .. })), "{result:?}");
    };
    let nan = f64::NAN;
    none(page.add_mesh(space, Mesh::from_corners("", &[[[nan; 3]; 3]])).map(|_| ()));
    none(page.add_scale(ValueScale { span: Span::Between(0.0, nan), ..ValueScale::default() }).map(|_| ()));
    none(page.add_values(mesh, scale, MeshValues::on_faces(vec![0.0, nan])).map(|_| ()));
    none(page.add_bounds(mesh, vec![[0.0, nan]; 2]).map(|_| ()));
    let end = RangeEnd::Scenes(vec![(scene, f64::INFINITY)]);
    none(page.add_range(scale, Range { text: String::new(), end }));
    for shape in [
        Shape::Lines(Lines { paths: vec![vec![[nan; 3]]], ..Lines::default() }),
        Shape::Points(Points {
            positions: vec![[0.0; 3]],
            values: Some((scale, vec![nan])),
            ..Points::default()
        }),
        Shape::Pieces(vec![[[nan; 3]; 3]]),
        Shape::Pairs(vec![Pair { label: Text::default().number(nan, 3), ..Pair::default() }]),
    ] {
        let mut scene = Scene::new("", space);
        scene.layers.push(Layer::new(shape));
        none(page.add_scene(scene).map(|_| ()));
    }
    let scatter = vec![ScatterPoint { at: [0.0, nan], ..ScatterPoint::default() }];
    let scatter = Series::Scatter { label: String::new(), points: scatter };
    let cell = Table {
        columns: vec![String::new()],
        rows: vec![Row { cells: vec![Cell::Bar { value: nan }], place: None }],
        ..Table::default()
    };
    for block in [
        Block::Text(Text::default().enclosure([0.0, nan])),
        Block::Headline(Statistic {
            value: Amount::Number { number: nan, digits: 3 },
            ..Statistic::default()
        }),
        Block::Chart(Chart { series: vec![scatter], ..Chart::default() }),
        Block::Table(cell),
    ] {
        none(page.add_card(Card::new("", vec![block])));
    }
    let crossed = Statistic { value: Amount::Enclosure { ends: [1.0, 0.0] }, ..Statistic::default() };
    let crossed = page.add_card(Card::new("", vec![Block::Statistics(vec![crossed])]));
    assert!(matches!(crossed, Err(PageError::Crossed { lower: 1.0, upper: 0.0, .. })));
}

#[test]
fn a_page_without_scenes_is_one_of_cards() {
    let mut page = Page::new("Numbers");
    page.add_card(Card::new("One", vec![Block::Text("and nothing else".into())])).unwrap();
    assert!(page.html().contains("and nothing else"));
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

/// The checksum that `web/build` writes into the bundle: of the output of `sha256sum`.
fn sum_of_sources() -> String {
    let mut names = vec!["build".to_owned(), "package.json".into(), "package-lock.json".into()];
    let mut sources = vec![];
    let mut folders = vec!["src".to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(web().join(&folder)).unwrap() {
            let name = format!("{folder}/{}", entry.unwrap().file_name().into_string().unwrap());
            let list = if web().join(&name).is_dir() { &mut folders } else { &mut sources };
            list.push(name);
        }
    }
    sources.sort();
    names.append(&mut sources);
    let line = |name: &String| format!("{}  {name}\n", sum(&fs::read(web().join(name)).unwrap()));
    sum(names.iter().map(line).collect::<String>().as_bytes())
}

#[test]
fn the_bundle_is_made_from_the_sources_beside_it() {
    for (kind, licences) in [("js", true), ("css", false)] {
        let text = fs::read_to_string(web().join("dist").join(format!("page.{kind}"))).unwrap();
        let (head, bundle) = text.split_once("*/\n").expect("a head");
        assert!(
            head.contains(&format!("sources {},", sum_of_sources())),
            "page.{kind} is older than its sources: run crates/show/figures/web/build"
        );
        assert!(head.contains(&format!("bundle {}", sum(bundle.as_bytes()))), "page.{kind} was edited");
        for package in ["three", "three-mesh-bvh"] {
            let named =
                head.contains(&format!("\n{package} ")) && head.contains("Permission is hereby granted");
            assert_eq!(named, licences, "the licence of {package} in page.{kind}");
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
