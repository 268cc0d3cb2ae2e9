//! Grey levels of coloured pixels.

use super::Rgba;

/// How many times as much colours must vary in some direction as in luminance, by their standard deviations, for that to be looked at.
const MOST_OF_HUE: f64 = 16.0;
/// Steps of the power method: its result need not be the exact direction.
const STEPS: usize = 32;
/// Rec. 601.
const LUMINANCE: [f64; 3] = [0.299, 0.587, 0.114];

/// Levels from 0 to 1: of the colours on white, or of opacity if that has more contrast. Samples go up to `most`.
pub(super) fn levels<T: Copy + Into<f64>>(pixels: &[Rgba<T>], most: f64, has_opacity: bool) -> Vec<f32> {
    let sample = |v: T| v.into() / most;
    let on_white = |pixel: &Rgba<T>| -> [f64; 3] {
        let opacity = if has_opacity { sample(pixel[3]) } else { 1.0 };
        [0, 1, 2].map(|k| opacity * sample(pixel[k]) + (1.0 - opacity))
    };
    let spread = Spread::of(pixels.iter().map(on_white));
    let (direction, variance) = spread.direction();
    if has_opacity {
        let opacity = Spread::of(pixels.iter().map(|pixel| [sample(pixel[3]); 3]));
        if opacity.along(LUMINANCE) > variance {
            return pixels.iter().map(|pixel| (1.0 - sample(pixel[3])) as f32).collect();
        }
    }
    // The weights of both signs sum up to the range of the levels.
    let low: f64 = direction.iter().filter(|w| **w < 0.0).sum();
    let range: f64 = direction.iter().map(|w| w.abs()).sum();
    pixels.iter().map(|pixel| ((dot(direction, on_white(pixel)) - low) / range) as f32).collect()
}

/// The covariances of red, green and blue.
struct Spread([[f64; 3]; 3]);

impl Spread {
    fn of(colours: impl Iterator<Item = [f64; 3]>) -> Self {
        let (mut sums, mut products, mut count) = ([0.0; 3], [[0.0; 3]; 3], 0.0);
        for colour in colours {
            count += 1.0;
            for i in 0..3 {
                sums[i] += colour[i];
                for j in 0..3 {
                    products[i][j] += colour[i] * colour[j];
                }
            }
        }
        let mean = sums.map(|sum| sum / count);
        Self([0, 1, 2].map(|i| [0, 1, 2].map(|j| products[i][j] / count - mean[i] * mean[j])))
    }

    /// The variance of the values of a linear function.
    fn along(&self, weights: [f64; 3]) -> f64 {
        dot(weights, self.0.map(|row| dot(row, weights)))
    }

    /// The weights of a grey level and their variance: those of luminance, or those of the direction in which colours vary most.
    fn direction(&self) -> ([f64; 3], f64) {
        let of_luminance = self.along(LUMINANCE);
        let largest = [0, 1, 2].into_iter().max_by(|i, j| self.0[*i][*i].total_cmp(&self.0[*j][*j]));
        let mut direction = [0.0; 3];
        direction[largest.unwrap_or(0)] = 1.0;
        for _ in 0..STEPS {
            let next = self.0.map(|row| dot(row, direction));
            let length = dot(next, next).sqrt();
            if length > 0.0 {
                direction = next.map(|x| x / length);
            }
        }
        let variance = self.along(direction);
        if variance > MOST_OF_HUE * MOST_OF_HUE * of_luminance {
            (direction, variance)
        } else {
            (LUMINANCE, of_luminance)
        }
    }
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
