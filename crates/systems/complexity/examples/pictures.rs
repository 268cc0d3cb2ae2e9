//! Measures of shapes drawn as pixels, beside those of the shapes themselves: in how many of the cases they are within 2 %, and the worst.
//!
//! A case is a shape at an angle, so many pixels across, of two levels or anti-aliased.
//!
//! ```sh
//! cargo run --release --package pompeiu-complexity --example pictures
//! cargo run --release --package pompeiu-complexity --example pictures -- star gear
//! ```

#![allow(clippy::print_stdout, reason = "an example prints")]

use pompeiu_complexity::generate::{PointOrder, polyline};
use pompeiu_complexity::{Measure, MeasureOptions, Measures, spearman};
use pompeiu_planar::picture::Picture;
use pompeiu_planar::silhouette::{Foreground, SilhouetteOptions, silhouette};
use pompeiu_planar::{Outline, Point, fill, first_crossing};
use rayon::prelude::*;
use std::error::Error;
use std::f64::consts::TAU;

type Outcome<T> = Result<T, Box<dyn Error>>;

const PIXELS: [usize; 4] = [128, 192, 320, 640];
const DEGREES: [f64; 7] = [0.0, 5.0, 10.0, 22.5, 30.0, 37.0, 45.0];

/// The error up to which a measure counts as the same.
const SAME: f64 = 0.02;

fn main() -> Outcome<()> {
    let named: Vec<String> = std::env::args().skip(1).collect();
    let mut all = shapes()?;
    all.retain(|(name, _)| named.is_empty() || named.iter().any(|part| name.contains(part.as_str())));
    println!("shape             levels  compactness        total curvature    peaks   worst");
    let mut sums = [0; 4];
    for (name, shape) in &all {
        let expected = Measures::of(shape, &MeasureOptions::default())?;
        for (levels, is_binary) in [("2", true), ("256", false)] {
            let cases: Vec<(usize, f64)> =
                PIXELS.iter().flat_map(|pixels| DEGREES.map(|degrees| (*pixels, degrees))).collect();
            let found: Vec<Measures> = cases
                .par_iter()
                .map(|(pixels, degrees)| {
                    let outline =
                        drawn(shape, *pixels, *degrees, is_binary).map_err(|error| error.to_string())?;
                    Measures::of(&outline, &MeasureOptions::default()).map_err(|error| error.to_string())
                })
                .collect::<Result<_, _>>()?;
            let off = |value: &dyn Fn(&Measures) -> f64| -> Vec<f64> {
                found.iter().map(|m| value(m) / value(&expected) - 1.0).collect()
            };
            let compactness = off(&|m| m.global.compactness);
            let total = off(&|m| m.curvature.total);
            let within = |errors: &[f64]| errors.iter().filter(|e| e.abs() <= SAME).count();
            let most = |errors: &[f64]| {
                errors.iter().copied().fold(0.0, |a: f64, e| if e.abs() > a.abs() { e } else { a })
            };
            let peaks = found.iter().filter(|m| m.curvature.peaks == expected.curvature.peaks).count();
            let worst =
                (0..cases.len()).max_by(|i, j| total[*i].abs().total_cmp(&total[*j].abs())).unwrap_or(0);
            println!(
                "{name:<17} {levels:<7} {:>2}/{} ({:>7.4})   {:>2}/{} ({:>7.4})   {peaks:>2}/{}   {} pixels, {}°",
                within(&compactness),
                cases.len(),
                most(&compactness),
                within(&total),
                cases.len(),
                most(&total),
                cases.len(),
                cases[worst].0,
                cases[worst].1
            );
            for (sum, n) in sums.iter_mut().zip([cases.len(), within(&compactness), within(&total), peaks]) {
                *sum += n;
            }
        }
    }
    let [cases, compactness, total, peaks] = sums;
    println!("of {cases} cases: compactness {compactness}, total curvature {total}, peaks {peaks}");
    ranks(&all)
}

/// Differences below this do not rank shapes: all convex ones have the total curvature 1 but for rounding.
const TIE: f64 = 1e-3;

