//! Texts beside points of a panel.

use crate::Panel;
use crate::image::Image;
use crate::raster::Camera;
use crate::text::{Run, Style};
use crate::theme::Colors;

/// Distance of a text from its point, in ems.
const GAP: f64 = 0.7;
/// Height of the box behind a text, and empty space at its sides, in ems.
const HEIGHT: f64 = 1.35;
const PADDING: f64 = 0.3;

/// A rectangle: left, top, right and bottom.
type Place = [f64; 4];

/// Writes the texts of the points that the mesh does not hide, in boxes that do not cover each other, where there is room.
pub(crate) fn draw(image: &mut Image, panel: &Panel, camera: &Camera, colors: &Colors, style: Style) {
    let mut taken: Vec<Place> = Vec::new();
    let [width, height] = [image.width(), image.height()].map(f64::from);
    for (position, text) in &panel.labels {
        let at = camera.see(*position).at;
        let [x, y] = at.map(|c| c.floor() as u32);
        // The middle of its disc has the colour of marks unless the mesh hides it, or a later disc covers it in the same colour.
        if image.pixel(x, y) != Some(colors.mark) {
            continue;
        }
        let size = [style.width(text) + 2.0 * PADDING * style.size, HEIGHT * style.size];
        let Some(place) = free_place(at, size, [width, height], &taken, GAP * style.size) else { continue };
        let [left, top, right, bottom] = place;
        image.fill([left, top], [right, bottom], colors.mark);
        image.fill([left + 1.0, top + 1.0], [right - 1.0, bottom - 1.0], colors.background);
        let baseline = bottom - 0.33 * style.size;
        style.draw(image, text, [left + PADDING * style.size, baseline], Run::Across);
        taken.push(place);
    }
}

/// A place near a point, inside the picture and free: at its right, at its left, then higher and lower.
fn free_place(at: [f64; 2], size: [f64; 2], picture: [f64; 2], taken: &[Place], gap: f64) -> Option<Place> {
    let moves = (0..8).flat_map(|step: i32| [f64::from(step), -f64::from(step)]);
    let places = moves.flat_map(|step| {
        let top = at[1] - 0.5 * size[1] + step * size[1];
        [at[0] + gap, at[0] - gap - size[0]].map(|left| [left, top, left + size[0], top + size[1]])
    });
    let is_free = |place: &Place| {
        let inside = place[0] >= 0.0 && place[1] >= 0.0 && place[2] <= picture[0] && place[3] <= picture[1];
        let apart = |other: &Place| {
            place[2] <= other[0] || other[2] <= place[0] || place[3] <= other[1] || other[3] <= place[1]
        };
        inside && taken.iter().all(apart)
    };
    places.into_iter().find(is_free)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_do_not_cover_each_other_and_stay_inside() {
        let mut taken = Vec::new();
        while let Some(place) = free_place([50.0, 50.0], [30.0, 10.0], [100.0, 100.0], &taken, 5.0) {
            assert!(place[0] >= 0.0 && place[2] <= 100.0 && place[1] >= 0.0 && place[3] <= 100.0);
            taken.push(place);
        }
        // Nine boxes fit above each other on both sides.
        assert_eq!(taken.len(), 18);
        assert_eq!(taken[0], [55.0, 45.0, 85.0, 55.0]);
    }
}
