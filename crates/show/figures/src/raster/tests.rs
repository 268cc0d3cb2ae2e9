//! Coverage of pixels, visibility of overlapping faces, and interpolated values.

use super::camera::Seen;
use super::triangles::{Grid, NONE, Triangle, Visible};
use super::{Camera, render};
use crate::{ColorMap, Mark, Panel, Projection, Scale, Theme, Values, View};
use pompeiu_core::TriMesh;

fn corner(x: f64, y: f64, near: f64) -> Seen {
    Seen { local: [0.0; 3], at: [x, y], near }
}

fn grid(columns: usize, rows: usize, per_pixel: u32) -> Grid {
    Grid { start: [0, 0], size: [columns * per_pixel as usize, rows * per_pixel as usize], per_pixel }
}

fn drawn(grid: &Grid, faces: &[[Seen; 3]]) -> Visible {
    let mut visible = Visible::nothing(grid);
    for (face, &corners) in faces.iter().enumerate() {
        if let Some(triangle) = Triangle::new(corners) {
            visible.draw(grid, face as u32, &triangle);
        }
    }
    visible
}

fn picture(grid: &Grid, visible: &Visible) -> String {
    let symbol = |face: &u32| if *face == NONE { '.' } else { char::from(b'0' + *face as u8) };
    let rows = visible.face.chunks(grid.size[0]).map(|row| row.iter().map(symbol).collect::<String>());
    rows.collect::<Vec<_>>().join("\n")
}

#[test]
fn a_face_covers_the_pixels_whose_middles_are_in_it() {
    let grid = grid(6, 4, 1);
    let face = [corner(1.0, 0.0, 0.0), corner(5.0, 0.0, 0.0), corner(1.0, 3.9, 0.0)];
    let expected = ".000..\n.00...\n.0....\n......";
    assert_eq!(picture(&grid, &drawn(&grid, &[face])), expected);
    let [p, q, r] = face;
    assert_eq!(picture(&grid, &drawn(&grid, &[[p, r, q]])), expected, "turned");
    assert_eq!(picture(&grid, &drawn(&grid, &[[r, p, q]])), expected, "started elsewhere");
}

#[test]
fn faces_around_a_vertex_cover_every_pixel_once() {
    // Spokes through pixel centres, where rounding decides, and through other points.
    let rim =
        [[0.5, 0.5], [4.5, 0.5], [8.5, 0.5], [8.5, 4.5], [8.5, 8.5], [3.3, 8.5], [0.5, 8.5], [0.5, 4.1]];
    for per_pixel in 1..=4 {
        let grid = grid(9, 9, per_pixel);
        let mut counts = vec![0; grid.size[0] * grid.size[1]];
        for spoke in 0..rim.len() {
            let [p, q] = [rim[spoke], rim[(spoke + 1) % rim.len()]].map(|[x, y]| corner(x, y, 0.0));
            let visible = drawn(&grid, &[[corner(4.5, 4.5, 0.0), p, q]]);
            counts.iter_mut().zip(visible.face).for_each(|(count, face)| *count += i32::from(face != NONE));
        }
        let inside = |index: usize| {
            [index % grid.size[0], index / grid.size[0]].iter().all(|&i| {
                let place = (i as f64 + 0.5) / f64::from(per_pixel);
                0.5 < place && place < 8.5
            })
        };
        assert!(counts.iter().all(|&count| count <= 1));
        assert!(counts.iter().enumerate().all(|(index, &count)| !inside(index) || count == 1));
    }
}

#[test]
fn the_nearest_face_is_seen_and_the_first_of_equals() {
    let grid = grid(4, 1, 1);
    let face = |near: [f64; 2]| {
        [corner(-1.0, -9.0, near[0]), corner(-1.0, 10.0, near[0]), corner(9.0, 0.0, near[1])]
    };
    let [far, close, same] = [face([1.0, 1.0]), face([2.0, 2.0]), face([2.0, 2.0])];
    assert_eq!(picture(&grid, &drawn(&grid, &[far, close, same])), "1111");
    assert_eq!(picture(&grid, &drawn(&grid, &[close, far])), "0000");
    // Two planes that cross over x = 2.
    let crossing = face([0.4, 2.4]);
    assert_eq!(picture(&grid, &drawn(&grid, &[crossing, face([1.0, 1.0])])), "1100");
}

#[test]
fn a_triangle_without_area_covers_nothing() {
    let line = [corner(0.0, 0.0, 0.0), corner(4.0, 4.0, 0.0), corner(2.0, 2.0, 0.0)];
    assert!(Triangle::new(line).is_none());
    assert!(Triangle::new([line[0]; 3]).is_none());
}

/// A square in the plane z = 0, with values equal to x.
fn square() -> (TriMesh, Vec<f64>) {
    let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let mesh = TriMesh::new(positions, vec![[0, 1, 2], [0, 2, 3]]).unwrap();
    let values = mesh.positions().iter().map(|position| position[0]).collect();
    (mesh, values)
}

