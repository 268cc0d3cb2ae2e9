//! Writes a page of a torus and a sphere, with distances from closed forms:
//!
//! ```sh
//! cargo run --release -p pompeiu-hausdorff --features figures --example deviation_page page.html [--faces 20000] [--signed] [--bands -0.1,0.2] [--offset 1e6]
//! ```
//!
//! Beside it, `page.html.json` holds what the page was made from. Distances are those of points of the meshes from the smooth
//! sphere and the smooth torus. All enclosures follow from one fact: a distance changes no faster than the place.

#![allow(clippy::print_stdout, reason = "this program is there to print")]
#![allow(clippy::unwrap_used, reason = "numbers of this program's own making compare")]

use pompeiu_core::TriMesh;
use pompeiu_core::mesh::shapes::{torus, uv_sphere};
use pompeiu_figures::page::{Axis, Bounds, PointPair};
use pompeiu_hausdorff::show::{
    DeviationContent, DisplayTriangles, Exceedance, Histogram, MeasuredSurface, Region, SearchStage,
    SurfaceDeviation,
};
use serde_json::json;
use std::error::Error;

const TORUS: [f64; 2] = [1.0, 0.36];
const CENTER: [f64; 3] = [0.14, 0.06, 0.11];
const RADIUS: f64 = 1.0;
/// As fractions of the size of the scene.
const STAGES: [f64; 8] = [3e-1, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 1e-4, 1e-5];

type Triangle = [[f64; 3]; 3];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let out = arguments.next().ok_or("expected the file to write")?;
    let (mut faces, mut signed, mut offset) = (20_000.0, false, 0.0);
    let mut bands = Vec::new();
    let mut names = ["torus.ply".to_owned(), "sphere.stl".to_owned()];
    while let Some(option) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{option} needs a value"));
        match option.as_str() {
            "--faces" => faces = value()?.parse::<f64>()?,
            "--offset" => offset = value()?.parse::<f64>()?,
            "--names" => names = [value()?, value()?],
            "--signed" => signed = true,
            "--bands" => {
                bands = value()?.split(',').map(str::parse).collect::<Result<Vec<f64>, _>>()?;
            }
            _ => return Err(format!("unknown option {option}").into()),
        }
    }
    // Half of the faces each; quadrilaterals about as long as wide.
    let around = (faces / 4.0 * TORUS[0] / TORUS[1]).sqrt().max(8.0) as u32;
    let across = (f64::from(around) * TORUS[1] / TORUS[0]).max(5.0) as u32;
    let a = moved(&torus(TORUS[0], TORUS[1], around, across)?, [0.0; 3]);
    let rings = (faces / 8.0).sqrt().max(4.0) as u32;
    let b = moved(&uv_sphere(RADIUS, 2 * rings, rings)?, CENTER);

    let to_sphere = |p: [f64; 3]| norm([0, 1, 2].map(|k| p[k] - CENTER[k])) - RADIUS;
    let to_torus = |p: [f64; 3]| (p[0].hypot(p[1]) - TORUS[0]).hypot(p[2]) - TORUS[1];
    let nearest_on_sphere = |p: [f64; 3]| {
        let from = [0, 1, 2].map(|k| p[k] - CENTER[k]);
        [0, 1, 2].map(|k| CENTER[k] + from[k] * RADIUS / norm(from))
    };
    let nearest_on_torus = |p: [f64; 3]| {
        let circle = p[0].hypot(p[1]);
        let middle = [p[0] / circle * TORUS[0], p[1] / circle * TORUS[0], 0.0];
        let from = [0, 1, 2].map(|k| p[k] - middle[k]);
        [0, 1, 2].map(|k| middle[k] + from[k] * TORUS[1] / norm(from))
    };
    let surfaces = [
        measured(&names[0], &a, &to_sphere, &nearest_on_sphere, signed, &bands, offset),
        measured(&names[1], &b, &to_torus, &nearest_on_torus, signed, &bands, offset),
    ];
    let [there, back] = [0, 1].map(|i| surfaces[i].deviation.as_ref().unwrap().distance);
    let page = DeviationContent {
        title: format!("{} and {}", names[0], names[1]),
        unit: "mm".into(),
        up: Axis::Z,
        signed,
        threshold: Some(0.25),
        bands,
        labels: Default::default(),
        verdict: None,
        still: None,
        distance: Some([0, 1].map(|end| if there[end] > back[end] { there[end] } else { back[end] })),
        surfaces,
        proof: vec![
            "Upper end: a distance changes no faster than the place, so no point of a piece is farther than its middle by more \
             than the piece reaches. Pieces were cut until that was enough."
                .into(),
            "Lower end: the distance of one point, from a closed form.".into(),
        ],
        attached: Vec::new(),
        facts: vec![["tolerance".into(), "1e-5 of the scene".into()]],
        command: Some("cargo run -p pompeiu-hausdorff --features figures --example deviation_page".into()),
        version: env!("CARGO_PKG_VERSION").into(),
    };
    let html = page.page()?.html();
    std::fs::write(&out, &html)?;
    std::fs::write(format!("{out}.json"), truth(&page).to_string())?;
    println!("{} bytes for {} faces", html.len(), page.surfaces[0].faces + page.surfaces[1].faces);
    Ok(())
}

