//! Whole pictures: the same bits on every machine, and robustness against any input.

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{icosphere, torus};
use pompeiu_figures::{
    ColorMap, Figure, FigureError, Image, LegendSide, Mark, Panel, Projection, Rgb, Scale, Theme, Values,
    View, vertex_normals,
};
use std::fs;
use std::path::Path;

/// Largest number of pixels on a side.
const MAX_SIDE: u32 = 1 << 14;

/// Compares a picture with the one in `tests/pictures`, pixel by pixel.
///
/// `POMPEIU_PICTURES=write` replaces those instead: look at them before you commit them.
fn check(name: &str, image: &Image) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/pictures").join(name);
    if std::env::var_os("POMPEIU_PICTURES").is_some_and(|value| value == "write") {
        image.write_png(fs::File::create(&path).unwrap()).unwrap();
    }
    let decoder = png::Decoder::new(std::io::BufReader::new(fs::File::open(&path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), (image.width(), image.height()), "{name}");
    let differing =
        pixels.chunks(3).zip(image.pixels()).filter(|(stored, drawn)| *stored != drawn.as_slice());
    assert_eq!(differing.count(), 0, "pixels of {name} that differ");
}

fn heights(mesh: &TriMesh) -> Vec<f64> {
    mesh.positions().iter().map(|position| position[1]).collect()
}

fn two_panels(torus: &TriMesh, sphere: &TriMesh, theme: Theme, projection: Projection) -> Image {
    let (high, low) = (heights(torus), heights(sphere));
    let faces: Vec<f64> = sphere.faces().iter().map(|face| low[face[0] as usize]).collect();
    let normals = vertex_normals(torus);
    let marks = [
        Mark::segment([0.6, 0.1, 0.4], [1.2, 0.9, 0.9]).with_color([220, 30, 30]),
        Mark::point([1.2, 0.9, 0.9]),
        Mark::arrow([-0.9, 0.6, 0.3], [-0.2, 0.6, 0.6]).with_width(3.0),
    ];
    let first =
        Panel::new(torus).with_values(Values::Vertices(&high)).with_normals(&normals).with_title("A → B");
    let second = Panel::new(sphere).with_values(Values::Faces(&faces)).with_edges().with_title("B → A");
    let scale = Scale::symmetric(ColorMap::Vik, 0.8).unwrap().with_limit(0.7).with_missing([90, 90, 90]);
    Figure::new(420, 240)
        .with_title("Two shapes: 0.1 ≤ H ≤ 0.2")
        .with_theme(theme)
        .with_view(View::default().with_up([0.0, 1.0, 0.2]).with_projection(projection))
        .with_scale(scale, "height (mm)")
        .with_panel(marks.into_iter().fold(first, Panel::with_mark))
        .with_panel(second)
        .draw()
        .unwrap()
}

/// A field that rotates around the axis of a torus, and one that points up.
fn fields(torus: &TriMesh, theme: Theme) -> Image {
    let middle = |face: &[u32; 3]| -> [f64; 3] {
        let [p, q, r] = face.map(|vertex| torus.positions()[vertex as usize]);
        std::array::from_fn(|i| (p[i] + q[i] + r[i]) / 3.0)
    };
    let turning: Vec<[f64; 3]> = torus.faces().iter().map(middle).map(|[x, y, _]| [-y, x, 0.0]).collect();
    let rising = vec![[0.0, 0.0, 0.3]; torus.faces().len()];
    Figure::new(420, 240)
        .with_theme(theme)
        .with_legend_at(LegendSide::Bottom)
        .with_view(View::default().with_up([0.0, 0.0, 1.0]))
        .with_scale(Scale::new(ColorMap::Viridis, 0.0, 1.2).unwrap(), "magnitude")
        .with_panel(Panel::new(torus).with_vectors(&turning).with_title("turning"))
        .with_panel(Panel::new(torus).with_vectors(&rising).with_title("rising"))
        .draw()
        .unwrap()
}

#[test]
fn pictures_are_those_that_were_looked_at() {
    let (torus, sphere) = (torus(0.8, 0.35, 40, 20).unwrap(), icosphere(0.9, 2).unwrap());
    check("light.png", &two_panels(&torus, &sphere, Theme::Light, Projection::Perspective));
    check("fields.png", &fields(&torus, Theme::Light));
    check("dark.png", &two_panels(&torus, &sphere, Theme::Dark, Projection::Orthographic));
}

