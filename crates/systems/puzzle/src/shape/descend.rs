//! Monotone gradient descent.

/// Ends when the energy falls by less than this share in [`WINDOW`] steps.
const SETTLED: f64 = 2e-4;
const WINDOW: usize = 8;

/// Momentum: the share of the previous step that is repeated.
const MOMENTUM: f64 = 0.85;

/// Moves x to lower energy; each accepted step lowers it. Returns the final energy.
///
/// `energy` returns the value at a point and writes an ascent direction, one of the gradients at kinks. `taken` is called after
/// each step; it returns whether to continue.
pub(super) fn descend(
    x: &mut Vec<f64>,
    first_step: f64,
    steps: usize,
    mut energy: impl FnMut(&[f64], &mut [f64]) -> f64,
    mut taken: impl FnMut(f64) -> bool,
) -> f64 {
    let n = x.len();
    let (mut gradient, mut new_gradient) = (vec![0.0; n], vec![0.0; n]);
    let mut value = energy(x, &mut gradient);
    let mut velocity = vec![0.0; n];
    let mut step = first_step;
    let mut seen = vec![value];
    for _ in 0..steps {
        let mut is_taken = false;
        for attempt in 0..14 {
            let to: Vec<f64> = (0..n).map(|i| x[i] + MOMENTUM * velocity[i] - step * gradient[i]).collect();
            let new = energy(&to, &mut new_gradient);
            if new < value {
                for i in 0..n {
                    velocity[i] = to[i] - x[i];
                }
                *x = to;
                value = new;
                std::mem::swap(&mut gradient, &mut new_gradient);
                if attempt == 0 {
                    step *= 1.15;
                }
                is_taken = true;
                break;
            }
            // Without momentum the direction is a descent direction.
            if attempt > 0 {
                step *= 0.4;
            }
            velocity.fill(0.0);
        }
        if !is_taken || !taken(value) {
            break;
        }
        seen.push(value);
        if seen.len() > WINDOW && value > (1.0 - SETTLED) * seen[seen.len() - 1 - WINDOW] {
            break;
        }
    }
    value
}

/// A hinge function: 0 below −width, v above width, a parabola between. It increases with v and with the width.
pub(super) fn hinge(v: f64, width: f64) -> (f64, f64) {
    if v <= -width {
        (0.0, 0.0)
    } else if v >= width {
        (v, 1.0)
    } else {
        let s = v + width;
        (s * s / (4.0 * width), s / (2.0 * width))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_energy_never_rises_and_reaches_a_minimum_with_a_kink() {
        let mut x = vec![3.0, -2.0];
        let mut last = f64::INFINITY;
        let energy = |x: &[f64], g: &mut [f64]| {
            g[0] = (x[0] - 1.0).signum();
            g[1] = 8.0 * x[1];
            (x[0] - 1.0).abs() + 4.0 * x[1] * x[1]
        };
        let end = descend(&mut x, 0.3, 400, energy, |value| {
            assert!(value < last);
            last = value;
            true
        });
        assert!(end < 1e-2 && (x[0] - 1.0).abs() < 1e-2, "{x:?}: {end}");
    }

    #[test]
    fn the_hinge_rises_with_its_width() {
        for v in [-0.3, -0.1, 0.0, 0.05, 0.2] {
            assert!(hinge(v, 0.1).0 <= hinge(v, 0.2).0);
            let (low, high) = (hinge(v - 1e-6, 0.15).0, hinge(v + 1e-6, 0.15).0);
            assert!(((high - low) / 2e-6 - hinge(v, 0.15).1).abs() < 1e-6);
        }
    }
}
