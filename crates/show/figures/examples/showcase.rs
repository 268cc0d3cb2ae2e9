//! Writes a page with every part that a page can have, from closed forms:
//!
//! ```sh
//! cargo run --release -p pompeiu-figures --example showcase showcase.html
//! ```
//!
//! The page shows a pulsating torus with its area over time beside it; the same torus cut open and flattened, in the same colours,
//! so that the point under the cursor on one is marked on the other; a flow on it with arrows and moving streaks; pieces of a
//! planar shape with their outlines; a sortable table of them, a scatter plot, a histogram. Beside the page, `showcase.html.json`
//! holds its input data.

#![allow(clippy::print_stdout, reason = "this program is there to print")]

use pompeiu_figures::page::{
    Amount, Arrangement, Axis, Block, Card, Cell, Chart, ChartAxis, Color, Fact, Layer, Lines, Mesh,
    MeshValues, Page, Paint, Place, PlaceId, PlaceItem, PlaceList, Player, PlayerControls, Points, Polygon,
    Row, ScatterPoint, Scene, Series, Shape, Space, Span, Statistic, Table, Text, Threshold, ValueScale,
};
use pompeiu_figures::{ColorMap, Figure, Panel, Scale};
use serde_json::{Value, json};
use std::error::Error;
use std::f64::consts::{PI, TAU};

const AROUND: u32 = 64;
const ACROSS: u32 = 28;
const STEPS: usize = 24;

/// The torus at a time from 0 to 1, by its angles.
fn torus(u: f64, v: f64, time: f64) -> [f64; 3] {
    let thick = 0.35 + 0.1 * (TAU * time).sin() * (3.0 * u).cos();
    let ring = 1.0 + thick * v.cos();
    [ring * u.cos(), ring * u.sin(), thick * v.sin()]
}

/// The angles at a corner of the grid, which is the torus cut open.
fn angles(i: u32, j: u32) -> [f64; 2] {
    [TAU * f64::from(i) / f64::from(AROUND), TAU * f64::from(j) / f64::from(ACROSS)]
}

/// Triangles of the grid: up to the last corners, or closed by the first ones.
fn triangles(is_closed: bool) -> Vec<[u32; 3]> {
    let (columns, rows) = if is_closed { (AROUND, ACROSS) } else { (AROUND + 1, ACROSS + 1) };
    let at = |i: u32, j: u32| (j % rows) * columns + i % columns;
    let square =
        |i, j| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]];
    (0..ACROSS).flat_map(|j| (0..AROUND).flat_map(move |i| square(i, j))).collect()
}

fn vertices(is_closed: bool) -> impl Iterator<Item = [f64; 2]> {
    let more = u32::from(!is_closed);
    (0..ACROSS + more).flat_map(move |j| (0..AROUND + more).map(move |i| angles(i, j)))
}

fn area(positions: &[[f64; 3]], triangles: &[[u32; 3]]) -> f64 {
    let of = |&[a, b, c]: &[u32; 3]| {
        let [p, q, r] = [a, b, c].map(|v| positions[v as usize]);
        let [x, y] = [q, r].map(|other| [0, 1, 2].map(|k| other[k] - p[k]));
        let cross = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
        cross.iter().fold(0.0_f64, |sum, c| sum.hypot(*c)) / 2.0
    };
    triangles.iter().map(of).sum()
}

/// The shared parts of the page, and the data that the browser's answers are compared with.
struct Showcase {
    page: Page,
    truth: Value,
}

fn main() -> Result<(), Box<dyn Error>> {
    let out = std::env::args().nth(1).ok_or("expected the file to write")?;
    let mut page = Page::new("Every part of a page");
    page.subtitle = Text::from("a torus with ")
        .count(triangles(true).len(), "face")
        .text(" that breathes, and pieces of a square");
    page.command = Some("cargo run -p pompeiu-figures --example showcase".into());
    env!("CARGO_PKG_VERSION").clone_into(&mut page.version);
    let mut showcase = Showcase { page, truth: json!({}) };
    showcase.add_flow()?;
    showcase.add_pieces()?;
    let html = showcase.page.html();
    std::fs::write(&out, &html)?;
    std::fs::write(format!("{out}.json"), showcase.truth.to_string())?;
    println!("{} bytes", html.len());
    Ok(())
}

