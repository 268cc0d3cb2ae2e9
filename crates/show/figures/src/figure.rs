//! Composing panels, a legend and text into a picture.

use crate::error::MAX_SIDE;
use crate::image::Image;
use crate::labels;
use crate::legend::{Histogram, Legend, LegendSide};
use crate::raster::{Camera, render};
use crate::text::{Run, Style, Weight};
use crate::{FigureError, Panel, Scale, Theme, View};

/// A picture of one or more panels that share a camera and a colour scale.
///
/// # Shapes and units
/// Sizes are in pixels; values and the ends of the scale are in the unit named in the scale's label.
///
/// # Accuracy
/// Pictures have the same bits for any number of threads, and on every machine with IEEE 754 arithmetic. A pixel is the mean of
/// nine samples; each sample has the colour of the value interpolated at its place, not an interpolation of colours.
///
/// # Limits
/// Faces are opaque and visible from both sides. The camera stays outside of all meshes.
///
/// # Cost
/// O(faces + pixels), parallel; 48 bytes per vertex, and 8 per face and tile of 64 pixels that it touches.
///
/// # Example
/// ```
/// use pompeiu_core::mesh::shapes::torus;
/// use pompeiu_figures::{ColorMap, Figure, Panel, Scale, Values};
///
/// let mesh = torus(1.0, 0.4, 48, 24)?;
/// let heights: Vec<f64> = mesh.positions().iter().map(|position| position[2]).collect();
/// let image = Figure::new(320, 240)
///     .with_scale(Scale::symmetric(ColorMap::Vik, 0.4)?, "height (mm)")
///     .with_panel(Panel::new(&mesh).with_values(Values::Vertices(&heights)).with_title("torus"))
///     .draw()?;
/// assert_eq!((image.width(), image.height()), (320, 240));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Figure<'a> {
    width: u32,
    height: u32,
    title: String,
    theme: Theme,
    view: View,
    scale: Option<(Scale, String)>,
    legend: LegendSide,
    has_legend: bool,
    text: Option<f64>,
    histograms: Vec<Histogram>,
    panels: Vec<Panel<'a>>,
}