#[test]
fn pictures_are_the_same_for_any_number_of_threads() {
    let (torus, sphere) = (torus(0.8, 0.35, 300, 150).unwrap(), icosphere(0.9, 4).unwrap());
    let draw = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut png = Vec::new();
            two_panels(&torus, &sphere, Theme::Light, Projection::Perspective).write_png(&mut png).unwrap();
            fields(&torus, Theme::Dark).write_png(&mut png).unwrap();
            png
        })
    };
    let one = draw(1);
    assert!(one == draw(2) && one == draw(8));
}

/// A figure that must be drawn whatever its values.
fn draw(mesh: &TriMesh, values: &[f64]) -> Image {
    let normals = vec![[f64::NAN; 3]; mesh.positions().len()];
    let panel = Panel::new(mesh).with_values(Values::Vertices(values)).with_normals(&normals).with_edges();
    let ends = [[f64::NAN; 3], [f64::INFINITY, 0.0, 0.0], [f64::MAX; 3], mesh.positions()[0]];
    let vectors: Vec<[f64; 3]> = (0..mesh.faces().len()).map(|face| ends[face % ends.len()]).collect();
    let panel = panel.with_vectors(&vectors);
    let marks = ends.iter().flat_map(|&from| ends.map(|to| [Mark::arrow(from, to), Mark::segment(from, to)]));
    let widths = [f64::NAN, -1.0, 0.0, 1e300, f64::INFINITY];
    let panel = marks.flatten().fold(panel, Panel::with_mark);
    let panel = widths.iter().fold(panel, |panel, &width| {
        panel.with_mark(Mark::point(mesh.positions()[0]).with_width(width).with_opacity_behind(width))
    });
    let scale = Scale::new(ColorMap::Viridis, -f64::MAX, f64::MAX).unwrap().with_limit(f64::INFINITY);
    Figure::new(90, 60).with_scale(scale, "\u{0}\n 漢字 🜂").with_panel(panel).draw().unwrap()
}

#[test]
fn no_mesh_and_no_value_is_too_odd() {
    let shapes: [[[f64; 3]; 4]; 6] = [
        [[0.0; 3], [0.0; 3], [0.0; 3], [5.0; 3]],
        [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [3.0, 6.0, 9.0], [0.0; 3]],
        [
            [TriMesh::MAX_COORDINATE; 3],
            [-TriMesh::MAX_COORDINATE; 3],
            [0.0, TriMesh::MAX_COORDINATE, 0.0],
            [1.0; 3],
        ],
        [[5e-324, 0.0, 0.0], [0.0, 5e-324, 0.0], [0.0, 0.0, 5e-324], [1.0; 3]],
        [[1e16, 1.0, 0.0], [1e16, 2.0, 0.0], [1e16, 1.0, 1.0], [0.0; 3]],
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1e-9, 0.0], [TriMesh::MAX_COORDINATE; 3]],
    ];
    for shape in shapes {
        let mesh = TriMesh::new(shape.to_vec(), vec![[0, 1, 2], [0, 0, 1], [2, 1, 0]]).unwrap();
        for values in [[f64::NAN; 4], [f64::INFINITY; 4], [-f64::MAX, f64::MAX, 0.0, f64::NEG_INFINITY]] {
            assert_eq!(draw(&mesh, &values).pixels().len(), 90 * 60);
        }
    }
}

#[test]
fn a_mark_is_seen_where_a_mesh_is_a_point() {
    let mesh = TriMesh::new(vec![[3.0, 4.0, 5.0]], vec![[0, 0, 0]]).unwrap();
    let panel = Panel::new(&mesh).with_mark(Mark::point([3.0, 4.0, 5.0]).with_color([200, 0, 0]));
    assert_eq!(Figure::new(60, 60).with_panel(panel).draw().unwrap().pixel(30, 30), Some([200, 0, 0]));
}

#[test]
fn no_size_is_too_odd() {
    let mesh = icosphere(1.0, 1).unwrap();
    let scale = Scale::new(ColorMap::Batlow, 0.0, 0.0).unwrap();
    for (width, height) in [(1, 1), (2, 500), (500, 2), (31, 17), (64, 64), (MAX_SIDE, 1)] {
        let figure =
            Figure::new(width, height).with_title("a title that is much too long for such a picture");
        let side = if width < height { LegendSide::Right } else { LegendSide::Bottom };
        let figure = figure.with_legend_at(side);
        let figure = (0..5)
            .fold(figure.with_scale(scale, "zero"), |f, _| f.with_panel(Panel::new(&mesh).with_title("p")));
        let image = figure.draw().unwrap();
        assert_eq!(image.pixels().len(), width as usize * height as usize);
        image.write_png(Vec::new()).unwrap();
    }
    let empty = Figure::new(8, 8).draw().unwrap();
    assert!(empty.pixels().iter().all(|&pixel| pixel == [255; 3]));
}