impl Showcase {
    /// A surface over time, its map to the plane, and a flow.
    fn add_flow(&mut self) -> Result<(), Box<dyn Error>> {
        let page = &mut self.page;
        let (solid, flat) = (page.add_space(Space::Spatial(Axis::Z)), page.add_space(Space::Plane));
        let time = |step: usize| step as f64 / (STEPS - 1) as f64;
        let player =
            Player { label: "Time".into(), steps: STEPS, interval: 120, repeats: true, ..Player::default() };
        let player = page.add_player(player)?;
        let curvature = ValueScale {
            title: "height".into(),
            unit: "mm".into(),
            colors: ColorMap::Batlow,
            span: Span::Between(-0.45, 0.45),
            ..ValueScale::default()
        };
        let height = page.add_scale(curvature)?;
        let speed = ValueScale { title: "speed".into(), unit: "mm/s".into(), ..ValueScale::default() };
        let speed = page.add_scale(speed)?;

        let at = |step: usize| vertices(true).map(move |[u, v]| torus(u, v, time(step))).collect::<Vec<_>>();
        let faces = triangles(true);
        let mesh = page.add_mesh(solid, Mesh::new("the torus", at(0), faces.clone()))?;
        let map_positions: Vec<[f64; 3]> =
            vertices(false).map(|[u, v]| [u / PI, v * 0.35 / PI, 0.0]).collect();
        let map = page.add_mesh(flat, Mesh::new("the map", map_positions, triangles(false)))?;
        page.link_meshes(mesh, map)?;

        let (mut surfaces, mut maps, mut areas, mut heights) = (vec![], vec![], vec![], vec![]);
        for step in 0..STEPS {
            let positions = at(step);
            areas.push(area(&positions, &faces));
            let of_step: Vec<f64> = positions.iter().map(|p| p[2]).collect();
            heights.push(of_step.clone());
            let moved = page.add_moved_mesh(solid, mesh, positions)?;
            let values = page.add_values(mesh, height, MeshValues::on_vertices(of_step))?;
            surfaces.push(Shape::Surface { mesh: moved, paint: Paint::Values(values), bounds: None });
            let on_map = vertices(false).map(|[u, v]| torus(u, v, time(step))[2]).collect();
            let values = page.add_values(map, height, MeshValues::on_vertices(on_map))?;
            maps.push(Shape::Surface { mesh: map, paint: Paint::Values(values), bounds: None });
        }
        let seams = page.add_toggle("Seams", true);
        let seam = |step: usize| {
            let path = |of: &dyn Fn(f64) -> [f64; 2]| {
                (0..96).map(|i| of(TAU * f64::from(i) / 96.0)).map(|[u, v]| torus(u, v, time(step))).collect()
            };
            let paths = vec![path(&|t| [t, 0.0]), path(&|t| [0.0, t])];
            Shape::Lines(Lines { paths, closed: true, width: 2.5, ..Lines::default() })
        };
        let mut surface = Scene::new("the surface", solid);
        surface.layers = vec![
            Layer::over_time(player, surfaces),
            Layer::over_time(player, (0..STEPS).map(seam).collect()).with_toggle(seams),
        ];
        let top = [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|part| torus(TAU * part, PI / 2.0, 0.0));
        surface.places = top
            .iter()
            .zip(1..)
            .map(|(center, i)| Place {
                center: *center,
                radius: 0.15,
                label: i.to_string(),
                ..Place::default()
            })
            .collect();
        let surface = page.add_scene(surface)?;
        let mut laid_flat = Scene::new("laid flat", flat);
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.7, 0.0], [0.0, 0.7, 0.0]];
        let border = Lines { paths: vec![corners.to_vec()], closed: true, width: 2.5, ..Lines::default() };
        laid_flat.layers =
            vec![Layer::over_time(player, maps), Layer::new(Shape::Lines(border)).with_toggle(seams)];
        let laid_flat = page.add_scene(laid_flat)?;

        let velocity = |[u, v]: [f64; 2]| {
            let [x, y] = [0.3 + 0.25 * v.cos(), 0.2 * (2.0 * u).sin()];
            let (ring, thick) = (1.0 + 0.35 * v.cos(), 0.35);
            [
                -x * ring * u.sin() - y * thick * v.sin() * u.cos(),
                x * ring * u.cos() - y * thick * v.sin() * u.sin(),
                y * thick * v.cos(),
            ]
        };
        let vectors = page.add_values(
            mesh,
            speed,
            MeshValues::vectors_on_vertices(vertices(true).map(velocity).collect()),
        )?;
        let arrows = page.add_toggle("Arrows", true);
        let mut streamlines =
            Lines { moving: true, width: 3.0, color: Color::Fixed([255, 255, 255]), ..Lines::default() };
        for start in 0..16 {
            let [mut u, mut v] = [TAU * f64::from(start) / 16.0, TAU * f64::from(start * 5 % 16) / 16.0];
            let step = |_| {
                u += 0.1 * (0.3 + 0.25 * v.cos());
                v += 0.1 * 0.2 * (2.0 * u).sin();
                torus(u, v, 0.0)
            };
            streamlines.paths.push((0..60).map(step).collect());
        }
        let mut flow = Scene::new("a flow", solid);
        flow.layers = vec![
            Layer::new(Shape::Surface { mesh, paint: Paint::Values(vectors), bounds: None }),
            Layer::new(Shape::Arrows { mesh, vectors }).with_toggle(arrows),
            Layer::new(Shape::Lines(streamlines)),
        ];
        let flow = page.add_scene(flow)?;
        for (key, text, scenes) in [
            ("linked", "Surface and map", vec![surface, laid_flat]),
            ("surface", "Surface", vec![surface]),
            ("flow", "Flow", vec![flow]),
        ] {
            page.add_arrangement(Arrangement {
                key: key.into(),
                text: text.into(),
                hint: String::new(),
                scenes,
            })?;
        }

        let told = |step: usize| {
            Text::from("time ").number(time(step), 3).text(" s, area ").number(areas[step], 5).text(" mm²")
        };
        let controls = PlayerControls { player, steps: (0..STEPS).map(told).collect(), off: Text::default() };
        page.set_player_below(controls)?;
        let times: Vec<f64> = (0..STEPS).map(time).collect();
        let axis = |label: &str| ChartAxis { label: label.into(), ..ChartAxis::default() };
        let curve = Chart {
            key: "area".into(),
            title: "The area of the torus over time".into(),
            x: axis("time in s"),
            y: axis("area in mm²"),
            series: vec![
                Series::Line { label: "area".into(), x: times.clone(), y: areas.clone() },
                Series::Band {
                    label: "within a hundredth".into(),
                    x: times.clone(),
                    y: areas.iter().map(|area| [area * 0.99, area * 1.01]).collect(),
                    falling: false,
                },
            ],
            player: Some(player),
            ..Chart::default()
        };
        let greatest = Statistic {
            key: "greatest".into(),
            name: "greatest area".into(),
            value: Amount::Enclosure {
                ends: areas.iter().fold([0.0; 2], |m, &a| if a > m[1] { [a, a * (1.0 + 1e-12)] } else { m }),
            },
            unit: "mm²".into(),
            note: Text::default(),
        };
        page.add_card(Card::new("Area", vec![Block::Headline(greatest), Block::Chart(curve)]))?;
        self.truth["areas"] = json!(areas);
        self.truth["heights"] = json!(heights);
        self.truth["faces"] = json!(faces);
        self.truth["places"] = json!(top);
        Ok(())
    }

    /// Pieces of a square: a scene in the plane, a table, a scatter plot and a histogram.
    fn add_pieces(&mut self) -> Result<(), Box<dyn Error>> {
        const SIDE: usize = 6;
        let page = &mut self.page;
        let plane = page.add_space(Space::Plane);
        // Corners of a grid, displaced; the border stays.
        let corner = |i: usize, j: usize| {
            let inside = |k: usize| if k == 0 || k == SIDE { 0.0 } else { 0.3 };
            let (x, y) = (i as f64, j as f64);
            [x + inside(i) * (2.3 * x + 5.1 * y).sin(), y + inside(j) * (4.7 * x - 1.9 * y).cos()]
        };
        let mut polygons: Vec<Polygon> = (0..SIDE * SIDE)
            .map(|n| [n % SIDE, n / SIDE])
            .map(|[i, j]| Polygon {
                outer: vec![corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)],
                holes: vec![],
            })
            .collect();
        let [x, y] = [3.5, 3.5];
        polygons[3 * SIDE + 3].holes.push(
            (0..12)
                .map(|k| TAU * f64::from(k) / 12.0)
                .map(|t| [x + 0.2 * t.cos(), y + 0.2 * t.sin()])
                .collect(),
        );
        let signed = |ring: &[[f64; 2]]| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(p, q)| p[0] * q[1] - p[1] * q[0]).sum::<f64>() / 2.0
        };
        let length = |ring: &[[f64; 2]]| {
            let next = ring.iter().cycle().skip(1);
            ring.iter().zip(next).map(|(p, q)| (p[0] - q[0]).hypot(p[1] - q[1])).sum::<f64>()
        };
        let areas: Vec<f64> = polygons
            .iter()
            .map(|p| signed(&p.outer) - p.holes.iter().map(|hole| signed(hole)).sum::<f64>())
            .collect();
        let lengths: Vec<f64> = polygons
            .iter()
            .map(|p| length(&p.outer) + p.holes.iter().map(|hole| length(hole)).sum::<f64>())
            .collect();
        let middles: Vec<[f64; 3]> = polygons
            .iter()
            .map(|p| {
                [
                    p.outer.iter().map(|q| q[0]).sum::<f64>() / 4.0,
                    p.outer.iter().map(|q| q[1]).sum::<f64>() / 4.0,
                    0.0,
                ]
            })
            .collect();
        let rings = polygons.iter().flat_map(|p| std::iter::once(&p.outer).chain(&p.holes));
        let outlines = rings.map(|ring| ring.iter().map(|&[x, y]| [x, y, 0.0]).collect()).collect();
        let mesh = page.add_polygons(plane, "the square", "piece", polygons)?;
        let scale = page.add_scale(ValueScale {
            title: "area".into(),
            unit: "mm²".into(),
            threshold: Some(1.0),
            ..ValueScale::default()
        })?;
        let values = page.add_values(mesh, scale, MeshValues::on_faces(areas.clone()))?;
        let mut scene = Scene::new("pieces", plane);
        let dots =
            Points { positions: middles.clone(), values: Some((scale, areas.clone())), ..Points::default() };
        scene.layers = vec![
            Layer::new(Shape::Surface { mesh, paint: Paint::Values(values), bounds: None }),
            Layer::new(Shape::Lines(Lines { paths: outlines, closed: true, width: 2.0, ..Lines::default() })),
            Layer::new(Shape::Points(dots)),
        ];
        scene.places = middles
            .iter()
            .zip(0..)
            .map(|(center, i)| Place {
                center: *center,
                radius: 0.7,
                faces: vec![i],
                mesh: Some(mesh),
                label: i.to_string(),
                pair: None,
            })
            .collect();
        let scene = page.add_scene(scene)?;
        page.add_arrangement(Arrangement {
            key: "pieces".into(),
            text: "Pieces".into(),
            hint: "in the plane".into(),
            scenes: vec![scene],
        })?;

        let thumbnail = thumbnail()?;
        let row = |i: usize| Row {
            cells: vec![
                Cell::text(format!("piece {i}")),
                Cell::Number { value: areas[i], digits: 4 },
                Cell::Enclosure { ends: [lengths[i].next_down(), lengths[i].next_up()] },
                Cell::Bar { value: areas[i] },
                if i == 0 { Cell::picture(&thumbnail, "a triangle") } else { Cell::Empty },
            ],
            place: Some(PlaceId { scene, place: i }),
        };
        let table = Table {
            key: "pieces".into(),
            caption: "Pieces of the square".into(),
            columns: ["piece", "area", "length of the border", "", ""].map(str::to_owned).to_vec(),
            rows: (0..areas.len()).map(row).collect(),
            sortable: true,
        };
        page.add_card(Card::new("Pieces", vec![Block::Table(table)]))?;
        let point = |i: usize| ScatterPoint {
            at: [areas[i], lengths[i]],
            label: format!("piece {i}"),
            place: Some(PlaceId { scene, place: i }),
        };
        let scatter = Chart {
            key: "scatter".into(),
            title: "Border of each piece by its area".into(),
            x: ChartAxis { label: "area in mm²".into(), logarithmic: true, ..ChartAxis::default() },
            y: ChartAxis { label: "length in mm".into(), ..ChartAxis::default() },
            series: vec![Series::Scatter {
                label: String::new(),
                points: (0..areas.len()).map(point).collect(),
            }],
            ..Chart::default()
        };
        let edges: Vec<f64> = (0..=10).map(|i| 0.2 * f64::from(i)).collect();
        let share = |bin: &[f64]| {
            areas.iter().filter(|a| bin[0] <= **a && **a < bin[1]).count() as f64 / areas.len() as f64
        };
        let histogram = Chart {
            key: "areas".into(),
            title: "How many pieces have which area".into(),
            x: ChartAxis { label: "area in mm²".into(), ..ChartAxis::default() },
            y: ChartAxis {
                label: "% of pieces".into(),
                percent: true,
                low: Some(0.0),
                ..ChartAxis::default()
            },
            series: vec![Series::Histogram {
                shares: edges.windows(2).map(|bin| [share(bin) * 0.9, share(bin)]).collect(),
                edges,
            }],
            scale: Some(scale),
            sets_threshold: true,
            player: None,
        };
        page.add_card(Card::new("Areas", vec![Block::Chart(scatter), Block::Chart(histogram)]))?;
        page.add_card(Card::new(
            "Threshold",
            vec![Block::Threshold(Threshold {
                scale,
                end: 2.0,
                of: "the square".into(),
                beyond: "greater".into(),
                share: None,
                bounds: None,
            })],
        ))?;
        let item = |i: usize| PlaceItem {
            place: PlaceId { scene, place: i },
            ends: [areas[i], areas[i]],
            note: Text::from("border ").number(lengths[i], 3).text(" mm"),
        };
        let list = PlaceList {
            key: "first".into(),
            scale: Some(scale),
            items: (0..3).map(item).collect(),
            none: String::new(),
        };
        let total = Statistic {
            key: "total".into(),
            name: "all pieces".into(),
            value: Amount::Number { number: areas.iter().sum(), digits: 6 },
            unit: "mm²".into(),
            note: Text::default(),
        };
        page.add_card(
            Card::new(
                "Some pieces",
                vec![
                    Block::Places(list),
                    Block::Statistics(vec![total]),
                    Block::Note("All numbers are from closed forms.".into()),
                ],
            )
            .with_scene(scene),
        )?;
        page.add_card(Card::new(
            "Run",
            vec![Block::Facts(vec![Fact::new("origin", "made for this page")]), Block::Run],
        ))?;
        self.truth["pieces"] = json!({ "areas": areas, "lengths": lengths, "middles": middles });
        Ok(())
    }
}

/// A small picture for the table.
fn thumbnail() -> Result<pompeiu_figures::Image, Box<dyn Error>> {
    let mesh =
        pompeiu_core::TriMesh::new(vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], vec![[0, 1, 2]])?;
    let scale = Scale::new(ColorMap::Viridis, 0.0, 1.0)?;
    Ok(Figure::new(160, 120).with_scale(scale, "").with_panel(Panel::new(&mesh)).draw()?)
}
