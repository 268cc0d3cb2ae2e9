//! A panel as a camera sees it.

use super::camera::{Camera, Seen};
use super::triangles::Triangle;
use crate::theme::Colors;
use crate::{Panel, Scale};

/// A panel with its camera.
pub(super) struct Scene<'a> {
    pub(super) panel: &'a Panel<'a>,
    pub(super) camera: &'a Camera,
    pub(super) scale: Option<&'a Scale>,
    pub(super) theme: &'a Colors,
    /// The vertices in camera coordinates.
    pub(super) seen: Vec<Seen>,
}

impl Scene<'_> {
    pub(super) fn triangle(&self, face: u32) -> Option<Triangle> {
        Triangle::new(self.panel.mesh.faces()[face as usize].map(|vertex| self.seen[vertex as usize]))
    }
}