/// Spearman's correlation of ranks at one size and at twice that, of values in steps of [`TIE`].
fn ranks(shapes: &[(String, Outline)]) -> Outcome<()> {
    println!("measure           pixels  levels  Spearman with twice the size");
    for (levels, is_binary) in [("2", true), ("256", false)] {
        let measured = |pixels: usize| -> Result<Vec<Measures>, String> {
            let one = |(_, shape): &(String, Outline)| {
                let outline = drawn(shape, pixels, 17.0, is_binary).map_err(|error| error.to_string())?;
                Measures::of(&outline, &MeasureOptions::default()).map_err(|error| error.to_string())
            };
            shapes.par_iter().map(one).collect()
        };
        let sizes = [128, 256, 512];
        let all = sizes.iter().map(|pixels| measured(*pixels)).collect::<Result<Vec<_>, _>>()?;
        for name in ["total-curvature", "compactness", "peaks", "boundary-25", "convexity"] {
            let measure = Measure::named(name)?;
            for (pixels, pair) in sizes.iter().zip(all.windows(2)) {
                let rounded = |m: &Measures| (measure.value(m) / TIE).round();
                let [a, b] = [0, 1].map(|k| pair[k].iter().map(rounded).collect::<Vec<_>>());
                println!("{name:<17} {pixels:<7} {levels:<7} {:.4}", spearman(&a, &b));
            }
        }
    }
    Ok(())
}

fn shapes() -> Outcome<Vec<(String, Outline)>> {
    let rectangle = |h: f64| Outline::new(vec![[-1.0, -h], [1.0, -h], [1.0, h], [-1.0, h]]);
    let star = |arms: usize, inner: f64| {
        polar(2 * arms, move |a| if (arms as f64 * a).cos() > 0.0 { 1.0 } else { inner })
    };
    let wave = |arms: f64, depth: f64| polar(4000, move |a| 1.0 + depth * (arms * a).cos());
    let mut all = vec![
        ("circle", polar(4000, |_| 1.0)?),
        ("square", rectangle(1.0)?),
        ("bar", rectangle(0.2)?),
        ("thin bar", rectangle(0.08)?),
        ("triangle", polar(3, |_| 1.0)?),
        ("pentagon", polar(5, |_| 1.0)?),
        ("hexagon", polar(6, |_| 1.0)?),
        ("octagon", polar(8, |_| 1.0)?),
        ("twelve sides", polar(12, |_| 1.0)?),
        ("ellipse 1:3", polar(4000, |_| 1.0)?.map(|[x, y]| [x, 0.33 * y])?),
        ("ellipse 1:8", polar(4000, |_| 1.0)?.map(|[x, y]| [x, 0.125 * y])?),
        ("clover of 4", wave(4.0, 0.5)?),
        ("flower of 6", wave(6.0, 0.35)?),
        ("flower of 12", wave(12.0, 0.15)?),
        ("star of 5", star(5, 0.42)?),
        ("star of 8", star(8, 0.6)?),
        ("star of 7", star(7, 0.3)?),
        ("gear of 8", gear(8, 0.75)?),
        ("gear of 14", gear(14, 0.82)?),
        ("L", letter(&[[0, 0], [6, 0], [6, 2], [2, 2], [2, 9], [0, 9]])?),
        ("T", letter(&[[3, 0], [5, 0], [5, 7], [8, 7], [8, 9], [0, 9], [0, 7], [3, 7]])?),
        (
            "E",
            letter(&[
                [0, 0],
                [6, 0],
                [6, 2],
                [2, 2],
                [2, 4],
                [5, 4],
                [5, 6],
                [2, 6],
                [2, 8],
                [6, 8],
                [6, 10],
                [0, 10],
            ])?,
        ),
        ("Z", letter(&[[0, 0], [8, 0], [8, 2], [3, 2], [8, 8], [8, 10], [0, 10], [0, 8], [5, 8], [0, 2]])?),
        ("crescent", crescent()?),
        ("rounded square", polar(4000, |a| (a.cos().powi(6) + a.sin().powi(6)).powf(-1.0 / 6.0))?),
        ("spiral arm", spiral()?),
    ];
    for (name, points) in [("polyline of 5", 5), ("polyline of 8", 8), ("polyline of 15", 15)] {
        // What is drawn of a curve that crosses itself has other measures than the curve.
        let simple = (1..100).filter_map(|seed| polyline(points, seed, PointOrder::Angle).ok());
        let mut simple = simple.filter(|outline| first_crossing(outline).is_none());
        all.push((name, simple.next().ok_or("all of the polylines cross themselves")?));
    }
    Ok(all.into_iter().map(|(name, outline)| (name.to_owned(), outline)).collect())
}