#[test]
fn every_direction_to_the_eye_gives_a_picture() {
    let mesh = icosphere(1.0, 1).unwrap();
    let axes =
        [[0.0, 1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [1e-300, 0.0, 0.0], [1e300, 1e300, -1e300]];
    for up in axes {
        for eye in axes {
            let view = View::default().with_up(up).with_direction_to_eye(eye);
            let image = Figure::new(40, 40).with_view(view).with_panel(Panel::new(&mesh)).draw().unwrap();
            assert_ne!(image.pixel(20, 20), Some([255; 3]), "up {up:?}, eye {eye:?}");
        }
    }
}

#[test]
fn what_does_not_fit_together_is_an_error_with_its_numbers() {
    let mesh = icosphere(1.0, 0).unwrap();
    let scale = Scale::new(ColorMap::Viridis, 0.0, 1.0).unwrap();
    let error =
        |panel| Figure::new(8, 8).with_scale(scale, "").with_panel(panel).draw().unwrap_err().to_string();
    assert_eq!(
        error(Panel::new(&mesh).with_values(Values::Vertices(&[0.0; 3]))),
        "a mesh with 12 vertices needs as many values, but has 3"
    );
    assert_eq!(
        error(Panel::new(&mesh).with_values(Values::Corners(&[[0.0; 3]; 60]))),
        "a mesh with 20 faces needs as many triples of values, but has 60"
    );
    assert_eq!(
        error(Panel::new(&mesh).with_vectors(&[[0.0; 3]; 12])),
        "a mesh with 20 faces needs as many vectors, but has 12"
    );
    assert_eq!(
        error(Panel::new(&mesh).with_normals(&[])),
        "a mesh with 12 vertices needs as many normals, but has 0"
    );
    let without_scale = Panel::new(&mesh).with_values(Values::Vertices(&[0.0; 12]));
    let figure = Figure::new(8, 8).with_panel(Panel::new(&mesh)).with_panel(without_scale);
    assert_eq!(figure.draw(), Err(FigureError::NoScale { panel: 2 }));
    assert_eq!(Figure::new(0, 8).draw(), Err(FigureError::Size { width: 0, height: 8 }));
    assert!(Figure::new(8, MAX_SIDE + 1).draw().is_err());
    let view = View::default().with_up([0.0, f64::NAN, 0.0]);
    let message = Figure::new(8, 8).with_view(view).draw().unwrap_err().to_string();
    assert_eq!(message, "the direction up is (0, NaN, 0), which is no direction");
}

/// A label stands beside its point where the mesh does not hide the point, and nowhere else.
#[test]
fn labels_of_hidden_points_are_not_drawn() {
    let mesh = icosphere(1.0, 3).unwrap();
    let drawn = |panel: Panel<'_>| Figure::new(200, 200).with_panel(panel).draw().unwrap();
    let view = View::default().frame().unwrap();
    let towards_eye = view[2];
    let plain = drawn(Panel::new(&mesh));
    let behind = drawn(Panel::new(&mesh).with_label(towards_eye.map(|x| -x), "1: 0.5"));
    assert_eq!(behind, plain);
    let before = drawn(Panel::new(&mesh).with_label(towards_eye, "1: 0.5"));
    let changed = before.pixels().iter().zip(plain.pixels()).filter(|(x, y)| x != y).count();
    let of_point = drawn(Panel::new(&mesh).with_mark(Mark::point(towards_eye)));
    let by_point = of_point.pixels().iter().zip(plain.pixels()).filter(|(x, y)| x != y).count();
    assert!(changed > by_point + 200, "{changed} {by_point}");
}

#[test]
fn pictures_are_tiled_in_rows() {
    let picture = |color: Rgb, width: u32| Image::new(width, 2, vec![color; 2 * width as usize]).unwrap();
    let tiled = Image::tiled(&[picture([1; 3], 3), picture([2; 3], 2), picture([3; 3], 3)], 2, [9; 3]);
    assert_eq!((tiled.width(), tiled.height()), (6, 4));
    assert_eq!(tiled.pixel(0, 0), Some([1; 3]));
    assert_eq!((tiled.pixel(4, 1), tiled.pixel(5, 1)), (Some([2; 3]), Some([9; 3])));
    assert_eq!((tiled.pixel(2, 3), tiled.pixel(3, 3)), (Some([3; 3]), Some([9; 3])));
}
