//! Measures of shapes drawn as pixels, beside those of the shapes themselves: the greatest relative errors over five angles.
//!
//! ```sh
//! cargo run --release --package pompeiu-complexity --example pictures
//! ```

#![allow(clippy::print_stdout, reason = "an example prints")]

use pompeiu_complexity::generate::{PointOrder, polyline};
use pompeiu_complexity::{MeasureOptions, Measures};
use pompeiu_planar::picture::Picture;
use pompeiu_planar::silhouette::{Foreground, SilhouetteOptions, silhouette};
use pompeiu_planar::{Outline, fill};
use std::error::Error;
use std::f64::consts::TAU;

fn main() -> Result<(), Box<dyn Error>> {
    let rectangle = |h: f64| Outline::new(vec![[-1.0, -h], [1.0, -h], [1.0, h], [-1.0, h]]);
    let shapes = [
        ("circle", polar(4000, |_| 1.0)?),
        ("square", rectangle(1.0)?),
        ("bar", rectangle(0.2)?),
        ("ellipse", polar(4000, |_| 1.0)?.map(|[x, y]| [x, 0.33 * y])?),
        ("hexagon", polar(6, |_| 1.0)?),
        ("octagon", polar(8, |_| 1.0)?),
        ("clover of 4", polar(4000, |a| 1.0 + 0.5 * (4.0 * a).cos())?),
        ("flower of 6", polar(4000, |a| 1.0 + 0.35 * (6.0 * a).cos())?),
        ("star of 5", polar(10, |a| if (5.0 * a).cos() > 0.0 { 1.0 } else { 0.42 })?),
        ("polyline of 8", polyline(8, 3, PointOrder::Angle)?),
        ("polyline of 15", polyline(15, 5, PointOrder::Angle)?),
    ];
    println!("shape           pixels  levels  compactness  total curvature  peaks");
    for (name, shape) in &shapes {
        let expected = Measures::of(shape, &MeasureOptions::default())?;
        for pixels in [128, 256] {
            for (levels, is_binary) in [("2", true), ("256", false)] {
                let (mut compactness, mut total, mut peaks) = (0.0_f64, 0.0_f64, 0);
                for degrees in [0.0, 10.0, 22.5, 37.0, 45.0] {
                    let outline = drawn(shape, pixels, degrees, is_binary)?;
                    let found = Measures::of(&outline, &MeasureOptions::default())?;
                    let off = |a: f64, b: f64| (a / b - 1.0).abs();
                    compactness = compactness.max(off(found.global.compactness, expected.global.compactness));
                    total = total.max(off(found.curvature.total, expected.curvature.total));
                    peaks = peaks.max(found.curvature.peaks.abs_diff(expected.curvature.peaks));
                }
                println!("{name:<15} {pixels:<7} {levels:<7} {compactness:<12.4} {total:<16.4} {peaks}");
            }
        }
    }
    Ok(())
}

fn polar(corners: usize, radius: impl Fn(f64) -> f64) -> Result<Outline, Box<dyn Error>> {
    let at = |i: usize| {
        let angle = TAU * i as f64 / corners as f64;
        [radius(angle) * angle.cos(), radius(angle) * angle.sin()]
    };
    Ok(Outline::new((0..corners).map(at).collect())?)
}

/// The outline read from a picture of the shape, turned, so many pixels across.
fn drawn(shape: &Outline, pixels: usize, degrees: f64, is_binary: bool) -> Result<Outline, Box<dyn Error>> {
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