#[test]
fn the_limit_is_where_values_are_it_and_not_where_colours_are() {
    let (mesh, values) = square();
    let scale = Scale::new(ColorMap::Viridis, 0.0, 1.0).unwrap().with_limit(0.7);
    let panels = [Panel::new(&mesh).with_values(Values::Vertices(&values))];
    for projection in [Projection::Orthographic, Projection::Perspective] {
        let view = View::default().with_direction_to_eye([0.0, 0.0, 1.0]).with_projection(projection);
        let camera = Camera::new(&view, &panels).unwrap().fitted([100, 100]);
        let image = render(&panels[0], &camera, Some(&scale), &Theme::Light.colors(), [100, 100]);
        // The square leaves 3.5 pixels free on each side: x = 0.7 lies 68.6 pixels from the left.
        let red = |x| image.pixel(x, 50).is_some_and(|[red, green, _]| red > 180 && green < 60);
        assert!(!red(67) && red(69) && red(95), "{projection:?}");
        assert!((5..67).all(|x| !red(x)), "{projection:?}");
        assert_eq!(image.pixel(2, 50), Some([255; 3]));
    }
}

#[test]
fn values_are_linear_in_space_under_perspective() {
    let (mesh, values) = square();
    let panel = Panel::new(&mesh).with_values(Values::Vertices(&values));
    let view = View::default().with_direction_to_eye([3.0, 0.0, 1.0]);
    let panels = [panel];
    let camera = Camera::new(&view, &panels).unwrap().fitted([200, 200]);
    let scale = Scale::new(ColorMap::Viridis, 0.0, 1.0).unwrap();
    for limit in [0.2, 0.5, 0.8] {
        let limited = scale.with_limit(limit);
        let image = render(&panels[0], &camera, Some(&limited), &Theme::Light.colors(), [200, 200]);
        let at = camera.see([limit, 0.5, 0.0]).at;
        let red = |x: f64| {
            image
                .pixel(x as u32, at[1] as u32)
                .is_some_and(|[red, green, _]| red > 80 && red > 2 * green.min(99))
        };
        assert!(!red(at[0] - 1.0) && red(at[0] + 1.0), "limit {limit}");
    }
}

#[test]
fn directions_are_those_in_which_points_move() {
    let (mesh, _) = square();
    let panels = [Panel::new(&mesh)];
    for projection in [Projection::Orthographic, Projection::Perspective] {
        let camera =
            Camera::new(&View::default().with_projection(projection), &panels).unwrap().fitted([500; 2]);
        for direction in [[1.0, 0.0, 0.0], [0.3, -0.8, 0.6], [0.1, 0.4, 0.9]] {
            let from = [0.2, 0.7, 0.0];
            let seen = [-1e-6, 1e-6]
                .map(|step| camera.see(std::array::from_fn(|i| from[i] + step * direction[i])).at);
            let moved = [seen[1][0] - seen[0][0], seen[1][1] - seen[0][1]];
            let [x, y] = camera.direction(camera.see(from).local, direction);
            // Half extents are 0.5, and steps are of lengths near 1.
            let length = (moved[0] * moved[0] + moved[1] * moved[1]).sqrt();
            assert!((x * moved[1] - y * moved[0]).abs() < 1e-6 * length, "{projection:?} {direction:?}");
            let expected =
                length / 2e-6 / (camera.scale / 0.5) / direction.iter().map(|c| c * c).sum::<f64>().sqrt();
            assert!((x * moved[0] + y * moved[1] - expected * length).abs() < 1e-6 * length);
        }
    }
}

#[test]
fn both_sides_of_a_face_look_the_same() {
    let (mesh, values) = square();
    let (positions, faces) = mesh.clone().into_parts();
    let turned = TriMesh::new(positions, faces.into_iter().map(|[a, b, c]| [a, c, b]).collect()).unwrap();
    let scale = Scale::new(ColorMap::Batlow, 0.0, 1.0).unwrap();
    let images = [&mesh, &turned].map(|mesh| {
        let panels = [Panel::new(mesh).with_values(Values::Vertices(&values))];
        let camera = Camera::new(&View::default(), &panels).unwrap().fitted([40, 40]);
        render(&panels[0], &camera, Some(&scale), &Theme::Light.colors(), [40, 40])
    });
    assert_eq!(images[0], images[1]);
}

#[test]
fn marks_are_hidden_by_what_is_before_them_as_far_as_wanted() {
    let (mesh, _) = square();
    let view =
        View::default().with_direction_to_eye([0.0, 0.0, 1.0]).with_projection(Projection::Orthographic);
    let seen = |depth: f64, behind: f64| {
        let mark = Mark::point([0.5, 0.5, depth]).with_color([255, 0, 0]).with_opacity_behind(behind);
        let panels = [Panel::new(&mesh).with_mark(mark)];
        let camera = Camera::new(&view, &panels).unwrap().fitted([61, 61]);
        render(&panels[0], &camera, None, &Theme::Light.colors(), [61, 61]).pixel(30, 30).unwrap()
    };
    let red = [255, 0, 0];
    assert_eq!([seen(0.5, 0.0), seen(0.0, 0.0), seen(-0.5, 1.0)], [red; 3]);
    let hidden = seen(-0.5, 0.0);
    assert!(hidden[0].abs_diff(hidden[1]) < 20, "the mesh is grey: {hidden:?}");
    let faint = seen(-0.5, 0.5);
    assert!(hidden[1] > faint[1] && faint[1] > 50, "{hidden:?} {faint:?}");
}