fn polar(corners: usize, radius: impl Fn(f64) -> f64) -> Outcome<Outline> {
    let at = |i: usize| {
        let angle = TAU * i as f64 / corners as f64;
        [radius(angle) * angle.cos(), radius(angle) * angle.sin()]
    };
    Ok(Outline::new((0..corners).map(at).collect())?)
}

/// Teeth with flat tops and bottoms, and sides that lean a little.
fn gear(teeth: usize, inner: f64) -> Outcome<Outline> {
    let corner = |i: usize| {
        let (tooth, k) = (i / 4, i % 4);
        let (share, radius) = [(0.04, inner), (0.14, 1.0), (0.46, 1.0), (0.56, inner)][k];
        let angle = TAU * (tooth as f64 + share) / teeth as f64;
        [radius * angle.cos(), radius * angle.sin()]
    };
    Ok(Outline::new((0..4 * teeth).map(corner).collect())?)
}

fn letter(corners: &[[i32; 2]]) -> Outcome<Outline> {
    Ok(Outline::new(corners.iter().map(|p| p.map(f64::from)).collect())?)
}

fn crescent() -> Outcome<Outline> {
    let arc = |centre: f64, radius: f64, from: f64, to: f64| -> Vec<Point> {
        let at = |i: i32| from + (to - from) * f64::from(i) / 600.0;
        (0..600).map(at).map(|a| [centre + radius * a.cos(), radius * a.sin()]).collect()
    };
    // The tips are where both circles meet: 0.5 away along the first axis.
    let outer = 60_f64.to_radians();
    let inner = (outer.sin()).atan2(outer.cos() + 0.1);
    let radius = (outer.sin().powi(2) + (outer.cos() + 0.1).powi(2)).sqrt();
    let mut points = arc(0.0, 1.0, outer, TAU - outer);
    points.extend(arc(
        -0.1 + 2.0 * (outer.cos() + 0.1),
        radius,
        std::f64::consts::PI + inner,
        std::f64::consts::PI - inner,
    ));
    Ok(Outline::new(points)?)
}

fn spiral() -> Outcome<Outline> {
    let side = |shift: f64| -> Vec<Point> {
        let at = |i: i32| 1.0 + 7.0 * f64::from(i) / 800.0;
        (0..=800).map(at).map(|a| [(0.12 * a + shift) * a.cos(), (0.12 * a + shift) * a.sin()]).collect()
    };
    let mut points = side(0.15);
    points.extend(side(-0.1).into_iter().rev());
    Ok(Outline::new(points)?)
}

/// The outline read from a picture of the shape, turned, so many pixels across.
fn drawn(shape: &Outline, pixels: usize, degrees: f64, is_binary: bool) -> Outcome<Outline> {
    let (s, c) = degrees.to_radians().sin_cos();
    let turned = shape.map(|[x, y]| [c * x - s * y, s * x + c * y])?;
    let [low, high] = turned.bounds();
    let scale = (pixels as f64 - 8.3) / (high[0] - low[0]).max(high[1] - low[1]);
    let placed = turned.map(|[x, y]| [4.12 + scale * (x - low[0]), 4.17 + scale * (y - low[1])])?;
    let mut levels = fill([&placed], pixels, pixels);
    if is_binary {
        for level in &mut levels {
            *level = f32::from(u8::from(*level > 0.5));
        }
    }
    let picture = Picture::new(pixels, pixels, levels).ok_or("a picture of no pixels")?;
    let options = SilhouetteOptions { foreground: Foreground::Light, ..SilhouetteOptions::default() };
    Ok(silhouette(&picture, &options)?.outer)
}