/// What the browser's answers are held against.
fn truth(page: &DeviationContent) -> serde_json::Value {
    let surface = |surface: &MeasuredSurface| {
        let deviation = surface.deviation.as_ref().unwrap();
        let stage =
            |stage: &SearchStage| json!({ "count": stage.remaining.len(), "distance": stage.distance });
        json!({
            "name": surface.name, "faces": surface.faces,
            "corners": surface.triangles.corners.iter().map(|at| at.map(|v| surface.triangles.positions[v as usize])).collect::<Vec<_>>(), "values": deviation.values, "bounds": deviation.face_bounds,
            "distance": deviation.distance, "witness": [deviation.witness.from, deviation.witness.to],
            "exceedance": { "at": deviation.exceedance.distances, "fractions": deviation.exceedance.fractions },
            "statistics": deviation.statistics.iter().map(|s| json!([s.0, s.1])).collect::<Vec<_>>(),
            "bands": deviation.bands,
            "regions": deviation.regions.iter().map(|r| json!({ "center": r.center, "faces": r.faces })).collect::<Vec<_>>(),
            "stages": deviation.stages.iter().map(stage).collect::<Vec<_>>(),
        })
    };
    json!({ "surfaces": [surface(&page.surfaces[0]), surface(&page.surfaces[1])], "distance": page.distance })
}

fn norm(v: [f64; 3]) -> f64 {
    v[0].hypot(v[1]).hypot(v[2])
}

fn moved(mesh: &TriMesh, by: [f64; 3]) -> Vec<Triangle> {
    mesh.face_ids().map(|f| mesh.corners(f).map(|p| [0, 1, 2].map(|k| p[k] + by[k]))).collect()
}

fn middle(t: &Triangle) -> [f64; 3] {
    [0, 1, 2].map(|k| (t[0][k] + t[1][k] + t[2][k]) / 3.0)
}

/// How far the corners, and so all points, are from the middle.
fn reach(t: &Triangle) -> f64 {
    let m = middle(t);
    t.iter().map(|p| norm([0, 1, 2].map(|k| p[k] - m[k]))).max_by(f64::total_cmp).unwrap()
}

fn quarters(&[a, b, c]: &Triangle) -> [Triangle; 4] {
    let half = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| f64::midpoint(p[k], q[k]));
    let [d, e, f] = [half(b, c), half(c, a), half(a, b)];
    [[a, f, e], [f, b, d], [e, d, c], [d, e, f]]
}

fn area(t: &Triangle) -> f64 {
    let [u, v] = [1, 2].map(|i| [0, 1, 2].map(|k| t[i][k] - t[0][k]));
    norm([u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]) / 2.0
}