impl<'a> Figure<'a> {
    /// An empty picture.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            title: String::new(),
            theme: Theme::default(),
            view: View::default(),
            scale: None,
            legend: LegendSide::default(),
            has_legend: true,
            text: None,
            histograms: Vec::new(),
            panels: Vec::new(),
        }
    }

    /// Writes a line of text at the top.
    #[must_use]
    pub fn with_title(mut self, title: impl Into<String>) -> Self {
        self.title = title.into();
        self
    }

    /// Chooses background and text colours.
    #[must_use]
    pub fn with_theme(mut self, theme: Theme) -> Self {
        self.theme = theme;
        self
    }

    /// Sets the viewing direction and projection.
    #[must_use]
    pub fn with_view(mut self, view: View) -> Self {
        self.view = view;
        self
    }

    /// Colours values by a scale, and shows its colour bar with a label that should name the unit.
    #[must_use]
    pub fn with_scale(mut self, scale: Scale, label: impl Into<String>) -> Self {
        self.scale = Some((scale, label.into()));
        self
    }

    /// Sets the side of the colour bar.
    #[must_use]
    pub fn with_legend_at(mut self, side: LegendSide) -> Self {
        self.legend = side;
        self
    }

    /// Leaves out the colour bar, where another picture beside this one has it.
    #[must_use]
    pub fn without_legend(mut self) -> Self {
        self.has_legend = false;
        self
    }

    /// Sets the size of text in pixels per em; by default it follows from the size of the picture.
    #[must_use]
    pub fn with_text_size(mut self, pixels: f64) -> Self {
        self.text = Some(pixels);
        self
    }

    /// Adds a histogram beside the colour bar, after earlier ones: shares in equal parts of the bar, from its lower end. The length
    /// of a column is proportional to the square root of its share, so that small shares remain visible.
    ///
    /// Without a [scale](Self::with_scale) there is no bar. Shares that are not positive numbers get no column.
    #[must_use]
    pub fn with_histogram(mut self, name: impl Into<String>, shares: Vec<f64>) -> Self {
        self.histograms.push(Histogram { name: name.into(), shares });
        self
    }

    /// Appends a panel: in rows, from left to right.
    #[must_use]
    pub fn with_panel(mut self, panel: Panel<'a>) -> Self {
        self.panels.push(panel);
        self
    }

    /// Draws the picture.
    ///
    /// # Errors
    /// [`FigureError`] names the inconsistency.
    pub fn draw(&self) -> Result<Image, FigureError> {
        let (width, height) = (self.width, self.height);
        if ![width, height].iter().all(|side| (1..=MAX_SIDE).contains(side)) {
            return Err(FigureError::Size { width, height });
        }
        for (panel, number) in self.panels.iter().zip(1..) {
            panel.check()?;
            if panel.values.is_some() && self.scale.is_none() {
                return Err(FigureError::NoScale { panel: number });
            }
        }
        let camera = Camera::new(&self.view, &self.panels)?;
        let colors = self.theme.colors();
        let mut image = Image::filled(width, height, colors.background);
        let sizes = Sizes::new(width, height, self.text);
        let mut area = Area {
            left: sizes.margin,
            top: sizes.margin,
            right: f64::from(width),
            bottom: f64::from(height),
        };
        area.right -= sizes.margin;
        area.bottom -= sizes.margin;
        if !self.title.is_empty() {
            let style = Style { weight: Weight::SemiBold, size: 1.3 * sizes.text, color: colors.text };
            let title = style.fit(&self.title, area.width());
            style.draw(&mut image, &title, [area.left, area.top + style.size], Run::Across);
            area.top += 2.1 * style.size;
        }
        let style = Style { weight: Weight::Regular, size: sizes.text, color: colors.text };
        if let (Some((scale, label)), true) = (&self.scale, self.has_legend) {
            let room = match self.legend {
                LegendSide::Right => area.height(),
                LegendSide::Bottom => area.width(),
            };
            let legend = Legend::new((scale, label), &self.histograms, style, self.legend, room);
            match self.legend {
                LegendSide::Right => area.right -= legend.thickness(),
                LegendSide::Bottom => area.bottom -= legend.thickness(),
            }
            let at = match self.legend {
                LegendSide::Right => [area.right, area.top],
                LegendSide::Bottom => [area.left, area.bottom],
            };
            legend.draw(&mut image, at);
        }
        self.draw_panels(&mut image, &camera, &area, style);
        Ok(image)
    }

    fn draw_panels(&self, image: &mut Image, camera: &Camera, area: &Area, style: Style) {
        let count = self.panels.len();
        let style = Style { weight: Weight::SemiBold, ..style };
        let line =
            if self.panels.iter().all(|panel| panel.title.is_empty()) { 0.0 } else { 1.9 * style.size };
        let size = |columns: usize| {
            let [columns, rows] = [columns, count.div_ceil(columns)].map(|n| n as f64);
            [area.width() / columns, area.height() / rows - line]
        };
        // The arrangement in which meshes are largest; of several, the one with the most columns.
        let columns = (1..=count).fold(1, |best, columns| {
            if camera.scale_for(size(columns)) >= camera.scale_for(size(best)) { columns } else { best }
        });
        let [cell_width, cell_height] = size(columns);
        let pixels = [cell_width, cell_height].map(|side| side.floor() as u32);
        if count == 0 || pixels.contains(&0) {
            return;
        }
        let camera = camera.fitted(pixels);
        let colors = self.theme.colors();
        for (index, panel) in self.panels.iter().enumerate() {
            let [column, row] = [index % columns, index / columns].map(|n| n as f64);
            let [left, top] = [area.left + column * cell_width, area.top + row * (cell_height + line)];
            let title = style.fit(&panel.title, cell_width - GUTTER * style.size);
            let indent = 0.5 * (cell_width - style.width(&title));
            style.draw(image, &title, [left + indent, top + style.size], Run::Across);
            let scale = self.scale.as_ref().map(|(scale, _)| scale);
            let mut drawn = render(panel, &camera, scale, &colors, pixels);
            let style = Style { weight: Weight::Regular, ..style };
            labels::draw(&mut drawn, panel, &camera, &colors, style);
            image.paste(&drawn, [left, top + line]);
        }
    }
}

/// Text size and margin, derived from the size of the picture.
struct Sizes {
    /// Pixels per em of normal text.
    text: f64,
    /// Empty pixels around everything.
    margin: f64,
}

/// Ems between the titles of neighbouring panels.
const GUTTER: f64 = 1.5;

/// Width of a square picture in ems, and the smallest legible em in pixels.
const EMS: f64 = 62.0;
const SMALLEST_EM: f64 = 10.0;

impl Sizes {
    fn new(width: u32, height: u32, text: Option<f64>) -> Self {
        let side = (f64::from(width) * f64::from(height)).sqrt();
        let text = text.unwrap_or(side / EMS);
        let text = if text > SMALLEST_EM { text } else { SMALLEST_EM };
        Self { text, margin: 0.9 * text }
    }
}

/// A part of the picture, in pixels.
struct Area {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

impl Area {
    fn width(&self) -> f64 {
        (self.right - self.left).clamp(0.0, f64::INFINITY)
    }

    fn height(&self) -> f64 {
        (self.bottom - self.top).clamp(0.0, f64::INFINITY)
    }
}
