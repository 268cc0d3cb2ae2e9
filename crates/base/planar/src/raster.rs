//! Rasterising outlines.

use crate::Outline;

/// Sample rows per row of pixels.
const ROWS: usize = 4;

/// The share of each pixel that lies inside, by the even–odd rule over all outlines: row by row from the top.
///
/// # Shapes and units
/// Outlines in pixels, the centre of the upper left pixel at 0, 0, y downwards.
///
/// # Accuracy
/// Exact along each sample row; four sample rows per row of pixels.
pub fn fill<'o>(outlines: impl IntoIterator<Item = &'o Outline>, width: usize, height: usize) -> Vec<f32> {
    let mut crossings: Vec<Vec<f64>> = vec![Vec::new(); ROWS * height];
    let row_at = |y: f64| (y + 0.5) * ROWS as f64 - 0.5;
    for [a, b] in outlines.into_iter().flat_map(Outline::sides) {
        let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
        let first = row_at(low[1]).ceil().max(0.0);
        let last = row_at(high[1]).ceil().min((ROWS * height) as f64);
        if first >= last {
            continue;
        }
        for row in first as usize..last as usize {
            let y = (row as f64 + 0.5) / ROWS as f64 - 0.5;
            let t = (y - low[1]) / (high[1] - low[1]);
            crossings[row].push(low[0] + t * (high[0] - low[0]) + 0.5);
        }
    }
    let mut shares = vec![0.0_f32; width * height];
    for (row, places) in crossings.iter_mut().enumerate() {
        places.sort_by(f64::total_cmp);
        let line = &mut shares[row / ROWS * width..][..width];
        for pair in places.chunks_exact(2) {
            let [from, to] = [pair[0], pair[1]].map(|x| x.clamp(0.0, width as f64));
            for column in from as usize..(to.ceil() as usize).min(width) {
                let inside = to.min(column as f64 + 1.0) - from.max(column as f64);
                line[column] += (inside.max(0.0) / ROWS as f64) as f32;
            }
        }
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_pixels_add_up_to_the_area() {
        let frame = Outline::new(vec![[0.5, 0.5], [4.25, 0.5], [4.25, 3.5], [0.5, 3.5]]).unwrap();
        let hole = Outline::new(vec![[1.5, 1.5], [2.5, 1.5], [2.5, 2.5], [1.5, 2.5]]).unwrap();
        let shares = fill([&frame, &hole], 6, 5);
        let total: f32 = shares.iter().sum();
        assert!((f64::from(total) - (3.75 * 3.0 - 1.0)).abs() < 1e-6);
        assert_eq!((shares[6 + 1], shares[6 + 4], shares[12 + 2], shares[0]), (1.0, 0.75, 0.0, 0.0));
    }
}