fn measured(
    name: &str,
    triangles: &[Triangle],
    distance: &dyn Fn([f64; 3]) -> f64,
    nearest: &dyn Fn([f64; 3]) -> [f64; 3],
    signed: bool,
    bands: &[f64],
    offset: f64,
) -> MeasuredSurface {
    let size = |p: [f64; 3]| distance(p).abs();
    let value = |p: [f64; 3]| if signed { distance(p) } else { size(p) };
    let shift = |p: [f64; 3]| [p[0] + offset, p[1], p[2]];
    let areas: Vec<f64> = triangles.iter().map(area).collect();
    let total: f64 = areas.iter().sum();
    // Least and largest size of the distance that each face can have.
    let range = |t: &Triangle| -> Bounds {
        let (at, reach) = (size(middle(t)), reach(t));
        [if at > reach { at - reach } else { 0.0 }, at + reach]
    };
    let ranges: Vec<Bounds> = triangles.iter().map(range).collect();
    let largest_corner = |t: &Triangle| t.iter().map(|&p| size(p)).max_by(f64::total_cmp).unwrap();
    let face_bounds: Vec<Bounds> =
        triangles.iter().zip(&ranges).map(|(t, range)| [largest_corner(t), range[1]]).collect();
    let top = ranges.iter().map(|range| range[1]).max_by(f64::total_cmp).unwrap();
    let fraction = |of: &dyn Fn(usize) -> bool| {
        (0..areas.len()).filter(|&i| of(i)).map(|i| areas[i]).sum::<f64>() / total
    };

    let places: Vec<f64> = (0..=200).map(|i| top * f64::from(i) / 200.0).collect();
    // Of 256 parts of each face: how much is far is known better than for whole faces.
    let mut parts = triangles.to_vec();
    for _ in 0..4 {
        parts = parts.iter().flat_map(quarters).collect();
    }
    let parts: Vec<(f64, Bounds)> = parts.iter().map(|part| (area(part), range(part))).collect();
    // For both ends the parts with the farthest first, and the area up to each.
    let sums = [0, 1].map(|end| {
        let mut sorted: Vec<(f64, f64)> = parts.iter().map(|(area, range)| (range[end], *area)).collect();
        sorted.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut sum = 0.0;
        for (_, area) in &mut sorted {
            sum += *area;
            *area = sum;
        }
        sorted
    });
    let share = |end: usize, at: f64| {
        let count = sums[end].partition_point(|(distance, _)| *distance > at);
        count.checked_sub(1).map_or(0.0, |last| (sums[end][last].1 / total).min(1.0))
    };
    let farther = |at: f64| [share(0, at), share(1, at)];
    let exceedance =
        Exceedance { distances: places.clone(), fractions: places.iter().map(|&at| farther(at)).collect() };
    let low = if signed { -1.0 } else { 0.0 };
    let edges: Vec<f64> = (0..=32).map(|i| top * (low + (1.0 - low) * f64::from(i) / 32.0)).collect();
    let values: Vec<Bounds> = triangles
        .iter()
        .map(|t| (value(middle(t)), reach(t)))
        .map(|(at, reach)| [at - reach, at + reach])
        .collect();
    let inside = |a: f64, b: f64| {
        [
            fraction(&|i| a <= values[i][0] && values[i][1] < b),
            fraction(&|i| values[i][1] >= a && values[i][0] < b),
        ]
    };
    let histogram = Histogram {
        fractions: edges.windows(2).map(|bin| inside(bin[0], bin[1])).collect(),
        edges: edges.clone(),
    };
    let ends: Vec<f64> =
        [f64::NEG_INFINITY].into_iter().chain(bands.iter().copied()).chain([f64::INFINITY]).collect();
    let classes =
        ends.windows(2).filter(|_| !bands.is_empty()).map(|ends| inside(ends[0], ends[1])).collect();
    let mean = |power: i32, end: usize| {
        (0..areas.len()).map(|i| areas[i] * ranges[i][end].powi(power)).sum::<f64>() / total
    };
    let quantile = |part: f64, end: usize| {
        let past = exceedance.fractions.iter().position(|fraction| fraction[end] <= 1.0 - part);
        // The lower curve crosses earlier than the true one, the upper one later.
        past.map_or(top, |i| if end == 0 { places[i.saturating_sub(1)] } else { places[i] })
    };
    let statistic = |label: &str, value: Bounds| (label.to_owned(), value);
    let statistics = vec![
        statistic("mean", [mean(1, 0), mean(1, 1)]),
        statistic("root mean square", [mean(2, 0).sqrt(), mean(2, 1).sqrt()]),
        statistic("median", [quantile(0.5, 0), quantile(0.5, 1)]),
        statistic("95 % within", [quantile(0.95, 0), quantile(0.95, 1)]),
        statistic("99 % within", [quantile(0.99, 0), quantile(0.99, 1)]),
    ];
    let (stages, distance, farthest) = search(triangles, &size, &shift);
    MeasuredSurface {
        name: name.into(),
        path: format!("examples/{name}"),
        vertices: triangles.len() / 2,
        faces: triangles.len(),
        triangles: DisplayTriangles {
            positions: triangles.as_flattened().iter().copied().map(shift).collect(),
            corners: (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            faces: (0..triangles.len() as u32).collect(),
            groups: None,
        },
        deviation: Some(SurfaceDeviation {
            values: triangles.iter().map(|t| t.map(value)).collect(),
            regions: regions(triangles, &face_bounds, &areas, &size, nearest, &shift),
            face_bounds,
            distance,
            stop: "as narrow as asked".into(),
            witness: PointPair { from: shift(farthest), to: shift(nearest(farthest)) },
            statistics,
            bands: classes,
            histogram,
            exceedance,
            stages,
        }),
    }
}

/// Branch and bound: what is left at each tolerance, and what encloses the largest distance in the end.
fn search(
    triangles: &[Triangle],
    size: &dyn Fn([f64; 3]) -> f64,
    shift: &dyn Fn([f64; 3]) -> [f64; 3],
) -> (Vec<SearchStage>, Bounds, [f64; 3]) {
    let corners = triangles.iter().flatten();
    let mut farthest = *corners.max_by(|p, q| size(**p).total_cmp(&size(**q))).unwrap();
    let mut open: Vec<Triangle> = triangles.to_vec();
    let mut stages = vec![];
    for tolerance in STAGES {
        loop {
            for p in open.iter().map(middle) {
                if size(p) > size(farthest) {
                    farthest = p;
                }
            }
            let lower = size(farthest);
            let upper = |t: &Triangle| size(middle(t)) + reach(t);
            open.retain(|t| upper(t) > lower);
            if open.iter().all(|t| upper(t) <= lower + tolerance) {
                break;
            }
            let (cut, kept): (Vec<Triangle>, Vec<Triangle>) =
                open.into_iter().partition(|t| upper(t) > lower + tolerance);
            open = kept;
            open.extend(cut.iter().flat_map(quartered));
        }
        let lower = size(farthest);
        let remaining = open.iter().map(|t| t.map(shift)).collect();
        stages.push(SearchStage { tolerance, distance: [lower, lower + tolerance], remaining });
    }
    let lower = size(farthest);
    (stages, [lower, lower + STAGES[STAGES.len() - 1]], farthest)
}

fn quartered(&[a, b, c]: &Triangle) -> [Triangle; 4] {
    let half = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| p[k].midpoint(q[k]));
    let (ab, bc, ca) = (half(a, b), half(b, c), half(c, a));
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// Faces that reach a good part of the largest distance, gathered around the farthest one that is left.
fn regions(
    triangles: &[Triangle],
    bounds: &[Bounds],
    areas: &[f64],
    size: &dyn Fn([f64; 3]) -> f64,
    nearest: &dyn Fn([f64; 3]) -> [f64; 3],
    shift: &dyn Fn([f64; 3]) -> [f64; 3],
) -> Vec<Region> {
    /// Of the unit of this scene.
    const APART: f64 = 0.45;
    let mut left: Vec<usize> = (0..triangles.len()).collect();
    left.sort_by(|&i, &j| bounds[j][0].total_cmp(&bounds[i][0]));
    let mut regions = vec![];
    while regions.len() < 6 && !left.is_empty() {
        let worst = *triangles[left[0]].iter().max_by(|p, q| size(**p).total_cmp(&size(**q))).unwrap();
        let near = |i: usize| norm([0, 1, 2].map(|k| middle(&triangles[i])[k] - worst[k])) < APART;
        let peak = bounds[left[0]];
        let (here, rest): (Vec<usize>, Vec<usize>) = left.into_iter().partition(|&i| near(i));
        left = rest;
        let members: Vec<usize> = here.into_iter().filter(|&i| bounds[i][0] > 0.9 * peak[0]).collect();
        let far =
            |&i: &usize| norm([0, 1, 2].map(|k| middle(&triangles[i])[k] - worst[k])) + reach(&triangles[i]);
        regions.push(Region {
            center: shift(worst),
            extent: 2.0 * members.iter().map(far).max_by(f64::total_cmp).unwrap(),
            area: members.iter().map(|&i| areas[i]).sum(),
            peak: [peak[0], members.iter().map(|&i| bounds[i][1]).max_by(f64::total_cmp).unwrap()],
            pair: PointPair { from: shift(worst), to: shift(nearest(worst)) },
            faces: members.iter().map(|&i| i as u32).collect(),
        });
    }
    regions
}
