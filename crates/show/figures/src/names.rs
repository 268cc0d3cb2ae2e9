//! Names of files and axes on pages.

use crate::page::Axis;

/// The axis nearest to a direction.
pub fn axis(direction: [f64; 3]) -> Axis {
    let [x, y, z] = direction.map(f64::abs);
    if z >= x && z >= y {
        Axis::Z
    } else if y >= x {
        Axis::Y
    } else {
        Axis::X
    }
}

/// The file without its folder.
pub fn name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}
